// Time on the page: slider, stages, readout, and the line across the plots.

const STOPS = [[0, "deployed"], [1, "planar"], [2, "compact"]];

/** The most spans on the slider; more would hide each other. */
const MOST_MARKS = 200;

class Timeline {
    /** `move` is called with the time that is chosen. */
    constructor(motion, move) {
        Object.assign(this, { motion, move });
        const slider = element("time");
        Object.assign(slider, { min: motion.first, max: motion.last, value: motion.first });
        slider.addEventListener("input", () => move(slider.valueAsNumber));
        const stops = STOPS.filter(([time]) => time >= motion.first && time <= motion.last);
        this.stops = stops.map(([time, name]) => [time, this.stop(time, name)]);
        stops.forEach(([time]) => this.mark(time, time, "stop"));
        motion.header.marks.slice(0, MOST_MARKS).forEach(([from, to]) => this.mark(from, to, "mark"));
        if (element("plots")) this.plot(element("plots"));
    }

    /** The fraction of the motion that lies before `time`. */
    percent(time) {
        const { first, last } = this.motion;
        return `${last > first ? (100 * (time - first)) / (last - first) : 0}%`;
    }

    stop(time, name) {
        const button = document.createElement("button");
        Object.assign(button, { type: "button", textContent: name, title: `t = ${time}` });
        button.style.left = this.percent(time);
        button.classList.toggle("first", time === this.motion.first);
        button.classList.toggle("last", time === this.motion.last);
        button.addEventListener("click", () => this.move(time));
        element("stops").append(button);
        return button;
    }

    mark(from, to, kind) {
        const tick = document.createElement("i");
        tick.className = kind;
        tick.style.left = this.percent(from);
        if (to > from) tick.style.right = `calc(100% - ${this.percent(to)})`;
        element("time-marks").append(tick);
    }

    /** Makes a press on the plots set the time. */
    plot(plots) {
        const picture = plots.querySelector("img");
        const [[left, first], [right, last]] = JSON.parse(plots.dataset.axis);
        this.drawLine = (time) => {
            const { style } = element("plot-now");
            style.left = `${100 * (left + ((right - left) * (time - first)) / (last - first))}%`;
            style.height = `${picture.clientHeight}px`;
            style.visibility = time < first || time > last ? "hidden" : "visible";
        };
        const press = (event) => {
            if (event.type !== "pointerdown" && !event.buttons) return;
            const box = picture.getBoundingClientRect();
            const part = ((event.clientX - box.left) / box.width - left) / (right - left);
            this.move(first + part * (last - first));
        };
        picture.draggable = false;
        picture.addEventListener("pointerdown", press);
        picture.addEventListener("pointermove", press);
        new ResizeObserver(() => this.drawLine(element("time").valueAsNumber)).observe(picture);
    }

    show(time, isPlaying) {
        const stop = this.stops.find(([at]) => Math.abs(time - at) < 5e-4);
        for (const [, button] of this.stops) {
            if (button === stop?.[1]) button.setAttribute("aria-current", "true");
            else button.removeAttribute("aria-current");
        }
        const stage = time < 1 ? "unfold" : time <= 2 ? "fold" : "settle";
        const words = stop ? stop[1].textContent : stage;
        const number = time.toFixed(3);
        const slider = element("time");
        slider.value = time;
        slider.setAttribute("aria-valuetext", `t = ${number}, ${words}`);
        const [bold, rest] = ["b", "span"].map((tag) => document.createElement(tag));
        bold.textContent = `t = ${number}`;
        rest.textContent = words;
        element("readout").replaceChildren(bold, rest);
        element("play").classList.toggle("playing", isPlaying);
        element("play").setAttribute("aria-label", isPlaying ? "Pause" : "Play");
        this.drawLine?.(time);
    }
}

