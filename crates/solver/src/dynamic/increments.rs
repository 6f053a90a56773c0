//! The increments of a stage's ramp.
//!
//! The stage is cut at the frames, at the requested times, and where a step of the schedule begins or ends. Each piece
//! is divided into equal increments so that none turns a target by more than [`LARGEST_TURN`]. In `fold`, towards the
//! end of every turn, there is also a geometric series, each closing increment leaving [`CLOSING_RATIO`] of the turn
//! that was left. There the layers that the turn closes come together: with ε left to turn, neighbouring layers lie of
//! the order of ε² apart, so the sag of a straight path between two states and the lag behind the schedule must shrink
//! like ε² too. Hence the tolerance falls with the square of what is left, and each closing increment is recorded as a
//! frame. Layers that an earlier step has closed are not followed more closely than the creases that still move.
//!
//! Times are counted from the end of the stage, where precision is needed.

use super::options::DynamicOptions;
use crate::schedule::Turn;
use crate::{Schedule, Stage};

/// The largest turn of a target in one increment, radians (1.5°: that of 240 frames), so that the path does not depend
/// on how few frames are recorded.
const LARGEST_TURN: f64 = std::f64::consts::PI / 120.0 * (1.0 + 1e-9);

/// The part of the remaining turn that a closing increment leaves.
const CLOSING_RATIO: f64 = 0.7;

/// The turn left at which closing begins, radians: there its increments are as large as the equal ones.
const CLOSING_TURN: f64 = LARGEST_TURN / (1.0 - CLOSING_RATIO);

/// The turn at which closing ends, radians: layers then lie closer than 1e-6, which counts as touching.
const CLOSED_TURN: f64 = 3e-4;

/// Stage-local times closer than this are the same but for rounding.
const SAME_TIME: f64 = 1e-12;

/// A part of a stage's ramp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Increment {
    /// The stage-local time at its end.
    pub(super) end: f64,
    /// The residual to which the sheet settles there.
    pub(super) tolerance: f64,
    /// Whether the state there is a frame.
    pub(super) is_recorded: bool,
}

/// The increments of `stage` but for the last one, which ends at 1 and settles to the final tolerance.
pub(super) fn increments(
    schedule: &Schedule,
    stage: Stage,
    options: &DynamicOptions,
) -> Vec<Increment> {
    let intervals = (options.frames / 2) as f64;
    let turns = schedule.turns(stage);
    let increment = |left: f64, is_recorded: bool| {
        let closeness = closeness(&turns, left);
        let tolerance = match stage {
            Stage::Unfold => options.ramp_tolerance,
            Stage::Fold => options.ramp_tolerance * closeness * closeness,
        };
        Increment { end: 1.0 - left, tolerance: tolerance.max(options.tolerance), is_recorded }
    };
    let asked = options.extra_times.iter().map(|t| t - stage.start_time());
    let asked: Vec<f64> = asked.filter(|s| *s > 0.0 && *s < 1.0).collect();
    let pieces = pieces(&turns, &asked, options.frames / 2);
    let equal = pieces.iter().flat_map(|piece| {
        (1..=piece.parts).map(|part| (piece.left(part, intervals), part == piece.parts))
    });
    let mut increments: Vec<_> = equal
        .filter(|&(left, _)| left > 0.0)
        .map(|(left, ends_piece)| increment(left, ends_piece))
        .collect();
    if stage == Stage::Fold {
        // A closing increment that all but meets an equal one is left out: frames are distinct in time.
        let is_apart = |left: &f64| {
            let left = left * intervals;
            pieces.iter().all(|piece| piece.is_apart(left))
        };
        let closing = closing(&turns).into_iter().filter(is_apart);
        increments.extend(closing.map(|left| increment(left, true)));
        increments.sort_by(|a, b| a.end.total_cmp(&b.end));
    }
    increments
}

/// Part of a stage between neighbouring cuts; `from` and `to` are the time left there, in frame spacings.
#[derive(Debug, Clone, Copy)]
struct Piece {
    from: f64,
    to: f64,
    parts: usize,
}

