//! Counts the passages of a sheet through itself, frame by frame.

use std::collections::{BTreeMap, BTreeSet};

use foldmotion_geometry::collide::Limits;
use foldmotion_pattern::Sheet;
use glam::DVec3;
use rayon::prelude::*;

use super::cell::{Cell, Ends, cells_of, piercing, piercing_terms, turn};
use super::clearance::Clearances;
use super::contact::{Contact, Stretch, Watched};
use super::interval::{Crossing, Found, Interval, Step};
use super::perturbation::offsets;
use super::system::System;
use super::topology::Topology;
use super::witness::Witness;

/// Contacts are those within this share of τ.
const CONTACT: f64 = 31.0 / 32.0;
/// The most intervals put off.
const MOST_QUIET: usize = 16;
/// Fewer cells than this are not worth a thread.
const CELLS_A_TASK: usize = 64;

/// Counts the passages of a sheet through itself, frame by frame.
#[derive(Debug)]
pub(crate) struct Crossings {
    topology: Topology,
    /// What the vertices are moved by.
    offsets: Vec<DVec3>,
    /// The distance within which features are in contact.
    reach: f64,
    limits: Limits,
    system: System,
    clearances: Clearances,
    /// Passings through whose contact lasts at the last frame.
    open: BTreeMap<Cell, Contact>,
    /// Passings by whose contact lasts: the unknown, and the contacts it stands in.
    open_turns: BTreeMap<Cell, (u32, Vec<u64>)>,
    contacts: u64,
    /// Intervals put off.
    quiet: Vec<Step>,
    /// What passed in them.
    passed: BTreeSet<Cell>,
}

impl Crossings {
    pub(crate) fn new(sheet: &Sheet, limits: &Limits) -> Self {
        let reach = CONTACT * limits.tolerance;
        Self {
            topology: Topology::new(&sheet.faces, sheet.vertices.len()),
            offsets: offsets(sheet.vertices.len(), limits.tolerance),
            reach,
            limits: *limits,
            system: System::new(),
            clearances: Clearances::default(),
            open: BTreeMap::new(),
            open_turns: BTreeMap::new(),
            contacts: 0,
            quiet: Vec::new(),
            passed: BTreeSet::new(),
        }
    }

