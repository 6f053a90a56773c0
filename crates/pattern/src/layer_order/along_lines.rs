//! What meets along the lines at which pieces are joined.

use super::LayerError;
use super::conditions::Conditions;
use super::convex::Convex;
use super::pairs::Pairs;
use super::pieces::{Joint, Pieces};

/// The most conditions.
const MOST_CONDITIONS: usize = 12_000_000;

/// All conditions of a flat state.
pub(super) fn conditions(
    pieces: &Pieces,
    pairs: &Pairs,
    width: f64,
) -> Result<Conditions, LayerError> {
    let lines = Lines { pieces, pairs, width, joints_of: joints_of(pieces) };
    let mut conditions = Conditions::default();
    for index in 0..pieces.joints.len() {
        lines.meet(index, &mut conditions);
    }
    lines.stacks(&mut conditions)?;
    Ok(conditions)
}

/// The joints of each piece.
fn joints_of(pieces: &Pieces) -> Vec<Vec<u32>> {
    let mut of = vec![Vec::new(); pieces.list.len()];
    for (index, joint) in (0..).zip(&pieces.joints) {
        for piece in joint.pieces {
            of[piece as usize].push(index);
        }
    }
    of
}

struct Lines<'a> {
    pieces: &'a Pieces,
    pairs: &'a Pairs,
    /// Lines nearer than this are one, and shorter common parts of lines are none.
    width: f64,
    joints_of: Vec<Vec<u32>>,
}

impl Lines<'_> {
    /// Adds what meets a joint: pieces that its line crosses, and joints after it along the same line.
    fn meet(&self, index: usize, conditions: &mut Conditions) {
        let joint = &self.pieces.joints[index];
        let [a, b] = joint.pieces;
        let others = |piece: u32| self.pairs.around[piece as usize].iter().map(|&(other, _)| other);
        let mut near: Vec<u32> = others(a).chain(others(b)).collect();
        near.sort_unstable();
        near.dedup();
        near.retain(|piece| !joint.pieces.contains(piece));
        for &piece in &near {
            if !self.is_crossed(piece, joint) {
                continue;
            }
            if joint.is_folded {
                conditions.taco_tortilla(self.pairs, joint.pieces, piece);
            } else {
                conditions.tortilla_tortilla(self.pairs, joint.pieces, [piece; 2]);
            }
        }
        let joints = near.iter().flat_map(|&piece| &self.joints_of[piece as usize]);
        let mut later: Vec<u32> = joints.copied().filter(|&j| j as usize > index).collect();
        later.sort_unstable();
        later.dedup();
        for other in later.into_iter().map(|j| &self.pieces.joints[j as usize]) {
            let is_apart = other.pieces.iter().all(|piece| !joint.pieces.contains(piece));
            if is_apart && self.is_along(joint, other) {
                self.join(joint, other, conditions);
            }
        }
    }

    /// Adds the condition of two joints along one line.
    fn join(&self, one: &Joint, other: &Joint, conditions: &mut Conditions) {
        let [a, b] = one.pieces;
        let [c, d] = other.pieces;
        let is_left = |piece| self.is_left(one, piece);
        let is_same_side = is_left(a) == is_left(c);
        match (one.is_folded, other.is_folded) {
            (true, true) if is_same_side => {
                conditions.taco_taco(self.pairs, one.pieces, other.pieces);
            }
            (true, true) => {}
            (true, false) => {
                let beside = if is_same_side { c } else { d };
                conditions.taco_tortilla(self.pairs, one.pieces, beside);
            }
            (false, true) => {
                let beside = if is_same_side { a } else { b };
                conditions.taco_tortilla(self.pairs, other.pieces, beside);
            }
            (false, false) => {
                let others = if is_same_side { [c, d] } else { [d, c] };
                conditions.tortilla_tortilla(self.pairs, one.pieces, others);
            }
        }
    }

    /// Whether a piece reaches to both sides of the line of a joint, along a part of the joint.
    fn is_crossed(&self, piece: u32, joint: &Joint) -> bool {
        let place = &self.pieces.list[piece as usize].place;
        let [start, end] = joint.ends;
        let Some(along) = (end - start).try_normalize() else {
            return false;
        };
        let chord = place.chord(start, along, self.width);
        chord.is_some_and(|[from, to]| to.min(start.distance(end)) - from.max(0.0) > self.width)
    }

    /// Whether two joints lie along one line and have a part of it in common.
    fn is_along(&self, one: &Joint, other: &Joint) -> bool {
        let length = |joint: &Joint| joint.ends[0].distance(joint.ends[1]);
        let (long, short) = if length(one) < length(other) { (other, one) } else { (one, other) };
        let [start, end] = long.ends;
        let Some(along) = (end - start).try_normalize() else {
            return false;
        };
        let is_on_line = |p: &glam::DVec2| along.perp_dot(*p - start).abs() <= self.width;
        let [p, q] = short.ends.map(|p| along.dot(p - start));
        short.ends.iter().all(is_on_line)
            && p.max(q).min(length(long)) - p.min(q).max(0.0) > self.width
    }

    fn is_left(&self, joint: &Joint, piece: u32) -> bool {
        let [start, end] = joint.ends;
        let middle = self.pieces.list[piece as usize].place.middle();
        (end - start).perp_dot(middle - start) > 0.0
    }

    /// Adds the transitivity of every three pieces with a common part.
    ///
    /// # Errors
    /// [`LayerError::TooMany`].
    fn stacks(&self, conditions: &mut Conditions) -> Result<(), LayerError> {
        let place = |piece: u32| &self.pieces.list[piece as usize].place;
        for &[f, g] in &self.pairs.list {
            let around = |piece: u32| &self.pairs.around[piece as usize];
            let later = around(f).iter().map(|&(h, _)| h).filter(|&h| h > g);
            let mut common: Option<Convex> = None;
            for h in later.filter(|&h| self.pairs.above(g, h).is_some()) {
                let common = common.get_or_insert_with(|| place(f).common(place(g)));
                if !common.is_empty() && common.overlaps(place(h), self.width) {
                    conditions.transitivity(self.pairs, [f, g, h]);
                }
            }
            if conditions.len() > MOST_CONDITIONS {
                let limit = MOST_CONDITIONS;
                return Err(LayerError::TooMany { what: "conditions", limit });
            }
        }
        Ok(())
    }
}
