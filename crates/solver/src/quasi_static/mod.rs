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
mod release;
mod run;
mod snap;
mod snap_control;
mod stall;
mod step_control;
mod stiffness_matrix;
mod support;

pub use contact::Contact;
pub use effort::Effort;
pub use hinge_hessian::fold_angle_hessian;
pub use jam::FOLDED_WITHIN_DEG;
pub use options::QuasiStaticOptions;
pub use outcome::{FrameFigures, Jam, QuasiStaticRun, StageOutcome, Stop, StopReason};
pub use release::Release;
pub use run::run_quasi_static;
pub use snap::Snap;
pub use snap_control::SnapControl;
pub use support::Support;

use configuration::Configuration;
use glam::DVec3;

use crate::Model;

/// The force by which residuals are judged: the moment of the stiffer kind of hinge at one radian per unit length, at
/// a lever of one unit length. In the model's units.
pub fn force_scale(model: &Model) -> f64 {
    model.material.fold_stiffness.max(model.material.facet_stiffness)
}

/// κ g of contact: a share of what hinges push with, or of bars strained by a thousandth if that is more.
fn contact_force(model: &Model, snap_control: SnapControl) -> f64 {
    snap_control.contact_share() * force_scale(model).max(1e-3 * model.material.axial_stiffness)
}

/// The nodal force that rounding alone may leave: positions are known to ε |x|, which bars multiply by their stiffness,
/// and hinges and face angles by theirs over the square of a height at rest.
fn rounding_force(model: &Model, positions: &[DVec3]) -> f64 {
    let size = |nodes: &[u32]| nodes.iter().map(|&v| positions[v as usize].length()).sum::<f64>();
    let height = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|v| model.pattern[v as usize]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (b - a).perp_dot(c - a).abs() / longest
    };
    let bars = model.bars.iter().map(|bar| bar.stiffness * size(&bar.vertices));
    let hinges = model.hinges.iter().map(|hinge| {
        let [a, b, left, right] = hinge.vertices;
        let least = height([a, b, left]).min(height([a, b, right]));
        hinge.stiffness * size(&[a, b]) / (least * least)
    });
    let faces = model.face_angles.iter().map(|face| {
        let least = height(face.vertices);
        model.material.face_angle_stiffness * size(&face.vertices[..2]) / (least * least)
    });
    8.0 * f64::EPSILON * bars.chain(hinges).chain(faces).fold(0.0, f64::max)
}
