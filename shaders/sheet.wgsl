// The sheet in space, as the window draws it: faces, then lines, into one multisampled target. Larger depth is nearer.
// Colours are linear light. Every colour is found in the vertex passes; the fragment passes only cover.

struct View {
    // Right, up and towards the viewer: a unit vector, and the place of the origin of `places` along it from the centre.
    right: vec4f,
    up: vec4f,
    toward: vec4f,
    // Half widths and half heights of the picture a length, depth a length, 1 / distance of the eye (0: parallel).
    scale: vec4f,
    // Pixels across and down, half the width of creases in pixels, 1 where colours are to be encoded as sRGB.
    picture: vec4f,
    // The distance of layers, the pull of lines towards the viewer (lengths), brightness of marks.
    layers: vec4f,
    front: vec4f,
    back: vec4f,
    mark: vec4f,
    // The colours of border and free hinges, mountains, valleys.
    inks: array<vec4f, 3>,
}

@group(0) @binding(0) var<uniform> view: View;
// The vertices, row by row; the layers before each triangle in its stack, seen from its front and from its back.
@group(0) @binding(1) var places: texture_2d<f32>;
@group(0) @binding(2) var layers: texture_2d<f32>;

const NONE = 0xffffffffu;
// The light of the films (Lambert's cosine wrapped around the sphere), fixed to the viewer.
const LIGHT = vec3f(-0.52, 0.66, 0.54);
const AMBIENT = 0.42;
// The part of a colour that the back of a tinted triangle keeps.
const TINTED_BACK = 0.62;

// Rows of tables have 512 cells.
fn cell(source: texture_2d<f32>, index: u32) -> vec4f {
    return textureLoad(source, vec2u(index & 511u, index >> 9u), 0);
}

fn place(vertex: u32) -> vec3f {
    return cell(places, vertex).xyz;
}

// The place on the screen: x, y and depth, −1 to 1, 0 to 1 for depth; w is what they were divided by.
// `lift` shifts the depth alone: it moves nothing across the screen.
fn seen(point: vec3f, lift: f32) -> vec4f {
    let along = vec3f(dot(view.right.xyz, point), dot(view.up.xyz, point), dot(view.toward.xyz, point))
        + vec3f(view.right.w, view.up.w, view.toward.w);
    let eye = view.scale.w;
    let w = 1.0 - eye * along.z;
    let depth = along.z + lift;
    // Linear over any plane on the screen, as depth is in a parallel view.
    let nearness = depth / (1.0 - eye * depth);
    return vec4f(along.xy * view.scale.xy / w, 0.5 + nearness * view.scale.z, w);
}

// The same in pixels, y up.
fn pixel(point: vec3f, lift: f32) -> vec3f {
    let at = seen(point, lift);
    return vec3f(0.5 * at.xy * view.picture.xy, at.z);
}

// 1 where the front of a triangle on the screen is seen, −1 where its back is.
fn facing(a: vec2f, b: vec2f, c: vec2f) -> f32 {
    let u = b - a;
    let v = c - a;
    return select(-1.0, 1.0, u.x * v.y - u.y * v.x >= 0.0);
}

fn normal(a: vec3f, b: vec3f, c: vec3f) -> vec3f {
    let n = cross(b - a, c - a);
    return n / max(length(n), 1e-20);
}

// The depth that triangle `face` gets by the order of layers: so much that they come apart alike across them, however
// they are seen, down to a slant of 15°. The first layer stays where it is. `side`: 1 where its front is seen.
fn sunk(face: u32, side: f32, cosine: f32) -> f32 {
    let before = cell(layers, face).xy;
    return -select(before.y, before.x, side > 0.0) * view.layers.x / max(abs(cosine), 0.26);
}

fn decoded(colour: vec3f) -> vec3f {
    return select(pow((colour + 0.055) / 1.055, vec3f(2.4)), colour / 12.92, colour <= vec3f(0.04045));
}

fn shown(light: vec3f, alpha: f32) -> vec4f {
    let encoded = select(1.055 * pow(max(light, vec3f(0.0)), vec3f(1.0 / 2.4)) - 0.055, 12.92 * light, light <= vec3f(0.0031308));
    return vec4f(select(light, encoded, view.picture.w > 0.5), alpha);
}