impl Piece {
    #[expect(clippy::cast_sign_loss, reason = "rates and lengths are not negative")]
    fn new(turns: &[Turn], [from, to]: [f64; 2], intervals: f64) -> Self {
        let ends = [from, to].map(|left| 1.0 - left / intervals);
        let rate = |turn: &Turn| turn.angle * turn.timing.steepest(ends[0], ends[1]);
        let fastest = turns.iter().map(rate).fold(0.0, f64::max);
        let turn = fastest * (from - to) / intervals;
        Self { from, to, parts: ((turn / LARGEST_TURN).ceil() as usize).max(1) }
    }

    /// The time left of the stage at the end of a part, counted from 1.
    fn left(&self, part: usize, intervals: f64) -> f64 {
        let parts = self.parts as f64;
        (self.from * parts - (self.from - self.to) * part as f64) / (intervals * parts)
    }

    /// Whether `left`, in frame spacings, lies elsewhere than a part of the piece begins or ends.
    fn is_apart(&self, left: f64) -> bool {
        let place = (self.from - left) / (self.from - self.to) * self.parts as f64;
        let is_inside = place > -1e-3 && place < self.parts as f64 + 1e-3;
        !is_inside || (place - place.round()).abs() > 1e-3
    }
}

/// The pieces of the stage in order of time; `asked` are stage-local times at which it is cut too.
fn pieces(turns: &[Turn], asked: &[f64], frames: usize) -> Vec<Piece> {
    let intervals = frames as f64;
    let same = SAME_TIME * intervals;
    let is_between_frames = |left: &f64| (left - left.round()).abs() > same;
    let kinks = turns
        .iter()
        .flat_map(|turn| [turn.timing.from, turn.timing.to])
        .chain(asked.iter().copied())
        .map(|s| (1.0 - s) * intervals)
        .filter(is_between_frames);
    let mut cuts: Vec<f64> = (0..=frames).map(|left| left as f64).chain(kinks).collect();
    cuts.sort_by(|a, b| b.total_cmp(a));
    cuts.dedup_by(|later, earlier| *earlier - *later <= same);
    cuts.windows(2).map(|pair| Piece::new(turns, [pair[0], pair[1]], intervals)).collect()
}

/// How close the sheet is to the end of a turn with `left` of the stage to go: the smallest turn left, as a share of
/// [`LARGEST_TURN`] and at most 1; turns long made are passed over, and 0 is left where all are.
fn closeness(turns: &[Turn], left: f64) -> f64 {
    let turn_left = |turn: &Turn| {
        let until_end = left - turn.timing.end_left();
        if until_end.abs() < SAME_TIME {
            Some(CLOSED_TURN)
        } else if until_end < 0.0 {
            None
        } else {
            Some(turn.angle * turn.timing.share_left(left))
        }
    };
    turns
        .iter()
        .filter_map(turn_left)
        .map(|turn| (turn / LARGEST_TURN).min(1.0))
        .reduce(f64::min)
        .unwrap_or(0.0)
}

