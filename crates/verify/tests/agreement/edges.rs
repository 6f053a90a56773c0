//! Passages through an edge between triangles, proved twice.

use foldmotion_check::{CollisionReport, PenetrationKind, Verdict};
use foldmotion_pattern::Motion;
use foldmotion_verify::verify;
use glam::{DVec2, DVec3};

use crate::sheets::{motion, sheet};
use crate::{agreed, judge};

/// A roof of two triangles at the edge from 0 to 1, and a triangle above it that is displaced by `moves`.
fn above_a_roof(slope: f64, part: [DVec3; 3], moves: &[DVec3]) -> Motion {
    let roof = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1.0, -slope), DVec3::new(0.5, -1.0, -slope)];
    let flat = [
        DVec2::ZERO,
        DVec2::X,
        DVec2::new(0.5, 1.0),
        DVec2::new(0.5, -1.0),
        DVec2::new(3.0, 0.0),
        DVec2::new(4.0, 0.0),
        DVec2::new(3.5, 1.0),
    ];
    let sheet = sheet(flat.to_vec(), vec![[0, 1, 2], [1, 0, 3], [4, 5, 6]]);
    let states = moves.iter().map(|&by| {
        let part = part.map(|p| p + by);
        roof.into_iter().chain(part).collect::<Vec<_>>()
    });
    let states: Vec<_> = states.collect();
    motion(sheet, states)
}

/// A triangle in the plane that contains the edge.
fn wall() -> [DVec3; 3] {
    [DVec3::new(0.3, 0.0, 0.5), DVec3::new(0.7, 0.0, 0.5), DVec3::new(0.5, 0.0, 1.5)]
}

fn through_the_edge() -> Motion {
    let down = DVec3::new(0.0, 0.0, -1.0);
    above_a_roof(0.5, wall(), &[DVec3::ZERO, down * 0.25, down])
}

fn without_penetrations(report: &CollisionReport) -> CollisionReport {
    CollisionReport {
        verdict: Verdict::Touching,
        first: None,
        penetrations: Vec::new(),
        ..report.clone()
    }
}

#[test]
fn a_wall_that_sinks_through_an_edge_penetrates_and_one_that_comes_to_rest_on_it_touches() {
    assert_eq!(agreed(&through_the_edge()), Verdict::Penetrating);
    let down = DVec3::new(0.0, 0.0, -0.5);
    let there_and_back = above_a_roof(0.5, wall(), &[DVec3::ZERO, down, DVec3::ZERO]);
    assert_eq!(agreed(&there_and_back), Verdict::Touching);
}

#[test]
fn a_wall_that_sinks_through_an_edge_is_found_where_nothing_is_listed() {
    let motion = through_the_edge();
    let report = judge(&motion);
    assert_eq!(report.penetrations[0].kind, PenetrationKind::ThroughEdge);
    let refuted = verify(&motion, &without_penetrations(&report)).refuted;
    assert!(refuted.iter().any(|r| r.found.contains("through the edge")), "{refuted:?}");
}

/// A change to a report that makes it false.
type Lie = fn(&mut CollisionReport);

#[test]
fn what_is_stated_of_a_passage_through_an_edge_is_held_to_what_is_found() {
    let motion = through_the_edge();
    let report = judge(&motion);
    let lies: [(&str, Lie); 5] = [
        ("point", |r| r.penetrations[0].point.x += 1e-3),
        ("passed_t", |r| r.penetrations[0].passed -= 1e-2),
        ("depth", |r| r.penetrations[0].depth += 10.0),
        ("depth", |r| r.penetrations[0].depth = -1e-3),
        ("vertices", |r| r.penetrations[0].vertices[0] = 6),
    ];
    for (k, (field, lie)) in lies.into_iter().enumerate() {
        let mut claim = report.clone();
        lie(&mut claim);
        let refuted = verify(&motion, &claim).refuted;
        let is_found = |name: &str| name.starts_with("penetrations");
        assert!(refuted.iter().any(|r| is_found(&r.field)), "{k} {field}");
    }
}

#[test]
fn an_invented_passage_is_not_verified() {
    let down = DVec3::new(0.0, 0.0, -0.5);
    let honest = above_a_roof(0.5, wall(), &[DVec3::ZERO, down, DVec3::ZERO]);
    let mut claim = judge(&honest);
    let mut made_up = judge(&through_the_edge()).penetrations[0].clone();
    (made_up.frame, made_up.time, made_up.passed) = (0, 1.0, 1.0);
    claim.first = Some(made_up.clone());
    claim.penetrations = vec![made_up];
    claim.verdict = Verdict::Penetrating;
    assert!(!verify(&honest, &claim).is_verified());
}

#[test]
fn a_wall_that_rests_on_an_edge_and_then_sinks_passes_no_earlier_than_it_sinks() {
    let down = DVec3::new(0.0, 0.0, -0.5);
    let moves = [DVec3::ZERO, down, down, down * 2.0];
    let motion = above_a_roof(0.5, wall(), &moves);
    assert_eq!(agreed(&motion), Verdict::Penetrating);
    let mut claim = judge(&motion);
    for penetration in &mut claim.penetrations {
        assert_eq!(penetration.frame, 2);
        penetration.frame = 1;
        (penetration.time, penetration.passed) = (1.0, 1.5);
    }
    assert!(!verify(&motion, &claim).is_verified());
}

/// A triangle that lands on one half, slides across the edge to the other and leaves, upwards or downwards.
fn sliding(leaves: f64) -> Motion {
    let part = [DVec3::new(0.45, 0.2, 0.5), DVec3::new(0.55, 0.2, 0.5), DVec3::new(0.5, 0.3, 0.5)];
    let down = DVec3::new(0.0, 0.0, -0.5);
    let across = |y: f64| DVec3::new(0.0, y, -0.5);
    let end = across(-0.5) + DVec3::Z * leaves;
    let moves = [DVec3::ZERO, down, across(-0.25), across(-0.5), end];
    above_a_roof(0.0, part, &moves)
}

#[test]
fn a_triangle_that_slides_across_an_edge_stays_on_the_side_on_which_it_landed() {
    assert_eq!(agreed(&sliding(0.5)), Verdict::Touching);
    let through = sliding(-0.5);
    assert_eq!(agreed(&through), Verdict::Penetrating);
    let claim = without_penetrations(&judge(&through));
    assert!(!verify(&through, &claim).refuted.is_empty());
}
