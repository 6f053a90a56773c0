//! The Levenberg–Marquardt method for the chord lengths of a profile.
//!
//! The unknowns are the parameters u_1 … u_{N−1} of the inner sampling points of N chords h_k = |Γ(u_{k+1}) − Γ(u_k)|.
//! The method minimises E = ½ Σ r_k² with r_k = (h_k − h̄) / h̄, h̄ the mean chord (equations 1 and 2 of the paper), by
//! algorithm 3.16 of Madsen, Nielsen and Tingleff 2004, *Methods for non-linear least squares problems*, section 3.2.
//!
//! Each r_k depends on every unknown through h̄, yet a step costs O(N). With D = ∂(h/h̄)/∂u at constant h̄ (two entries
//! in each row), g = Dᵀ1 / N = ∇h̄ / h̄ and v = Dᵀr, the Jacobian is J = D − (1 + r) gᵀ, and because Σ r_k = 0
//!
//! Jᵀr = v − (r·r) g,  JᵀJ = DᵀD + (r·r − N) g gᵀ − v gᵀ − g vᵀ:
//!
//! a tridiagonal matrix and one of rank 2. JᵀJ + μI is solved by LDLᵀ of the tridiagonal part and the
//! Sherman–Morrison–Woodbury formula.

use serde::{Deserialize, Serialize};

use crate::chords::{Chords, dot};
use crate::tridiagonal::Tridiagonal;
use crate::{GeometryError, Profile};

/// The initial μ, relative to the largest diagonal entry of DᵀD: equal steps of arc length are a good start (section
/// 3.2 of the source).
const INITIAL_DAMPING: f64 = 1e-6;
/// A step shrinks no gap between consecutive parameters by more than this share, so that their order is kept.
const LARGEST_SHRINKAGE: f64 = 0.9;
/// The number of rejections in a row after which no damping will help: μ has grown by 2^(1 + 2 + … + 12).
const REJECTIONS: u32 = 12;
/// The number of rejections in a row after which a residual within rounding is as small as it gets.
const REJECTIONS_WITHIN_ROUNDING: u32 = 3;

/// The reason why an iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ending {
    /// |R_max| is within the tolerance.
    Tolerance,
    /// |R_max| is above the tolerance, but as small as the rounding of points and parameters permits.
    Rounding,
    /// No further step reduces E: a local minimum with unequal segments, or a corner of the curve in between.
    Stalled,
    /// The iteration limit was reached.
    Iterations,
    /// There was no iteration: the method does not aim at equal segments.
    Direct,
}

impl Ending {
    pub(crate) fn converged(self) -> bool {
        matches!(self, Self::Tolerance | Self::Rounding)
    }
}

/// The state in which the iteration ended.
pub(crate) struct Minimum {
    pub(crate) parameters: Vec<f64>,
    pub(crate) chords: Chords,
    pub(crate) iterations: usize,
    pub(crate) ending: Ending,
}

impl Minimum {
    pub(crate) fn converged(&self) -> bool {
        self.ending.converged()
    }
}

/// Minimises E from `parameters`, which increase strictly from 0 to 1; the ends are fixed. The order of the parameters
/// is kept at every step, and E never increases. An iteration is one linear solve, whether accepted or not.
pub(crate) fn minimise(
    profile: &Profile,
    mut parameters: Vec<f64>,
    tolerance: f64,
    max_iterations: usize,
) -> Result<Minimum, GeometryError> {
    let mut chords = Chords::new(profile, &parameters)?;
    let mut linear = Linearised::new(profile, &parameters, &chords);
    let mut damping = INITIAL_DAMPING * linear.largest_diagonal();
    let mut growth = 2.0;
    let mut rejected = 0;
    let mut iterations = 0;
    let ending = loop {
        let residual = chords.max_residual();
        let within_rounding = residual <= linear.rounding;
        if residual <= tolerance {
            break Ending::Tolerance;
        } else if within_rounding && rejected >= REJECTIONS_WITHIN_ROUNDING {
            break Ending::Rounding;
        } else if rejected >= REJECTIONS {
            break Ending::Stalled;
        } else if iterations >= max_iterations {
            break Ending::Iterations;
        }
        iterations += 1;
        let gain = match linear.step(damping, &parameters) {
            Some(step) => take(profile, &mut parameters, &mut chords, &step),
            None => None,
        };
        if let Some(gain) = gain {
            linear = Linearised::new(profile, &parameters, &chords);
            damping *= (1.0 - (2.0 * gain - 1.0).powi(3)).max(1.0 / 3.0);
            growth = 2.0;
            rejected = 0;
        } else {
            damping *= growth;
            growth *= 2.0;
            rejected += 1;
        }
    };
    Ok(Minimum { parameters, chords, iterations, ending })
}

/// A step of the unknowns, and the reduction of E that the linear model predicts for it.
struct Step {
    change: Vec<f64>,
    promised: f64,
}

