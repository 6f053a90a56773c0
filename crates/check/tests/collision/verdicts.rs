use std::f64::consts::PI;

use foldmotion_check::{
    CheckError, CollisionOptions, CollisionReport, PenetrationKind, Verdict, collisions,
    penetration_spans,
};
use foldmotion_pattern::{Assignment, Motion};
use glam::{DQuat, DVec2, DVec3};

use crate::sheets::{accordion, fold, folded, motion, sheet, strip};

fn judge(motion: &Motion) -> CollisionReport {
    collisions(motion, &CollisionOptions::default(), &|_| true).unwrap()
}

/// Two separate triangles; the states displace the second.
fn two_plates(states: &[DVec3]) -> Motion {
    let base = [DVec2::ZERO, DVec2::X, DVec2::Y];
    let vertices = base.into_iter().chain(base.map(|p| p + DVec2::X * 5.0));
    let sheet = sheet(vertices.collect(), vec![[0, 1, 2], [3, 4, 5]]);
    let place = |&at: &DVec3| {
        let lower = base.map(|p| p.extend(0.0));
        let upper = base.map(|p| p.extend(0.0) * 0.5 + at);
        lower.into_iter().chain(upper).collect()
    };
    motion(sheet, states.iter().map(place))
}

#[test]
fn a_strip_that_stays_apart_is_free_with_its_closest_approach() {
    // Three squares folded to a narrowing channel and back: the free ends of the first and the third come closest.
    let channel = [1.8, 0.0, -1.8];
    let expected = 1.0 + 2.0 * f64::cos(1.8);
    let report = judge(&fold(3, &[&[0.0; 3], &channel, &[0.0; 3]], 7));
    assert_eq!(report.verdict, Verdict::Free, "{report:?}");
    let separation = report.min_separation.unwrap();
    assert!((separation.distance - expected).abs() < 1e-4, "{separation:?}");
    assert_eq!(separation.time, 7.0);
    assert_eq!(report.separation_series.len(), 15);
    assert_eq!(report.touching_pairs, 0);
    let gap = separation.points[0].distance(separation.points[1]);
    assert!((gap - separation.distance).abs() < 1e-12);
}

#[test]
fn the_closest_approach_between_frames_is_found() {
    // The corner of the upper plate passes the lower one at a height of 0.1 halfway through.
    let report = judge(&two_plates(&[DVec3::new(-2.0, 0.1, 0.1), DVec3::new(2.0, 0.1, 0.1)]));
    let separation = report.min_separation.unwrap();
    assert_eq!(report.verdict, Verdict::Free);
    assert!((separation.distance - 0.1).abs() < 2e-5, "{separation:?}");
    assert!((0.3..0.9).contains(&separation.time));
    assert!(report.separation_series.iter().all(|&d| d > 0.9));
}

#[test]
fn plates_pass_through_each_other_between_two_frames() {
    let report = judge(&two_plates(&[DVec3::new(0.1, 0.1, 0.3), DVec3::new(0.1, 0.1, -0.1)]));
    assert_eq!(report.verdict, Verdict::Penetrating);
    let first = report.first.unwrap();
    assert_eq!(first.kind, PenetrationKind::PassedThrough);
    assert!((first.time - 0.75).abs() < 1e-6 && first.passed >= first.time);
    assert!(first.depth <= 1e-6 && first.vertices.len() >= 3);
    assert!(first.point.z.abs() < 1e-5);
    assert_eq!(report.min_separation.unwrap().distance, 0.0);
}

#[test]
fn plates_that_touch_and_part_are_touching_and_those_that_stop_a_little_apart_too() {
    let at = |z: f64| DVec3::new(0.1, 0.1, z);
    for least in [0.0, 0.9e-6, -0.9e-6] {
        let report = judge(&two_plates(&[at(0.3), at(least), at(0.3)]));
        assert_eq!(report.verdict, Verdict::Touching, "{least}: {report:?}");
        assert_eq!(report.touching_pairs, 1);
    }
    let report = judge(&two_plates(&[at(0.3), at(1.1e-6), at(0.3)]));
    assert_eq!(report.verdict, Verdict::Free);
    let report = judge(&two_plates(&[at(0.3), at(0.0), at(-0.3)]));
    assert_eq!(report.verdict, Verdict::Penetrating);
    let wide = CollisionOptions { touch_tolerance: 1e-3, ..CollisionOptions::default() };
    let near = two_plates(&[at(0.3), at(5e-4), at(0.3)]);
    let report = collisions(&near, &wide, &|_| true).unwrap();
    assert_eq!((report.verdict, report.tolerance), (Verdict::Touching, 1e-3));
}

