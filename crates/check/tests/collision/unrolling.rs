//! Rolled strips unrolled by scaling all their fold angles together: known answers, compared with exact tests in the
//! plane.

use std::f64::consts::{PI, TAU};

use foldmotion_check::{CollisionOptions, CollisionReport, Verdict, collisions};
use foldmotion_geometry::first_crossing;
use foldmotion_pattern::Motion;
use glam::{DVec2, DVec3};

use crate::sheets::{folded, motion, strip};

/// The headings of a chain of unit segments, in radians.
type Headings = Vec<f64>;

/// The headings of r = √θ, both arms to θ = 6π, in 2 · `half` equal segments.
fn fermat_spiral(half: usize) -> Headings {
    let at = |angle: f64| DVec2::from_angle(angle) * angle.sqrt();
    // Distances from a point of the arm increase along it up to at least 1.5.
    let next = |last: f64, length: f64| {
        last_where([last, last + 1.5], |angle| at(angle).distance(at(last)) < length)
    };
    let arm = |length: f64| marched(half, |last| next(last, length));
    let length = last_where([0.5, 2.0], |length| arm(length)[half] < 6.0 * PI);
    let arm: Vec<DVec2> = arm(length).into_iter().map(at).collect();
    let inward = arm[1..].iter().rev().map(|&p| -p);
    headings(&inward.chain(arm.iter().copied()).collect::<Vec<_>>())
}

/// 0 and `count` further numbers, each computed from the previous one.
fn marched(count: usize, next: impl Fn(f64) -> f64) -> Vec<f64> {
    let numbers = std::iter::successors(Some(0.0), |&last| Some(next(last)));
    numbers.take(count + 1).collect()
}

