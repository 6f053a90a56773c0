//! Rows of their own heights: segments of unequal length (discussion and figure 10 of the paper).
//!
//! Each row may take the case its own w/h_k calls for. Where two rows meet, the creases of both end on the boundary
//! between them: at the lines P and Q of either. Flaps as wide as the column (E, T) end at 0, w/2 and w; those of a
//! short row (S) at s_k, w/2 and w − s_k, with s_k = (w − h_k)/2 its own. So E and T rows meet, and a short row meets
//! only rows of its own height. One flap width a for all rows makes them meet whatever their heights, because a row
//! folds with any a ≤ h_k/2: it is split where h_k > 2a.

use crate::unit::sii_offset;
use crate::{Case, EQUAL_WIDTH_TOLERANCE, PatternError, Unit};

/// Two neighbouring rows whose creases do not meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Clash {
    /// The upper row; the boundary below it is where the two clash.
    pub row: usize,
    /// The units of the upper and the lower row.
    pub units: [Unit; 2],
    /// Where creases of the upper and the lower row end on the boundary without a partner, y within one column.
    pub ends: [Vec<f64>; 2],
}

impl Clash {
    /// The two cases, such as `T against S`.
    pub fn name(&self) -> String {
        let [upper, lower] = self.units.map(|unit| unit.case.name());
        format!("{upper} against {lower}")
    }

    /// Why: which creases end where.
    pub fn reason(&self) -> String {
        let pads = self.units.map(|unit| unit.compact_width() > 0.0);
        let why = match pads {
            [true, true] => "pads of two widths meet",
            _ => "pads meet a row that has none",
        };
        let list = |ends: &[f64]| {
            let ends: Vec<String> = ends.iter().map(|y| format!("{y:.6}")).collect();
            ends.join(", ")
        };
        format!(
            "{why}: creases of row {} end at y = {} of a column, those of row {} at y = {}",
            self.row,
            list(&self.ends[0]),
            self.row + 1,
            list(&self.ends[1])
        )
    }
}

impl From<Clash> for PatternError {
    fn from(clash: Clash) -> Self {
        let name = |unit: &Unit| {
            let ratio = unit.width / unit.height;
            format!("case {}, w/h = {ratio:.6}", unit.case.name())
        };
        Self::RowsClash {
            row: clash.row,
            upper: name(&clash.units[0]),
            lower: name(&clash.units[1]),
            reason: clash.reason(),
        }
    }
}

/// The unit of each row by its own w/h_k: E, T or S (figure 10b).
///
/// They make a sheet only where [`clashes`] finds none.
///
/// # Errors
/// As [`Unit::new`] for each row.
pub fn own_cases(width: f64, heights: &[f64]) -> Result<Vec<Unit>, PatternError> {
    let unit =
        |&height: &f64| Unit::new(Case::auto(width, height, None), width, height, None, None);
    heights.iter().map(unit).collect()
}

/// The unit of each row with one flap width in all, a = λ·min(h_min, w)/2, which makes rows of any heights meet.
///
/// Where w ≥ h_min that is a = λ·h_min/2. What is left of the width, w − 2a, are pads: d = `offset` (default half of
/// w1' = w/2 − a) in the centre, s = w1' − d at the sides. A row is split where h_k > 2a. Its case is named by its
/// parts: with pads SII where split, else S; without pads T where split, else E.
///
/// # Errors
/// Heights or a width that are not positive, λ outside (0, 1], d outside [0, w1') where there are pads, an offset where
/// there are none, parts thinner than 1e-9 h, such as of a row that λ = 1 would split only just.
pub fn common_flap(
    width: f64,
    heights: &[f64],
    lambda: f64,
    offset: Option<f64>,
) -> Result<Vec<Unit>, PatternError> {
    let positive = |value: f64| value > 0.0 && value.is_finite();
    if !positive(width) {
        let (name, value) = ("unit width w", width);
        return Err(PatternError::NotPositive { name, value });
    }
    if let Some(&value) = heights.iter().find(|&&height| !positive(height)) {
        let name = "row height h";
        return Err(PatternError::NotPositive { name, value });
    }
    if !(lambda > 0.0 && lambda <= 1.0) {
        return Err(PatternError::CommonFlapOutOfRange { value: lambda });
    }
    let least = heights.iter().copied().fold(width, f64::min);
    let flap = lambda * least / 2.0;
    let pads = width / 2.0 - flap;
    let (side_pad, centre_pad) = match (pads > 0.0, offset) {
        (true, offset) => {
            let offset = sii_offset(pads, offset)?;
            (pads - offset, 2.0 * offset)
        }
        (false, None) => (0.0, 0.0),
        (false, Some(value)) => {
            return Err(PatternError::OffsetOutOfRange { value, limit: 0.0 });
        }
    };
    let unit = |&height: &f64| {
        let split = height > 2.0 * flap;
        let unit = Unit {
            case: match (pads > 0.0, split) {
                (true, true) => Case::SII,
                (true, false) => Case::S,
                (false, true) => Case::T,
                (false, false) => Case::E,
            },
            width,
            height,
            flap,
            side_pad,
            centre_pad,
            split,
        };
        unit.require_wide_parts()?;
        Ok(unit)
    };
    heights.iter().map(unit).collect()
}