#[test]
fn plates_that_start_on_each_other_may_part_on_either_side_but_not_come_back_on_the_other() {
    let at = |z: f64| DVec3::new(0.1, 0.1, z);
    for z in [0.2, -0.2] {
        let report = judge(&two_plates(&[at(0.0), at(z), at(0.0)]));
        assert_eq!(report.verdict, Verdict::Touching);
    }
    let report = judge(&two_plates(&[at(0.0), at(0.2), at(0.0), at(-0.2)]));
    assert_eq!(report.verdict, Verdict::Penetrating);
    assert!(report.first.unwrap().time >= 1.0);
}

#[test]
fn a_strip_folded_through_itself_penetrates_at_the_right_time() {
    // The fourth square swings through the first, starting at its free end.
    let states: [&[f64]; 3] = [&[0.0; 4], &[0.0, 1.9, 3.3, 4.2], &[0.0, 1.9, 4.0, 5.0]];
    let report = judge(&fold(4, &states, 12));
    assert_eq!(report.verdict, Verdict::Penetrating);
    let first = report.first.clone().unwrap();
    assert!(first.depth > 1e-6 && first.kind != PenetrationKind::FoldedThrough);
    // Dense frames of the same motion find the first contact no earlier than straight paths allow.
    let dense = judge(&fold(4, &states, 240));
    let dense_first = dense.first.unwrap().time / 20.0;
    assert!((dense_first - first.time).abs() < 0.1, "{dense_first} {first:?}");
    assert!(report.penetrations.is_sorted_by(|p, q| p.time <= q.time));
}

#[test]
fn a_fold_of_exactly_half_a_turn_touches_and_one_past_it_penetrates_by_its_overlap() {
    let to = |past: f64| judge(&fold(2, &[&[0.0, 0.0], &[0.0, PI + past]], 20));
    for past in [0.0, 5e-7, -1e-9] {
        assert_eq!(to(past).verdict, Verdict::Touching, "{past}");
    }
    assert_eq!(to(-0.01).verdict, Verdict::Free);
    for past in [1e-5, 0.01, 0.5] {
        let report = to(past);
        assert_eq!(report.verdict, Verdict::Penetrating, "{past}");
        let hinge =
            report.penetrations.iter().find(|p| p.kind == PenetrationKind::FoldedThrough).unwrap();
        assert_eq!(hinge.vertices.len(), 4);
    }
}

#[test]
fn a_crease_that_starts_folded_takes_the_side_of_its_assignment() {
    let to = |angle: f64, assignment: Assignment| {
        let mut motion = fold(2, &[&[0.0, PI], &[0.0, angle]], 4);
        for edge in motion.sheet.edges.iter_mut().filter(|e| e.is_hinge()) {
            edge.assignment = assignment;
        }
        judge(&motion).verdict
    };
    assert_eq!(to(PI - 0.1, Assignment::Valley), Verdict::Touching);
    assert_eq!(to(PI + 0.1, Assignment::Valley), Verdict::Penetrating);
    assert_eq!(to(PI + 0.1, Assignment::Mountain), Verdict::Touching);
    assert_eq!(to(PI - 0.1, Assignment::Mountain), Verdict::Penetrating);
}

#[test]
fn a_closed_ring_whose_seam_opens_touches() {
    let ring: Vec<_> = (0..6).map(|k| f64::from(k) * PI / 3.0).collect();
    let report = judge(&fold(6, &[&ring, &[0.0; 6]], 10));
    assert_eq!(report.verdict, Verdict::Touching, "{:?}", report.first);
    assert!(report.min_separation.unwrap().distance < 1e-6);
    let too_far: Vec<_> = ring.iter().map(|a| a * 1.05).collect();
    let report = judge(&fold(6, &[&[0.0; 6], &ring, &too_far], 10));
    assert_eq!(report.verdict, Verdict::Penetrating);
}

