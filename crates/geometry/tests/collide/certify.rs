//! The certificate of two moving triangles on motions whose answer is known.

use foldmotion_geometry::collide::{Limits, MovingPair, Outcome, PairPose, Side, certify};
use foldmotion_geometry::triangle_triangle;
use glam::DVec3;

use foldmotion_random::Random;

const LIMITS: Limits = Limits { tolerance: 1e-6, margin: 1e-13, budget: 4000 };

fn judge(pair: &MovingPair) -> Outcome {
    match Side::at_start(&pair.start, &LIMITS) {
        Some(side) => certify(pair, &side, &LIMITS),
        None => panic!("the pair starts deeper than the tolerance"),
    }
}

fn has_passed(pair: &MovingPair) -> bool {
    matches!(judge(pair), Outcome::Passed(_))
}

fn pose(a: [DVec3; 3], b: [DVec3; 3]) -> PairPose {
    PairPose { a, b, shared: 0 }
}

fn plate() -> [DVec3; 3] {
    [DVec3::new(-1.0, -1.0, 0.0), DVec3::new(2.0, -1.0, 0.0), DVec3::new(-1.0, 2.0, 0.0)]
}

/// A random pair of the given kind: coordinates on a coarse grid (coplanar, parallel, equal coordinates), corners
/// moved by about τ, or general position.
fn random_pair(random: &mut Random, kind: usize, shared: usize) -> MovingPair {
    let point = |random: &mut Random| {
        let p = random.vector();
        match kind {
            0 => p,
            1 => (p * 2.0).round() * 0.5,
            2 => (p * 2.0).round() * 0.5 + random.vector() * 2e-6,
            _ => DVec3::new(p.x, p.y, (p.z * 1.5).round() * 5e-7),
        }
    };
    let make = |random: &mut Random| {
        let a = [(); 3].map(|()| point(random));
        let mut b = [(); 3].map(|()| point(random));
        b[..shared].copy_from_slice(&a[..shared]);
        PairPose { a, b, shared }
    };
    let start = make(random);
    let far = make(random);
    let reach = [1.0, 0.1, 1e-5][random.index(3)];
    let between = |p: [DVec3; 3], q: [DVec3; 3]| [0, 1, 2].map(|i| p[i].lerp(q[i], reach));
    MovingPair {
        start,
        end: PairPose { a: between(start.a, far.a), b: between(start.b, far.b), shared },
    }
}

#[test]
fn no_pair_that_passes_is_deeper_than_the_tolerance_at_any_sampled_instant() {
    let mut random = Random::new(51);
    let (mut passed, mut crossed, mut undecided) = (0, 0, 0);
    for case in 0..6000 {
        let pair = random_pair(&mut random, case % 4, (case / 4) % 3);
        let has_area = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).length() > 1e-9;
        if !has_area(&pair.start.a) || !has_area(&pair.start.b) {
            continue;
        }
        let Some(side) = Side::at_start(&pair.start, &LIMITS) else {
            assert!(pair.start.depth().overlap > LIMITS.tolerance - 2.0 * LIMITS.margin);
            continue;
        };
        let sampled = (0..=60)
            .map(|k| pair.at(f64::from(k) / 60.0).depth().overlap)
            .fold(f64::NEG_INFINITY, f64::max);
        match certify(&pair, &side, &LIMITS) {
            Outcome::Passed(passage) => {
                passed += 1;
                assert!(sampled <= LIMITS.tolerance, "case {case}: {sampled}");
                assert_eq!(passage.in_contact, passage.clearance <= 0.0);
            }
            Outcome::Crossed(crossing) => {
                crossed += 1;
                assert!(crossing.contact <= crossing.passed);
                assert!(crossing.reach > LIMITS.tolerance || crossing.depth > LIMITS.tolerance);
            }
            Outcome::Undecided { .. } => undecided += 1,
        }
    }
    println!("{passed} passed, {crossed} crossed, {undecided} undecided");
    assert!(passed > 1000 && crossed > 500);
    assert!(undecided < 60, "one in a hundred: {undecided}");
}

#[test]
fn pairs_that_stay_apart_pass() {
    let mut random = Random::new(52);
    let mut apart = 0;
    for _ in 0..3000 {
        let pair = random_pair(&mut random, 0, 0);
        let nearest = (0..=200)
            .map(|k| pair.at(f64::from(k) / 200.0))
            .map(|p| triangle_triangle(&p.a, &p.b).distance)
            .fold(f64::INFINITY, f64::min);
        if nearest > 0.04 {
            apart += 1;
            match judge(&pair) {
                Outcome::Passed(passage) => {
                    assert!(!passage.in_contact);
                    assert!(passage.clearance > 0.0 && passage.clearance <= nearest + 1e-12);
                }
                other => panic!("{other:?}"),
            }
        }
    }
    assert!(apart > 300, "{apart}");
}

