//! Whether every contact of two rigid bodies in relative translation could be undone by a displacement that is small.
//!
//! A contact can be undone where a path near the given one meets nothing. Displaced paths have a displacement of 26
//! directions or none at each waypoint and are straight between them; which waypoints are reached without contact is
//! followed from one to the next. A path found is a proof, as contact is decided exactly. That no path is found with
//! displacements of 2 τ, at waypoints four times as dense, nor of 0.6 τ to 1.9 τ, is taken for penetration.

use super::{
    distance::swept_distance,
    exact::{Convex, Point, UNIT, plus},
};

/// Two rigid bodies of convex polygons; the second is displaced along straight paths.
#[derive(Debug, Clone)]
pub(crate) struct Bodies {
    pub(crate) still: Vec<Convex>,
    pub(crate) moving: Vec<Convex>,
    pub(crate) path: Vec<Point>,
}

/// The displacements of a length, none first.
fn displacements(radius: f64) -> Vec<Point> {
    let signs = [0_i64, -1, 1];
    let directions = signs
        .iter()
        .flat_map(|&x| signs.iter().flat_map(move |&y| signs.map(|z| [x, y, z])));
    directions
        .map(|d| {
            let length = (d.iter().map(|c| c * c).sum::<i64>() as f64)
                .sqrt()
                .max(1.0);
            d.map(|c| (c as f64 * radius * UNIT as f64 / length).round() as i64)
        })
        .collect()
}

impl Bodies {
    /// The smallest distance over the whole path.
    pub(crate) fn distance(&self) -> f64 {
        let mut least = f64::INFINITY;
        for ends in self.windows() {
            for p in &self.still {
                for q in &self.moving {
                    least = least.min(swept_distance(p, q, ends[0], ends[1]));
                }
            }
        }
        least
    }

    /// Neighbouring waypoints; a path of one waypoint stays there.
    fn windows(&self) -> Vec<[Point; 2]> {
        if let [only] = *self.path.as_slice() {
            return vec![[only, only]];
        }
        self.path.windows(2).map(|w| [w[0], w[1]]).collect()
    }

    /// Whether a path displaced by at most `radius` at waypoints `density` times as dense meets nothing.
    pub(crate) fn can_be_undone(&self, radius: f64, density: i64) -> bool {
        let choices = displacements(radius);
        let mut reached = vec![true; choices.len()];
        for [from, to] in self.windows() {
            let at = |k: i64| [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * k / density);
            for k in 0..density {
                reached = self.advance([at(k), at(k + 1)], radius, &choices, &reached);
                if !reached.contains(&true) {
                    return false;
                }
            }
        }
        true
    }

    fn advance(
        &self,
        [from, to]: [Point; 2],
        radius: f64,
        choices: &[Point],
        reached: &[bool],
    ) -> Vec<bool> {
        let mut near = Vec::new();
        for p in &self.still {
            for q in &self.moving {
                if swept_distance(p, q, from, to) < 2.0 * radius {
                    near.push((p, q));
                }
            }
        }
        if near.is_empty() {
            return vec![true; choices.len()];
        }
        let is_clear = |i: usize, j: usize| {
            let ends = [plus(from, choices[i]), plus(to, choices[j])];
            reached[i] && !near.iter().any(|(p, q)| p.meets(q, ends[0], ends[1]))
        };
        (0..choices.len())
            .map(|j| is_clear(j, j) || (0..choices.len()).any(|i| is_clear(i, j)))
            .collect()
    }
}
