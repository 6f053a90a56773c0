// The passes of one step of the dynamic engine: the twins of crates/solver/src/dynamic/passes.rs, in f32.
//
// edge_loads -> face_loads -> node_step -> sum_totals. Each bar and hinge is evaluated once, each node gathers its own in a
// fixed order, sums over nodes are trees of fixed shape: no atomics, the same bits each time on one device. A node's place is
// its rest position in the flat sheet plus a displacement, so that the digits go to the motion: differences of rest
// positions come from f64. README.md lists the buffers.

// Kept in step with `Control` in crates/solver/src/dynamic/gpu/control.rs; a test compares the two.
struct Control {
    dt: f32,
    viscosity: f32,
    damping: f32,
    face_angle_stiffness: f32,
    nodes: u32,
    edges: u32,
    faces: u32,
    groups: u32,
    work: f32,
    path: f32,
    squared_force: f32,
    squared_speed: f32,
    largest_squared_speed: f32,
    longest_dt: f32,
    longest_way: f32,
    // Steps since the start of a relaxation; below 0 outside of one.
    age: f32,
}

@group(0) @binding(0) var<uniform> control: Control;
@group(0) @binding(1) var<storage, read> edge_vertices: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> edge_constants: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> edge_rest: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> displacements: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> velocities: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> angles: array<f32>;
@group(0) @binding(7) var<storage, read> targets: array<f32>;
@group(0) @binding(8) var<storage, read_write> loads: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read> face_records: array<vec4<u32>>;
@group(0) @binding(10) var<storage, read> face_rest: array<vec4<f32>>;
@group(0) @binding(11) var<storage, read_write> corner_forces: array<vec4<f32>>;
@group(0) @binding(12) var<storage, read> starts: array<vec2<u32>>;
@group(0) @binding(13) var<storage, read> slots: array<u32>;
@group(0) @binding(14) var<storage, read_write> forces_and_masses: array<vec4<f32>>;
@group(0) @binding(15) var<storage, read_write> totals: Control;
@group(0) @binding(16) var<storage, read_write> partials: array<vec4<f32>>;

const GROUP: u32 = 128u;
const LEAST_SQUARE: f32 = 1e-30;
const TURN: f32 = 6.2831855;

// The angle of (x, y), to a few units in the last place; WGSL's own may be off by 4096 of them.
fn angle_of(y: f32, x: f32) -> f32 {
    let across = abs(y);
    let along = abs(x);
    let longer = max(max(across, along), 1e-37);
    let shorter = min(across, along);
    // atan(s/l) = pi/4 + atan((s - l) / (s + l)).
    let is_steep = shorter > 0.41421357 * longer;
    let t = select(shorter, shorter - longer, is_steep) / select(longer, shorter + longer, is_steep);
    let z = t * t;
    var series = 0.05858149;
    series = series * z - 0.06664511;
    series = series * z + 0.07692183;
    series = series * z - 0.09090905;
    series = series * z + 0.11111111;
    series = series * z - 0.14285715;
    series = series * z + 0.2;
    series = series * z - 0.33333334;
    let small = select(0.0, 0.7853982, is_steep) + (t + t * z * series);
    let first = select(small, 1.5707964 - small, along < across);
    let half = select(first, 3.1415927 - first, x < 0.0);
    return select(half, -half, y < 0.0);
}

@compute @workgroup_size(128)
fn edge_loads(@builtin(global_invocation_id) id: vec3<u32>) {
    let edge = id.x;
    if (edge >= control.edges) {
        return;
    }
    let vertices = edge_vertices[edge];
    let constants = edge_constants[edge];
    let rest = edge_rest[2u * edge];
    let rest_right = edge_rest[2u * edge + 1u];
    let start = displacements[vertices.x].xyz;
    let e = vec3<f32>(rest.xy, 0.0) + (displacements[vertices.y].xyz - start);
    let a = vec3<f32>(rest.zw, 0.0) + (displacements[vertices.z].xyz - start);
    let b = vec3<f32>(rest_right.xy, 0.0) + (displacements[vertices.w].xyz - start);
    let square = max(dot(e, e), LEAST_SQUARE);
    let length = sqrt(square);
    let stretch = constants.x * ((length - constants.y) / length);
    let drag = velocities[vertices.y].xyz - velocities[vertices.x].xyz;
    let pull = e * stretch + drag * (constants.z * control.damping);
    let left = cross(e, a);
    let right = cross(b, e);
    let raw = angle_of(length * dot(b, left), dot(left, right));
    let followed = raw + round((angles[edge] - raw) / TURN) * TURN;
    angles[edge] = followed;
    loads[edge] = vec4<f32>(pull, constants.w * (targets[edge] - followed) / length);
}

