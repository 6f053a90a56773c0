//! The last equilibria of a stage, to extrapolate the next one from.

use std::collections::VecDeque;

use foldmotion_geometry::RigidMotion;
use glam::DVec3;

use super::Configuration;
use crate::Model;

/// The most states an extrapolation passes through: without contact, and with it, where layers that meet bend the path.
const MOST_STATES: usize = 7;
const MOST_STATES_IN_CONTACT: usize = 3;
/// Hinges that would turn further, in radians, make an extrapolation useless.
const LARGEST_TURN: f64 = std::f64::consts::FRAC_PI_2;

/// The last equilibria with their stage-local times.
pub(super) struct History {
    states: VecDeque<(f64, Vec<DVec3>)>,
    /// The last of them, with its fold angles.
    last: Configuration,
    /// Through how many of them to extrapolate.
    used: usize,
}

impl History {
    /// A path that starts at `s` in `start`.
    pub(super) fn new(s: f64, start: Configuration) -> Self {
        Self { states: VecDeque::from([(s, start.positions.clone())]), last: start, used: 1 }
    }

    /// Adds an equilibrium. The earlier ones are moved rigidly onto it, so that what is extrapolated is how the sheet
    /// folds: the rigid motion of a state is arbitrary, and extrapolating it would make it grow without bound.
    ///
    /// From now on as many states are used as would have foretold this one best, or one more if that was all.
    pub(super) fn push(&mut self, s: f64, state: Configuration, in_contact: bool) {
        let most = if in_contact { MOST_STATES_IN_CONTACT } else { MOST_STATES };
        while self.states.len() > most {
            self.states.pop_front();
        }
        let motion = RigidMotion::best_fit(&self.last.positions, &state.positions);
        for (_, earlier) in &mut self.states {
            for position in earlier {
                *position = motion.apply(*position);
            }
        }
        let known = self.states.len();
        let error = |used: usize| {
            let foretold = self.foretell(s, used);
            let errors = foretold.iter().zip(&state.positions);
            errors.map(|(&p, &q)| p.distance_squared(q)).fold(0.0, f64::max)
        };
        let errors: Vec<f64> = (1..=known).map(error).collect();
        let best = (1..=known).min_by(|&a, &b| errors[a - 1].total_cmp(&errors[b - 1]));
        self.used = match best {
            Some(best) if best < known => best,
            _ => most.min(known + 1),
        };
        if known == most {
            self.states.pop_front();
        }
        self.states.push_back((s, state.positions.clone()));
        self.last = state;
    }

    /// The stage-local time of the last equilibrium.
    pub(super) fn last_time(&self) -> f64 {
        self.states.back().map_or(0.0, |(s, _)| *s)
    }

    /// The state at `s` extrapolated; `None` if a hinge would turn too far.
    pub(super) fn extrapolate(&self, model: &Model, s: f64) -> Option<Configuration> {
        let ahead = self.foretell(s, self.used);
        let moves = ahead.iter().zip(&self.last.positions);
        let direction: Vec<DVec3> = moves.map(|(&x, &last)| x - last).collect();
        self.last.moved(model, &direction, 1.0, LARGEST_TURN)
    }

    /// The polynomial through the last `used` states, at `s`.
    fn foretell(&self, s: f64, used: usize) -> Vec<DVec3> {
        let from = self.states.len() - used;
        let states = || self.states.range(from..);
        let mut sum = vec![DVec3::ZERO; self.last.positions.len()];
        for (index, (own, positions)) in states().enumerate() {
            // Lagrange's polynomial of one state at `s`.
            let others = states().enumerate().filter(|&(i, _)| i != index);
            let weight: f64 = others.map(|(_, (other, _))| (s - other) / (own - other)).product();
            for (sum, &position) in sum.iter_mut().zip(positions) {
                *sum += position * weight;
            }
        }
        sum
    }
}
