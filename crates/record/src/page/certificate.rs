//! `certificate.json` as words and tables: what is proved of the motion, and under which assumptions.

use std::fmt::Write as _;

use serde_json::Value;

use super::html::{digits, escaped, facts, number, table};

/// The most rows of a table; files hold the rest.
const MOST_ROWS: usize = 20;

/// The verdict as a word with a sign, so that no one needs to tell colours apart.
pub(super) fn badge(verdict: Option<&str>) -> String {
    let Some(verdict) = verdict else {
        return String::new();
    };
    let (sign, class, meaning) = match verdict {
        "free" => ("✓", "good", "no facets come within the tolerance of each other"),
        "touching" => {
            ("✓", "good", "facets lie on each other and leave on the side they came from")
        }
        "penetrating" => ("✗", "bad", "the sheet passes through itself"),
        _ => ("?", "open", "not decided"),
    };
    let verdict = escaped(verdict);
    format!(
        "<p class=\"verdict {class}\"><strong><span aria-hidden=\"true\">{sign}</span> {verdict}</strong> {meaning}</p>\n"
    )
}

/// The section of the certificate.
pub(super) fn section(certificate: &Value) -> String {
    let mut html = String::from("<section>\n<h2>Certificate</h2>\n");
    html.push_str(&statement(certificate));
    html.push_str(&penetrations(certificate));
    html.push_str(&undecided(certificate));
    let assumptions = list(certificate, "/assumptions");
    if !assumptions.is_empty() {
        html.push_str("<h3>Assumptions</h3>\n<ul class=\"assumptions\">\n");
        for text in assumptions.iter().filter_map(Value::as_str) {
            let _ = writeln!(html, "<li>{}</li>", escaped(text));
        }
        html.push_str("</ul>\n");
    }
    html.push_str("</section>\n");
    html
}

fn list<'a>(value: &'a Value, pointer: &str) -> &'a [Value] {
    let list = value.pointer(pointer).and_then(Value::as_array);
    list.map_or(&[], Vec::as_slice)
}

fn statement(certificate: &Value) -> String {
    let text = |pointer: &str| match certificate.pointer(pointer)? {
        Value::String(text) => Some(text.clone()),
        value => number(value),
    };
    let digits_at = |pointer: &str, count| {
        let x = certificate.pointer(pointer)?.as_f64()?;
        Some(digits(x, count))
    };
    let frames = || {
        let (first, last) = (text("/times/0")?, text("/times/1")?);
        Some(format!("{}, t = {first} to {last}", text("/frames")?))
    };
    let separation = || {
        let distance = digits_at("/min_separation/distance", 4)?;
        Some(format!("{distance} at t = {}", digits_at("/min_separation/t", 4)?))
    };
    facts(&[
        ("verdict", text("/verdict")),
        ("tolerance", text("/tolerance")),
        ("unit of the tolerance", text("/unit_length")),
        ("frames", frames()),
        ("judged only up to t", text("/stopped/t")),
        ("triangles", text("/triangles")),
        ("smallest separation", separation()),
        ("SHA-256 of the motion file", text("/sha256")),
    ])
}

/// Two faces, by their facets where the file names some.
fn pair(entry: &Value) -> String {
    let of = |key: &str| {
        let numbers = entry.pointer(key)?;
        Some(format!("{} and {}", number(numbers.get(0)?)?, number(numbers.get(1)?)?))
    };
    let facets = of("/pair/facets").map(|pair| format!("facets {pair}"));
    let pair = facets.or_else(|| Some(format!("faces {}", of("/pair/faces")?)));
    pair.unwrap_or_default()
}

fn time(entry: &Value) -> String {
    let time = entry.get("t").and_then(Value::as_f64);
    time.map_or_else(|| "–".to_owned(), |t| digits(t, 6))
}

fn penetrations(certificate: &Value) -> String {
    let row = |entry: &Value| {
        let kind = entry.get("kind").and_then(Value::as_str).unwrap_or("–");
        let depth = entry.get("depth").and_then(Value::as_f64);
        let depth = depth.map_or_else(|| "–".to_owned(), |d| digits(d, 3));
        vec![time(entry), pair(entry), kind.to_owned(), depth]
    };
    rows("Penetrations", certificate, "/penetrations", &["t", "between", "kind", "depth"], &row)
}

fn undecided(certificate: &Value) -> String {
    let row = |entry: &Value| vec![time(entry), pair(entry)];
    rows("Undecided pairs", certificate, "/undecided", &["certified up to t", "between"], &row)
}

fn rows(
    caption: &str,
    certificate: &Value,
    pointer: &str,
    head: &[&str],
    row: &dyn Fn(&Value) -> Vec<String>,
) -> String {
    let entries = list(certificate, pointer);
    if entries.is_empty() {
        return String::new();
    }
    let shown: Vec<Vec<String>> = entries.iter().take(MOST_ROWS).map(row).collect();
    let caption = match entries.len() {
        count if count > MOST_ROWS => format!("{caption}: the first {MOST_ROWS} of {count}"),
        count => format!("{caption}: {count}"),
    };
    table(&caption, head, &shown)
}
