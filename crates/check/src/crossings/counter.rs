//! Counts the passages of a sheet through itself, frame by frame.

use std::collections::{BTreeMap, BTreeSet};

use foldmotion_geometry::collide::Limits;
use foldmotion_pattern::Sheet;
use glam::DVec3;
use rayon::prelude::*;

use super::cell::{Cell, IntervalEnds, cells_of, piercing, piercing_terms, turn};
use super::clearance::Clearances;
use super::contact::{CellState, Contact, ContactInterval};
use super::evidence::CrossingEvidence;
use super::interval::{Found, Interval, MovedInterval, SheetCrossing};
use super::perturbation::offsets;
use super::system::EquationSystem;
use super::topology::Topology;

/// Features are in contact if they are within this share of τ of each other.
const CONTACT: f64 = 31.0 / 32.0;
/// The largest number of intervals whose evaluation is postponed.
const MOST_QUIET: usize = 16;
/// The number of cells below which starting another thread does not pay.
const CELLS_A_TASK: usize = 64;

/// Counts the passages of a sheet through itself, frame by frame.
#[derive(Debug)]
pub(crate) struct CrossingCounter {
    topology: Topology,
    /// The offset by which each vertex is moved, a length in each coordinate.
    offsets: Vec<DVec3>,
    /// The distance within which features are in contact, a length.
    reach: f64,
    limits: Limits,
    system: EquationSystem,
    clearances: Clearances,
    /// Contacts of vertices with facets and of edges with edges that last at the last frame.
    open: BTreeMap<Cell, Contact>,
    /// Contacts of vertices with edges that last at the last frame: the unknown number of turns, and the numbers of the
    /// contacts in whose equations it appears.
    open_turns: BTreeMap<Cell, (u32, Vec<u64>)>,
    contacts: u64,
    /// Intervals whose evaluation is postponed.
    quiet: Vec<MovedInterval>,
    /// The cells in which something passed during those intervals.
    passed: BTreeSet<Cell>,
}

impl CrossingCounter {
    pub(crate) fn new(sheet: &Sheet, limits: &Limits) -> Self {
        let reach = CONTACT * limits.tolerance;
        Self {
            topology: Topology::new(&sheet.faces, sheet.vertices.len()),
            offsets: offsets(sheet.vertices.len(), limits.tolerance),
            reach,
            limits: *limits,
            system: EquationSystem::new(),
            clearances: Clearances::default(),
            open: BTreeMap::new(),
            open_turns: BTreeMap::new(),
            contacts: 0,
            quiet: Vec::new(),
            passed: BTreeSet::new(),
        }
    }

    /// Accepts the first frame: both frames of the interval are the same.
    pub(crate) fn begin(&mut self, interval: &Interval<'_>) -> Found {
        let positions = self.moved(interval.positions[0]);
        let ends = IntervalEnds([&positions, &positions]);
        let states = self.observe(interval, ends);
        let mut unknowns = BTreeMap::new();
        for (&cell, state) in &states {
            if state.is_near && !matches!(cell, Cell::VertexEdge { .. }) {
                let unknown = self.system.new_unknown();
                unknowns.insert(cell, unknown);
                let mut contact = self.contact(interval.times[0]);
                contact.terms.push((unknown, 1));
                self.open.insert(cell, contact);
            }
        }
        let mut found = Found::default();
        for (edge, face) in self.edges_and_facets(interval.near) {
            let terms = piercing_terms(&self.topology, edge, face);
            if terms.iter().any(|&(cell, _)| self.is_lost(cell, interval)) {
                continue;
            }
            let Some(pierced) = piercing(&self.topology, edge, face, &positions) else {
                found.unsure.extend(self.pairs_of(edge, face).first());
                continue;
            };
            let known = terms.iter().filter_map(|(cell, sign)| Some((*unknowns.get(cell)?, *sign)));
            if self.system.add(&known.collect::<Vec<_>>(), pierced) {
                continue;
            }
            let evidence = CrossingEvidence::of_piercing(&self.topology, edge, face, &positions);
            found.crossings.push(SheetCrossing {
                pairs: self.pairs_of(edge, face),
                evidence,
                since: interval.times[0],
                passed: interval.times[0],
            });
        }
        found
    }

