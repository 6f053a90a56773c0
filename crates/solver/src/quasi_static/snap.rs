//! Snaps: the sheet leaves its equilibrium and moves far to the next.

/// A part of the motion in which the sheet was not in equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snap {
    /// The motion time of the last equilibrium before it.
    pub from: f64,
    /// The motion time of the first equilibrium after it; of the last state if the sheet found none.
    pub to: f64,
    /// The elastic energy that the sheet lost at the targets held in its load steps, in the model's units.
    pub energy_released: f64,
    /// Whether it ended in equilibrium.
    pub is_over: bool,
}

/// Takes note of a load step of `from` to `to` in which the sheet snapped: of one more, if the snap before it is not over.
pub(super) fn add_snap(snaps: &mut Vec<Snap>, step: Snap) {
    match snaps.last_mut().filter(|last| !last.is_over) {
        Some(last) => {
            last.to = step.to;
            last.energy_released += step.energy_released;
            last.is_over = step.is_over;
        }
        None => snaps.push(step),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn load_steps_of_a_snap_are_one_until_it_is_over() {
        let mut snaps = Vec::new();
        let step = |from, is_over| Snap { from, to: from + 0.1, energy_released: 1.0, is_over };
        for step in [step(1.0, false), step(1.1, false), step(1.2, true), step(1.5, true)] {
            add_snap(&mut snaps, step);
        }
        let found: Vec<_> = snaps.iter().map(|s| (s.from, s.energy_released)).collect();
        assert_eq!(found, [(1.0, 3.0), (1.5, 1.0)]);
    }
}
