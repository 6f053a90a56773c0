//! The verdict panel: the outcome of a run or a check, and the numbers behind it.

use eframe::egui::{Color32, CornerRadius, Frame, Grid, Link, Margin, RichText, ScrollArea, Ui};
use foldmotion_check::Verdict;
use foldmotion_study::Report;
use foldmotion_study::report::{OutcomeKind, PenetrationReport, StageReport};

use crate::work::CheckedMotion;

/// Shows `report`; returns the motion time that was clicked, if any.
pub(crate) fn results(ui: &mut Ui, report: &Report) -> Option<f64> {
    let mut chosen = None;
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        chosen = outcome(ui, report);
        ui.add_space(6.0);
        boxes(ui, report);
        for stage in &report.stages {
            ui.add_space(6.0);
            chosen = stage_rows(ui, stage).or(chosen);
        }
        ui.add_space(6.0);
        engine(ui, report);
    });
    chosen
}

/// Shows what is known about a motion file; returns the motion time that was clicked, if any.
pub(crate) fn file_results(
    ui: &mut Ui,
    title: &str,
    judged: Option<&CheckedMotion>,
) -> Option<f64> {
    ui.strong(title);
    let Some(judged) = judged else {
        ui.label("Checking for collisions…");
        return None;
    };
    let certificate = &judged.certificate;
    let collision = &judged.findings.collision;
    let colour = verdict_colour(ui, certificate.verdict);
    ui.label(RichText::new(certificate.verdict.name()).size(20.0).strong().color(colour));
    ui.label(format!(
        "{} pairs tested between {} frames, tolerance {:.0e} units of length",
        collision.pairs_tested.total(),
        certificate.frames,
        certificate.tolerance
    ));
    if let Some(stopped) = &certificate.stopped {
        ui.label(stopped.line());
    }
    let mut chosen = None;
    if let Some(first) = &collision.first {
        let words = format!(
            "triangles {} and {}, {:.2e} deep, at",
            first.faces[0], first.faces[1], first.depth
        );
        chosen = time_link(ui, &words, first.time);
    }
    if collision.penetrations.len() > 1 {
        ui.label(format!("{} pairs of triangles penetrate", collision.penetrations.len()));
    }
    if let Some(separation) = &collision.min_separation {
        let words = format!("smallest separation {:.2e} at", separation.distance);
        chosen = time_link(ui, &words, separation.time).or(chosen);
    }
    chosen
}

/// The colour of a verdict.
pub(crate) fn verdict_colour(ui: &Ui, verdict: Verdict) -> Color32 {
    let is_dark = ui.visuals().dark_mode;
    match (verdict, is_dark) {
        (Verdict::Free | Verdict::Touching, true) => Color32::from_rgb(92, 196, 120),
        (Verdict::Free | Verdict::Touching, false) => Color32::from_rgb(20, 118, 52),
        (Verdict::Penetrating, _) => ui.visuals().error_fg_color,
        (Verdict::Undecided, _) => ui.visuals().warn_fg_color,
    }
}

/// The colour of an outcome.
pub(crate) fn outcome_colour(ui: &Ui, kind: OutcomeKind) -> Color32 {
    let as_verdict = match kind {
        OutcomeKind::Folded => Verdict::Free,
        OutcomeKind::Collides => Verdict::Penetrating,
        _ => Verdict::Undecided,
    };
    verdict_colour(ui, as_verdict)
}

fn outcome(ui: &mut Ui, report: &Report) -> Option<f64> {
    let collision = &report.collision;
    let colour = outcome_colour(ui, report.outcome.kind);
    let mut chosen = None;
    let frame = Frame::new()
        .fill(colour.gamma_multiply(0.14))
        .corner_radius(CornerRadius::same(4))
        .inner_margin(Margin::same(8));
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.label(RichText::new(report.outcome.headline()).size(20.0).strong().color(colour));
        ui.label(&report.outcome.reason);
        ui.label(format!(
            "{}: {} pairs tested between {} frames, tolerance {:.0e} h",
            collision.verdict, collision.pairs_tested, report.path.frames, collision.tolerance
        ))
        .on_hover_text(
            "Free: no two facets come within the tolerance of each other. Touching: some do, and separate again on \
             the same side. Penetrating: some overlap by more than the tolerance, or separate on the other side. Undecided: \
             neither could be proved.",
        );
        if let Some(first) = &collision.first {
            chosen = penetration(ui, first);
        }
        if collision.penetrating_pairs > 1 {
            ui.label(format!("{} pairs of facets penetrate", collision.penetrating_pairs));
        }
        if let Some(stopped) = &collision.stopped {
            ui.label(stopped.line());
        }
        if collision.undecided_pairs > 0 {
            ui.label(format!("{} pairs are undecided", collision.undecided_pairs));
        }
        if let (Some(distance), Some(t)) = (collision.min_separation, collision.min_separation_t) {
            chosen = time_link(ui, &format!("smallest separation {distance:.2e} h at"), t).or(chosen);
        }
        if let Some(jam) = &report.jam {
            let words = format!("jammed {:.1}° from its target at", jam.fold_angle_error_deg);
            chosen = time_link(ui, &words, jam.t).or(chosen);
        }
    });
    chosen
}

