//! The sparse stiffness matrix, in 3 × 3 blocks of nodes, and its factorisation.
//!
//! The lower half is stored by columns in the order of elimination. The symbolic analysis is made once per pattern and
//! reused by every numeric factorisation. Factorisations run on one thread: bitwise the same result on any number of
//! them.

use glam::{DMat3, DVec3};

use super::cholesky::{BlockOffset, Cholesky};
use crate::SolverError;

/// A symmetric matrix over nodes and its factor.
pub(super) struct StiffnessMatrix {
    /// The blocks of the node column of rank j are `starts[j]..starts[j + 1]`: their rows by rank, rising from j
    /// itself.
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// Each block by columns.
    values: Vec<[f64; 9]>,
    /// The values to go back to.
    kept: Vec<[f64; 9]>,
    offsets: Vec<BlockOffset>,
    cholesky: Cholesky,
    right_side: Vec<f64>,
}

/// The positions of the blocks of an element of N nodes in a matrix.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElementBlocks<const N: usize> {
    /// The nodes of the element in the order of elimination.
    order: [u8; N],
    /// The block of the i-th and the j-th of them, i ≥ j.
    blocks: [[u32; N]; N],
}

impl StiffnessMatrix {
    /// The zero matrix with room for the blocks of `pairs` of nodes (in any order, repeats allowed) and the diagonal.
    ///
    /// # Errors
    /// [`SolverError::Factorisation`] where the analysis needs more than the machine or 32-bit indices hold.
    pub(super) fn new(nodes: usize, pairs: &[[u32; 2]]) -> Result<Self, SolverError> {
        let (starts, rows) = block_pattern(nodes, pairs.iter().copied());
        let cholesky = Cholesky::new(nodes, &starts, &rows)
            .map_err(|reason| SolverError::Factorisation { nodes, reason })?;
        let ranks = cholesky.ranks();
        let ranked = pairs.iter().map(|pair| pair.map(|node| ranks[node as usize]));
        let (starts, rows) = block_pattern(nodes, ranked);
        let columns = (0..nodes).flat_map(|column| {
            let own = &rows[starts[column] as usize..starts[column + 1] as usize];
            own.iter().map(move |&row| (row, column as u32))
        });
        let offsets: Vec<BlockOffset> =
            columns.filter_map(|(row, column)| cholesky.offset(row, column)).collect();
        Ok(Self {
            values: vec![[0.0; 9]; rows.len()],
            kept: Vec::new(),
            right_side: vec![0.0; 3 * nodes],
            starts,
            rows,
            offsets,
            cholesky,
        })
    }

    pub(super) fn clear(&mut self) {
        self.values.fill([0.0; 9]);
    }

    /// Keeps the values, to go back to them.
    pub(super) fn keep(&mut self) {
        self.kept.clone_from(&self.values);
    }

    /// Goes back to the values that were kept.
    pub(super) fn restore(&mut self) {
        self.values.clone_from(&self.kept);
    }

    /// The positions of the blocks of an element; `None` if the pattern has no room for one.
    pub(super) fn element<const N: usize>(&self, nodes: &[u32; N]) -> Option<ElementBlocks<N>> {
        let ranks = self.ranks(*nodes);
        let mut order: [u8; N] = std::array::from_fn(|i| i as u8);
        order.sort_unstable_by_key(|&i| ranks[i as usize]);
        let mut blocks = [[0; N]; N];
        for (i, row) in blocks.iter_mut().enumerate() {
            for (j, block) in row.iter_mut().enumerate().take(i + 1) {
                let [row, column] = [i, j].map(|k| ranks[order[k] as usize]);
                *block = self.block(row, column)?;
            }
        }
        Some(ElementBlocks { order, blocks })
    }

    /// Adds the symmetric matrix of an element, by blocks of its nodes.
    pub(super) fn add<const N: usize>(
        &mut self,
        element: &ElementBlocks<N>,
        blocks: &[[DMat3; N]; N],
    ) {
        for (i, row) in element.blocks.iter().enumerate() {
            for (j, &index) in row.iter().enumerate().take(i + 1) {
                let block = &blocks[element.order[i] as usize][element.order[j] as usize];
                for (sum, scalar) in
                    self.values[index as usize].iter_mut().zip(block.to_cols_array())
                {
                    *sum += scalar;
                }
            }
        }
    }

