//! What the stroke of an element means.

use std::f64::consts::PI;
use std::str::FromStr as _;

use svgtypes::Color;

use super::super::colour::{Meaning, meaning};
use super::super::drawing::Role;

/// What a stroke means, and the alpha of its colour; `None` if it is no colour.
pub(super) fn stroke_meaning(stroke: &str) -> Option<(Meaning, f64)> {
    // A colour of print may follow that of the screen.
    let stroke = stroke.split(" icc-color").next().unwrap_or_default().trim();
    // The parser takes any letter for a digit of 0.
    let digits = stroke.strip_prefix('#').unwrap_or_default();
    if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let color = Color::from_str(stroke).ok()?;
    Some((meaning([color.red, color.green, color.blue]), f64::from(color.alpha) / 255.0))
}

/// The fold angle of a role at an opacity, radians.
pub(super) fn target(role: Role, opacity: f64) -> f64 {
    match role {
        Role::Mountain => -PI * opacity,
        Role::Valley => PI * opacity,
        _ => 0.0,
    }
}

/// An opacity between 0 and 1, given as number or percentage; `None` if it is neither.
pub(super) fn opacity(text: &str) -> Option<f64> {
    let (number, scale) = match text.strip_suffix('%') {
        Some(percent) => (percent, 0.01),
        None => (text, 1.0),
    };
    let value: f64 = number.trim().parse().ok()?;
    value.is_finite().then(|| (value * scale).clamp(0.0, 1.0))
}
