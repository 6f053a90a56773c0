//! The passes of the dynamic engine on a GPU, in f32.
//!
//! The shader is `shaders/solver.wgsl`; its passes have the names and the order of those on the CPU (`passes`), which are
//! their twins: tests compare them pass by pass. Places are kept as the flat crease pattern plus a displacement, and
//! differences of the pattern come from f64, so that rounding grows with the motion and not with the sheet. Forces agree
//! with the CPU's to some 1e-5 of the stiffest bar's for sheets of some ten thousand nodes: an f32 has 24 bits, and a
//! displacement of a hundred unit lengths leaves 1e-5 of one.
//!
//! Limits. The motion of a whole run stays on the CPU for now: here a state can be stepped and relaxed, for whoever wants
//! many nodes and has the card. The residual of a relaxation has a floor of about 1e-4 for the same reason.

mod buffers;
mod control;
mod device;
mod state;
mod tables;
#[cfg(test)]
mod tests;

pub use device::Gpu;
pub use state::{GpuState, GpuTotals};
