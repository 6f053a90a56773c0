// The legend: which values the colours mean.

/** A number with few digits. */
const short = (x) => Number(x.toPrecision(3)).toString().replace("-", "−");

/** A value found from a part of its range, with as many digits as the steps of the range resolve. */
function told(part, { range: [low, high] }, levels) {
    const decimals = Math.max(Math.ceil(-Math.log10((high - low) / levels)), 0);
    const text = Number((low + part * (high - low)).toFixed(Math.min(decimals, 100))).toString().replace("-", "−");
    return part >= 1 ? `≥ ${text}` : text;
}

class Legend {
    /** `change` is called when other colours are chosen. */
    constructor(motion, change) {
        Object.assign(this, { motion, change, index: -1 });
        const names = ["paper", ...motion.header.values.map((values) => values.title)];
        this.choices = names.map((name, index) => this.choice(name, index - 1));
        element("colours").hidden = names.length < 2;
        const ramp = motion.header.colours.map(([r, g, b]) => `rgb(${r} ${g} ${b})`);
        element("legend-map").style.background = `linear-gradient(to right, ${ramp.join(", ")})`;
        this.addKey();
    }

    choice(name, index) {
        const [label, input, words] = ["label", "input", "span"].map((tag) => document.createElement(tag));
        words.textContent = name;
        Object.assign(input, { type: "radio", name: "colour", checked: index === this.index });
        input.addEventListener("change", () => this.choose(index));
        label.append(input, words);
        element("colours").append(label);
        return input;
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

    /** The values shown; none if the paper is shown. */
    get values() {
        return this.motion.header.values[this.index];
    }

    /** Shows the values of number `index`, or paper for −1. */
    choose(index) {
        const choice = this.choices[index + 1];
        if (!choice) return;
        choice.checked = true;
        this.index = index;
        element("legend").hidden = !this.values;
        if (this.values) {
            const { title, range } = this.values;
            element("legend-title").textContent = title;
            ["low", "high"].forEach((end, i) => { element(`legend-${end}`).textContent = short(range[i]); });
        }
        this.change();
    }

    show(time) {
        if (!this.values) return;
        const most = this.motion.values(this.index, time).reduce((a, b) => (b > a ? b : a), 0);
        element("legend-now").textContent = `largest now ${told(most, this.values, this.motion.header.levels)}`;
    }

    /** The kind of a triangle and its value. */
    words(face, time) {
        const { faceFacets, facets, header } = this.motion;
        const facet = faceFacets[face];
        const [row, column, kind] = facets.subarray(3 * facet, 3 * facet + 3);
        const name = header.kinds[kind];
        let words = `facet ${facet}`;
        if (name !== "plain") words += `, ${name.replace("-", " ")}, row ${row} column ${column}`;
        if (this.values) {
            const part = this.motion.values(this.index, time)[face];
            if (!Number.isNaN(part)) words += `: ${this.values.title} ${told(part, this.values, header.levels)}`;
        }
        return words;
    }
}

