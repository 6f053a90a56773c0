//! A small set of pieces that have no order, as evidence that the sheet has none.

use std::collections::BTreeSet;

use super::conditions::Conditions;
use super::search::{Found, Search, SearchLimits};

/// The most pieces from which the set is reduced one by one.
const MOST_REDUCED: usize = 2000;
/// The budget of each search of a smaller set.
const LIMITS: SearchLimits = SearchLimits { steps: 100_000, solutions: 1 };
/// The most searches.
const MOST_SEARCHES: usize = 2000;

/// Pieces, their pairs and what is asked of these.
#[derive(Debug)]
pub(super) struct Problem<'a> {
    /// The pieces of each pair.
    pub(super) pairs: &'a [[u32; 2]],
    pub(super) conditions: &'a Conditions,
    pub(super) given: &'a [(u32, bool)],
}

/// A problem restricted to some pieces.
struct Restricted {
    pairs: Vec<[u32; 2]>,
    conditions: Conditions,
    given: Vec<(u32, bool)>,
}

impl Restricted {
    fn problem(&self) -> Problem<'_> {
        Problem { pairs: &self.pairs, conditions: &self.conditions, given: &self.given }
    }
}

impl Problem<'_> {
    fn restricted(&self, pieces: &BTreeSet<u32>) -> Restricted {
        let mut renumbered = vec![None; self.pairs.len()];
        let mut pairs = Vec::new();
        for (new, pair) in renumbered.iter_mut().zip(self.pairs) {
            if pair.iter().all(|piece| pieces.contains(piece)) {
                *new = Some(pairs.len() as u32);
                pairs.push(*pair);
            }
        }
        let new = |&(pair, value): &(u32, bool)| Some((renumbered[pair as usize]?, value));
        Restricted {
            given: self.given.iter().filter_map(new).collect(),
            conditions: self.conditions.restricted(&renumbered),
            pairs,
        }
    }

    fn has_none(&self) -> bool {
        let search = Search::run(self.conditions, self.pairs.len(), self.given, LIMITS);
        matches!(search.found, Found::None { .. })
    }

    /// Pieces that have no order whatever the others do: none of them can be left out, unless the set is too large to be
    /// reduced. `contradicting`: pairs that were found to contradict each other.
    pub(super) fn least(&self, contradicting: &[u32]) -> BTreeSet<u32> {
        let pieces: BTreeSet<u32> =
            contradicting.iter().flat_map(|&pair| self.pairs[pair as usize]).collect();
        let mut within = self.restricted(&pieces);
        if pieces.len() > MOST_REDUCED || !within.problem().has_none() {
            return pieces;
        }
        let mut left: Vec<u32> = pieces.into_iter().collect();
        let mut size = left.len() / 2;
        let mut searches = 0;
        while size > 0 {
            let mut start = 0;
            while start < left.len() && searches < MOST_SEARCHES {
                searches += 1;
                let end = (start + size).min(left.len());
                let rest: BTreeSet<u32> =
                    left[..start].iter().chain(&left[end..]).copied().collect();
                let fewer = within.problem().restricted(&rest);
                if fewer.problem().has_none() {
                    left = rest.into_iter().collect();
                    within = fewer;
                } else {
                    start = end;
                }
            }
            size /= 2;
        }
        left.into_iter().collect()
    }
}
