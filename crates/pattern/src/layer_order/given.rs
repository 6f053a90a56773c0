//! Orders that are given: those of mountain and valley creases, and those of the file.

use std::collections::BTreeMap;

use super::LayerError;
use super::pairs::{Literal, Pairs};
use super::pieces::Pieces;
use crate::{Assignment, Sheet};

/// An order of two facets as FOLD states it: the first lies on the side of the second one's front (1) or back (−1).
pub(super) type FaceOrder = (u32, u32, i8);

/// The pairs whose order is given, with whether the second piece lies above the first.
#[derive(Debug, Default)]
pub(super) struct Given {
    /// By creases.
    pub(super) by_creases: Vec<(u32, bool)>,
    /// By the file, where creases do not say the same.
    pub(super) by_file: Vec<(u32, bool)>,
}

fn order(statement: Literal) -> (u32, bool) {
    (statement / 2, statement.is_multiple_of(2))
}

impl Given {
    /// # Errors
    /// [`LayerError::GivenOrder`].
    pub(super) fn new(
        sheet: &Sheet,
        pieces: &Pieces,
        pairs: &Pairs,
        of_file: &[FaceOrder],
    ) -> Result<Self, LayerError> {
        let by_creases: BTreeMap<u32, bool> = of_creases(sheet, pieces, pairs).collect();
        let mut by_file = BTreeMap::new();
        let mut of_facet = vec![Vec::new(); sheet.facets.len()];
        for (index, piece) in (0..).zip(&pieces.list) {
            of_facet[piece.facet as usize].push(index);
        }
        for &(f, g, sign) in of_file {
            let of = |facet: u32| of_facet.get(facet as usize).map_or(&[][..], Vec::as_slice);
            let all = of(f).iter().flat_map(|&p| of(g).iter().map(move |&q| (p, q)));
            for (p, q) in all {
                let is_up = (sign > 0) != pieces.list[q as usize].is_turned;
                let statement = if is_up { pairs.above(q, p) } else { pairs.above(p, q) };
                let Some((pair, value)) = statement.map(order) else {
                    continue;
                };
                let crease = by_creases.get(&pair).copied();
                let known = crease.or_else(|| by_file.get(&pair).copied());
                if known.is_some_and(|known| known != value) {
                    let instead = match crease {
                        Some(_) => "the crease between them folds to the other side",
                        None => "another entry says the opposite",
                    };
                    let is_above = sign > 0;
                    return Err(LayerError::GivenOrder { facets: [f, g], is_above, instead });
                }
                if crease.is_none() {
                    by_file.insert(pair, value);
                }
            }
        }
        let list = |map: BTreeMap<u32, bool>| map.into_iter().collect();
        Ok(Self { by_creases: list(by_creases), by_file: list(by_file) })
    }

    /// All orders that are given.
    pub(super) fn all(&self) -> Vec<(u32, bool)> {
        [&self.by_creases[..], &self.by_file].concat()
    }
}

/// A valley puts each piece on the front of the other, a mountain on its back.
fn of_creases<'a>(
    sheet: &'a Sheet,
    pieces: &'a Pieces,
    pairs: &'a Pairs,
) -> impl Iterator<Item = (u32, bool)> + 'a {
    pieces.joints.iter().filter_map(|joint| {
        let [a, b] = joint.pieces;
        let is_front = match sheet.edges[joint.edge as usize].assignment {
            Assignment::Valley => true,
            Assignment::Mountain => false,
            _ => return None,
        };
        let is_up = is_front != pieces.list[a as usize].is_turned;
        let statement = if is_up { pairs.above(a, b) } else { pairs.above(b, a) };
        statement.map(order)
    })
}