#[test]
fn a_plate_that_passes_through_a_parallel_plate_crosses_though_it_is_never_deep() {
    let mut random = Random::new(53);
    let (mut over, mut beside) = (0, 0);
    for _ in 0..400 {
        let flat = |t: [DVec3; 3], z: f64| t.map(|p| DVec3::new(p.x, p.y, z));
        let (a, b) = (flat(random.triangle(1.0), 0.0), random.triangle(1.0));
        let (height, drift) =
            ([1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7][random.index(7)], random.vector());
        let pair = MovingPair {
            start: pose(a, flat(b, height)),
            end: pose(a, flat(b.map(|p| p + drift), -height)),
        };
        let meeting = pair.at(0.5);
        let distance = triangle_triangle(&meeting.a, &meeting.b).distance;
        if distance > 1e-3 {
            // Beside each other when the planes meet: going around is not a crossing.
            beside += 1;
            assert!(has_passed(&pair), "{pair:?}");
            continue;
        }
        // Within τ below the plane, a plate may still slide out sideways.
        let below = pair.at(0.5 + 0.5 * LIMITS.tolerance / height);
        let is_over = |p: &PairPose| triangle_triangle(&p.a, &flat(p.b, 0.0)).distance == 0.0;
        if height > 2.0 * LIMITS.tolerance && is_over(&meeting) && is_over(&below) {
            over += 1;
            match judge(&pair) {
                Outcome::Crossed(crossing) => {
                    assert!(crossing.depth <= LIMITS.tolerance, "{crossing:?}");
                    assert!((crossing.contact - 0.5).abs() < 1e-6, "{crossing:?}");
                }
                other => panic!("{height}: {other:?} {pair:?}"),
            }
        }
    }
    assert!(over > 60 && beside > 60, "{over} {beside}");
}

/// A needle whose tip moves from `z0` to `z1` above the plate.
fn needle(z0: f64, z1: f64) -> MovingPair {
    let at = |z: f64| {
        pose(
            plate(),
            [DVec3::new(0.0, 0.0, z), DVec3::new(0.1, 0.0, z + 1.0), DVec3::new(0.0, 0.1, z + 1.0)],
        )
    };
    MovingPair::new(at(z0), at(z1))
}

/// Judges a motion through several poses, passing the side on.
fn judge_path(pairs: &[MovingPair]) -> Outcome {
    let mut side = Side::at_start(&pairs[0].start, &LIMITS).unwrap();
    for pair in &pairs[..pairs.len() - 1] {
        match certify(pair, &side, &LIMITS) {
            Outcome::Passed(passage) => side = passage.side,
            other => return other,
        }
    }
    certify(pairs.last().unwrap(), &side, &LIMITS)
}

#[test]
fn a_corner_that_touches_a_facet_and_goes_back_touches_and_one_that_goes_through_crosses() {
    for depth in [0.0, 1e-9, 0.9e-6] {
        let outcome = judge_path(&[needle(0.3, -depth), needle(-depth, 0.3)]);
        assert!(matches!(&outcome, Outcome::Passed(_)), "{depth}: {outcome:?}");
    }
    let outcome = judge_path(&[needle(0.3, 1e-9), needle(1e-9, 0.3)]);
    assert!(matches!(outcome, Outcome::Passed(_)));
    for depth in [1.1e-6, 1e-3, 0.5, 1e3] {
        match judge(&needle(0.3, -depth)) {
            Outcome::Crossed(crossing) => {
                let contact = 0.3 / (0.3 + depth);
                assert!((crossing.contact - contact).abs() < 1e-7, "{crossing:?}");
                assert!(crossing.passed >= crossing.contact);
            }
            other => panic!("{depth}: {other:?}"),
        }
    }
    let outcome = judge_path(&[needle(0.3, 0.0), needle(0.0, -0.3)]);
    assert!(matches!(outcome, Outcome::Crossed(_)), "stopping at the facet is no way through");
}

#[test]
fn sliding_on_a_facet_and_off_its_edge_to_the_other_side_is_touching() {
    let at = |x: f64, z: f64| {
        let small = [DVec3::ZERO, DVec3::X * 0.2, DVec3::Y * 0.2];
        pose(plate(), small.map(|p| p + DVec3::new(x, -0.5, z)))
    };
    let go = |p: PairPose, q: PairPose| MovingPair { start: p, end: q };
    let path = [
        go(at(0.0, 0.1), at(0.0, 0.0)),
        go(at(0.0, 0.0), at(-2.0, 0.0)),
        go(at(-2.0, 0.0), at(-2.0, -0.1)),
        go(at(-2.0, -0.1), at(0.0, -0.1)),
        go(at(0.0, -0.1), at(0.0, 0.0)),
        go(at(0.0, 0.0), at(0.0, -0.1)),
    ];
    let outcome = judge_path(&path);
    assert!(matches!(&outcome, Outcome::Passed(_)), "{outcome:?}");
    let outcome = judge_path(&[path[0], path[5]]);
    assert!(matches!(&outcome, Outcome::Crossed(_)), "{outcome:?}");
}