fn penetration(ui: &mut Ui, first: &PenetrationReport) -> Option<f64> {
    let units = first.units.as_ref().map_or_else(String::new, |[a, b]| {
        format!(" (row {}, column {} and row {}, column {})", a.row, a.column, b.row, b.column)
    });
    let words = format!(
        "{}: facets {} and {}{units}, {:.2e} h deep, at",
        first.kind, first.facets[0], first.facets[1], first.depth
    );
    time_link(ui, &words, first.t)
}

/// Text followed by a motion time as a link; returns the time if it was clicked.
fn time_link(ui: &mut Ui, words: &str, t: f64) -> Option<f64> {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label(words);
        let link = ui.add(Link::new(format!("t\u{a0}=\u{a0}{t:.4}")));
        link.on_hover_text("Go to this motion time").clicked().then_some(t)
    })
    .inner
}

fn boxes(ui: &mut Ui, report: &Report) {
    let unit = &report.length_unit;
    ui.strong(format!("compact box, {unit}"));
    Grid::new("compact box").num_columns(4).striped(true).show(ui, |ui| {
        let about = "Equations 3 to 7 of the paper";
        ui.label("");
        ui.weak("measured");
        ui.weak("closed form").on_hover_text(about);
        ui.weak("error").on_hover_text(about);
        ui.end_row();
        let (compact, form) = (&report.compact, report.closed_form.as_ref());
        let error = compact.relative_error.as_ref();
        let extents = ["x, length", "y, width", "z, flaps"].into_iter().enumerate();
        let extents = extents.map(|(k, name)| {
            let form = form.map(|f| f.extents[k]);
            let error = error.map(|e| e.extents[k]);
            (name, compact.extents[k], form, error)
        });
        let (form_area, error_area) = (form.map(|f| f.area), error.map(|e| e.area));
        let (form_volume, error_volume) = (form.map(|f| f.volume), error.map(|e| e.volume));
        let sizes = [
            ("area x·z", compact.area, form_area, error_area),
            ("volume", compact.volume, form_volume, error_volume),
        ];
        for (name, value, form, error) in extents.chain(sizes) {
            ui.label(name);
            ui.label(format!("{value:.5}"));
            ui.label(form.map_or_else(|| "–".to_owned(), |v| format!("{v:.5}")));
            ui.label(error.map_or_else(|| "–".to_owned(), |v| format!("{v:+.1e}")));
            ui.end_row();
        }
    });
}

fn stage_rows(ui: &mut Ui, stage: &StageReport) -> Option<f64> {
    let mut chosen = None;
    ui.strong(format!("stage {}", stage.name.name()));
    if !stage.converged {
        let words = format!("no equilibrium beyond t = {:.4}", stage.reached_t);
        ui.colored_label(ui.visuals().warn_fg_color, words);
    }
    let strain = format!("largest strain {:.2e} at", stage.peak_strain);
    chosen = time_link(ui, &strain, stage.peak_strain_t).or(chosen);
    let bending = format!("largest facet bending {:.2}° at", stage.peak_facet_bending_deg);
    chosen = time_link(ui, &bending, stage.peak_facet_bending_t).or(chosen);
    let e = &stage.peak_energy;
    ui.label(format!(
        "energy at most: bars {:.1e}, creases {:.1e}, facets {:.1e}, contact {:.1e}",
        e.bars, e.creases, e.facets, e.contact
    ))
    .on_hover_text("Energy in units of EA·h at EA = 1");
    chosen
}

fn engine(ui: &mut Ui, report: &Report) {
    let engine = &report.engine;
    let gap = engine.contact_gap.map_or_else(
        || "layers may pass through each other".to_owned(),
        |gap| {
            let at_end = engine.final_gap.filter(|end| *end < gap);
            let end = at_end.map_or_else(String::new, |end| format!(", {end:.0e} h in the end"));
            format!("layers keep {gap:.0e} h apart{end}")
        },
    );
    ui.weak(format!(
        "{} engine on {} ({gap}): {:.2} s for {} steps; check {:.2} s",
        engine.name.name(),
        engine.device,
        engine.seconds,
        engine.steps,
        report.seconds.check
    ));
}
