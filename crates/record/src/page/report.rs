//! `report.json` as words and tables.
//!
//! Keys that are missing or of another shape are passed over: reports of other versions show what they share. Times,
//! threads and device are never shown.

use serde_json::Value;

use super::html::{digits, escaped, facts, number, table};

/// One value of the report in words.
fn text(report: &Value, pointer: &str) -> Option<String> {
    let value = report.pointer(pointer)?;
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Bool(is) => Some(if *is { "yes" } else { "no" }.to_owned()),
        _ => number(value),
    }
}

fn cell(report: &Value, pointer: &str) -> String {
    text(report, pointer).unwrap_or_else(|| "–".to_owned())
}

/// A number scaled and with few digits, such as a share as per cent.
fn scaled(report: &Value, pointer: &str, factor: f64) -> String {
    let value = report.pointer(pointer).and_then(Value::as_f64);
    value.map_or_else(|| "–".to_owned(), |x| digits(factor * x, 3))
}

fn list<'a>(report: &'a Value, pointer: &str) -> &'a [Value] {
    let list = report.pointer(pointer).and_then(Value::as_array);
    list.map_or(&[], Vec::as_slice)
}

/// The sentence below the title.
pub(super) fn lead(report: &Value) -> String {
    let mut parts = Vec::new();
    if let (Some(rows), Some(columns)) = (text(report, "/rows"), text(report, "/columns")) {
        let case = text(report, "/case").map_or(String::new(), |c| format!(" of case {c}"));
        parts.push(format!("{rows} × {columns} units{case}"));
    }
    let unit = text(report, "/length_unit").unwrap_or_default();
    if let (Some(w), Some(h)) = (text(report, "/unit/width"), text(report, "/unit/height")) {
        parts.push(format!("w = {w} {unit}, h = {h} {unit}"));
    }
    if let Some(facets) = text(report, "/pattern/facet_count") {
        parts.push(format!("{facets} facets"));
    }
    if parts.is_empty() {
        return String::new();
    }
    format!("<p class=\"lead\">{}</p>\n", escaped(&parts.join(" · ")))
}

/// The section of the report.
pub(super) fn section(report: &Value) -> String {
    let mut html = String::from("<section>\n<h2>Report</h2>\n");
    html.push_str(&compact_box(report));
    html.push_str(&stages(report));
    html.push_str(&stop(report));
    html.push_str(&sizes(report));
    html.push_str(&vertices(report));
    html.push_str("</section>\n");
    html
}

fn compact_box(report: &Value) -> String {
    let row = |name: &str, pointer: &str, show: &dyn Fn(&str) -> String| {
        report.pointer(pointer).filter(|v| v.is_object())?;
        let mut cells = vec![name.to_owned()];
        for key in ["extents/0", "extents/1", "extents/2", "area", "volume"] {
            cells.push(show(&format!("{pointer}/{key}")));
        }
        Some(cells)
    };
    let exact = |pointer: &str| cell(report, pointer);
    let percent = |pointer: &str| format!("{} %", scaled(report, pointer, 100.0));
    let rows: Vec<Vec<String>> = [
        row("closed form", "/closed_form", &exact),
        row("measured", "/compact", &exact),
        row("error", "/compact/relative_error", &percent),
    ]
    .into_iter()
    .flatten()
    .collect();
    if rows.is_empty() {
        return String::new();
    }
    let unit = text(report, "/length_unit").unwrap_or_else(|| "the file's unit".to_owned());
    table(
        &format!("The box around the compact state, in {unit}"),
        &["", "x", "y", "z", "area xz", "volume"],
        &rows,
    )
}

fn stages(report: &Value) -> String {
    let row = |stage: &Value| {
        vec![
            cell(stage, "/name"),
            scaled(stage, "/peak_strain", 100.0),
            scaled(stage, "/mean_strain", 100.0),
            scaled(stage, "/peak_facet_bending_deg", 1.0),
            cell(stage, "/converged"),
        ]
    };
    let rows: Vec<Vec<String>> = list(report, "/stages").iter().map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let head =
        ["stage", "largest strain, %", "mean strain, %", "largest facet bending, °", "converged"];
    table("The stages of the motion", &head, &rows)
}

/// The evidence that the motion stopped before its end.
fn stop(report: &Value) -> String {
    let Some(time) = text(report, "/stop/t") else {
        return String::new();
    };
    let force = |key: &str| {
        let value = report.pointer(key).and_then(Value::as_f64);
        value.map_or_else(String::new, |value| digits(value, 2))
    };
    format!(
        "<p class=\"warning\">No equilibrium was found beyond t = {}: the unbalanced force left was {}, where {} counts as equilibrium.</p>\n",
        escaped(&time),
        force("/stop/residual"),
        force("/stop/residual_tolerance")
    )
}

