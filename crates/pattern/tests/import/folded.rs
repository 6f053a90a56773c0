//! A pattern folded flat by reflection at every crease, and whether a stack of its layers crosses itself.

use foldmotion_pattern::{Assignment, Edge, ImportedPattern};
use glam::{DAffine2, DMat2, DVec2};

/// The reflection in the line through two points.
fn reflection(a: DVec2, b: DVec2) -> DAffine2 {
    let way = (b - a).normalize();
    let turn = DMat2::from_cols(2.0 * way.x * way, 2.0 * way.y * way) - DMat2::IDENTITY;
    DAffine2::from_mat2_translation(turn, a - turn * a)
}

/// The flat state.
pub(crate) struct Folded<'a> {
    pub(crate) imported: &'a ImportedPattern,
    /// Where each triangle comes to lie.
    places: Vec<DAffine2>,
}

impl<'a> Folded<'a> {
    /// Seen from the front of the triangle at a point, which stays where it is; the others by a walk from it.
    pub(crate) fn new(imported: &'a ImportedPattern, fixed: [f64; 2]) -> Self {
        let places = vec![DAffine2::NAN; imported.sheet.faces.len()];
        let mut folded = Self { imported, places };
        let root = folded.face_at(fixed);
        folded.places[root] = DAffine2::IDENTITY;
        let mut reached = vec![root];
        while let Some(face) = reached.pop() {
            for (from, to, turn) in folded.steps() {
                if from == face && folded.places[to].is_nan() {
                    folded.places[to] = folded.places[from] * turn;
                    reached.push(to);
                }
            }
        }
        folded
    }

    /// The triangle in which a point of the pattern lies.
    pub(crate) fn face_at(&self, point: [f64; 2]) -> usize {
        let sheet = &self.imported.sheet;
        let is_inside = |face: &[u32; 3]| {
            let corners = face.map(|v| sheet.vertices[v as usize] - DVec2::from(point));
            (0..3).all(|i| corners[i].perp_dot(corners[(i + 1) % 3]) > -1e-12)
        };
        sheet.faces.iter().position(is_inside).unwrap()
    }

    /// Where a point of the pattern comes to lie.
    pub(crate) fn at(&self, point: [f64; 2]) -> DVec2 {
        self.places[self.face_at(point)].transform_point2(point.into())
    }

    /// Where a vertex comes to lie, as a corner of a triangle.
    fn corner(&self, face: usize, vertex: u32) -> DVec2 {
        self.places[face].transform_point2(self.imported.sheet.vertices[vertex as usize])
    }

    /// From each triangle to those beside it, and the map between them.
    fn steps(&self) -> impl Iterator<Item = (usize, usize, DAffine2)> + use<'a> {
        let sheet = &self.imported.sheet;
        sheet.edges.iter().filter(|e| e.is_hinge()).flat_map(|edge| {
            let [a, b] = edge.vertices.map(|v| sheet.vertices[v as usize]);
            let turn = if edge.is_crease() { reflection(a, b) } else { DAffine2::IDENTITY };
            let [f, g] = edge.faces.map(|f| f.unwrap() as usize);
            [(f, g, turn), (g, f, turn)]
        })
    }

    /// Whether a triangle shows its front.
    pub(crate) fn shows_front(&self, face: u32) -> bool {
        self.places[face as usize].matrix2.determinant() > 0.0
    }

    /// Whether the walk meets itself around every vertex.
    pub(crate) fn closes(&self) -> bool {
        let meets = |(from, to, turn): (usize, usize, DAffine2)| {
            self.places[to].abs_diff_eq(self.places[from] * turn, 1e-12)
        };
        self.steps().all(meets)
    }

    fn creases(&self) -> impl Iterator<Item = &Edge> {
        self.imported.sheet.edges.iter().filter(|e| e.is_crease())
    }

    /// How many creases have a letter that a stack, the place of every triangle from front to back, denies.
    pub(crate) fn denied(&self, stack: &[usize]) -> usize {
        let is_denied = |edge: &&Edge| {
            let [f, g] = edge.faces.map(|face| face.unwrap() as usize);
            let shows_front = self.places[f].matrix2.determinant() > 0.0;
            let folds_to_front = shows_front == (stack[g] < stack[f]);
            folds_to_front != (edge.assignment == Assignment::Valley)
        };
        self.creases().filter(is_denied).count()
    }

    /// How often a crease runs through a layer between the two that it joins, or interleaves with another crease.
    pub(crate) fn crossings(&self, stack: &[usize]) -> usize {
        let sheet = &self.imported.sheet;
        let bend = |edge: &Edge| {
            let [f, g] = edge.faces.map(|face| face.unwrap() as usize);
            Bend {
                ends: edge.vertices.map(|v| self.corner(f, v)),
                beside: self.corner(f, sheet.apex(f as u32, edge).unwrap()),
                layers: [stack[f].min(stack[g]), stack[f].max(stack[g])],
            }
        };
        let bends: Vec<Bend> = self.creases().map(bend).collect();
        let mut crossings = 0;
        for (index, bend) in bends.iter().enumerate() {
            let runs = |&face: &usize| {
                bend.spans(stack[face])
                    && bend.runs_through(sheet.faces[face].map(|v| self.corner(face, v)))
            };
            crossings += (0..stack.len()).filter(runs).count();
            let others = bends[index + 1..].iter();
            crossings += others.filter(|o| bend.interleaves(o) && bend.lies_along(o)).count();
        }
        crossings
    }
}

/// A crease folded flat: its ends, a point on the side of its triangles, the lower layer and the upper.
struct Bend {
    ends: [DVec2; 2],
    beside: DVec2,
    layers: [usize; 2],
}

impl Bend {
    /// Whether a layer lies between the two it joins.
    fn spans(&self, layer: usize) -> bool {
        self.layers[0] < layer && layer < self.layers[1]
    }

    /// Whether one of the other's layers lies between its own and one beyond.
    fn interleaves(&self, other: &Self) -> bool {
        let beyond = |layer| layer < self.layers[0] || self.layers[1] < layer;
        let [a, b] = other.layers;
        self.spans(a) && beyond(b) || self.spans(b) && beyond(a)
    }

    /// Whether a length of it lies inside a triangle.
    fn runs_through(&self, corners: [DVec2; 3]) -> bool {
        let winding = (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]);
        let (mut low, mut high) = (0.0_f64, 1.0_f64);
        for i in 0..3 {
            let way = (corners[(i + 1) % 3] - corners[i]) * winding.signum();
            let [a, b] = self.ends.map(|p| way.perp_dot(p - corners[i]) - 1e-9);
            match (a > 0.0, b > 0.0) {
                (true, true) => {}
                (true, false) => high = high.min(a / (a - b)),
                (false, true) => low = low.max(a / (a - b)),
                (false, false) => return false,
            }
        }
        high - low > 1e-6
    }

    /// Whether a length of both coincides, with their triangles on the same side.
    fn lies_along(&self, other: &Self) -> bool {
        let way = self.ends[1] - self.ends[0];
        let off = |p: DVec2| way.perp_dot(p - self.ends[0]);
        let [a, b] = other.ends.map(|p| way.dot(p - self.ends[0]) / way.length_squared());
        other.ends.iter().all(|p| off(*p).abs() < 1e-9)
            && a.max(b).min(1.0) - a.min(b).max(0.0) > 1e-6
            && off(self.beside) * off(other.beside) > 0.0
    }
}