/// Every two neighbouring rows whose creases do not meet, in order; lengths closer than 1e-9 h count as equal.
pub fn clashes(units: &[Unit]) -> Vec<Clash> {
    let clash = |(row, pair): (usize, &[Unit])| {
        let units = [pair[0], pair[1]];
        let tolerance = EQUAL_WIDTH_TOLERANCE * units[0].height.min(units[1].height);
        let ends = units.map(|unit| boundary_ends(&unit));
        let alone = |of: usize| -> Vec<f64> {
            let other = &ends[1 - of];
            let has_partner = |y: f64| other.iter().any(|z| (y - z).abs() <= tolerance);
            let own = ends[of].iter().copied();
            own.filter(|&y| !has_partner(y)).collect()
        };
        let ends = [alone(0), alone(1)];
        let is_clash = ends.iter().any(|ends| !ends.is_empty());
        is_clash.then_some(Clash { row, units, ends })
    };
    units.windows(2).enumerate().filter_map(clash).collect()
}

/// Where creases end on the boundaries of a row, within one column: at its lines P and Q.
fn boundary_ends(unit: &Unit) -> Vec<f64> {
    let Unit { width, flap, side_pad, centre_pad, .. } = *unit;
    let mut ends = vec![side_pad, side_pad + flap];
    if centre_pad > 0.0 {
        ends.push(width - side_pad - flap);
    }
    ends.push(width - side_pad);
    ends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::UnitSheet;

    #[test]
    fn each_row_of_figure_10_takes_the_case_of_its_own_height() {
        let units = own_cases(1.0, &[1.0, 1.4, 0.6]).unwrap();
        let cases: Vec<Case> = units.iter().map(|unit| unit.case).collect();
        assert_eq!(cases, [Case::E, Case::T, Case::S]);
    }

    #[test]
    fn in_figure_10_the_square_row_meets_the_tall_one_and_the_short_one_clashes() {
        let units = own_cases(1.0, &[1.0, 1.4, 0.6]).unwrap();
        let found = clashes(&units);
        let [clash] = found.as_slice() else { panic!("one clash, not {found:?}") };
        assert_eq!((clash.row, clash.name().as_str()), (1, "T against S"));
        assert_eq!(clash.ends[0], [0.0, 1.0]);
        let expected = [0.2, 0.8];
        let error = |(a, b): (&f64, f64)| (a - b).abs();
        assert!(clash.ends[1].iter().zip(expected).all(|p| error(p) < 1e-15));
        assert!(clash.reason().contains("pads meet a row that has none"));
    }

    #[test]
    fn a_short_row_clashes_with_square_tall_and_other_short_rows_and_no_other_rows_clash() {
        let heights = [("E", 1.0), ("T", 1.4), ("T", 2.0), ("S", 0.6), ("S", 0.5)];
        for (upper, h0) in heights {
            for (lower, h1) in heights {
                let units = own_cases(1.0, &[h0, h1]).unwrap();
                let names: Vec<String> = clashes(&units).iter().map(Clash::name).collect();
                let meets = h0 == h1 || (upper != "S" && lower != "S");
                let expected =
                    if meets { Vec::new() } else { vec![format!("{upper} against {lower}")] };
                assert_eq!(names, expected, "heights {h0} and {h1}");
                assert_eq!(UnitSheet::with_rows(&units, 2).is_ok(), meets);
            }
        }
    }

    #[test]
    fn two_short_rows_clash_because_their_pads_have_two_widths() {
        let units = own_cases(1.0, &[0.6, 0.5]).unwrap();
        let error = UnitSheet::with_rows(&units, 1).unwrap_err().to_string();
        assert!(error.contains("pads of two widths meet"), "{error}");
        assert!(error.contains("row 0 (case S") && error.contains("row 1 (case S"));
    }

    #[test]
    fn one_flap_width_lets_rows_of_any_heights_meet() {
        for lambda in [0.2, 0.7, 1.0] {
            for width in [0.4, 0.6, 1.0, 2.5] {
                let units = common_flap(width, &[1.0, 1.4, 0.6], lambda, None).unwrap();
                assert!(clashes(&units).is_empty());
                for u in &units {
                    assert_eq!(u.flap, lambda * width.min(0.6) / 2.0);
                    let sum = 2.0 * u.side_pad + 2.0 * u.flap + u.centre_pad;
                    assert!((sum - width).abs() < 1e-15);
                    assert_eq!(u.split, u.height > 2.0 * u.flap);
                }
            }
        }
    }

    #[test]
    fn one_flap_width_over_equal_heights_is_case_sii() {
        let units = common_flap(1.6, &[1.0; 4], 0.7, None).unwrap();
        assert_eq!(units[3], Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None).unwrap());
        let units = common_flap(0.7, &[1.0; 4], 1.0, None).unwrap();
        assert_eq!(units[0], Unit::new(Case::T, 0.7, 1.0, None, None).unwrap());
    }

    #[test]
    fn a_common_flap_out_of_range_is_refused() {
        for lambda in [0.0, -0.1, 1.1, f64::NAN] {
            assert!(common_flap(1.0, &[1.0, 2.0], lambda, None).is_err());
        }
        for heights in [[1.0, 0.0], [1.0, f64::NAN], [f64::INFINITY, 1.0]] {
            assert!(common_flap(1.0, &heights, 0.5, None).is_err());
        }
        assert!(common_flap(f64::NAN, &[1.0], 0.5, None).is_err());
        assert!(common_flap(1.0, &[1.0, 2.0], 0.5, Some(0.25)).is_err());
        assert!(common_flap(1.0, &[1.0, 2.0], 1.0, Some(0.1)).is_err());
        // A row that is split by a hair.
        let error = common_flap(1.0, &[1.0, 1.0 + 1e-12], 1.0, None).unwrap_err();
        assert!(matches!(error, PatternError::DegenerateUnit { .. }), "{error}");
    }
}
