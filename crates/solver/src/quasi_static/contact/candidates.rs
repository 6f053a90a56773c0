//! The pairs of primitives that can meet soon, found by a tree of boxes and followed from state to state.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use foldmotion_geometry::collide::Tree;
use glam::DVec3;

use super::super::configuration::{dot, largest};
use super::near::NearPairs;
use super::pair::{ContactPair, PairKind};
use super::plane::Plane;
use super::primitives::Primitives;
use super::step_limit::step_limit;
use crate::SolverError;

/// Pairs closer than this share of the gap at the start count as in touch.
const TOUCHING: f64 = 1e-3;
/// Candidates are searched within this many gaps.
const WITHIN: f64 = 2.0;
/// The share of its gap that a pair never gives up in a step, and on the straight path between two frames.
const FLOOR: f64 = 0.5;
const PATH_FLOOR: f64 = 0.45;
/// Instants of a path at which triangles that started in touch are tried.
const INSTANTS: u32 = 8;
/// By how much distances may change before candidates are looked for again, in unit lengths: at least this many gaps,
/// twice what nodes move up to this, and more up to the last while there are few.
const MARGIN_IN_GAPS: f64 = 4.0;
const MARGIN: f64 = 0.02;
const MOST_MARGIN: f64 = 0.2;
/// Few are fewer than there are triangles, many this many times as many.
const MANY: usize = 8;

/// The candidates, with what is known of each pair.
pub(super) struct Candidates {
    primitives: Primitives,
    tree: Tree,
    gap: f64,
    triangles: usize,
    /// The largest distance so far of the pairs that do not keep the whole gap yet.
    admitted: BTreeMap<(PairKind, [u32; 4]), f64>,
    /// The pairs of triangles of those that are not pushed apart yet.
    in_touch: Vec<[u32; 2]>,
    pairs: Vec<ContactPair>,
    near: NearPairs,
    searched_path: SearchedPath,
    margin: f64,
    searches: usize,
}

/// The straight path along which candidates were searched.
#[derive(Default)]
struct SearchedPath {
    from: Vec<DVec3>,
    displacement: Vec<DVec3>,
    margin: f64,
}

impl SearchedPath {
    /// Whether no node of `positions` is further than half the margin from where it is at one instant of the path.
    fn holds(&self, positions: &[DVec3]) -> bool {
        if self.from.len() != positions.len() {
            return false;
        }
        let off = || positions.iter().zip(&self.from).map(|(&x, &a)| x - a);
        let square = dot(&self.displacement, &self.displacement);
        let along: f64 = off().zip(&self.displacement).map(|(d, &w)| d.dot(w)).sum();
        let time = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
        let limit = 0.25 * self.margin * self.margin;
        off().zip(&self.displacement).all(|(d, &w)| (d - w * time).length_squared() <= limit)
    }
}

impl Candidates {
    /// The candidates among `primitives` that keep `gap`, from `start` (unit lengths) on.
    ///
    /// # Errors
    /// [`SolverError::StartCrosses`].
    pub(super) fn new(
        primitives: Primitives,
        gap: f64,
        start: &[DVec3],
    ) -> Result<Self, SolverError> {
        let boxes = primitives.boxes(start, &[], 0.0);
        let mut candidates = Self {
            tree: Tree::new(&boxes),
            gap,
            triangles: boxes.len(),
            admitted: BTreeMap::new(),
            in_touch: Vec::new(),
            pairs: Vec::new(),
            near: NearPairs::default(),
            searched_path: SearchedPath::default(),
            margin: MARGIN,
            searches: 0,
            primitives,
        };
        if let Some(faces) = candidates.crossing(start) {
            return Err(SolverError::StartCrosses { faces });
        }
        candidates.admit(start);
        Ok(candidates)
    }

    pub(super) fn gap(&self) -> f64 {
        self.gap
    }

    pub(super) fn searches(&self) -> usize {
        self.searches
    }

    pub(super) fn pair(&self, index: u32) -> &ContactPair {
        &self.pairs[index as usize]
    }

    pub(super) fn pair_mut(&mut self, index: u32) -> &mut ContactPair {
        &mut self.pairs[index as usize]
    }

    pub(super) fn pairs_mut(&mut self) -> &mut [ContactPair] {
        &mut self.pairs
    }

    pub(super) fn forget_planes(&mut self) {
        for pair in &mut self.pairs {
            pair.has_plane = false;
        }
    }

    /// Lowers the gap to `gap`, if that is lower.
    pub(super) fn close_to(&mut self, gap: f64) {
        if gap < self.gap {
            self.gap = gap;
            self.searched_path = SearchedPath::default();
        }
    }