/// The times left at the ends of the closing increments of every turn, each time once.
fn closing(turns: &[Turn]) -> Vec<f64> {
    let series = |turn: &Turn| {
        let Turn { angle, timing } = *turn;
        let first = (CLOSING_TURN / angle).min(1.0) * CLOSING_RATIO;
        std::iter::successors(Some(first), |share| Some(share * CLOSING_RATIO))
            .take_while(move |share| angle * share > CLOSED_TURN)
            .map(move |share| timing.time_left(share))
    };
    let mut times: Vec<f64> = turns.iter().flat_map(series).collect();
    times.sort_by(f64::total_cmp);
    times.dedup_by(|a, b| *a - *b <= SAME_TIME);
    times
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;
    use crate::{CreaseGroup, Ease, ScheduleStep, UnfoldPath};

    fn sheet() -> UnitSheet {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        UnitSheet::new(unit, 3, 1).unwrap()
    }

    fn schedule(share: f64, steps: &[ScheduleStep]) -> Schedule {
        let units = sheet();
        let flat = vec![0.0; units.sheet.edges.len()];
        let compact: Vec<f64> = units.compact_angles().iter().map(|a| a * share).collect();
        let uniform = Schedule::uniform(&units.sheet, &flat, &compact).unwrap();
        uniform.with_steps(&units.sheet, steps).unwrap()
    }

    fn options(frames: usize) -> DynamicOptions {
        DynamicOptions { frames, ..DynamicOptions::default() }
    }

    fn increments_for(frames: usize, share: f64) -> Vec<Increment> {
        increments(&schedule(share, &[]), Stage::Fold, &options(frames))
    }

    fn step(row: u32, from: f64, to: f64, ease: Ease) -> ScheduleStep {
        ScheduleStep {
            stage: Stage::Fold,
            creases: CreaseGroup::All,
            rows: Some([row, row]),
            columns: None,
            from,
            to,
            ease,
        }
    }

    /// The uniform ramp written out: every frame spacing in equal parts, and the closing series.
    fn uniform_twin(frames: usize, turn: f64) -> Vec<Increment> {
        let options = options(frames);
        let intervals = frames / 2;
        let parts = (turn / intervals as f64 / LARGEST_TURN).ceil().max(1.0);
        let total = intervals as f64 * parts;
        let increment = |left: f64, is_recorded| {
            let closeness = (turn * left / LARGEST_TURN).min(1.0);
            Increment {
                end: 1.0 - left,
                tolerance: (options.ramp_tolerance * closeness * closeness).max(options.tolerance),
                is_recorded,
            }
        };
        let mut increments = Vec::new();
        let mut index = 1.0;
        while index < total {
            increments.push(increment((total - index) / total, index % parts == 0.0));
            index += 1.0;
        }
        let mut left = (CLOSING_TURN / turn).min(1.0) * CLOSING_RATIO;
        while turn * left > CLOSED_TURN {
            let place = left * total;
            if (place - place.round()).abs() > 1e-3 {
                increments.push(increment(left, true));
            }
            left *= CLOSING_RATIO;
        }
        increments.sort_by(|a, b| a.end.total_cmp(&b.end));
        increments
    }

    #[test]
    fn the_uniform_ramp_is_cut_into_equal_parts_bit_for_bit() {
        for frames in [2, 6, 14, 24, 38, 240, 242, 1000] {
            for share in [0.01, 0.1, 0.3, 0.7, 0.77, 1.0, 1.9] {
                let turn = std::f64::consts::PI * share;
                let twin = uniform_twin(frames, turn);
                assert!(increments_for(frames, share) == twin, "{frames} {share}");
            }
        }
        let shifted = schedule(1.0, &[step(0, 0.0, 0.999, Ease::Linear)]);
        let shifted = increments(&shifted, Stage::Fold, &options(240));
        assert!(shifted != uniform_twin(240, std::f64::consts::PI));
    }

    #[test]
    fn no_increment_of_any_schedule_turns_a_target_too_far() {
        let schedules = [
            vec![],
            vec![step(0, 0.0, 0.3, Ease::Linear), step(1, 0.3, 0.61, Ease::Smooth)],
            vec![step(1, 0.123_456, 0.123_457, Ease::Smooth)],
            vec![step(2, 0.5, 0.501, Ease::Linear)],
        ];
        for (steps, frames) in schedules.iter().flat_map(|s| [(s, 2), (s, 24), (s, 240)]) {
            let schedule = schedule(1.0, steps);
            let increments = increments(&schedule, Stage::Fold, &options(frames));
            let mut from = 0.0;
            for end in increments.iter().map(|i| i.end).chain([1.0]) {
                assert!(end > from, "{end} follows {from}");
                for hinge in 0..schedule.hinge_count() {
                    let [a, b] = [from, end].map(|s| schedule.target(Stage::Fold, hinge, s));
                    assert!(
                        (b - a).abs() <= LARGEST_TURN * (1.0 + 1e-6),
                        "{from} to {end}: {a} to {b}"
                    );
                }
                from = end;
            }
            // An increment for each frame and kink; twice for 180° at 1.5°, half as much more where eased; closing.
            let most = frames / 2 + 2 * steps.len() + (steps.len() + 1) * (180 + 20);
            assert!(increments.len() <= most, "{} {most}", increments.len());
        }
    }

    #[test]
    fn no_increment_turns_a_crease_too_far_on_a_path_to_and_fro() {
        let units = sheet();
        let flat = vec![0.0; units.sheet.edges.len()];
        let angles = vec![vec![0.0; 2], vec![1.5, -0.3], vec![-1.5, 0.3], vec![0.0; 2]];
        let path = UnfoldPath { progress: vec![0.0, 0.21, 0.3, 1.0], angles };
        let schedule = Schedule::uniform(&units.sheet, &flat, &flat)
            .and_then(|schedule| schedule.with_unfold_path(&units.sheet, path))
            .unwrap();
        for frames in [2, 24, 240] {
            let increments = increments(&schedule, Stage::Unfold, &options(frames));
            let ends: Vec<f64> = increments.iter().map(|i| i.end).chain([1.0]).collect();
            for (from, end) in std::iter::once(0.0).chain(ends.iter().copied()).zip(&ends) {
                for hinge in 0..schedule.hinge_count() {
                    let [a, b] = [from, *end].map(|s| schedule.target(Stage::Unfold, hinge, s));
                    assert!((b - a).abs() <= LARGEST_TURN * (1.0 + 1e-6), "{from}: {a} {b}");
                }
            }
            // 3 radians within 0.09 of the stage set the pace of all of it.
            let pace = 3.0 / 0.09 / LARGEST_TURN;
            assert!((ends.len() as f64) < pace + frames as f64 + 2.0);
        }
    }

    #[test]
    fn a_state_is_recorded_at_every_frame_and_where_a_step_begins_or_ends() {
        let steps = [step(0, 0.0, 0.311, Ease::Linear), step(1, 0.25, 0.75, Ease::Smooth)];
        for frames in [2, 24, 1000] {
            let increments = increments(&schedule(1.0, &steps), Stage::Fold, &options(frames));
            let spacings = frames / 2;
            let times = (1..spacings).map(|k| k as f64 / spacings as f64);
            for time in times.chain([0.25, 0.311, 0.75]) {
                let is_there = |i: &&Increment| i.is_recorded && (i.end - time).abs() < 1e-12;
                let count = increments.iter().filter(is_there).count();
                assert_eq!(count, 1, "{frames} frames: {time}");
            }
        }
    }

    #[test]
    fn closing_increments_shrink_and_tighten_towards_the_end_of_every_step() {
        for ease in [Ease::Linear, Ease::Smooth] {
            let schedule = schedule(1.0, &[step(0, 0.0, 0.311, ease)]);
            let all = increments(&schedule, Stage::Fold, &options(240));
            for end in [0.311, 1.0] {
                let before = all.iter().rfind(|i| i.end < end - 1e-9).unwrap();
                // A crease of the row, and one of another.
                let hinge = (0..schedule.hinge_count())
                    .find(|&h| {
                        let is_done = (schedule.target(Stage::Fold, h, 0.311).abs() - 3.1) > 0.0;
                        is_done == (end < 1.0) && schedule.target(Stage::Fold, h, 1.0).abs() > 3.1
                    })
                    .unwrap();
                let [a, b] = [before.end, 1.0].map(|s| schedule.target(Stage::Fold, hinge, s));
                let left = (b - a).abs();
                assert!(left < 1.5 * CLOSED_TURN && left > CLOSED_TURN, "{left}");
                assert!(before.tolerance < 1e-6 && before.is_recorded, "{before:?}");
            }
            // Between the steps the sheet is far from the end of any turn.
            let between = all.iter().find(|i| i.end > 0.32).unwrap();
            assert_eq!(between.tolerance, DynamicOptions::default().ramp_tolerance);
            assert_eq!(all[0].tolerance, DynamicOptions::default().ramp_tolerance);
        }
    }

    #[test]
    fn a_sheet_that_does_not_turn_has_one_increment_a_frame() {
        assert_eq!(increments_for(24, 0.0).len(), 11);
    }
}
