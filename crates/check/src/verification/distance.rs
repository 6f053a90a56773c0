//! The distance of two triangles, and a lower bound of it over an interval.

use glam::DVec3;

use super::path::{OnPlane, Path};
use super::span::{Pose, Span};
use super::walk::SHORTEST_STEP;

/// The closest points of two triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Closest {
    pub(super) on_a: DVec3,
    pub(super) on_b: DVec3,
}

impl Closest {
    pub(super) fn distance(&self) -> f64 {
        self.on_a.distance(self.on_b)
    }

    fn reversed(self) -> Self {
        Self {
            on_a: self.on_b,
            on_b: self.on_a,
        }
    }
}

/// What came of the search for a pair nearer than asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Nearness {
    /// Never nearer.
    Kept,
    /// Nearer at this instant.
    Nearer { time: f64, distance: f64 },
    /// Neither was found in the budget.
    Unproved,
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

/// The point of a triangle nearest to p: below it where it is above the triangle, otherwise on the rim.
pub(super) fn on_triangle(p: DVec3, t: &[DVec3; 3]) -> DVec3 {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let squared = normal.length_squared();
    if squared > 0.0 {
        let foot = p - normal * ((p - t[0]).dot(normal) / squared);
        let is_inside = (0..3).all(|i| {
            let (u, v) = (t[i], t[(i + 1) % 3]);
            (v - u).cross(foot - u).dot(normal) >= 0.0
        });
        if is_inside {
            return foot;
        }
    }
    nearest((0..3).map(|i| on_segment(p, [t[i], t[(i + 1) % 3]])), p)
}

fn nearest(points: impl Iterator<Item = DVec3>, p: DVec3) -> DVec3 {
    points
        .reduce(|q, r| {
            if p.distance_squared(r) < p.distance_squared(q) {
                r
            } else {
                q
            }
        })
        .unwrap_or(p)
}

/// The closest points of two segments: where their lines are closest, if that is inside both, otherwise at an end.
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
        if (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) {
            let inside = Closest {
                on_a: s[0] + u * x,
                on_b: r[0] + v * y,
            };
            best = closer([best, inside].into_iter());
        }
    }
    best
}

fn closer(all: impl Iterator<Item = Closest>) -> Closest {
    let far = Closest {
        on_a: DVec3::ZERO,
        on_b: DVec3::INFINITY,
    };
    all.reduce(|p, q| if q.distance() < p.distance() { q } else { p })
        .unwrap_or(far)
}

/// Where a segment goes through a triangle.
fn pierced([u, v]: [DVec3; 2], t: &[DVec3; 3]) -> Option<DVec3> {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let (above, below) = ((u - t[0]).dot(normal), (v - t[0]).dot(normal));
    if above * below > 0.0 || above == below {
        return None;
    }
    let point = u + (v - u) * (above / (above - below));
    let inside = |i: usize| {
        let (p, q) = (t[i], t[(i + 1) % 3]);
        (q - p).cross(point - p).dot(normal) >= 0.0
    };
    (0..3).all(inside).then_some(point)
}

/// The closest points of two triangles; the same point twice where they meet.
pub(super) fn closest(pose: &Pose) -> Closest {
    let edge = |t: &[DVec3; 3], i: usize| [t[i], t[(i + 1) % 3]];
    let (a, b) = (&pose.a, &pose.b);
    let through = (0..3).find_map(|i| pierced(edge(a, i), b).or_else(|| pierced(edge(b, i), a)));
    if let Some(point) = through {
        return Closest {
            on_a: point,
            on_b: point,
        };
    }
    let from_a = a.iter().map(|&p| Closest {
        on_a: p,
        on_b: on_triangle(p, b),
    });
    let from_b = b.iter().map(|&p| Closest {
        on_a: p,
        on_b: on_triangle(p, a),
    });
    let edges = (0..9).map(|k| of_segments(edge(a, k / 3), edge(b, k % 3)));
    closer(from_a.chain(from_b.map(Closest::reversed)).chain(edges))
}

/// Searches the interval for an instant at which the triangles are nearer than `limit`, or proves that there is none.
///
/// Between two instants the direction goes straight from the one line of closest points to the other, or rests on
/// one of them; the Bernstein coefficients bound the gap along it from below, and so the distance.
pub(super) fn keeps_distance(span: &Span, limit: f64, budget: u32) -> Nearness {
    let none = OnPlane {
        a: [false; 3],
        b: [false; 3],
    };
    let line = |c: &Closest| (c.on_b - c.on_a).normalize_or_zero();
    let (mut time, mut step) = (0.0, 1.0);
    let mut pose = span.at(0.0);
    let mut here = closest(&pose);
    for _ in 0..budget {
        if here.distance() < limit {
            return Nearness::Nearer {
                time,
                distance: here.distance(),
            };
        }
        if time >= 1.0 {
            return Nearness::Kept;
        }
        let end = span.at(time + step);
        let there = closest(&end);
        if there.distance() < limit {
            (time, here) = (time + step, there);
            continue;
        }
        let part = span.part(&pose, &end);
        let (d0, d1) = (line(&here), line(&there));
        let is_kept = [(d0, d1), (d0, d0), (d1, d1)]
            .into_iter()
            .any(|(from, to)| Path::straight(from, to).bound(&part, none).gap >= limit);
        if is_kept {
            time += step;
            (pose, here) = (end, there);
            if step < 1.0 && (time / (2.0 * step)).fract() == 0.0 {
                step *= 2.0;
            }
        } else if step > SHORTEST_STEP {
            step *= 0.5;
        } else {
            return Nearness::Unproved;
        }
    }
    Nearness::Unproved
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    fn sampled(pose: &Pose) -> f64 {
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
            let pose = Pose {
                a: triangle(0.0),
                b: triangle(1.2),
            };
            let (found, dense) = (closest(&pose).distance(), sampled(&pose));
            assert!(found <= dense + 1e-12, "{found} {dense}");
            assert!(found >= dense - 0.15, "{found} {dense}");
        }
    }

    #[test]
    fn a_distance_that_is_kept_is_kept_at_every_sampled_instant_and_a_nearer_instant_is_found() {
        let mut random = Random::new(9);
        let mut kept = 0;
        for _ in 0..200 {
            let mut triangle = |shift: f64| [(); 3].map(|()| random.vector() + DVec3::X * shift);
            let (start, end) = (
                [triangle(0.0), triangle(2.0)],
                [triangle(0.0), triangle(2.0)],
            );
            let span = Span::new(start, end, 0);
            let distance = |k: u32| closest(&span.at(f64::from(k) / 500.0)).distance();
            let least = (0..=500).map(distance).fold(f64::INFINITY, f64::min);
            assert_ne!(keeps_distance(&span, least + 1e-3, 100_000), Nearness::Kept);
            if least > 0.05 {
                kept += 1;
                let answer = keeps_distance(&span, least - 0.02, 100_000);
                assert_eq!(answer, Nearness::Kept, "{least}");
            }
        }
        assert!(kept > 50, "{kept}");
    }
}