    /// Makes the candidates good for `positions`; the planes held keep their pairs.
    pub(super) fn prepare(&mut self, positions: &[DVec3], planes: &mut Vec<Plane>) {
        let still = vec![DVec3::ZERO; positions.len()];
        self.prepare_path(positions, &still, planes);
    }

    /// Makes the candidates good for every state on the straight path from `positions` to `positions` + `displacement`.
    pub(super) fn prepare_path(
        &mut self,
        positions: &[DVec3],
        displacement: &[DVec3],
        planes: &mut Vec<Plane>,
    ) {
        let end: Vec<DVec3> = positions.iter().zip(displacement).map(|(&x, &d)| x + d).collect();
        // The states near the searched path are a convex set: if they hold the ends of a path they hold all of it.
        if self.searched_path.holds(positions) && self.searched_path.holds(&end) {
            return;
        }
        let reach = largest(displacement);
        let margin = (2.0 * reach).min(MARGIN).max(MARGIN_IN_GAPS * self.gap).max(self.margin);
        let (mut pairs, least) = self.search(positions, displacement, WITHIN * self.gap + margin);
        self.searched_path =
            SearchedPath { from: positions.to_vec(), displacement: displacement.to_vec(), margin };
        // Few candidates may as well serve for longer; many cost more than another search.
        if pairs.len() < self.triangles {
            self.margin = (2.0 * margin).min(MOST_MARGIN);
        } else if pairs.len() > MANY * self.triangles {
            self.margin = 0.0;
        }
        self.carry_over(&mut pairs, planes);
        self.near = NearPairs::new(positions, least, &pairs);
        self.pairs = pairs;
    }

    /// Carries over what is known of the pairs, and the planes held, to a new list of them.
    fn carry_over(&self, pairs: &mut [ContactPair], planes: &mut Vec<Plane>) {
        let known = || self.pairs.iter().filter(|pair| pair.is_known());
        if known().next().is_none() {
            return planes.clear();
        }
        let by_key: HashMap<_, u32> =
            pairs.iter().enumerate().map(|(index, pair)| (pair.key(), index as u32)).collect();
        for old in known() {
            if let Some(&index) = by_key.get(&old.key()) {
                let pair = &mut pairs[index as usize];
                pair.multiplier = old.multiplier;
                pair.stiffening = old.stiffening;
                pair.is_on_facet = old.is_on_facet;
                pair.pushes = old.pushes;
                pair.has_plane = old.has_plane;
            }
        }
        planes.retain_mut(|plane| {
            let index = by_key.get(&self.pair(plane.pair).key());
            plane.pair = index.copied().unwrap_or_default();
            index.is_some()
        });
    }

    /// Measures the distances at `positions`. Precondition: prepared for them.
    pub(super) fn measure(&mut self, positions: &[DVec3]) {
        self.near.move_to(&self.pairs, positions);
    }

    /// The pairs within a few gaps, in order. Precondition: measured.
    pub(super) fn near(&self) -> Vec<u32> {
        self.near.active.clone()
    }

    /// The pairs without a plane that the step `direction`, no node moving further than `reach`, may bring within the
    /// gap. Precondition: measured.
    pub(super) fn closing(&self, direction: &[DVec3], reach: f64) -> Vec<u32> {
        let pairs = self.pairs.iter().zip(&self.near.least).enumerate();
        pairs
            .filter(|(_, (pair, least))| {
                let free = **least - pair.gap;
                free <= 2.0 * reach
                    && !pair.has_plane
                    && free <= pair.speed(&pair.corners(direction))
            })
            .map(|(index, _)| index as u32)
            .collect()
    }

    /// The largest t ≤ `limit` for which every pair keeps half of its gap on the path from `positions` along
    /// t × `direction`. Precondition: prepared for that path.
    pub(super) fn step_limit(
        &mut self,
        positions: &[DVec3],
        direction: &[DVec3],
        limit: f64,
    ) -> f64 {
        self.measure(positions);
        let reach = 2.0 * largest(direction);
        let pairs = self.pairs.iter().zip(&self.near.least);
        pairs.fold(limit, |limit, (pair, least)| {
            let floor = FLOOR * pair.gap;
            if least - floor > reach * limit {
                return limit;
            }
            let d = pair.corners(direction);
            if least - floor > pair.speed(&d) * limit {
                return limit;
            }
            step_limit(pair, floor, &pair.corners(positions), &d, limit)
        })
    }

