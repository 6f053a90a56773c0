// The sheet as three.js draws it: triangles with corners of their own, lines inside their own triangles. A line so
// hides and is hidden with its paper, and layers that lie on each other keep their lines to themselves.

const VERTEX = `
in vec3 line;
in float lift;
in vec4 paint;
out vec3 vCorner;
out vec3 vSeen;
flat out vec3 vLine;
flat out vec4 vPaint;
flat out float vSide;

void main() {
    int corner = gl_VertexID % 3;
    vCorner = vec3(corner == 0, corner == 1, corner == 2);
    vLine = line;
    vPaint = paint;
    vec3 seen = normalMatrix * normal;
    vSide = seen.z < 0.0 ? -1.0 : 1.0;
    vSeen = vSide * seen;
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    // The view is parallel: this moves nothing across the screen, but decides which layer is in front.
    viewPosition.z += vSide * lift;
    gl_Position = projectionMatrix * viewPosition;
}`;

// The light of the films: Lambert's cosine wrapped around the sphere, fixed to the viewer.
const FRAGMENT = `
uniform vec3 front, back, mark, mountain, valley, border;
uniform float halfWidth;
in vec3 vCorner;
in vec3 vSeen;
flat in vec3 vLine;
flat in vec4 vPaint;
flat in float vSide;
out vec4 colour;

const vec3 LIGHT = vec3(-0.52, 0.66, 0.54);

float reflected(vec3 seen) {
    float wrapped = 0.5 + 0.5 * dot(seen, normalize(LIGHT));
    return 0.42 + 0.58 * wrapped * wrapped;
}

// Creases over colours that show values: sRGB 176, 176, 180.
const vec3 NEUTRAL = vec3(0.434, 0.434, 0.456);

vec3 ink(float kind) {
    if (vPaint.a > 0.75 && kind < 2.5) return NEUTRAL;
    return kind < 1.5 ? mountain : kind < 2.5 ? valley : border;
}

vec3 encoded(vec3 light) {
    return mix(12.92 * light, 1.055 * pow(max(light, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
}

void main() {
    float part = reflected(normalize(vSeen));
    vec3 light = (vSide < 0.0 ? back : front) * part;
    // Square on, a value has the colour of the legend.
    if (vPaint.a > 0.75) light = vPaint.rgb * (1.0 + 0.8 * (part / reflected(vec3(0.0, 0.0, 1.0)) - 1.0));
    else if (vPaint.a > 0.25) light = mark * part;
    vec3 slopeX = dFdx(vCorner), slopeY = dFdy(vCorner);
    // The heights of the triangle over its sides, in pixels: lines leave room for paper between them.
    vec3 heights = 1.0 / max(sqrt(slopeX * slopeX + slopeY * slopeY), vec3(1e-9));
    vec3 away = vCorner * heights;
    for (int i = 0; i < 3; i += 1) {
        // A crease has a half in each of its triangles, the border all in one.
        float room = clamp(0.06 * heights[i], 0.25 * halfWidth, halfWidth);
        float reach = vLine[i] < 2.5 ? room : 2.0 * room;
        float cover = 1.0 - smoothstep(reach - 0.5, reach + 0.5, away[i]);
        if (vLine[i] > 0.5 && halfWidth > 0.0) light = mix(light, ink(vLine[i]), cover);
    }
    colour = vec4(encoded(light), 1.0);
}`;

/** Linear light of an sRGB colour of bytes. */
const light = (bytes) => {
    const colour = new THREE.Color().setRGB(bytes[0] / 255, bytes[1] / 255, bytes[2] / 255, "srgb");
    return colour;
};

/** Depth between neighbours of a stack, in the sheet's unit of length. */
const LAYER = 4e-3;

