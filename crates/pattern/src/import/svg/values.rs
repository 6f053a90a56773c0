//! Numbers and lengths in attributes.

use std::str::FromStr as _;

use roxmltree::Node;
use svgtypes::{Length, LengthUnit, NumberListParser};

use super::super::ImportError;
use super::LineNumbers;

/// Millimetres of a user unit, where nothing else is said (CSS: 96 to the inch).
pub(super) const MM_A_UNIT: f64 = 25.4 / 96.0;

/// The most characters of a value that an error repeats.
const SHOWN: usize = 60;

/// An error about an attribute.
pub(super) fn wrong(
    node: Node<'_, '_>,
    numbering: &LineNumbers,
    name: &'static str,
    value: &str,
    need: &'static str,
) -> ImportError {
    ImportError::Attribute {
        element: numbering.source(node),
        name,
        value: value.chars().take(SHOWN).collect(),
        need,
    }
}

/// A length in mm where its unit is physical; otherwise in user units; `None` for percentages and font sizes.
pub(super) fn parsed(text: &str) -> Option<Result<(f64, bool), ()>> {
    let Ok(Length { number, unit }) = Length::from_str(text.trim()) else {
        return Some(Err(()));
    };
    if !number.is_finite() {
        return Some(Err(()));
    }
    let mm = match unit {
        LengthUnit::None | LengthUnit::Px => return Some(Ok((number, false))),
        LengthUnit::Mm => 1.0,
        LengthUnit::Cm => 10.0,
        LengthUnit::In => 25.4,
        LengthUnit::Pt => 25.4 / 72.0,
        LengthUnit::Pc => 25.4 / 6.0,
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
    };
    Some(Ok((number * mm, true)))
}

/// An attribute that is a length, in user units; 0 if omitted.
pub(super) fn length(
    node: Node<'_, '_>,
    numbering: &LineNumbers,
    name: &'static str,
) -> Result<f64, ImportError> {
    let Some(text) = node.attribute(name) else {
        return Ok(0.0);
    };
    match parsed(text) {
        Some(Ok((number, false))) => Ok(number),
        Some(Ok((mm, true))) => Ok(mm / MM_A_UNIT),
        _ => Err(wrong(
            node,
            numbering,
            name,
            text,
            "a finite number is needed, in user units or px, mm, cm, in, pt, pc",
        )),
    }
}

/// A length that must not be negative.
pub(super) fn size(
    node: Node<'_, '_>,
    numbering: &LineNumbers,
    name: &'static str,
) -> Result<f64, ImportError> {
    let value = length(node, numbering, name)?;
    if value >= 0.0 {
        return Ok(value);
    }
    let text = node.attribute(name).unwrap_or_default();
    Err(wrong(node, numbering, name, text, "it must not be negative"))
}

/// All numbers of a list.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    NumberListParser::from(text).map(|number| number.ok().filter(|n| n.is_finite())).collect()
}
