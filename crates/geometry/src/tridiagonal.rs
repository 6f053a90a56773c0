//! Symmetric tridiagonal systems.

/// L D Lᵀ of a symmetric positive definite tridiagonal matrix (Golub and Van Loan 2013, algorithm 4.3.6).
pub(crate) struct Tridiagonal {
    pivots: Vec<f64>,
    /// The entries below the unit diagonal of L, one fewer than there are pivots.
    lower: Vec<f64>,
}

impl Tridiagonal {
    pub(crate) fn factor(
        diagonal: impl Iterator<Item = f64>,
        off_diagonal: impl Iterator<Item = f64>,
    ) -> Self {
        let mut pivots: Vec<_> = diagonal.collect();
        let mut lower: Vec<_> = off_diagonal.collect();
        for (k, entry) in lower.iter_mut().enumerate() {
            let coupling = *entry;
            *entry = coupling / pivots[k];
            pivots[k + 1] -= *entry * coupling;
        }
        Self { pivots, lower }
    }

    /// The solution x of L D Lᵀ x = b.
    pub(crate) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x = b.to_vec();
        for (k, lower) in self.lower.iter().enumerate() {
            x[k + 1] -= lower * x[k];
        }
        for (x, pivot) in x.iter_mut().zip(&self.pivots) {
            *x /= pivot;
        }
        for (k, lower) in self.lower.iter().enumerate().rev() {
            x[k] -= lower * x[k + 1];
        }
        x
    }
}
