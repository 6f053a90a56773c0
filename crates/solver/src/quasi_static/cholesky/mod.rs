//! Sparse Cholesky factorisation in blocks of nodes, front by front.
//!
//! The multifrontal method (Duff and Reid 1983, "The multifrontal solution of indefinite sparse symmetric linear
//! equations"): the nodes of a front are eliminated from a small dense matrix, and what that leaves of the rows below
//! is added to the front that eliminates the first of them. Sums are taken in one order, on one thread.

#![expect(
    clippy::inline_always,
    reason = "a kernel is compiled for the machine's vectors only where all of it is inlined"
)]

mod fronts;
mod kernel;

use pulp::{Arch, Simd, WithSimd};

use self::fronts::Fronts;
use self::kernel::{Shape, factorise_panel, solve_backward, solve_forward, subtract_product};

/// The position of a block of the matrix: the index of its first scalar in the panel of its columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct BlockOffset {
    scalars: u32,
}

/// The factor of a matrix of one pattern, and the workspace to compute it.
pub(super) struct Cholesky {
    fronts: Fronts,
    shapes: Vec<Shape>,
    /// The panel of front f is `panels[panel_starts[f]..panel_starts[f + 1]]`.
    panel_starts: Vec<u32>,
    panels: Vec<f64>,
    /// For each row of each front, as in `fronts.rows`: the row of the parent's panel that it is added to.
    handed_to: Vec<u32>,
    /// The updates not yet taken up.
    pending: Vec<f64>,
    /// The right side of one front.
    own: Vec<f64>,
    arch: Arch,
}

impl Cholesky {
    /// Analyses the pattern: node column j has the rows `blocks[starts[j]..starts[j + 1]]`, j itself and greater ones.
    ///
    /// # Errors
    /// The reason, as a sentence, if the matrix is too large.
    pub(super) fn new(nodes: usize, starts: &[u32], blocks: &[u32]) -> Result<Self, &'static str> {
        let fronts = Fronts::new(nodes, starts, blocks)?;
        let shape = |f: usize| Shape { width: 3 * fronts.width(f), rows: 3 * fronts.rows(f).len() };
        let shapes: Vec<Shape> = (0..fronts.count()).map(shape).collect();
        let mut panel_starts = vec![0u32];
        let mut size = 0;
        for shape in &shapes {
            size += shape.panel();
            let end =
                u32::try_from(size).map_err(|_error| "more entries than 32-bit indices hold")?;
            panel_starts.push(end);
        }
        let tallest = shapes.iter().map(|shape| shape.height()).max();
        Ok(Self {
            panels: vec![0.0; size],
            handed_to: handed_to(&fronts, &shapes),
            pending: vec![0.0; most_pending(&fronts, &shapes)],
            own: vec![0.0; tallest.unwrap_or(0)],
            fronts,
            shapes,
            panel_starts,
            arch: Arch::new(),
        })
    }

    /// The rank of each node: its position in the order of elimination.
    pub(super) fn ranks(&self) -> &[u32] {
        &self.fronts.ranks
    }

    /// The offset of the block of a node column and row, both by ranks. Precondition: row ≥ column, in the pattern.
    pub(super) fn offset(&self, row: u32, column: u32) -> Option<BlockOffset> {
        let f = self.fronts.first.partition_point(|&first| first <= column) - 1;
        let shape = self.shapes[f];
        let inside = 3 * (column - self.fronts.first[f]) as usize;
        let panel_row = if row < self.fronts.first[f + 1] {
            shape.offset() + 3 * (row - self.fronts.first[f]) as usize
        } else {
            shape.head() + 3 * self.fronts.rows(f).binary_search(&row).ok()?
        };
        Some(BlockOffset { scalars: (inside * shape.height() + panel_row) as u32 })
    }

    /// Factorises the matrix with `shift` added to its diagonal; false where it is not positive definite.
    ///
    /// The blocks of the node column of rank j are `values[starts[j]..starts[j + 1]]`, at these `offsets`.
    pub(super) fn factorise(
        &mut self,
        starts: &[u32],
        offsets: &[BlockOffset],
        values: &[[f64; 9]],
        shift: f64,
    ) -> bool {
        self.arch.dispatch(Elimination {
            starts,
            offsets,
            values,
            shift,
            fronts: &self.fronts,
            shapes: &self.shapes,
            panel_starts: &self.panel_starts,
            panels: &mut self.panels,
            handed_to: &self.handed_to,
            pending: &mut self.pending,
        })
    }

    /// Overwrites `right` (by ranks) by the solution. Precondition: factorised.
    pub(super) fn solve(&mut self, right: &mut [f64]) {
        self.arch.dispatch(Solution {
            fronts: &self.fronts,
            shapes: &self.shapes,
            panel_starts: &self.panel_starts,
            panels: &self.panels,
            own: &mut self.own,
            right,
        });
    }
}

