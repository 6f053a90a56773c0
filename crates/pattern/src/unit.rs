//! The unit of each case: how a column of width w and a row of height h are divided.
//!
//! A column is divided along the width into s | a | 2d | a | s (side pad, flap, centre pad, flap, side pad); on the
//! mid line of a row the creases meet at distance a from both row boundaries (sections 2 and 3 of the paper).

use serde::{Deserialize, Serialize};

use crate::PatternError;

/// Widths closer than this fraction of h count as equal.
pub const EQUAL_WIDTH_TOLERANCE: f64 = 1e-9;

/// The cases of the paper, and the unmodified rectangle of its figures 3a–d and 4a–d.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Case {
    /// Square units, w = h (section 2).
    E,
    /// Tall units, w < h, mid vertices split (figures 3e–h).
    T,
    /// Short units, w > h, with side pads (figures 4e–h).
    S,
    /// Short units with split mid vertices and centre pads (figure 5).
    SII,
    /// The unmodified rectangle of any w/h.
    #[serde(rename = "plain")]
    Plain,
}

impl Case {
    /// The name in scene files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::E => "E",
            Self::T => "T",
            Self::S => "S",
            Self::SII => "SII",
            Self::Plain => "plain",
        }
    }

    /// The case that `auto` chooses: E if w = h within 1e-9 h, T below, above it S, or SII if λ is given.
    pub fn auto(width: f64, height: f64, lambda: Option<f64>) -> Self {
        if (width - height).abs() <= EQUAL_WIDTH_TOLERANCE * height {
            Self::E
        } else if width < height {
            Self::T
        } else if lambda.is_some() {
            Self::SII
        } else {
            Self::S
        }
    }
}

/// One unit: its size and the widths its column is divided into. Lengths in the unit of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// The case of the unit.
    pub case: Case,
    /// The width w of the unit.
    pub width: f64,
    /// The height h of the unit.
    pub height: f64,
    /// a, the width of a flap.
    pub flap: f64,
    /// s, the width of a side pad.
    pub side_pad: f64,
    /// 2d, the width of the centre pad.
    pub centre_pad: f64,
    /// Whether the mid vertex is split into two.
    pub split: bool,
}

