//! A moving sheet with its truth, and the motions that show it, all of which have the same verdict.

use foldmotion_random::Random;
use std::collections::BTreeMap;

use foldmotion_pattern::{
    Assignment, CreaseKind, Edge, Facet, FacetKind, Frame, LayerOrder, Motion, Sheet,
};
use glam::{DQuat, DVec2, DVec3};

use super::{
    exact::{Point, UNIT},
    mesh::{Mesh, WHOLE, Weights, edge},
    part::Part,
};

/// The truth about a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Truth {
    /// Deeper than several τ, or through.
    Penetrating,
    /// Within τ, and nothing is through.
    Touching,
    /// Farther apart than τ.
    Free,
    /// Nothing is through: touching or free.
    NotThrough,
    /// Too close to a limit to require a verdict.
    Open,
}

/// A moving sheet.
#[derive(Debug, Clone)]
pub(crate) struct Scene {
    /// The corners and polygons at the first frame.
    pub(crate) part: Part,
    /// The position of every corner at every frame.
    pub(crate) frames: Vec<Vec<Point>>,
    pub(crate) mesh: Mesh,
    pub(crate) truth: Truth,
    /// The smallest distance of facets without a common vertex, if it is known.
    pub(crate) separation: Option<f64>,
    pub(crate) allows_slivers: bool,
}

impl Scene {
    /// The motion in its original form.
    pub(crate) fn motion(&self) -> Motion {
        let plain = Order::plain(&self.mesh);
        assemble(&self.mesh, &self.frames, &plain)
    }

    /// The same sheet on the same straight paths, with other triangles, turned, reversed, renumbered, and with more
    /// frames.
    pub(crate) fn varied(&self, random: &mut Random) -> Motion {
        let other;
        let mut mesh = &self.mesh;
        if random.index(4) == 0 && !self.allows_slivers {
            other = Mesh::random(&self.part, random, false);
            mesh = &other;
        }
        let order = if random.index(2) == 0 {
            Order::random(&self.part, mesh, random)
        } else {
            Order::plain(mesh)
        };
        let mut motion = assemble(mesh, &self.frames, &order);
        if random.index(3) == 0 {
            add_frames(&mut motion, random);
        }
        if random.index(2) == 0 {
            reverse(&mut motion);
        }
        if random.index(2) == 0 {
            turn(&mut motion, random);
        }
        motion
    }
}

/// The order in which vertices and triangles are numbered, and which triangles are turned over.
struct Order {
    vertices: Vec<usize>,
    triangles: Vec<usize>,
    is_turned: Vec<bool>,
}

fn shuffled(count: usize, random: &mut Random) -> Vec<usize> {
    let mut all: Vec<usize> = (0..count).collect();
    for i in (1..count).rev() {
        all.swap(i, random.index(i + 1));
    }
    all
}

impl Order {
    fn plain(mesh: &Mesh) -> Self {
        Self {
            vertices: (0..mesh.vertices.len()).collect(),
            triangles: (0..mesh.triangles.len()).collect(),
            is_turned: vec![false; mesh.triangles.len()],
        }
    }

    /// Triangles joined by edges are turned over together.
    fn random(part: &Part, mesh: &Mesh, random: &mut Random) -> Self {
        let component = components(part);
        let turned: Vec<bool> = component.iter().map(|_| random.index(2) == 0).collect();
        let is_turned = mesh.polygon_of.iter().map(|&p| turned[component[p]]);
        Self {
            vertices: shuffled(mesh.vertices.len(), random),
            triangles: shuffled(mesh.triangles.len(), random),
            is_turned: is_turned.collect(),
        }
    }
}

/// For every polygon, the first polygon that is joined to it by edges.
fn components(part: &Part) -> Vec<usize> {
    let edges = |polygon: &Vec<usize>| -> Vec<[usize; 2]> {
        let next = |i: usize| polygon[(i + 1) % polygon.len()];
        (0..polygon.len()).map(|i| edge(polygon[i], next(i))).collect()
    };
    let mut component: Vec<usize> = (0..part.polygons.len()).collect();
    for _ in 0..part.polygons.len() {
        for f in 0..part.polygons.len() {
            for g in 0..f {
                let own = edges(&part.polygons[f]);
                if edges(&part.polygons[g]).iter().any(|e| own.contains(e)) {
                    let least = component[f].min(component[g]);
                    (component[f], component[g]) = (least, least);
                }
            }
        }
    }
    component
}

