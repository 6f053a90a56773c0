//! Numbers in messages.

use std::fmt;

/// A number as people read it: plain from 0.001 to a million, otherwise with an exponent.
///
/// A precision is a number of significant digits: `{:.3}` of 0.000 123 456 is 1.23e-4. Trailing zeros are left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = match f.precision() {
            Some(digits) if self.0.is_finite() => {
                let rounded = format!("{:.*e}", digits.saturating_sub(1), self.0);
                rounded.parse().unwrap_or(self.0)
            }
            _ => self.0,
        };
        let is_plain = value == 0.0 || (1e-3..1e6).contains(&value.abs());
        let text = match value {
            _ if !value.is_finite() => format!("{value}"),
            // A zero has no sign.
            0.0 => "0".to_owned(),
            _ if is_plain => format!("{value}"),
            _ => format!("{value:e}"),
        };
        f.write_str(&text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plain_near_one_and_short_elsewhere() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (4.0, "4"),
            (-2.5, "-2.5"),
            (0.001, "0.001"),
            (1e-6, "1e-6"),
            (999_999.0, "999999"),
            (1e6, "1e6"),
            (-1e308, "-1e308"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ];
        for (value, text) in cases {
            assert_eq!(Number(value).to_string(), text);
        }
    }

    #[test]
    fn a_precision_counts_significant_digits() {
        assert_eq!(format!("{:.3}", Number(1.234_56e-4)), "1.23e-4");
        assert_eq!(format!("{:.3}", Number(12.345_6)), "12.3");
        assert_eq!(format!("{:.2}", Number(0.999)), "1");
        assert_eq!(format!("{:.3}", Number(0.0)), "0");
    }
}
