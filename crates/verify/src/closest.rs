//! The closest points of two triangles.

use glam::DVec3;

use crate::moving_pair::PairPose;

/// The closest points of two triangles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Closest {
    pub(crate) on_a: DVec3,
    pub(crate) on_b: DVec3,
}

impl Closest {
    pub(crate) fn distance(&self) -> f64 {
        self.on_a.distance(self.on_b)
    }

    fn reversed(self) -> Self {
        Self { on_a: self.on_b, on_b: self.on_a }
    }
}

/// The point of a segment nearest to p.
fn on_segment(p: DVec3, [u, v]: [DVec3; 2]) -> DVec3 {
    let along = v - u;
    let squared = along.length_squared();
    if squared == 0.0 {
        return u;
    }
    u + along * ((p - u).dot(along) / squared).clamp(0.0, 1.0)
}

/// The point of a triangle nearest to p: the foot of p if p is above the triangle, otherwise a point of the rim.
pub(crate) fn on_triangle(p: DVec3, t: &[DVec3; 3]) -> DVec3 {
    let rim = (0..3).map(|i| on_segment(p, [t[i], t[(i + 1) % 3]]));
    nearest(rim.chain(below(p, t)), p)
}

/// A point of the triangle, which is the foot of p if p is above the triangle.
///
/// The barycentric coordinate of the corner opposite the longest side comes from areas; of the section at this
/// coordinate the nearest point is taken. In a thin triangle the coordinate is inaccurate, but then the section changes
/// little with it.
fn below(p: DVec3, t: &[DVec3; 3]) -> Option<DVec3> {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let squared = normal.length_squared();
    if squared == 0.0 {
        return None;
    }
    let side = |i: usize| t[(i + 1) % 3].distance_squared(t[(i + 2) % 3]);
    let across = (1..3).fold(0, |i, j| if side(j) > side(i) { j } else { i });
    let [tip, u, v] = [0, 1, 2].map(|k| t[(across + k) % 3]);
    let share = ((v - u).cross(p - u).dot(normal) / squared).clamp(0.0, 1.0);
    let section = [u + (tip - u) * share, v + (tip - v) * share];
    Some(on_segment(p, section))
}

fn nearest(points: impl Iterator<Item = DVec3>, p: DVec3) -> DVec3 {
    points
        .reduce(|q, r| if p.distance_squared(r) < p.distance_squared(q) { r } else { q })
        .unwrap_or(p)
}

/// The closest points of two segments: where their lines are closest, if that is inside both, otherwise at an end.
///
/// For nearly parallel lines, the place of closest approach is inaccurate. So for a point on one segment the nearest
/// point of the other is taken, and for that the nearest again.
fn of_segments(s: [DVec3; 2], r: [DVec3; 2]) -> Closest {
    let ends = [
        (s[0], on_segment(s[0], r)),
        (s[1], on_segment(s[1], r)),
        (on_segment(r[0], s), r[0]),
        (on_segment(r[1], s), r[1]),
    ];
    let mut best = closer(ends.into_iter().map(|(on_a, on_b)| Closest { on_a, on_b }));
    let (u, v, w) = (s[1] - s[0], r[1] - r[0], r[0] - s[0]);
    let n = u.cross(v);
    let squared = n.length_squared();
    if squared > 0.0 {
        let (x, y) = (w.cross(v).dot(n) / squared, w.cross(u).dot(n) / squared);
        let inside = 0.0..=1.0;
        if inside.contains(&x) && inside.contains(&y) {
            let (on_a, on_b) = (s[0] + u * x, r[0] + v * y);
            let as_met = Closest { on_a, on_b };
            let on_b = on_segment(on_a, r);
            let again = Closest { on_a: on_segment(on_b, s), on_b };
            best = closer([best, as_met, again].into_iter());
        }
    }
    best
}

fn closer(all: impl Iterator<Item = Closest>) -> Closest {
    let far = Closest { on_a: DVec3::ZERO, on_b: DVec3::INFINITY };
    all.reduce(|p, q| if q.distance() < p.distance() { q } else { p }).unwrap_or(far)
}

/// The point at which a segment crosses the plane of a triangle, and the point of the triangle nearest to it.
fn pierced([u, v]: [DVec3; 2], t: &[DVec3; 3]) -> Option<Closest> {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let (above, below) = ((u - t[0]).dot(normal), (v - t[0]).dot(normal));
    if above * below > 0.0 || above == below {
        return None;
    }
    let on_a = u + (v - u) * (above / (above - below));
    let on_b = on_triangle(on_a, t);
    Some(Closest { on_a, on_b })
}

/// The closest points of two triangles, each to within rounding; nearly the same point twice if they intersect.
pub(crate) fn closest(pose: &PairPose) -> Closest {
    let edge = |t: &[DVec3; 3], i: usize| [t[i], t[(i + 1) % 3]];
    let (a, b) = (&pose.a, &pose.b);
    let through_b = (0..3).filter_map(|i| pierced(edge(a, i), b));
    let through_a = (0..3).filter_map(|i| pierced(edge(b, i), a).map(Closest::reversed));
    let from_a = a.iter().map(|&p| Closest { on_a: p, on_b: on_triangle(p, b) });
    let from_b = b.iter().map(|&p| Closest { on_a: p, on_b: on_triangle(p, a) });
    let edges = (0..9).map(|k| of_segments(edge(a, k / 3), edge(b, k % 3)));
    let corners = from_a.chain(from_b.map(Closest::reversed));
    closer(corners.chain(edges).chain(through_b).chain(through_a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use foldmotion_random::Random;

    fn sampled(pose: &PairPose) -> f64 {
        let mut least = f64::INFINITY;
        let n = 24;
        let point = |t: &[DVec3; 3], i: u32, j: u32| {
            let (x, y) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            t[0] + (t[1] - t[0]) * x + (t[2] - t[0]) * y
        };
        for i in 0..=n {
            for j in 0..=n - i {
                let p = point(&pose.a, i, j);
                least = least.min(p.distance(on_triangle(p, &pose.b)));
            }
        }
        least
    }

    #[test]
    fn the_distance_is_what_dense_sampling_finds() {
        let mut random = Random::new(8);
        for _ in 0..200 {
            let mut triangle = |shift: f64| [(); 3].map(|()| random.vector() + DVec3::X * shift);
            let pose = PairPose { a: triangle(0.0), b: triangle(1.2) };
            let (found, dense) = (closest(&pose).distance(), sampled(&pose));
            assert!(found <= dense + 1e-12, "{found} {dense}");
            assert!(found >= dense - 0.15, "{found} {dense}");
        }
    }
}
