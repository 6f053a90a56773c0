//! A step in the quadratic model of the energy that a Newton step minimises.

use glam::DVec3;

/// A step d, with the force H d that the Hessian of all but contact makes of it.
#[derive(Debug, Clone)]
pub(super) struct ModelStep {
    pub(super) direction: Vec<DVec3>,
    pub(super) elastic: Vec<DVec3>,
}

impl ModelStep {
    /// No step.
    pub(super) fn none(nodes: usize) -> Self {
        Self { direction: vec![DVec3::ZERO; nodes], elastic: vec![DVec3::ZERO; nodes] }
    }

    /// Shortens the step to `share` of it.
    pub(super) fn scale(&mut self, share: f64) {
        for vector in self.direction.iter_mut().chain(&mut self.elastic) {
            *vector *= share;
        }
    }

    /// Moves `share` of the way to another step.
    pub(super) fn advance(&mut self, share: f64, other: &Self) {
        let own = self.direction.iter_mut().chain(&mut self.elastic);
        for (own, &other) in own.zip(other.direction.iter().chain(&other.elastic)) {
            *own += (other - *own) * share;
        }
    }
}
