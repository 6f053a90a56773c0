//! Simplices without a common vertex: the parts of two triangles that share one or two, and whether an edge pierces a
//! triangle for sure.

use glam::DVec3;

use super::closest::closest;
use super::span::{Pose, Span};

/// The largest parts of two triangles that share no vertex, as triangles with corners repeated.
pub(super) fn disjoint_parts(span: &Span) -> Vec<Span> {
    let corners: &[[[usize; 3]; 2]] = match span.shared {
        0 => return vec![*span],
        1 => &[[[1, 2, 2], [0, 1, 2]], [[0, 1, 2], [1, 2, 2]]],
        _ => &[
            [[2, 2, 2], [0, 1, 2]],
            [[0, 1, 2], [2, 2, 2]],
            [[0, 2, 2], [1, 2, 2]],
            [[1, 2, 2], [0, 2, 2]],
        ],
    };
    let part = |&[a, b]: &[[usize; 3]; 2]| Span {
        a: a.map(|i| span.a[i]),
        b: b.map(|j| span.b[j]),
        shared: 0,
        is_part: true,
        ..*span
    };
    corners.iter().map(part).collect()
}

/// Whether an edge goes through a triangle such that no push by τ undoes it: its ends are farther than that from the
/// triangle, and it is so from the triangle's rim (the degree of the difference on the rim is then ±1).
pub(super) fn is_pierced([p, q]: [DVec3; 2], t: &[DVec3; 3], tolerance: f64) -> bool {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
    let (above, below) = (normal.dot(p - t[0]), normal.dot(q - t[0]));
    if above * below >= 0.0 || above.abs().min(below.abs()) <= tolerance {
        return false;
    }
    let point = p + (q - p) * (above / (above - below));
    let is_inside = (0..3).all(|i| {
        let (u, v) = (t[i], t[(i + 1) % 3]);
        (v - u).cross(point - u).dot(normal) > 0.0
    });
    is_inside
        && (0..3).all(|i| {
            let (u, v) = (t[i], t[(i + 1) % 3]);
            let rim = Pose {
                a: [p, q, q],
                b: [u, v, v],
            };
            closest(&rim).distance() > tolerance
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_pierces_a_triangle_for_sure_only_where_it_stands_off_its_rim_and_beyond_it() {
        let t = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let pierces = |x: f64, beyond: f64| {
            let at = |z: f64| DVec3::new(x, 0.25, z);
            is_pierced([at(1.0), at(-beyond)], &t, 0.1)
        };
        assert!(pierces(0.25, 1.0));
        assert!(!pierces(0.25, 0.05));
        assert!(!pierces(0.05, 1.0));
        assert!(!pierces(-0.5, 1.0));
    }

    #[test]
    fn the_parts_of_neighbours_have_no_corner_in_common() {
        let corner = |k: u32| [DVec3::new(f64::from(k), f64::from(k * k), 0.0); 2];
        for shared in 1..3 {
            let a = [0, 1, 2].map(corner);
            let b = [0, 1, 2].map(|k| if k < shared { corner(k) } else { corner(k + 3) });
            let start = [a.map(|p| p[0]), b.map(|p| p[0])];
            let span = Span::new(start, start, shared as usize);
            let parts = disjoint_parts(&span);
            assert_eq!(parts.len(), 2 * shared as usize);
            for part in parts {
                assert!(part.a.iter().all(|p| !part.b.contains(p)), "{part:?}");
            }
        }
    }
}
