//! Numbers and words as SVG and DXF take them.

/// A length in mm to 1e-9 mm, without trailing zeros or exponent.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.9}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// Words for XML: markup escaped, what XML 1.0 forbids as spaces.
pub(super) fn xml(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

/// Words for a line of DXF R12: one line of ASCII, other letters as `?`.
pub(super) fn ascii(text: &str) -> String {
    let plain = |letter: char| match letter {
        c if c.is_control() => ' ',
        c if c.is_ascii() => c,
        _ => '?',
    };
    // Readers limit lines to 255 letters.
    text.chars().map(plain).take(200).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_keep_a_billionth_of_a_millimetre() {
        assert_eq!(number(100.0), "100");
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(-1e-12), "0");
        assert_eq!(number(714.285_714_285_714_2), "714.285714286");
        assert_eq!(number(1e-9), "0.000000001");
    }

    #[test]
    fn text_cannot_break_out_of_its_element() {
        assert_eq!(xml("a<b>&\"c\"\n\u{0}"), "a&lt;b&gt;&amp;&quot;c&quot;  ");
        assert_eq!(ascii("a\n0\nEOF é"), "a 0 EOF ?");
    }
}
