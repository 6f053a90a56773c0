//! One axis of a plot: the range it shows, linear or logarithmic, its ticks and their labels.

use std::ops::Range;

/// The most ticks on an axis.
const MOST_TICKS: usize = 9;

/// A range of values, shown linearly or by their logarithms.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub(super) range: Range<f64>,
    pub(super) is_logarithmic: bool,
}

impl Axis {
    /// How far along the axis `value` lies: 0 at the start of the range, 1 at its end.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        let scale = |v: f64| if self.is_logarithmic { v.log10() } else { v };
        let (start, end) = (scale(self.range.start), scale(self.range.end));
        (scale(value) - start) / (end - start)
    }

    /// The values to mark, rising, with their labels. At most `most` of them.
    pub(super) fn ticks(&self, most: usize) -> Vec<(f64, String)> {
        let most = most.min(MOST_TICKS);
        if self.is_logarithmic { self.logarithmic_ticks(most) } else { self.linear_ticks(most) }
    }

    /// Multiples of 1, 2 or 5 times a power of ten.
    fn linear_ticks(&self, most: usize) -> Vec<(f64, String)> {
        let Range { start, end } = self.range;
        let least = (end - start) / most as f64;
        let decade = 10.0_f64.powf(least.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * decade);
        let step = step.into_iter().find(|&s| s >= least).unwrap_or(least);
        let (first, last) = ((start / step).ceil() as i64, (end / step).floor() as i64);
        let values = (first..=last).map(|k| k as f64 * step);
        values.map(|value| (value, label(value, step))).collect()
    }

    /// Powers of ten; between neighbouring ones also their multiples where the range is too short for two powers.
    fn logarithmic_ticks(&self, most: usize) -> Vec<(f64, String)> {
        let exponents = self.range.start.log10().floor() as i32..=self.range.end.log10() as i32 + 1;
        let multiples: [&[u8]; 3] = [&[1], &[1, 2, 5], &[1, 2, 3, 4, 5, 6, 7, 8, 9]];
        let mut ticks = Vec::new();
        for multiples in multiples {
            let all = exponents.clone().flat_map(|e| multiples.iter().map(move |&m| (m, e)));
            let all = all.map(|(m, e)| {
                let power = 10.0_f64.powi(e);
                let value = f64::from(m) * power;
                (value, label(value, power))
            });
            ticks = all.filter(|(v, _)| self.range.contains(v)).collect::<Vec<_>>();
            if ticks.len() > 1 {
                break;
            }
        }
        let stride = ticks.len().div_ceil(most).max(1);
        ticks.into_iter().step_by(stride).collect()
    }
}

/// `value` to the decimals that tell it from the tick one `step` away.
fn label(value: f64, step: f64) -> String {
    let exponent = step.log10().floor() as i32;
    if value == 0.0 || (-4..=4).contains(&exponent) {
        let decimals = if exponent < -4 { 0 } else { exponent.min(0) };
        return format!("{value:.*}", decimals.unsigned_abs() as usize);
    }
    let power = value.abs().log10().floor() as i32;
    let decimals = (power - exponent).max(0).unsigned_abs() as usize;
    format!("{value:.decimals$e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: Range<f64>, is_logarithmic: bool) -> Vec<String> {
        let axis = Axis { range, is_logarithmic };
        let ticks = axis.ticks(5).into_iter();
        ticks.map(|(_, label)| label).collect()
    }

    #[test]
    fn linear_ticks_are_round_numbers() {
        assert_eq!(labels(0.0..2.0, false), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(labels(-3.0..41.0, false), ["0", "10", "20", "30", "40"]);
        let small = ["0", "1e-6", "2e-6", "3e-6"];
        assert_eq!(labels(0.0..3.5e-6, false), small);
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten_or_multiples_of_one() {
        let powers = ["0.001", "0.01", "0.1", "1"];
        assert_eq!(labels(5e-4..3.0, true), powers);
        assert_eq!(labels(0.15..0.6, true), ["0.2", "0.5"]);
        let short = ["3", "4"];
        assert_eq!(labels(2.1..4.9, true), short);
        assert!(labels(1e-12..1.0, true).len() <= 5);
    }

    #[test]
    fn ends_of_the_range_are_the_ends_of_the_axis() {
        for is_logarithmic in [false, true] {
            let axis = Axis { range: 0.1..10.0, is_logarithmic };
            let ends = [0.1, 10.0].map(|value| axis.fraction(value));
            assert!(ends[0].abs() < 1e-15 && (ends[1] - 1.0).abs() < 1e-15);
        }
    }
}
