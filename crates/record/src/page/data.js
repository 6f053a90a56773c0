// The data of the page: a header as JSON and arrays, deflated, as base64.

const element = (id) => document.getElementById(id);
const parsed = (id) => JSON.parse(element(id).textContent);

/** The bytes of a data block. */
async function unpacked(id) {
    const text = atob(element(id).textContent);
    const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Response(stream).arrayBuffer();
}

/** The arrays of the payload by name. */
async function arrays(directory) {
    const bytes = await unpacked("payload");
    const types = { Uint8: Uint8Array, Uint32: Uint32Array, Int32: Int32Array };
    const array = ([name, { type, offset, length }]) => [name, new types[type](bytes, offset, length)];
    return Object.fromEntries(Object.entries(directory).map(array));
}

/** Changes from row to row, summed. */
function summed(changes, width) {
    const sums = changes.slice();
    for (let i = width; i < sums.length; i += 1) sums[i] += sums[i - width];
    return sums;
}

/** The indices of the rising `times` before and after `time`, and the fraction of the interval up to it. */
function between(times, time) {
    const next = times.findIndex((t) => t >= time);
    const after = next < 0 ? times.length - 1 : next;
    const before = next < 0 ? after : Math.max(after - 1, 0);
    const span = times[after] - times[before];
    return { before, after, part: span > 0 ? Math.min(Math.max((time - times[before]) / span, 0), 1) : 0 };
}

/** The sheet and its motion: positions and values at any time. `coordinates`: the coordinates of every key. */
class Motion {
    constructor(header, data) {
        Object.assign(this, data);
        this.header = header;
        this.times = header.times;
        this.keyTimes = header.keys.map((key) => header.times[key]);
        this.width = data.positions.length / header.keys.length;
        const coordinate = (steps, i) => header.origin[i % 3] + header.step * steps;
        this.coordinates = Float32Array.from(summed(data.positions, this.width), coordinate);
        this.triangles = data.faces.length / 3;
        this.levels = header.values.map((_, index) => summed(data[`values${index}`], this.triangles));
    }

    get first() {
        return this.times[0];
    }

    get last() {
        return this.times[this.times.length - 1];
    }

    /** The coordinates of the vertices: straight from key frame to key frame. */
    at(time) {
        const { before, after, part } = between(this.keyTimes, time);
        const [from, to] = [before * this.width, after * this.width];
        const positions = new Float32Array(this.width);
        for (let i = 0; i < this.width; i += 1) {
            const [a, b] = [this.coordinates[from + i], this.coordinates[to + i]];
            positions[i] = a + (b - a) * part;
        }
        return positions;
    }

    /** The values of the triangles as parts of their range, NaN if there is none. */
    values(index, time) {
        const { before, after, part } = between(this.times, time);
        const [all, most] = [this.levels[index], this.header.levels];
        const [from, to] = [before * this.triangles, after * this.triangles];
        return Float32Array.from({ length: this.triangles }, (_, face) => {
            const [a, b] = [all[from + face], all[to + face]];
            return a > most || b > most ? NaN : (a + (b - a) * part) / most;
        });
    }

    /** Whether each facet is marked; short spans are seen for a hundredth of the motion. */
    marked(time) {
        const least = (this.last - this.first) / 200;
        const facets = new Set();
        for (const [from, to, face] of this.header.marks) {
            const slack = Math.max(least - (to - from) / 2, 0);
            if (time >= from - slack && time <= to + slack) facets.add(this.faceFacets[face]);
        }
        return facets;
    }
}

