//! Places the frames of a sheet of units in space.
//!
//! The energy of a sheet does not depend on its position, so an engine leaves that open. The exact states are at fixed
//! positions: deployed on the profile of the scene, planar in the plane z = 0, compact along the axes.
//! Between two of them each frame is fitted rigidly to the frame before, so that the sheet as a whole turns as little as
//! possible. The rotation that remains at the end of the stage is spread over the stage, and the centre moves from that of one
//! exact state to that of the next. The share of both is 3u² − 2u³ at the stage's time u, so that the motion is smooth where
//! the stages meet.

use std::f64::consts::{FRAC_PI_2, PI};

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::Frame;
use glam::{DMat3, DQuat, DVec3};

/// A rotation whose half angle has a smaller cosine counts as half a turn, whose direction is arbitrary.
const HALF_TURN: f64 = 1e-6;

/// A right angle, in radians.
const QUARTER_TURN: f64 = FRAC_PI_2;

/// The exact states at t = 0, 1, 2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ExactStates<'a> {
    pub(crate) deployed: &'a [DVec3],
    pub(crate) planar: &'a [DVec3],
    pub(crate) compact: &'a [DVec3],
}

/// Moves each frame rigidly: at t = 0, 1, 2 it is fitted to the exact state; between them the motion is smooth.
///
/// In a stage that did not reach its end, no rotation is added. The frames must be in order of time, from the deployed state.
pub(crate) fn place(frames: &mut [Frame], exact: &ExactStates<'_>) {
    let Some((first, rest)) = frames.split_first_mut() else {
        return;
    };
    let fit = RigidMotion::best_fit(&first.positions, exact.deployed);
    apply(&fit, first);
    let turn = half_turn(exact);
    let middle = rest.partition_point(|frame| frame.time <= 1.0);
    let (unfold, fold) = rest.split_at_mut(middle);
    place_stage(first, unfold, &turned(exact.planar, turn));
    let flat = unfold.last().unwrap_or(first);
    place_stage(flat, fold, &turned(exact.compact, turn));
}

/// The half turn of the planar and the compact state about an axis that keeps a sheet from turning round while it
/// unfolds; the identity if it does not.
///
/// The exact states run along +x with the front up. A profile drawn from left to right, or with its flaps below, leads to a
/// deployed state that lies the other way.
fn half_turn(exact: &ExactStates<'_>) -> DMat3 {
    let angle = |turn: DMat3| {
        let planar = turned(exact.planar, turn);
        let fit = RigidMotion::best_fit(exact.deployed, &planar);
        axis_and_angle(fit.rotation).1
    };
    if angle(DMat3::IDENTITY) <= PI - QUARTER_TURN / 2.0 {
        return DMat3::IDENTITY;
    }
    let axes = [DVec3::Z, DVec3::Y, DVec3::X];
    let mut turns = axes.map(|axis| DMat3::from_diagonal(2.0 * axis - DVec3::ONE)).into_iter();
    turns.find(|&turn| angle(turn) < QUARTER_TURN / 2.0).unwrap_or(DMat3::IDENTITY)
}

/// `positions` turned about their centre.
fn turned(positions: &[DVec3], turn: DMat3) -> Vec<DVec3> {
    let centre = centre(positions);
    positions.iter().map(|&p| centre + turn * (p - centre)).collect()
}

/// Places the frames of the stage that leads to `exact`, after its placed first frame `start`.
fn place_stage(start: &Frame, frames: &mut [Frame], exact: &[DVec3]) {
    let mut before = start;
    for frame in frames.iter_mut() {
        let fit = RigidMotion::best_fit(&frame.positions, &before.positions);
        apply(&fit, frame);
        before = frame;
    }
    let end = before;
    let is_reached = end.time == start.time.floor() + 1.0;
    let (axis, angle) = if is_reached {
        axis_and_angle(RigidMotion::best_fit(&end.positions, exact).rotation)
    } else {
        (DVec3::Z, 0.0)
    };
    // A best fit keeps the centre.
    let centre = centre(&start.positions);
    let displacement = self::centre(exact) - centre;
    for frame in frames {
        let share = share(frame.time - start.time.floor());
        let rotation = DMat3::from_axis_angle(axis, share * angle);
        let translation = centre + share * displacement - rotation * centre;
        let motion = RigidMotion { rotation, translation };
        apply(&motion, frame);
    }
}

