//! Searches for equilibrium that get nowhere.

/// A new low counts if it is lower by this share.
const PROGRESS: f64 = 1e-2;
/// Iterations without a new low of energy or forces, after which there will be none.
const MOST_IDLE: usize = 300;

/// The lows of a search: steps at kinks of the energy, or of contact between them, can follow each other without end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stall {
    energy: f64,
    residual: f64,
    idle: usize,
}

impl Stall {
    /// Nothing is known yet, or nothing known holds any more.
    pub(super) const NONE: Self = Self { energy: f64::INFINITY, residual: f64::INFINITY, idle: 0 };

    /// Takes note of a state; whether the search gets nowhere. `rounding`: what rounding may change of the energy.
    pub(super) fn note(&mut self, energy: f64, residual: f64, rounding: f64) -> bool {
        let is_lower =
            energy < self.energy - rounding || residual < self.residual * (1.0 - PROGRESS);
        self.energy = self.energy.min(energy);
        self.residual = self.residual.min(residual);
        self.idle = if is_lower { 0 } else { self.idle + 1 };
        self.idle > MOST_IDLE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_that_goes_round_in_circles_stalls_and_one_that_creeps_does_not() {
        let mut circling = Stall::NONE;
        let stalls = (0..1_000).position(|k| circling.note(1.0 + f64::from(k % 3), 2.0, 1e-12));
        assert_eq!(stalls, Some(MOST_IDLE + 1));
        let mut creeping = Stall::NONE;
        assert!((0..1_000).all(|k| !creeping.note(1.0 - 1e-6 * f64::from(k), 2.0, 1e-12)));
    }
}
