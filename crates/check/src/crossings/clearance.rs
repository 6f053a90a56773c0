//! Lower bounds of the distances of cells, so that simplices that are far apart and move little are not measured again.

use glam::DVec3;

use super::{
    cell::{Cell, cells_of},
    topology::Topology,
};
use rayon::prelude::*;

/// The cells of the current pairs, each with a lower bound of the distance of its simplices at the last frame.
#[derive(Debug, Default)]
pub(super) struct Clearances {
    near: Vec<[u32; 2]>,
    /// The cells in increasing order, each once.
    pub(super) cells: Vec<Cell>,
    /// The lower bound for each cell, a length; 0 if nothing is known.
    pub(super) bounds: Vec<f64>,
}

impl Clearances {
    /// Replaces the pairs by those of the next interval, keeping what is known about cells that remain.
    pub(super) fn follow(&mut self, topology: &Topology, near: &[[u32; 2]], cells_a_task: usize) {
        if self.near == near {
            return;
        }
        let pairs = near.par_iter().with_min_len(cells_a_task);
        let mut cells: Vec<Cell> =
            pairs.flat_map_iter(|&faces| cells_of(topology, faces)).collect();
        cells.par_sort_unstable();
        cells.dedup();
        let mut known = self.cells.iter().zip(&self.bounds).peekable();
        let bound = |cell: &Cell| {
            while known.next_if(|(earlier, _)| *earlier < cell).is_some() {}
            let same = known.next_if(|(earlier, _)| *earlier == cell);
            same.map_or(0.0, |(_, bound)| *bound)
        };
        self.bounds = cells.iter().map(bound).collect();
        self.cells = cells;
        near.clone_into(&mut self.near);
    }
}

impl Cell {
    /// A bound of how much nearer the simplices may come to each other while each vertex moves by its displacement.
    pub(super) fn approach(self, topology: &Topology, displacements: &[DVec3]) -> f64 {
        let [a, b] = self.corners(topology);
        let squared =
            |u: u32, v: u32| displacements[u as usize].distance_squared(displacements[v as usize]);
        let pairs = a.iter().flat_map(|&u| b.iter().map(move |&v| (u, v)));
        let greatest = pairs.map(|(u, v)| squared(u, v)).fold(0.0, f64::max);
        greatest.sqrt()
    }
}
