//! The data of the plots under the timeline.

/// Curves of related quantities over motion time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Plot {
    /// The quantity, with its unit.
    pub(crate) title: String,
    pub(crate) about: &'static str,
    pub(crate) is_logarithmic: bool,
    pub(crate) curves: Vec<Curve>,
    /// A value to compare with, and its name.
    pub(crate) reference: Option<(f64, &'static str)>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curve {
    pub(crate) name: &'static str,
    /// Pairs of motion time and value, in order of time; a value that is not a number leaves a gap.
    pub(crate) points: Vec<[f64; 2]>,
}

#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Plots {
    pub(crate) plots: Vec<Plot>,
}

impl Plot {
    /// Whether any value can be drawn.
    pub(crate) fn has_values(&self) -> bool {
        let mut values = self.curves.iter().flat_map(|curve| &curve.points);
        values.any(|p| self.shows(p[1]))
    }

    /// Whether `value` can be drawn.
    pub(super) fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.is_logarithmic || value > 0.0)
    }

    /// A value on the scale of the plot: the value itself, or its decimal logarithm.
    pub(super) fn level(&self, value: f64) -> f64 {
        if self.is_logarithmic { value.log10() } else { value }
    }

    /// The lowest and the highest level; a linear plot starts at 0 if no value is negative.
    pub(super) fn levels(&self) -> [f64; 2] {
        let values = self.curves.iter().flat_map(|c| c.points.iter().map(|p| p[1]));
        let values = values.chain(self.reference.map(|(value, _)| value));
        let levels = values.filter(|&v| self.shows(v)).map(|v| self.level(v));
        let start =
            if self.is_logarithmic { [f64::INFINITY, f64::NEG_INFINITY] } else { [0.0, 0.0] };
        let [low, high] = levels.fold(start, |[low, high], v| [low.min(v), high.max(v)]);
        if !(low.is_finite() && high.is_finite()) {
            return [0.0, 1.0];
        }
        if high - low < 1e-12 * high.abs().max(1e-12) {
            return [low, low + high.abs().max(1e-9)];
        }
        [low, high]
    }
}

impl Curve {
    /// The value at motion time `t`, interpolated linearly between frames.
    pub(super) fn at(&self, t: f64) -> Option<f64> {
        let next = self.points.partition_point(|p| p[0] < t);
        let after = self.points.get(next)?;
        if after[0] == t || next == 0 {
            return (after[0] == t).then_some(after[1]);
        }
        let before = self.points[next - 1];
        let part = (t - before[0]) / (after[0] - before[0]);
        Some(before[1] + part * (after[1] - before[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(is_logarithmic: bool, values: &[f64]) -> Plot {
        let points = values.iter().enumerate().map(|(k, &v)| [k as f64, v]);
        Plot {
            title: String::new(),
            about: "",
            is_logarithmic,
            curves: vec![Curve { name: "a", points: points.collect() }],
            reference: None,
        }
    }

    #[test]
    fn levels_hold_every_value_that_can_be_drawn() {
        assert_eq!(plot(false, &[1.0, 3.0, f64::NAN]).levels(), [0.0, 3.0]);
        assert_eq!(plot(true, &[0.0, 0.01, 10.0]).levels(), [-2.0, 1.0]);
        assert_eq!(plot(true, &[0.0, -1.0]).levels(), [0.0, 1.0]);
        let mut with = plot(false, &[1.0]);
        with.reference = Some((5.0, "closed form"));
        assert_eq!(with.levels(), [0.0, 5.0]);
        let [low, high] = plot(true, &[7.0, 7.0]).levels();
        assert!(low < high, "a constant has a scale too");
    }

    #[test]
    fn values_between_frames_lie_on_a_line() {
        let curve = &plot(false, &[1.0, 3.0, 2.0]).curves[0];
        assert_eq!(curve.at(0.5), Some(2.0));
        assert_eq!(curve.at(1.0), Some(3.0));
        assert_eq!(curve.at(0.0), Some(1.0));
        assert_eq!(curve.at(-0.1), None);
        assert_eq!(curve.at(2.1), None);
    }
}
