//! Certifies a pair of moving triangles.

use super::{
    Effort, Limits, MovingPair, Outcome, PairCertificate, Side, certifier::Certifier,
    impact::never_meet, separating::widest,
};

/// The first steps tried, in turn: a coarse step may lose a part of D(t) that a fine one follows.
const FIRST_STEPS: [f64; 3] = [1.0, 1.0 / 16.0, 1.0 / 256.0];

/// Certifies a pair from the side it starts on (see the module documentation).
///
/// `side`: from [`Side::at_start`], or the side the pair had at the end of the previous interval. If the steps do not
/// certify the pair, the vertex–facet and edge–edge queries are tried, which need no axes: those of triangles that
/// shrink to a segment during the motion are undefined.
pub fn certify(pair: &MovingPair, side: &Side, limits: &Limits) -> Outcome {
    let mut outcome = Outcome::Undecided { time: 0.0 };
    for first_step in FIRST_STEPS {
        outcome = Certifier::new(pair, side.clone(), limits).run(first_step);
        let is_deep = matches!(&outcome, Outcome::Crossed(c) if c.depth > limits.tolerance);
        if is_deep || matches!(outcome, Outcome::Passed(_)) {
            break;
        }
    }
    if matches!(outcome, Outcome::Passed(_)) {
        return outcome;
    }
    passage_without_meeting(pair, side, limits).map_or(outcome, Outcome::Passed)
}

/// The certificate of triangles that share no vertex, start apart, end apart and are proved never to meet in between.
fn passage_without_meeting(
    pair: &MovingPair,
    side: &Side,
    limits: &Limits,
) -> Option<PairCertificate> {
    if pair.start.shared > 0 || matches!(side, Side::Contact(_)) {
        return None;
    }
    widest(&pair.start, limits)?;
    let at_end = widest(&pair.end, limits)?;
    never_meet(pair, limits).then_some(PairCertificate {
        side: Side::Apart(at_end),
        clearance: limits.margin,
        in_contact: false,
        effort: Effort::Search,
    })
}
