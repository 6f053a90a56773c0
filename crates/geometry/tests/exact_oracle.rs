//! The collision kernels and the certificate compared with exact arithmetic.
//!
//! `cargo run --release -p foldmotion-geometry --example exact_oracle` does the same for a million queries.

mod oracle;

use foldmotion_geometry::collide::{Effort, Impact, Outcome, Side, certify};
use glam::DVec3;
use oracle::{
    contact::{Path, Query},
    queries::{Class, queries_of, query, triangles},
    trial::{answer, kernel, limits_of, may_meet, moving, try_pairs, try_queries},
};

#[test]
fn no_meeting_is_missed_by_the_kernels() {
    for class in Class::ALL {
        let tally = try_queries(class, 1100, kernel);
        println!("{class:?} {tally}");
        assert_eq!(tally.false_negatives, 0, "{class:?}: {tally}");
        assert!(tally.meets >= 10, "{class:?} has meetings: {tally}");
        let is_exact = !matches!(class, Class::NearDegenerate | Class::SubUlp | Class::HugeOrTiny);
        let allowed = if is_exact { tally.queries / 20 } else { tally.queries / 2 };
        assert!(tally.false_positives <= allowed, "{class:?}: {tally}");
    }
}

#[test]
fn no_meeting_is_certified_free_and_no_deep_pair_passes() {
    let mut certified = 0;
    for class in Class::ALL {
        let (tally, pairs) = try_pairs(class, 40, kernel);
        println!("{class:?} {tally} {pairs}");
        assert_eq!(tally.false_negatives, 0, "{class:?}: {tally}");
        assert_eq!(pairs.free_but_meeting, 0, "{class:?}: {pairs}");
        assert_eq!(pairs.passed_but_deep, 0, "{class:?}: {pairs}");
        certified += pairs.free + pairs.touching;
    }
    assert!(certified > 150, "{certified}");
}

#[test]
fn configurations_made_to_touch_do_so_according_to_the_oracle() {
    for class in [Class::Touching, Class::Grazing, Class::Fast] {
        let missed = (0..400).find(|&number| !query(class, number).meets());
        assert_eq!(missed, None, "{class:?}");
    }
}

/// A kernel that trusts f64: the plane is met if the volumes at two neighbours of 64 instants differ in sign, and the
/// foot of the vertex lies inside.
fn trusting_kernel(query: &Query) -> bool {
    let Query::VertexFacet(vertex, facet) = query else {
        return kernel(query);
    };
    let at = |path: &Path, t: f64| path[0] + (path[1] - path[0]) * t;
    let differences = |t: f64| facet.each_ref().map(|corner| at(corner, t) - at(vertex, t));
    let volume = |t: f64| {
        let [x, y, z] = differences(t);
        x.dot(y.cross(z))
    };
    (0..64).any(|k| {
        let [t0, t1] = [f64::from(k) / 64.0, f64::from(k + 1) / 64.0];
        let (v0, v1) = (volume(t0), volume(t1));
        if v0 * v1 > 0.0 {
            return false;
        }
        let [x, y, z] = differences(t0 + (t1 - t0) * (v0 / (v0 - v1)).clamp(0.0, 1.0));
        let normal = (y - x).cross(z - x);
        [x.cross(y), y.cross(z), z.cross(x)].iter().all(|side| side.dot(normal) >= 0.0)
    })
}

#[test]
fn a_kernel_that_trusts_rounding_is_caught_by_the_touching_classes() {
    for class in [Class::SubUlp, Class::Touching, Class::Fast] {
        let tally = try_queries(class, 800, trusting_kernel);
        assert!(tally.false_negatives > 0, "{class:?}: {tally}");
    }
}

