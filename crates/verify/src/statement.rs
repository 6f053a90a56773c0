//! The consistency of a report: what its parts imply about each other.

use foldmotion_pattern::Sheet;

use crate::face_pair::FacePair;
use crate::outcome::Refutation;
use foldmotion_check::{CollisionReport, Verdict};

/// What the second proof has found.
pub(crate) struct Findings<'a> {
    pub(crate) sheet: &'a Sheet,
    /// The index of the last frame proved, and its motion time.
    pub(crate) last: (usize, f64),
    /// The number of pairs that surely touch, and of those that may.
    pub(crate) touching: [usize; 2],
    /// A bound of the rounding error of a distance, in units of length.
    pub(crate) rounding: f64,
}

/// Everything in which the report contradicts itself or what was found.
pub(crate) fn consistency(claim: &CollisionReport, facts: &Findings<'_>) -> Vec<Refutation> {
    let mut refuted = Vec::new();
    if let Some(says) = verdict_error(claim, facts.touching) {
        refuted.push(Refutation::new("verdict", format!("{:?}", claim.verdict), says));
    }
    refuted.extend(stop_error(claim, facts.last));
    if claim.min_separation.is_none() && has_measured_pair(facts.sheet) {
        refuted.push(Refutation::new(
            "min_separation",
            "none",
            "there are facets that share no vertex",
        ));
    }
    if let Some(says) = separation_error(claim, facts.rounding) {
        let stated = claim.min_separation.map(|s| (s.distance, s.attained));
        refuted.push(Refutation::new("min_separation", format!("{stated:?}"), says));
    }
    order_of_penetrations(claim, &mut refuted);
    refuted
}

/// Why the check would not have ended when it is said to have.
fn stop_error(claim: &CollisionReport, (frame, time): (usize, f64)) -> Option<Refutation> {
    let stopped = claim.stopped?;
    // That each pair occurs once is checked elsewhere.
    let of_pairs = claim.penetrations.iter().filter(|p| p.conflict.is_none());
    let count = of_pairs.count();
    let found = if (stopped.frame, stopped.time) != (frame, time) {
        format!("frame {frame}, t = {time}")
    } else if stopped.stop_at == 0 || count <= stopped.stop_at {
        format!("{count} pairs penetrate up to there")
    } else {
        return None;
    };
    Some(Refutation::new("stopped", format!("{stopped:?}"), found))
}

/// What is wrong with the two bounds of the separation.
fn separation_error(claim: &CollisionReport, rounding: f64) -> Option<&'static str> {
    let stated = claim.min_separation?;
    let open = stated.attained - stated.distance;
    let accuracy = (0.01 * claim.tolerance).max(1e-4 * stated.attained) + rounding;
    if !(stated.distance >= 0.0 && open >= 0.0) {
        Some("the lower bound must be at least 0 and at most the distance attained")
    } else if stated.is_tight && open > accuracy {
        Some("the bounds are farther apart than is_tight promises")
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
                "penetrations are listed in order of time",
            ));
        }
    }
    // A pair may have one penetration and one contradiction of layers.
    let kinds = claim.penetrations.iter();
    let mut faces: Vec<_> = kinds.map(|p| (p.faces, p.conflict.is_some())).collect();
    faces.sort_unstable();
    if let Some([twice, _]) = faces.windows(2).find(|w| w[0] == w[1]) {
        refuted.push(Refutation::new(
            "penetrations",
            format!("triangles {:?} twice", twice.0),
            "each pair is listed once",
        ));
    }
}

/// Why the verdict does not follow from the rest of the report, or from what was found.
///
/// Between *free* and *touching*, the pairs that surely or possibly come within τ decide.
fn verdict_error(claim: &CollisionReport, [sure, possible]: [usize; 2]) -> Option<&'static str> {
    let is_close = claim.min_separation.is_some_and(|s| s.distance <= claim.tolerance);
    let (is_so, says) = if !claim.penetrations.is_empty() {
        let is_so = claim.verdict == Verdict::Penetrating;
        (is_so, "penetrations are listed")
    } else if !claim.undecided.is_empty() {
        let is_so = claim.verdict == Verdict::Undecided;
        (is_so, "undecided pairs are listed")
    } else if claim.verdict == Verdict::Free {
        (!is_close && sure == 0, "facets touch")
    } else {
        let is_so = claim.verdict == Verdict::Touching && (is_close || possible > 0);
        (is_so, "nothing touches, penetrates or is undecided")
    };
    (!is_so).then_some(says)
}

fn has_measured_pair(sheet: &Sheet) -> bool {
    let count = sheet.faces.len() as u32;
    (0..count).any(|f| (f + 1..count).any(|g| FacePair::new(sheet, [f, g]).is_measured(sheet)))
}
