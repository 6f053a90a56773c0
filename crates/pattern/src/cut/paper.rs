//! Sizes of paper and lengths as a user writes them.

use std::str::FromStr;

use glam::DVec2;

use super::CutError;

/// mm in a unit of length.
const UNITS: &[(&str, f64)] =
    &[("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4), ("pt", 25.4 / 72.0), ("", 1.0)];

/// Papers with their short and long side, mm (ISO 216; ANSI A to B).
const PAPERS: &[(&str, [f64; 2])] = &[
    ("a0", [841.0, 1189.0]),
    ("a1", [594.0, 841.0]),
    ("a2", [420.0, 594.0]),
    ("a3", [297.0, 420.0]),
    ("a4", [210.0, 297.0]),
    ("a5", [148.0, 210.0]),
    ("a6", [105.0, 148.0]),
    ("letter", [215.9, 279.4]),
    ("legal", [215.9, 355.6]),
    ("tabloid", [279.4, 431.8]),
];

/// A length in mm from a number with mm, cm, m, in or pt; mm without a unit.
///
/// # Errors
/// [`CutError::LengthText`] where it is none of these, or not finite.
pub fn parse_millimetres(text: &str) -> Result<f64, CutError> {
    let wrong = || CutError::LengthText { text: text.to_owned() };
    let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.').map_or(0, |last| last + 1);
    let (number, unit) = text.split_at(end);
    let known = UNITS.iter().find(|(name, _)| *name == unit.trim());
    let &(_, factor) = known.ok_or_else(wrong)?;
    let value: f64 = number.trim().parse().map_err(|_| wrong())?;
    if value.is_finite() { Ok(value * factor) } else { Err(wrong()) }
}

/// The size of a sheet of paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperSize(
    /// Width and height, mm.
    pub DVec2,
);

impl FromStr for PaperSize {
    type Err = CutError;

    /// `A0` to `A6`, `letter`, `legal`, `tabloid`, upright or with `-landscape`; or `WIDTHxHEIGHT` with a unit as in
    /// [`parse_millimetres`].
    fn from_str(text: &str) -> Result<Self, CutError> {
        let wrong = || CutError::PaperText { text: text.to_owned() };
        let lower = text.to_lowercase();
        let name = lower.strip_suffix("-landscape").unwrap_or(&lower);
        if let Some(&(_, [short, long])) = PAPERS.iter().find(|(known, _)| *known == name) {
            return Ok(Self(if name == lower {
                DVec2::new(short, long)
            } else {
                DVec2::new(long, short)
            }));
        }
        let (width, height) = lower.split_once('x').ok_or_else(wrong)?;
        let unit = height.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
        let height = parse_millimetres(height).map_err(|_| wrong())?;
        // A unit after the height alone is meant for both.
        let is_bare = width.ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let width = if is_bare { format!("{width}{unit}") } else { width.to_owned() };
        let width = parse_millimetres(&width).map_err(|_| wrong())?;
        if width > 0.0 && height > 0.0 { Ok(Self(DVec2::new(width, height))) } else { Err(wrong()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(text: &str) -> [f64; 2] {
        text.parse::<PaperSize>().unwrap().0.to_array()
    }

    #[test]
    fn papers_have_their_standard_sizes() {
        assert_eq!(size("A4"), [210.0, 297.0]);
        assert_eq!(size("a3-landscape"), [420.0, 297.0]);
        assert_eq!(size("Letter"), [215.9, 279.4]);
        assert_eq!(size("300x600"), [300.0, 600.0]);
        assert_eq!(size("8x11in"), [8.0 * 25.4, 11.0 * 25.4]);
        assert_eq!(size("30cmx1.5m"), [300.0, 1500.0]);
    }

    #[test]
    fn lengths_carry_their_unit() {
        assert_eq!(parse_millimetres("12.5"), Ok(12.5));
        assert_eq!(parse_millimetres("72 pt"), Ok(25.4));
        assert_eq!(parse_millimetres("1.5cm"), Ok(15.0));
        assert_eq!(parse_millimetres("-3mm"), Ok(-3.0));
    }

    #[test]
    fn what_is_no_length_and_no_paper_is_refused() {
        for text in ["", "mm", "3 feet", "1e999", "nan", "inf", "1,5"] {
            assert!(parse_millimetres(text).is_err(), "{text}");
        }
        for text in ["", "A9", "x", "0x10", "-3x4", "10x", "x10mm", "10x20x30", "A4-sideways"] {
            assert!(text.parse::<PaperSize>().is_err(), "{text}");
        }
    }
}
