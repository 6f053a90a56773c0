// The page: its controls, its keys, and the hook for programs.

const STOPS = [[0, "deployed"], [1, "planar"], [2, "compact"]];

/** A number with a few digits. */
const short = (x) => Number(x.toPrecision(3)).toString().replace("-", "−");

class Controls {
    constructor(motion, paper, stage) {
        Object.assign(this, { motion, paper, stage });
        this.values = -1;
        this.player = new Player(motion, () => this.show());
        this.player.isRepeated = !matchMedia("(prefers-reduced-motion: reduce)").matches;
        this.addTime();
        this.addColours();
        this.addViews();
        this.addKeys();
        this.addPlots();
        this.addKey();
        stage.canvas.addEventListener("pointermove", (event) => this.point(event));
        stage.canvas.addEventListener("pointerleave", () => { element("pointed").textContent = ""; });
        element("play").addEventListener("click", () => this.player.toggle());
        element("repeat").checked = this.player.isRepeated;
        element("repeat").addEventListener("change", (event) => { this.player.isRepeated = event.target.checked; });
    }

    /** Where `time` lies on the way from the first to the last, per cent. */
    percent(time) {
        const { first, last } = this.motion;
        return `${last > first ? (100 * (time - first)) / (last - first) : 0}%`;
    }

    addTime() {
        const { motion } = this;
        const slider = element("time");
        Object.assign(slider, { min: motion.first, max: motion.last, value: motion.first });
        slider.addEventListener("input", () => {
            this.player.isPlaying = false;
            this.player.set(slider.valueAsNumber);
        });
        this.stops = STOPS.filter(([time]) => time >= motion.first && time <= motion.last).map(([time, name]) => {
            const button = document.createElement("button");
            Object.assign(button, { type: "button", textContent: name, title: `t = ${time}` });
            button.style.left = this.percent(time);
            button.classList.toggle("first", time === motion.first);
            button.classList.toggle("last", time === motion.last);
            button.addEventListener("click", () => {
                this.player.isPlaying = false;
                this.player.set(time);
            });
            element("stops").append(button);
            return [time, button];
        });
        const mark = (from, to, kind) => {
            const tick = document.createElement("i");
            tick.className = kind;
            tick.style.left = this.percent(from);
            if (to > from) tick.style.right = `calc(100% - ${this.percent(to)})`;
            element("time-marks").append(tick);
        };
        this.stops.forEach(([time]) => mark(time, time, "stop"));
        motion.header.marks.slice(0, 200).forEach(([from, to]) => mark(from, to, "mark"));
    }

    addColours() {
        const names = ["paper", ...this.motion.header.values.map((values) => values.title)];
        this.choices = names.map((name, index) => {
            const [label, input] = ["label", "input"].map((tag) => document.createElement(tag));
            const words = document.createElement("span");
            words.textContent = name;
            Object.assign(input, { type: "radio", name: "colour", checked: index === 0 });
            input.addEventListener("change", () => this.colour(index - 1));
            label.append(input, words);
            element("colours").append(label);
            return input;
        });
        element("colours").hidden = names.length < 2;
        const ramp = this.motion.header.colours.map(([r, g, b]) => `rgb(${r} ${g} ${b})`);
        element("legend-map").style.background = `linear-gradient(to right, ${ramp.join(", ")})`;
    }

    colour(index) {
        this.values = index;
        this.choices[index + 1].checked = true;
        const values = this.motion.header.values[index];
        element("legend").hidden = !values;
        if (values) {
            element("legend-title").textContent = values.title;
            element("legend-low").textContent = short(values.range[0]);
            element("legend-high").textContent = short(values.range[1]);
        }
        this.show();
    }

    addViews() {
        this.views = new Map(this.motion.header.views);
        for (const [name, view] of this.views) {
            const button = document.createElement("button");
            Object.assign(button, { type: "button", textContent: name });
            button.addEventListener("click", () => this.stage.look(view));
            element("views").append(button);
        }
    }

    addKeys() {
        const moves = { ArrowLeft: -0.02, ArrowRight: 0.02, PageDown: -0.2, PageUp: 0.2 };
        addEventListener("keydown", (event) => {
            if (event.ctrlKey || event.metaKey || event.altKey) return;
            const { player, motion } = this;
            const isButton = event.target.closest?.("button, summary, a, input[type=checkbox], input[type=radio]");
            if (event.key === " " && !isButton) player.toggle();
            else if (event.key.startsWith("Arrow") && event.target.type === "radio") return;
            else if (["ArrowLeft", "ArrowRight"].includes(event.key) || (event.key in moves && event.target.type === "range")) {
                player.isPlaying = false;
                player.set(player.time + moves[event.key] * (event.shiftKey ? 5 : 1));
            } else if (["Home", "End"].includes(event.key) && (isButton || event.target.type === "range" || event.target === this.stage.canvas)) {
                player.isPlaying = false;
                player.set(event.key === "Home" ? motion.first : motion.last);
            } else return;
            event.preventDefault();
        });
    }

