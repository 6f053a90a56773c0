//! The sparse stiffness matrix, in 3 × 3 blocks of nodes, and its Cholesky factorisation.
//!
//! The lower half is stored by columns; all three scalar columns of a node list the same rows. The symbolic analysis
//! (an approximate-minimum-degree ordering of the nodes, Amestoy, Davis, Duff 1996, and the elimination tree) is made
//! once per pattern and reused by every numeric factorisation. Factorisations run on one thread: bitwise the same
//! result on any number of them.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use glam::{DMat3, DVec3};

use crate::SolverError;

/// A symmetric matrix over nodes and its factor.
pub(super) struct StiffnessMatrix {
    nodes: usize,
    /// The blocks of node column j are `blocks[starts[j]..starts[j + 1]]`: their rows, rising from j itself.
    starts: Vec<u32>,
    blocks: Vec<u32>,
    /// The same pattern by scalars.
    columns: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    workspace: MemBuffer,
    right_side: Vec<f64>,
}

impl StiffnessMatrix {
    /// The zero matrix with room for the blocks of `pairs` of nodes (in any order, repeats allowed) and the diagonal.
    ///
    /// # Errors
    /// [`SolverError::Factorisation`] where the analysis needs more than the machine or 32-bit indices hold.
    pub(super) fn new(nodes: usize, pairs: &[[u32; 2]]) -> Result<Self, SolverError> {
        let (starts, blocks) = block_pattern(nodes, pairs);
        let entries = 9 * blocks.len();
        if u32::try_from(entries).is_err() {
            return Err(SolverError::Factorisation {
                nodes,
                reason: "more entries than 32-bit indices hold",
            });
        }
        let mut columns = vec![0u32];
        let mut rows = Vec::with_capacity(entries);
        for node in 0..nodes {
            let own = &blocks[starts[node] as usize..starts[node + 1] as usize];
            for _axis in 0..3 {
                rows.extend(own.iter().flat_map(|&b| [3 * b, 3 * b + 1, 3 * b + 2]));
                columns.push(rows.len() as u32);
            }
        }
        let symbolic = analyse(nodes, &starts, &blocks, &columns, &rows).map_err(|_error| {
            SolverError::Factorisation {
                nodes,
                reason: "the symbolic analysis ran out of memory",
            }
        })?;
        let scratch = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, faer::Spec::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        Ok(Self {
            nodes,
            values: vec![0.0; rows.len()],
            factor: vec![0.0; symbolic.len_val()],
            workspace: MemBuffer::new(scratch),
            right_side: vec![0.0; 3 * nodes],
            starts,
            blocks,
            columns,
            rows,
            symbolic,
        })
    }

    /// Whether the blocks of every pair have room.
    pub(super) fn holds(&self, pairs: impl IntoIterator<Item = [u32; 2]>) -> bool {
        pairs
            .into_iter()
            .all(|[a, b]| self.place(a.max(b), a.min(b)).is_some())
    }

    pub(super) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds the block of rows `i` and columns `j`; its mirror image is implied. Call once for i ≠ j.
    ///
    /// Precondition: the pattern has room for it.
    pub(super) fn add(&mut self, i: u32, j: u32, block: DMat3) {
        let (i, j, block) = if i >= j {
            (i, j, block)
        } else {
            (j, i, block.transpose())
        };
        let Some(place) = self.place(i, j) else {
            debug_assert!(false, "the pattern has no block ({i}, {j})");
            return;
        };
        let stride = 3 * (self.starts[j as usize + 1] - self.starts[j as usize]) as usize;
        for axis in 0..3 {
            let at = place + axis * stride;
            let column = block.col(axis);
            self.values[at] += column.x;
            self.values[at + 1] += column.y;
            self.values[at + 2] += column.z;
        }
    }

    /// Adds the symmetric matrix of an element, by blocks of its nodes.
    pub(super) fn add_element<const N: usize>(
        &mut self,
        nodes: &[u32; N],
        blocks: &[[DMat3; N]; N],
    ) {
        for (i, row) in blocks.iter().enumerate() {
            for (j, &block) in row.iter().enumerate().take(i + 1) {
                self.add(nodes[i], nodes[j], block);
            }
        }
    }

    /// Adds `amount` to every diagonal scalar.
    pub(super) fn shift(&mut self, amount: f64) {
        for node in 0..self.nodes as u32 {
            self.add(node, node, DMat3::from_diagonal(DVec3::splat(amount)));
        }
    }

    /// The mean of the diagonal scalars.
    pub(super) fn mean_diagonal(&self) -> f64 {
        let diagonal = |column: usize| {
            // The block of the node itself comes first in its column.
            self.values[self.columns[column] as usize + column % 3]
        };
        (0..3 * self.nodes).map(diagonal).sum::<f64>() / (3 * self.nodes) as f64
    }

