//! Facets beside curved creases, cut along rulings.
//!
//! Paper folded along a curve bends into developable surfaces, which straight lines, the rulings, cover. Beside a crease
//! in a plane with the same fold angle everywhere, rulings meet the crease at right angles (Fuchs and Tabachnikov 1999,
//! "More on paperfolding"). Where they run for other creases depends on the folding, so right angles are what the
//! triangulation comes near to. Diagonals across the rulings would keep the facet from bending.
//! Idea: Sasaki and Mitani 2022, "Simple implementation and low computational cost simulation of curved folds based on
//! ruling-aware triangulation"; the method here is our own.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::drawing::{Line, Role};
use super::open_cuts::sides;
use super::plan::Plan;
use super::predicate::side;

/// The cosine of the largest angle between two chords of one smooth curve.
const SMOOTH: f64 = 0.7;
/// How near rulings may end to each other and to corners on a border, in parts of the chords beside them.
const LEAST_GAP: f64 = 0.3;
/// The sides of a facet above which rulings do not end in vertices of their own.
const MOST_SIDES: usize = 2_000;
/// The most rounds of exchanging diagonals.
const MOST_ROUNDS: usize = 200;
/// By how much a diagonal must be better to be exchanged.
const LEAST_GAIN: f64 = 1e-6;
/// The cost of a diagonal at an end that is on no curved crease; at one that is, it is the squared cosine of the angle
/// between the two.
const UNBOUND: f64 = 0.25;
/// The height of a triangle, in parts of its longest side, below which none is made.
const LEAST_HEIGHT: f64 = 1e-3;

/// The lines of a plan by their ends.
type LineMap<'a> = BTreeMap<[u32; 2], &'a Line>;

pub(super) fn by_ends(lines: &[Line]) -> LineMap<'_> {
    lines.iter().map(|line| (line.key(), line)).collect()
}

/// The directions of the curved creases at the corners of a facet, the facet on the left.
pub(super) fn tangents(
    loops: &[Vec<u32>],
    points: &[DVec2],
    lines: &LineMap<'_>,
) -> BTreeMap<u32, DVec2> {
    let is_curved_crease = |a: u32, b: u32| {
        let line = lines.get(&[a.min(b), a.max(b)]);
        line.is_some_and(|l| l.is_curved && !matches!(l.role, Role::Border | Role::Cut))
    };
    let mut found = BTreeMap::new();
    for corners in loops {
        let count = corners.len();
        for (index, &at) in corners.iter().enumerate() {
            let before = corners[(index + count - 1) % count];
            let after = corners[(index + 1) % count];
            if !is_curved_crease(before, at) || !is_curved_crease(at, after) {
                continue;
            }
            let [a, b, c] = [before, at, after].map(|v| points[v as usize]);
            let [into, out] = [(b - a).normalize_or_zero(), (c - b).normalize_or_zero()];
            if into.dot(out) >= SMOOTH {
                found.insert(at, (into + out).normalize_or_zero());
            }
        }
    }
    found
}

/// A ruling that ends on a straight border line.
struct End {
    /// Where along the line, from its first end (0) to the other (1).
    share: f64,
    /// How far apart vertices must be there.
    gap: f64,
}

/// Adds vertices where rulings end on straight border lines, so that the facet can bend along them.
pub(super) fn end_on_borders(plan: &mut Plan, tolerance: f64) {
    let mut ends: BTreeMap<[u32; 2], Vec<End>> = BTreeMap::new();
    let lines = by_ends(&plan.lines);
    for loops in &plan.facets {
        if loops.iter().map(Vec::len).sum::<usize>() <= MOST_SIDES {
            ends_of_facet(loops, &plan.points, &lines, tolerance, &mut ends);
        }
    }
    let mut added: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for line in std::mem::take(&mut plan.lines) {
        let points = line.ends.map(|v| plan.points[v as usize]);
        let kept = ends.remove(&line.key()).map(|ends| spaced(ends, points[0].distance(points[1])));
        let first = plan.points.len() as u32;
        plan.points.extend(kept.iter().flatten().map(|share| points[0].lerp(points[1], *share)));
        plan.origins.resize(plan.points.len(), None);
        let inner: Vec<u32> = (first..plan.points.len() as u32).collect();
        let stops: Vec<u32> =
            [line.ends[0]].into_iter().chain(inner.iter().copied()).chain([line.ends[1]]).collect();
        plan.lines.extend(stops.windows(2).map(|s| Line { ends: [s[0], s[1]], ..line }));
        if !inner.is_empty() {
            let is_upward = line.ends[0] < line.ends[1];
            let ordered = if is_upward { inner } else { inner.into_iter().rev().collect() };
            added.insert(line.key(), ordered);
        }
    }
    for corners in plan.facets.iter_mut().flatten() {
        *corners = with_added(corners, &added);
    }
}

