//! The conditions that an order of layers must meet, as tables over the statements they speak of.
//!
//! The conditions are those of Justin 1997, "Towards a mathematical theory of origami", in the form of Akitaya, Mitani,
//! Kanamori, Fukui 2013, "Generating folding sequences from crease patterns of flat-foldable origami", and of Ku's
//! Flat-Folder: taco–taco, taco–tortilla, tortilla–tortilla and transitivity.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::pairs::{Literal, Pairs};

/// The kind of a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    TacoTaco,
    TacoTortilla,
    TortillaTortilla,
    Transitivity,
}

/// How many conditions of each kind an order of layers must meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct ConditionCounts {
    /// Two folded creases along one line, on the same side of it: their layers may not alternate.
    pub taco_taco: usize,
    /// A folded crease and a facet that goes on beyond its line: the facet may not lie between the layers of the crease.
    pub taco_tortilla: usize,
    /// Two facets that both go on beyond a line, at least one of them joined from two pieces there: their order is the
    /// same on both sides.
    pub tortilla_tortilla: usize,
    /// Three facets that lie over one point: their orders may not form a cycle.
    pub transitivity: usize,
}

impl ConditionCounts {
    /// The number of all conditions.
    pub fn total(&self) -> usize {
        self.taco_taco + self.taco_tortilla + self.tortilla_tortilla + self.transitivity
    }
}

/// The bits of a table at whose index the statement i holds.
const HOLDS: [u64; 6] = [
    0xAAAA_AAAA_AAAA_AAAA,
    0xCCCC_CCCC_CCCC_CCCC,
    0xF0F0_F0F0_F0F0_F0F0,
    0xFF00_FF00_FF00_FF00,
    0xFFFF_0000_FFFF_0000,
    0xFFFF_FFFF_0000_0000,
];

/// Both statements hold, or neither.
const EQUAL: u64 = 0b1001;
/// a < b, b < c and a < c: all but the two cycles a < b < c < a and a > b > c > a.
const ACYCLIC: u64 = 0b1110_0111;

/// Conditions, each a table of the combinations of its statements that are possible.
#[derive(Debug, Default)]
pub(super) struct Conditions {
    kinds: Vec<Kind>,
    /// Where the statements of each condition start.
    starts: Vec<u32>,
    literals: Vec<Literal>,
    taco_taco: TacoTable,
}

/// The possible combinations of a < b, c < d, a < c, a < d, b < c, b < d, where a crease joins a to b and another one
/// c to d.
#[derive(Debug)]
struct TacoTable(u64);

impl Default for TacoTable {
    fn default() -> Self {
        let mut table = 0;
        for code in 0..256 {
            let ranks = [0, 2, 4, 6].map(|shift| code >> shift & 3);
            let [a, b, c, d] = ranks;
            let is_order = (0..4).all(|rank| ranks.contains(&rank));
            let is_between = |x: i32| (a < x) != (b < x);
            if is_order && is_between(c) == is_between(d) {
                let holds = [a < b, c < d, a < c, a < d, b < c, b < d];
                let bits = holds.iter().enumerate().map(|(i, &holds)| u32::from(holds) << i);
                table |= 1 << bits.sum::<u32>();
            }
        }
        Self(table)
    }
}

impl Conditions {
    pub(super) fn len(&self) -> usize {
        self.kinds.len()
    }

    fn push(&mut self, kind: Kind, literals: &[Literal]) {
        self.kinds.push(kind);
        self.starts.push(self.literals.len() as u32);
        self.literals.extend_from_slice(literals);
    }

    /// Creases join a to b and c to d on one side of a line.
    pub(super) fn taco_taco(&mut self, pairs: &Pairs, [a, b]: [u32; 2], [c, d]: [u32; 2]) {
        let all = [[a, b], [c, d], [a, c], [a, d], [b, c], [b, d]];
        let all = all.map(|[f, g]| pairs.above(f, g));
        if let [Some(ab), Some(cd), Some(ac), Some(ad), Some(bc), Some(bd)] = all {
            self.push(Kind::TacoTaco, &[ab, cd, ac, ad, bc, bd]);
        }
    }

    /// A crease joins a to b, and c lies on their side of its line and goes on beyond it.
    pub(super) fn taco_tortilla(&mut self, pairs: &Pairs, [a, b]: [u32; 2], c: u32) {
        self.equal(Kind::TacoTortilla, pairs, [[a, c], [b, c]]);
    }