    /// The mean of the diagonal scalars.
    pub(super) fn mean_diagonal(&self) -> f64 {
        // The block of the node itself comes first in its column.
        let trace = |start: &u32| {
            let block = &self.values[*start as usize];
            block[0] + block[4] + block[8]
        };
        let nodes = self.starts.len() - 1;
        self.starts[..nodes].iter().map(trace).sum::<f64>() / (3 * nodes) as f64
    }

    /// Factorises the matrix with `shift` added to every diagonal scalar; false where it is not positive definite.
    pub(super) fn factorise(&mut self, shift: f64) -> bool {
        self.cholesky.factorise(&self.starts, &self.offsets, &self.values, shift)
    }

    /// Overwrites `vectors` by the solution with them as the right side, from the last factorisation.
    pub(super) fn solve(&mut self, vectors: &mut [DVec3]) {
        let ranks = self.cholesky.ranks();
        for (&rank, vector) in ranks.iter().zip(vectors.iter()) {
            self.right_side[3 * rank as usize..][..3].copy_from_slice(&vector.to_array());
        }
        self.cholesky.solve(&mut self.right_side);
        for (&rank, vector) in self.cholesky.ranks().iter().zip(vectors) {
            *vector = DVec3::from_slice(&self.right_side[3 * rank as usize..]);
        }
    }

    fn ranks<const N: usize>(&self, nodes: [u32; N]) -> [u32; N] {
        let ranks = self.cholesky.ranks();
        nodes.map(|node| ranks[node as usize])
    }

    /// The block of a row and a column by rank, row ≥ column.
    fn block(&self, row: u32, column: u32) -> Option<u32> {
        let start = self.starts[column as usize];
        let end = self.starts[column as usize + 1];
        let own = &self.rows[start as usize..end as usize];
        Some(start + own.binary_search(&row).ok()? as u32)
    }
}

/// The blocks of the lower half by columns: starts and rows, the diagonal included.
fn block_pattern(nodes: usize, pairs: impl Iterator<Item = [u32; 2]>) -> (Vec<u32>, Vec<u32>) {
    let lower = pairs.map(|[a, b]| (a.min(b), a.max(b)));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds a block of two nodes and its mirror image.
    fn add(matrix: &mut StiffnessMatrix, nodes: [u32; 2], block: DMat3) {
        let element = matrix.element(&nodes).unwrap();
        let zero = DMat3::ZERO;
        matrix.add(&element, &[[zero, block], [block.transpose(), zero]]);
    }

    #[test]
    fn a_solution_solves_the_system_it_was_made_from() {
        let nodes = 12;
        let pairs: Vec<[u32; 2]> = (0..11).map(|i| [i + 1, i]).chain([[0, 7], [3, 9]]).collect();
        let mut matrix = StiffnessMatrix::new(nodes, &pairs).unwrap();
        let block = |i: u32, j: u32| {
            let x = f64::from(i * 7 + j * 3);
            DMat3::from_cols_array(&std::array::from_fn(|k| (x + k as f64).sin()))
        };
        let mut dense = vec![vec![DMat3::ZERO; nodes]; nodes];
        for &[i, j] in &pairs {
            add(&mut matrix, [i, j], block(i, j));
            dense[i as usize][j as usize] += block(i, j);
            dense[j as usize][i as usize] += block(i, j).transpose();
        }
        for (i, row) in dense.iter_mut().enumerate() {
            row[i] += DMat3::IDENTITY * 9.0;
        }
        let right: Vec<DVec3> =
            (0..nodes).map(|i| DVec3::new(i as f64, 1.0, -(i as f64))).collect();
        let mut solution = right.clone();
        assert!(matrix.factorise(9.0));
        matrix.solve(&mut solution);
        for (row, expected) in dense.iter().zip(&right) {
            let product: DVec3 = row.iter().zip(&solution).map(|(&m, &x)| m * x).sum();
            assert!(product.distance(*expected) < 1e-11, "{product} {expected}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let mut matrix = StiffnessMatrix::new(3, &[[0, 1], [1, 2]]).unwrap();
        add(&mut matrix, [1, 0], DMat3::IDENTITY * 2.0);
        assert!(!matrix.factorise(1.0));
        assert!(matrix.factorise(2.1));
    }

    #[test]
    fn only_pairs_of_the_pattern_have_room() {
        let matrix = StiffnessMatrix::new(3, &[[0, 1]]).unwrap();
        assert!(matrix.element(&[1, 0]).is_some());
        assert!(matrix.element(&[2]).is_some());
        assert!(matrix.element(&[0, 2]).is_none());
    }
}
