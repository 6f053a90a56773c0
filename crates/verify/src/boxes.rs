//! Every pair of swept boxes, tested one by one.

use glam::DVec3;
use rayon::prelude::*;

/// The number of boxes tested before the results are examined.
const BLOCK: usize = 64;

/// Boxes stored coordinate by coordinate, rounded outward to f32.
#[derive(Debug, Default)]
pub(crate) struct Boxes {
    low: [Vec<f32>; 3],
    high: [Vec<f32>; 3],
}

impl Boxes {
    /// Adds the box around some points, enlarged by `radius` on every side.
    pub(crate) fn push(&mut self, points: impl Iterator<Item = DVec3>, radius: f64) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for p in points {
            low = low.min(p);
            high = high.max(p);
        }
        for k in 0..3 {
            self.low[k].push(((low[k] - radius) as f32).next_down());
            self.high[k].push(((high[k] + radius) as f32).next_up());
        }
    }

    /// All pairs i < j whose boxes overlap, in increasing order.
    pub(crate) fn overlapping(&self) -> Vec<[u32; 2]> {
        let count = self.low[0].len();
        let rows: Vec<Vec<u32>> = (0..count).into_par_iter().map(|i| self.row(i)).collect();
        let pairs = rows.iter().enumerate();
        pairs.flat_map(|(i, row)| row.iter().map(move |&j| [i as u32, j])).collect()
    }

    fn row(&self, i: usize) -> Vec<u32> {
        let mut found = Vec::new();
        let ([x0, y0, z0], [x1, y1, z1]) = (&self.low, &self.high);
        let overlaps = |j: usize| {
            (x0[j] <= x1[i])
                && (x1[j] >= x0[i])
                && (y0[j] <= y1[i])
                && (y1[j] >= y0[i])
                && (z0[j] <= z1[i])
                && (z1[j] >= z0[i])
        };
        let mut from = i + 1;
        while from < x0.len() {
            let to = (from + BLOCK).min(x0.len());
            if self.any(i, from, to) {
                found.extend((from..to).filter(|&j| overlaps(j)).map(|j| j as u32));
            }
            from = to;
        }
        found
    }

    /// Whether box i overlaps any of the boxes `from` to `to`. The loop has no branch, so that it is vectorised.
    #[expect(clippy::needless_bitwise_bool, reason = "lazy operators would be branches")]
    fn any(&self, i: usize, from: usize, to: usize) -> bool {
        let low = [0, 1, 2].map(|k| &self.low[k][from..to]);
        let high = [0, 1, 2].map(|k| &self.high[k][from..to]);
        let (below, above) =
            (self.low.each_ref().map(|c| c[i]), self.high.each_ref().map(|c| c[i]));
        let mut any = 0;
        for j in 0..to - from {
            let hit = (low[0][j] <= above[0])
                & (high[0][j] >= below[0])
                & (low[1][j] <= above[1])
                & (high[1][j] >= below[1])
                & (low[2][j] <= above[2])
                & (high[2][j] >= below[2]);
            any |= u32::from(hit);
        }
        any != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    #[test]
    fn no_overlapping_pair_is_left_out_and_no_other_is_named() {
        let mut random = Random::new(4);
        let boxes: Vec<[DVec3; 2]> = (0..300)
            .map(|_| {
                let p = random.vector();
                [p, p + random.vector() * 0.2]
            })
            .collect();
        let mut all = Boxes::default();
        for ends in &boxes {
            all.push(ends.iter().copied(), 0.01);
        }
        let touches = |p: &[DVec3; 2], q: &[DVec3; 2]| {
            let (p0, p1, q0, q1) = (p[0].min(p[1]), p[0].max(p[1]), q[0].min(q[1]), q[0].max(q[1]));
            p0.cmple(q1 + 0.02).all() && q0.cmple(p1 + 0.02).all()
        };
        let mut expected = Vec::new();
        for i in 0..300u32 {
            for j in i + 1..300 {
                if touches(&boxes[i as usize], &boxes[j as usize]) {
                    expected.push([i, j]);
                }
            }
        }
        assert!(expected.len() > 50);
        assert_eq!(all.overlapping(), expected);
    }
}