@compute @workgroup_size(128)
fn face_loads(@builtin(global_invocation_id) id: vec3<u32>) {
    let face = id.x;
    if (face >= control.faces) {
        return;
    }
    let vertices = face_records[2u * face];
    let edges = face_records[2u * face + 1u];
    let rest = face_rest[2u * face];
    let start = displacements[vertices.x].xyz;
    let middle = displacements[vertices.y].xyz;
    let ec = vec3<f32>(rest.xy, 0.0) + (middle - start);
    let ea = vec3<f32>(rest.zw, 0.0) + (displacements[vertices.z].xyz - middle);
    let eb = -(ea + ec);
    let da = -dot(eb, ec);
    let db = -dot(ec, ea);
    let dc = -dot(ea, eb);
    let normal = cross(ec, ea);
    let square = max(dot(normal, normal), LEAST_SQUARE);
    let along = normal / square;
    let ga = loads[edges.x].w;
    let gb = loads[edges.y].w;
    let gc = loads[edges.z].w;
    let ab = ga - gb;
    let bc = gb - gc;
    let ca = gc - ga;
    var fa = along * (ab * dc - ca * db);
    var fb = along * (bc * da - ab * dc);
    var fc = along * (ca * db - bc * da);
    if (control.face_angle_stiffness > 0.0) {
        let angles_at_rest = face_rest[2u * face + 1u];
        let length = sqrt(square);
        let ma = control.face_angle_stiffness * (angles_at_rest.x - angle_of(length, da));
        let mb = control.face_angle_stiffness * (angles_at_rest.y - angle_of(length, db));
        let mc = control.face_angle_stiffness * (angles_at_rest.z - angle_of(length, dc));
        let across = along * length;
        let qa = cross(ea, across) / (db + dc);
        let qb = cross(eb, across) / (dc + da);
        let qc = cross(ec, across) / (da + db);
        fa += qc * (mb - ma) + qb * (mc - ma);
        fb += qa * (mc - mb) + qc * (ma - mb);
        fc += qb * (ma - mc) + qa * (mb - mc);
    }
    corner_forces[3u * face] = vec4<f32>(fa, 0.0);
    corner_forces[3u * face + 1u] = vec4<f32>(fb, 0.0);
    corner_forces[3u * face + 2u] = vec4<f32>(fc, 0.0);
}

var<workgroup> sums: array<vec4<f32>, 128>;
var<workgroup> maxima: array<vec2<f32>, 128>;

// Sums and maxima over the group, by a tree; the first invocation holds them.
fn reduce(lane: u32, sum: vec4<f32>, maximum: vec2<f32>) {
    sums[lane] = sum;
    maxima[lane] = maximum;
    workgroupBarrier();
    for (var half = GROUP / 2u; half > 0u; half /= 2u) {
        if (lane < half) {
            sums[lane] += sums[lane + half];
            maxima[lane] = max(maxima[lane], maxima[lane + half]);
        }
        workgroupBarrier();
    }
}

@compute @workgroup_size(128)
fn node_step(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
) {
    let node = id.x;
    var sum = vec4<f32>(0.0);
    var maximum = vec2<f32>(0.0);
    if (node < control.nodes) {
        let first = starts[node];
        let last = starts[node + 1u];
        var force = vec3<f32>(0.0);
        for (var at = first.x; at < last.x; at++) {
            let slot = slots[at];
            let pull = loads[slot / 2u].xyz;
            force += select(pull, -pull, slot % 2u == 1u);
        }
        for (var at = first.y; at < last.y; at++) {
            force += corner_forces[slots[at]].xyz;
        }
        let before = forces_and_masses[node];
        let mass = before.w;
        let v = velocities[node].xyz;
        let half = 0.5 * control.viscosity * control.dt;
        let moved = v * ((1.0 - half) / (1.0 + half)) + force * (control.dt / ((1.0 + half) * mass));
        sum = vec4<f32>(dot(v, before.xyz - force), mass * dot(v, v), dot(moved, moved), 0.0);
        maximum = vec2<f32>(dot(force, force), dot(moved, moved));
        forces_and_masses[node] = vec4<f32>(force, mass);
        velocities[node] = vec4<f32>(moved, 0.0);
        displacements[node] += vec4<f32>(moved * control.dt, 0.0);
    }
    reduce(local.x, sum, maximum);
    if (local.x == 0u) {
        partials[2u * group.x] = sums[0];
        partials[2u * group.x + 1u] = vec4<f32>(maxima[0], 0.0, 0.0);
    }
}

// One group: the totals, and from them the pace of the next step of a relaxation.
@compute @workgroup_size(128)
fn sum_totals(@builtin(local_invocation_id) local: vec3<u32>) {
    var sum = vec4<f32>(0.0);
    var maximum = vec2<f32>(0.0);
    for (var group = local.x; group < totals.groups; group += GROUP) {
        sum += partials[2u * group];
        maximum = max(maximum, partials[2u * group + 1u].xy);
    }
    reduce(local.x, sum, maximum);
    if (local.x == 0u) {
        let total = sums[0];
        totals.work = total.x;
        totals.path = total.y;
        totals.squared_speed = total.z;
        totals.squared_force = maxima[0].x;
        totals.largest_squared_speed = maxima[0].y;
        if (totals.age >= 0.0) {
            if (totals.age > 0.0 && total.y > 0.0) {
                totals.viscosity = 2.0 * sqrt(max(total.x / (total.y * totals.dt), 0.0));
            }
            totals.age += 1.0;
            totals.dt = min(totals.longest_dt, totals.longest_way / max(sqrt(maxima[0].y), 1e-30));
        }
    }
}
