//! What a study says of a motion beside its frames.

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::CompactBox;
use glam::DVec3;

use crate::UnitStudy;

/// Points of the profile in a figure.
const POINTS: u32 = 240;

/// The exact states and closed forms of a sheet of units.
#[derive(Debug, Clone)]
pub(crate) struct Known {
    /// The deployed state, upright.
    pub(crate) deployed: Vec<DVec3>,
    /// The flat sheet.
    pub(crate) planar: Vec<DVec3>,
    /// The exact compact state.
    pub(crate) compact: Vec<DVec3>,
    /// Of the compact box.
    pub(crate) closed_form: Option<CompactBox>,
    /// Γ beside the deployed state.
    pub(crate) profile: Vec<DVec3>,
    /// The sizes of the units, where all are equal.
    pub(crate) units: Option<UnitSizes>,
}

/// The sizes of a sheet of equal units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UnitSizes {
    /// w.
    pub(crate) width: f64,
    /// h.
    pub(crate) height: f64,
    /// Nc.
    pub(crate) columns: usize,
}

impl UnitStudy {
    /// A state at motion time `time`, turned as its stage is shown: upright until it is flat, then as the compact state
    /// lies. `positions`: one for each vertex of the sheet.
    pub fn turned(&self, time: f64, positions: &[DVec3]) -> Vec<DVec3> {
        turned(&self.known(), time, positions)
    }

    pub(crate) fn known(&self) -> Known {
        let point = |k: u32| {
            let p = self.profile.position(f64::from(k) / f64::from(POINTS));
            DVec3::new(p.x, 0.0, p.y)
        };
        let sizes = || UnitSizes {
            width: self.units.unit.width,
            height: self.units.unit.height,
            columns: self.units.columns,
        };
        Known {
            units: self.units.has_equal_rows().then(sizes),
            deployed: self.deployed.clone(),
            planar: self.units.sheet.planar(),
            compact: self.units.compact(),
            closed_form: self.closed_form,
            profile: (0..=POINTS).map(point).collect(),
        }
    }
}

/// A state at motion time `time`, turned as its stage is shown: upright until it is flat, then as the compact state lies.
pub(crate) fn turned(known: &Known, time: f64, positions: &[DVec3]) -> Vec<DVec3> {
    let target = match time {
        t if t < 1.0 => &known.deployed,
        1.0 => &known.planar,
        _ => &known.compact,
    };
    let fit = RigidMotion::best_fit(positions, target);
    positions.iter().map(|&p| fit.apply(p)).collect()
}
