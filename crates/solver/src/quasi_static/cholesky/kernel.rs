//! The dense kernels of a front.
//!
//! Matrices are stored by columns. The panel of a front has the columns eliminated in it: first, up to a multiple of
//! [`PADDING`], empty rows and the rows of the columns themselves, then the rows below, padded by zeros in turn. The
//! diagonal of a factorised panel holds the inverse of that of the factor. Above the diagonal lie numbers of no
//! meaning.

use pulp::Simd;

/// Rows are padded to multiples of this, so that no vector of any instruction set is left over.
pub(super) const PADDING: usize = 8;
/// Columns of the update computed together.
const TOGETHER: usize = 4;

/// The shape of a front, in scalars.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shape {
    /// Columns eliminated.
    pub(super) width: usize,
    /// Rows below them.
    pub(super) rows: usize,
}

impl Shape {
    /// Panel rows up to the end of those of the columns.
    pub(super) fn head(self) -> usize {
        self.width.next_multiple_of(PADDING)
    }

    /// The panel row of the first column.
    pub(super) fn offset(self) -> usize {
        self.head() - self.width
    }

    /// Rows below, padded: the distance of the columns of the update.
    pub(super) fn tail(self) -> usize {
        self.rows.next_multiple_of(TOGETHER).next_multiple_of(PADDING)
    }

    /// Panel rows: the distance of its columns.
    pub(super) fn height(self) -> usize {
        self.head() + self.tail()
    }

    /// Scalars of the panel.
    pub(super) fn panel(self) -> usize {
        self.height() * self.width
    }

    /// Scalars of the update.
    pub(super) fn update(self) -> usize {
        self.tail() * self.rows.next_multiple_of(TOGETHER)
    }
}

/// Factorises the panel in place, three columns at a time; false where it is not positive definite.
#[inline(always)]
pub(super) fn factorise_panel<S: Simd>(simd: S, panel: &mut [f64], shape: Shape) -> bool {
    let height = shape.height();
    for first in (0..shape.width).step_by(3) {
        let row = shape.offset() + first;
        let (done, rest) = panel.split_at_mut(first * height);
        let own = &mut rest[..3 * height];
        let from = row / S::F64_LANES;
        let done = Columns { scalars: done, height, from: 0 };
        done.subtract_from::<S, 3>(simd, row, from, own, height);
        let Some(corner) = Corner::factorise(own, height, row) else {
            return false;
        };
        corner.divide(simd, own, height, from);
        corner.store(own, height, row);
    }
    true
}

/// Columns, each `height` long; only the rows from `from` on count.
#[derive(Clone, Copy)]
struct Columns<'a> {
    scalars: &'a [f64],
    height: usize,
    from: usize,
}

impl Columns<'_> {
    /// Subtracts from V vectors, at `at`, of N columns of `target` those of the product of the columns with the rows
    /// from
    /// `row` on. The columns of `target` lie `distance` apart.
    #[inline(always)]
    fn subtract_product<S: Simd, const V: usize, const N: usize>(
        self,
        simd: S,
        row: usize,
        at: usize,
        target: &mut [f64],
        distance: usize,
    ) {
        let mut sums = [[simd.splat_f64s(0.0); V]; N];
        for column in self.scalars.chunks_exact(self.height) {
            let rows = &column[self.from..];
            let vectors = &S::as_simd_f64s(rows).0[at..at + V];
            let factors = &rows[row..row + N];
            for (sum, &factor) in sums.iter_mut().zip(factors) {
                let factor = simd.splat_f64s(factor);
                for v in 0..V {
                    sum[v] = simd.mul_add_e_f64s(vectors[v], factor, sum[v]);
                }
            }
        }
        for (column, sum) in target.chunks_exact_mut(distance).zip(sums) {
            let vectors = &mut S::as_mut_simd_f64s(column).0[at..at + V];
            for v in 0..V {
                vectors[v] = simd.sub_f64s(vectors[v], sum[v]);
            }
        }
    }

    /// Does so for all vectors from `first` on.
    #[inline(always)]
    fn subtract_from<S: Simd, const N: usize>(
        self,
        simd: S,
        row: usize,
        first: usize,
        target: &mut [f64],
        distance: usize,
    ) {
        let vectors = distance / S::F64_LANES;
        let mut at = first;
        while at + 2 <= vectors {
            self.subtract_product::<S, 2, N>(simd, row, at, target, distance);
            at += 2;
        }
        if at < vectors {
            self.subtract_product::<S, 1, N>(simd, row, at, target, distance);
        }
    }
}

/// The factor of a 3 × 3 block: what lies below its diagonal, and the inverse of that.
struct Corner {
    inverse: [f64; 3],
    l10: f64,
    l20: f64,
    l21: f64,
}

impl Corner {
    #[inline(always)]
    fn factorise(own: &[f64], height: usize, row: usize) -> Option<Self> {
        let at = |i: usize, j: usize| own[j * height + row + i];
        let d0 = at(0, 0);
        let i0 = 1.0 / d0.sqrt();
        let (l10, l20) = (at(1, 0) * i0, at(2, 0) * i0);
        let d1 = at(1, 1) - l10 * l10;
        let i1 = 1.0 / d1.sqrt();
        let l21 = (at(2, 1) - l20 * l10) * i1;
        let d2 = at(2, 2) - l20 * l20 - l21 * l21;
        let i2 = 1.0 / d2.sqrt();
        // NaN is not positive either.
        (d0 > 0.0 && d1 > 0.0 && d2 > 0.0).then_some(Self { inverse: [i0, i1, i2], l10, l20, l21 })
    }