/// The share of the remaining rigid motion that is applied at the time `u` of a stage.
fn share(u: f64) -> f64 {
    u * u * (3.0 - 2.0 * u)
}

/// The axis and the angle up to half a turn. The sign of half a turn is rounding, so its axis is the one whose largest
/// coordinate is positive.
fn axis_and_angle(rotation: DMat3) -> (DVec3, f64) {
    let q = DQuat::from_mat3(&rotation);
    let largest = |v: DVec3| v.to_array().into_iter().fold(0.0, furthest);
    let is_reversed = if q.w.abs() < HALF_TURN { largest(q.xyz()) < 0.0 } else { q.w < 0.0 };
    let q = if is_reversed { -q } else { q };
    let sine = q.xyz().length();
    let axis = q.xyz().try_normalize().unwrap_or(DVec3::Z);
    (axis, 2.0 * sine.atan2(q.w))
}

/// The number with the larger absolute value; the first of two equal ones.
fn furthest(a: f64, b: f64) -> f64 {
    if b.abs() > a.abs() { b } else { a }
}

fn centre(positions: &[DVec3]) -> DVec3 {
    positions.iter().sum::<DVec3>() / positions.len().max(1) as f64
}

/// Moves a frame rigidly.
pub(crate) fn apply(motion: &RigidMotion, frame: &mut Frame) {
    for position in &mut frame.positions {
        *position = motion.apply(*position);
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use foldmotion_solver::Budget;

    use super::*;
    use crate::compute::engine::EngineRun;
    use crate::{SceneSource, Study};

    /// Frames of the test motions.
    const FRAMES: usize = 120;

    /// The motion of a shelter without contact as the engine leaves it: facets with one diagonal let it turn.
    fn folded(sheet: &str) -> (Study, EngineRun) {
        let scene = format!(
            "[profile]\nmodel = \"shelter\"\n[sheet]\n{sheet}\n[material]\nfacet_model = \"one-diagonal\"\n\
             [motion]\ncontact = false\nframes = {FRAMES}\n"
        );
        let source = SceneSource::new(Path::new("a.toml"), scene);
        let study = Study::resolve(&source).unwrap();
        let computed = study.fold(&[], Budget::Standard, &|_| true).unwrap();
        (study, computed)
    }

    const SHEETS: [&str; 4] =
        ["case = \"E\"", "case = \"T\"", "case = \"S\"", "case = \"SII\"\nlambda = 0.7"];

    /// The largest turn of the sheet as a whole from one frame to the next, degrees.
    fn largest_turn(frames: &[Frame]) -> f64 {
        let turn = |w: &[Frame]| {
            let fit = RigidMotion::best_fit(&w[0].positions, &w[1].positions);
            axis_and_angle(fit.rotation).1.to_degrees()
        };
        frames.windows(2).map(turn).fold(0.0, f64::max)
    }

    #[test]
    fn the_deployed_planar_and_compact_states_are_placed_exactly() {
        for sheet in SHEETS {
            let (study, computed) = folded(sheet);
            let units = study.subject.units().unwrap();
            let h = study.subject.sheet().unit_length;
            let (planar, compact) = (units.units.sheet.planar(), units.units.compact());
            let misplaced = |frames: &[Frame]| {
                let misplaced = |(time, exact): (f64, &[DVec3])| {
                    let frame = frames.iter().find(|frame| frame.time == time).unwrap();
                    let pairs = frame.positions.iter().zip(exact);
                    pairs.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max) / h
                };
                [(0.0, &units.deployed[..]), (1.0, &planar), (2.0, &compact)].map(misplaced)
            };
            let placed = misplaced(&study.place(computed.frames.clone()).frames);
            assert!(placed.iter().all(|&d| d < 1e-9), "{sheet}: {placed:?}");
            // The engine leaves them elsewhere.
            assert!(misplaced(&computed.frames)[2] > 1e-2, "{sheet}");
        }
    }

    #[test]
    fn the_sheet_as_a_whole_never_jumps() {
        for sheet in SHEETS {
            let (study, computed) = folded(sheet);
            let turn = largest_turn(&study.place(computed.frames.clone()).frames);
            assert!(turn < 1e-3, "{sheet}: {turn}");
            // The engine turns it by some degrees where it starts to fold.
            assert!(largest_turn(&computed.frames) > 1.0, "{sheet}");
        }
    }

    /// A bar of 4 × 2 × 1 that tumbles.
    fn tumbling(times: impl Iterator<Item = f64>) -> Vec<Frame> {
        let frame = |time: f64| {
            let turn =
                DMat3::from_euler(glam::EulerRot::XYZ, 40.0 * time, -7.0 * time, 90.0 * time);
            let moved = |p: DVec3| turn * p + DVec3::new(time.sin(), 3.0 * time, -time);
            Frame { time, positions: BAR.map(moved).to_vec() }
        };
        times.map(frame).collect()
    }

    #[test]
    fn a_profile_drawn_from_left_to_right_does_not_turn_round_while_it_unfolds() {
        let to_the_right = "[[-3, 0], [-2, 1.2], [0, 1.8], [2, 1.2], [3, 0]]";
        let to_the_left = "[[3, 0], [2, 1.2], [0, 1.8], [-2, 1.2], [-3, 0]]";
        for (facing, points) in [
            ("right", to_the_right),
            ("left", to_the_right),
            ("right", to_the_left),
            ("left", to_the_left),
        ] {
            let scene = format!(
                "[profile]\npoints = {points}\n[sheet]\ncase = \"E\"\nrows = 5\ncolumns = 3\nfacing = \"{facing}\"\n\
                 [motion]\ncontact = false\nframes = {FRAMES}\n"
            );
            let source = SceneSource::new(Path::new("a.toml"), scene);
            let study = Study::resolve(&source).unwrap();
            let run = study.fold(&[], Budget::Standard, &|_| true).unwrap();
            let frames = study.place(run.frames).frames;
            let flat = frames.iter().find(|frame| frame.time == 1.0).unwrap();
            let fit = RigidMotion::best_fit(&frames[0].positions, &flat.positions);
            let turn = axis_and_angle(fit.rotation).1.to_degrees();
            assert!(turn < 1.0, "{facing} {points}: {turn} degrees");
            assert!(flat.positions.iter().all(|p| p.z.abs() < 1e-9));
        }
    }

    const BAR: [DVec3; 4] = [
        DVec3::new(0.0, 0.0, 0.0),
        DVec3::new(4.0, 0.0, 0.0),
        DVec3::new(0.0, 2.0, 0.0),
        DVec3::new(0.0, 0.0, 1.0),
    ];

    #[test]
    fn a_rigid_body_turns_from_one_exact_state_to_the_next_without_a_jump() {
        const STEPS: u32 = 100;
        let turned = |angle: f64| BAR.map(|p| DMat3::from_rotation_y(angle) * p + DVec3::X);
        let (third, quarter) = (turned(PI / 1.5), turned(FRAC_PI_2));
        let exact = ExactStates { deployed: &BAR, planar: &third, compact: &quarter };
        let mut frames = tumbling((0..=2 * STEPS).map(|k| f64::from(k) / f64::from(STEPS)));
        assert!(largest_turn(&frames) > 20.0);
        place(&mut frames, &exact);
        let distance = |k: u32, exact: &[DVec3]| {
            let pairs = frames[k as usize].positions.iter().zip(exact);
            pairs.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
        };
        assert!(distance(0, &BAR) < 1e-12);
        assert!(distance(STEPS, &third) < 1e-12);
        assert!(distance(2 * STEPS, &quarter) < 1e-12);
        // A third of a turn with a share that grows at most 1.5 times as fast as the time.
        let turn = largest_turn(&frames);
        assert!(turn < 1.5 * 120.0 / f64::from(STEPS) + 1e-9, "{turn}");
    }

    #[test]
    fn a_stage_that_did_not_reach_its_end_is_not_rotated() {
        let far = BAR.map(|p| DMat3::from_rotation_z(2.0) * p);
        let exact = ExactStates { deployed: &BAR, planar: &BAR, compact: &far };
        let mut frames = tumbling((0..=19).map(|k| f64::from(k) / 10.0));
        place(&mut frames, &exact);
        assert!(largest_turn(&frames) < 1e-9);
        let mut whole = tumbling((0..=20).map(|k| f64::from(k) / 10.0));
        place(&mut whole, &exact);
        assert!(largest_turn(&whole) > 10.0);
    }
}