    addPlots() {
        const plots = element("plots");
        if (!plots) return;
        const picture = plots.querySelector("img");
        const [[left, first], [right, last]] = JSON.parse(plots.dataset.axis);
        this.plotted = (time) => {
            const now = element("plot-now");
            now.style.left = `${100 * (left + ((right - left) * (time - first)) / (last - first))}%`;
            now.style.height = `${picture.clientHeight}px`;
            now.hidden = time < first || time > last;
        };
        const move = (event) => {
            if (event.type !== "pointerdown" && !event.buttons) return;
            const box = picture.getBoundingClientRect();
            const part = ((event.clientX - box.left) / box.width - left) / (right - left);
            this.player.isPlaying = false;
            this.player.set(first + part * (last - first));
        };
        picture.draggable = false;
        picture.addEventListener("pointerdown", move);
        picture.addEventListener("pointermove", move);
        picture.addEventListener("load", () => this.plotted(this.player.time));
        addEventListener("resize", () => this.plotted(this.player.time));
    }

    /** The colours of lines and sides, as they are drawn. */
    addKey() {
        const { style, marks } = this.motion.header;
        for (const sample of element("key").querySelectorAll("i")) {
            const [r, g, b] = style[sample.className.split(" ")[0]];
            sample.style[sample.classList.contains("side") ? "background" : "borderTopColor"] = `rgb(${r} ${g} ${b})`;
        }
        element("mark-key").hidden = marks.length === 0;
    }

    /** Says what the pointer is on. */
    point(event) {
        const face = event.buttons ? -1 : this.stage.pointed(event);
        element("pointed").textContent = face < 0 ? "" : this.words(face);
    }

    words(face) {
        const { faceFacets, facets, header } = this.motion;
        const facet = faceFacets[face];
        const [row, column, kind] = facets.subarray(3 * facet, 3 * facet + 3);
        const name = header.kinds[kind];
        let words = `facet ${facet}`;
        if (name !== "plain") words += `, ${name.replace("-", " ")}, row ${row} column ${column}`;
        const values = header.values[this.values];
        if (values) {
            const part = this.motion.values(this.values, this.player.time)[face];
            const [low, high] = values.range;
            const edge = part >= 1 ? "≥ " : part <= 0 && low !== 0 ? "≤ " : "";
            if (!Number.isNaN(part)) words += `: ${values.title} ${edge}${short(low + part * (high - low))}`;
        }
        return words;
    }

    show() {
        const { player, motion } = this;
        this.paper.show(player.time, this.values);
        this.stage.request();
        const slider = element("time");
        slider.value = player.time;
        const stop = this.stops.find(([time]) => Math.abs(time - player.time) < 5e-4);
        this.stops.forEach(([time, button]) => {
            if (stop && stop[0] === time) button.setAttribute("aria-current", "true");
            else button.removeAttribute("aria-current");
        });
        const stage = player.time < 1 ? "unfold" : player.time <= 2 ? "fold" : "settle";
        const words = stop ? stop[1].textContent : stage;
        const number = player.time.toFixed(3);
        slider.setAttribute("aria-valuetext", `t = ${number}, ${words}`);
        const [bold, rest] = ["b", "span"].map((tag) => document.createElement(tag));
        bold.textContent = `t = ${number}`;
        rest.textContent = words;
        element("readout").replaceChildren(bold, rest);
        element("play").classList.toggle("playing", player.isPlaying);
        element("play").setAttribute("aria-label", player.isPlaying ? "Pause" : "Play");
        if (this.plotted) this.plotted(player.time);
        const values = motion.header.values[this.values];
        if (values) {
            const most = motion.values(this.values, player.time).reduce((a, b) => (b > a ? b : a), 0);
            const [low, high] = values.range;
            element("legend-now").textContent = `largest now ${most >= 1 ? "≥ " : ""}${short(low + most * (high - low))}`;
        }
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

/** What a link may ask for: motion.html#t=1.5&view=top&colour=1 */
function follow(controls) {
    const wishes = new URLSearchParams(location.hash.slice(1));
    const view = controls.views.get(wishes.get("view"));
    if (view) controls.stage.look(view);
    const colour = Number(wishes.get("colour") ?? 0);
    if (controls.choices[colour]) controls.colour(colour - 1);
    if (wishes.has("t")) controls.player.set(wishes.get("t"));
}

async function open() {
    ["fold", "certificate"].forEach(addFile);
    const header = parsed("scene");
    const motion = new Motion(header, await arrays(header.arrays));
    const paper = new Paper(motion);
    paper.show(motion.first, -1);
    const stage = new Stage(motion, paper, element("sheet"));
    const controls = new Controls(motion, paper, stage);
    controls.show();
    follow(controls);
    addEventListener("hashchange", () => follow(controls));
    element("notice").hidden = true;
    window.foldmotion = {
        get time() { return controls.player.time; },
        get playing() { return controls.player.isPlaying; },
        triangles: motion.triangles,
        verdict: header.verdict,
        setTime: (time) => controls.player.set(time),
        play: () => controls.player.play(),
        pause: () => controls.player.pause(),
        setColour: (index) => controls.colour(index),
        setView: (name) => stage.look(controls.views.get(name)),
        positions: (time) => Array.from(motion.at(time)),
    };
    document.documentElement.dataset.ready = "true";
}

open().catch((error) => {
    element("notice").textContent = `The sheet cannot be shown here: ${error.message ?? error}. A browser with WebGL 2 is needed.`;
    element("controls").hidden = true;
    console.error(error);
});