    /// Divides the rows of the three columns by the transposed factor.
    #[inline(always)]
    fn divide<S: Simd>(&self, simd: S, own: &mut [f64], height: usize, from: usize) {
        let (first, rest) = own.split_at_mut(height);
        let (second, third) = rest.split_at_mut(height);
        let [first, second, third] =
            [first, second, third].map(|column| &mut S::as_mut_simd_f64s(column).0[from..]);
        let inverse = self.inverse.map(|i| simd.splat_f64s(i));
        let [l10, l20, l21] = [self.l10, self.l20, self.l21].map(|l| simd.splat_f64s(-l));
        for ((a, b), c) in first.iter_mut().zip(second).zip(third) {
            let x = simd.mul_f64s(*a, inverse[0]);
            let y = simd.mul_f64s(simd.mul_add_e_f64s(x, l10, *b), inverse[1]);
            let z = simd.mul_add_e_f64s(x, l20, *c);
            let z = simd.mul_f64s(simd.mul_add_e_f64s(y, l21, z), inverse[2]);
            (*a, *b, *c) = (x, y, z);
        }
    }

    #[inline(always)]
    fn store(&self, own: &mut [f64], height: usize, row: usize) {
        let [i0, i1, i2] = self.inverse;
        own[row..row + 3].copy_from_slice(&[i0, self.l10, self.l20]);
        own[height + row + 1..height + row + 3].copy_from_slice(&[i1, self.l21]);
        own[2 * height + row + 2] = i2;
    }
}

/// Subtracts from the lower half of `update` the product of the rows below the panel's columns with themselves.
#[inline(always)]
pub(super) fn subtract_product<S: Simd>(simd: S, panel: &[f64], update: &mut [f64], shape: Shape) {
    let tail = shape.tail();
    if tail == 0 {
        return;
    }
    let below = Columns { scalars: panel, height: shape.height(), from: shape.head() };
    for (index, columns) in update.chunks_exact_mut(TOGETHER * tail).enumerate() {
        let row = TOGETHER * index;
        below.subtract_from::<S, TOGETHER>(simd, row, row / S::F64_LANES, columns, tail);
    }
}

/// Solves with the panel: `own` starts with the right side of its columns after the offset and ends, below, with what
/// is to be subtracted from the right side of the rows below.
#[inline(always)]
pub(super) fn solve_forward<S: Simd>(simd: S, panel: &[f64], own: &mut [f64], shape: Shape) {
    for (index, column) in panel.chunks_exact(shape.height()).enumerate() {
        let row = shape.offset() + index;
        let x = own[row] * column[row];
        // Whole vectors, from the one that holds the next row on; what lies above is restored.
        let from = (row + 1) / S::F64_LANES;
        let start = from * S::F64_LANES;
        let mut above = [0.0; PADDING];
        let count = row + 1 - start;
        above[..count].copy_from_slice(&own[start..=row]);
        let factor = simd.splat_f64s(-x);
        let vectors = S::as_simd_f64s(column).0[from..].iter();
        let sums = S::as_mut_simd_f64s(own).0[from..].iter_mut();
        for (sum, &vector) in sums.zip(vectors) {
            *sum = simd.mul_add_e_f64s(vector, factor, *sum);
        }
        own[start..=row].copy_from_slice(&above[..count]);
        own[row] = x;
    }
}

/// Solves with the transposed panel: `own` holds the right side of its columns and, below, the solution of the rows.
#[inline(always)]
pub(super) fn solve_backward<S: Simd>(simd: S, panel: &[f64], own: &mut [f64], shape: Shape) {
    for (index, column) in panel.chunks_exact(shape.height()).enumerate().rev() {
        let row = shape.offset() + index;
        let from = (row + 1).next_multiple_of(S::F64_LANES);
        let mut sum = 0.0;
        for i in row + 1..from {
            sum += column[i] * own[i];
        }
        let vectors = S::as_simd_f64s(&column[from..]).0;
        let others = S::as_simd_f64s(&own[from..]).0;
        let mut sums = [simd.splat_f64s(0.0); 2];
        let (pairs, last) = vectors.as_chunks::<2>();
        let (other_pairs, other_last) = others.as_chunks::<2>();
        for (a, b) in pairs.iter().zip(other_pairs) {
            sums[0] = simd.mul_add_e_f64s(a[0], b[0], sums[0]);
            sums[1] = simd.mul_add_e_f64s(a[1], b[1], sums[1]);
        }
        for (&a, &b) in last.iter().zip(other_last) {
            sums[0] = simd.mul_add_e_f64s(a, b, sums[0]);
        }
        sum += simd.reduce_sum_f64s(simd.add_f64s(sums[0], sums[1]));
        own[row] = (own[row] - sum) * column[row];
    }
}
