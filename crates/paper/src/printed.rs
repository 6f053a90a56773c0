//! The numbers that the paper prints in tables 1 and 2.

/// A row of table 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Table1 {
    pub(super) model: &'static str,
    pub(super) rows: usize,
    pub(super) columns: usize,
    /// |R_max|, the largest residual.
    pub(super) max_residual: f64,
    /// |R_ave|, the mean residual.
    pub(super) mean_residual: f64,
    /// T, in seconds.
    pub(super) seconds: f64,
}

const fn row(
    model: &'static str,
    [rows, columns]: [usize; 2],
    [max_residual, mean_residual]: [f64; 2],
    seconds: f64,
) -> Table1 {
    Table1 { model, rows, columns, max_residual, mean_residual, seconds }
}

/// Table 1, in its order.
pub(super) const TABLE_1: [Table1; 9] = [
    row("shelter", [7, 5], [2.62096e-14, 8.61766e-15], 0.010),
    row("chair", [9, 4], [1.95472e-14, 9.99077e-15], 0.033),
    row("rolling-paper", [12, 4], [7.28233e-14, 2.64116e-14], 0.088),
    row("fermat-spiral", [100, 2], [2.73695e-11, 3.98563e-12], 39.268),
    row("omega", [35, 5], [5.03413e-13, 1.56708e-13], 1.475),
    row("mushroom", [14, 3], [1.06474e-13, 2.58246e-14], 0.208),
    row("whale", [20, 3], [1.40942e-12, 2.89229e-13], 0.351),
    row("airfoil", [26, 7], [6.06483e-13, 1.00295e-13], 0.534),
    row("bunny", [100, 5], [7.24736e-11, 9.98287e-12], 56.024),
];

/// A row of table 2: the figure, Nr and Nc in E, T, and both S and SII.
#[derive(Debug, Clone, Copy)]
pub(super) struct Table2 {
    pub(super) model: &'static str,
    pub(super) figure: &'static str,
    pub(super) rows: usize,
    pub(super) columns: [usize; 3],
}

const fn counts(
    model: &'static str,
    figure: &'static str,
    rows: usize,
    columns: [usize; 3],
) -> Table2 {
    Table2 { model, figure, rows, columns }
}

/// Table 2, in its order.
pub(super) const TABLE_2: [Table2; 4] = [
    counts("chair", "7a", 9, [4, 6, 2]),
    counts("omega", "7b", 35, [5, 6, 4]),
    counts("mushroom", "8a", 14, [3, 5, 2]),
    counts("bunny", "8b", 100, [5, 8, 3]),
];
