//! The plots of a motion, from the findings of its check.

use foldmotion_check::FittedBox;
use foldmotion_pattern::CompactBox;
use foldmotion_study::FrameFigures;

use crate::timeline::{Curve, Plot, Plots};

/// Strain, bending, energy and separation of every frame, and its box compared with the closed form.
pub(crate) fn plots_of(
    series: &[FrameFigures],
    boxes: &[FittedBox],
    closed_form: Option<CompactBox>,
    unit: &str,
) -> Plots {
    let mut plots = frame_plots(series);
    plots.extend(box_plots(series, boxes, closed_form, unit));
    Plots { plots }
}

fn frame_plots(series: &[FrameFigures]) -> Vec<Plot> {
    let curve = |name, value: fn(&FrameFigures) -> f64| Curve {
        name,
        points: series.iter().map(|f| [f.time, value(f)]).collect(),
    };
    let plot = |title: &str, about, is_logarithmic, curves| Plot {
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
        plot(
            "bar strain, %",
            "Strain |l/l₀ − 1| of all edges; 0 if the sheet folds rigidly",
            false,
            vec![
                curve("largest", |f| 100.0 * f.peak_strain),
                curve("mean", |f| 100.0 * f.mean_strain),
            ],
        ),
        plot(
            "facet bending, degrees",
            "Largest fold angle inside a facet",
            false,
            vec![curve("largest", |f| f.peak_bending_deg)],
        ),
        plot("energy", "Energy in units of EA·h at EA = 1", false, energy),
        plot(
            "separation, h",
            "Smallest distance between facets without a common vertex",
            true,
            vec![curve("smallest", |f| f.separation)],
        ),
    ]
    .into_iter()
    .filter(Plot::has_values)
    .collect()
}

fn box_plots(
    series: &[FrameFigures],
    boxes: &[FittedBox],
    closed_form: Option<CompactBox>,
    unit: &str,
) -> Vec<Plot> {
    if boxes.len() != series.len() {
        return Vec::new();
    }
    let plot = |title: String, about, value: fn(&FittedBox) -> f64, form: Option<f64>| {
        let points = series.iter().zip(boxes);
        Plot {
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
        plot(
            format!("area x·z, {unit}²"),
            "Area of the bounding box, compared with the closed form of the compact state (equations 3 to 7)",
            |b| b.area,
            closed_form.map(|form| form.area),
        ),
        plot(
            format!("volume, {unit}³"),
            "Volume of the bounding box, compared with the closed form of the compact state (equations 3 to 7)",
            |b| b.volume,
            closed_form.map(|form| form.volume),
        ),
    ]
}
