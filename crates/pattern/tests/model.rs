//! The built-in profiles: their tables, their sources, their division.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

use foldmotion_geometry::{
    Division, DivisionOptions, Profile, divide, divide_from, divide_to_length,
};
use foldmotion_pattern::{CaseColumns, ProfileModel, Shape, find_model, models};
use glam::DVec2;

fn model(name: &str) -> &'static ProfileModel {
    find_model(name).unwrap()
}

fn divided(model: &ProfileModel) -> (Profile, Division) {
    divide_to_length(
        &model.profile().unwrap(),
        model.rows,
        model.length(),
        &DivisionOptions::default(),
    )
    .unwrap()
}

/// |R_max| of table 1, which no division here may exceed.
const TABLE_1: [f64; 9] = [
    2.62096e-14,
    1.95472e-14,
    7.28233e-14,
    2.73695e-11,
    5.03413e-13,
    1.06474e-13,
    1.40942e-12,
    6.06483e-13,
    7.24736e-11,
];

#[test]
fn rows_and_columns_are_those_of_tables_1_and_2() {
    let found: Vec<_> =
        models().iter().map(|m| (m.rows, m.columns.e, (m.columns.t, m.columns.s))).collect();
    let table_1 = [(7, 5), (9, 4), (12, 4), (100, 2), (35, 5), (14, 3), (20, 3), (26, 7), (100, 5)];
    for ((rows, columns, _), expected) in found.iter().zip(table_1) {
        assert_eq!((*rows, *columns), expected);
    }
    for (name, columns) in
        [("chair", (6, 2)), ("omega", (6, 4)), ("mushroom", (5, 2)), ("bunny", (8, 3))]
    {
        let model = model(name);
        assert_eq!((model.columns.t, model.columns.s), columns);
        assert!(!model.columns.ours);
    }
    assert_eq!(models().iter().filter(|m| m.columns.ours).count(), 5);
    for model in models() {
        let CaseColumns { e, t, s, .. } = model.columns;
        assert!(s < e && e < t, "{}: T narrows the units, S widens them", model.name);
        assert_eq!(find_model(model.name), Some(model));
    }
    assert_eq!(find_model("Shelter"), None);
}

#[test]
fn every_division_is_equal_to_1e_minus_13_and_never_worse_than_table_1() {
    for (model, paper) in models().iter().zip(TABLE_1) {
        let (_, division) = divided(model);
        assert!(division.converged(), "{}: {:?}", model.name, division.ending);
        let residual = division.max_residual;
        assert!(residual <= paper.min(1e-13), "{}: {residual:e}", model.name);
        assert!((division.length() - model.length()).abs() <= 1e-14 * model.length());
    }
}

#[test]
fn a_thousand_random_rising_starts_and_even_parameters_reach_the_division_of_even_arc_length() {
    let mut random = fastrand::Rng::with_seed(1);
    for model in models() {
        let profile = model.profile().unwrap();
        let options = DivisionOptions::default();
        let expected = divide(&profile, model.rows, &options).unwrap();
        let even: Vec<_> = (0..=model.rows).map(|k| k as f64 / model.rows as f64).collect();
        let random_starts = (0..112).map(|_| {
            let mut start: Vec<_> = (1..model.rows).map(|_| random.f64()).collect();
            start.extend([0.0, 1.0]);
            start.sort_by(f64::total_cmp);
            start
        });
        for start in std::iter::once(even).chain(random_starts) {
            let division = divide_from(&profile, &start, &options).unwrap();
            assert!(division.max_residual <= 1e-13, "{}", model.name);
            for (u, expected) in division.parameters.iter().zip(&expected.parameters) {
                assert!((u - expected).abs() <= 1e-9, "{}", model.name);
            }
        }
    }
}

