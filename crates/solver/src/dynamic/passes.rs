//! The passes of one step over a block.
//!
//! `edge_loads` evaluates each bar and hinge once: the pull of the bar, with its damper, and what the hinge asks of its
//! two triangles,
//!
//! p = k (1 − l₀/l) e + d (v₁ − v₀),  g = κ l₀ (θ* − θ) / l,  e = x₁ − x₀, l = |e|,
//!
//! as the three numbers k (1 − l₀/l), d and g; the first two shared out to the triangles at the edge.
//!
//! θ = atan2(l b·n_left, n_left·n_right) with n_left = e × a, n_right = b × e and a, b from x₀ to the apexes; it is
//! `foldmotion_geometry::fold_angle` since (n_right × n_left)·e = l² b·n_left.
//!
//! `face_loads` turns those of the three edges of a triangle into forces on its corners, where it has the points anyway;
//! so a node sums 6 corners, and no ends of bars. The gradient of a fold angle at
//! the corners of one of its triangles is along the normal n of that triangle: l n/|n|² at the apex, and at the ends what
//! keeps translations and rotations free. With D the dot product of the two sides at a corner, the three hinges sum to
//!
//! f_a = ((g_a − g_b) D_c + (g_a − g_c) D_b) n / |n|²
//!
//! for the corner a opposite to the edge of g_a, and in turn for b and c: three products where four points a hinge had
//! been. The face-angle springs m = φ (α₀ − α) add, with q = e × n / (|n| |e|²) of each side,
//!
//! f_a = (m_b − m_a) q_c + (m_c − m_a) q_b.
//!
//! `node_step` sums the corners at each node in a fixed order and moves it.

use pulp::{Simd, WithSimd};

use super::angle::atan2;
use super::lanes::{Lanes, Quad, Vectors, WIDTH};
use super::layout::Block;
use super::part::{Edge, Face, LEAST_SQUARE, Part};

/// A whole turn: fold angles are followed modulo it.
const TURN: f64 = std::f64::consts::TAU;

/// The parameters of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StepSettings {
    /// The time step Δt.
    pub(super) dt: f64,
    /// c of a viscous force −c m v, centred in the step.
    pub(super) viscosity: f64,
    /// Fraction of the bars' dampers that acts.
    pub(super) damping: f64,
}

/// Sums over the nodes of a block in a step, from the state it started in.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Totals {
    /// Σ v·(F before − F now): the work of the change of the forces along the last displacement, divided by Δt.
    pub(super) work: f64,
    /// Σ m |v|² of the last displacement.
    pub(super) path: f64,
    /// The largest |F|².
    pub(super) squared_force: f64,
    /// Σ |v|² after the step.
    pub(super) squared_speed: f64,
    /// The largest |v|² after the step.
    pub(super) largest_squared_speed: f64,
}

/// The state before a step, in the order of the layout.
#[derive(Debug, Clone, Copy)]
pub(super) struct StateBefore<'a> {
    pub(super) positions: &'a [Quad],
    pub(super) velocities: &'a [Quad],
}

/// The mass of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mass {
    pub(super) mass: f64,
    pub(super) inverse: f64,
}

impl Mass {
    pub(super) const UNIT: Self = Self::new(1.0);

    pub(super) const fn new(mass: f64) -> Self {
        Self { mass, inverse: 1.0 / mass }
    }
}

/// The values that a step writes for the nodes of one block.
#[derive(Debug)]
pub(super) struct StateAfter<'a> {
    pub(super) positions: &'a mut [Quad],
    pub(super) velocities: &'a mut [Quad],
    /// Forces of the last evaluation, overwritten by those of this one.
    pub(super) forces: &'a mut [Quad],
    pub(super) masses: &'a [Mass],
}

/// Angles and targets of the hinges of a block.
#[derive(Debug, Clone)]
pub(super) struct Hinges {
    /// The followed fold angles at the last evaluation.
    pub(super) angles: Vec<[f64; WIDTH]>,
    pub(super) targets: Vec<[f64; WIDTH]>,
}

/// Room for the loads of one block; a worker needs one.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    pub(super) positions: Vec<Quad>,
    velocities: Vec<Quad>,
    /// The loads of each edge on its triangles: g, k (1 − l₀/l) and d.
    pub(super) loads: Vec<[Quad; WIDTH]>,
    pub(super) corner_forces: Vec<[[Quad; WIDTH]; 3]>,
}

