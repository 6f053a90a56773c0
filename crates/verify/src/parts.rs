//! Simplices without a common vertex: the parts of two triangles that share one or two vertices.

use crate::moving_pair::MovingPair;

/// The largest parts of two triangles that share no vertex, as triangles with repeated corners.
pub(crate) fn disjoint_parts(moving: &MovingPair) -> Vec<MovingPair> {
    let corners: &[[[usize; 3]; 2]] = match moving.shared {
        0 => return vec![*moving],
        1 => &[[[1, 2, 2], [0, 1, 2]], [[0, 1, 2], [1, 2, 2]]],
        _ => &[
            [[2, 2, 2], [0, 1, 2]],
            [[0, 1, 2], [2, 2, 2]],
            [[0, 2, 2], [1, 2, 2]],
            [[1, 2, 2], [0, 2, 2]],
        ],
    };
    let part = |&[a, b]: &[[usize; 3]; 2]| MovingPair {
        a: a.map(|i| moving.a[i]),
        b: b.map(|j| moving.b[j]),
        shared: 0,
        is_part: true,
        ..*moving
    };
    corners.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn the_parts_of_neighbours_have_no_corner_in_common() {
        let corner = |k: u32| [DVec3::new(f64::from(k), f64::from(k * k), 0.0); 2];
        for shared in 1..3 {
            let a = [0, 1, 2].map(corner);
            let b = [0, 1, 2].map(|k| if k < shared { corner(k) } else { corner(k + 3) });
            let start = [a.map(|p| p[0]), b.map(|p| p[0])];
            let moving = MovingPair::new(start, start, shared as usize);
            let parts = disjoint_parts(&moving);
            assert_eq!(parts.len(), 2 * shared as usize);
            for part in parts {
                assert!(part.a.iter().all(|p| !part.b.contains(p)), "{part:?}");
            }
        }
    }
}
