//! From what was found out about a motion to the curves under the timeline.

use foldmotion_check::FittedBox;
use foldmotion_pattern::CompactBox;
use foldmotion_study::FrameFigures;

use crate::timeline::{Curve, Curves, Panel};

/// Strain, bending, energy and separation of every frame, and its box against the closed form.
pub(crate) fn curves(
    series: &[FrameFigures],
    boxes: &[FittedBox],
    closed_form: Option<CompactBox>,
    unit: &str,
) -> Curves {
    let mut panels = figures(series);
    panels.extend(box_panels(series, boxes, closed_form, unit));
    Curves { panels }
}

fn figures(series: &[FrameFigures]) -> Vec<Panel> {
    let curve = |name, value: fn(&FrameFigures) -> f64| Curve {
        name,
        points: series.iter().map(|f| [f.time, value(f)]).collect(),
    };
    let panel = |title: &str, about, is_logarithmic, curves| Panel {
        title: title.to_owned(),
        about,
        is_logarithmic,
        curves,
        reference: None,
    };
    let mut energy = vec![
        curve("bars", |f| f.energy.bars),
        curve("creases", |f| f.energy.creases),
        curve("facets", |f| f.energy.facets),
    ];
    if series.iter().any(|f| f.contacts > 0) {
        energy.push(curve("contact", |f| f.contact_energy));
    }
    vec![
        panel(
            "bar strain, %",
            "|l/l₀ − 1| of all edges: 0 where the sheet folds rigidly",
            false,
            vec![
                curve("largest", |f| 100.0 * f.peak_strain),
                curve("mean", |f| 100.0 * f.mean_strain),
            ],
        ),
        panel(
            "facet bending, degrees",
            "the largest fold angle inside a facet",
            false,
            vec![curve("largest", |f| f.peak_bending_deg)],
        ),
        panel("energy", "in units of EA·h at EA = 1", false, energy),
        panel(
            "separation, h",
            "the smallest distance of facets that share no vertex",
            true,
            vec![curve("smallest", |f| f.separation)],
        ),
    ]
    .into_iter()
    .filter(Panel::has_values)
    .collect()
}

fn box_panels(
    series: &[FrameFigures],
    boxes: &[FittedBox],
    closed_form: Option<CompactBox>,
    unit: &str,
) -> Vec<Panel> {
    if boxes.len() != series.len() {
        return Vec::new();
    }
    let panel = |title: String, about, value: fn(&FittedBox) -> f64, form: Option<f64>| {
        let points = series.iter().zip(boxes);
        Panel {
            title,
            about,
            is_logarithmic: false,
            curves: vec![Curve {
                name: "box",
                points: points.map(|(f, b)| [f.time, value(b)]).collect(),
            }],
            reference: form.map(|value| (value, "closed form")),
        }
    };
    vec![
        panel(
            format!("area x·z, {unit}²"),
            "of the bounding box, against the area of the compact state in closed form (equations 3 to 7)",
            |b| b.area,
            closed_form.map(|form| form.area),
        ),
        panel(
            format!("volume, {unit}³"),
            "of the bounding box, against the volume of the compact state in closed form (equations 3 to 7)",
            |b| b.volume,
            closed_form.map(|form| form.volume),
        ),
    ]
}
