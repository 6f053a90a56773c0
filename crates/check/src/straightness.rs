//! How far the straight paths between frames stray from a smooth motion through the frames.

use foldmotion_pattern::Frame;
use glam::DVec3;

/// The motion time of the planar state, at which the motion may turn sharply because its stages meet there.
const STAGES_MEET: f64 = 1.0;

/// For each interval between frames, an estimate of how far the straight paths stray from the smooth motion that the
/// frames sample, in the unit of length of the frames.
///
/// A path x(t) leaves its chord over an interval Δ by at most max |x″| Δ²/8 (the remainder of linear interpolation). x″
/// is taken from the second divided differences with the frame before and the frame after, whichever is larger; frames
/// on both sides of t = 1, where the stages meet, are not combined.
///
/// The estimate is infinite if no third frame of the same stage is available. It is not a bound: movement between
/// frames that leaves no trace in them is not seen. Preconditions: times increase strictly, and all frames have the
/// same number of positions.
pub fn straying(frames: &[Frame]) -> Vec<f64> {
    let bend: Vec<Option<f64>> = frames
        .windows(3)
        .map(|w| (w[1].time != STAGES_MEET).then(|| second_difference(w)))
        .collect();
    (0..frames.len().saturating_sub(1))
        .map(|k| {
            let span = frames[k + 1].time - frames[k].time;
            let before = k.checked_sub(1).and_then(|k| bend.get(k)).copied();
            let after = bend.get(k).copied();
            let largest = [before, after].into_iter().flatten().flatten();
            let largest = largest.reduce(f64::max).unwrap_or(f64::INFINITY);
            largest * span * span / 4.0
        })
        .collect()
}

/// The largest |x″| / 2 of any vertex over three frames.
fn second_difference(frames: &[Frame]) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|k| &frames[k]);
    let slope = |p: DVec3, q: DVec3, from: &Frame, to: &Frame| (q - p) / (to.time - from.time);
    let vertices = a.positions.iter().zip(&b.positions).zip(&c.positions);
    vertices
        .map(|((&p, &q), &r)| (slope(q, r, b, c) - slope(p, q, a, b)).length())
        .fold(0.0, f64::max)
        / (c.time - a.time)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(times: &[f64], path: impl Fn(f64) -> DVec3) -> Vec<Frame> {
        let frame = |&time: &f64| Frame { time, positions: vec![DVec3::ZERO, path(time)] };
        times.iter().map(frame).collect()
    }

    #[test]
    fn on_a_parabola_the_estimate_is_the_sagitta() {
        // |x″| = 2·3: the sagitta of a chord over Δ is 6 Δ²/8.
        let times = [0.0, 0.1, 0.25, 0.3];
        let frames = sampled(&times, |t| DVec3::new(t, 3.0 * t * t, 1.0));
        for (stray, span) in straying(&frames).into_iter().zip([0.1, 0.15, 0.05]) {
            assert!((stray - 0.75 * span * span).abs() < 1e-14, "{stray}");
        }
    }

    #[test]
    fn a_rotation_strays_by_about_the_sagitta_of_its_arc_and_a_translation_not_at_all() {
        let times: Vec<f64> = (0..=20).map(|k| 0.04 * f64::from(k)).collect();
        let turning = sampled(&times, |t| DVec3::new(t.cos(), t.sin(), 0.0));
        let sagitta = 1.0 - f64::cos(0.02);
        for stray in straying(&turning) {
            assert!((stray / sagitta - 1.0).abs() < 1e-3, "{stray} {sagitta}");
        }
        let gliding = sampled(&times, |t| DVec3::new(1.0, 2.0, 3.0) * t);
        assert!(straying(&gliding).iter().all(|&stray| stray < 1e-15));
    }

    #[test]
    fn a_corner_where_the_stages_meet_is_no_curvature_and_a_lone_interval_tells_nothing() {
        let corner = |t: f64| DVec3::new(t, (t - 1.0).abs(), 0.0);
        let straight = sampled(&[0.0, 0.5, 1.0, 1.5, 2.0], corner);
        assert!(straying(&straight).iter().all(|&stray| stray < 1e-15));
        let shifted = sampled(&[0.0, 0.5, 1.01, 1.5, 2.0], corner);
        assert!(straying(&shifted).iter().any(|&stray| stray > 0.1));
        let lone = sampled(&[0.0, 1.0, 2.0], corner);
        assert_eq!(straying(&lone), [f64::INFINITY; 2]);
        assert!(straying(&lone[..1]).is_empty());
    }
}
