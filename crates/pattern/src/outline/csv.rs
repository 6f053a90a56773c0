//! Tables of coordinates: x and z a line, separated by commas, semicolons, tabs or spaces, with or without quotes.
//!
//! Blank lines and lines that start with `#` are left out, and so is a first line of names.

use glam::DVec2;

use super::{Outline, OutlineError, number};

pub(super) fn parse(text: &str) -> Result<Outline, OutlineError> {
    let mut points = Vec::new();
    let mut is_first = true;
    for (index, line) in text.lines().enumerate() {
        let line = line.trim_start_matches('\u{feff}').trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let values = values(line);
        let is_header = is_first && values.iter().all(|v| v.parse::<f64>().is_err());
        is_first = false;
        if is_header {
            continue;
        }
        let [x, z] = values[..] else {
            return Err(OutlineError::NotAPoint { line: index + 1, count: values.len() });
        };
        points.push(DVec2::new(number(x, index + 1)?, number(z, index + 1)?));
    }
    if points.is_empty() {
        return Err(OutlineError::Empty { expected: "a line needs two numbers, x and z" });
    }
    Ok(Outline::of(points))
}

/// The values of a line: separated by semicolons if it has any, else by commas, else by blanks; each may be in double
/// quotes (RFC 4180).
fn values(line: &str) -> Vec<&str> {
    for separator in [';', ','] {
        if line.contains(separator) {
            return line.split(separator).map(unquoted).collect();
        }
    }
    line.split_whitespace().map(unquoted).collect()
}

fn unquoted(value: &str) -> &str {
    let value = value.trim();
    let inner = value.strip_prefix('"').and_then(|v| v.strip_suffix('"'));
    inner.map_or(value, str::trim)
}