/// One step of one block.
#[derive(Debug)]
pub(super) struct BlockStep<'a> {
    pub(super) block: &'a Block,
    pub(super) hinges: &'a mut Hinges,
    pub(super) before: StateBefore<'a>,
    pub(super) after: StateAfter<'a>,
    pub(super) scratch: &'a mut Scratch,
    pub(super) settings: StepSettings,
    pub(super) face_angle_stiffness: f64,
}

impl WithSimd for BlockStep<'_> {
    type Output = Totals;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Totals {
        self.load_nodes();
        self.edge_loads(simd);
        match (self.settings.damping == 0.0, self.block.rest_angles.is_empty()) {
            (true, true) => self.face_loads::<S, false, false>(simd),
            (true, false) => self.face_loads::<S, false, true>(simd),
            (false, true) => self.face_loads::<S, true, false>(simd),
            (false, false) => self.face_loads::<S, true, true>(simd),
        }
        self.node_step(simd)
    }
}

impl BlockStep<'_> {
    #[inline(always)]
    fn load_nodes(&mut self) {
        let Self { block, before, scratch, .. } = self;
        load(block, before.positions, &mut scratch.positions);
        if self.settings.damping != 0.0 {
            load(block, before.velocities, &mut scratch.velocities);
        }
    }

    #[inline(always)]
    fn edge_loads<S: Simd>(&mut self, simd: S) {
        let scratch = &mut *self.scratch;
        scratch.loads.resize(self.block.edges.len(), [[0.0; 4]; WIDTH]);
        let damping = Lanes::splat(simd, self.settings.damping);
        let hinges = self.hinges.angles.iter_mut().zip(&self.hinges.targets);
        let records = self.block.edges.iter().zip(hinges);
        for ((record, (angle, target)), load) in records.zip(&mut scratch.loads) {
            for index in 0..Lanes::<S>::PARTS {
                let part = Part { simd, index };
                let Edge { e, a, b } = part.edge(&scratch.positions, record);
                let square = e.dot(e).max(damping.constant(LEAST_SQUARE));
                let inverse = damping.constant(1.0).over(square.sqrt());
                let tension = part.numbers(&record.tension) * inverse;
                let (left, right) = (e.cross(a), b.cross(e));
                let raw = atan2(square * inverse * b.dot(left), left.dot(right));
                let turns = (part.numbers(angle) - raw) * damping.constant(1.0 / TURN);
                let followed = turns.round().mul_add(damping.constant(TURN), raw);
                followed.store(angle, index);
                let moment =
                    part.numbers(&record.hinge_stiffness) * (part.numbers(target) - followed);
                let asked = Vectors {
                    x: moment * inverse,
                    y: part.numbers(&record.stiffness) - tension,
                    z: part.numbers(&record.damper) * damping,
                };
                asked.store(load, index);
            }
        }
    }

    #[inline(always)]
    fn face_loads<S: Simd, const DAMPED: bool, const HELD: bool>(&mut self, simd: S) {
        let scratch = &mut *self.scratch;
        let groups = self.block.faces.len();
        scratch.corner_forces.resize(groups, [[[0.0; 4]; WIDTH]; 3]);
        let loads = scratch.loads.as_flattened();
        let one = Lanes::splat(simd, 1.0);
        let stiffness = one.constant(self.face_angle_stiffness);
        for (group, (record, forces)) in
            self.block.faces.iter().zip(&mut scratch.corner_forces).enumerate()
        {
            for index in 0..Lanes::<S>::PARTS {
                let part = Part { simd, index };
                let Face { sides: [ea, eb, ec], dots: [da, db, dc], normal, square } =
                    part.face(&scratch.positions, record);
                let la = part.vectors(loads, &record.edges[0]);
                let lb = part.vectors(loads, &record.edges[1]);
                let lc = part.vectors(loads, &record.edges[2]);
                let (mut pa, mut pb, mut pc) = (ea.scaled(la.y), eb.scaled(lb.y), ec.scaled(lc.y));
                if DAMPED {
                    let va = part.vectors(&scratch.velocities, &record.vertices[0]);
                    let vb = part.vectors(&scratch.velocities, &record.vertices[1]);
                    let vc = part.vectors(&scratch.velocities, &record.vertices[2]);
                    pa = (vc - vb).mul_add(la.z, pa);
                    pb = (va - vc).mul_add(lb.z, pb);
                    pc = (vb - va).mul_add(lc.z, pc);
                }
                let along = normal.scaled(one.over(square));
                let (ab, bc, ca) = (la.x - lb.x, lb.x - lc.x, lc.x - la.x);
                let mut fa = along.mul_add(ab * dc - ca * db, pc - pb);
                let mut fb = along.mul_add(bc * da - ab * dc, pa - pc);
                let mut fc = along.mul_add(ca * db - bc * da, pb - pa);
                if HELD {
                    let rest = &self.block.rest_angles[group];
                    let length = square.sqrt();
                    let ma = stiffness * (part.numbers(&rest[0]) - atan2(length, da));
                    let mb = stiffness * (part.numbers(&rest[1]) - atan2(length, db));
                    let mc = stiffness * (part.numbers(&rest[2]) - atan2(length, dc));
                    // e × n / (|n| |e|²), with |e|² the sum of the dot products at its ends.
                    let across = along.scaled(length);
                    let qa = ea.cross(across).scaled(one.over(db + dc));
                    let qb = eb.cross(across).scaled(one.over(dc + da));
                    let qc = ec.cross(across).scaled(one.over(da + db));
                    fa = qc.mul_add(mb - ma, qb.mul_add(mc - ma, fa));
                    fb = qa.mul_add(mc - mb, qc.mul_add(ma - mb, fb));
                    fc = qb.mul_add(ma - mc, qa.mul_add(mb - mc, fc));
                }
                fa.store(&mut forces[0], index);
                fb.store(&mut forces[1], index);
                fc.store(&mut forces[2], index);
            }
        }
    }

    /// Sums the forces at each node and moves it.
    #[inline(always)]
    fn node_step<S: Simd>(&mut self, simd: S) -> Totals {
        let StepSettings { dt, viscosity, .. } = self.settings;
        let keep = (1.0 - 0.5 * viscosity * dt) / (1.0 + 0.5 * viscosity * dt);
        let gain = dt / (1.0 + 0.5 * viscosity * dt);
        let Self { block, before, after, scratch, .. } = self;
        let corner_forces = scratch.corner_forces.as_flattened().as_flattened();
        let own = block.first..block.first + block.owned;
        let nodes = before.positions[own.clone()]
            .iter()
            .zip(&before.velocities[own])
            .zip(block.corner_starts.windows(2));
        let written = after
            .positions
            .iter_mut()
            .zip(after.velocities.iter_mut())
            .zip(after.forces.iter_mut())
            .zip(after.masses);
        let [mut work, mut path, mut speeds] = [[0.0; 4]; 3];
        for (((x, v), starts), (((new_x, new_v), force), mass)) in nodes.zip(written) {
            let mut sum = [0.0; 4];
            for &slot in &block.corners[starts[0] as usize..starts[1] as usize] {
                let force = &corner_forces[slot as usize];
                for k in 0..4 {
                    sum[k] += force[k];
                }
            }
            let impulse = gain * mass.inverse;
            // All is read before anything is written, so that the four numbers of a vector move together.
            let (x, v, last_force) = (*x, *v, *force);
            let [mut next_x, mut next_v] = [[0.0; 4]; 2];
            for k in 0..4 {
                work[k] += v[k] * (last_force[k] - sum[k]);
                path[k] += v[k] * v[k] * mass.mass;
                next_v[k] = v[k] * keep + sum[k] * impulse;
                next_x[k] = x[k] + next_v[k] * dt;
                speeds[k] += next_v[k] * next_v[k];
            }
            *new_x = next_x;
            *new_v = next_v;
            *force = sum;
        }
        Totals {
            work: work.iter().sum(),
            path: path.iter().sum(),
            squared_force: largest_square(simd, after.forces),
            squared_speed: speeds.iter().sum(),
            largest_squared_speed: largest_square(simd, after.velocities),
        }
    }
}

/// Copies the nodes of a block, its own first.
#[inline(always)]
pub(super) fn load(block: &Block, nodes: &[Quad], local: &mut Vec<Quad>) {
    local.clear();
    local.extend_from_slice(&nodes[block.first..block.first + block.owned]);
    local.extend(block.halo.iter().map(|&node| nodes[node as usize]));
}

/// The largest |v|² of `vectors`; those that are not numbers are ignored.
#[inline(always)]
fn largest_square<S: Simd>(simd: S, vectors: &[Quad]) -> f64 {
    let (groups, rest) = vectors.as_chunks::<WIDTH>();
    let mut largest = Lanes::splat(simd, 0.0);
    for group in groups {
        for part in 0..Lanes::<S>::PARTS {
            let v = Vectors::load(simd, group, part);
            let square = v.dot(v);
            largest = largest.select_below(square, square, largest);
        }
    }
    let rest = rest.iter().map(|[x, y, z, _]| x * x + y * y + z * z);
    let lanes = largest.to_array();
    rest.chain(lanes).fold(0.0, f64::max)
}