fn ends_of_facet(
    loops: &[Vec<u32>],
    points: &[DVec2],
    lines: &LineMap<'_>,
    tolerance: f64,
    ends: &mut BTreeMap<[u32; 2], Vec<End>>,
) {
    let facet_sides: Vec<[u32; 2]> = loops
        .iter()
        .flat_map(|corners| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)])
        })
        .collect();
    for (&at, &tangent) in &tangents(loops, points, lines) {
        let from = points[at as usize];
        let across = tangent.perp();
        let others = facet_sides.iter().filter(|side| !side.contains(&at));
        let hits = others.filter_map(|&side| {
            let [a, b] = side.map(|v| points[v as usize] - from);
            let along = b - a;
            let slope = along.perp_dot(across);
            let (share, far) = (across.perp_dot(a) / slope, along.perp_dot(a) / slope);
            (far > 0.0 && (0.0..=1.0).contains(&share)).then_some((far, share, side))
        });
        let Some((_, _, key)) = hits.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        let Some(line) = lines.get(&key) else { continue };
        if line.is_curved || !matches!(line.role, Role::Border | Role::Cut) {
            continue;
        }
        let [a, b] = line.ends.map(|v| points[v as usize] - from);
        let chords = facet_sides.iter().filter(|side| side.contains(&at));
        let length = |side: &[u32; 2]| points[side[0] as usize].distance(points[side[1] as usize]);
        let shortest = chords.map(length).fold(f64::INFINITY, f64::min);
        ends.entry(key).or_default().push(End {
            share: across.perp_dot(a) / (b - a).perp_dot(across),
            gap: (LEAST_GAP * shortest).max(4.0 * tolerance),
        });
    }
}

/// The shares of those ends that lie apart from each other and from the ends of the line, in order.
fn spaced(mut ends: Vec<End>, length: f64) -> Vec<f64> {
    ends.sort_by(|a, b| a.share.total_cmp(&b.share));
    let mut last = 0.0;
    ends.retain(|end| {
        let is_apart =
            (end.share - last) * length >= end.gap && (1.0 - end.share) * length >= end.gap;
        if is_apart {
            last = end.share;
        }
        is_apart
    });
    ends.into_iter().map(|end| end.share).collect()
}

/// A loop with the vertices added on its sides; those of a side run from its lower end to the other.
fn with_added(corners: &[u32], added: &BTreeMap<[u32; 2], Vec<u32>>) -> Vec<u32> {
    let mut all = Vec::with_capacity(corners.len());
    let next = corners.iter().cycle().skip(1);
    for (&a, &b) in corners.iter().zip(next) {
        all.push(a);
        if let Some(inner) = added.get(&[a.min(b), a.max(b)]) {
            if a < b {
                all.extend(inner);
            } else {
                all.extend(inner.iter().rev());
            }
        }
    }
    all
}

/// Exchanges diagonals of a triangulated facet for those that meet curved creases more nearly at right angles.
///
/// `is_line`: whether a line is drawn between two vertices, which stays.
pub(super) fn align(
    corners: &mut [[u32; 3]],
    points: &[DVec2],
    tangents: &BTreeMap<u32, DVec2>,
    is_line: impl Fn([u32; 2]) -> bool,
) {
    let cost = |a: u32, b: u32| {
        let along = (points[b as usize] - points[a as usize]).normalize_or_zero();
        let at = |v: u32| tangents.get(&v).map_or(UNBOUND, |t| t.dot(along).powi(2));
        at(a) + at(b)
    };
    for _ in 0..MOST_ROUNDS {
        let mut changed: BTreeSet<u32> = BTreeSet::new();
        for (ends, starts) in sides(corners) {
            let &[s, t] = starts.as_slice() else { continue };
            let triangles = [s / 3, t / 3];
            if is_line(ends) || triangles.iter().any(|triangle| changed.contains(triangle)) {
                continue;
            }
            let corner =
                |start: u32, k: u32| corners[start as usize / 3][((start % 3 + k) % 3) as usize];
            let (p, q, r, u) = (corner(s, 0), corner(s, 1), corner(s, 2), corner(t, 2));
            let exchanged = [[p, u, r], [u, q, r]];
            let before = [[p, q, r], [q, p, u]];
            let least = |pair: &[[u32; 3]; 2]| {
                pair.iter().map(|c| height(c.map(|v| points[v as usize]))).fold(1.0, f64::min)
            };
            let is_better = cost(r, u) < cost(p, q) - LEAST_GAIN;
            if is_better && least(&exchanged) >= LEAST_HEIGHT.min(least(&before).max(1e-12)) {
                for (triangle, new) in triangles.into_iter().zip(exchanged) {
                    corners[triangle as usize] = new;
                    changed.insert(triangle);
                }
            }
        }
        if changed.is_empty() {
            break;
        }
    }
}

/// The least height of a triangle, in parts of its longest side; negative if it is turned over.
fn height([a, b, c]: [DVec2; 3]) -> f64 {
    let longest = [a - b, b - c, c - a].map(DVec2::length_squared).into_iter().fold(0.0, f64::max);
    side(a, b, c) / longest
}