#[test]
fn plates_resting_on_each_other_may_turn_together() {
    let turned = |angle: f64| {
        let q = glam::DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 0.5).normalize(), angle);
        let upper = plate().map(|p| p * 0.3);
        pose(plate().map(|p| q * p), upper.map(|p| q * p))
    };
    let above = pose(plate(), plate().map(|p| p * 0.3 + DVec3::Z * 0.2));
    let mut path = vec![MovingPair::new(above, turned(0.0))];
    path.extend(
        (0..20)
            .map(|k| MovingPair::new(turned(f64::from(k) * 0.1), turned(f64::from(k + 1) * 0.1))),
    );
    let outcome = judge_path(&path);
    assert!(matches!(&outcome, Outcome::Passed(p) if p.in_contact), "{outcome:?}");
}

fn folded(angle: f64) -> PairPose {
    PairPose {
        a: [DVec3::ZERO, DVec3::X, DVec3::new(0.3, 1.0, 0.0)],
        b: [DVec3::ZERO, DVec3::X, DVec3::new(0.6, -f64::cos(angle), f64::sin(angle))],
        shared: 2,
    }
}

fn fold(angles: &[f64]) -> Outcome {
    let pairs: Vec<_> =
        angles.windows(2).map(|w| MovingPair::new(folded(w[0]), folded(w[1]))).collect();
    judge_path(&pairs)
}

#[test]
fn a_fold_past_half_a_turn_crosses_where_its_overlap_exceeds_the_tolerance() {
    use std::f64::consts::PI;
    // The tents (apexes at 0.3 and 0.6, height 1) meet at height 0.4 / 0.7.
    let height = 0.4 / 0.7 + 0.2;
    for sign in [1.0, -1.0] {
        let to = |past: f64| fold(&[0.0, sign * 1.5, sign * 3.0, sign * (PI + past)]);
        for past in [-0.1, -1e-9, 0.0, 1e-9, 0.7e-6 / height] {
            let outcome = to(past);
            assert!(matches!(&outcome, Outcome::Passed(_)), "{past}: {outcome:?}");
        }
        for past in [3e-6, 1e-4, 0.1, 1.0] {
            match to(past) {
                Outcome::Crossed(c) => assert!(c.reach > 1e-6, "{past}: {c:?}"),
                other => panic!("{past}: {other:?}"),
            }
        }
    }
    assert!(
        matches!(fold(&[-2.0, -1.0, 1.0, 2.0, 0.1, -1.0]), Outcome::Passed(_)),
        "through flat is harmless"
    );
}

#[test]
fn crossing_around_a_shared_corner_is_found() {
    let at = |z: f64| PairPose {
        a: [DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0)],
        b: [DVec3::ZERO, DVec3::new(0.8, 0.0, z), DVec3::new(-0.5, 0.1, z + 0.5)],
        shared: 1,
    };
    let go = |z0: f64, z1: f64| MovingPair::new(at(z0), at(z1));
    assert!(has_passed(&go(0.5, 0.1)));
    assert!(has_passed(&go(0.5, 0.0)), "lying on it touches");
    let back = judge_path(&[go(0.5, 0.0), go(0.0, 0.5)]);
    assert!(matches!(back, Outcome::Passed(_)));
    let outcome = judge(&go(0.5, -0.2));
    assert!(matches!(&outcome, Outcome::Crossed(_)), "{outcome:?}");
    let outcome = judge_path(&[go(0.5, 0.0), go(0.0, -0.01)]);
    assert!(matches!(&outcome, Outcome::Crossed(_)), "{outcome:?}");
}

#[test]
fn a_wall_that_slides_past_a_corner_and_then_sinks_passes_beside_the_plate() {
    let plate = [
        DVec3::new(-0.75, -0.625, 0.0),
        DVec3::new(0.75, -0.625, 0.0),
        DVec3::new(-0.75, 0.625, 0.0),
    ];
    // Past the corner it is 0.8 τ deep, and along a straight line from one direction to the other at least 0.57 τ.
    let wall = |x: f64, y: f64, z: f64| {
        let foot = DVec3::new(x, y, z);
        let far = foot + DVec3::new(-3.0, 1.5625, 0.0);
        pose(plate, [far, foot, far + DVec3::Z * 2.5])
    };
    let passes = |end: [f64; 2]| MovingPair {
        start: wall(-0.375, 0.3125, 4e-6),
        end: wall(end[0], end[1], -1.04e-5),
    };
    assert!(has_passed(&passes([0.0, 0.46875])));
    // Through the plate, well before the corner.
    assert!(!has_passed(&passes([-0.375, 0.3125])));
}