/// How the motion ended and why, with a sign, so that no one needs to tell colours apart; nothing for a report without
/// it.
pub(super) fn outcome(report: &Value) -> String {
    let (Some(kind), Some(time)) =
        (text(report, "/outcome/kind"), report.pointer("/outcome/t").and_then(Value::as_f64))
    else {
        return String::new();
    };
    let (sign, class) = match kind.as_str() {
        "folded" => ("✓", "good"),
        "collides" => ("✗", "bad"),
        _ => ("!", "open"),
    };
    let headline = match kind.as_str() {
        "folded" => kind,
        "not-converged" => "did not converge".to_owned(),
        _ => format!("{} at t = {}", escaped(&kind), digits(time, 5)),
    };
    let reason = text(report, "/outcome/reason").unwrap_or_default();
    format!(
        "<p class=\"verdict {class}\"><strong><span aria-hidden=\"true\">{sign}</span> {headline}</strong> {}</p>\n",
        escaped(&reason)
    )
}

fn sizes(report: &Value) -> String {
    let unit = text(report, "/length_unit").unwrap_or_default();
    let length = |pointer: &str| text(report, pointer).map(|x| format!("{x} {unit}"));
    let residual = || {
        let largest = report.pointer("/division/max_residual")?.as_f64()?;
        let method = text(report, "/division/method")?;
        Some(format!("{method}, |R_max| = {}", digits(largest, 2)))
    };
    let separation = || {
        let least = report.pointer("/collision/min_separation")?.as_f64()?;
        let at = scaled(report, "/collision/min_separation_t", 1.0);
        Some(format!("{} h at t = {at}", digits(least, 3)))
    };
    let straying = || {
        let straying = report.pointer("/path/straying")?.as_f64()?;
        Some(format!("≈ {} h", digits(straying, 2)))
    };
    facts(&[
        ("profile", text(report, "/profile/source")),
        ("division", residual()),
        ("flap a", length("/unit/flap")),
        ("side pad s", length("/unit/side_pad")),
        ("centre pad 2d", length("/unit/centre_pad")),
        ("vertices", text(report, "/pattern/vertex_count")),
        ("triangles", text(report, "/pattern/face_count")),
        ("developable", text(report, "/pattern/developable")),
        ("locally flat-foldable", text(report, "/pattern/flat_foldable")),
        ("unfolded by", text(report, "/unfold/method")),
        ("engine", text(report, "/engine/name")),
        ("contact gap, h", text(report, "/engine/contact_gap")),
        ("in the last state, h", text(report, "/engine/final_gap")),
        ("frames", text(report, "/path/frames")),
        ("straight paths stray", straying()),
        ("smallest separation", separation()),
        ("pairs of triangles judged", text(report, "/collision/pairs_tested")),
        ("pairs that touch", text(report, "/collision/touching_pairs")),
    ])
}

fn vertices(report: &Value) -> String {
    let row = |kind: &Value| {
        vec![
            cell(kind, "/type"),
            cell(kind, "/degree"),
            cell(kind, "/count"),
            cell(kind, "/mountains_minus_valleys"),
            format!("{}°", cell(kind, "/angle_sum_deg")),
            cell(kind, "/flat_foldable"),
        ]
    };
    let rows: Vec<Vec<String>> = list(report, "/pattern/vertices").iter().map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = ["type", "creases", "vertices", "M − V", "angles sum to", "locally flat-foldable"];
    format!(
        "<details>\n<summary>Interior vertices of the crease pattern</summary>\n{}</details>\n",
        table("Interior vertices by type", &head, &rows)
    )
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_page_is_headed_by_the_outcome_and_a_good_sign_stands_only_before_a_folded_sheet() {
        let ended =
            |kind: &str| outcome(&json!({"outcome": {"kind": kind, "t": 1.25, "reason": "a < b"}}));
        assert!(ended("jammed").contains("!</span> jammed at t = 1.25"));
        assert!(ended("jammed").contains("a &lt; b"));
        assert!(ended("stopped").contains("stopped at t = 1.25"));
        assert!(ended("not-converged").contains("did not converge</strong>"));
        assert!(ended("collides").contains("class=\"verdict bad\""));
        assert!(ended("folded").contains("class=\"verdict good\""));
        for kind in ["jammed", "stopped", "not-converged", "collides", "undecided"] {
            assert!(!ended(kind).contains("good"), "{kind}");
        }
        assert_eq!(outcome(&json!({"title": "no outcome"})), "");
        let stop = json!({"t": 1.25, "residual": 0.5, "residual_tolerance": 1e-9});
        assert!(
            section(&json!({"stop": stop})).contains("No equilibrium was found beyond t = 1.25")
        );
        assert!(!section(&json!({"stop": null})).contains("No equilibrium"));
    }
}
