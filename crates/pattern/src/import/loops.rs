//! The faces of a planar graph.
//!
//! Each line is two half-edges, 2i from its first end to its second and 2i + 1 back; the face of a half-edge lies on
//! its left. Signs come from exact predicates throughout.

use std::cmp::Ordering;

use glam::DVec2;

use super::grid::Grid;
use super::predicate::side;
use super::split::Graph;

/// The loops of half-edges around the faces, and which of them bound one face.
#[derive(Debug)]
pub(super) struct Faces {
    /// The face on the left of each half-edge; 0 is the plane around everything.
    pub(super) face_of: Vec<u32>,
    /// The loops of each face, as vertices, the face on their left: the outer one first, then one around each thing
    /// inside; face 0 has no outer one.
    pub(super) loops: Vec<Vec<Vec<u32>>>,
}

/// The faces of a planar graph.
pub(super) fn faces(graph: &Graph) -> Faces {
    let trace = Trace::new(graph);
    let outer = trace.outer_loops();
    let face_of_loop = trace.nest(&outer);
    let count = 1 + trace.starts.len() - outer.len();
    let mut loops = vec![Vec::new(); count];
    // Outer borders of faces come before what lies inside them.
    for is_inner in [false, true] {
        for (index, &face) in face_of_loop.iter().enumerate() {
            if outer.contains_key(&(index as u32)) == is_inner {
                loops[face as usize].push(trace.vertices(trace.starts[index]));
            }
        }
    }
    let face = |of: &u32| face_of_loop[*of as usize];
    Faces { face_of: trace.loop_of.iter().map(face).collect(), loops }
}

/// Outer loops by their index, each with the first vertex of its part of the graph.
type OuterLoops = std::collections::BTreeMap<u32, u32>;

struct Trace<'a> {
    graph: &'a Graph,
    /// The half-edges that leave each vertex, counter-clockwise from straight down, exclusive.
    leaving: Vec<Vec<u32>>,
    /// The half-edge that comes next in the loop.
    next: Vec<u32>,
    /// The loop of each half-edge.
    loop_of: Vec<u32>,
    /// A half-edge of each loop.
    starts: Vec<u32>,
}

impl<'a> Trace<'a> {
    fn new(graph: &'a Graph) -> Self {
        let mut leaving = vec![Vec::new(); graph.points.len()];
        for (index, line) in graph.lines.iter().enumerate() {
            leaving[line.ends[0] as usize].push(2 * index as u32);
            leaving[line.ends[1] as usize].push(2 * index as u32 + 1);
        }
        let half_edges = 2 * graph.lines.len();
        let mut trace = Self {
            graph,
            leaving: Vec::new(),
            next: vec![0; half_edges],
            loop_of: vec![u32::MAX; half_edges],
            starts: Vec::new(),
        };
        for (vertex, half_edges) in leaving.iter_mut().enumerate() {
            let at = graph.points[vertex];
            half_edges.sort_by(|&g, &h| {
                let [g, h] = [g, h].map(|e| graph.points[trace.to(e) as usize]);
                around(at, g, h)
            });
            // Coming in along the twin of one, the face on the left goes on along the one before it.
            for (index, &half_edge) in half_edges.iter().enumerate() {
                let before = half_edges[(index + half_edges.len() - 1) % half_edges.len()];
                trace.next[(half_edge ^ 1) as usize] = before;
            }
        }
        trace.leaving = leaving;
        trace.number_loops();
        trace
    }

    fn to(&self, half_edge: u32) -> u32 {
        self.from(half_edge ^ 1)
    }

    fn from(&self, half_edge: u32) -> u32 {
        self.graph.lines[half_edge as usize / 2].ends[half_edge as usize % 2]
    }

    fn number_loops(&mut self) {
        for start in 0..self.next.len() as u32 {
            if self.loop_of[start as usize] != u32::MAX {
                continue;
            }
            let number = self.starts.len() as u32;
            let mut at = start;
            while self.loop_of[at as usize] == u32::MAX {
                self.loop_of[at as usize] = number;
                at = self.next[at as usize];
            }
            self.starts.push(start);
        }
    }

    fn vertices(&self, start: u32) -> Vec<u32> {
        let mut vertices = vec![self.from(start)];
        let mut at = self.next[start as usize];
        while at != start {
            vertices.push(self.from(at));
            at = self.next[at as usize];
        }
        vertices
    }

