//! Numbers with as many digits as are the same on every machine.

/// `value` with this number of significant digits, without an exponent.
pub(crate) fn rounded(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    // Rounding may carry into the next decade: the exponent is that of the rounded number.
    let text = format!("{value:.*e}", places(digits - 1));
    let exponent =
        text.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok()).unwrap_or(0);
    format!("{value:.*}", places(digits - 1 - exponent))
}

/// `value` with this number of significant digits and an exponent.
pub(crate) fn scientific(value: f64, digits: usize) -> String {
    format!("{value:.*e}", digits.saturating_sub(1))
}

/// The largest number of one significant digit that is at most `value`.
pub(crate) fn below(value: f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor());
    if value > 0.0 { unit * (value / unit).floor() } else { value }
}

/// The smallest number of one significant digit that is at least `value`.
pub(crate) fn above(value: f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor());
    if value > 0.0 { unit * (value / unit).ceil() } else { value }
}

/// A number of decimal places; 0 instead of a negative one.
fn places(count: i32) -> usize {
    usize::try_from(count).unwrap_or(0)
}