#[test]
fn crossing_around_a_shared_vertex_is_found() {
    let vertices = [(0.0, 0.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let vertices: Vec<_> = vertices.into_iter().map(DVec2::from).collect();
    let fan = sheet(vertices.clone(), vec![[0, 1, 2], [0, 3, 4]]);
    let swung = |z: f64| {
        let mut at: Vec<_> = vertices.iter().map(|v| v.extend(0.0)).collect();
        at[3] = DVec3::new(0.6, 0.1, z);
        at[4] = DVec3::new(-0.4, 0.0, 1.0);
        at
    };
    let judged = |heights: &[f64]| judge(&motion(fan.clone(), heights.iter().map(|&z| swung(z))));
    assert_eq!(judged(&[0.5, 0.1, 0.4]).verdict, Verdict::Free);
    assert_eq!(judged(&[0.5, 0.0, 0.4]).verdict, Verdict::Touching);
    let report = judged(&[0.5, 0.0, -0.3]);
    assert_eq!(report.verdict, Verdict::Penetrating);
    let first = report.first.unwrap();
    assert_eq!(first.kind, PenetrationKind::AroundVertex);
    assert!(first.time <= first.passed && first.passed < 1.001);
}

#[test]
fn an_accordion_folds_free_to_layers_a_thousandth_apart_and_not_through_each_other() {
    let report = judge(&accordion(8, 2, 40, 1e-3, 0.7));
    assert_eq!(report.verdict, Verdict::Free, "{:?}", report.first);
    assert!(report.undecided.is_empty());
    let flat = judge(&accordion(8, 2, 40, 0.0, 0.7));
    assert_eq!(flat.verdict, Verdict::Touching, "{:?}", flat.first);
    let past = judge(&accordion(8, 2, 40, -1e-3, 0.7));
    assert_eq!(past.verdict, Verdict::Penetrating);
}

#[test]
fn verdicts_do_not_depend_on_position_order_or_threads() {
    let states: [&[f64]; 3] = [&[0.0; 4], &[0.0, 1.9, 3.3, 4.2], &[0.0, 1.9, 4.0, 5.0]];
    let motions = [fold(4, &states, 9), accordion(6, 1, 12, 1e-3, 0.3)];
    let turn = DQuat::from_axis_angle(DVec3::new(2.0, -1.0, 2.0) / 3.0, 1.234);
    for original in motions {
        let expected = judge(&original);
        let mut moved = original.clone();
        for frame in &mut moved.frames {
            for p in &mut frame.positions {
                *p = turn * *p + DVec3::new(30.0, -7.0, 2.0);
            }
        }
        let report = judge(&moved);
        assert_eq!(report.verdict, expected.verdict);
        let time = |r: &CollisionReport| r.first.as_ref().map_or(0.0, |p| p.time);
        assert!((time(&report) - time(&expected)).abs() < 1e-6);

        let mut reversed = original.clone();
        reversed.sheet = sheet(
            original.sheet.vertices.clone(),
            original.sheet.faces.iter().rev().copied().collect(),
        );
        let report = judge(&reversed);
        assert_eq!(report.verdict, expected.verdict);
        assert!((time(&report) - time(&expected)).abs() < 1e-6);

        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            assert_eq!(pool.install(|| judge(&original)), expected);
        }
    }
}

#[test]
fn motions_that_cannot_be_judged_are_refused_by_name() {
    let good = fold(2, &[&[0.0, 0.0], &[0.0, 1.0]], 3);
    let with = |change: &dyn Fn(&mut Motion)| {
        let mut motion = good.clone();
        change(&mut motion);
        collisions(&motion, &CollisionOptions::default(), &|_| true).unwrap_err()
    };
    let nan = with(&|m| m.frames[2].positions[1].y = f64::NAN);
    assert!(matches!(nan, CheckError::NotFinite { frame: 2, vertex: 1, .. }));
    let short = with(&|m| m.frames[1].positions.truncate(3));
    assert!(matches!(short, CheckError::FrameSize { frame: 1, .. }));
    let order = with(&|m| m.frames[2].time = 1.0);
    assert!(matches!(order, CheckError::TimeOrder { frame: 2, .. }));
    let flat = with(&|m| m.frames[1].positions[1] = m.frames[1].positions[0]);
    assert!(matches!(flat, CheckError::DegenerateFace { frame: 1, .. }));
    let far = with(&|m| m.frames[1].positions.iter_mut().for_each(|p| p.x += 1e9));
    assert!(matches!(far, CheckError::ToleranceBelowRounding { .. }));
    let corner = with(&|m| m.sheet.faces[0][0] = 77);
    assert!(matches!(corner, CheckError::CornerOutOfRange { face: 0, vertex: 77, .. }));
    let twice = with(&|m| m.sheet.faces[1] = m.sheet.faces[0]);
    assert!(matches!(twice, CheckError::DuplicateFace { f: 0, g: 1 }));
    assert_eq!(with(&|m| m.frames.clear()), CheckError::NoFrames);
    for touch_tolerance in [0.0, -1.0, f64::NAN, 0.5] {
        let options = CollisionOptions { touch_tolerance, ..CollisionOptions::default() };
        let refused = collisions(&good, &options, &|_| true).unwrap_err();
        assert!(matches!(refused, CheckError::ToleranceOutOfRange { .. }));
    }
    let cancelled = collisions(&good, &CollisionOptions::default(), &|done| done < 0.5);
    assert_eq!(cancelled, Err(CheckError::Cancelled { intervals: 2 }));
}

#[test]
fn with_an_exhausted_budget_freedom_is_still_proved_by_distance_and_no_penetration_is_hidden() {
    let options = CollisionOptions { budget: 1, ..CollisionOptions::default() };
    let of = |motion: &Motion| collisions(motion, &options, &|_| true).unwrap();
    let apart = of(&accordion(6, 1, 4, 1e-3, 2.0));
    let separation = apart.min_separation.unwrap();
    assert_eq!(apart.verdict == Verdict::Free, separation.distance > 1e-6, "{separation:?}");
    let through = two_plates(&[DVec3::new(0.1, 0.1, 0.3), DVec3::new(0.1, 0.1, -0.3)]);
    assert_eq!(of(&through).verdict, Verdict::Penetrating);
}

#[test]
fn a_single_frame_is_judged_as_it_is() {
    let plates = |at: DVec3| judge(&two_plates(&[at])).verdict;
    assert_eq!(plates(DVec3::new(0.1, 0.1, 0.2)), Verdict::Free);
    assert_eq!(plates(DVec3::new(0.1, 0.1, 0.0)), Verdict::Touching);
    assert_eq!(plates(DVec3::new(0.1, 0.1, 5e-7)), Verdict::Touching);
    let sheet = strip(4, 1);
    let crossed = folded(&sheet, &[0.0, 1.9, 4.0, 5.0]);
    let report = judge(&motion(sheet, [crossed]));
    assert_eq!(report.verdict, Verdict::Penetrating);
    assert!(report.first.unwrap().depth > 0.01);
}

#[test]
fn a_penetration_lasts_until_the_plates_are_no_longer_in_each_other() {
    // The corner of the upright plate sinks through the lying one by 0.2 and rises again.
    let heights = [0.3, 0.1, -0.1, -0.2, -0.1, 0.1, 0.3];
    let base = [DVec2::ZERO, DVec2::X, DVec2::Y];
    let vertices = base.into_iter().chain(base.map(|p| p + DVec2::X * 5.0));
    let sheet = sheet(vertices.collect(), vec![[0, 1, 2], [3, 4, 5]]);
    let place = |&height: &f64| {
        let lower = base.map(|p| p.extend(0.0));
        let upper = [(0.0, 0.0), (0.1, 1.0), (-0.1, 1.0)]
            .map(|(x, z)| DVec3::new(0.3 + x, 0.3, height + z));
        lower.into_iter().chain(upper).collect()
    };
    let motion = motion(sheet, heights.iter().map(place));
    let report = judge(&motion);
    let spans = penetration_spans(&motion, &report);
    assert_eq!(spans.len(), 1, "{report:?}");
    assert_eq!(spans[0].from, report.first.unwrap().time);
    assert!((spans[0].from - 1.5).abs() < 1e-6, "{spans:?}");
    assert_eq!(spans[0].to, 4.0);
    // Plates that have changed sides are no longer deep in each other: the span is the interval.
    let through = two_plates(&[0.3, -0.1, -0.5].map(|z| DVec3::new(0.1, 0.1, z)));
    let spans = penetration_spans(&through, &judge(&through));
    assert!((spans[0].from - 0.75).abs() < 1e-6, "{spans:?}");
    assert_eq!(spans[0].to, 1.0);
}

/// A small plate that approaches one with sides of 2e4 units, slides below it and leaves, all of it rotated.
fn below_a_large_plate(turn: DQuat) -> Motion {
    let small = |i: u32, j: u32| DVec2::new(f64::from(i), f64::from(j)) / 3.0;
    let large = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let mut vertices: Vec<DVec2> = large.iter().map(|&(x, y)| DVec2::new(x, y) * 1e4).collect();
    vertices.extend((0..4).flat_map(|j| (0..4).map(move |i| small(i, j))));
    let mut faces = vec![[0, 1, 2], [0, 2, 3]];
    for corner in (0..3).flat_map(|j| (0..3).map(move |i| 4 + i + 4 * j)) {
        faces.extend([[corner, corner + 1, corner + 5], [corner, corner + 5, corner + 4]]);
    }
    let places = [(0.0, -1.0), (0.0, 0.0), (0.5, 0.0), (0.0, -1.0)];
    let tilt = DQuat::from_rotation_z(0.8);
    let states = places.map(|(x, z)| {
        let place = |(v, p): (usize, &DVec2)| {
            let is_large = v < 4;
            let moved = tilt * p.extend(0.0) + DVec3::new(x - 0.2, 0.1, z);
            turn * if is_large { p.extend(0.0) } else { moved }
        };
        vertices.iter().enumerate().map(place).collect()
    });
    motion(sheet(vertices.clone(), faces), states)
}

#[test]
fn a_tolerance_gives_the_right_verdict_or_is_refused_however_small_it_is() {
    let [mut judged, mut refused] = [0, 0];
    for k in 0..12 {
        let axis = DVec3::new(1.0, f64::from(k), -2.0).normalize();
        let motion = below_a_large_plate(DQuat::from_axis_angle(axis, 0.7 * f64::from(k)));
        for touch_tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
            let options = CollisionOptions { touch_tolerance, ..CollisionOptions::default() };
            match collisions(&motion, &options, &|_| true) {
                Ok(report) => {
                    judged += 1;
                    assert_eq!(report.verdict, Verdict::Touching, "{k} {touch_tolerance}");
                }
                Err(CheckError::ToleranceBelowRounding { .. }) => refused += 1,
                Err(other) => panic!("{other}"),
            }
        }
    }
    assert_eq!([judged, refused], [48, 24]);
}

/// Triangles with a common corner: an edge of one comes to lie tangentially on a corner of the other, so that two edges
/// are within τ of each other long before the end, √τ earlier.
#[test]
fn edges_that_lie_down_on_each_other_touch_for_every_tolerance() {
    let corners = [[0.0, 0.0], [3.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let faces = vec![[0, 2, 1], [0, 3, 4]];
    let sheet = sheet(corners.map(DVec2::from_array).to_vec(), faces);
    let at = |left: f64| {
        let mut places = corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
        places[1].y = left;
        places[4].z = left;
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 0.9);
        places.into_iter().map(|p| turn * p).collect()
    };
    let motion = motion(sheet, [at(1.0), at(0.0)]);
    for touch_tolerance in [1e-5, 1e-6, 1e-7, 3.5e-8, 1e-8, 1e-9] {
        let options = CollisionOptions { touch_tolerance, ..CollisionOptions::default() };
        let report = collisions(&motion, &options, &|_| true).unwrap();
        assert_eq!(report.verdict, Verdict::Touching, "{touch_tolerance}: {:?}", report.first);
    }
}
