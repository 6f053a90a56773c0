//! Sections that are neither report nor certificate.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::Page;
use super::html::escaped;
use super::payload::base64;
use crate::plots::time_axis;
use crate::{Panel, Provenance, RecordError, plots};

/// The plots as a picture: nothing in it can run.
pub(super) fn plotted(panels: &[Panel]) -> Result<String, RecordError> {
    if panels.is_empty() {
        return Ok(String::new());
    }
    let titles: Vec<&str> = panels.iter().map(|panel| panel.title).collect();
    let [left, right] = time_axis(panels).map(|(fraction, time)| json!([fraction, time]));
    Ok(format!(
        "<section>\n<h2>Plots</h2>\n<figure class=\"plots\" id=\"plots\" data-axis=\"[{left},{right}]\">\n\
         <img alt=\"Plots over motion time t: {}\" src=\"data:image/svg+xml;base64,{}\">\n\
         <div class=\"now\" id=\"plot-now\"></div>\n\
         <figcaption>Against motion time t. The line is the state shown above; press on the plots to move it.\
         </figcaption>\n</figure>\n</section>\n",
        escaped(&titles.join("; ")),
        base64(plots(panels)?.as_bytes())
    ))
}

/// The files that can be saved from the page.
pub(super) fn files(page: &Page<'_>) -> String {
    let row = |id: &str, name: &str, what: &str| {
        format!(
            "<li><button type=\"button\" id=\"save-{id}\" data-name=\"{name}\">{name}</button> {what}</li>\n"
        )
    };
    let mut rows = String::new();
    if page.fold.is_some() {
        let what = "the motion as computed, every frame in full precision, as FOLD 1.2";
        rows.push_str(&row("fold", "motion.fold", what));
    }
    if page.certificate.is_some() {
        let what = "what is proved of it; <code>foldmotion check motion.fold --verify certificate.json</code> proves it again";
        rows.push_str(&row("certificate", "certificate.json", what));
    }
    if rows.is_empty() {
        return rows;
    }
    format!("<section>\n<h2>Files</h2>\n<ul class=\"files\">\n{rows}</ul>\n</section>\n")
}

/// Who made the page, at its foot.
pub(super) fn origin(origin: &Provenance) -> String {
    let mut text = String::new();
    // Writing into a string cannot fail.
    if !origin.producer.is_empty() {
        let _ = write!(text, "Made by {}. ", escaped(&origin.producer));
    }
    if !origin.hash.is_empty() {
        let hash = escaped(&origin.hash);
        let _ = write!(text, "Motion <code>{hash}</code>. ");
    }
    if !origin.scene.is_empty() {
        let scene = escaped(&origin.scene);
        let _ = write!(text, "<details><summary>Scene</summary><pre>{scene}</pre></details>");
    }
    text
}

/// The provenance from which the page can be made again.
pub(super) fn provenance(origin: &Provenance) -> Value {
    json!({
        "title": origin.title,
        "producer": origin.producer,
        "scene": origin.scene,
        "hash": origin.hash,
    })
}
