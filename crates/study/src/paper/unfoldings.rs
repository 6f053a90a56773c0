//! The nine profiles unfolded into the plane, each motion judged.
//!
//! Rows stay rigid rectangles here, so every state is the exact deployed state over a chain of segments of equal
//! length. Every column repeats the same cross-section; one column is judged.

use foldmotion_check::{CollisionOptions, Verdict, collisions};
use foldmotion_pattern::{Case, Facing, Frame, LayerOrder, Motion, Unit, UnitSheet, find_model};
use glam::DVec2;

use super::motions::Done;
use super::record::UnfoldingRow;
use super::store::Store;
use super::targets::{inputs, sheet};
use crate::reporting::verdict_name;
use crate::{Study, StudyError};

/// Frames from deployed to planar: the straight paths between them are what is judged.
const FRAMES: usize = 480;

/// The unfolding of `model` by scaling all hinge angles alike, if it has been judged.
pub(super) fn finished(store: &Store, model: &str) -> Option<UnfoldingRow> {
    store.find(&name(model), &part_inputs(model))
}

/// The unfolding of `model`, judged where it has not been.
pub(super) fn unfolding(
    store: &Store,
    model: &str,
    done: Done<'_>,
) -> Result<UnfoldingRow, StudyError> {
    store.part(&name(model), &part_inputs(model), || judge(model, done))
}

fn name(model: &str) -> String {
    format!("unfolding-{model}")
}

fn part_inputs(model: &str) -> String {
    inputs(model, &format!("unfolding, {FRAMES} frames"))
}

fn judge(model: &str, done: Done<'_>) -> Result<UnfoldingRow, StudyError> {
    let study = sheet(model, Case::E)?;
    let motion = uniform_motion(&study)?;
    let report = collisions(&motion, &CollisionOptions::default(), done)?;
    Ok(UnfoldingRow {
        model: model.to_owned(),
        rows: find_model(model).map_or(0, |m| m.rows),
        method: "uniform".to_owned(),
        verdict: verdict_name(report.verdict).to_owned(),
        crosses_at: match (report.verdict, &report.first) {
            (Verdict::Penetrating, Some(first)) => Some(1.0 - first.time),
            _ => None,
        },
        frames: motion.frames.len(),
    })
}

/// One column of the sheet over the chain with its turns scaled from all to none.
fn uniform_motion(study: &Study) -> Result<Motion, StudyError> {
    let height = study.units.unit.height;
    let fault = |e: foldmotion_pattern::PatternError| StudyError::Parse {
        place: study.title.clone(),
        message: e.to_string(),
    };
    let unit = Unit::new(Case::E, height, height, None, None).map_err(fault)?;
    let units = UnitSheet::new(unit, study.units.rows, 1).map_err(fault)?;
    let points = &study.division.points;
    let state = |k: usize| {
        let time = k as f64 / FRAMES as f64;
        let polygon = with_turns_scaled(points, 1.0 - time);
        let positions = units.deployed(&polygon, Facing::Left).map_err(fault)?;
        Ok(Frame { time, positions })
    };
    let frames = (0..=FRAMES).map(state).collect::<Result<_, StudyError>>()?;
    Ok(Motion {
        frames,
        sheet: units.sheet,
        compact_order: LayerOrder::default(),
    })
}

/// The chain `points` with the turns between its segments scaled by `part`; its middle segment stays.
fn with_turns_scaled(points: &[DVec2], part: f64) -> Vec<DVec2> {
    let segments: Vec<DVec2> = points.windows(2).map(|p| p[1] - p[0]).collect();
    let mut headings = vec![segments.first().map_or(0.0, |s| s.to_angle())];
    for pair in segments.windows(2) {
        let turn = pair[0].perp_dot(pair[1]).atan2(pair[0].dot(pair[1]));
        headings.push(headings.last().copied().unwrap_or(0.0) + turn);
    }
    let middle = headings.get(headings.len() / 2).copied().unwrap_or(0.0);
    let mut chain = vec![points.first().copied().unwrap_or_default()];
    for (segment, heading) in segments.iter().zip(&headings) {
        let direction = DVec2::from_angle(middle + part * (heading - middle));
        let last = chain.last().copied().unwrap_or_default();
        chain.push(last + segment.length() * direction);
    }
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaling_the_turns_keeps_lengths_and_ends_straight() {
        let study = sheet("omega", Case::E).unwrap();
        let points = &study.division.points;
        let whole = with_turns_scaled(points, 1.0);
        for (a, b) in whole.iter().zip(points) {
            assert!((*a - *b).length() < 1e-12);
        }
        for part in [0.7, 0.0] {
            for pair in with_turns_scaled(points, part).windows(2) {
                assert!(((pair[1] - pair[0]).length() - 1.0).abs() < 1e-12);
            }
        }
        let flat = with_turns_scaled(points, 0.0);
        let span = (flat[flat.len() - 1] - flat[0]).length();
        assert!((span - (points.len() - 1) as f64).abs() < 1e-12);
    }

    #[test]
    fn the_shelter_unfolds_clear_and_the_spiral_crosses_itself_when_scaled() {
        let row = judge("shelter", &|_| true).unwrap();
        assert!(
            matches!(row.verdict.as_str(), "free" | "touching"),
            "{row:?}"
        );
        assert_eq!(row.crosses_at, None);
        let row = judge("fermat-spiral", &|_| true).unwrap();
        assert_eq!(row.verdict, "penetrating");
        assert!(
            row.crosses_at
                .is_some_and(|part| (0.8..0.9).contains(&part)),
            "{row:?}"
        );
    }
}
