//! The nine profiles unfolded into the plane, with a check of each motion.
//!
//! Rows are rigid rectangles here, so each state is the exact deployed state on a chain of segments of equal length. All
//! columns have the same cross-section, so one column is checked.

use foldmotion_check::{CollisionOptions, Verdict, collisions};
use foldmotion_pattern::{Case, Facing, Frame, LayerOrder, Motion, Unit, UnitSheet};
use glam::DVec2;

use super::motions::PartProgress;
use super::record::UnfoldingRow;
use super::store::Store;
use super::targets::{inputs, sheet};
use crate::PaperError;
use foldmotion_study::UnitStudy;

/// The number of frames from deployed to planar; the straight paths between them are checked.
const FRAMES: usize = 960;

/// The stored unfoldings of `model`; `None` if they have not been checked.
pub(super) fn finished(store: &Store, model: &str) -> Option<Vec<UnfoldingRow>> {
    store.find(&name(model), &part_inputs(model))
}

/// The unfoldings of `model`, which are checked if necessary: uniform, and by energy if uniform is not proved to be clear.
pub(super) fn unfolding(
    store: &Store,
    model: &str,
    done: PartProgress<'_>,
) -> Result<Vec<UnfoldingRow>, PaperError> {
    store.part(&name(model), &part_inputs(model), || check_all(model, done))
}

fn name(model: &str) -> String {
    format!("unfolding-{model}")
}

fn part_inputs(model: &str) -> String {
    inputs(model, &format!("unfolding, {FRAMES} frames"))
}

fn check_all(model: &str, done: PartProgress<'_>) -> Result<Vec<UnfoldingRow>, PaperError> {
    let study = sheet(model, Case::E)?;
    let unfolding = &study.unfolding;
    let turns = turns(&study.division.points);
    let scaled = |time: f64| turns.iter().map(|turn| (1.0 - time) * turn).collect();
    let uniform = check(model, &study, scaled, done)?;
    let is_proved = unfolding.certified && unfolding.path.is_none();
    let mut rows = vec![UnfoldingRow { proved: is_proved, ..uniform }];
    if let Some(path) = &unfolding.path {
        let by_energy = check(model, &study, |time| path.at(time), done)?;
        rows.push(UnfoldingRow {
            method: "energy".to_owned(),
            proved: unfolding.certified,
            ..by_energy
        });
    }
    Ok(rows)
}

/// Checks the motion in which the turns of the chain at time t are `turns_at(t)`.
fn check(
    model: &str,
    study: &UnitStudy,
    turns_at: impl Fn(f64) -> Vec<f64>,
    done: PartProgress<'_>,
) -> Result<UnfoldingRow, PaperError> {
    let motion = motion(study, turns_at)?;
    let report = collisions(&motion, &CollisionOptions::default(), done)?;
    Ok(UnfoldingRow {
        model: model.to_owned(),
        rows: study.units.rows,
        method: "uniform".to_owned(),
        verdict: report.verdict,
        crosses_at: match (report.verdict, &report.first) {
            (Verdict::Penetrating, Some(first)) => Some(1.0 - first.time),
            _ => None,
        },
        proved: false,
        frames: motion.frames.len(),
    })
}

/// The motion of one column of the sheet on the chain with those turns.
fn motion(study: &UnitStudy, turns_at: impl Fn(f64) -> Vec<f64>) -> Result<Motion, PaperError> {
    let height = study.units.unit.height;
    let failed = |e| PaperError::pattern(&study.profile_source, e);
    let unit = Unit::new(Case::E, height, height, None, None).map_err(failed)?;
    let units = UnitSheet::new(unit, study.units.rows, 1).map_err(failed)?;
    let state = |k: usize| {
        let time = k as f64 / FRAMES as f64;
        let polygon = chain(height, &turns_at(time));
        let positions = units.deployed(&polygon, Facing::Left).map_err(failed)?;
        Ok(Frame { time, positions })
    };
    let frames = (0..=FRAMES).map(state).collect::<Result<_, PaperError>>()?;
    Ok(Motion { frames, sheet: units.sheet, compact_order: LayerOrder::default() })
}

/// The turns from each segment of a polygon to the next, radians in (−π, π].
fn turns(points: &[DVec2]) -> Vec<f64> {
    let turn = |p: &[DVec2]| {
        let (from, to) = (p[1] - p[0], p[2] - p[1]);
        from.perp_dot(to).atan2(from.dot(to))
    };
    points.windows(3).map(turn).collect()
}

/// The chain of segments of length `height` with those turns. Its middle segment lies along x, which keeps the paths of both
/// ends short.
fn chain(height: f64, turns: &[f64]) -> Vec<DVec2> {
    let mut heading = -turns[..turns.len() / 2].iter().sum::<f64>();
    let mut point = height * DVec2::from_angle(heading);
    let mut points = vec![DVec2::ZERO, point];
    for turn in turns {
        heading += turn;
        point += height * DVec2::from_angle(heading);
        points.push(point);
    }
    let middle = points[points.len() / 2];
    points.iter().map(|&p| p - middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chain_of_a_polygons_turns_has_its_distances() {
        let study = sheet("omega", Case::E).unwrap();
        let points = &study.division.points;
        let whole = chain(study.units.unit.height, &turns(points));
        assert_eq!(whole.len(), points.len());
        for (i, j) in [(0, 35), (3, 20), (11, 12)] {
            let error = whole[i].distance(whole[j]) - points[i].distance(points[j]);
            assert!(error.abs() < 1e-11, "{i} {j}: {error}");
        }
        let flat = chain(1.0, &[0.0; 34]);
        assert!((flat[0].distance(flat[35]) - 35.0).abs() < 1e-12);
    }

    #[test]
    fn the_shelter_unfolds_clear_and_the_spiral_by_energy_where_scaling_crosses() {
        let rows = check_all("shelter", &|_| true).unwrap();
        assert_eq!(rows.len(), 1, "{rows:?}");
        assert!(rows[0].proved && rows[0].crosses_at.is_none(), "{rows:?}");
        let rows = check_all("fermat-spiral", &|_| true).unwrap();
        assert_eq!(rows[0].verdict, Verdict::Penetrating);
        let crosses_at = rows[0].crosses_at.unwrap();
        assert!((0.8..0.9).contains(&crosses_at), "{rows:?}");
        assert_eq!((rows[1].method.as_str(), rows[1].proved), ("energy", true));
        assert!(rows[1].crosses_at.is_none(), "{rows:?}");
    }
}