/// The number between the two up to which `holds` is true.
fn last_where([mut low, mut high]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = low.midpoint(high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The headings of a polyline, without jumps by full turns.
fn headings(points: &[DVec2]) -> Headings {
    let segments: Vec<DVec2> = points.windows(2).map(|p| p[1] - p[0]).collect();
    let mut headings = vec![segments[0].to_angle()];
    for pair in segments.windows(2) {
        headings.push(headings[headings.len() - 1] + pair[0].angle_to(pair[1]));
    }
    headings
}

/// All turns scaled to a deployment fraction; the heading in the middle is kept.
fn scaled(headings: &Headings, fraction: f64) -> Headings {
    let middle = headings[headings.len() / 2];
    headings.iter().map(|h| middle + (h - middle) * fraction).collect()
}

fn points(headings: &Headings) -> Vec<DVec2> {
    let mut points = vec![DVec2::ZERO];
    for heading in headings {
        points.push(points[points.len() - 1] + DVec2::from_angle(*heading));
    }
    points
}

/// The strip at deployment fractions from `first` to `last`, in `intervals` equal steps.
fn unrolling(headings: &Headings, first: f64, last: f64, intervals: u32) -> Motion {
    let sheet = strip(headings.len() as u32, 1);
    let state = |k: u32| {
        let fraction = first + (last - first) * f64::from(k) / f64::from(intervals);
        folded(&sheet, &scaled(headings, fraction))
    };
    motion(sheet.clone(), (0..=intervals).map(state))
}

fn judge(motion: &Motion) -> CollisionReport {
    collisions(motion, &CollisionOptions::default(), &|_| true).unwrap()
}

/// The first and the last deployment fraction at which the scaled chain crosses itself, by dense exact tests.
fn crossing_fractions(headings: &Headings) -> Option<[f64; 2]> {
    let crosses =
        |fraction: f64| first_crossing(&points(&scaled(headings, fraction)), false).is_some();
    let samples: Vec<f64> =
        (1..1000).map(|k| f64::from(k) / 1000.0).filter(|&f| crosses(f)).collect();
    Some([*samples.last()?, *samples.first()?])
}

#[test]
fn a_fermat_spiral_of_100_segments_penetrates_between_the_fractions_sampling_finds_and_is_clear_outside()
 {
    let spiral = fermat_spiral(50);
    let [first, last] = crossing_fractions(&spiral).unwrap();
    assert!((first - 0.85).abs() < 0.02 && (last - 0.34).abs() < 0.02, "{first} {last}");
    let report = judge(&unrolling(&spiral, 1.0, 0.0, 1000));
    assert_eq!(report.verdict, Verdict::Penetrating);
    let begins = 1.0 - report.first.unwrap().time / 1000.0;
    assert!((begins - first).abs() < 0.01, "{begins} {first}");
    let before = judge(&unrolling(&spiral, 1.0, first + 0.01, 200));
    assert_eq!(before.verdict, Verdict::Free);
    let after = judge(&unrolling(&spiral, last - 0.01, 0.0, 400));
    assert_eq!(after.verdict, Verdict::Free);
    let end = judge(&unrolling(&spiral, last + 0.01, 0.0, 400));
    assert_eq!(end.verdict, Verdict::Penetrating);
}

/// The headings of a closed outline, whose first point is not repeated.
fn closed(outline: &[DVec2]) -> Headings {
    headings(&[outline, &outline[..1]].concat())
}

/// NACA 0012 with a closed trailing edge, in 2 · `half` segments of equal length.
fn airfoil(half: usize) -> Headings {
    let upper = |x: f64| {
        let z = 0.2969 * x.sqrt() - 0.1260 * x - 0.3516 * x * x + 0.2843 * x.powi(3)
            - 0.1036 * x.powi(4);
        DVec2::new(x, 0.6 * z)
    };
    // From the leading edge along x = u², on which distances increase.
    let next = |last: f64, length: f64| {
        let start = upper(last * last);
        last_where([last, last + 1.0], |u| upper(u * u).distance(start) < length)
    };
    let march = |length: f64| marched(half, |last| next(last, length));
    let scale = 1.0 / half as f64;
    let length = last_where([0.5 * scale, 2.0 * scale], |length| march(length)[half] < 1.0);
    let side: Vec<DVec2> = march(length).into_iter().map(|u| upper(u * u)).collect();
    let back = side.iter().rev().copied();
    let forth = side[1..half].iter().map(|p| DVec2::new(p.x, -p.y));
    closed(&back.chain(forth).collect::<Vec<_>>())
}

#[test]
fn a_circle_and_an_airfoil_touch_only_at_their_seam_and_open() {
    let circle: Vec<DVec2> =
        (0..30).map(|k| DVec2::from_angle(TAU * f64::from(k) / 30.0)).collect();
    for (name, headings) in [("circle", closed(&circle)), ("airfoil", airfoil(20))] {
        let report = judge(&unrolling(&headings, 1.0, 0.0, 120));
        assert_eq!(report.verdict, Verdict::Touching, "{name}: {:?}", report.first);
        // The facets on either side of the seam: two triangles each.
        assert!(report.touching_pairs <= 4, "{name}: {}", report.touching_pairs);
        assert_eq!(crossing_fractions(&headings), None, "{name}");
        let opened = judge(&unrolling(&headings, 0.99, 0.0, 120));
        assert_eq!(opened.verdict, Verdict::Free, "{name}");
    }
}

#[test]
fn a_capital_omega_stays_clear() {
    // A foot, back into the neck, a bowl of nine tenths of a turn, and out to the other foot.
    let bowl = (0..=20).map(|k| 2.7 - 0.27 * f64::from(k));
    let omega: Headings = [0.0; 3].into_iter().chain(bowl).chain([0.0; 3]).collect();
    assert_eq!(first_crossing(&points(&omega), false), None);
    let report = judge(&unrolling(&omega, 1.0, 0.0, 120));
    assert_eq!(report.verdict, Verdict::Free, "{:?}", report.first);
    assert_eq!(crossing_fractions(&omega), None);
}

#[test]
fn the_first_contact_of_a_recorded_motion_is_found_to_a_millionth_of_a_frame_interval() {
    for (half, intervals) in [(50, 100), (40, 60), (30, 37)] {
        let motion = unrolling(&fermat_spiral(half), 1.0, 0.3, intervals);
        let report = judge(&motion);
        let first = report.first.unwrap();
        let sampled = first_contact(&motion);
        assert!((first.time - sampled).abs() < 1e-6, "{half}: {} {sampled}", first.time);
    }
}

/// The first instant at which the profile of the straight paths between frames crosses itself: dense samples, then
/// bisection.
fn first_contact(motion: &Motion) -> f64 {
    let profile = |frame: usize, share: f64| -> Vec<DVec2> {
        let [from, to] = [frame, frame + 1].map(|k| &motion.frames[k].positions);
        let pairs = from.iter().zip(to).step_by(2);
        let flat = |p: DVec3| DVec2::new(p.x, p.z);
        pairs.map(|(&a, &b)| flat(a).lerp(flat(b), share)).collect()
    };
    let crosses =
        |frame: usize, share: f64| first_crossing(&profile(frame, share), false).is_some();
    let parts = 200;
    for frame in 0..motion.frames.len() - 1 {
        let Some(part) = (1..=parts).find(|&k| crosses(frame, f64::from(k) / f64::from(parts)))
        else {
            continue;
        };
        let ends = [part - 1, part].map(|k| f64::from(k) / f64::from(parts));
        return frame as f64 + last_where(ends, |share| !crosses(frame, share));
    }
    panic!("the motion crosses nowhere");
}