/// Takes the step if it reduces E. Returns the gain ratio ρ, the actual reduction over the predicted one.
fn take(
    profile: &Profile,
    parameters: &mut Vec<f64>,
    chords: &mut Chords,
    step: &Step,
) -> Option<f64> {
    let mut moved = parameters.clone();
    for (u, change) in moved[1..].iter_mut().zip(&step.change) {
        *u += change;
    }
    // Rounding can close a gap that the step left open.
    if moved.windows(2).any(|u| u[1] <= u[0]) {
        return None;
    }
    let candidate = Chords::new(profile, &moved).ok()?;
    let reduction = chords.energy() - candidate.energy();
    if reduction <= 0.0 || step.promised <= 0.0 {
        return None;
    }
    *parameters = moved;
    *chords = candidate;
    Some(reduction / step.promised)
}

/// The residuals and their derivatives at one set of parameters.
struct Linearised {
    residuals: Vec<f64>,
    /// Row k of D: ∂(h_k/h̄)/∂u_k and ∂(h_k/h̄)/∂u_{k+1} at constant h̄.
    slopes: Vec<[f64; 2]>,
    /// The vector g of the module documentation.
    mean_gradient: Vec<f64>,
    /// The vector v of the module documentation.
    pull: Vec<f64>,
    /// A bound of the effect of rounding in points and parameters on a residual.
    rounding: f64,
}

impl Linearised {
    fn new(profile: &Profile, parameters: &[f64], chords: &Chords) -> Self {
        let velocities: Vec<_> = parameters.iter().map(|&u| profile.derivative(u)).collect();
        let slopes: Vec<_> = (0..chords.residuals.len())
            .map(|k| {
                let direction = (chords.points[k + 1] - chords.points[k]).normalize_or_zero();
                [-velocities[k], velocities[k + 1]].map(|v| direction.dot(v) / chords.mean)
            })
            .collect();
        let fastest = velocities.iter().fold(0.0, |max: f64, v| max.max(v.length()));
        let count = slopes.len() as f64;
        let mut linear = Self {
            residuals: chords.residuals.clone(),
            slopes,
            mean_gradient: Vec::new(),
            pull: Vec::new(),
            rounding: 8.0 * f64::EPSILON * (profile.magnitude() + fastest) / chords.mean,
        };
        linear.mean_gradient = linear.transposed(|_| 1.0 / count);
        linear.pull = linear.transposed(|k| linear.residuals[k]);
        linear
    }

    /// The product Dᵀy. Unknown j is the end of chord j and the start of chord j + 1.
    fn transposed(&self, y: impl Fn(usize) -> f64) -> Vec<f64> {
        (0..self.slopes.len() - 1)
            .map(|j| self.slopes[j][1] * y(j) + self.slopes[j + 1][0] * y(j + 1))
            .collect()
    }

    /// The gradient Jᵀr of E.
    fn gradient(&self) -> Vec<f64> {
        let squared = dot(&self.residuals, &self.residuals);
        self.pull.iter().zip(&self.mean_gradient).map(|(v, g)| v - squared * g).collect()
    }

    fn diagonal(&self) -> impl Iterator<Item = f64> {
        self.slopes.windows(2).map(|s| s[0][1] * s[0][1] + s[1][0] * s[1][0])
    }

    fn largest_diagonal(&self) -> f64 {
        self.diagonal().fold(f64::MIN_POSITIVE, f64::max)
    }

    /// The solution of (JᵀJ + μI) δ = −Jᵀr, shortened so that the order of the parameters is kept; `None` if it is not
    /// finite.
    fn step(&self, damping: f64, parameters: &[f64]) -> Option<Step> {
        let gradient = self.gradient();
        let mut change = self.solve(damping, &gradient)?;
        for entry in &mut change {
            *entry = -*entry;
        }
        let slope = -dot(&change, &gradient);
        let squared = dot(&change, &change);
        if !(slope.is_finite() && squared.is_finite()) {
            return None;
        }
        let share = admissible_share(&change, parameters);
        for entry in &mut change {
            *entry *= share;
        }
        // L(0) − L(share δ), with δᵀJᵀJδ = −δᵀJᵀr − μ δᵀδ.
        let promised = share * slope - 0.5 * share * share * (slope - damping * squared);
        Some(Step { change, promised })
    }

