//! Eigenvalues and eigenvectors of small symmetric matrices by Jacobi rotations.

/// The largest number of sweeps; a matrix of four rows takes six.
const SWEEPS: usize = 64;

/// Diagonalises `a`, a symmetric matrix, and returns the rotation that does so: its column i is the eigenvector of the
/// eigenvalue left in `a[i][i]`.
pub(crate) fn diagonalise<const N: usize>(a: &mut [[f64; N]; N]) -> [[f64; N]; N] {
    let mut vectors = [[0.0; N]; N];
    for (i, row) in vectors.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for _sweep in 0..SWEEPS {
        let off: f64 =
            (0..N).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| a[i][j].abs()).sum();
        let diagonal: f64 = (0..N).map(|i| a[i][i].abs()).sum();
        if off <= f64::EPSILON * 1e-3 * diagonal {
            break;
        }
        for p in 0..N {
            for q in p + 1..N {
                rotate(a, &mut vectors, p, q);
            }
        }
    }
    vectors
}

#[expect(clippy::needless_range_loop, reason = "matrix indices read like the formula")]
fn rotate<const N: usize>(a: &mut [[f64; N]; N], vectors: &mut [[f64; N]; N], p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
    let t = if theta == 0.0 { 1.0 } else { t };
    let c = 1.0 / t.hypot(1.0);
    let s = t * c;
    for k in 0..N {
        let (akp, akq) = (a[k][p], a[k][q]);
        a[k][p] = c * akp - s * akq;
        a[k][q] = s * akp + c * akq;
    }
    for k in 0..N {
        let (apk, aqk) = (a[p][k], a[q][k]);
        a[p][k] = c * apk - s * aqk;
        a[q][k] = s * apk + c * aqk;
    }
    for row in vectors.iter_mut() {
        let (vp, vq) = (row[p], row[q]);
        row[p] = c * vp - s * vq;
        row[q] = s * vp + c * vq;
    }
}
