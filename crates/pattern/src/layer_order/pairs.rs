//! The pairs of pieces that lie on each other.

use super::LayerError;
use super::convex::Convex;
use super::pieces::Piece;

/// The most pairs.
const MOST_PAIRS: usize = 4_000_000;

/// The pairs of pieces that overlap, each a variable: whether the second lies above the first.
#[derive(Debug)]
pub(super) struct Pairs {
    /// The pieces of each pair, the smaller index first, in order.
    pub(super) list: Vec<[u32; 2]>,
    /// For each piece the others it overlaps, in order, with the index of the pair.
    pub(super) around: Vec<Vec<(u32, u32)>>,
}

/// A statement "the second piece lies above the first" about any two pieces: twice the index of the pair, plus one if it
/// is the opposite of the pair's variable.
pub(super) type Literal = u32;

impl Pairs {
    /// Finds the pairs that overlap by more than `width` in every direction.
    ///
    /// # Errors
    /// [`LayerError::TooMany`].
    pub(super) fn new(pieces: &[Piece], width: f64) -> Result<Self, LayerError> {
        let places: Vec<&Convex> = pieces.iter().map(|piece| &piece.place).collect();
        let mut by_start: Vec<u32> = (0..pieces.len() as u32).collect();
        by_start.sort_by(|&f, &g| places[f as usize].low.x.total_cmp(&places[g as usize].low.x));
        let mut list = Vec::new();
        for (k, &f) in by_start.iter().enumerate() {
            let place = places[f as usize];
            let ahead = by_start[k + 1..].iter().copied();
            for g in ahead.take_while(|&g| places[g as usize].low.x < place.high.x - width) {
                if place.overlaps(places[g as usize], width) {
                    list.push([f.min(g), f.max(g)]);
                }
            }
            if list.len() > MOST_PAIRS {
                return Err(LayerError::TooMany { what: "overlapping pairs", limit: MOST_PAIRS });
            }
        }
        list.sort_unstable();
        let mut around = vec![Vec::new(); pieces.len()];
        for (pair, &[f, g]) in (0..).zip(&list) {
            around[f as usize].push((g, pair));
            around[g as usize].push((f, pair));
        }
        for others in &mut around {
            others.sort_unstable();
        }
        Ok(Self { list, around })
    }

    /// The statement that `upper` lies above `lower`; `None` where they do not overlap.
    pub(super) fn above(&self, lower: u32, upper: u32) -> Option<Literal> {
        let others = &self.around[lower as usize];
        let found = others.binary_search_by_key(&upper, |&(other, _)| other).ok()?;
        Some(2 * others[found].1 + u32::from(upper < lower))
    }
}