/// A kernel that shrinks its features towards their centres by 10⁻¹².
fn shrinking_kernel(query: &Query) -> bool {
    fn shrunk<const N: usize>(paths: [Path; N]) -> [Path; N] {
        let centre = |end: usize| paths.iter().map(|p| p[end]).sum::<DVec3>() / N as f64;
        let centres = [centre(0), centre(1)];
        paths.map(|path| [0, 1].map(|end| path[end].lerp(centres[end], 1e-12)))
    }
    kernel(&match *query {
        Query::VertexFacet(vertex, facet) => Query::VertexFacet(vertex, shrunk(facet)),
        Query::EdgeEdge(a, b) => Query::EdgeEdge(shrunk(a), shrunk(b)),
    })
}

#[test]
fn a_kernel_with_features_too_small_by_a_millionth_of_a_millionth_is_caught() {
    let tally = try_queries(Class::Touching, 400, shrinking_kernel);
    assert!(tally.false_negatives > 20, "{tally}");
}

#[test]
fn the_reported_impact_is_no_later_than_the_first() {
    // The features touch at a dyadic instant at the latest, in an interval that cannot be shortened from above.
    for class in [Class::Touching, Class::Grazing] {
        for number in 0..300 {
            let query = query(class, number);
            let until = |t: f64| {
                let cut = |path: Path| [path[0], path[0].lerp(path[1], t)];
                match query {
                    Query::VertexFacet(p, facet) => Query::VertexFacet(cut(p), facet.map(cut)),
                    Query::EdgeEdge(a, b) => Query::EdgeEdge(a.map(cut), b.map(cut)),
                }
            };
            match answer(&query, 0.0) {
                // The paths up to a dyadic t are exact here: before `from` nothing meets.
                Impact::Within { from, to } => {
                    assert!(to - from <= 1.0 / (1u64 << 44) as f64);
                    let before = (from * 64.0).floor() / 64.0;
                    assert!(before == from || !until(before).meets(), "{class:?} {number}");
                }
                other => panic!("{class:?} {number}: {other:?}"),
            }
        }
    }
}

#[test]
fn features_within_the_separation_at_an_instant_are_never_reported_as_apart() {
    // Witnesses: integer weights with sum 4 at eighths of t on integer coordinates, so that points are exact; their
    // squared distance is exact as well, and its root is rounded up.
    let mut told_apart = 0;
    for number in 0..1500 {
        let query = query(Class::SharedCoordinates, number);
        let t = (number % 9) as f64 / 8.0;
        let at = |path: &Path| path[0] * (1.0 - t) + path[1] * t;
        let (i, j) = ((number / 9 % 3) as f64 * 0.25, (number / 27 % 3) as f64 * 0.25);
        let apart = match &query {
            Query::VertexFacet(p, [a, b, c]) => {
                at(p) - (at(a) * i + at(b) * j + at(c) * (1.0 - i - j))
            }
            Query::EdgeEdge([a, b], [c, d]) => {
                at(a) * i + at(b) * (1.0 - i) - at(c) * j - at(d) * (1.0 - j)
            }
        };
        let separation = apart.length().next_up();
        assert!(may_meet(&query, separation), "{number}: {query:?} {separation}");
        told_apart += u32::from(!may_meet(&query, 0.25 * separation));
    }
    assert!(told_apart > 300, "smaller separations are kept: {told_apart}");
}

#[test]
fn triangles_that_shrink_to_segments_and_never_meet_pass_by_the_queries() {
    let mut by_queries = 0;
    for number in 0..400 {
        let both = triangles(Class::NoExtent, number);
        let (pair, limits) = (moving(&both), limits_of(&both));
        let Some(side @ Side::Apart(_)) = Side::at_start(&pair.start, &limits) else {
            continue;
        };
        let outcome = certify(&pair, &side, &limits);
        let near = |query: &Query| may_meet(query, limits.margin);
        if !queries_of(&both).iter().any(near) {
            let Outcome::Passed(passage) = &outcome else {
                panic!("{number}: {outcome:?}");
            };
            let is_last_resort = passage.clearance == limits.margin;
            by_queries += u32::from(is_last_resort && passage.effort == Effort::Search);
        }
    }
    assert!(by_queries > 0, "no walk left one to the queries");
}