    /// a goes on as b beyond a line, and c, on the side of a, as d.
    pub(super) fn tortilla_tortilla(&mut self, pairs: &Pairs, [a, b]: [u32; 2], [c, d]: [u32; 2]) {
        self.equal(Kind::TortillaTortilla, pairs, [[a, c], [b, d]]);
    }

    /// a, b and c lie over one point.
    pub(super) fn transitivity(&mut self, pairs: &Pairs, [a, b, c]: [u32; 3]) {
        let all = [[a, b], [b, c], [a, c]].map(|[f, g]| pairs.above(f, g));
        if let [Some(ab), Some(bc), Some(ac)] = all {
            self.push(Kind::Transitivity, &[ab, bc, ac]);
        }
    }

    fn equal(&mut self, kind: Kind, pairs: &Pairs, both: [[u32; 2]; 2]) {
        if let [Some(one), Some(other)] = both.map(|[f, g]| pairs.above(f, g)) {
            self.push(kind, &[one, other]);
        }
    }

    /// The statements of a condition.
    pub(super) fn literals(&self, condition: u32) -> &[Literal] {
        let index = condition as usize;
        let end = self.starts.get(index + 1).map_or(self.literals.len(), |&end| end as usize);
        &self.literals[self.starts[index] as usize..end]
    }

    /// The pairs that a condition speaks of.
    pub(super) fn variables(&self, condition: u32) -> impl Iterator<Item = u32> + '_ {
        self.literals(condition).iter().map(|literal| literal / 2)
    }

    /// The combinations of a condition that are possible where `value` is known of some pairs.
    pub(super) fn possible(&self, condition: u32, value: impl Fn(u32) -> Option<bool>) -> u64 {
        let literals = self.literals(condition);
        let known = literals.iter().zip(HOLDS).filter_map(|(literal, holds)| {
            let is_true = value(literal / 2)? != (literal % 2 == 1);
            Some(if is_true { holds } else { !holds })
        });
        known.fold(self.table(condition), |table, bits| table & bits)
    }

    /// What follows for each pair that is not known from the combinations that are possible.
    pub(super) fn implied(
        &self,
        condition: u32,
        possible: u64,
    ) -> impl Iterator<Item = (u32, bool)> + '_ {
        self.literals(condition).iter().zip(HOLDS).filter_map(move |(literal, holds)| {
            let is_flipped = literal % 2 == 1;
            match (possible & holds, possible & !holds) {
                (0, _) => Some((literal / 2, is_flipped)),
                (_, 0) => Some((literal / 2, !is_flipped)),
                _ => None,
            }
        })
    }

    /// Whether every combination of the pairs that are not known is possible.
    pub(super) fn is_met(possible: u64, unknown: usize) -> bool {
        possible.count_ones() == 1 << unknown
    }

    /// The same conditions without those that speak of other pairs: `renumbered` has the new index of each pair.
    pub(super) fn restricted(&self, renumbered: &[Option<u32>]) -> Self {
        let mut kept = Self::default();
        let mut literals = Vec::new();
        for condition in 0..self.len() as u32 {
            literals.clear();
            let all = self.literals(condition);
            let new = |l: &Literal| Some(2 * renumbered[(l / 2) as usize]? + l % 2);
            literals.extend(all.iter().filter_map(new));
            if literals.len() == all.len() {
                kept.push(self.kinds[condition as usize], &literals);
            }
        }
        kept
    }

    pub(super) fn counts(&self) -> ConditionCounts {
        let count = |kind| self.kinds.iter().filter(|&&k| k == kind).count();
        ConditionCounts {
            taco_taco: count(Kind::TacoTaco),
            taco_tortilla: count(Kind::TacoTortilla),
            tortilla_tortilla: count(Kind::TortillaTortilla),
            transitivity: count(Kind::Transitivity),
        }
    }

    fn table(&self, condition: u32) -> u64 {
        match self.kinds[condition as usize] {
            Kind::TacoTaco => self.taco_taco.0,
            Kind::TacoTortilla | Kind::TortillaTortilla => EQUAL,
            Kind::Transitivity => ACYCLIC,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_two_creases_has_the_orders_whose_brackets_do_not_cross() {
        // Of the 24 orders of four layers, a third has the brackets of two pairs crossing: 8.
        assert_eq!(TacoTable::default().0.count_ones(), 16);
    }

    #[test]
    fn three_layers_have_six_orders() {
        assert_eq!(ACYCLIC.count_ones(), 6);
    }
}
