//! Insertion and removal of knots of a cubic B-spline.
//!
//! Source: Boehm 1980, "Inserting new knots into B-spline curves".

use glam::DVec2;

const DEGREE: usize = 3;
/// Knots are equal or at least this far apart, relative to the length of the domain.
const NARROWEST_SPAN: f64 = 1e-9;

/// Control points and knots of a spline.
pub(super) type Spline = (Vec<DVec2>, Vec<f64>);

/// The same curve with the knot `u` inserted once more. With k such that t_k ≤ u < t_{k+1},
///
/// Q_i = (1 − α_i) P_{i−1} + α_i P_i,  α_i = (u − t_i) / (t_{i+3} − t_i) for k − 2 ≤ i ≤ k, 1 for smaller i and 0 for
/// larger i.
///
/// An existing knot within 1e-9 of the domain replaces `u`. Precondition: n ≥ 4 control points and n + 4 non-decreasing
/// knots. `None` if `u` lies outside the domain [t_3, t_n) or already has multiplicity three.
pub(super) fn inserted(points: &[DVec2], knots: &[f64], u: f64) -> Option<Spline> {
    let count = points.len();
    if count <= DEGREE || knots.len() != count + DEGREE + 1 {
        return None;
    }
    let closest = NARROWEST_SPAN * (knots[count] - knots[DEGREE]);
    let near = knots.iter().copied().find(|t| (t - u).abs() <= closest);
    let u = near.unwrap_or(u);
    let is_within = knots[DEGREE] <= u && u < knots[count];
    let multiplicity = knots.iter().filter(|&&t| t == u).count();
    if !is_within || multiplicity >= DEGREE {
        return None;
    }
    let k = knots.partition_point(|&t| t <= u) - 1;
    let point = |i: usize| {
        if i + DEGREE <= k {
            points[i]
        } else if i > k {
            points[i - 1]
        } else {
            let share = (u - knots[i]) / (knots[i + DEGREE] - knots[i]);
            points[i - 1].lerp(points[i], share)
        }
    };
    let points = (0..=count).map(point).collect();
    let mut knots = knots.to_vec();
    knots.insert(k + 1, u);
    Some((points, knots))
}

/// The same curve with clamped ends: it starts at its first control point and ends at its last.
pub(super) fn clamped(points: &[DVec2], knots: &[f64]) -> Option<Spline> {
    let (points, knots) = reversed(clamped_start(points.to_vec(), knots.to_vec())?);
    clamped_start(points, knots).map(reversed)
}

fn clamped_start(mut points: Vec<DVec2>, mut knots: Vec<f64>) -> Option<Spline> {
    let start = *knots.get(DEGREE)?;
    while knots.iter().filter(|&&t| t == start).count() < DEGREE {
        (points, knots) = inserted(&points, &knots, start)?;
    }
    let behind = knots.partition_point(|&t| t <= start);
    let first = behind - 1 - DEGREE.min(behind - 1);
    let points = points.get(first..)?.to_vec();
    let knots = std::iter::repeat_n(start, DEGREE + 1).chain(knots[behind..].iter().copied());
    Some((points, knots.collect()))
}

fn reversed((mut points, mut knots): Spline) -> Spline {
    points.reverse();
    let sum = knots[0] + knots[knots.len() - 1];
    knots.reverse();
    for knot in &mut knots {
        *knot = sum - *knot;
    }
    (points, knots)
}

/// The knots without one in the middle of the support of control point `index`, for removing that point.
pub(super) fn removed(knots: &[f64], index: usize) -> Vec<f64> {
    let mut knots = knots.to_vec();
    let inner = DEGREE + 1..knots.len().saturating_sub(DEGREE + 1);
    if let Some(last) = inner.clone().last() {
        knots.remove((index + 2).clamp(inner.start, last));
    }
    knots
}

#[cfg(test)]
mod tests {
    use foldmotion_geometry::Nurbs;
    use foldmotion_study::models;

    use super::*;

    fn largest_difference(a: &Nurbs, b: &Nurbs) -> f64 {
        let at = |k: i32| f64::from(k) / 1000.0;
        let distance = |u: f64| a.position(u).distance(b.position(u));
        (0..=1000).map(at).map(distance).fold(0.0, f64::max)
    }

    #[test]
    fn inserting_a_knot_keeps_the_curve() {
        for model in models() {
            let profile = model.profile().unwrap();
            let curve = profile.curve();
            for u in [0.0, 1e-3, 0.25, 1.0 / 3.0, 0.5, 0.777, 0.999] {
                let Some((points, knots)) = inserted(curve.control_points(), curve.knots(), u)
                else {
                    assert_eq!(u, 0.0, "{}: only the clamped start takes no knot", model.name);
                    continue;
                };
                assert_eq!(points.len(), curve.control_points().len() + 1);
                let more = Nurbs::with_knots(points, knots).unwrap();
                let error = largest_difference(curve, &more);
                assert!(error <= 1e-12 * profile.magnitude(), "{} {u}: {error}", model.name);
            }
        }
    }

    #[test]
    fn a_curve_with_a_wrong_control_point_is_detected() {
        let profile = models()[0].profile().unwrap();
        let curve = profile.curve();
        let (mut points, knots) = inserted(curve.control_points(), curve.knots(), 0.5).unwrap();
        points[3].x += 1e-9;
        let more = Nurbs::with_knots(points, knots).unwrap();
        assert!(largest_difference(curve, &more) > 1e-12);
    }

    #[test]
    fn a_knot_outside_the_domain_or_of_multiplicity_three_is_refused() {
        let points: Vec<DVec2> = (0..5).map(|k| DVec2::new(f64::from(k), 0.0)).collect();
        let knots = [0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0];
        for u in [-0.1, 1.0, 1.1, f64::NAN] {
            assert_eq!(inserted(&points, &knots, u), None);
        }
        let (points, knots) = inserted(&points, &knots, 0.5).unwrap();
        let (points, knots) = inserted(&points, &knots, 0.5).unwrap();
        assert_eq!(inserted(&points, &knots, 0.5), None);
        assert_eq!(inserted(&points[1..], &knots, 0.2), None);
    }

    #[test]
    fn clamping_a_periodic_curve_keeps_it() {
        let bunny = models().iter().find(|m| m.name == "bunny").unwrap();
        let profile = bunny.profile().unwrap();
        let curve = profile.curve();
        let (points, knots) = clamped(curve.control_points(), curve.knots()).unwrap();
        assert!(knots[..4].iter().all(|&t| t == knots[3]));
        let end = knots.len() - 4;
        assert!(knots[end..].iter().all(|&t| t == knots[end]));
        let same = Nurbs::with_knots(points.clone(), knots).unwrap();
        assert!(largest_difference(curve, &same) <= 1e-12 * profile.magnitude());
        assert_eq!(same.position(0.0), points[0]);
    }

    #[test]
    fn a_control_point_is_removed_with_one_knot_of_its_support() {
        let knots = [0.0, 0.0, 0.0, 0.0, 0.3, 0.6, 1.0, 1.0, 1.0, 1.0];
        for index in 0..6 {
            let fewer = removed(&knots, index);
            let points = (0..5).map(|k| DVec2::new(f64::from(k), 0.0)).collect();
            assert!(Nurbs::with_knots(points, fewer).is_ok());
        }
    }
}