    /// Accepts the next frame.
    ///
    /// As long as everything that passes through something stays in contact, no equation is closed. Such intervals are
    /// postponed, provided that no earlier contact lasts, and are evaluated only once a contact ends in which something
    /// passed.
    pub(crate) fn advance(&mut self, interval: &Interval<'_>) -> Found {
        let positions = interval.positions.map(|positions| self.moved(positions));
        let states = self.observe(interval, IntervalEnds([&positions[0], &positions[1]]));
        let step = MovedInterval { times: interval.times, positions, states };
        if self.is_quiet(&step) && self.quiet.len() < MOST_QUIET {
            let passed = step.states.iter().filter(|(_, s)| !s.passages.is_empty());
            self.passed.extend(passed.map(|(cell, _)| *cell));
            if step.states.values().any(|state| state.is_near) {
                self.quiet.push(step);
            } else {
                self.quiet.clear();
            }
            return Found::default();
        }
        self.passed.clear();
        let mut found = Found::default();
        for step in std::mem::take(&mut self.quiet).into_iter().chain([step]) {
            self.process(step, &mut found);
        }
        found
    }

    /// Whether no contact that was evaluated lasts, and none ends in which something passed.
    fn is_quiet(&self, step: &MovedInterval) -> bool {
        let lasts = |cell: &Cell| step.states.get(cell).is_some_and(|state| state.is_near);
        let mut state = step.states.values();
        self.open.is_empty()
            && state.all(|state| !state.is_unsure && (state.passages.is_empty() || state.is_near))
            && self.passed.iter().all(lasts)
    }

    fn process(&mut self, mut step: MovedInterval, found: &mut Found) {
        let ends = IntervalEnds([&step.positions[0], &step.positions[1]]);
        self.time_contacts(&mut step.states, ends);
        let mut intervals = self.intervals(&step, found);
        self.add_turns(&step.states, &mut intervals);
        self.close(intervals, &step, found);
    }

    fn moved(&self, positions: &[DVec3]) -> Vec<DVec3> {
        let both = positions.iter().zip(&self.offsets);
        both.map(|(p, offset)| *p + *offset).collect()
    }

    /// Whether one of the pairs of triangles around a cell is excluded from the counts.
    fn is_lost(&self, cell: Cell, interval: &Interval<'_>) -> bool {
        cell.faces(&self.topology).any(|pair| (interval.is_lost)(pair))
    }

    /// Whether everything that can pass through something in a pair of triangles is counted.
    pub(crate) fn counts(&self, faces: [u32; 2], is_lost: &dyn Fn([u32; 2]) -> bool) -> bool {
        let is_beside = |cell: &Cell| matches!(cell, Cell::VertexEdge { .. });
        let mut through = cells_of(&self.topology, faces).into_iter().filter(|c| !is_beside(c));
        !through.any(|cell| cell.faces(&self.topology).any(is_lost))
    }

    /// The pairs of `face` with each triangle at an edge.
    fn pairs_of(&self, edge: u32, face: u32) -> Vec<[u32; 2]> {
        let around = self.topology.edge_faces[edge as usize].iter();
        around.map(|&f| [f.min(face), f.max(face)]).collect()
    }

    fn contact(&mut self, since: f64) -> Contact {
        self.contacts += 1;
        Contact::new(self.contacts, since)
    }

