//! The quasi-static engine: the sheet folded slowly, in equilibrium at every load step.
//!
//! The energy is that of [`crate::Model`], the same the dynamic engine moves by. At each load step its minimum is found
//! by Newton's method with line search and sparse Cholesky factorisation, warm-started from the last equilibria. With
//! [`Contact`] the layers push on each other and cannot pass through one another.
//!
//! Limits. The path is that of a sheet folded slowly: where equilibrium is lost it snaps to the next, and which one
//! that is depends on the step of the search. Layers keep the gap in contact, which [`Contact::final_gap`] closes at the
//! end: compact extents then exceed the closed form by at most the layers met times that gap, or, where bars are too
//! stiff to make room by straining, by what creases open by an angle of the order of its root.

mod cholesky;
mod closing;
mod configuration;
mod contact;
mod effort;
mod element_stiffness;
mod face_angle_hessian;
mod hinge_hessian;
mod history;
mod jam;
mod model_step;
mod newton;
mod options;
mod outcome;
mod run;
mod snap;
mod stall;
mod step_control;
mod stiffness_matrix;

pub use contact::Contact;
pub use effort::Effort;
pub use hinge_hessian::fold_angle_hessian;
pub use options::{QuasiStaticOptions, SnapControl, Support};
pub use outcome::{FrameFigures, Jam, QuasiStaticRun, StageOutcome, Stop, StopReason};
pub use snap::Snap;
pub use run::run_quasi_static;

use configuration::Configuration;
use glam::DVec3;

use crate::Model;

/// The force by which residuals are judged: the moment of the stiffer kind of hinge at one radian per unit length, at
/// a lever of one unit length. In the model's units.
pub fn force_scale(model: &Model) -> f64 {
    model.material.fold_stiffness.max(model.material.facet_stiffness)
}

/// κ g of contact: a tenth of what hinges push with, or of bars strained by a thousandth if that is more. Multipliers
/// carry the rest: the stiffer the planes, the more rounds it takes to find which of them push.
///
/// A sheet that passes through snaps presses its layers together harder, before multipliers have grown: ten times that.
fn contact_force(model: &Model, snap_control: SnapControl) -> f64 {
    let share = match snap_control {
        SnapControl::Settle => 0.1,
        SnapControl::PassThrough => 1.0,
    };
    share * force_scale(model).max(1e-3 * model.material.axial_stiffness)
}

/// The nodal force that rounding alone may leave: positions are known to ε |x|, which bars multiply by their stiffness.
fn rounding_force(model: &Model, positions: &[DVec3]) -> f64 {
    let bar = |bar: &crate::Bar| {
        let [a, b] = bar.vertices.map(|v| positions[v as usize].length());
        bar.stiffness * (a + b)
    };
    8.0 * f64::EPSILON * model.bars.iter().map(bar).fold(0.0, f64::max)
}