    /// Whether no layer touches another on the straight path between two states.
    pub(super) fn is_path_free(
        &mut self,
        from: &[DVec3],
        to: &[DVec3],
        planes: &mut Vec<Plane>,
    ) -> bool {
        let displacement: Vec<DVec3> = to.iter().zip(from).map(|(&b, &a)| b - a).collect();
        if self.crossing_in_touch(from, to).is_some() {
            return false;
        }
        self.prepare_path(from, &displacement, planes);
        self.measure(from);
        let reach = 2.0 * largest(&displacement);
        self.pairs.iter().zip(&self.near.least).all(|(pair, least)| {
            let floor = PATH_FLOOR * pair.gap;
            least - floor > reach || {
                let (x, d) = (pair.corners(from), pair.corners(&displacement));
                step_limit(pair, floor, &x, &d, 1.0) >= 1.0
            }
        })
    }

    /// Takes note of an equilibrium: pairs that have come further apart keep more of the gap from now on.
    pub(super) fn accept(&mut self, positions: &[DVec3]) {
        let whole = WITHIN * self.gap;
        let before = self.admitted.len();
        let mut grown = false;
        for ((kind, nodes), most) in &mut self.admitted {
            let distance = kind.closest(&nodes.map(|v| positions[v as usize])).distance;
            if distance > 1.1 * *most && distance > 0.1 * self.gap {
                *most = distance;
                grown = true;
            }
        }
        self.admitted.retain(|_, most| *most < whole);
        if grown || self.admitted.len() != before {
            self.searched_path = SearchedPath::default();
        }
    }

    /// Every pair that may come nearer than `within` on the straight path from `positions` to `positions` +
    /// `displacement`, with its distance at `positions`.
    fn search(
        &mut self,
        positions: &[DVec3],
        displacement: &[DVec3],
        within: f64,
    ) -> (Vec<ContactPair>, Vec<f64>) {
        self.searches += 1;
        let boxes = self.primitives.boxes(positions, displacement, 0.5 * within);
        self.tree.refit(&boxes);
        let furthest = within + 2.0 * largest(displacement);
        let (mut pairs, mut distances) = (Vec::new(), Vec::new());
        self.tree.visit_overlapping(&boxes, |a, b| {
            self.primitives.visit_pairs(a, b, |kind, nodes, mollifier| {
                let mut pair = ContactPair::new(kind, nodes, [a, b], self.gap, mollifier);
                let x = pair.corners(positions);
                let least = pair.least_distance(&x);
                if least >= furthest {
                    return;
                }
                let within = within + pair.speed(&pair.corners(displacement));
                if least >= within {
                    return;
                }
                let distance = pair.closest(&x).distance;
                if distance < within && self.keeps_gap(&mut pair) {
                    pairs.push(pair);
                    distances.push(distance);
                }
            });
        });
        (pairs, distances)
    }

    /// Sets the gap of an admitted pair; false where it is not pushed apart yet.
    fn keeps_gap(&self, pair: &mut ContactPair) -> bool {
        let Some(&most) = self.admitted.get(&pair.key()) else {
            return true;
        };
        pair.gap = self.gap.min(0.5 * most);
        most > TOUCHING * self.gap
    }

    /// Admits the pairs that start closer than twice the gap.
    fn admit(&mut self, start: &[DVec3]) {
        let still = vec![DVec3::ZERO; start.len()];
        let (close, distances) = self.search(start, &still, WITHIN * self.gap);
        let touching = close.iter().zip(&distances).filter(|(_, d)| **d <= TOUCHING * self.gap);
        let triangles: BTreeSet<[u32; 2]> =
            touching.flat_map(|(pair, _)| self.primitives.triangles_of(pair)).collect();
        self.in_touch = triangles.into_iter().collect();
        self.admitted = close.iter().map(ContactPair::key).zip(distances).collect();
    }

    /// Two triangles among those that started in touch that cross or overlap each other on the straight path between two states, at
    /// its end or at one of the instants tried before.
    pub(super) fn crossing_in_touch(&self, from: &[DVec3], to: &[DVec3]) -> Option<[u32; 2]> {
        if self.in_touch.is_empty() {
            return None;
        }
        (1..=INSTANTS).find_map(|k| {
            let t = f64::from(k) / f64::from(INSTANTS);
            let between: Vec<DVec3> = from.iter().zip(to).map(|(a, b)| a.lerp(*b, t)).collect();
            let mut in_touch = self.in_touch.iter().copied();
            in_touch.find(|&faces| {
                self.primitives.cross(faces, &between) || self.primitives.overlap(faces, &between)
            })
        })
    }

    /// The first two triangles that cross each other.
    fn crossing(&self, positions: &[DVec3]) -> Option<[u32; 2]> {
        let boxes = self.primitives.boxes(positions, &[], 0.0);
        let pairs = self.tree.overlapping_pairs(&boxes);
        pairs
            .into_iter()
            .map(|(a, b)| [a, b])
            .find(|&faces| self.primitives.cross(faces, positions))
    }
}
