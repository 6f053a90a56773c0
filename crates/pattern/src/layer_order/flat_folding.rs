//! A pattern folded flat, with an order of its layers where there is one.

use super::along_lines::conditions;
use super::conditions::{ConditionCounts, Conditions};
use super::contradiction::Problem;
use super::convex::Convex;
use super::given::Given;
use super::pairs::Pairs;
use super::pieces::Pieces;
use super::search::{Found, Search, SearchLimits};
use super::{FlatState, LayerError};
use crate::{ImportedPattern, LayerOrder};

/// How far the search goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerOptions {
    /// The most conditions that are looked at before the search ends undecided.
    pub steps: u64,
    /// The most orders of each independent component that are counted; at least 1.
    pub solutions: u64,
    /// What [`FlatState::width`] is multiplied by: where facets are hardly wider than that, another width may tell them
    /// apart.
    pub width: f64,
}

impl Default for LayerOptions {
    fn default() -> Self {
        Self { steps: 50_000_000, solutions: 1, width: 1.0 }
    }
}

/// What was found about the order of layers.
#[derive(Debug, Clone, PartialEq)]
pub enum FoundLayers {
    /// An order exists.
    Order {
        /// One such order, of every two triangles of different facets that overlap, both directions.
        order: LayerOrder,
        /// How many there are; `None` if not all were counted.
        solutions: Option<u64>,
    },
    /// No order exists.
    None {
        /// Facets that cannot be put in order, whatever the others do. None of them can be left out, unless there are
        /// too many to try.
        facets: Vec<u32>,
        /// The orders of these facets that the file gives; without those of the file an order exists. Empty if the file
        /// is not the reason.
        given: Vec<[u32; 2]>,
    },
    /// The search ended first.
    Undecided {
        /// The number of conditions that were looked at.
        steps: u64,
    },
}

/// A pattern folded flat, and what was found about the order of its layers.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatFolding {
    /// The flat state.
    pub state: FlatState,
    /// The number of pairs of facets that overlap; of facets that are not convex, pairs of their triangles.
    pub pairs: usize,
    /// The number of conditions on the order of these pairs.
    pub conditions: ConditionCounts,
    /// The number of components that were searched, after all that follows from creases and given orders.
    pub components: usize,
    /// An order of layers, or why there is none.
    pub found: FoundLayers,
}

impl FlatFolding {
    /// Folds a pattern flat and finds an order of its layers.
    ///
    /// `targets`: the fold angle of every edge in the flat state, radians. Orders that the file gives hold.
    ///
    /// # Errors
    /// [`LayerError`] if the pattern does not fold flat, or is too large.
    pub fn find(
        imported: &ImportedPattern,
        targets: &[f64],
        options: &LayerOptions,
    ) -> Result<Self, LayerError> {
        let mut state = FlatState::new(&imported.sheet, targets)?;
        state.width *= options.width;
        Self::of_state(state, &imported.face_orders, options)
    }

    fn of_state(
        state: FlatState,
        face_orders: &[(u32, u32, i8)],
        options: &LayerOptions,
    ) -> Result<Self, LayerError> {
        let pieces = Pieces::new(&state);
        let pairs = Pairs::new(&pieces.list, state.width)?;
        let conditions = conditions(&pieces, &pairs, state.width)?;
        let given = Given::new(&state.sheet, &pieces, &pairs, face_orders)?;
        let layers = Layers { state: &state, pieces, pairs, conditions, given };
        let limits = SearchLimits { steps: options.steps, solutions: options.solutions.max(1) };
        let search = layers.search(&layers.given.all(), limits);
        let (counts, components) = (layers.conditions.counts(), search.components);
        let pairs = layers.pairs.list.len();
        let found = layers.found(search, limits);
        Ok(Self { pairs, conditions: counts, components, found, state })
    }
}

/// Everything about the layers of a flat state.
struct Layers<'a> {
    state: &'a FlatState,
    pieces: Pieces,
    pairs: Pairs,
    conditions: Conditions,
    given: Given,
}

impl Layers<'_> {
    fn search(&self, given: &[(u32, bool)], limits: SearchLimits) -> Search {
        Search::run(&self.conditions, self.pairs.list.len(), given, limits)
    }

    fn found(&self, search: Search, limits: SearchLimits) -> FoundLayers {
        match search.found {
            Found::Orders { values, solutions } => {
                FoundLayers::Order { order: self.order(&values), solutions }
            }
            Found::None { pairs } => self.contradiction(&pairs, limits),
            Found::Undecided => FoundLayers::Undecided { steps: search.steps },
        }
    }

    fn contradiction(&self, pairs: &[u32], limits: SearchLimits) -> FoundLayers {
        let all = self.given.all();
        let problem =
            Problem { pairs: &self.pairs.list, conditions: &self.conditions, given: &all };
        let pieces = problem.least(pairs);
        let facet = |piece: &u32| self.pieces.list[*piece as usize].facet;
        let mut facets: Vec<u32> = pieces.iter().map(facet).collect();
        facets.sort_unstable();
        facets.dedup();
        let is_of_file = !self.given.by_file.is_empty()
            && matches!(self.search(&self.given.by_creases, limits).found, Found::Orders { .. });
        let by_file = self.given.by_file.iter().map(|&(pair, _)| self.pairs.list[pair as usize]);
        let given = by_file
            .filter(|pair| is_of_file && pair.iter().all(|piece| pieces.contains(piece)))
            .map(|pair| pair.map(|piece| facet(&piece)));
        FoundLayers::None { facets, given: given.collect() }
    }

    /// The order of all triangles of two pieces that overlap.
    fn order(&self, values: &[bool]) -> LayerOrder {
        let mut triangles = vec![Vec::new(); self.pieces.list.len()];
        for (face, &piece) in (0..).zip(&self.pieces.of_triangle) {
            triangles[piece as usize].push((face, Convex::new(self.state.triangle(face).to_vec())));
        }
        let is_turned = |piece: u32| self.pieces.list[piece as usize].is_turned;
        let side = |is_up: bool| if is_up { 1 } else { -1 };
        let mut order = LayerOrder::default();
        for (&[p, q], &is_second_above) in self.pairs.list.iter().zip(values) {
            for (f, at) in &triangles[p as usize] {
                let over = triangles[q as usize].iter();
                for (g, _) in over.filter(|(_, other)| at.overlaps(other, self.state.width)) {
                    order.insert(*g, *f, side(is_second_above != is_turned(p)));
                    order.insert(*f, *g, side(is_second_above == is_turned(q)));
                }
            }
        }
        order
    }
}
