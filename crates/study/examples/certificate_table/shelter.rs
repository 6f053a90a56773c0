//! The shelter in four cases, three materials and two schedules, with contact and without.

use crate::checked::{Checked, Motion};
use crate::number::{above, below, rounded, scientific};
use crate::{Row, Table};

const CASES: [&str; 4] = ["E", "T", "S", "SII"];
const ROWS: usize = 7;
/// Shallower first penetrations have no digit that is the same on every machine: that of E near-rigid is 2.8e-4 h with vectors of 8
/// numbers and 2e-5 h with others.
const STEADY_DEPTH: f64 = 1e-3;
/// Each row begins and ends this part of the stage after the row before.
const DELAY: f64 = 0.02;

/// Both tables.
pub(crate) fn tables() -> Vec<Table> {
    vec![with_contact(), without_contact()]
}

fn with_contact() -> Table {
    let mut rows = Vec::new();
    for (material, schedules) in [
        ("default", &["uniform", "staggered"][..]),
        ("paper", &["uniform"]),
        ("near-rigid", &["uniform", "staggered"]),
    ] {
        for schedule in schedules {
            for case in CASES {
                let mut motion = Motion::of_shelter(case, material, true);
                if *schedule == "staggered" {
                    motion.settings.push(staggered());
                }
                let names = [case, material, schedule].map(str::to_owned).to_vec();
                rows.push(Row { names, motion });
            }
        }
    }
    Table {
        title: "With contact (gap 1e-3 h, 1e-5 h in the end). Separation in units of h, with the motion time at which it is smallest."
            .to_owned(),
        columns: [
            &["case", "material", "schedule"],
            &[
                "verdict",
                "separation",
                "t",
                "peak strain",
                "outcome",
                "second proof",
            ],
        ],
        rows,
        cells: |checked| {
            let [separation, t] = separation(checked);
            vec![
                checked.verdict(),
                separation,
                t,
                peak_strain(checked),
                checked.outcome(),
                checked.second_proof(),
            ]
        },
    }
}

fn without_contact() -> Table {
    let row = |sheet: &str, material: &str, motion| Row {
        names: [sheet, material].map(str::to_owned).to_vec(),
        motion,
    };
    let shelter = |case, material| row(case, material, Motion::of_shelter(case, material, false));
    let mut rows = Vec::from(CASES.map(|case| shelter(case, "default")));
    rows.extend(CASES.map(|case| shelter(case, "near-rigid")));
    let mut wide = Motion::of_shelter("S", "near-rigid", false);
    wide.settings.extend(["sheet.columns=5", "sheet.width=8.0"].map(str::to_owned));
    rows.push(row("S, 7 × 5, w = 1.6 h", "near-rigid", wide));
    for (scene, sheet) in [
        ("shelter-short-plain", "unmodified rectangles, w/h = 2.5"),
        ("shelter-tall-plain", "unmodified rectangles, w/h = 0.71"),
    ] {
        let motion = Motion { scene: scene.to_owned(), has_contact: false, settings: Vec::new() };
        rows.push(row(sheet, "default", motion));
    }
    Table {
        title: "Without contact, uniform schedule:".to_owned(),
        columns: [
            &["sheet", "material"],
            &["verdict", "first penetration", "peak strain", "outcome", "second proof"],
        ],
        rows,
        cells: |checked| {
            vec![
                checked.verdict(),
                first_penetration(checked),
                peak_strain(checked),
                checked.outcome(),
                checked.second_proof(),
            ]
        },
    }
}

impl Motion {
    /// The scene of `case`; the default material is the one of the scene.
    fn of_shelter(case: &str, material: &str, has_contact: bool) -> Self {
        let mut settings = Vec::new();
        if material != "default" {
            settings.push(format!("material.preset={material}"));
        }
        Self { scene: format!("shelter-{}", case.to_lowercase()), has_contact, settings }
    }
}

/// The setting by which row r moves from `DELAY` r to 1 − `DELAY` (6 − r) of stage fold.
fn staggered() -> String {
    let step = |row: usize| {
        let from = DELAY * row as f64;
        let to = 1.0 - DELAY * (ROWS - 1 - row) as f64;
        format!("{{stage=\"fold\", rows=[{row}], from={from:?}, to={to:?}}}")
    };
    let steps: Vec<String> = (0..ROWS).map(step).collect();
    format!("motion.step=[{}]", steps.join(", "))
}

/// The smallest separation and its motion time.
///
/// The last state of a motion that jams depends on rounding: only a bound is the same on every machine.
fn separation(checked: &Checked) -> [String; 2] {
    let none = || "-".to_owned();
    match checked.verified.certificate.min_separation {
        None => [none(), none()],
        Some(closest) if checked.is_finished() => {
            [scientific(closest.attained, 3), format!("{:.3}", closest.t)]
        }
        Some(closest) => [format!("> {}", scientific(below(closest.distance), 1)), none()],
    }
}

fn peak_strain(checked: &Checked) -> String {
    let stages = &checked.report.stages;
    let peak = stages.iter().map(|s| s.peak_strain).fold(0.0, f64::max);
    let percent = 100.0 * peak;
    if !checked.is_finished() {
        return format!("< {} %", rounded(above(percent), 1));
    }
    let digits = if percent < 1.0 { 2 } else { 3 };
    format!("{} %", rounded(percent, digits))
}

fn first_penetration(checked: &Checked) -> String {
    let Some(first) = checked.verified.certificate.penetrations.first() else {
        return "none".to_owned();
    };
    let depth = match first.depth {
        0.0 => first.kind.to_string(),
        depth if depth < STEADY_DEPTH => format!("depth < {STEADY_DEPTH:e} h"),
        depth => format!("depth {} h", scientific(depth, 1)),
    };
    format!("t = {:.3}, {depth}", first.t)
}