    /// (JᵀJ + μI)⁻¹ b: with U = [g v] and C = [[r·r − N, −1], [−1, 0]],
    /// (T + U C Uᵀ)⁻¹ b = w − Y (C⁻¹ + UᵀY)⁻¹ Uᵀw, where T Y = U and T w = b.
    fn solve(&self, damping: f64, b: &[f64]) -> Option<Vec<f64>> {
        let factors = Tridiagonal::factor(
            self.diagonal().map(|d| d + damping),
            (1..self.slopes.len() - 1).map(|k| self.slopes[k][0] * self.slopes[k][1]),
        );
        let (g, v) = (&self.mean_gradient, &self.pull);
        let (y_g, y_v, mut w) = (factors.solve(g), factors.solve(v), factors.solve(b));
        let corner = self.slopes.len() as f64 - dot(&self.residuals, &self.residuals);
        let s_gg = dot(g, &y_g);
        let s_gv = dot(g, &y_v) - 1.0;
        let s_vv = dot(v, &y_v) + corner;
        let determinant = s_gg * s_vv - s_gv * s_gv;
        let (b_g, b_v) = (dot(g, &w), dot(v, &w));
        let along_g = (s_vv * b_g - s_gv * b_v) / determinant;
        let along_v = (s_gg * b_v - s_gv * b_g) / determinant;
        if !(along_g.is_finite() && along_v.is_finite()) {
            return None;
        }
        for ((w, y_g), y_v) in w.iter_mut().zip(&y_g).zip(&y_v) {
            *w -= along_g * y_g + along_v * y_v;
        }
        Some(w)
    }
}

/// The largest share of the step that shrinks no gap between parameters by more than [`LARGEST_SHRINKAGE`].
fn admissible_share(change: &[f64], parameters: &[f64]) -> f64 {
    let moved = |k: usize| match k {
        0 => 0.0,
        _ => change.get(k - 1).copied().unwrap_or(0.0),
    };
    (0..parameters.len() - 1).fold(1.0, |share: f64, k| {
        let gap = parameters[k + 1] - parameters[k];
        let shrinkage = moved(k) - moved(k + 1);
        if shrinkage > LARGEST_SHRINKAGE * gap {
            share.min(LARGEST_SHRINKAGE * gap / shrinkage)
        } else {
            share
        }
    })
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::Closure;

    fn wavy() -> (Profile, Vec<f64>) {
        let points = [(0.0, 0.0), (1.0, 2.0), (2.0, -1.0), (3.0, 1.5), (5.0, 0.0), (5.5, 2.0)];
        let points = points.map(|(x, z)| DVec2::new(x, z));
        let profile = Profile::new(&points, Closure::Open).unwrap();
        (profile, vec![0.0, 0.13, 0.3, 0.38, 0.61, 0.8, 1.0])
    }

    /// J by central differences of the residuals, column by column.
    fn jacobian(profile: &Profile, parameters: &[f64]) -> Vec<Vec<f64>> {
        let step = 1e-6;
        (1..parameters.len() - 1)
            .map(|j| {
                let shifted = |sign: f64| {
                    let mut u = parameters.to_vec();
                    u[j] += sign * step;
                    Chords::new(profile, &u).unwrap().residuals
                };
                let (up, down) = (shifted(1.0), shifted(-1.0));
                up.iter().zip(&down).map(|(a, b)| (a - b) / (2.0 * step)).collect()
            })
            .collect()
    }

    #[test]
    fn the_gradient_of_the_energy_agrees_with_differences_of_the_residuals() {
        let (profile, u) = wavy();
        let chords = Chords::new(&profile, &u).unwrap();
        let gradient = Linearised::new(&profile, &u, &chords).gradient();
        for (column, entry) in jacobian(&profile, &u).iter().zip(gradient) {
            let expected = dot(column, &chords.residuals);
            assert!((entry - expected).abs() < 1e-8, "{entry} != {expected}");
        }
    }

    #[test]
    fn a_step_solves_the_damped_normal_equations_of_the_full_jacobian() {
        let (profile, u) = wavy();
        let chords = Chords::new(&profile, &u).unwrap();
        let linear = Linearised::new(&profile, &u, &chords);
        let columns = jacobian(&profile, &u);
        for damping in [1e-3, 0.1, 10.0] {
            let right_hand_side = [0.3, -1.0, 2.0, 0.7, -0.2];
            let x = linear.solve(damping, &right_hand_side).unwrap();
            for (i, expected) in right_hand_side.iter().enumerate() {
                let row: f64 = (0..x.len()).map(|j| dot(&columns[i], &columns[j]) * x[j]).sum();
                let error = (row + damping * x[i] - expected).abs();
                assert!(error < 1e-7, "μ = {damping}, row {i}: error {error}");
            }
        }
    }

    #[test]
    fn a_step_that_would_break_the_order_is_shortened() {
        let parameters = [0.0, 0.4, 0.5, 1.0];
        let change = [0.3, -0.1];
        let share = admissible_share(&change, &parameters);
        assert!((share - 0.9 * 0.1 / 0.4).abs() < 1e-15);
        assert_eq!(admissible_share(&[0.01, 0.01], &parameters), 1.0);
        assert!(admissible_share(&[-0.5, 0.0], &parameters) < 0.8, "the ends hold too");
    }
}