/// The farthest that any of `points` lies from the polyline through `line`, over the diagonal of the box of `line`.
fn farthest(points: &[DVec2], line: &[DVec2]) -> f64 {
    let to_segment = |p: DVec2, a: DVec2, b: DVec2| {
        let share = (p - a).dot(b - a) / (b - a).length_squared();
        p.distance(a.lerp(b, share.clamp(0.0, 1.0)))
    };
    let distance = |p: &DVec2| {
        let nearest = line.windows(2).map(|s| to_segment(*p, s[0], s[1]));
        nearest.fold(f64::INFINITY, f64::min)
    };
    let low = line.iter().copied().reduce(DVec2::min).unwrap();
    let high = line.iter().copied().reduce(DVec2::max).unwrap();
    points.iter().map(distance).fold(0.0, f64::max) / low.distance(high)
}

#[test]
fn curves_stay_within_half_a_percent_of_their_sources_both_ways() {
    let sources: [(&str, Vec<DVec2>); 3] = [
        ("fermat-spiral", {
            let end = (6.0 * std::f64::consts::PI).sqrt();
            (-1000..=1000)
                .map(|k| {
                    let t: f64 = end * f64::from(k) / 1000.0;
                    // r² = θ; the other arm stands opposite.
                    let (r, theta) = (t, t * t);
                    DVec2::new(r * theta.cos(), r * theta.sin())
                })
                .collect()
        }),
        ("airfoil", {
            let Shape::Naca(section) = model("airfoil").shape else { panic!() };
            (0..=1000)
                .map(|k| section.point(std::f64::consts::TAU * f64::from(k) / 1000.0))
                .collect()
        }),
        ("bunny", {
            let Shape::Points(points) = model("bunny").shape else { panic!() };
            let closing = points.iter().chain(points.first());
            closing.copied().map(DVec2::from).collect()
        }),
    ];
    for (name, source) in sources {
        let profile = model(name).profile().unwrap();
        let curve: Vec<_> = (0..=4000).map(|k| profile.position(f64::from(k) / 4000.0)).collect();
        let (away, missed) = (farthest(&curve, &source), farthest(&source, &curve));
        assert!(away <= 5e-3 && missed <= 5e-3, "{name}: {away} {missed}");
        assert!(
            farthest(&curve[..3500], &source) < farthest(&source, &curve[..3500]),
            "a cut curve fails"
        );
    }
}

#[test]
fn closed_models_run_counter_clockwise_so_that_the_left_is_their_inside() {
    for model in models().iter().filter(|m| m.is_closed()) {
        let (_, division) = divided(model);
        let twice_area: f64 = division.points.windows(2).map(|p| p[0].perp_dot(p[1])).sum();
        assert!(twice_area > 0.0, "{}", model.name);
        assert_eq!(division.points.first(), division.points.last());
    }
}

#[test]
fn the_shelter_reads_foot_wall_roof_wall_foot_from_right_to_left() {
    let (_, division) = divided(model("shelter"));
    let directions: Vec<_> = division
        .points
        .windows(2)
        .map(|p| (p[1] - p[0]).to_angle().rem_euclid(std::f64::consts::TAU).to_degrees())
        .collect();
    let expected = [180.0, 99.5, 143.2, 180.0, 216.8, 260.5, 180.0];
    for (direction, expected) in directions.iter().zip(expected) {
        assert!((direction - expected).abs() < 0.1, "{directions:?}");
    }
}

#[test]
fn the_shelter_stands_on_the_ground_and_is_mirror_symmetric() {
    let (profile, division) = divided(model("shelter"));
    for (a, b) in division.points.iter().zip(division.points.iter().rev()) {
        assert!((a.x + b.x).abs() < 1e-13 && (a.y - b.y).abs() < 1e-13, "{a} {b}");
    }
    let feet = [0, 1, 6, 7].map(|k| division.points[k].y);
    assert_eq!(feet, [0.0; 4]);
    for k in 0..=1000 {
        assert!(profile.position(f64::from(k) / 1000.0).y >= 0.0);
    }
}
