//! A state of the sheet during the search for equilibrium.

use glam::DVec3;

use crate::Model;

/// Positions in unit lengths and the followed fold angle of every hinge at them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Configuration {
    pub(super) positions: Vec<DVec3>,
    pub(super) angles: Vec<f64>,
}

impl Configuration {
    /// The sheet at `positions`, its fold angles those nearest to `angles`.
    pub(super) fn new(model: &Model, positions: Vec<DVec3>, mut angles: Vec<f64>) -> Self {
        model.follow_angles(&positions, &mut angles);
        Self { positions, angles }
    }

    /// This state moved by `length` × `direction`, its fold angles followed.
    ///
    /// `None` if a hinge turned by more than `largest_turn`, so that following it would be a guess.
    pub(super) fn moved(
        &self,
        model: &Model,
        direction: &[DVec3],
        length: f64,
        largest_turn: f64,
    ) -> Option<Self> {
        let positions: Vec<DVec3> =
            self.positions.iter().zip(direction).map(|(&x, &d)| x + d * length).collect();
        let mut angles = self.angles.clone();
        model.follow_angles(&positions, &mut angles);
        let followed =
            angles.iter().zip(&self.angles).all(|(new, old)| (new - old).abs() <= largest_turn);
        followed.then_some(Self { positions, angles })
    }
}

/// The largest length among `vectors`.
pub(super) fn largest(vectors: &[DVec3]) -> f64 {
    vectors.iter().map(|v| v.length_squared()).fold(0.0, f64::max).sqrt()
}

/// Σ u·v.
pub(super) fn dot(u: &[DVec3], v: &[DVec3]) -> f64 {
    u.iter().zip(v).map(|(&a, &b)| a.dot(b)).sum()
}