    /// The cells of the pairs with their passages and whether they are in contact at the end. Cells that are excluded,
    /// and those that stay farther apart than the reach, are left out.
    fn observe(
        &mut self,
        interval: &Interval<'_>,
        ends: IntervalEnds<'_>,
    ) -> BTreeMap<Cell, CellState> {
        let mut clearances = std::mem::take(&mut self.clearances);
        clearances.follow(&self.topology, interval.near, CELLS_A_TASK);
        let both = ends.0[0].iter().zip(ends.0[1]);
        let displacements: Vec<DVec3> = both.map(|(p, q)| *q - *p).collect();
        // Twice the reach covers the accuracy to which contact times are found.
        let far = 2.0 * self.reach + self.limits.margin;
        let cells = clearances.cells.par_iter().with_min_len(CELLS_A_TASK);
        let states: Vec<_> = cells
            .zip(&mut clearances.bounds)
            .filter_map(|(&cell, bound)| {
                *bound -= cell.approach(&self.topology, &displacements) + self.limits.margin;
                if *bound > far {
                    return None;
                }
                *bound = 0.0;
                let is_beside = matches!(cell, Cell::VertexEdge { .. });
                if !is_beside && self.is_lost(cell, interval) {
                    return None;
                }
                let state = CellState::new(cell, &self.topology, ends, self.reach);
                *bound = state.distance;
                Some((cell, state))
            })
            .collect();
        self.clearances = clearances;
        let mut states = states.into_iter().collect();
        self.mark_near_rims(&mut states);
        states
    }

    /// A vertex that is near an edge of a facet is near the facet, even if rounding says otherwise.
    fn mark_near_rims(&self, states: &mut BTreeMap<Cell, CellState>) {
        let near_edges = states.iter().filter_map(|(cell, state)| match cell {
            Cell::VertexEdge { vertex, edge } if state.is_near => Some((*vertex, *edge)),
            _ => None,
        });
        for (vertex, edge) in near_edges.collect::<Vec<_>>() {
            for (cell, _) in turn(&self.topology, vertex, edge) {
                if let Some(state) = states.get_mut(&cell) {
                    state.is_near = true;
                }
            }
        }
    }

    /// Finds the times at which the cells are in contact.
    fn time_contacts(&self, states: &mut BTreeMap<Cell, CellState>, ends: IntervalEnds<'_>) {
        let mut list: Vec<_> = states.iter_mut().collect();
        list.par_iter_mut().with_min_len(CELLS_A_TASK).for_each(|(cell, state)| {
            let pair = cell.moving(&self.topology, ends);
            state.time(&pair, self.reach, &self.limits);
        });
        self.mark_unsure_around(states);
    }

    /// If it is unknown when a vertex is in contact with an edge, the passages around them are unsure as well.
    fn mark_unsure_around(&self, states: &mut BTreeMap<Cell, CellState>) {
        let open = states.iter().filter_map(|(cell, state)| match cell {
            Cell::VertexEdge { vertex, edge } if state.is_unsure => Some((*vertex, *edge)),
            _ => None,
        });
        for (vertex, edge) in open.collect::<Vec<_>>() {
            for (cell, _) in turn(&self.topology, vertex, edge) {
                if let Some(state) = states.get_mut(&cell) {
                    state.is_unsure = true;
                }
            }
        }
    }

    /// The contacts of all cells of vertices with facets and edges with edges, with their passages.
    fn intervals(
        &mut self,
        step: &MovedInterval,
        found: &mut Found,
    ) -> BTreeMap<Cell, Vec<ContactInterval>> {
        let mut all = BTreeMap::new();
        let mut open = std::mem::take(&mut self.open);
        for (&cell, state) in &step.states {
            if matches!(cell, Cell::VertexEdge { .. }) {
                continue;
            }
            let earlier = open.remove(&cell);
            if state.is_unsure {
                found.unsure.extend(cell.faces(&self.topology).next());
                continue;
            }
            let rim = cell.rim(&self.topology);
            let times = state.all_times(rim.filter_map(|cell| step.states.get(&cell)));
            let intervals = self.intervals_of(&times, state, earlier, step);
            if !intervals.is_empty() {
                all.insert(cell, intervals);
            }
        }
        // Cells in contact that are no longer observed have been excluded from the counts.
        all
    }