// s: the part of its colour that a side with the unit normal n reflects.
fn reflected(n: vec3f) -> f32 {
    let wrapped = 0.5 + 0.5 * dot(n, normalize(LIGHT));
    return AMBIENT + (1.0 - AMBIENT) * wrapped * wrapped;
}

// The colour of a triangle by its paint: kind in the highest byte (0 paper, 1 a value, that takes no light, 2 a tint,
// 3 a mark), colour as sRGB in the others.
fn painted(paint: u32, side: f32, n: vec3f) -> vec3f {
    let kind = paint >> 24u;
    let colour = decoded(vec3f(vec3u(paint, paint >> 8u, paint >> 16u) & vec3u(255u)) / 255.0);
    if kind == 1u {
        return colour;
    }
    var base = select(view.back.rgb, view.front.rgb, side > 0.0);
    if kind == 2u {
        base = colour * select(TINTED_BACK, 1.0, side > 0.0);
    }
    if kind == 3u {
        base = mix(base, view.mark.rgb, view.layers.z);
    }
    return base * reflected(n);
}

struct Face {
    @builtin(position) at: vec4f,
    @location(0) @interpolate(flat) light: vec3f,
}

// Three vertices a triangle, a triangle an instance.
@vertex
fn face_vertex(
    @builtin(vertex_index) k: u32,
    @builtin(instance_index) face: u32,
    @location(0) corners: vec3u,
    @location(1) paint: u32,
) -> Face {
    let a = place(corners.x);
    let b = place(corners.y);
    let c = place(corners.z);
    let side = facing(seen(a, 0.0).xy, seen(b, 0.0).xy, seen(c, 0.0).xy);
    let n = side * normal(a, b, c);
    let turned = vec3f(dot(view.right.xyz, n), dot(view.up.xyz, n), dot(view.toward.xyz, n));
    let lift = sunk(face, side, turned.z);
    let at = seen(select(select(c, b, k == 1u), a, k == 0u), lift);
    return Face(vec4f(at.xyz * at.w, at.w), painted(paint, side, turned));
}

@fragment
fn face_fragment(face: Face) -> @location(0) vec4f {
    return shown(face.light, 1.0);
}

struct Line {
    @builtin(position) at: vec4f,
    // Pixels along the line from its start and across it, its length, half its width.
    @location(0) @interpolate(linear) across: vec4f,
    @location(1) @interpolate(flat) ink: vec4f,
}

// A line on the screen between two places in pixels.
struct Track {
    start: vec3f,
    along: vec2f,
    extent: f32,
    // Depth a pixel along it.
    slope: f32,
}

fn track(start: vec3f, end: vec3f) -> Track {
    let apart = end.xy - start.xy;
    let extent = length(apart);
    let along = select(vec2f(1.0, 0.0), apart / max(extent, 1e-6), extent > 1e-6);
    return Track(start, along, extent, select(0.0, (end.z - start.z) / extent, extent > 0.5));
}

fn left_of(line: Track) -> vec2f {
    return vec2f(-line.along.y, line.along.x);
}

// A corner of a line: `u` pixels along and `v` across to the left, at `depth` over that of the line there.
fn corner(line: Track, u: f32, v: f32, depth: f32, half_width: f32, ink: vec4f) -> Line {
    let xy = line.start.xy + u * line.along + v * left_of(line);
    // Beyond its ends a line goes on, but one that is seen end on not far.
    let z = line.start.z + clamp(u, -0.5 * line.extent, 1.5 * line.extent) * line.slope + depth;
    let at = vec4f(2.0 * xy / view.picture.xy, clamp(z, 0.0, 1.0), 1.0);
    return Line(at, vec4f(u, v, line.extent, half_width), ink);
}

// How a triangle beside a crease goes on from it on the screen.
struct Beside {
    // Pixels from the crease to its third corner, to the left.
    reach: f32,
    // Depth a pixel to the left.
    slope: f32,
    // Depth over the crease by the order of layers.
    lift: f32,
}

