//! What a report must say if it says the rest: counts from the topology, and the parts of the verdict.

use std::collections::BTreeMap;

use foldmotion_pattern::Sheet;

use super::outcome::Refutation;
use super::pair::Pair;
use crate::collision::{CollisionReport, Verdict};

/// One pair in this many may be said to touch, though this proof finds it apart.
const DOUBTFUL_SHARE: usize = 100;

/// What the second proof knows.
pub(super) struct Facts<'a> {
    pub(super) sheet: &'a Sheet,
    pub(super) intervals: usize,
    /// Pairs with a penetration, and the first interval in which they are not judged any more.
    pub(super) dropped: &'a BTreeMap<[u32; 2], usize>,
    /// Pairs that surely touch, pairs that may.
    pub(super) touching: [usize; 2],
    /// What rounding may change a distance by, in units of length.
    pub(super) rounding: f64,
}

/// Everything the report contradicts itself or the topology in.
pub(super) fn consistency(claim: &CollisionReport, facts: &Facts<'_>) -> Vec<Refutation> {
    let mut refuted = Vec::new();
    counts(claim, facts, &mut refuted);
    let [sure, possible] = facts.touching;
    // The first proof counts from above: what it cannot prove free touches. Its doubts are granted for a few.
    let possible = possible + possible / DOUBTFUL_SHARE;
    if !(sure..=possible).contains(&claim.touching_pairs) {
        let found = format!("between {sure} and {possible}");
        refuted.push(Refutation::new(
            "touching_pairs",
            claim.touching_pairs,
            found,
        ));
    }
    if let Some(says) = verdict_fault(claim) {
        refuted.push(Refutation::new(
            "verdict",
            format!("{:?}", claim.verdict),
            says,
        ));
    }
    if claim.min_separation.is_none() && has_measured_pair(facts.sheet) {
        refuted.push(Refutation::new(
            "min_separation",
            "none",
            "there are facets that share no vertex",
        ));
    }
    if let Some(says) = separation_fault(claim, facts.rounding) {
        let stated = claim.min_separation.map(|s| (s.distance, s.attained));
        refuted.push(Refutation::new(
            "min_separation",
            format!("{stated:?}"),
            says,
        ));
    }
    order_of_penetrations(claim, &mut refuted);
    refuted
}

/// What is wrong with the two bounds of the separation.
fn separation_fault(claim: &CollisionReport, rounding: f64) -> Option<&'static str> {
    let stated = claim.min_separation?;
    let open = stated.attained - stated.distance;
    let accuracy = (0.01 * claim.tolerance).max(1e-4 * stated.attained) + rounding;
    if !(stated.distance >= 0.0 && open >= 0.0) {
        Some("a lower bound is at least 0 and at most what is attained")
    } else if stated.is_tight && open > accuracy {
        Some("these bounds are not as near as promised")
    } else {
        None
    }
}

fn order_of_penetrations(claim: &CollisionReport, refuted: &mut Vec<Refutation>) {
    let key = |k: usize| {
        let p = &claim.penetrations[k];
        (p.time, p.passed, p.faces)
    };
    for k in 1..claim.penetrations.len() {
        if key(k - 1) > key(k) {
            refuted.push(Refutation::new(
                "penetrations",
                format!("{:?} after {:?}", key(k), key(k - 1)),
                "they are in order of time",
            ));
        }
    }
    // Of one pair there may be a penetration and an order of layers.
    let kinds = claim.penetrations.iter();
    let mut faces: Vec<_> = kinds.map(|p| (p.faces, p.conflict.is_some())).collect();
    faces.sort_unstable();
    if let Some([twice, _]) = faces.windows(2).find(|w| w[0] == w[1]) {
        refuted.push(Refutation::new(
            "penetrations",
            format!("triangles {:?} twice", twice.0),
            "each pair stands once",
        ));
    }
}

/// How many pairs of triangles share one vertex and two.
fn neighbours(sheet: &Sheet) -> [u64; 2] {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); sheet.vertices.len()];
    for (face, corners) in sheet.faces.iter().enumerate() {
        for &v in corners {
            around[v as usize].push(face as u32);
        }
    }
    let mut counts = [0; 2];
    for (face, corners) in sheet.faces.iter().enumerate() {
        let others = corners.iter().flat_map(|&v| &around[v as usize]);
        let mut later: Vec<u32> = others.copied().filter(|&g| g as usize > face).collect();
        later.sort_unstable();
        for group in later.chunk_by(|p, q| p == q) {
            counts[usize::from(group.len() > 1)] += 1;
        }
    }
    counts
}

fn counts(claim: &CollisionReport, facts: &Facts<'_>, refuted: &mut Vec<Refutation>) {
    let mut require = |field: &str, stated: u64, found: std::ops::RangeInclusive<u64>| {
        if !found.contains(&stated) {
            let (low, high) = (found.start(), found.end());
            let found = if low == high {
                low.to_string()
            } else {
                format!("between {low} and {high}")
            };
            refuted.push(Refutation::new(field, stated, found));
        }
    };
    let intervals = facts.intervals as u64;
    let mut dropped = [0; 3];
    for (&faces, &from) in facts.dropped {
        let shared = Pair::new(facts.sheet, faces).shared.min(2);
        dropped[shared] += facts.intervals.saturating_sub(from) as u64;
    }
    let [vertex, edge] = neighbours(facts.sheet);
    let pairs = claim.pairs_tested;
    let exactly = |n: u64| n..=n;
    require(
        "pairs_tested.shared_vertex",
        pairs.shared_vertex,
        exactly(vertex * intervals - dropped[1]),
    );
    require(
        "pairs_tested.shared_crease",
        pairs.shared_crease,
        exactly(edge * intervals - dropped[2]),
    );
    let by = claim.decided_by;
    let total = pairs.total();
    let decided = by
        .axis_at_rest
        .saturating_add(by.turning_axis)
        .saturating_add(by.search);
    require("decided_by", decided, exactly(total));
    let faces = facts.sheet.faces.len() as u64;
    let all = faces * faces.saturating_sub(1) / 2 * intervals;
    let known = dropped[1] + dropped[2];
    // Dropped pairs that share nothing may have been left out by their boxes.
    let judged = all - known - dropped[0]..=all - known;
    require(
        "pairs_tested and decided_by.boxes",
        by.boxes.saturating_add(total),
        judged,
    );
}

/// What the rest of the report says where the verdict is another.
fn verdict_fault(claim: &CollisionReport) -> Option<&'static str> {
    let is_close = claim
        .min_separation
        .is_some_and(|s| s.distance <= claim.tolerance);
    let expected = if !claim.penetrations.is_empty() {
        (Verdict::Penetrating, "penetrations are listed")
    } else if !claim.undecided.is_empty() {
        (Verdict::Undecided, "undecided pairs are listed")
    } else if claim.touching_pairs > 0 || is_close {
        (
            Verdict::Touching,
            "facets touch, none penetrate, none are undecided",
        )
    } else {
        (Verdict::Free, "nothing touches")
    };
    (claim.verdict != expected.0).then_some(expected.1)
}

fn has_measured_pair(sheet: &Sheet) -> bool {
    let count = sheet.faces.len() as u32;
    (0..count).any(|f| (f + 1..count).any(|g| Pair::new(sheet, [f, g]).is_measured(sheet)))
}