#[test]
fn a_contact_begins_when_the_triangles_meet_whatever_direction_parted_them_before() {
    let wall = [
        DVec3::new(-0.75, -1.125, 0.75),
        DVec3::new(-0.75, -1.125, -0.75),
        DVec3::new(-0.75, 1.125, 0.75),
    ];
    // At 0.55 a direction vanishes along which they were apart from the start; the corner at x reaches the wall at
    // 0.625.
    let part = |x: f64, z: f64| {
        let tip = DVec3::new(x, 0.0, z);
        let others = [(0.8125, 0.0), (0.25, 0.5625)];
        let others = others.map(|(x, y)| tip + DVec3::new(x, y, -0.8125));
        pose(wall, [tip, others[0], others[1]])
    };
    let pair = MovingPair { start: part(0.1875, -0.75), end: part(-1.3125, 0.75) };
    match judge(&pair) {
        Outcome::Crossed(crossing) => {
            assert!((crossing.contact - 0.625).abs() < 1e-9, "{crossing:?}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_exhausted_budget_is_undecided() {
    let limits = Limits { budget: 2, ..LIMITS };
    let pair = needle(0.3, -0.2);
    let side = Side::at_start(&pair.start, &limits).unwrap();
    assert!(matches!(certify(&pair, &side, &limits), Outcome::Undecided { .. }));
}

/// Mirror images in a folding sheet: corners 1 and 0 meet in a point and pass, but the facets behind them never
/// intersect. Only one of the axes before the contact leads to those after it, and only from close by.
#[test]
fn corners_that_meet_at_a_point_and_pass_touch() {
    let pair = MovingPair {
        start: PairPose {
            a: [
                DVec3::new(
                    -1.182_526_622_228_076_8,
                    -2.356_943_535_021_146_3,
                    -0.684_433_335_193_203_2,
                ),
                DVec3::new(
                    -1.468_041_415_306_987,
                    -1.108_914_930_470_406_7,
                    -0.233_011_272_273_418_5,
                ),
                DVec3::new(
                    -0.894_892_714_888_426_3,
                    -2.253_744_651_172_832_3,
                    0.277_510_039_105_149_7,
                ),
            ],
            b: [
                DVec3::new(
                    -1.471_283_293_825_841,
                    -1.108_914_930_470_406_2,
                    -0.255_010_165_735_981_1,
                ),
                DVec3::new(
                    -1.014_961_075_815_963_3,
                    -1.134_204_455_587_614,
                    -0.422_819_846_456_129_8,
                ),
                DVec3::new(
                    -0.886_723_344_561_860_7,
                    9.146_247_275_904_074e-05,
                    -0.764_416_852_652_660_4,
                ),
            ],
            shared: 0,
        },
        end: PairPose {
            a: [
                DVec3::new(
                    -1.138_008_116_994_137_2,
                    -2.347_105_275_973_367,
                    -0.727_810_881_619_428_9,
                ),
                DVec3::new(
                    -1.459_491_866_842_780_8,
                    -1.101_339_925_526_613_6,
                    -0.291_868_074_058_533_1,
                ),
                DVec3::new(
                    -0.901_914_234_493_968_8,
                    -2.241_136_408_263_309_4,
                    0.247_913_304_495_723_02,
                ),
            ],
            b: [
                DVec3::new(
                    -1.446_119_047_674_940_8,
                    -1.101_339_925_526_613_6,
                    -0.201_122_161_632_596_16,
                ),
                DVec3::new(
                    -0.995_028_205_323_127,
                    -1.127_929_456_575_127_7,
                    -0.381_968_598_817_210_85,
                ),
                DVec3::new(
                    -0.875_504_853_344_714_5,
                    8.453_937_699_748_337e-05,
                    -0.742_179_637_791_598_1,
                ),
            ],
            shared: 0,
        },
    };
    let limits = Limits { tolerance: 1e-6, margin: Limits::margin_for(3.0), budget: 4096 };
    let side = Side::at_start(&pair.start, &limits).unwrap();
    match certify(&pair, &side, &limits) {
        Outcome::Passed(passage) => assert!(passage.in_contact, "{passage:?}"),
        other => panic!("{other:?}"),
    }
}
