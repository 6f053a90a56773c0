//! Stepping equal chords off a curve with a pair of compasses: a start for the division that no corner holds up.

use glam::DVec2;

/// Halvings of the interval in which the opening of the compasses is sought.
const HALVINGS: usize = 60;

/// Samples of a curve in order: parameters and points.
pub(crate) struct Samples {
    pub(crate) parameters: Vec<f64>,
    pub(crate) points: Vec<DVec2>,
}

impl Samples {
    /// Parameters from 0 to 1 of about equal chords, at the widest opening at which `segments` of them fit on the curve of
    /// this `length`. None if they cannot be told apart.
    ///
    /// As accurate as the samples are; where the number of chords jumps with the opening, the last one differs.
    pub(crate) fn step_off(&self, segments: usize, length: f64) -> Option<Vec<f64>> {
        let (mut fits, mut too_wide) = (0.0, 2.0 * length / segments as f64);
        let mut best = None;
        for _ in 0..HALVINGS {
            let opening = f64::midpoint(fits, too_wide);
            let ends = self.walk(segments, opening);
            if ends.len() == segments {
                best = Some(ends);
                fits = opening;
            } else {
                too_wide = opening;
            }
        }
        let mut parameters = best?;
        parameters.insert(0, 0.0);
        parameters[segments] = 1.0;
        let rising = parameters.windows(2).all(|u| u[0] < u[1]);
        rising.then_some(parameters)
    }

    /// The ends of at most `segments` chords, each the first point that far from the end before it.
    fn walk(&self, segments: usize, opening: f64) -> Vec<f64> {
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
        let points = parameters
            .iter()
            .map(|&u| DVec2::new(u, 2.0 - 4.0 * (u - 0.5).abs()))
            .collect();
        let samples = Samples { parameters, points };
        for segments in [1, 2, 3, 4, 5, 8, 13] {
            let ends = samples.step_off(segments, 17f64.sqrt()).unwrap();
            let at = |u: f64| DVec2::new(u, 2.0 - 4.0 * (u - 0.5).abs());
            let chords: Vec<_> = ends
                .windows(2)
                .map(|u| at(u[0]).distance(at(u[1])))
                .collect();
            assert_eq!(chords.len(), segments);
            for chord in &chords[..segments - 1] {
                assert!((chord - chords[0]).abs() < 1e-2 * chords[0], "{chords:?}");
            }
        }
    }
}
