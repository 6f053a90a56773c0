//! The last equilibria of a stage, to extrapolate the next one from.

use std::collections::VecDeque;

use foldmotion_geometry::RigidMotion;
use glam::DVec3;

use super::Configuration;
use crate::Model;

/// States the extrapolation passes through: a parabola.
const KEPT_STATES: usize = 3;
/// Hinges that would turn further, in radians, make an extrapolation useless.
const LARGEST_TURN: f64 = std::f64::consts::FRAC_PI_2;

/// The last equilibria with their stage-local times.
pub(super) struct History {
    states: VecDeque<(f64, Configuration)>,
}

impl History {
    /// A path that starts at `s` in `start`.
    pub(super) fn new(s: f64, start: Configuration) -> Self {
        Self {
            states: VecDeque::from([(s, start)]),
        }
    }

    /// Adds an equilibrium. The earlier ones are moved rigidly onto it, so that what is extrapolated is how the sheet
    /// folds: the rigid motion of a state is arbitrary, and extrapolating it would make it grow without bound.
    pub(super) fn push(&mut self, s: f64, state: Configuration) {
        for (_, earlier) in &mut self.states {
            let motion = RigidMotion::best_fit(&earlier.positions, &state.positions);
            for position in &mut earlier.positions {
                *position = motion.apply(*position);
            }
        }
        self.states.push_back((s, state));
        if self.states.len() > KEPT_STATES {
            self.states.pop_front();
        }
    }

    /// The polynomial through the states kept, at `s`; none where a hinge would turn too far.
    pub(super) fn extrapolate(&self, model: &Model, s: f64) -> Option<Configuration> {
        let (_, last) = self.states.back()?;
        let mut direction = vec![DVec3::ZERO; last.positions.len()];
        for (index, (_, state)) in self.states.iter().enumerate() {
            let weight = self.weight(index, s);
            let moves = state.positions.iter().zip(&last.positions);
            for (d, (&x, &x_last)) in direction.iter_mut().zip(moves) {
                *d += (x - x_last) * weight;
            }
        }
        last.moved(model, &direction, 1.0, LARGEST_TURN)
    }

    /// Lagrange's polynomial of one state at `s`.
    fn weight(&self, index: usize, s: f64) -> f64 {
        let own = self.states[index].0;
        let others = self.states.iter().enumerate().filter(|&(i, _)| i != index);
        others
            .map(|(_, &(other, _))| (s - other) / (own - other))
            .product()
    }
}
