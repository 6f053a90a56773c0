//! `index.html`: the paper's numbers, ours and the differences, with all figures.

use foldmotion_check::Verdict;
use std::fmt::Write as _;

use super::figures::Figure;
use super::record::{CaseRow, MotionRow, PaperRecord};
use foldmotion_study::report::BoxReport;

/// The style sheet of the page.
const STYLE: &str = include_str!("page.css");

/// The text of a missing value.
const NONE: &str = "–";

/// The text of the page.
pub(super) fn page(record: &PaperRecord, figures: &[Figure]) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>Foldable cylindrical surfaces: the paper beside foldmotion</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <h1>Constructing foldable cylindrical surfaces via unfolded waterbomb origami units</h1>\n\
         <p>The tables and figures of the paper as foldmotion {} reproduces them: the paper's number, ours, and the \
         difference. Lengths are in units of the rows' height h. The same numbers are in <code>paper.json</code>.</p>\n",
        record.version
    );
    page.push_str(&table1(record));
    page.push_str(&table2(record));
    page.push_str(&boxes(record));
    page.push_str(&certificates(record));
    page.push_str(&unfoldings(record));
    page.push_str(&problems(record));
    for figure in figures {
        let (row, svg) = (&figure.row, &figure.svg);
        let caption = marked(&row.caption);
        let _ = write!(
            page,
            "<figure id=\"{}\">\n{svg}<figcaption>{caption} <a href=\"{}\">SVG</a>, <a href=\"{}\">PNG</a></figcaption>\n</figure>\n",
            row.name, row.files[0], row.files[1]
        );
    }
    page.push_str("</body>\n</html>\n");
    page
}

fn table1(record: &PaperRecord) -> String {
    let head = "profile; N_r × N_c; |R_max| paper; ours; difference; |R_ave| paper; ours; difference; \
                T (s) paper; ours; difference";
    let rows = record.table1.iter().map(|row| {
        let printed = &row.paper;
        let mut cells = vec![row.model.clone(), format!("{} × {}", row.rows, row.columns)];
        for (paper, ours) in
            [(printed.max_residual, row.max_residual), (printed.mean_residual, row.mean_residual)]
        {
            cells.extend([paper, ours, ours - paper].map(|value| format!("{value:.3e}")));
        }
        let (paper, ours) = (printed.seconds, row.seconds);
        cells.extend([format!("{paper:.3}"), format!("{ours:.6}"), format!("{:.3}", ours - paper)]);
        cells
    });
    let words = "Residuals of the division into equal segments (equation 1). The paper's times were measured on another \
                 machine (Intel i5-9300H) with its own starting values; ours are the least of five divisions.";
    section("Table 1", words, head, rows)
}

fn table2(record: &PaperRecord) -> String {
    let head = "profile; figure; paper: E; T; S, SII; ours: E; T; S, SII; ";
    let rows = record.table2.iter().map(|row| {
        let counts = |rows: usize, columns: [usize; 3]| columns.map(|c| format!("{rows} × {c}"));
        let mut cells = vec![row.model.clone()];
        match &row.paper {
            Some(paper) => {
                cells.push(paper.figure.clone());
                cells.extend(counts(paper.rows, paper.columns));
            }
            None => cells.extend([NONE; 4].map(str::to_owned)),
        }
        cells.extend(counts(row.rows, row.columns));
        let is_same = row.paper.as_ref().map(|p| (p.rows, p.columns) == (row.rows, row.columns));
        let remark = match is_same {
            Some(true) => "as printed",
            Some(false) => "differs",
            None => "T, S and SII are our choice",
        };
        cells.push(remark.to_owned());
        cells
    });
    section("Table 2", "Units N_r × N_c of one target (Γ, W) in each case.", head, rows)
}

fn boxes(record: &PaperRecord) -> String {
    let head = "profile; case; N_r × N_c; w/h; A paper; exact state; difference; simulated; relative error; \
                V paper; exact state; difference; simulated; relative error";
    let rows = record.cases.iter().map(|row| {
        let mut cells = name_of(row);
        cells.push(format!("{:.4}", row.unit_width));
        let errors = row.simulated_error.map(|error| (error.area, error.volume)).unzip();
        let values: [fn(&BoxReport) -> f64; 2] = [|b| b.area, |b| b.volume];
        for (value, error) in values.into_iter().zip([errors.0, errors.1]) {
            let (paper, exact) = (value(&row.closed_form), value(&row.exact));
            let simulated = row.simulated.as_ref().map(value);
            cells.push(format!("{paper:.6}"));
            cells.push(format!("{exact:.6}"));
            cells.push(format!("{:.1e}", exact - paper));
            cells.push(simulated.map_or(NONE.to_owned(), |v| format!("{:.6}", v + 0.0)));
            cells.push(error.map_or(NONE.to_owned(), |v| format!("{v:.1e}")));
        }
        cells
    });
    let words = "Area A (x–z plane) and volume V of the compact state's box: the paper's closed forms (equations 3 to 7), the \
                 exact state, and the state that the simulation without contact reaches; its error is divided by the \
                 closed form or, if that is 0, by h² or h³. N_c marked * are ours.";
    section("Areas and volumes of every case", words, head, rows)
}

