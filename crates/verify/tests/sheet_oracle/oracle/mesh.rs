//! Random triangulations of a part: the union is the same, the triangles are not.

use foldmotion_random::Random;
use std::collections::BTreeMap;

use super::{
    exact::{Point, minus},
    part::Part,
};

/// The weights of corners are integers with this sum.
pub(crate) const WHOLE: i64 = 4096;

/// A vertex as a weighted mean of corners.
pub(crate) type Weights = Vec<(usize, i64)>;

/// Triangles and the polygon that contains each; the outlines of the polygons with the vertices on their edges.
#[derive(Debug, Clone, Default)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<Weights>,
    pub(crate) triangles: Vec<[usize; 3]>,
    pub(crate) polygon_of: Vec<usize>,
    pub(crate) outlines: Vec<Vec<usize>>,
}

/// The weighted mean of vertices; the shares are in quarters or eighths.
fn mean(parts: &[(&Weights, i64)], whole: i64) -> Weights {
    let mut sum = BTreeMap::new();
    for (weights, share) in parts {
        for (corner, weight) in *weights {
            *sum.entry(*corner).or_insert(0) += weight * share;
        }
    }
    sum.into_iter().map(|(c, w)| (c, w / whole)).collect()
}

/// An edge with its smaller vertex first.
pub(crate) fn edge(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// The position of a vertex times [`WHOLE`], which is exact.
fn scaled(weights: &Weights, corners: &[Point]) -> Point {
    [0, 1, 2].map(|i| weights.iter().map(|&(c, w)| w * corners[c][i]).sum())
}

/// The position of a vertex, exact if the corners are multiples of [`WHOLE`].
pub(crate) fn place(weights: &Weights, corners: &[Point]) -> Point {
    scaled(weights, corners).map(|c| c / WHOLE)
}

impl Mesh {
    /// A triangulation without slivers, if some attempts produce one. The plainest has no additional vertices.
    pub(crate) fn random(part: &Part, random: &mut Random, allows_slivers: bool) -> Self {
        for attempt in 0..12 {
            let mesh = Self::attempt(part, random, attempt);
            if allows_slivers || mesh.least_height(&part.corners) > 1.0 / 40.0 {
                return mesh;
            }
        }
        Self::attempt(part, random, usize::MAX)
    }

    fn attempt(part: &Part, random: &mut Random, attempt: usize) -> Self {
        let mut mesh = Self {
            vertices: (0..part.corners.len()).map(|c| vec![(c, WHOLE)]).collect(),
            ..Self::default()
        };
        let is_plain = attempt > 8 || random.index(3) == 0;
        mesh.outlines.clone_from(&part.polygons);
        if !is_plain {
            mesh.cut_edges(random);
        }
        for polygon in 0..part.polygons.len() {
            let can_star = part.convex.contains(&part.polygons[polygon]);
            if can_star && !is_plain && random.index(3) == 0 {
                mesh.star(polygon, random);
            } else {
                mesh.clip_ears(polygon, &part.corners, random);
            }
        }
        if !is_plain && random.index(2) == 0 && mesh.triangles.len() < 30 {
            mesh.split_triangle(random);
        }
        for _ in 0..random.index(5) {
            mesh.flip(&part.corners, random);
        }
        mesh
    }

    fn cut_edges(&mut self, random: &mut Random) {
        let mut cuts: BTreeMap<[usize; 2], Option<usize>> = BTreeMap::new();
        for outline in &mut self.outlines {
            let mut longer = Vec::new();
            for (i, &a) in outline.iter().enumerate() {
                longer.push(a);
                let b = outline[(i + 1) % outline.len()];
                let vertices = &mut self.vertices;
                let cut = cuts.entry(edge(a, b)).or_insert_with(|| {
                    (random.index(4) == 0).then(|| {
                        let share = [2, 4, 4, 6][random.index(4)];
                        let ends = [(&vertices[a], share), (&vertices[b], 8 - share)];
                        vertices.push(mean(&ends, 8));
                        vertices.len() - 1
                    })
                });
                longer.extend(*cut);
            }
            *outline = longer;
        }
    }

    fn push(&mut self, triangle: [usize; 3], polygon: usize) {
        self.triangles.push(triangle);
        self.polygon_of.push(polygon);
    }

    /// Connects a vertex inside with all sides.
    fn star(&mut self, polygon: usize, random: &mut Random) {
        let outline = self.outlines[polygon].clone();
        let corners: Vec<usize> =
            outline.iter().copied().filter(|&v| self.vertices[v].len() == 1).collect();
        let at = |k: usize| &self.vertices[corners[k % corners.len()]];
        let first = random.index(corners.len());
        let centre = if corners.len() == 4 && random.index(2) == 0 {
            let all: Vec<_> = (0..4).map(|k| (at(k), 1)).collect();
            mean(&all, 4)
        } else {
            let step = corners.len().div_ceil(3);
            mean(&[(at(first), 2), (at(first + step), 1), (at(first + 2 * step), 1)], 4)
        };
        self.vertices.push(centre);
        let centre = self.vertices.len() - 1;
        for (i, &a) in outline.iter().enumerate() {
            self.push([a, outline[(i + 1) % outline.len()], centre], polygon);
        }
    }

    fn clip_ears(&mut self, polygon: usize, corners: &[Point], random: &mut Random) {
        let mut left = self.outlines[polygon].clone();
        let plane = Plane::of(&left, self, corners);
        while left.len() > 3 {
            let count = left.len();
            let first = random.index(count);
            let is_ear = |i: usize| {
                let [a, b, c] = [count - 1, 0, 1].map(|k| left[(i + k) % count]);
                let side = |p, q, r| plane.side(self, corners, [p, q, r]);
                let is_clear = |&v: &usize| {
                    [a, b, c].contains(&v)
                        || side(a, b, v) < 0
                        || side(b, c, v) < 0
                        || side(c, a, v) < 0
                };
                side(a, b, c) > 0 && left.iter().all(is_clear)
            };
            let ear = (first..first + count).map(|i| i % count).find(|&i| is_ear(i));
            let i = ear.expect("every polygon has an ear");
            let triangle = [count - 1, 0, 1].map(|k| left[(i + k) % count]);
            left.remove(i);
            self.push(triangle, polygon);
        }
        self.push([left[0], left[1], left[2]], polygon);
    }

    fn split_triangle(&mut self, random: &mut Random) {
        let index = random.index(self.triangles.len());
        let [a, b, c] = self.triangles[index];
        let shares = [(&self.vertices[a], 2), (&self.vertices[b], 1), (&self.vertices[c], 1)];
        self.vertices.push(mean(&shares, 4));
        let v = self.vertices.len() - 1;
        self.triangles[index] = [a, b, v];
        let polygon = self.polygon_of[index];
        self.push([b, c, v], polygon);
        self.push([c, a, v], polygon);
    }

    /// Flips an edge between two triangles of one polygon if the four corners are strictly convex.
    fn flip(&mut self, corners: &[Point], random: &mut Random) {
        let start = random.index(self.triangles.len());
        for f in (0..self.triangles.len()).map(|k| (start + k) % self.triangles.len()) {
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|j| self.triangles[f][(k + j) % 3]);
                let beyond = |g: &usize| {
                    let t = self.triangles[*g];
                    *g != f
                        && self.polygon_of[*g] == self.polygon_of[f]
                        && (0..3).any(|j| t[j] == b && t[(j + 1) % 3] == a)
                };
                let Some(g) = (0..self.triangles.len()).find(beyond) else {
                    continue;
                };
                let apex = self.triangles[g].into_iter().find(|v| *v != a && *v != b);
                let Some(d) = apex else { continue };
                let plane = Plane::of(&[a, b, c], self, corners);
                let turns = [[a, d, c], [d, b, c]];
                if turns.iter().all(|&t| plane.side(self, corners, t) > 0) {
                    [self.triangles[f], self.triangles[g]] = turns;
                    return;
                }
            }
        }
    }

    fn least_height(&self, corners: &[Point]) -> f64 {
        let heights = self.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|v| super::distance::to_f64(place(&self.vertices[v], corners)));
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            (b - a).cross(c - a).length() / longest
        });
        heights.fold(f64::INFINITY, f64::min)
    }

    /// Every edge with the triangles beside it.
    pub(crate) fn edges(&self) -> BTreeMap<[usize; 2], Vec<usize>> {
        let mut edges: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (index, t) in self.triangles.iter().enumerate() {
            for k in 0..3 {
                edges.entry(edge(t[k], t[(k + 1) % 3])).or_default().push(index);
            }
        }
        edges
    }
}

