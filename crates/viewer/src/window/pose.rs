//! The state that is shown, with the colours of its triangles: worked out once, as long as nothing changes.

use std::sync::Arc;

use foldmotion_pattern::Sheet;
use foldmotion_study::Quantity;
use glam::DVec3;

use super::act::Act;
use crate::settings::Colour;
use crate::work::State;

/// The state that is shown.
#[derive(Debug, Default)]
pub(crate) struct Pose {
    /// Changes with the positions.
    pub(crate) key: u64,
    of: Option<Of>,
    pub(crate) positions: Arc<Vec<DVec3>>,
    /// Triangles that penetrate now, and where they met.
    pub(crate) penetrating: (Vec<u32>, Vec<DVec3>),
    values: Option<(u64, Quantity, Vec<f64>)>,
    ranges: Option<(u64, Quantity, [f64; 2])>,
}

/// What a pose is of.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Of {
    /// A motion at a time.
    Act(u64, f64),
    /// The state of a run, or in the hand, by its serial number.
    Live(u64, bool),
}

impl Pose {
    /// Takes the state of `act` at motion time `t`.
    pub(crate) fn show(&mut self, act: &Act, t: f64) {
        let of = Of::Act(act.key, t);
        if self.of == Some(of) {
            return;
        }
        self.set(of, Arc::new(act.state(t)));
        self.penetrating = act.penetrating(t);
    }

    /// Takes a state that is computed while it is shown: where the engine has it, or, in the hand, where `act` is shown.
    pub(crate) fn show_live(&mut self, state: &State, act: &Act, is_in_hand: bool) {
        let of = Of::Live(state.serial, is_in_hand);
        if self.of == Some(of) {
            return;
        }
        let positions = if is_in_hand {
            Arc::clone(&state.positions)
        } else {
            Arc::new(
                state
                    .positions
                    .iter()
                    .map(|&p| act.place.apply(p))
                    .collect(),
            )
        };
        self.set(of, positions);
        self.penetrating = (Vec::new(), Vec::new());
    }

    fn set(&mut self, of: Of, positions: Arc<Vec<DVec3>>) {
        self.of = Some(of);
        self.positions = positions;
        self.key += 1;
    }

    /// The values of the triangles that `colour` shows, if it shows values, with their range and title.
    pub(crate) fn values(
        &mut self,
        act: &Act,
        sheet: &Sheet,
        colour: Colour,
    ) -> Option<(&[f64], [f64; 2], &'static str)> {
        let quantity = match colour {
            Colour::Strain => Quantity::Strain,
            Colour::Bending => Quantity::Bending,
            Colour::Plain | Colour::Unit | Colour::Layer => return None,
        };
        if self
            .ranges
            .is_none_or(|(key, q, _)| (key, q) != (act.key, quantity))
        {
            let range = quantity.of_motion(act.motion()).range;
            self.ranges = Some((act.key, quantity, range));
        }
        let is_known = self
            .values
            .as_ref()
            .is_some_and(|(key, q, _)| (*key, *q) == (self.key, quantity));
        if !is_known {
            let values = quantity.values(sheet, &self.positions);
            self.values = Some((self.key, quantity, values));
        }
        let (_, _, range) = self.ranges?;
        let (_, _, values) = self.values.as_ref()?;
        Some((values, range, quantity.title()))
    }
}