    /// Takes in the first frame: the interval's two frames are the same.
    pub(crate) fn begin(&mut self, interval: &Interval<'_>) -> Found {
        let positions = self.moved(interval.positions[0]);
        let ends = Ends([&positions, &positions]);
        let watched = self.watch(interval, ends);
        let mut unknowns = BTreeMap::new();
        for (&cell, seen) in &watched {
            if seen.is_near && !matches!(cell, Cell::VertexEdge { .. }) {
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
            let known = terms
                .iter()
                .filter_map(|(cell, sign)| Some((*unknowns.get(cell)?, *sign)));
            if self.system.add(&known.collect::<Vec<_>>(), pierced) {
                continue;
            }
            let witness = Witness::of_piercing(&self.topology, edge, face, &positions);
            found.crossings.push(Crossing {
                pairs: self.pairs_of(edge, face),
                witness,
                since: interval.times[0],
                passed: interval.times[0],
            });
        }
        found
    }

    /// Takes in the next frame.
    ///
    /// Where all that passes through something stays in contact, all equations hold without a turn: such intervals are put
    /// off, as long as no earlier contact lasts, and only looked at once a contact ends in which something passed.
    pub(crate) fn advance(&mut self, interval: &Interval<'_>) -> Found {
        let positions = interval.positions.map(|positions| self.moved(positions));
        let watched = self.watch(interval, Ends([&positions[0], &positions[1]]));
        let step = Step {
            times: interval.times,
            positions,
            watched,
        };
        if self.is_quiet(&step) && self.quiet.len() < MOST_QUIET {
            let passed = step.watched.iter().filter(|(_, s)| !s.passings.is_empty());
            self.passed.extend(passed.map(|(cell, _)| *cell));
            if step.watched.values().any(|seen| seen.is_near) {
                self.quiet.push(step);
            } else {
                self.quiet.clear();
            }
            return Found::default();
        }
        self.passed.clear();
        let mut found = Found::default();
        for step in std::mem::take(&mut self.quiet).into_iter().chain([step]) {
            self.take_in(step, &mut found);
        }
        found
    }

    /// Whether no contact lasts that was looked at, and none ends in which something passed.
    fn is_quiet(&self, step: &Step) -> bool {
        let lasts = |cell: &Cell| step.watched.get(cell).is_some_and(|seen| seen.is_near);
        let mut seen = step.watched.values();
        self.open.is_empty()
            && seen.all(|seen| !seen.is_unsure && (seen.passings.is_empty() || seen.is_near))
            && self.passed.iter().all(lasts)
    }

    fn take_in(&mut self, mut step: Step, found: &mut Found) {
        let ends = Ends([&step.positions[0], &step.positions[1]]);
        self.time_contacts(&mut step.watched, ends);
        let mut stretches = self.stretches(&step, found);
        self.add_turns(&step.watched, &mut stretches);
        self.close(stretches, &step, found);
    }

    fn moved(&self, positions: &[DVec3]) -> Vec<DVec3> {
        let places = positions.iter().zip(&self.offsets);
        places.map(|(p, offset)| *p + *offset).collect()
    }

    /// Whether one of the pairs of triangles around a cell is not counted.
    fn is_lost(&self, cell: Cell, interval: &Interval<'_>) -> bool {
        cell.faces(&self.topology)
            .any(|pair| (interval.is_lost)(pair))
    }

    /// Whether all that can pass through something in a pair of triangles is counted.
    pub(crate) fn counts(&self, faces: [u32; 2], is_lost: &dyn Fn([u32; 2]) -> bool) -> bool {
        let is_by = |cell: &Cell| matches!(cell, Cell::VertexEdge { .. });
        let mut through = cells_of(&self.topology, faces)
            .into_iter()
            .filter(|c| !is_by(c));
        !through.any(|cell| cell.faces(&self.topology).any(is_lost))
    }

    /// The triangles at an edge, each with the one given.
    fn pairs_of(&self, edge: u32, face: u32) -> Vec<[u32; 2]> {
        let around = self.topology.edge_faces[edge as usize].iter();
        around.map(|&f| [f.min(face), f.max(face)]).collect()
    }

    fn contact(&mut self, since: f64) -> Contact {
        self.contacts += 1;
        Contact::new(self.contacts, since)
    }

    /// The cells of the pairs with their passages and whether they are in contact at the end; those lost are left out, and
    /// those that stay farther apart than the reach.
    fn watch(&mut self, interval: &Interval<'_>, ends: Ends<'_>) -> BTreeMap<Cell, Watched> {
        let mut clearances = std::mem::take(&mut self.clearances);
        clearances.follow(&self.topology, interval.near, CELLS_A_TASK);
        let both = ends.0[0].iter().zip(ends.0[1]);
        let ways: Vec<DVec3> = both.map(|(p, q)| *q - *p).collect();
        // Twice the reach covers to what share it is told.
        let far = 2.0 * self.reach + self.limits.margin;
        let cells = clearances.cells.par_iter().with_min_len(CELLS_A_TASK);
        let watched: Vec<_> = cells
            .zip(&mut clearances.bounds)
            .filter_map(|(&cell, bound)| {
                *bound -= cell.approach(&self.topology, &ways) + self.limits.margin;
                if *bound > far {
                    return None;
                }
                *bound = 0.0;
                let is_by = matches!(cell, Cell::VertexEdge { .. });
                if !is_by && self.is_lost(cell, interval) {
                    return None;
                }
                let seen = Watched::new(cell, &self.topology, ends, self.reach);
                *bound = seen.distance;
                Some((cell, seen))
            })
            .collect();
        self.clearances = clearances;
        let mut watched = watched.into_iter().collect();
        self.agree_with_rim(&mut watched);
        watched
    }

    /// What is near an edge of a facet is near the facet, also where rounding says otherwise.
    fn agree_with_rim(&self, watched: &mut BTreeMap<Cell, Watched>) {
        let near_edges = watched.iter().filter_map(|(cell, seen)| match cell {
            Cell::VertexEdge { vertex, edge } if seen.is_near => Some((*vertex, *edge)),
            _ => None,
        });
        for (vertex, edge) in near_edges.collect::<Vec<_>>() {
            for (cell, _) in turn(&self.topology, vertex, edge) {
                if let Some(seen) = watched.get_mut(&cell) {
                    seen.is_near = true;
                }
            }
        }
    }

    /// When the cells are in contact.
    fn time_contacts(&self, watched: &mut BTreeMap<Cell, Watched>, ends: Ends<'_>) {
        let mut list: Vec<_> = watched.iter_mut().collect();
        list.par_iter_mut()
            .with_min_len(CELLS_A_TASK)
            .for_each(|(cell, seen)| {
                let pair = cell.moving(&self.topology, ends);
                seen.time(&pair, self.reach, &self.limits);
            });
        self.doubt_around(watched);
    }

    /// Where it is open when something passes by, what passes through there is open too.
    fn doubt_around(&self, watched: &mut BTreeMap<Cell, Watched>) {
        let open = watched.iter().filter_map(|(cell, seen)| match cell {
            Cell::VertexEdge { vertex, edge } if seen.is_unsure => Some((*vertex, *edge)),
            _ => None,
        });
        for (vertex, edge) in open.collect::<Vec<_>>() {
            for (cell, _) in turn(&self.topology, vertex, edge) {
                if let Some(seen) = watched.get_mut(&cell) {
                    seen.is_unsure = true;
                }
            }
        }
    }

    /// The stretches of contact of all cells of passing through, with their passages.
    fn stretches(&mut self, step: &Step, found: &mut Found) -> BTreeMap<Cell, Vec<Stretch>> {
        let mut all = BTreeMap::new();
        let mut open = std::mem::take(&mut self.open);
        for (&cell, seen) in &step.watched {
            if matches!(cell, Cell::VertexEdge { .. }) {
                continue;
            }
            let earlier = open.remove(&cell);
            if seen.is_unsure {
                found.unsure.extend(cell.faces(&self.topology).next());
                continue;
            }
            let rim = cell.rim(&self.topology);
            let times = seen.all_times(rim.filter_map(|cell| step.watched.get(&cell)));
            let stretches = self.stretches_of(&times, seen, earlier, step);
            if !stretches.is_empty() {
                all.insert(cell, stretches);
            }
        }
        // What is in contact but not watched any more was lost: it is not counted.
        all
    }

    fn stretches_of(
        &mut self,
        times: &[[f64; 2]],
        seen: &Watched,
        mut earlier: Option<Contact>,
        step: &Step,
    ) -> Vec<Stretch> {
        let mut stretches = Vec::with_capacity(times.len());
        for &[from, to] in times {
            let continued = if from == 0.0 { earlier.take() } else { None };
            let mut contact = continued.unwrap_or_else(|| self.contact(step.at(from)));
            let within = seen.passings.iter();
            for passing in within.filter(|p| (from..=to).contains(&p.time())) {
                contact.sum += i64::from(passing.sign);
                contact.passed = Some(step.at(passing.time()));
            }
            stretches.push(Stretch {
                times: [from, to],
                is_open: to == 1.0 && seen.is_near,
                contact,
            });
        }
        // A contact that lasted to the frame before and is not seen at its beginning ended there.
        stretches.extend(earlier.map(|contact| Stretch {
            times: [0.0, 0.0],
            is_open: false,
            contact,
        }));
        stretches
    }

    /// Lets every vertex that passes by an edge turn around it.
    fn add_turns(
        &mut self,
        watched: &BTreeMap<Cell, Watched>,
        stretches: &mut BTreeMap<Cell, Vec<Stretch>>,
    ) {
        let mut earlier = std::mem::take(&mut self.open_turns);
        for (&cell, seen) in watched {
            let Cell::VertexEdge { vertex, edge } = cell else {
                continue;
            };
            for &times in &seen.times {
                let mut around = Vec::new();
                for (through, sign) in turn(&self.topology, vertex, edge) {
                    let mut list = stretches.get(&through).into_iter().flatten();
                    let met = list.find(|stretch| stretch.overlaps(times));
                    around.extend(met.map(|stretch| (through, stretch.contact.number, sign)));
                }
                let met: Vec<u64> = around.iter().map(|&(_, number, _)| number).collect();
                let before = earlier.remove(&cell).filter(|_| times[0] == 0.0);
                let unknown = match before {
                    Some((unknown, known)) if known == met => unknown,
                    _ => self.new_turn(stretches, &around),
                };
                if times[1] == 1.0 && seen.is_near {
                    self.open_turns.insert(cell, (unknown, met));
                }
            }
        }
    }

    /// An unknown number of turns, which stands in the contacts around.
    fn new_turn(
        &mut self,
        stretches: &mut BTreeMap<Cell, Vec<Stretch>>,
        around: &[(Cell, u64, i64)],
    ) -> u32 {
        let unknown = self.system.new_unknown();
        for &(cell, number, sign) in around {
            let list = stretches.get_mut(&cell).into_iter().flatten();
            for stretch in list.filter(|stretch| stretch.contact.number == number) {
                stretch.contact.terms.push((unknown, sign));
            }
        }
        unknown
    }

    /// Balances what has ended and keeps the rest.
    fn close(&mut self, stretches: BTreeMap<Cell, Vec<Stretch>>, step: &Step, found: &mut Found) {
        let ends = Ends([&step.positions[0], &step.positions[1]]);
        for (cell, list) in stretches {
            for stretch in list {
                if stretch.is_open {
                    self.open.insert(cell, stretch.contact);
                    continue;
                }
                let contact = stretch.contact;
                if self.system.add(&contact.terms, -contact.sum) {
                    continue;
                }
                let witness = Witness::of_passing(&self.topology, cell, ends, stretch.times);
                let ended = step.at(stretch.times[1]);
                found.crossings.push(Crossing {
                    pairs: cell.faces(&self.topology).collect(),
                    witness,
                    since: contact.since,
                    passed: contact.passed.unwrap_or(ended),
                });
            }
        }
    }

    /// Every edge and facet without a common vertex of the pairs, once.
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