impl Unit {
    /// The unit of `case` with width w and height h.
    ///
    /// `lambda` (λ) and `offset` (d, default w1'/2 with w1' = w/2 − λh/2) belong to case SII.
    ///
    /// # Errors
    /// Sizes that are not positive, a case that w/h contradicts, λ or d out of range, and parts thinner than 1e-9 h.
    pub fn new(
        case: Case,
        width: f64,
        height: f64,
        lambda: Option<f64>,
        offset: Option<f64>,
    ) -> Result<Self, PatternError> {
        for (name, value) in [("unit width w", width), ("unit height h", height)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(PatternError::NotPositive { name, value });
            }
        }
        if case != Case::SII {
            for (key, value) in [("lambda", lambda), ("offset", offset)] {
                if value.is_some() {
                    return Err(PatternError::KeyWithoutCase { key, case: case.name() });
                }
            }
        }
        require_ratio(case, width, height)?;
        let unit = |flap, side_pad, centre_pad, split| Self {
            case,
            width,
            height,
            flap,
            side_pad,
            centre_pad,
            split,
        };
        let unit = match case {
            Case::E | Case::Plain => unit(width / 2.0, 0.0, 0.0, false),
            Case::T => unit(width / 2.0, 0.0, 0.0, true),
            Case::S => unit(height / 2.0, (width - height) / 2.0, 0.0, false),
            Case::SII => {
                let (flap, side_pad, offset) = sii_widths(width, height, lambda, offset)?;
                unit(flap, side_pad, 2.0 * offset, true)
            }
        };
        unit.require_wide_parts()?;
        Ok(unit)
    }

    /// The distance of a mid vertex from its row boundary: a, or h/2 in an unmodified rectangle.
    pub fn mid_distance(&self) -> f64 {
        if self.split { self.flap } else { self.height / 2.0 }
    }

    /// The narrowest of the parts the unit has: flap, pads, and the part between split mid vertices.
    pub fn thinnest_part(&self) -> f64 {
        let ridge = if self.split { self.height - 2.0 * self.flap } else { self.height };
        // Pads that the case does not have are exactly 0 wide.
        let parts = [self.flap, self.side_pad, self.centre_pad, ridge];
        parts.into_iter().filter(|&part| part > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// The width of one column in the compact state, 2s + 2d: flaps have no extent across the width.
    pub fn compact_width(&self) -> f64 {
        2.0 * self.side_pad + self.centre_pad
    }

    pub(crate) fn require_wide_parts(&self) -> Result<(), PatternError> {
        let least = EQUAL_WIDTH_TOLERANCE * self.height;
        let ridge = if self.split { self.height - 2.0 * self.flap } else { self.height };
        // Pads that the case does not have are exactly 0 wide.
        let pad = |width: f64| if width == 0.0 { f64::INFINITY } else { width };
        let parts = [
            ("the flap", self.flap, "choose fewer columns or a larger lambda"),
            ("the side pad", pad(self.side_pad), "choose a smaller offset or another width"),
            ("the centre pad", pad(self.centre_pad), "use offset = 0 or a larger one"),
            ("the part between the split mid vertices", ridge, "choose case E or a smaller lambda"),
        ];
        match parts.into_iter().find(|&(_, value, _)| value < least) {
            Some((part, value, remedy)) => {
                Err(PatternError::DegenerateUnit { part, value, height: self.height, remedy })
            }
            None => Ok(()),
        }
    }
}

fn require_ratio(case: Case, width: f64, height: f64) -> Result<(), PatternError> {
    let equal = (width - height).abs() <= EQUAL_WIDTH_TOLERANCE * height;
    let (holds, need, remedy) = match case {
        Case::E => (equal, "w = h", "leave width out, or choose case = \"auto\""),
        Case::T => (
            width < height && !equal,
            "w < h",
            "raise the number of columns, or choose case = \"auto\"",
        ),
        Case::S | Case::SII => (
            width > height && !equal,
            "w > h",
            "lower the number of columns, or choose case = \"auto\"",
        ),
        Case::Plain => (true, "", ""),
    };
    if holds {
        Ok(())
    } else {
        Err(PatternError::CaseContradictsUnit { case: case.name(), need, width, height, remedy })
    }
}

/// (a, s, d) of case SII.
fn sii_widths(
    width: f64,
    height: f64,
    lambda: Option<f64>,
    offset: Option<f64>,
) -> Result<(f64, f64, f64), PatternError> {
    let value = lambda.unwrap_or(f64::NAN);
    if !(value > 0.0 && value < 1.0) {
        return Err(PatternError::LambdaOutOfRange { value });
    }
    let flap = value * height / 2.0;
    let limit = width / 2.0 - flap;
    let offset = sii_offset(limit, offset)?;
    Ok((flap, limit - offset, offset))
}

/// d below its limit w1', half of it if omitted.
pub(crate) fn sii_offset(limit: f64, offset: Option<f64>) -> Result<f64, PatternError> {
    let value = offset.unwrap_or(limit / 2.0);
    if value >= 0.0 && value < limit {
        Ok(value)
    } else {
        Err(PatternError::OffsetOutOfRange { value, limit })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_every_unit_sum_to_its_width() {
        let units = [
            Unit::new(Case::E, 1.0, 1.0, None, None),
            Unit::new(Case::T, 0.7, 1.0, None, None),
            Unit::new(Case::S, 1.6, 1.0, None, None),
            Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None),
            Unit::new(Case::SII, 1.6, 1.0, Some(0.3), Some(0.0)),
            Unit::new(Case::Plain, 2.5, 1.0, None, None),
        ];
        for unit in units {
            let u = unit.unwrap();
            let sum = 2.0 * u.side_pad + 2.0 * u.flap + u.centre_pad;
            assert!((sum - u.width).abs() < 1e-15, "{u:?}");
        }
    }

    #[test]
    fn a_case_that_contradicts_the_width_is_refused() {
        for (case, width) in
            [(Case::E, 1.1), (Case::T, 1.0), (Case::T, 1.2), (Case::S, 1.0), (Case::S, 0.9)]
        {
            let error = Unit::new(case, width, 1.0, None, None).unwrap_err();
            assert!(matches!(error, PatternError::CaseContradictsUnit { .. }), "{error}");
        }
        let error = Unit::new(Case::SII, 0.9, 1.0, Some(0.5), None).unwrap_err();
        assert!(matches!(error, PatternError::CaseContradictsUnit { .. }), "{error}");
    }

    #[test]
    fn lambda_and_offset_out_of_range_are_refused() {
        for lambda in [None, Some(0.0), Some(1.0), Some(-0.2), Some(f64::NAN)] {
            let error = Unit::new(Case::SII, 1.6, 1.0, lambda, None).unwrap_err();
            assert!(matches!(error, PatternError::LambdaOutOfRange { .. }), "{error}");
        }
        for offset in [-0.1, 0.46, 0.5, f64::NAN] {
            let error = Unit::new(Case::SII, 1.6, 1.0, Some(0.7), Some(offset)).unwrap_err();
            assert!(matches!(error, PatternError::OffsetOutOfRange { .. }), "{error}");
        }
        let error = Unit::new(Case::S, 1.6, 1.0, Some(0.7), None).unwrap_err();
        assert!(matches!(error, PatternError::KeyWithoutCase { key: "lambda", .. }), "{error}");
    }

    #[test]
    fn auto_takes_the_case_that_width_and_height_allow() {
        assert_eq!(Case::auto(1.0 + 5e-10, 1.0, None), Case::E);
        assert_eq!(Case::auto(0.9, 1.0, Some(0.5)), Case::T);
        assert_eq!(Case::auto(1.1, 1.0, None), Case::S);
        assert_eq!(Case::auto(1.1, 1.0, Some(0.5)), Case::SII);
    }

    #[test]
    fn sizes_that_are_not_positive_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Unit::new(Case::Plain, bad, 1.0, None, None).is_err());
            assert!(Unit::new(Case::Plain, 1.0, bad, None, None).is_err());
        }
    }
}