/// The coordinate plane onto which a polygon is projected, and its orientation there.
struct Plane {
    axes: [usize; 2],
    is_turned: bool,
}

impl Plane {
    fn of(outline: &[usize], mesh: &Mesh, corners: &[Point]) -> Self {
        let at: Vec<Point> = outline.iter().map(|&v| scaled(&mesh.vertices[v], corners)).collect();
        let area = |[x, y]: [usize; 2]| {
            let term = |i: usize| {
                let [a, b] = [at[i], at[(i + 1) % at.len()]].map(|p| minus(p, at[0]));
                i128::from(a[x]) * i128::from(b[y]) - i128::from(a[y]) * i128::from(b[x])
            };
            (0..at.len()).map(term).sum::<i128>()
        };
        let planes = [[0, 1], [1, 2], [2, 0]];
        let axes = planes.into_iter().max_by_key(|&axes| area(axes).abs()).unwrap_or([0, 1]);
        Self { axes, is_turned: area(axes) < 0 }
    }

    /// Twice the area of a triangle, positive if it has the orientation of the polygon.
    fn side(&self, mesh: &Mesh, corners: &[Point], triangle: [usize; 3]) -> i128 {
        let [a, b, c] = triangle.map(|v| scaled(&mesh.vertices[v], corners));
        let [u, v] = [minus(b, a), minus(c, a)].map(|d| self.axes.map(|i| i128::from(d[i])));
        let area = u[0] * v[1] - u[1] * v[0];
        if self.is_turned { -area } else { area }
    }
}