    fn intervals_of(
        &mut self,
        times: &[[f64; 2]],
        state: &CellState,
        mut earlier: Option<Contact>,
        step: &MovedInterval,
    ) -> Vec<ContactInterval> {
        let mut intervals = Vec::with_capacity(times.len());
        for &[from, to] in times {
            let continued = if from == 0.0 { earlier.take() } else { None };
            let mut contact = continued.unwrap_or_else(|| self.contact(step.at(from)));
            let within = state.passages.iter();
            for passage in within.filter(|p| (from..=to).contains(&p.time())) {
                contact.sum += i64::from(passage.sign);
                contact.passed = Some(step.at(passage.time()));
            }
            intervals.push(ContactInterval {
                times: [from, to],
                is_open: to == 1.0 && state.is_near,
                contact,
            });
        }
        // A contact that lasted until the previous frame but is not seen at the beginning of this interval ended there.
        intervals.extend(earlier.map(|contact| ContactInterval {
            times: [0.0, 0.0],
            is_open: false,
            contact,
        }));
        intervals
    }

    /// Adds an unknown number of turns for every contact of a vertex with an edge.
    fn add_turns(
        &mut self,
        states: &BTreeMap<Cell, CellState>,
        intervals: &mut BTreeMap<Cell, Vec<ContactInterval>>,
    ) {
        let mut earlier = std::mem::take(&mut self.open_turns);
        for (&cell, state) in states {
            let Cell::VertexEdge { vertex, edge } = cell else {
                continue;
            };
            for &times in &state.times {
                let mut around = Vec::new();
                for (through, sign) in turn(&self.topology, vertex, edge) {
                    let mut list = intervals.get(&through).into_iter().flatten();
                    let met = list.find(|interval| interval.overlaps(times));
                    around.extend(met.map(|interval| (through, interval.contact.number, sign)));
                }
                let met: Vec<u64> = around.iter().map(|&(_, number, _)| number).collect();
                let before = earlier.remove(&cell).filter(|_| times[0] == 0.0);
                let unknown = match before {
                    Some((unknown, known)) if known == met => unknown,
                    _ => self.new_turn(intervals, &around),
                };
                if times[1] == 1.0 && state.is_near {
                    self.open_turns.insert(cell, (unknown, met));
                }
            }
        }
    }

    /// A new unknown number of turns, added to the equations of the contacts around.
    fn new_turn(
        &mut self,
        intervals: &mut BTreeMap<Cell, Vec<ContactInterval>>,
        around: &[(Cell, u64, i64)],
    ) -> u32 {
        let unknown = self.system.new_unknown();
        for &(cell, number, sign) in around {
            let list = intervals.get_mut(&cell).into_iter().flatten();
            for interval in list.filter(|interval| interval.contact.number == number) {
                interval.contact.terms.push((unknown, sign));
            }
        }
        unknown
    }

    /// Adds the equations of the contacts that have ended, and keeps the others open.
    fn close(
        &mut self,
        intervals: BTreeMap<Cell, Vec<ContactInterval>>,
        step: &MovedInterval,
        found: &mut Found,
    ) {
        let ends = IntervalEnds([&step.positions[0], &step.positions[1]]);
        for (cell, list) in intervals {
            for interval in list {
                if interval.is_open {
                    self.open.insert(cell, interval.contact);
                    continue;
                }
                let contact = interval.contact;
                if self.system.add(&contact.terms, -contact.sum) {
                    continue;
                }
                let evidence =
                    CrossingEvidence::of_passage(&self.topology, cell, ends, interval.times);
                let ended = step.at(interval.times[1]);
                found.crossings.push(SheetCrossing {
                    pairs: cell.faces(&self.topology).collect(),
                    evidence,
                    since: contact.since,
                    passed: contact.passed.unwrap_or(ended),
                });
            }
        }
    }

    /// Every edge and facet of the pairs that have no common vertex, once.
    fn edges_and_facets(&self, near: &[[u32; 2]]) -> BTreeSet<(u32, u32)> {
        let both = near.iter().flat_map(|&[f, g]| [(f, g), (g, f)]);
        both.flat_map(|(f, g)| self.topology.face_edges[f as usize].map(|edge| (edge, g)))
            .filter(|&(edge, face)| {
                let corners = self.topology.corners(face);
                let ends = self.topology.ends(edge);
                !ends.iter().any(|v| corners.contains(v))
            })
            .collect()
    }
}
