// The page: it joins its parts, handles keys, and offers an interface to other programs.

class Controls {
    constructor(motion, paper, stage) {
        Object.assign(this, { motion, paper, stage });
        this.player = new Player(motion, () => this.show());
        this.player.isRepeated = !matchMedia("(prefers-reduced-motion: reduce)").matches;
        this.timeline = new Timeline(motion, (time) => this.move(time));
        this.legend = new Legend(motion, () => this.show());
        this.views = new Map(motion.header.views);
        this.addButtons();
        addEventListener("keydown", (event) => this.press(event));
        stage.canvas.addEventListener("pointermove", (event) => this.point(event));
        stage.canvas.addEventListener("pointerleave", () => { element("pointed").textContent = ""; });
    }

    addButtons() {
        const add = (name, title, act) => {
            const button = document.createElement("button");
            Object.assign(button, { type: "button", textContent: name, title });
            button.addEventListener("click", act);
            element("views").append(button);
        };
        this.views.forEach((view, name) => add(name, "all of the motion", () => this.stage.look(view)));
        add("fit", "the state shown, as large as it fits", () => this.stage.fit());
        element("play").addEventListener("click", () => this.player.toggle());
        element("repeat").checked = this.player.isRepeated;
        element("repeat").addEventListener("change", (event) => { this.player.isRepeated = event.target.checked; });
    }

    /** Stops at `time`. */
    move(time) {
        this.player.isPlaying = false;
        this.player.set(time);
    }

    /** Space plays, arrows move in time; elements that use a key themselves keep it. */
    press(event) {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const { player, motion } = this;
        const isSlider = event.target.type === "range";
        const isChoice = Boolean(event.target.closest?.("button, summary, a, input:not([type=range])"));
        const step = event.shiftKey ? 0.1 : 0.02;
        const moves = { ArrowLeft: -step, ArrowRight: step };
        if (isSlider) Object.assign(moves, { ArrowDown: -step, ArrowUp: step, PageDown: -0.2, PageUp: 0.2 });
        if (isSlider || event.target === this.stage.canvas) {
            Object.assign(moves, { Home: motion.first - player.time, End: motion.last - player.time });
        }
        if (event.key === " " && !isChoice) player.toggle();
        else if (event.key in moves && event.target.type !== "radio") this.move(player.time + moves[event.key]);
        else return;
        event.preventDefault();
    }

    /** Describes what the pointer is on. */
    point(event) {
        const face = event.buttons ? -1 : this.stage.pointed(event);
        element("pointed").textContent = face < 0 ? "" : this.legend.words(face, this.player.time);
    }

    show() {
        const { time, isPlaying } = this.player;
        this.paper.show(time, this.legend.index);
        this.stage.request();
        this.timeline.show(time, isPlaying);
        this.legend.show(time);
    }

    /** The settings a link may contain: motion.html#t=1.5&view=top&colour=1 */
    follow() {
        const wishes = new URLSearchParams(location.hash.slice(1));
        const view = this.views.get(wishes.get("view"));
        if (view) this.stage.look(view);
        if (wishes.has("colour")) this.legend.choose(Number(wishes.get("colour")) - 1);
        if (wishes.has("t")) this.move(wishes.get("t"));
    }
}

/** Lets a press on a button save the file in a data block. */
function addFile(id) {
    const button = element(`save-${id}`);
    button?.addEventListener("click", async () => {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(new Blob([await unpacked(`${id}-file`)], { type: "application/json" }));
        link.download = button.dataset.name;
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    });
}

/** The interface for other programs. */
function hook(motion, controls) {
    const { player } = controls;
    return {
        get time() { return player.time; },
        get playing() { return player.isPlaying; },
        triangles: motion.triangles,
        verdict: motion.header.verdict,
        setTime: (time) => controls.move(time),
        play: () => player.play(),
        pause: () => player.pause(),
        setColour: (index) => controls.legend.choose(index),
        setView: (name) => controls.stage.look(controls.views.get(name)),
        fit: () => controls.stage.fit(),
        positions: (time) => Array.from(motion.at(time)),
    };
}

async function open() {
    ["fold", "certificate"].forEach(addFile);
    const header = parsed("scene");
    const motion = new Motion(header, await arrays(header.arrays));
    const paper = new Paper(motion);
    const controls = new Controls(motion, paper, new Stage(motion, paper, element("sheet")));
    controls.show();
    controls.follow();
    addEventListener("hashchange", () => controls.follow());
    element("notice").hidden = true;
    window.foldmotion = hook(motion, controls);
    document.documentElement.dataset.ready = "true";
}

open().catch((error) => {
    element("notice").textContent = `The sheet cannot be shown here: ${error.message ?? error}. A browser with WebGL 2 is needed.`;
    element("controls").hidden = true;
    console.error(error);
});
