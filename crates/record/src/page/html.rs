//! Text inside HTML.

use std::fmt::Write as _;

use serde_json::Value;

/// `text` as the text of an element or between the quotes of an attribute.
pub(super) fn escaped(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => html.push_str("&amp;"),
            '<' => html.push_str("&lt;"),
            '>' => html.push_str("&gt;"),
            '"' => html.push_str("&quot;"),
            '\'' => html.push_str("&#39;"),
            _ => html.push(letter),
        }
    }
    html
}

/// `value` as JSON that no script element ends in.
pub(super) fn data(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

/// A table of texts; the first column holds the names of the rows. Each cell knows the name of its column: a narrow
/// page shows cells as lines.
pub(super) fn table(caption: &str, head: &[&str], rows: &[Vec<String>]) -> String {
    let mut html = format!(
        "<div class=\"wide\"><table>\n<caption>{}</caption>\n<thead><tr>",
        escaped(caption)
    );
    // Writing into a string cannot fail.
    for name in head {
        let _ = write!(html, "<th scope=\"col\">{}</th>", escaped(name));
    }
    html.push_str("</tr></thead>\n<tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for (column, cell) in row.iter().enumerate() {
            let cell = escaped(cell);
            let _ = if column == 0 {
                write!(html, "<th scope=\"row\">{cell}</th>")
            } else {
                let name = escaped(head.get(column).copied().unwrap_or_default());
                write!(html, "<td data-name=\"{name}\">{cell}</td>")
            };
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody>\n</table></div>\n");
    html
}

/// Letters beyond which a text takes a line of its own.
const LONG: usize = 42;

/// Names beside texts; those without text are left out.
pub(super) fn facts(rows: &[(&str, Option<String>)]) -> String {
    let mut html = String::from("<dl>\n");
    for (name, text) in rows {
        if let Some(text) = text {
            let is_long = name.chars().count() + text.chars().count() > LONG;
            let class = if is_long { " class=\"long\"" } else { "" };
            let (name, text) = (escaped(name), escaped(text));
            let _ = writeln!(html, "<div{class}><dt>{name}</dt><dd>{text}</dd></div>");
        }
    }
    html.push_str("</dl>\n");
    html
}

/// A number as papers print it: six digits, powers of ten beyond 1e-3 and 1e6; `None` if `value` is not a number.
pub(super) fn number(value: &Value) -> Option<String> {
    if value.is_u64() || value.is_i64() {
        return Some(value.to_string().replace('-', "−"));
    }
    value.as_f64().map(|x| digits(x, 6))
}

/// `x` with `count` digits at most.
pub(super) fn digits(x: f64, count: u16) -> String {
    let after_first = count.saturating_sub(1);
    let scientific = format!("{x:.*e}", usize::from(after_first));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    let text = if x == 0.0 || (-3..6).contains(&power) {
        let decimals = (i32::from(after_first) - power).max(0);
        trimmed(&format!("{x:.*}", decimals.cast_unsigned() as usize)).to_owned()
    } else {
        let exponent: String = exponent.chars().map(raised).collect();
        match trimmed(mantissa) {
            "1" => format!("10{exponent}"),
            mantissa => format!("{mantissa} × 10{exponent}"),
        }
    };
    text.replace('-', "−")
}

/// Without the zeros that end a fraction.
fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

fn raised(letter: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match letter.to_digit(10) {
        Some(digit) => DIGITS[digit as usize],
        None => '⁻',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_printed_as_in_papers() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (-2.5, "−2.5"),
            (4.900_000_000_000_002, "4.9"),
            (1234.5678, "1234.57"),
            (0.001_5, "0.0015"),
            (1e-6, "10⁻⁶"),
            (-1.25e-14, "−1.25 × 10⁻¹⁴"),
            (3e8, "3 × 10⁸"),
            (999_999.9, "10⁶"),
            (f64::NAN, "NaN"),
        ];
        for (value, text) in cases {
            assert_eq!(digits(value, 6), text);
        }
        assert_eq!(number(&serde_json::json!(12_345_678)).unwrap(), "12345678");
        assert_eq!(number(&Value::Null), None);
    }

    #[test]
    fn text_ends_neither_its_element_nor_its_attribute_nor_its_script() {
        assert_eq!(escaped("</b>\"'&"), "&lt;/b&gt;&quot;&#39;&amp;");
        let text = data(&serde_json::json!("</script><!--"));
        assert!(!text.contains('<'));
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), "</script><!--");
    }
}
