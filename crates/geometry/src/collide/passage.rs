//! The times and directions in which a moving vertex passes through a moving facet, or an edge through an edge.
//!
//! These are the signed intersection numbers of a path with a surface: over a time interval, their sum does not change
//! however the paths are deformed, as long as the vertex stays away from the rim of the facet (or the edges from each
//! other's ends). See `moving_patch` for how a passage is isolated and for the rounding of every sign.

use glam::DVec3;
use robust::{Coord3D, orient3d};

use super::{double_word::DoubleWord, moving_patch::MovingPatch, patch::Patch};

/// A passage through a feature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// The ends of the time interval within [0, 1] that contains it: 2⁻⁴⁰ long, up to 2⁻²⁴ for edges that are nearly
    /// parallel.
    pub times: [f64; 2],
    /// The direction of the passage, 1 or −1 (see [`vertex_passages`] and [`edge_passages`]).
    pub sign: i8,
}

impl Passage {
    /// The middle of the time interval that contains it.
    pub fn time(&self) -> f64 {
        f64::midpoint(self.times[0], self.times[1])
    }
}

/// Every passage of a vertex through a facet over t in [0, 1], in order of time.
///
/// `vertex`, `facet`: each point at t = 0 and at t = 1, moving straight. The sign is 1 if the vertex passes from the
/// back of the facet to its front (the corners are counter-clockwise seen from the front). `None` if a passage cannot
/// be told from its absence: the vertex touches the facet or its rim to within rounding, or lies in its plane at an
/// end.
pub fn vertex_passages(vertex: [DVec3; 2], facet: [[DVec3; 2]; 3]) -> Option<Vec<Passage>> {
    let points = [0, 1].map(|end: usize| facet.map(|corner| [corner[end], vertex[end]]));
    let volume = |end: usize| {
        let [p, q, r] = facet.map(|corner| corner[end]);
        move || sign_of_volume([p, q, r, vertex[end]])
    };
    // The volume det(p − v, q − v, r − v) is positive if the vertex is behind.
    signed(points, [volume(0), volume(1)], -1)
}

/// Every passage of two edges through each other over t in [0, 1], in order of time.
///
/// `a`, `b`: the ends of the edges, each at t = 0 and at t = 1, moving straight. The sign is that of det(a_1 − a_0, b_1
/// − b_0, b_0 − a_0) afterwards: it is the same for (b, a), and changes if one edge is reversed. `None` in the same
/// cases as for [`vertex_passages`].
pub fn edge_passages(a: [[DVec3; 2]; 2], b: [[DVec3; 2]; 2]) -> Option<Vec<Passage>> {
    let around = [(0, 0), (1, 0), (1, 1), (0, 1)];
    let points = [0, 1].map(|end: usize| around.map(|(i, j)| [a[i][end], b[j][end]]));
    let volume = |end: usize| move || sign_of_volume([a[0], a[1], b[0], b[1]].map(|p| p[end]));
    signed(points, [volume(0), volume(1)], 1)
}

