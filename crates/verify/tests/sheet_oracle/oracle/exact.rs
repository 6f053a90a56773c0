//! Convex polygons in integers, and whether two of them meet while one moves straight.
//!
//! Coordinates are multiples of 2⁻²⁶. Coordinates below 8 are integers below 2²⁹, separating axes are below 2⁹², and
//! their products with points below 2¹²⁴: everything stays exact in `i128`.

/// The length 1, as an integer.
pub(crate) const UNIT: i64 = 1 << 26;
/// The largest coordinate for which nothing overflows.
const LARGEST: i64 = 1 << 29;

/// A point or vector in multiples of 2⁻²⁶.
pub(crate) type Point = [i64; 3];

type Wide = [i128; 3];

pub(crate) fn plus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] + b[i])
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn wide(a: Point) -> Wide {
    a.map(i128::from)
}

fn cross(a: Wide, b: Wide) -> Wide {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}

fn dot(a: Wide, b: Wide) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn is_zero(a: Wide) -> bool {
    a == [0; 3]
}

/// A convex polygon with at least three corners that are not all on a line.
#[derive(Debug, Clone)]
pub(crate) struct Convex {
    pub(crate) corners: Vec<Point>,
    normal: Wide,
    edges: Vec<Wide>,
}

impl Convex {
    pub(crate) fn new(corners: Vec<Point>) -> Self {
        let is_small = |p: &Point| p.iter().all(|c| c.abs() < LARGEST);
        assert!(corners.iter().all(is_small), "{corners:?}");
        let count = corners.len();
        let edges: Vec<Wide> =
            (0..count).map(|i| wide(minus(corners[(i + 1) % count], corners[i]))).collect();
        let normal = cross(edges[0], edges[1]);
        assert!(!is_zero(normal), "{corners:?}");
        Self { corners, normal, edges }
    }

    /// Whether all corners lie in one plane.
    pub(crate) fn is_plane(&self) -> bool {
        let [low, high] = self.range(self.normal);
        low == high
    }

    fn range(&self, axis: Wide) -> [i128; 2] {
        let heights = self.corners.iter().map(|&p| dot(axis, wide(p)));
        heights.fold([i128::MAX, i128::MIN], |[low, high], h| [low.min(h), high.max(h)])
    }

    /// Whether this polygon meets `other`, displaced from `from` straight to `to`, at any time in between.
    ///
    /// They do not meet exactly if a facet normal of the convex set { p − q − s } separates 0 from it strictly: the
    /// normal of a polygon, a product of two edges, of an edge and the path, or, if everything lies in one plane, a
    /// normal within it.
    pub(crate) fn meets(&self, other: &Self, from: Point, to: Point) -> bool {
        let path = wide(minus(to, from));
        let separates = |axis: Wide| {
            let ([a0, a1], [b0, b1]) = (self.range(axis), other.range(axis));
            let (s, t) = (dot(axis, wide(from)), dot(axis, wide(to)));
            a1 < b0 + s.min(t) || a0 > b1 + s.max(t)
        };
        if separates(self.normal) || separates(other.normal) {
            return false;
        }
        let along_path = |edge: &Wide| separates(cross(*edge, path));
        if self.edges.iter().chain(&other.edges).any(along_path) {
            return false;
        }
        let across = |e: &Wide| other.edges.iter().any(|f| separates(cross(*e, *f)));
        if self.edges.iter().any(across) {
            return false;
        }
        let is_flat = is_zero(cross(self.normal, other.normal)) && dot(self.normal, path) == 0;
        if !is_flat {
            return true;
        }
        let all = self.edges.iter().chain(&other.edges).chain([&path]);
        !all.into_iter().any(|e| separates(cross(self.normal, *e)))
    }
}