    /// Factorises; false where the matrix is not positive definite.
    pub(super) fn factorise(&mut self) -> bool {
        let pattern = symbolic_view(self.nodes, &self.columns, &self.rows);
        let matrix = SparseColMatRef::new(pattern, &self.values[..]);
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.workspace),
                faer::Spec::default(),
            )
            .is_ok()
    }

    /// Overwrites `vectors` by the solution with them as the right side, from the last factorisation.
    pub(super) fn solve(&mut self, vectors: &mut [DVec3]) {
        for (scalars, vector) in self.right_side.chunks_exact_mut(3).zip(vectors.iter()) {
            scalars.copy_from_slice(&vector.to_array());
        }
        let size = self.right_side.len();
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut self.right_side, size, 1),
            Par::Seq,
            MemStack::new(&mut self.workspace),
        );
        for (scalars, vector) in self.right_side.chunks_exact(3).zip(vectors) {
            *vector = DVec3::from_slice(scalars);
        }
    }

    /// The place in `values` of the first scalar of block (i, j), i ≥ j.
    fn place(&self, i: u32, j: u32) -> Option<usize> {
        let start = self.starts[j as usize] as usize;
        let end = self.starts[j as usize + 1] as usize;
        let block = self.blocks[start..end].binary_search(&i).ok()?;
        Some(9 * start + 3 * block)
    }
}

/// The blocks of the lower half by columns: starts and rows, the diagonal included.
fn block_pattern(nodes: usize, pairs: &[[u32; 2]]) -> (Vec<u32>, Vec<u32>) {
    let lower = pairs.iter().map(|&[a, b]| (a.min(b), a.max(b)));
    let mut all: Vec<(u32, u32)> = (0..nodes as u32).map(|i| (i, i)).chain(lower).collect();
    all.sort_unstable();
    all.dedup();
    let mut starts = vec![0u32; nodes + 1];
    for &(column, _) in &all {
        starts[column as usize + 1] += 1;
    }
    for node in 0..nodes {
        starts[node + 1] += starts[node];
    }
    (starts, all.into_iter().map(|(_, row)| row).collect())
}

fn symbolic_view<'a>(
    nodes: usize,
    columns: &'a [u32],
    rows: &'a [u32],
) -> SymbolicSparseColMatRef<'a, u32> {
    SymbolicSparseColMatRef::new_checked(3 * nodes, 3 * nodes, columns, None, rows)
}

fn analyse(
    nodes: usize,
    starts: &[u32],
    blocks: &[u32],
    columns: &[u32],
    rows: &[u32],
) -> Result<SymbolicCholesky<u32>, faer::sparse::FaerError> {
    // Order the nodes, not the scalars: a ninth of the work, and the three scalars of a node stay together.
    let (mut forward, mut inverse) = (vec![0u32; nodes], vec![0u32; nodes]);
    let graph = SymbolicSparseColMatRef::new_checked(nodes, nodes, starts, None, blocks);
    let scratch = amd::order_maybe_unsorted_scratch::<u32>(nodes, blocks.len());
    amd::order_maybe_unsorted(
        &mut forward,
        &mut inverse,
        graph,
        amd::Control::default(),
        MemStack::new(&mut MemBuffer::new(scratch)),
    )?;
    let expand = |order: &[u32]| -> Vec<u32> {
        order
            .iter()
            .flat_map(|&node| [3 * node, 3 * node + 1, 3 * node + 2])
            .collect()
    };
    // An inverse expands to the inverse: scalar 3 i + c goes with node i.
    let (forward, inverse) = (expand(&forward), expand(&inverse));
    let order = PermRef::new_checked(&forward, &inverse, 3 * nodes);
    factorize_symbolic_cholesky(
        symbolic_view(nodes, columns, rows),
        Side::Lower,
        SymmetricOrdering::Custom(order),
        CholeskySymbolicParams {
            // Always by supernodes: with three scalars a node there are always some, and it was measured two to four
            // times faster than column by column from 500 to 14 000 scalars.
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_solves_the_system_it_was_made_from() {
        let nodes = 12;
        let pairs: Vec<[u32; 2]> = (0..11)
            .map(|i| [i + 1, i])
            .chain([[0, 7], [3, 9]])
            .collect();
        let mut matrix = StiffnessMatrix::new(nodes, &pairs).unwrap();
        let block = |i: u32, j: u32| {
            let x = f64::from(i * 7 + j * 3);
            DMat3::from_cols_array(&std::array::from_fn(|k| (x + k as f64).sin()))
        };
        let mut dense = vec![vec![DMat3::ZERO; nodes]; nodes];
        for &[i, j] in &pairs {
            matrix.add(i, j, block(i, j));
            dense[i as usize][j as usize] += block(i, j);
            dense[j as usize][i as usize] += block(i, j).transpose();
        }
        matrix.shift(9.0);
        for (i, row) in dense.iter_mut().enumerate() {
            row[i] += DMat3::IDENTITY * 9.0;
        }
        assert!((matrix.mean_diagonal() - 9.0).abs() < 1e-14);
        let right: Vec<DVec3> = (0..nodes)
            .map(|i| DVec3::new(i as f64, 1.0, -(i as f64)))
            .collect();
        let mut solution = right.clone();
        assert!(matrix.factorise());
        matrix.solve(&mut solution);
        for (row, expected) in dense.iter().zip(&right) {
            let product: DVec3 = row.iter().zip(&solution).map(|(&m, &x)| m * x).sum();
            assert!(product.distance(*expected) < 1e-11, "{product} {expected}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let mut matrix = StiffnessMatrix::new(3, &[[0, 1], [1, 2]]).unwrap();
        matrix.shift(1.0);
        matrix.add(1, 0, DMat3::IDENTITY * 2.0);
        assert!(!matrix.factorise());
    }

    #[test]
    fn only_pairs_of_the_pattern_have_room() {
        let matrix = StiffnessMatrix::new(3, &[[0, 1]]).unwrap();
        assert!(matrix.holds([[1, 0], [2, 2]]));
        assert!(!matrix.holds([[0, 2]]));
    }
}