// `front`: 1 where the front of the triangle is seen when it lies to the left, −1 to the right.
fn beside(line: Track, start: vec3f, end: vec3f, apex: u32, face: u32, front: f32) -> Beside {
    if face == NONE {
        return Beside(0.0, 0.0, -1.0);
    }
    let third = place(apex);
    let at = pixel(third, 0.0);
    let aside = at.xy - line.start.xy;
    let reach = dot(aside, left_of(line));
    let foot = line.start.z + dot(aside, line.along) * line.slope;
    let slope = select(0.0, (at.z - foot) / reach, abs(reach) > 0.02);
    let cosine = dot(normal(start, end, third), view.toward.xyz);
    return Beside(reach, slope, sunk(face, front * reach, cosine) * view.scale.z);
}

// Six vertices a half of a crease. Each half lies in the plane of the triangle that is seen on its side, at the depth of
// that one's layer: it hides and is hidden with its paper. Beside a silhouette it lies flat.
// `faces`, and their third corners `apexes`: left and right of the crease, seen from the front.
@vertex
fn crease_vertex(
    @builtin(vertex_index) index: u32,
    @location(0) ends: vec2u,
    @location(1) apexes: vec2u,
    @location(2) faces: vec2u,
    @location(3) ink: u32,
) -> Line {
    let start = place(ends.x);
    let end = place(ends.y);
    let line = track(pixel(start, 0.0), pixel(end, 0.0));
    let left = beside(line, start, end, apexes.x, faces.x, 1.0);
    let right = beside(line, start, end, apexes.y, faces.y, -1.0);
    let half_width = view.picture.z;
    let reach = half_width + 0.5;
    let side = select(-1.0, 1.0, index < 6u);
    let pull = view.layers.y * view.scale.z;
    // Depth over the crease: at it, and how much more at the outer border.
    var outer = vec2f(max(left.lift, right.lift), 0.0);
    var is_paper = false;
    if side * left.reach > 0.0 {
        outer = vec2f(left.lift, side * left.slope * min(reach, abs(left.reach)));
        is_paper = true;
    }
    if side * right.reach > 0.0 {
        let other = vec2f(right.lift, side * right.slope * min(reach, abs(right.reach)));
        if !is_paper || other.x + other.y > outer.x + outer.y {
            outer = other;
        }
    }
    // Where a triangle is seen at a slant, rounding to parts of a pixel moves its depth.
    let slack = pull + 0.02 * abs(outer.y);
    let k = index % 6u;
    let is_end = k == 1u || k == 2u || k == 4u;
    let is_outer = k == 2u || k == 4u || k == 5u;
    let u = select(-reach, line.extent + reach, is_end);
    let v = select(0.0, side * reach, is_outer);
    let depth = outer.x + select(0.0, outer.y, is_outer) + slack;
    return corner(line, u, v, depth, half_width, vec4f(view.inks[ink].rgb, 1.0));
}

// Six vertices a line or, where both ends are one, a dot. `colour`: linear light and opacity. `style`: half the width in
// pixels, opacity where it is hidden.
@vertex
fn overlay_vertex(
    @builtin(vertex_index) k: u32,
    @location(0) start: vec3f,
    @location(1) end: vec3f,
    @location(2) colour: vec4f,
    @location(3) style: vec2f,
) -> Line {
    return overlay(k, start, end, colour, style.x);
}

// The part of it that paper hides.
@vertex
fn hidden_vertex(
    @builtin(vertex_index) k: u32,
    @location(0) start: vec3f,
    @location(1) end: vec3f,
    @location(2) colour: vec4f,
    @location(3) style: vec2f,
) -> Line {
    return overlay(k, start, end, vec4f(colour.rgb, colour.a * style.y), style.x);
}

fn overlay(k: u32, start: vec3f, end: vec3f, colour: vec4f, half_width: f32) -> Line {
    let line = track(pixel(start, 0.0), pixel(end, 0.0));
    let reach = half_width + 0.5;
    let u = select(-reach, line.extent + reach, k == 1u || k == 2u || k == 4u);
    let v = select(-reach, reach, k == 2u || k == 4u || k == 5u);
    return corner(line, u, v, view.layers.y * view.scale.z, half_width, colour);
}

@fragment
fn line_fragment(line: Line) -> @location(0) vec4f {
    let beyond = max(max(-line.across.x, line.across.x - line.across.z), 0.0);
    let distance = length(vec2f(beyond, line.across.y));
    let cover = clamp(line.across.w + 0.5 - distance, 0.0, 1.0);
    return shown(line.ink.rgb, line.ink.a * cover);
}
