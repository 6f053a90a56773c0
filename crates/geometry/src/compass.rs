//! Stepping equal chords along a curve with a pair of compasses.

use glam::DVec2;

/// The number of times the interval is halved in which the opening of the compasses is sought.
const HALVINGS: usize = 40;

/// Samples of a curve in order: parameters and points.
pub(crate) struct Samples {
    pub(crate) parameters: Vec<f64>,
    pub(crate) points: Vec<DVec2>,
}

impl Samples {
    /// The samples of the curve in the opposite direction.
    pub(crate) fn reversed(&self) -> Self {
        Self {
            parameters: self.parameters.iter().rev().map(|u| 1.0 - u).collect(),
            points: self.points.iter().rev().copied().collect(),
        }
    }

    /// The widest opening at which `segments` chords fit on the curve of this `length`, each ending at the first point
    /// at that distance from its start.
    ///
    /// It is as accurate as the samples. If the number of chords jumps with the opening, the last chord ends early.
    pub(crate) fn widest_opening(&self, segments: usize, length: f64) -> f64 {
        let (mut fits, mut too_wide) = (0.0, 2.0 * length / segments as f64);
        for _ in 0..HALVINGS {
            let opening = f64::midpoint(fits, too_wide);
            if self.walk(segments, opening).len() == segments {
                fits = opening;
            } else {
                too_wide = opening;
            }
        }
        fits
    }

    /// The ends of at most `segments` chords, each the first point at that distance from the previous end.
    pub(crate) fn walk(&self, segments: usize, opening: f64) -> Vec<f64> {
        let mut ends = Vec::with_capacity(segments + 1);
        let mut centre = self.points[0];
        let (mut u, mut p) = (self.parameters[0], centre);
        let mut next = 1;
        while ends.len() < segments && next < self.points.len() {
            let (u_next, p_next) = (self.parameters[next], self.points[next]);
            let (inner, outer) = (p.distance(centre), p_next.distance(centre));
            if outer < opening {
                (u, p) = (u_next, p_next);
                next += 1;
            } else {
                // The chord may end again within this piece of the curve, so `next` stays.
                let share = ((opening - inner) / (outer - inner)).clamp(0.0, 1.0);
                u += share * (u_next - u);
                p += share * (p_next - p);
                centre = p;
                ends.push(u);
            }
        }
        ends
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chords_stepped_off_around_a_corner_are_equal() {
        let parameters: Vec<_> = (0..=1000).map(|k| f64::from(k) / 1000.0).collect();
        // Up and down again: a corner of 2 atan(1/4) at u = ½.
        let points =
            parameters.iter().map(|&u| DVec2::new(u, 2.0 - 4.0 * (u - 0.5).abs())).collect();
        let samples = Samples { parameters, points };
        for segments in [1, 2, 3, 4, 5, 8, 13] {
            let opening = samples.widest_opening(segments, 17f64.sqrt());
            let mut ends = vec![0.0];
            ends.extend(samples.walk(segments, opening));
            let at = |u: f64| DVec2::new(u, 2.0 - 4.0 * (u - 0.5).abs());
            let chords: Vec<_> = ends.windows(2).map(|u| at(u[0]).distance(at(u[1]))).collect();
            assert_eq!(chords.len(), segments);
            for chord in &chords {
                assert!((chord - opening).abs() < 1e-2 * opening, "{chords:?}");
            }
            assert!(samples.walk(segments, 1.01 * opening).len() < segments);
        }
    }
}
