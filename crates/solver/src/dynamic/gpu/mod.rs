//! The passes of the dynamic engine on a GPU, in f32.
//!
//! The shader is `shaders/solver.wgsl`; its passes have the names and the order of those on the CPU (`passes`), which
//! are their twins: tests compare them pass by pass. Places are kept as the flat crease pattern plus a displacement,
//! and differences of the pattern come from f64, so that rounding grows with the motion and not with the sheet. Forces
//! agree with the CPU's to some 1e-5 of the stiffest bar's for sheets of some ten thousand nodes: an f32 has 24 bits,
//! and a displacement of a hundred unit lengths leaves 1e-5 of one.
//!
//! In a run ([`Device`](super::Device)) the GPU moves the sheet and settles it to what f32 leaves, about 1e-4 of the
//! fold stiffness for a sheet of some ten unit lengths; finer tolerances, those of the last degrees of a fold, are the
//! CPU's.

mod buffers;
mod control;
mod cost;
mod device;
mod drive;
mod state;
mod tables;
#[cfg(test)]
mod tests;

pub use device::Gpu;
pub(super) use drive::GpuDrive;
pub use state::{GpuState, GpuTotals};