/// The rows of the parents' panels that the rows of each front are added to.
fn handed_to(fronts: &Fronts, shapes: &[Shape]) -> Vec<u32> {
    let mut all = Vec::with_capacity(fronts.rows.len());
    for f in 0..fronts.count() {
        let Some(parent) = fronts.parents[f] else {
            continue;
        };
        let parent = parent as usize;
        let (first, end) = (fronts.first[parent], fronts.first[parent + 1]);
        let below = fronts.rows(parent);
        let mut index = 0;
        for &row in fronts.rows(f) {
            if row < end {
                all.push((shapes[parent].offset() + 3 * (row - first) as usize) as u32);
            } else {
                while below[index] < row {
                    index += 1;
                }
                all.push((shapes[parent].head() + 3 * index) as u32);
            }
        }
    }
    all
}

/// The most scalars of updates that wait at one time.
fn most_pending(fronts: &Fronts, shapes: &[Shape]) -> usize {
    let (mut waiting, mut most) = (0, 0);
    let mut handed = vec![0; fronts.count()];
    for (f, shape) in shapes.iter().enumerate() {
        let update = shape.update();
        most = most.max(waiting + update);
        waiting = waiting + update - handed[f];
        if let Some(parent) = fronts.parents[f] {
            handed[parent as usize] += update;
        }
    }
    most
}

/// One numeric factorisation.
struct Elimination<'a> {
    starts: &'a [u32],
    offsets: &'a [BlockOffset],
    values: &'a [[f64; 9]],
    shift: f64,
    fronts: &'a Fronts,
    shapes: &'a [Shape],
    panel_starts: &'a [u32],
    panels: &'a mut [f64],
    handed_to: &'a [u32],
    pending: &'a mut [f64],
}

impl WithSimd for Elimination<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        // Fronts whose updates wait, with where they begin.
        let mut waiting: Vec<(usize, usize)> = Vec::new();
        let mut end = 0;
        for (f, &shape) in self.shapes.iter().enumerate() {
            let [from, to] = [f, f + 1].map(|f| self.panel_starts[f] as usize);
            let panel = &mut self.panels[from..to];
            let [first, last] = [f, f + 1].map(|f| self.fronts.first[f] as usize);
            let blocks = self.starts[first] as usize..self.starts[last] as usize;
            panel.fill(0.0);
            for (offset, block) in self.offsets[blocks.clone()].iter().zip(&self.values[blocks]) {
                for (column, scalars) in block.as_chunks::<3>().0.iter().enumerate() {
                    let at = offset.scalars as usize + column * shape.height();
                    panel[at..at + 3].copy_from_slice(scalars);
                }
            }
            add_shift(panel, shape, self.shift);
            let (before, free) = self.pending.split_at_mut(end);
            let update = &mut free[..shape.update()];
            update.fill(0.0);
            let is_child =
                |&&(child, _): &&(usize, usize)| self.fronts.parents[child] == Some(f as u32);
            let children = waiting.iter().rev().take_while(is_child).count();
            let begin = waiting.len() - children;
            for &(child, at) in &waiting[begin..] {
                let rows =
                    self.fronts.starts[child] as usize..self.fronts.starts[child + 1] as usize;
                let handed = &before[at..at + self.shapes[child].update()];
                take_up(panel, update, shape, handed, &self.handed_to[rows]);
            }
            if !factorise_panel(simd, panel, shape) {
                return false;
            }
            subtract_product(simd, panel, update, shape);
            let start = waiting.get(begin).map_or(end, |&(_, at)| at);
            waiting.truncate(begin);
            self.pending.copy_within(end..end + shape.update(), start);
            end = start + shape.update();
            waiting.push((f, start));
        }
        true
    }
}