/// The exact sign of det(a − d, b − d, c − d); 0 if the four points lie in one plane.
pub fn sign_of_volume(points: [DVec3; 4]) -> i8 {
    let [a, b, c, d] = points.map(|p| Coord3D { x: p.x, y: p.y, z: p.z });
    let value = orient3d(a, b, c, d);
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

/// `points`: for each end, the corners of the patch of differences, each as the two points whose difference it is;
/// `signs`: the exact signs of the volume at both ends, computed only if needed.
fn signed<const N: usize>(
    points: [[[DVec3; 2]; N]; 2],
    signs: [impl Fn() -> i8; 2],
    orientation: i8,
) -> Option<Vec<Passage>> {
    let [start, end] = points.map(|at| at.map(|[p, q]| p - q));
    if Patch::new(start, end, 0.0)?.stays_clear(0.0, 1.0) {
        return Some(Vec::new());
    }
    let signs = signs.map(|sign| sign());
    if signs.contains(&0) {
        return None;
    }
    let passages = MovingPatch::<f64, N>::new(points).passages(signs);
    let passages =
        passages.or_else(|| MovingPatch::<DoubleWord, N>::new(points).passages(signs))?;
    let passing = |(times, sign): ([f64; 2], i8)| Passage { times, sign: sign * orientation };
    Some(passages.into_iter().map(passing).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    const PLATE: [DVec3; 3] = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 4.0, 0.0)];

    fn still<const N: usize>(points: [DVec3; N]) -> [[DVec3; 2]; N] {
        points.map(|p| [p, p])
    }

    #[test]
    fn a_vertex_passes_from_back_to_front_with_sign_one_and_back_with_minus_one() {
        let path = [DVec3::new(1.0, 1.0, -1.0), DVec3::new(1.0, 1.0, 3.0)];
        let up = vertex_passages(path, still(PLATE)).unwrap();
        assert_eq!(up.len(), 1);
        assert!(up[0].sign == 1 && (up[0].time() - 0.25).abs() < 1e-9, "{up:?}");
        let down = vertex_passages([path[1], path[0]], still(PLATE)).unwrap();
        assert!(down[0].sign == -1 && (down[0].time() - 0.75).abs() < 1e-9);
        let beside = path.map(|p| p + DVec3::X * 3.0);
        assert!(vertex_passages(beside, still(PLATE)).unwrap().is_empty());
        let on_the_rim = path.map(|p| DVec3::new(0.0, 1.0, p.z));
        assert_eq!(vertex_passages(on_the_rim, still(PLATE)), None);
    }

    #[test]
    fn edges_pass_with_the_same_sign_whichever_comes_first_and_the_other_sign_reversed() {
        let a = still([DVec3::NEG_X, DVec3::X]);
        let b = [DVec3::NEG_Y, DVec3::Y].map(|p| [p - DVec3::Z, p + DVec3::Z * 2.0]);
        let sign = |a, b| edge_passages(a, b).unwrap()[0].sign;
        assert_eq!(sign(a, b), sign(b, a));
        assert_eq!(sign(a, b), -sign([a[1], a[0]], b));
        let longer = edge_passages(a, b.map(|[p, q]| [p + DVec3::X * 2.0, q + DVec3::X * 2.0]));
        assert_eq!(longer.unwrap(), []);
    }

    /// Edges in layers of a stack, moved by some 1e-10 out of one plane: their volume never exceeds 1e-21.
    #[test]
    fn nearly_parallel_edges_pass_though_rounding_leaves_open_when_exactly() {
        let turned = |t: f64| {
            let turn = |x: f64, y: f64, height: f64| {
                let (sin, cos) = t.sin_cos();
                let (x, y) = (0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y);
                DVec3::new(cos * x - sin * height, y, sin * x + cos * height)
            };
            let a = [turn(-0.5, 0.25, 0.0), turn(0.5, 0.25, 0.0)];
            let b = [
                turn(-0.5, 0.25 + 1e-10, 1e-10 * (t - 0.6)),
                turn(0.5, 0.25 - 1e-10, 2e-10 * (t - 0.6)),
            ];
            [a, b]
        };
        let [[a0, b0], [a1, b1]] = [turned(0.5), turned(0.7)];
        let path = |p: [DVec3; 2], q: [DVec3; 2]| [[p[0], q[0]], [p[1], q[1]]];
        let passed = edge_passages(path(a0, a1), path(b0, b1)).unwrap();
        assert_eq!(passed.len(), 1);
        let [from, to] = passed[0].times;
        assert!((passed[0].time() - 0.5).abs() < 0.01, "{passed:?}");
        assert!(to - from > 1e-12 && to - from < 6e-8, "{passed:?}");
    }

    /// The signed number of passages of a closed loop of motions is the number of times it winds around what it avoids.
    #[test]
    fn passages_over_a_closed_box_sum_to_zero() {
        // The degree of (v(t) − q(t)) over the boundary of facet × time: the bottom, the top and the three sides; the
        // vertex must enter the prism as often as it leaves it. Here: motions out and back along another path that
        // avoids the rim have the same sum.
        let mut random = Random::new(71);
        let mut passed = 0;
        for _ in 0..2000 {
            let [p, q] = [random.vector(), random.vector()];
            let facet = [(); 3].map(|()| random.vector());
            let direct: i32 = sum(&[p, q], facet);
            let detour = p.midpoint(q) + random.vector() * 0.05;
            let bent = sum(&[p, detour, q], facet);
            // The triangle p, detour, q meets the rim an even or odd number of times; they are counted exactly.
            let rim: i32 =
                (0..3).map(|k| pierced([p, detour, q], [facet[k], facet[(k + 1) % 3]])).sum();
            assert_eq!(bent - direct, rim, "{p} {q} {facet:?} {detour}");
            passed += i32::from(direct != 0);
        }
        assert!(passed > 50, "{passed}");
    }

    fn sum(path: &[DVec3], facet: [DVec3; 3]) -> i32 {
        let steps = path.windows(2);
        let passages = steps.flat_map(|w| vertex_passages([w[0], w[1]], still(facet)).unwrap());
        passages.map(|p| i32::from(p.sign)).sum()
    }

    /// The signed number of times an edge passes through the triangle p, m, q, as the linking number of path and rim.
    fn pierced([p, m, q]: [DVec3; 3], [c, d]: [DVec3; 2]) -> i32 {
        let above = sign_of_volume([p, m, q, c]);
        let below = sign_of_volume([p, m, q, d]);
        if above == below {
            return 0;
        }
        let inside = [
            sign_of_volume([c, d, p, m]),
            sign_of_volume([c, d, m, q]),
            sign_of_volume([c, d, q, p]),
        ];
        if inside[0] == inside[1] && inside[1] == inside[2] { i32::from(above) } else { 0 }
    }
}
