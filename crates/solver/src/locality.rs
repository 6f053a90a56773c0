//! An order of the nodes in which neighbours in the sheet are neighbours in memory.

use glam::DVec2;

/// Levels of the curve: its cells are 2⁻¹⁶ of the sheet across.
const LEVELS: u32 = 16;

/// The indices of `points` along Hilbert's curve through their bounding square; ties keep their order.
///
/// Any run of consecutive points is compact: its border is of the order of the root of its size (Hilbert 1891).
pub(crate) fn hilbert_order(points: &[DVec2]) -> Vec<u32> {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let side = (high - low).max_element();
    let scale = if side > 0.0 { f64::from((1u32 << LEVELS) - 1) / side } else { 0.0 };
    #[expect(clippy::cast_sign_loss, reason = "no point lies below the lowest")]
    let keys: Vec<u64> = points
        .iter()
        .map(|point| {
            let cell = (*point - low) * scale;
            hilbert_index(cell.x as u32, cell.y as u32)
        })
        .collect();
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_by_key(|&index| keys[index as usize]);
    order
}

/// The place of the cell (x, y) along the curve.
fn hilbert_index(mut x: u32, mut y: u32) -> u64 {
    let mut index = 0u64;
    for level in (0..LEVELS).rev() {
        let side = 1u32 << level;
        let (right, upper) = (x & side != 0, y & side != 0);
        let quarter = match (right, upper) {
            (false, false) => 0,
            (false, true) => 1,
            (true, true) => 2,
            (true, false) => 3,
        };
        index = index << 2 | quarter;
        // Each quarter holds the same curve, turned so that its ends meet those of its neighbours.
        if !upper {
            if right {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(side: u32) -> Vec<DVec2> {
        let point = |i: u32| DVec2::new(f64::from(i % side), f64::from(i / side));
        (0..side * side).map(point).collect()
    }

    #[test]
    fn every_point_comes_once() {
        let mut order = hilbert_order(&grid(20));
        order.sort_unstable();
        assert!(order.into_iter().eq(0..400));
    }

    #[test]
    fn the_curve_through_a_grid_steps_to_a_neighbour() {
        let points = grid(16);
        for pair in hilbert_order(&points).windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|i| points[i as usize]);
            assert_eq!(a.distance(b), 1.0, "{a} {b}");
        }
    }

    #[test]
    fn points_at_one_position_keep_their_order() {
        assert_eq!(hilbert_order(&[DVec2::ONE; 3]), [0, 1, 2]);
    }
}
