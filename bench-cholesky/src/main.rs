//! Times our multifrontal Cholesky factorisation and faer's sparse one on the same matrices.
//!
//! The pattern is that of sheets of units: 3 × 3 blocks for the nodes of each bar and of each hinge. The values are made
//! up, positive definite by diagonal dominance: they do not change the amount of work. Both run on one thread, both order
//! by approximate minimum degree, and the symbolic analysis is not timed, since the engine makes it once per pattern.

use std::time::Instant;

use faer::Side;
use faer::linalg::solvers::SolveCore as _;
use faer::prelude::Mat;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, Triplet};
use foldmotion_pattern::{Case, Sheet, Unit, UnitSheet};
use foldmotion_solver::SolverError;
use glam::{DMat3, DVec3};

use stiffness_matrix::StiffnessMatrix;

// The factorisation is private to the solver: its sources are compiled here a second time.
#[path = "../../crates/solver/src/quasi_static/cholesky/mod.rs"]
#[allow(dead_code)]
mod cholesky;
#[path = "../../crates/solver/src/quasi_static/stiffness_matrix.rs"]
#[allow(dead_code)]
mod stiffness_matrix;

/// Timed repetitions of each factorisation and solution; the median counts.
const REPEATS: usize = 21;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "| sheet | nodes | blocks | ours, ms | faer, ms | ratio | solve ours, ms | solve faer, ms | largest difference |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for (rows, columns) in [(7, 5), (35, 4), (100, 3), (500, 2), (40, 40)] {
        compare(rows, columns)?;
    }
    Ok(())
}

fn compare(rows: usize, columns: usize) -> Result<(), Box<dyn std::error::Error>> {
    let unit = Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None)?;
    let sheet = UnitSheet::new(unit, rows, columns)?.sheet;
    let nodes = sheet.vertices.len();
    let pairs = pairs(&sheet);
    let mut ours = StiffnessMatrix::new(nodes, &pairs)?;
    fill(&mut ours, nodes, &pairs);
    let theirs =
        SparseColMat::try_new_from_triplets(3 * nodes, 3 * nodes, &triplets(nodes, &pairs))?;
    let symbolic = SymbolicLlt::try_new(theirs.symbolic(), Side::Lower)?;
    let numeric = || Llt::try_new_with_symbolic(symbolic.clone(), theirs.as_ref(), Side::Lower);

    let own_factor = median(|| assert!(ours.factorise(0.0)));
    let faer_factor = median(|| drop(numeric()));
    let right: Vec<DVec3> = (0..nodes).map(|i| DVec3::new(i as f64, 1.0, -0.5)).collect();
    let mut solution = right.clone();
    let own_solve = median(|| {
        solution.copy_from_slice(&right);
        ours.solve(&mut solution);
    });
    let llt = numeric().map_err(|error| format!("{error:?}"))?;
    let mut other = Mat::<f64>::zeros(3 * nodes, 1);
    let faer_solve = median(|| {
        for (i, vector) in right.iter().enumerate() {
            for axis in 0..3 {
                other[(3 * i + axis, 0)] = vector[axis];
            }
        }
        llt.solve_in_place_with_conj(faer::Conj::No, other.as_mut());
    });
    let difference = (0..nodes)
        .flat_map(|i| (0..3).map(move |axis| (i, axis)))
        .map(|(i, axis)| (solution[i][axis] - other[(3 * i + axis, 0)]).abs())
        .fold(0.0, f64::max);
    println!(
        "| {rows} × {columns} | {nodes} | {} | {own_factor:.3} | {faer_factor:.3} | {:.2} | {own_solve:.3} | {faer_solve:.3} | {difference:.0e} |",
        pairs.len() + nodes,
        faer_factor / own_factor,
    );
    Ok(())
}

/// The pairs of nodes that a bar or a hinge couples, each once.
fn pairs(sheet: &Sheet) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for edge in &sheet.edges {
        let mut nodes: Vec<u32> =
            edge.faces.iter().flatten().flat_map(|&f| sheet.faces[f as usize]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        for (k, &a) in nodes.iter().enumerate() {
            pairs.extend(nodes[..k].iter().map(|&b| [a, b]));
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// A block off the diagonal, its scalars below 1.
fn block([a, b]: [u32; 2]) -> DMat3 {
    let x = f64::from(a * 7 + b * 3);
    DMat3::from_cols_array(&std::array::from_fn(|k| 0.5 * (x + k as f64).sin()))
}

/// More than the sum of the absolute values of a row off the diagonal: no node has as many as 50 neighbours.
const DIAGONAL: f64 = 100.0;

fn fill(matrix: &mut StiffnessMatrix, nodes: usize, pairs: &[[u32; 2]]) {
    for node in 0..nodes as u32 {
        if let Some(places) = matrix.element(&[node]) {
            matrix.add(&places, &[[DMat3::IDENTITY * DIAGONAL]]);
        }
    }
    for &pair in pairs {
        if let Some(places) = matrix.element(&pair) {
            let (block, zero) = (block(pair), DMat3::ZERO);
            matrix.add(&places, &[[zero, block], [block.transpose(), zero]]);
        }
    }
}

/// The lower half of the same matrix.
fn triplets(nodes: usize, pairs: &[[u32; 2]]) -> Vec<Triplet<usize, usize, f64>> {
    let diagonal = (0..3 * nodes).map(|i| Triplet::new(i, i, DIAGONAL));
    let below = pairs.iter().flat_map(|&pair| {
        // The first node of a pair is the greater one.
        let (block, [a, b]) = (block(pair), pair.map(|node| 3 * node as usize));
        (0..9).map(move |k| Triplet::new(a + k % 3, b + k / 3, block.col(k / 3)[k % 3]))
    });
    diagonal.chain(below).collect()
}

/// The median time of [`REPEATS`] runs, milliseconds.
fn median(mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..REPEATS)
        .map(|_| {
            let start = Instant::now();
            run();
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[REPEATS / 2]
}
