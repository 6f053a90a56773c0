//! Whether an edge passes through a part of the sheet such that no push by τ undoes it.
//!
//! Let S be some triangles of the sheet that can be oriented alike, and e an edge that has no vertex in common with
//! them. The number of times that e passes through S, counted with signs, is the degree of the difference of their
//! points on the boundary of S × e. Pushes by τ do not change it while the ends of e are farther than τ from S, and e
//! is farther than τ from the rim of S. If it is not 0, e intersects S whatever the push.

use glam::DVec3;

use crate::closest::{closest, on_triangle};
use crate::moving_pair::PairPose;

/// The offsets of an edge, in units of τ: none, and both senses of some directions.
const OFFSETS: [DVec3; 5] = [
    DVec3::ZERO,
    DVec3::new(3.1e-3, -2.3e-3, 1.7e-3),
    DVec3::new(-3.1e-3, 2.3e-3, -1.7e-3),
    DVec3::new(1.3e-3, 1.9e-3, 2.9e-3),
    DVec3::new(-1.3e-3, -1.9e-3, -2.9e-3),
];
/// A bound of the lengths of the offsets, in units of τ.
const LONGEST_OFFSET: f64 = 5e-3;
/// A bound of the rounding error of a product of three lengths, in units of ε and the cube of the largest.
const ROUNDINGS: f64 = 256.0;

/// Triangles of the sheet, oriented alike, and the edges that belong to only one of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Surface {
    triangles: Vec<[u32; 3]>,
    rim: Vec<[u32; 2]>,
}

impl Surface {
    /// `None` if the triangles are not connected across edges or cannot be oriented alike.
    pub(crate) fn of(triangles: &[[u32; 3]]) -> Option<Self> {
        let (first, others) = triangles.split_first()?;
        let mut left = others.to_vec();
        let mut oriented = vec![*first];
        let mut sides = sides(first).to_vec();
        while !left.is_empty() {
            let fits = |t: &[u32; 3]| self::sides(t).iter().any(|&[p, q]| sides.contains(&[q, p]));
            let both = left.iter().enumerate();
            let mut turned = both.flat_map(|(k, &[p, q, r])| [(k, [p, q, r]), (k, [p, r, q])]);
            let (k, next) = turned.find(|(_, t)| fits(t))?;
            left.swap_remove(k);
            oriented.push(next);
            sides.extend(self::sides(&next));
        }
        let once = |side: &[u32; 2]| sides.iter().filter(|other| *other == side).count() == 1;
        let is_oriented = sides.iter().all(once);
        let rim = sides.iter().filter(|&&[p, q]| !sides.contains(&[q, p]));
        is_oriented.then(|| Self { rim: rim.copied().collect(), triangles: oriented })
    }

    /// Whether an edge passes through the surface for every offset, possibly by less than τ.
    pub(crate) fn is_met(
        &self,
        edge: [u32; 2],
        position: &dyn Fn(u32) -> DVec3,
        tolerance: f64,
    ) -> bool {
        self.placed(edge, position).is_some_and(|(ends, triangles)| {
            let mut times = times_through(ends, &triangles, tolerance).skip(1);
            times.all(|times| times.is_some_and(|times| times != 0))
        })
    }

    /// The ends of an edge and the triangles, in space; `None` if they have a vertex in common.
    fn placed(
        &self,
        edge: [u32; 2],
        position: &dyn Fn(u32) -> DVec3,
    ) -> Option<([DVec3; 2], Vec<[DVec3; 3]>)> {
        let mut corners = self.triangles.iter().flatten();
        let is_apart = !corners.any(|v| edge.contains(v));
        let triangles = || self.triangles.iter().map(|t| t.map(position)).collect();
        is_apart.then(|| (edge.map(position), triangles()))
    }

    /// Whether an edge surely passes through the surface. `position`: the position of a vertex.
    pub(crate) fn is_pierced(
        &self,
        edge: [u32; 2],
        position: &dyn Fn(u32) -> DVec3,
        tolerance: f64,
    ) -> bool {
        let Some((ends, triangles)) = self.placed(edge, position) else {
            return false;
        };
        let reach = (1.0 + LONGEST_OFFSET) * tolerance;
        let mut times = times_through(ends, &triangles, tolerance);
        times.find_map(|times| times).is_some_and(|times| times != 0)
            && ends.iter().all(|&end| {
                let off = |t: &[DVec3; 3]| on_triangle(end, t).distance(end);
                triangles.iter().all(|t| off(t) > reach)
            })
            && self.rim.iter().all(|side| {
                let [[p, q], [u, v]] = [ends, side.map(position)];
                let both = PairPose { a: [p, q, q], b: [u, v, v] };
                closest(&both).distance() > reach
            })
    }
}

/// Whether a segment may surely pass through a surface that contains this triangle.
pub(crate) fn may_pierce(ends: [DVec3; 2], triangle: &[DVec3; 3], tolerance: f64) -> bool {
    let is_off = |end: DVec3| on_triangle(end, triangle).distance(end) > tolerance;
    let triangles = std::slice::from_ref(triangle);
    let mut times = times_through(ends, triangles, tolerance);
    times.any(|times| times.is_some_and(|times| times != 0)) && ends.into_iter().all(is_off)
}

