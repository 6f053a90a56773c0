//! Vertices that are all farther than a tolerance from each other.

use std::collections::HashMap;

use glam::DVec2;

/// Points that represent every point within the tolerance of them: the first one given represents those after it, so
/// that no point moves farther than the tolerance.
#[derive(Debug)]
pub(super) struct Vertices {
    pub(super) points: Vec<DVec2>,
    tolerance: f64,
    /// The points in each square with the tolerance as side.
    squares: HashMap<[i64; 2], Vec<u32>>,
}

impl Vertices {
    pub(super) fn new(tolerance: f64) -> Self {
        Self { points: Vec::new(), tolerance, squares: HashMap::new() }
    }

    fn square(&self, point: DVec2) -> [i64; 2] {
        (point / self.tolerance).floor().to_array().map(|c| c as i64)
    }

    /// The nearest vertex within the tolerance, the first of those equally near.
    fn near(&self, point: DVec2) -> Option<u32> {
        let [x, y] = self.square(point);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        let held = around.filter_map(|square| self.squares.get(&square)).flatten();
        let distance = |&v: &u32| (self.points[v as usize].distance(point), v);
        held.map(distance)
            .filter(|(distance, _)| *distance <= self.tolerance)
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, v)| v)
    }

    /// The vertex that represents `point`: one within the tolerance, otherwise a new one.
    pub(super) fn add(&mut self, point: DVec2) -> u32 {
        self.near(point).unwrap_or_else(|| {
            let vertex = self.points.len() as u32;
            self.points.push(point);
            self.squares.entry(self.square(point)).or_default().push(vertex);
            vertex
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_near_points_represents_all_and_chains_do_not_drift() {
        let mut vertices = Vertices::new(1.0);
        let added: Vec<u32> =
            [0.0, 0.9, 1.8, 2.7, -0.9].map(|x| vertices.add(DVec2::new(x, -x))).to_vec();
        // The distance between neighbours is 0.9·√2 > 1.
        assert_eq!(added, [0, 1, 2, 3, 4]);
        let added: Vec<u32> = [0.5, 0.7, 1.3].map(|x| vertices.add(DVec2::new(x, -x))).to_vec();
        assert_eq!(added, [1, 1, 1]);
        assert_eq!(vertices.points.len(), 5);
    }

    #[test]
    fn nearness_is_found_across_squares() {
        let mut vertices = Vertices::new(1e-3);
        for (a, b) in [(0.999_9e-3, 1.000_1e-3), (-1e-9, 1e-9)] {
            let first = vertices.add(DVec2::new(a, 5.0 + a));
            assert_eq!(vertices.add(DVec2::new(b, 5.0 + b)), first);
        }
    }
}
