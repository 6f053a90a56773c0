//! The state that is shown, with the values of its triangles, computed only when something has changed.

use std::sync::Arc;

use foldmotion_pattern::Sheet;
use foldmotion_study::Quantity;
use glam::DVec3;

use super::shown_motion::ShownMotion;
use crate::settings::Colour;
use crate::work::SheetState;

/// The state that is shown.
#[derive(Debug, Default)]
pub(crate) struct ShownState {
    /// A number that changes with the positions.
    pub(crate) key: u64,
    of: Option<StateKey>,
    pub(crate) positions: Arc<Vec<DVec3>>,
    /// The triangles that penetrate now, and the points where they met.
    pub(crate) penetrating: (Vec<u32>, Vec<DVec3>),
    values: Option<(u64, Quantity, Vec<f64>)>,
    ranges: Option<(u64, Quantity, [f64; 2])>,
}

/// What the state depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
enum StateKey {
    /// The key of a motion and the motion time.
    Motion(u64, f64),
    /// The serial number of a state of a run or an interaction, and whether it is an interaction.
    StateFeed(u64, bool),
}

impl ShownState {
    /// Shows the state of a motion at motion time `t`.
    pub(crate) fn show(&mut self, shown: &ShownMotion, t: f64) {
        let of = StateKey::Motion(shown.key, t);
        if self.of == Some(of) {
            return;
        }
        self.set(of, Arc::new(shown.state(t)));
        self.penetrating = shown.penetrating(t);
    }

    /// Shows a state while it is computed. The states of a run are moved to where `shown` is placed; those of an
    /// interaction are there already.
    pub(crate) fn show_live(
        &mut self,
        state: &SheetState,
        shown: &ShownMotion,
        is_interacting: bool,
    ) {
        let of = StateKey::StateFeed(state.serial, is_interacting);
        if self.of == Some(of) {
            return;
        }
        let positions = if is_interacting {
            Arc::clone(&state.positions)
        } else {
            Arc::new(state.positions.iter().map(|&p| shown.placement.apply(p)).collect())
        };
        self.set(of, positions);
        self.penetrating = (Vec::new(), Vec::new());
    }

    fn set(&mut self, of: StateKey, positions: Arc<Vec<DVec3>>) {
        self.of = Some(of);
        self.positions = positions;
        self.key += 1;
    }

    /// The values of the triangles, their range and their title, if `colour` shows values.
    pub(crate) fn values(
        &mut self,
        shown: &ShownMotion,
        sheet: &Sheet,
        colour: Colour,
    ) -> Option<(&[f64], [f64; 2], &'static str)> {
        let quantity = match colour {
            Colour::Strain => Quantity::Strain,
            Colour::Bending => Quantity::Bending,
            Colour::Plain | Colour::Unit | Colour::Layer => return None,
        };
        if self.ranges.is_none_or(|(key, q, _)| (key, q) != (shown.key, quantity)) {
            let range = quantity.of_motion(shown.motion()).range;
            self.ranges = Some((shown.key, quantity, range));
        }
        let is_known =
            self.values.as_ref().is_some_and(|(key, q, _)| (*key, *q) == (self.key, quantity));
        if !is_known {
            let values = quantity.values(sheet, &self.positions);
            self.values = Some((self.key, quantity, values));
        }
        let (_, _, range) = self.ranges?;
        let (_, _, values) = self.values.as_ref()?;
        Some((values, range, quantity.title()))
    }
}