fn sides([p, q, r]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[*p, *q], [*q, *r], [*r, *p]]
}

/// How often a segment passes through the triangles, with signs, for each of the offsets; `None` if rounding hides it.
fn times_through(
    ends: [DVec3; 2],
    triangles: &[[DVec3; 3]],
    tolerance: f64,
) -> impl Iterator<Item = Option<i32>> {
    OFFSETS.iter().map(move |&offset| {
        let moved = ends.map(|end| end + offset * tolerance);
        triangles.iter().map(|t| through(moved, t)).sum()
    })
}

/// 1 or −1 if a segment passes through a triangle from its back to its front or the other way, 0 if it does not; `None`
/// if rounding hides it.
fn through([p, q]: [DVec3; 2], t: &[DVec3; 3]) -> Option<i32> {
    let all = [p, q, t[0], t[1], t[2]];
    let size = all.iter().map(|v| v.distance(p)).fold(0.0, f64::max);
    let margin = ROUNDINGS * f64::EPSILON * size * size * size;
    let sign = |[u, v, w, x]: [DVec3; 4]| {
        let product = (v - u).cross(w - u).dot(x - u);
        (product.abs() > margin).then_some(product > 0.0)
    };
    let [u, v, w] = *t;
    let (above, below) = (sign([u, v, w, q])?, sign([u, v, w, p])?);
    if above == below {
        return Some(0);
    }
    let turns = [sign([p, q, u, v])?, sign([p, q, v, w])?, sign([p, q, w, u])?];
    let is_inside = turns.iter().all(|&turn| turn == turns[0]);
    let direction = if above { 1 } else { -1 };
    Some(if is_inside { direction } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four triangles around vertex 4, a roof with a ridge along x; the edge from 5 to 6 goes down at (x, y).
    fn is_pierced(faces: &[[u32; 3]], x: f64, y: f64, beyond: f64) -> bool {
        let position = |v: u32| match v {
            0 => DVec3::new(-1.0, 0.0, 0.0),
            1 => DVec3::new(0.0, -1.0, -0.5),
            2 => DVec3::new(1.0, 0.0, 0.0),
            3 => DVec3::new(0.0, 1.0, -0.5),
            4 => DVec3::ZERO,
            5 => DVec3::new(x, y, 1.0),
            _ => DVec3::new(x, y, -beyond),
        };
        let surface = Surface::of(faces).unwrap();
        surface.is_pierced([5, 6], &position, 0.1)
    }

    const AROUND: [[u32; 3]; 4] = [[4, 0, 1], [2, 4, 1], [4, 2, 3], [4, 0, 3]];

    #[test]
    fn an_edge_surely_pierces_a_triangle_only_away_from_its_rim_and_beyond_it() {
        let one = &AROUND[2..3];
        assert!(is_pierced(one, 0.3, 0.3, 1.0));
        assert!(!is_pierced(one, 0.3, 0.3, 0.2));
        assert!(!is_pierced(one, 0.3, 0.3, 0.1));
        assert!(!is_pierced(one, 0.3, 0.05, 1.0));
        assert!(!is_pierced(one, -0.3, 0.3, 1.0));
    }

    #[test]
    fn an_edge_in_a_crease_pierces_the_two_triangles_there_and_one_in_a_vertex_all_around_it() {
        assert!(is_pierced(&AROUND[1..3], 0.4, 0.0, 1.0));
        assert!(!is_pierced(&AROUND[1..3], 0.0, 0.0, 1.0));
        assert!(is_pierced(&AROUND, 0.0, 0.0, 1.0));
        assert!(!is_pierced(&AROUND, 0.0, 0.0, 0.05));
        assert!(!is_pierced(&AROUND, 0.45, 0.45, 1.0));
    }

    #[test]
    fn an_edge_that_goes_down_one_wall_of_a_fold_and_up_through_the_other_pierces_neither_for_sure()
    {
        // Across the ridge and below it: in through one side and out through the other.
        let position = |v: u32| match v {
            0 => DVec3::new(-1.0, 0.0, 0.0),
            1 => DVec3::new(1.0, 0.0, 0.0),
            2 => DVec3::new(0.0, -1.0, -2.0),
            3 => DVec3::new(0.0, 1.0, -2.0),
            4 => DVec3::new(0.0, -2.0, -0.5),
            _ => DVec3::new(0.0, 2.0, -0.5),
        };
        let surface = Surface::of(&[[0, 1, 2], [0, 1, 3]]).unwrap();
        assert!(!surface.is_pierced([4, 5], &position, 0.1));
        let one = Surface::of(&[[0, 1, 2]]).unwrap();
        assert!(one.is_pierced([4, 5], &position, 0.1));
    }

    #[test]
    fn what_cannot_be_oriented_alike_is_no_surface() {
        // Three triangles at one edge, and a band with a half twist.
        assert_eq!(Surface::of(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), None);
        let moebius = [[0, 1, 2], [1, 2, 3], [2, 3, 4], [3, 4, 0], [4, 0, 1]];
        assert_eq!(Surface::of(&moebius), None);
        assert_eq!(Surface::of(&[[0, 1, 2], [3, 4, 5]]), None);
    }
}