#[inline(always)]
fn add_shift(panel: &mut [f64], shape: Shape, shift: f64) {
    if shift > 0.0 {
        for column in 0..shape.width {
            panel[column * shape.height() + shape.offset() + column] += shift;
        }
    }
}

/// Adds what a child hands up to the panel and the update of its parent.
#[inline(always)]
fn take_up(panel: &mut [f64], update: &mut [f64], shape: Shape, handed: &[f64], to: &[u32]) {
    let (head, tail) = (shape.head(), shape.tail());
    let distance = Shape { width: 0, rows: 3 * to.len() }.tail();
    for (j, &row) in to.iter().enumerate() {
        let row = row as usize;
        for axis in 0..3 {
            let from = &handed[(3 * j + axis) * distance..][..3 * to.len()];
            let (column, above) = if row < head {
                let at = (row - shape.offset() + axis) * shape.height();
                (&mut panel[at..at + shape.height()], 0)
            } else {
                let at = (row - head + axis) * tail;
                (&mut update[at..at + tail], head)
            };
            for (&row, scalars) in to[j..].iter().zip(from[3 * j..].as_chunks::<3>().0) {
                let at = row as usize - above;
                let target = &mut column[at..at + 3];
                target[0] += scalars[0];
                target[1] += scalars[1];
                target[2] += scalars[2];
            }
        }
    }
}

/// The solution of one system.
struct Solution<'a> {
    fronts: &'a Fronts,
    shapes: &'a [Shape],
    panel_starts: &'a [u32],
    panels: &'a [f64],
    own: &'a mut [f64],
    right: &'a mut [f64],
}

impl WithSimd for Solution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (f, &shape) in self.shapes.iter().enumerate() {
            let own = &mut self.own[..shape.height()];
            let columns = 3 * self.fronts.first[f] as usize;
            let right = &mut self.right[columns..columns + shape.width];
            own[shape.offset()..shape.head()].copy_from_slice(right);
            own[shape.head()..].fill(0.0);
            solve_forward(simd, panel(self.panels, self.panel_starts, f), own, shape);
            right.copy_from_slice(&own[shape.offset()..shape.head()]);
            for (&row, less) in
                self.fronts.rows(f).iter().zip(own[shape.head()..].as_chunks::<3>().0)
            {
                let target = &mut self.right[3 * row as usize..][..3];
                for axis in 0..3 {
                    target[axis] += less[axis];
                }
            }
        }
        for (f, &shape) in self.shapes.iter().enumerate().rev() {
            let own = &mut self.own[..shape.height()];
            let columns = 3 * self.fronts.first[f] as usize;
            own[shape.offset()..shape.head()]
                .copy_from_slice(&self.right[columns..columns + shape.width]);
            own[shape.head()..].fill(0.0);
            for (&row, target) in
                self.fronts.rows(f).iter().zip(own[shape.head()..].as_chunks_mut::<3>().0)
            {
                target.copy_from_slice(&self.right[3 * row as usize..][..3]);
            }
            solve_backward(simd, panel(self.panels, self.panel_starts, f), own, shape);
            self.right[columns..columns + shape.width]
                .copy_from_slice(&own[shape.offset()..shape.head()]);
        }
    }
}

#[inline(always)]
fn panel<'a>(panels: &'a [f64], starts: &[u32], f: usize) -> &'a [f64] {
    &panels[starts[f] as usize..starts[f + 1] as usize]
}
