//! Whether and when a moving vertex meets a moving facet, or a moving edge another.
//!
//! # The guarantee
//!
//! [`Impact::Never`] is proved for the given f64 numbers in exact arithmetic: at no t in [0, 1] are the features within
//! the separation of each other. It is proved in the same way that they are not before `from` in the other answers.
//! Every bound includes its rounding, derived in `patch`. A query that cannot be decided counts as an impact, and so do
//! coordinates that are not finite or whose differences overflow. The converse holds up to rounding only: features that
//! pass each other at less than about 10⁻¹⁵ of their size, or turn around each other too fast for the resolution, may
//! be reported as meeting.
//!
//! # Method
//!
//! The differences of the two features form a moving triangle or parallelogram, which contains the origin exactly when
//! they meet. Time is halved, the earlier half first; an interval is discarded by the first of three filters that
//! proves it clear: the ranges of the coordinates; the sign of the coplanarity cubic in Bernstein form; a plane between
//! the patch and the origin that turns along. Intervals as short as the resolution that remain count as impacts. This
//! is the inclusion-based search of Wang, Ferguson, Schneider, Jiang, Attene and Panozzo 2021 ("A large-scale benchmark
//! and an inclusion-based algorithm for continuous collision detection") in t only: a patch is convex, so that a plane
//! decides for all (u, v) together what their boxes decide one by one.

use glam::DVec3;

use super::{Limits, MovingPair, patch::Patch};

/// Times are multiples of this, which keeps t and 1 − t exact.
const FINEST: f64 = 1.0 / (1u64 << 50) as f64;

/// The parameters of a query.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactSearch {
    /// δ: features within this distance of each other meet. A length of at least 0.
    pub separation: f64,
    /// The longest time interval that counts as an impact without further division; at least 2⁻⁵⁰.
    pub resolution: f64,
    /// The largest number of time intervals examined.
    pub budget: u32,
}

impl Default for ImpactSearch {
    /// Impacts at distance 0, located to within 2⁻⁴⁴.
    fn default() -> Self {
        Self { separation: 0.0, resolution: 1.0 / (1u64 << 44) as f64, budget: 4096 }
    }
}

/// The answer to a query over t in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Impact {
    /// The features are proved never to come within the separation.
    Never,
    /// The features may meet in [from, to], an interval no longer than the resolution; they are proved not to before
    /// `from`.
    Within {
        /// The earliest time at which the first impact may begin.
        from: f64,
        /// The end of the interval examined.
        to: f64,
    },
    /// The budget was exhausted at `from`; the features are proved not to meet before.
    Undecided {
        /// The time up to which the query is decided.
        from: f64,
    },
}

/// Whether and when a vertex comes within the separation of a facet.
///
/// `vertex`: its positions at t = 0 and at t = 1; `facet`: those of each corner. Every point moves on a straight line.
/// A facet without area is treated as its edges.
pub fn vertex_facet(vertex: [DVec3; 2], facet: [[DVec3; 2]; 3], search: &ImpactSearch) -> Impact {
    let differences = |end: usize| facet.map(|corner| corner[end] - vertex[end]);
    first_impact(differences(0), differences(1), search)
}

/// Whether and when two edges come within the separation of each other.
///
/// `a`, `b`: the ends of the edges, each at t = 0 and at t = 1, moving on straight lines. An edge without length is
/// treated as a point.
pub fn edge_edge(a: [[DVec3; 2]; 2], b: [[DVec3; 2]; 2], search: &ImpactSearch) -> Impact {
    let around = [(0, 0), (1, 0), (1, 1), (0, 1)];
    let differences = |end: usize| around.map(|(i, j)| a[i][end] - b[j][end]);
    first_impact(differences(0), differences(1), search)
}

/// Whether two triangles that share no vertex and start apart are proved to stay farther apart than the margin.
///
/// As long as triangles are apart, their distance is that of a vertex from a facet or of two edges. If none of the six
/// and nine queries finds an impact, they stay apart. Precondition: at t = 0 they are farther apart than the margin.
/// (If an edge started inside a facet, no vertex would have to meet a facet and no edge another.)
pub(super) fn never_meet(pair: &MovingPair, limits: &Limits) -> bool {
    let paths = |from: &[DVec3; 3], to: &[DVec3; 3]| [0, 1, 2].map(|i| [from[i], to[i]]);
    let a = paths(&pair.start.a, &pair.end.a);
    let b = paths(&pair.start.b, &pair.end.b);
    let search = ImpactSearch {
        separation: limits.margin,
        budget: limits.budget,
        ..ImpactSearch::default()
    };
    let edge = |t: &[[DVec3; 2]; 3], i: usize| [t[i], t[(i + 1) % 3]];
    let is_never = |meeting: Impact| meeting == Impact::Never;
    (0..3).all(|i| {
        is_never(vertex_facet(a[i], b, &search))
            && is_never(vertex_facet(b[i], a, &search))
            && (0..3).all(|j| is_never(edge_edge(edge(&a, i), edge(&b, j), &search)))
    })
}