    /// The loop around each connected part of the graph from outside, by the part's first vertex (leftmost, then
    /// lowest): nothing lies to its left, so the last half-edge that leaves it has the outside on its left.
    fn outer_loops(&self) -> OuterLoops {
        let mut part = vec![u32::MAX; self.graph.points.len()];
        let mut outer = OuterLoops::new();
        for first in self.ordered() {
            let Some(&last) = self.leaving[first as usize].last() else {
                continue;
            };
            if part[first as usize] != u32::MAX {
                continue;
            }
            outer.insert(self.loop_of[last as usize], first);
            let mut reached = vec![first];
            part[first as usize] = first;
            while let Some(vertex) = reached.pop() {
                for &half_edge in &self.leaving[vertex as usize] {
                    let to = self.to(half_edge);
                    if part[to as usize] == u32::MAX {
                        part[to as usize] = first;
                        reached.push(to);
                    }
                }
            }
        }
        outer
    }

    /// The vertices from left to right, from below upwards where equally far left.
    fn ordered(&self) -> Vec<u32> {
        let points = &self.graph.points;
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        order.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|v| points[v as usize]);
            a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
        });
        order
    }

    /// The face of each loop: a number of its own for those that go around a face, for the others the face they lie in.
    fn nest(&self, outer: &OuterLoops) -> Vec<u32> {
        let mut face_of_loop = vec![0; self.starts.len()];
        let mut count = 0;
        for (index, face) in face_of_loop.iter_mut().enumerate() {
            if !outer.contains_key(&(index as u32)) {
                count += 1;
                *face = count;
            }
        }
        let lines = self.graph.lines.iter();
        let segments: Vec<[DVec2; 2]> =
            lines.map(|line| line.ends.map(|v| self.graph.points[v as usize])).collect();
        let grid = Grid::new(&segments, 0.0);
        let mut from_left: Vec<(&u32, &u32)> = outer.iter().collect();
        let points = &self.graph.points;
        from_left.sort_by(|a, b| {
            let [a, b] = [a, b].map(|(_, first)| points[**first as usize]);
            a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
        });
        // A loop around another begins farther left, so what it lies in is already known.
        for (&index, &first) in from_left {
            let beside = Self::left_of(points[first as usize], &segments, &grid);
            face_of_loop[index as usize] =
                beside.map_or(0, |h| face_of_loop[self.loop_of[h as usize] as usize]);
        }
        face_of_loop
    }

    /// The half-edge that a ray to the left from `point` meets first, with the point's side on its left.
    fn left_of(point: DVec2, segments: &[[DVec2; 2]], grid: &Grid) -> Option<u32> {
        let mut nearest: Option<(u32, [DVec2; 2])> = None;
        for square in grid.leftwards(point) {
            for &line in grid.lines(square) {
                let [a, b] = segments[line as usize];
                let upward = if a.y <= b.y { [a, b] } else { [b, a] };
                // Lines that end at the height of the ray count where they go up from it.
                let meets = upward[0].y <= point.y && point.y < upward[1].y;
                let is_left = meets && side(upward[0], upward[1], point) < 0.0;
                if is_left && nearest.is_none_or(|(_, other)| lies_right(upward, other)) {
                    nearest = Some((line, upward));
                }
            }
            if nearest.is_some_and(|(_, line)| is_passed(line, point, square, grid)) {
                break;
            }
        }
        let (line, upward) = nearest?;
        let runs_up = segments[line as usize][0] == upward[0];
        // Downwards, left and right are exchanged.
        Some(2 * line + u32::from(runs_up))
    }
}

/// Whether the line meets the ray to the right of this square, so that no line in squares farther left is nearer.
fn is_passed([low, high]: [DVec2; 2], point: DVec2, square: usize, grid: &Grid) -> bool {
    let share = (point.y - low.y) / (high.y - low.y);
    let x = low.x + (high.x - low.x) * share;
    grid.column(grid.square(DVec2::new(x, point.y))) > grid.column(square)
}

/// Whether `a` lies to the right of `b`; both go up, do not cross, and share a height.
fn lies_right(a: [DVec2; 2], b: [DVec2; 2]) -> bool {
    let signs = [
        (a[0].y >= b[0].y).then(|| -side(b[0], b[1], a[0])),
        (a[0].y < b[0].y).then(|| side(a[0], a[1], b[0])),
        (a[1].y <= b[1].y).then(|| -side(b[0], b[1], a[1])),
        (a[1].y > b[1].y).then(|| side(a[0], a[1], b[1])),
    ];
    let decided = signs.into_iter().flatten().find(|s| *s != 0.0);
    decided.is_some_and(|s| s > 0.0)
}

/// The order of directions from `at`, counter-clockwise, beginning just after straight down.
fn around(at: DVec2, g: DVec2, h: DVec2) -> Ordering {
    // The right half turns from just after straight down to straight up.
    let is_left = |p: DVec2| p.x < at.x || (p.x == at.x && p.y < at.y);
    is_left(g).cmp(&is_left(h)).then_with(|| {
        let turn = side(at, g, h);
        0.0.partial_cmp(&turn).unwrap_or(Ordering::Equal)
    })
}