class Paper {
    constructor(motion) {
        this.motion = motion;
        const corners = 3 * motion.triangles;
        const attribute = (size, Type = Float32Array) => new THREE.BufferAttribute(new Type(corners * size), size);
        this.geometry = new THREE.BufferGeometry();
        for (const [name, size] of [["position", 3], ["normal", 3], ["line", 3], ["lift", 1], ["paint", 4]]) {
            this.geometry.setAttribute(name, attribute(size).setUsage(THREE.DynamicDrawUsage));
        }
        const line = this.geometry.attributes.line.array;
        for (let i = 0; i < line.length; i += 1) line[i] = motion.lines[3 * Math.floor(i / 9) + (i % 3)];
        const { style } = motion.header;
        const uniforms = { halfWidth: { value: 1 } };
        for (const name of ["front", "back", "mark", "mountain", "valley", "border"]) {
            uniforms[name] = { value: light(style[name]) };
        }
        this.material = new THREE.ShaderMaterial({
            glslVersion: THREE.GLSL3,
            vertexShader: VERTEX,
            fragmentShader: FRAGMENT,
            side: THREE.DoubleSide,
            uniforms,
        });
        this.mesh = new THREE.Mesh(this.geometry, this.material);
        this.mesh.frustumCulled = false;
        this.colours = motion.header.colours.map(light);
    }

    /** Lines are as wide as in a film of 960 pixels, thinner on a narrower screen. */
    setLines(ratio, width) {
        const part = Math.min(Math.max(width / 960, 0.5), 1);
        this.material.uniforms.halfWidth.value = 0.5 * this.motion.header.style.lineWidth * part * ratio;
    }

    /** Shows the state at `time`, painted with values of number `index`, or as paper if that is below 0. */
    show(time, index) {
        this.setPositions(this.motion.at(time));
        this.order();
        this.paint(time, index);
        this.geometry.boundingSphere = null;
        this.geometry.boundingBox = null;
    }

    setPositions(positions) {
        const { position, normal } = this.geometry.attributes;
        const { faces } = this.motion;
        const [a, b, c] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
        for (let face = 0; face < this.motion.triangles; face += 1) {
            [a, b, c].forEach((point, i) => point.fromArray(positions, 3 * faces[3 * face + i]));
            [a, b, c].forEach((point, i) => point.toArray(position.array, 9 * face + 3 * i));
            b.sub(a).cross(c.sub(a)).normalize();
            for (let i = 0; i < 3; i += 1) b.toArray(normal.array, 9 * face + 3 * i);
        }
        position.needsUpdate = true;
        normal.needsUpdate = true;
    }

    /** Lifts the layers of each stack apart, as far as they are parallel to a neighbour: from 30° on not at all. */
    order() {
        const { lift, normal } = this.geometry.attributes;
        const { pairs, lifts, triangles, header } = this.motion;
        const near = new Float32Array(triangles);
        const n = normal.array;
        for (let i = 0; i < pairs.length; i += 2) {
            const [f, g] = [9 * pairs[i], 9 * pairs[i + 1]];
            const cosine = Math.abs(n[f] * n[g] + n[f + 1] * n[g + 1] + n[f + 2] * n[g + 2]);
            const part = Math.min(Math.max((cosine - 0.866) / (0.966 - 0.866), 0), 1);
            near[pairs[i]] = Math.max(near[pairs[i]], part);
            near[pairs[i + 1]] = Math.max(near[pairs[i + 1]], part);
        }
        const unit = 0.5 * LAYER * header.unitLength;
        for (let i = 0; i < lift.array.length; i += 1) {
            const face = Math.floor(i / 3);
            lift.array[i] = unit * lifts[face] * near[face];
        }
        lift.needsUpdate = true;
    }

    paint(time, index) {
        const { paint } = this.geometry.attributes;
        const marked = this.motion.marked(time);
        const values = index < 0 ? null : this.motion.values(index, time);
        paint.array.fill(0);
        for (let face = 0; face < this.motion.triangles; face += 1) {
            const is = marked.has(this.motion.faceFacets[face]);
            if (!is && (!values || Number.isNaN(values[face]))) continue;
            const { r, g, b } = is ? this.colours[0] : this.colour(values[face]);
            for (let i = 0; i < 3; i += 1) paint.array.set([r, g, b, is ? 0.5 : 1], 12 * face + 4 * i);
        }
        paint.needsUpdate = true;
        return values;
    }

    /** The colour of a part of the range; the map's samples are mixed as bytes, as in the films. */
    colour(part) {
        const position = part * (this.colours.length - 1);
        const index = Math.min(Math.floor(position), this.colours.length - 2);
        const [low, high] = [index, index + 1].map((k) => this.motion.header.colours[k]);
        return light(low.map((byte, c) => Math.round(byte + (high[c] - byte) * (position - index))));
    }
}