fn first_impact<const N: usize>(
    start: [DVec3; N],
    end: [DVec3; N],
    search: &ImpactSearch,
) -> Impact {
    let Some(patch) = Patch::new(start, end, search.separation) else {
        return Impact::Undecided { from: 0.0 };
    };
    let resolution = search.resolution.max(FINEST);
    let mut open = vec![(0.0, 1.0)];
    for _ in 0..search.budget {
        let Some((from, to)) = open.pop() else {
            return Impact::Never;
        };
        if patch.stays_clear(from, to) {
            continue;
        }
        if to - from <= resolution {
            return Impact::Within { from, to };
        }
        let middle = f64::midpoint(from, to);
        open.push((middle, to));
        open.push((from, middle));
    }
    match open.pop() {
        Some((from, _)) => Impact::Undecided { from },
        None => Impact::Never,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still(p: DVec3) -> [DVec3; 2] {
        [p, p]
    }

    fn plate() -> [[DVec3; 2]; 3] {
        [DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0].map(still)
    }

    fn falling(x: f64, from: f64, to: f64) -> [DVec3; 2] {
        [DVec3::new(x, 1.0, from), DVec3::new(x, 1.0, to)]
    }

    #[test]
    fn a_vertex_through_a_facet_meets_it_at_the_reported_instant() {
        let search = ImpactSearch::default();
        for (from, to) in [(1.0, -2.0), (0.3, -1e6), (1e-9, -1e-7), (5.0, 0.0)] {
            let expected = from / (from - to);
            match vertex_facet(falling(1.0, from, to), plate(), &search) {
                Impact::Within { from: t0, to: t1 } => {
                    assert!(t0 <= expected && expected <= t1 + 1e-15, "{t0} {expected}");
                    assert!(expected - t0 < 1e-12, "{t0} {expected}");
                }
                other => panic!("{from} {to}: {other:?}"),
            }
        }
        let beside = vertex_facet(falling(3.5, 1.0, -1.0), plate(), &search);
        assert_eq!(beside, Impact::Never);
        let short = vertex_facet(falling(1.0, 1.0, 1e-12), plate(), &search);
        assert_eq!(short, Impact::Never);
    }

    #[test]
    fn the_separation_is_kept_exactly() {
        // δ and the gap are dyadic. At rest at distance δ the features count as within it; one ulp farther they need
        // not, and a thousand ulps farther they must not.
        let at = |gap: f64, separation: f64| {
            let search = ImpactSearch { separation, ..ImpactSearch::default() };
            vertex_facet(falling(1.0, 1.0, gap), plate(), &search)
        };
        assert!(matches!(at(0.125, 0.125), Impact::Within { .. }));
        assert_eq!(at(0.125 + 1e-12, 0.125), Impact::Never);
        assert!(matches!(at(0.125 - 1e-12, 0.125), Impact::Within { .. }));
    }

    #[test]
    fn edges_that_cross_meet_and_parallel_ones_beside_each_other_never_do() {
        let search = ImpactSearch::default();
        let a = [still(-DVec3::X), still(DVec3::X)];
        let across = |z0: f64, z1: f64, x: f64| {
            [-1.0, 1.0].map(|y| [DVec3::new(x, y, z0), DVec3::new(x, y, z1)])
        };
        let meeting = edge_edge(a, across(1.0, -3.0, 0.5), &search);
        assert!(
            matches!(meeting, Impact::Within { from, to } if from <= 0.25 && to >= 0.25),
            "{meeting:?}"
        );
        assert_eq!(edge_edge(a, across(1.0, -3.0, 1.5), &search), Impact::Never);
        let along = |y: f64| [still(DVec3::new(-3.0, y, 0.0)), still(DVec3::new(3.0, y, 0.0))];
        assert_eq!(edge_edge(a, along(1e-12), &search), Impact::Never);
        let on = edge_edge(a, along(0.0), &search);
        assert!(matches!(on, Impact::Within { from: 0.0, .. }), "{on:?}");
    }

    #[test]
    fn what_cannot_be_decided_counts_as_meeting() {
        let search = ImpactSearch::default();
        let nan = vertex_facet(falling(f64::NAN, 1.0, 2.0), plate(), &search);
        assert_eq!(nan, Impact::Undecided { from: 0.0 });
        let far = vertex_facet(falling(1.0, f64::MAX, -f64::MAX), plate(), &search);
        assert!(far != Impact::Never);
        let poor = ImpactSearch { budget: 3, ..search };
        let ended = vertex_facet(falling(1.0, 1.0, -2.0), plate(), &poor);
        assert!(matches!(ended, Impact::Undecided { from } if from <= 1.0 / 3.0));
    }
}
