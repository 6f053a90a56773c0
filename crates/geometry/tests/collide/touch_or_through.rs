//! A vertex that touches a facet and goes back is touching; one that passes through is penetrating, however fast.
//!
//! All coordinates are dyadic, so that touches are exact and happen at the intended instant. Lengths are of order 1, τ
//! = 2⁻²⁰, and speeds range from 10⁻³ to 10⁶ lengths per interval.

use foldmotion_geometry::collide::{Limits, MovingPair, Outcome, PairPose, Side, certify};
use glam::DVec3;

use foldmotion_random::Random;

/// The dyadic tolerance τ.
const TOLERANCE: f64 = 1.0 / (1u64 << 20) as f64;

fn limits(pairs: &[MovingPair]) -> Limits {
    let poses = pairs.iter().flat_map(|pair| [pair.start, pair.end]);
    let corners = poses.flat_map(|pose| [pose.a, pose.b]).flatten();
    let extent = corners.map(DVec3::length).fold(0.0, f64::max);
    Limits {
        tolerance: TOLERANCE,
        margin: Limits::margin_for(extent),
        // A facet that makes half a turn within 10⁻⁶ of the interval, in contact throughout, needs a step for each
        // degree.
        budget: 40_000,
    }
}

/// Certifies a motion of several intervals, passing the side on; undecided if it starts deep.
fn judge(pairs: &[MovingPair]) -> Outcome {
    let limits = limits(pairs);
    let mut outcome = Outcome::Undecided { time: 0.0 };
    let Some(mut side) = Side::at_start(&pairs[0].start, &limits) else {
        return outcome;
    };
    for pair in pairs {
        outcome = certify(pair, &side, &limits);
        match &outcome {
            Outcome::Passed(passage) => side = passage.side.clone(),
            _ => break,
        }
    }
    outcome
}

/// A power of two between 2⁻¹⁰ and 2²⁰.
fn speed(random: &mut Random) -> f64 {
    2.0_f64.powi(i32::from(random.index(31) as u8) - 10)
}

/// A multiple of 1/16 in [−2, 2].
fn dyadic(random: &mut Random) -> f64 {
    random.index(65) as f64 / 16.0 - 2.0
}

/// Permutes the axes and moves the origin, exactly.
fn placed(random: &mut Random) -> impl Fn(DVec3) -> DVec3 + use<> {
    let turn = random.index(3);
    let shift = DVec3::new(dyadic(random), dyadic(random), dyadic(random));
    move |p| {
        shift
            + match turn {
                0 => p,
                1 => DVec3::new(p.y, p.z, p.x),
                _ => DVec3::new(p.z, p.x, p.y),
            }
    }
}

fn plate() -> [DVec3; 3] {
    [(-8.0, -8.0), (24.0, -8.0), (-8.0, 24.0)].map(|(x, y)| DVec3::new(x, y, 0.0))
}

/// A needle above the plate with its tip at `tip`.
fn needle(tip: DVec3) -> [DVec3; 3] {
    let up = [DVec3::ZERO, DVec3::new(0.25, 0.0, 1.0), DVec3::new(0.0, 0.25, 1.5)];
    up.map(|d| tip + d)
}

/// A motion of a needle over a plate through tips above the same or different points.
fn motion(random: &mut Random, tips: &[DVec3]) -> Vec<MovingPair> {
    let place = placed(random);
    let is_swapped = random.index(2) == 0;
    let pose = |tip: &DVec3| {
        let (mut a, mut b) = (plate().map(&place), needle(*tip).map(&place));
        if is_swapped {
            std::mem::swap(&mut a, &mut b);
        }
        PairPose { a, b, shared: 0 }
    };
    let poses: Vec<_> = tips.iter().map(pose).collect();
    let intervals = poses.windows(2);
    intervals.map(|p| MovingPair::new(p[0], p[1])).collect()
}

/// A point above the plate, at this height.
fn above(random: &mut Random, height: f64) -> DVec3 {
    DVec3::new(dyadic(random), dyadic(random), height)
}

#[test]
fn a_vertex_that_reaches_a_facet_and_goes_back_touches_at_any_speed() {
    let mut random = Random::new(71);
    for case in 0..300 {
        let (fast, depth) = (speed(&mut random), [0.0, 0.25, 0.5][case % 3] * TOLERANCE);
        let heights = [fast, -depth, fast * 0.5, -depth, 2.0 * fast];
        let tips = heights.map(|height| above(&mut random, height));
        let outcome = judge(&motion(&mut random, &tips));
        assert!(matches!(&outcome, Outcome::Passed(_)), "{case} at {fast}: {outcome:?}");
    }
}

