//! Convex polygons in the plane.

use glam::DVec2;

/// Sorts the corners counter-clockwise.
pub(super) fn counter_clockwise([p, q, r]: [DVec2; 3]) -> [DVec2; 3] {
    if (q - p).perp_dot(r - p) < 0.0 { [p, r, q] } else { [p, q, r] }
}

/// Whether the triangles overlap by more than `width` in every direction.
///
/// The smallest overlap of two convex polygons is attained along the normal of a side (Minkowski difference).
pub(super) fn overlap(a: &[DVec2; 3], b: &[DVec2; 3], width: f64) -> bool {
    let normals = |t: &[DVec2; 3]| [t[1] - t[0], t[2] - t[1], t[0] - t[2]].map(DVec2::perp);
    let mut all = normals(a).into_iter().chain(normals(b));
    all.all(|normal| {
        let normal = normal.normalize_or_zero();
        let (a, b) = (span(a, normal), span(b, normal));
        a[1].min(b[1]) - a[0].max(b[0]) > width
    })
}

fn span(points: &[DVec2], direction: DVec2) -> [f64; 2] {
    let heights = points.iter().map(|p| p.dot(direction));
    heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| [low.min(h), high.max(h)])
}

/// The intersection of counter-clockwise triangles, clipped side by side (Sutherland and Hodgman 1974).
pub(super) fn common(triangles: &[[DVec2; 3]]) -> Vec<DVec2> {
    let Some((first, others)) = triangles.split_first() else {
        return Vec::new();
    };
    let mut polygon = first.to_vec();
    for triangle in others {
        for i in 0..3 {
            polygon = left_of(&polygon, triangle[i], triangle[(i + 1) % 3]);
        }
    }
    polygon
}

/// The part of a convex polygon to the left of the line from `from` to `to`.
fn left_of(polygon: &[DVec2], from: DVec2, to: DVec2) -> Vec<DVec2> {
    let height = |p: DVec2| (to - from).perp_dot(p - from);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (hp, hq) = (height(p), height(q));
        if hp >= 0.0 {
            kept.push(p);
        }
        if (hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0) {
            kept.push(p.lerp(q, hp / (hp - hq)));
        }
    }
    kept
}

/// Whether a convex polygon is wider than `width` in every direction: its smallest width is perpendicular to one of its
/// sides.
pub(super) fn is_wide(polygon: &[DVec2], width: f64) -> bool {
    let sides = (0..polygon.len()).map(|i| polygon[(i + 1) % polygon.len()] - polygon[i]);
    let normals = sides.filter_map(|side| side.perp().try_normalize());
    let widths = normals.map(|normal| {
        let [low, high] = span(polygon, normal);
        high - low
    });
    polygon.len() > 2 && widths.fold(f64::INFINITY, f64::min) > width
}

/// The mean of the corners, which lies inside a convex polygon.
pub(super) fn middle(polygon: &[DVec2]) -> DVec2 {
    polygon.iter().sum::<DVec2>() / polygon.len().max(1) as f64
}

/// Whether `point` lies inside a counter-clockwise triangle, farther than `margin` from its sides.
pub(super) fn holds(triangle: &[DVec2; 3], point: DVec2, margin: f64) -> bool {
    (0..3).all(|i| {
        let side = triangle[(i + 1) % 3] - triangle[i];
        side.perp_dot(point - triangle[i]) > margin * side.length()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNER: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

    #[test]
    fn triangles_overlap_by_the_shortest_push_that_separates_them() {
        // Pushed along the diagonal they separate after √½ (1 − 2·0.2).
        let other = CORNER.map(|p| p + DVec2::splat(0.2));
        let exact = 0.6 * std::f64::consts::FRAC_1_SQRT_2;
        assert!(overlap(&CORNER, &other, exact - 1e-12));
        assert!(!overlap(&CORNER, &other, exact + 1e-12));
        assert!(!overlap(&CORNER, &CORNER.map(|p| DVec2::new(-p.x, p.y)), 0.0));
    }

    #[test]
    fn the_common_part_has_the_area_of_its_closed_form() {
        let mirrored = counter_clockwise(CORNER.map(|p| DVec2::new(0.5 - p.x, p.y)));
        let shifted = CORNER.map(|p| p - DVec2::Y * 0.25);
        let polygon = common(&[CORNER, mirrored, shifted]);
        let area: f64 = (0..polygon.len())
            .map(|i| 0.5 * polygon[i].perp_dot(polygon[(i + 1) % polygon.len()]))
            .sum();
        // The strip 0 ≤ x ≤ 0.5 below y = 0.75 − x and y = 0.5 + x: a roof over a rectangle of 0.5 × 0.25.
        let roof = |x: f64| (0.75 - x).min(0.5 + x);
        let steps = 100_000;
        let sum: f64 =
            (0..steps).map(|k| roof((f64::from(k) + 0.5) / f64::from(steps) * 0.5)).sum();
        assert!((area - sum / f64::from(steps) * 0.5).abs() < 1e-9, "{area}");
        assert!(holds(&CORNER, middle(&polygon), 0.1) && holds(&mirrored, middle(&polygon), 0.1));
        assert!(is_wide(&polygon, 0.49) && !is_wide(&polygon, 0.51));
    }

    #[test]
    fn what_is_apart_or_thin_has_no_wide_common_part() {
        let far = CORNER.map(|p| p + DVec2::X * 2.0);
        assert!(common(&[CORNER, far]).len() < 3);
        let beside = counter_clockwise(CORNER.map(|p| DVec2::new(1e-7 - p.x, p.y)));
        assert!(!is_wide(&common(&[CORNER, beside]), 1e-6));
    }
}
