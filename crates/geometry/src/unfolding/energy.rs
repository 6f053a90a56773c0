//! The energy that keeps a chain from touching itself, and its gradient.

use glam::DVec2;

/// E = Σ 1 / (|v − a| + |v − b| − |ab|)², over all points v and segments ab that do not end in v, of a chain through
/// `points`; infinite if a point lies on a segment.
///
/// Source: Cantarella, Demaine, Iben and O'Brien 2004, section 3. It decreases along every motion in which no distance
/// shrinks.
pub(super) fn energy(points: &[DVec2]) -> f64 {
    let mut energy = 0.0;
    for_each_term(points, |_, _, term| energy += term.excess.powi(-2));
    energy
}

/// E and its gradient with respect to the turns of a chain through `points`.
///
/// Turning joint k moves every point p_j beyond it by (p_j − p_k) rotated by a right angle, so that ∂E/∂τ_k = Σ_{j>k}
/// ⟂(p_j − p_k) · ∂E/∂p_j.
pub(super) fn energy_and_gradient(points: &[DVec2]) -> (f64, Vec<f64>) {
    let mut energy = 0.0;
    let mut by_point = vec![DVec2::ZERO; points.len()];
    for_each_term(points, |v, k, term| {
        let inverse = term.excess.recip();
        energy += inverse * inverse;
        let rate = -2.0 * inverse * inverse * inverse;
        let [a, b] = term.directions.map(|d| d * rate);
        by_point[v] += a + b;
        by_point[k] -= a;
        by_point[k + 1] -= b;
    });
    let (mut force, mut moment) = (DVec2::ZERO, 0.0);
    let mut gradient = vec![0.0; points.len() - 2];
    for j in (2..points.len()).rev() {
        force += by_point[j];
        moment += points[j].perp_dot(by_point[j]);
        gradient[j - 2] = moment - points[j - 1].perp_dot(force);
    }
    (energy, gradient)
}

/// The contribution of a point v and a segment ab to the energy.
struct Term {
    /// The excess |v − a| + |v − b| − |ab|.
    excess: f64,
    /// The unit vectors from a and from b to v.
    directions: [DVec2; 2],
}

/// Visits every point and every segment that does not end in it. Segments keep their length, so |ab| is constant.
fn for_each_term(points: &[DVec2], mut visit: impl FnMut(usize, usize, Term)) {
    let lengths: Vec<f64> = points.windows(2).map(|p| p[0].distance(p[1])).collect();
    for (v, &point) in points.iter().enumerate() {
        let mut from_a = (point - points[0], point.distance(points[0]));
        for (k, length) in lengths.iter().enumerate() {
            let offset = point - points[k + 1];
            let from_b = (offset, offset.length());
            if v != k && v != k + 1 {
                visit(
                    v,
                    k,
                    Term {
                        excess: from_a.1 + from_b.1 - length,
                        directions: [from_a, from_b].map(|(offset, distance)| offset / distance),
                    },
                );
            }
            from_a = from_b;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unfolding::Chain;
    use foldmotion_random::Random;

    #[test]
    fn the_gradient_agrees_with_finite_differences() {
        let mut random = Random::new(11);
        for _ in 0..20 {
            let turns: Vec<f64> = (0..12).map(|_| 0.5 * random.number()).collect();
            let points: Vec<DVec2> = (0..14).map(|k| DVec2::X * f64::from(k)).collect();
            let chain = Chain::new(&points, false).unwrap();
            let at = |turns: &[f64]| energy(&chain.points(turns));
            let (value, gradient) = energy_and_gradient(&chain.points(&turns));
            assert!((value - at(&turns)).abs() <= 1e-14 * value);
            for k in 0..turns.len() {
                let moved = |by: f64| {
                    let mut moved = turns.clone();
                    moved[k] += by;
                    at(&moved)
                };
                let slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                let scale = gradient.iter().fold(0.0, |a: f64, g| a.max(g.abs()));
                assert!((slope - gradient[k]).abs() < 1e-6 * scale, "{k}: {slope} {}", gradient[k]);
            }
        }
    }

    #[test]
    fn the_energy_grows_without_bound_towards_a_touch_and_is_least_where_straight() {
        let hook = |gap: f64| {
            [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, gap]].map(DVec2::from)
        };
        assert!(energy(&hook(1e-3)) > 1e4 * energy(&hook(0.5)));
        let chain = Chain::new(&hook(0.5), false).unwrap();
        let straight = energy(&chain.points(&[0.0; 3]));
        assert!(straight < energy(&chain.points(&[0.1, 0.0, 0.0])));
        assert!(straight < energy(&chain.points(chain.turns())));
    }
}