#[test]
fn a_vertex_that_goes_through_a_facet_penetrates_at_any_speed() {
    let mut random = Random::new(72);
    for case in 0..300 {
        let fast = speed(&mut random);
        let instant = random.index(63) as f64 / 64.0 + 1.0 / 64.0;
        let below = [2.0 * TOLERANCE, fast.max(2.0 * TOLERANCE) * (1.0 - instant), 4.0 + fast];
        let below = below[case % 3].max(2.0 * TOLERANCE);
        let tips = [fast * instant, -below].map(|height| above(&mut random, height));
        let outcome = judge(&motion(&mut random, &tips));
        let Outcome::Crossed(crossing) = &outcome else {
            panic!("{case} at {fast} to {below}: {outcome:?}");
        };
        let contact = tips[0].z / (tips[0].z + below);
        assert!((crossing.contact - contact).abs() < 1e-6, "{contact}: {crossing:?}");
        assert!(crossing.depth > TOLERANCE || crossing.reach > TOLERANCE, "{crossing:?}");
    }
}

#[test]
fn a_vertex_that_stops_on_a_facet_and_goes_on_through_it_penetrates_at_any_speed() {
    let mut random = Random::new(73);
    for case in 0..200 {
        let fast = speed(&mut random);
        let rest = [0.5, 0.0, -0.5][case % 3] * TOLERANCE;
        let heights = [fast, rest, rest, -fast.max(2.0 * TOLERANCE)];
        let tips = heights.map(|height| above(&mut random, height));
        let outcome = judge(&motion(&mut random, &tips));
        assert!(matches!(&outcome, Outcome::Crossed(_)), "{case} at {fast}: {outcome:?}");
    }
}

/// A facet that tilts about the y axis with slope k (t − t*), and a needle below it whose tip has the height −k s (t −
/// t*)² + `lift` above its plane: it touches at t* and goes back.
fn graze(random: &mut Random, fast: f64, lift: f64) -> MovingPair {
    let at = random.index(65) as f64 / 64.0;
    let drift = 2.0_f64.powi(-i32::from(random.index(4) as u8) - 2);
    let place_in_facet = 0.25 + random.index(5) as f64 * 0.125;
    let place = placed(random);
    let pose = |t: f64| {
        let t = t - at;
        let tip = DVec3::new(place_in_facet + drift * t, 0.0, fast * place_in_facet * t + lift);
        let needle = [DVec3::ZERO, DVec3::new(0.0, 0.25, -1.0), DVec3::new(0.0, -0.25, -1.5)];
        let facet = [DVec3::NEG_Y * 4.0, DVec3::Y * 4.0, DVec3::new(4.0, 0.0, 4.0 * fast * t)];
        PairPose { a: facet.map(&place), b: needle.map(|d| place(tip + d)), shared: 0 }
    };
    MovingPair::new(pose(0.0), pose(1.0))
}

#[test]
fn a_vertex_that_grazes_a_tilting_facet_between_frames_touches_at_any_speed() {
    let mut random = Random::new(74);
    for case in 0..400 {
        let fast = speed(&mut random);
        let lift = [0.0, -0.5, 0.5][case % 3] * TOLERANCE;
        let outcome = judge(&[graze(&mut random, fast, lift)]);
        assert!(
            matches!(&outcome, Outcome::Passed(p) if p.in_contact || lift < 0.0),
            "{case} at {fast}: {outcome:?}"
        );
    }
}

#[test]
fn a_vertex_that_pierces_a_tilting_facet_between_frames_penetrates_at_any_speed() {
    let mut random = Random::new(75);
    let mut through = 0;
    for case in 0..200 {
        let fast = speed(&mut random);
        let pair = graze(&mut random, fast, 2.5 * TOLERANCE);
        // Slow ones start deep.
        let is_deep = Side::at_start(&pair.start, &limits(&[pair])).is_none();
        through += u32::from(!is_deep);
        let outcome = (!is_deep).then(|| judge(&[pair]));
        assert!(
            matches!(&outcome, None | Some(Outcome::Crossed(_))),
            "{case} at {fast}: {outcome:?}"
        );
    }
    assert!(through > 120, "{through}");
}