fn certificates(record: &PaperRecord) -> String {
    let head = "profile; case; N_r × N_c; contact; verdict; first penetration t; least separation / h; \
                reached t; jam t; peak strain; frames; largest error of an extent; rms to exact / h";
    let mut rows = Vec::new();
    for row in &record.cases {
        for (words, motion) in [("on", &row.certificate), ("off", &row.motion)] {
            if let Some(motion) = motion {
                let mut cells = name_of(row);
                cells.push(words.to_owned());
                cells.extend(motion_cells(motion));
                rows.push(cells);
            }
        }
    }
    let words = "Motions of the default material (Origami Simulator's stiffness), in equilibrium along the schedule. The \
                 verdict is about the recorded frames and straight paths between them, within 1e-6 h. With contact, layers \
                 keep a gap, so that the compact box is larger than the closed form of a sheet without thickness.";
    section("Certificates", words, head, rows.into_iter())
}

fn motion_cells(motion: &MotionRow) -> Vec<String> {
    let optional = |value: Option<f64>| value.map_or(NONE.to_owned(), |v| format!("{v:.4}"));
    let extents = motion.error.extents.iter().map(|e| e.abs());
    vec![
        motion.verdict.to_string(),
        optional(motion.first_penetration_t),
        motion.min_separation.map_or(NONE.to_owned(), |s| format!("{s:.1e}")),
        format!(
            "{}{}",
            motion.reached_t,
            if motion.converged { "" } else { " (not in equilibrium)" }
        ),
        optional(motion.jam_t),
        format!("{:.1e}", motion.peak_strain),
        motion.frames.to_string(),
        format!("{:.1e}", extents.fold(0.0, f64::max)),
        format!("{:.1e}", motion.rms_to_exact),
    ]
}

fn unfoldings(record: &PaperRecord) -> String {
    let head = "profile; N_r; path; verdict; crosses at this part of the remaining path; \
                proved clear at every instant; frames";
    let rows = record.unfoldings.iter().map(|row| {
        vec![
            row.model.clone(),
            row.rows.to_string(),
            row.method.clone(),
            row.verdict.to_string(),
            row.crosses_at.map_or(NONE.to_owned(), |part| format!("{part:.4}")),
            if row.proved { "yes" } else { NONE }.to_owned(),
            row.frames.to_string(),
        ]
    });
    let words = "From the deployed state into the plane, rows rigid: uniform scales all hinge angles alike; energy follows the \
                 descent of Cantarella, Demaine, Iben and O'Brien (2004). Closed profiles touch at their seam when deployed.";
    section("Unfolding", words, head, rows)
}

/// The motions that penetrate, jam or stay undecided, in words.
fn problems(record: &PaperRecord) -> String {
    let mut list = String::new();
    let mut add = |words: String| {
        let _ = writeln!(list, "<li>{words}</li>");
    };
    for row in &record.unfoldings {
        if let Some(part) = row.crosses_at {
            add(format!(
                "{}, unfolded on the path “{}”: passes through itself once {part:.3} of the path remains.",
                row.model, row.method
            ));
        }
    }
    for row in &record.cases {
        for (contact, motion) in [("with", &row.certificate), ("without", &row.motion)] {
            let Some(motion) = motion else { continue };
            let name = format!("{}, case {}, {contact} contact", row.model, row.case);
            if let Some(t) = motion.first_penetration_t {
                add(format!("{name}: penetrates, first at t = {t:.4}."));
            }
            if let Some(t) = motion.jam_t {
                add(format!("{name}: jams at t = {t:.4}."));
            }
            if motion.verdict == Verdict::Undecided || !motion.converged {
                add(format!("{name}: {}, reached t = {}.", motion.verdict, motion.reached_t));
            }
        }
    }
    if list.is_empty() {
        return String::new();
    }
    format!("<h2>Where motions penetrate, jam or stay undecided</h2>\n<ul>\n{list}</ul>\n")
}

fn name_of(row: &CaseRow) -> Vec<String> {
    let mark = if row.columns_ours { " *" } else { "" };
    vec![row.model.clone(), row.case.clone(), format!("{} × {}{mark}", row.rows, row.columns)]
}

/// A table with a title and an introduction; `head` has the names of its columns, separated by `; `.
fn section(
    title: &str,
    words: &str,
    head: &str,
    rows: impl Iterator<Item = Vec<String>>,
) -> String {
    let mut body = String::new();
    for row in rows {
        body.push_str("<tr>");
        for cell in row {
            let class = match cell.as_str() {
                "penetrating" | "undecided" | "differs" => " class=\"fault\"",
                "free" | "touching" | "as printed" => " class=\"good\"",
                _ => "",
            };
            let _ = write!(body, "<td{class}>{}</td>", escaped(&cell));
        }
        body.push_str("</tr>\n");
    }
    if body.is_empty() {
        return String::new();
    }
    let head = marked(head).replace("; ", "</th><th>");
    let words = marked(words);
    format!(
        "<h2>{title}</h2>\n<p>{words}</p>\n<div><table>\n<thead><tr><th>{head}</th></tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n"
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// A text in which `_x` becomes a subscript.
fn marked(text: &str) -> String {
    let text = escaped(text);
    let mut parts = text.split('_');
    let mut marked = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| !c.is_alphanumeric()).unwrap_or(part.len());
        let (low, rest) = part.split_at(end);
        let _ = write!(marked, "<sub>{low}</sub>{rest}");
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subscripts_are_marked_and_signs_are_escaped() {
        assert_eq!(
            marked("|R_max| < N_r × N_c"),
            "|R<sub>max</sub>| &lt; N<sub>r</sub> × N<sub>c</sub>"
        );
        assert_eq!(marked("plain"), "plain");
    }
}