fn position(weights: &Weights, corners: &[Point]) -> DVec3 {
    let along = |i: usize| {
        let sum: i64 = weights.iter().map(|&(c, w)| w * corners[c][i]).sum();
        sum as f64 / (WHOLE * UNIT) as f64
    };
    DVec3::new(along(0), along(1), along(2))
}

/// A projection in which no polygon is seen edge-on: the triangles of the crease pattern must have an area.
fn pattern(p: DVec3) -> DVec2 {
    DVec2::new(p.x + 0.371 * p.z, p.y + 0.613 * p.z)
}

fn assemble(mesh: &Mesh, frames: &[Vec<Point>], order: &Order) -> Motion {
    let mut number = vec![0_u32; order.vertices.len()];
    for (new, &old) in order.vertices.iter().enumerate() {
        number[old] = new as u32;
    }
    let faces = order.triangles.iter().map(|&t| {
        let [a, b, c] = mesh.triangles[t].map(|v| number[v]);
        if order.is_turned[t] { [a, c, b] } else { [a, b, c] }
    });
    let faces: Vec<[u32; 3]> = faces.collect();
    let polygon_of: Vec<usize> = order.triangles.iter().map(|&t| mesh.polygon_of[t]).collect();
    let facets = mesh.outlines.iter().map(|outline| Facet {
        polygon: outline.iter().map(|&v| number[v]).collect(),
        row: 0,
        column: 0,
        kind: FacetKind::Plain,
    });
    let positions = |corners: &Vec<Point>| -> Vec<DVec3> {
        order.vertices.iter().map(|&v| position(&mesh.vertices[v], corners)).collect()
    };
    Motion {
        sheet: Sheet {
            vertices: positions(&frames[0]).into_iter().map(pattern).collect(),
            edges: edges(&faces, &polygon_of),
            face_facets: polygon_of.iter().map(|&p| p as u32).collect(),
            facets: facets.collect(),
            faces,
            unit_length: 1.0,
        },
        frames: frames
            .iter()
            .enumerate()
            .map(|(k, corners)| Frame { time: k as f64, positions: positions(corners) })
            .collect(),
        compact_order: LayerOrder::default(),
    }
}

fn edges(faces: &[[u32; 3]], polygon_of: &[usize]) -> Vec<Edge> {
    let mut sides: BTreeMap<(u32, u32), [Option<u32>; 2]> = BTreeMap::new();
    for (face, corners) in faces.iter().enumerate() {
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            let slot = usize::from(from > to);
            sides.entry((from.min(to), from.max(to))).or_default()[slot] = Some(face as u32);
        }
    }
    let edges = sides.into_iter().map(|((v, w), faces)| {
        let (assignment, kind) = match faces {
            [Some(f), Some(g)] if polygon_of[f as usize] == polygon_of[g as usize] => {
                (Assignment::Facet, CreaseKind::Facet)
            }
            [Some(_), Some(_)] => (Assignment::Free, CreaseKind::Imported),
            _ => (Assignment::Border, CreaseKind::Border),
        };
        Edge { vertices: [v, w], assignment, kind, row: 0, column: 0, faces }
    });
    edges.collect()
}

/// Adds one or two frames on the straight paths.
fn add_frames(motion: &mut Motion, random: &mut Random) {
    for _ in 0..=random.index(2) {
        if motion.frames.len() < 2 {
            return;
        }
        let k = random.index(motion.frames.len() - 1);
        let share = [0.5, 0.25, 0.75, 0.3][random.index(4)];
        let (p, q) = (&motion.frames[k], &motion.frames[k + 1]);
        let both = p.positions.iter().zip(&q.positions);
        let frame = Frame {
            time: p.time + (q.time - p.time) * share,
            positions: both.map(|(p, q)| p + (q - p) * share).collect(),
        };
        motion.frames.insert(k + 1, frame);
    }
}

fn reverse(motion: &mut Motion) {
    let last = motion.frames.last().map_or(0.0, |frame| frame.time);
    motion.frames.reverse();
    for frame in &mut motion.frames {
        frame.time = last - frame.time;
    }
}

fn turn(motion: &mut Motion, random: &mut Random) {
    let axis = (random.vector() + DVec3::splat(1e-3)).normalize();
    let turn = DQuat::from_axis_angle(axis, 3.0 * random.number());
    for frame in &mut motion.frames {
        for p in &mut frame.positions {
            *p = turn * *p;
        }
    }
}
