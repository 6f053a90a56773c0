//! f64 mathematics that can be proved.
//!
//! Lengths are in the unit of the input, angles in radians. The profile lies in the x–z plane and is held as 2D
//! points (x, z); sheets live in 3D with the width along y.
//!
//! Fold angles follow the FOLD format: 0 flat, positive valley (the neighbouring facet rises on the front side),
//! negative mountain, ±π folded flat. The front of a facet is the side from which its vertices run counter-clockwise.

mod aabb;
mod arc_length;
mod chain;
mod chords;
mod closure;
pub mod collide;
mod compass;
mod dihedral;
mod distance;
mod division;
mod douglas_peucker;
mod error;
mod fit;
mod interpolation;
mod length_table;
mod levenberg_marquardt;
mod number;
mod nurbs;
mod orientation;
mod polygon;
mod profile;
mod rigid;
mod symmetric;
mod tridiagonal;
pub mod unfolding;

pub use aabb::Aabb;
pub use closure::Closure;
pub use dihedral::{fold_angle, fold_angle_gradient, nearest_turn};
pub use distance::{Closest, segment_segment, triangle_triangle};
pub use division::{
    Division, DivisionMethod, DivisionOptions, divide, divide_from, divide_to_length, simplify,
    simplify_to_length,
};
pub use error::GeometryError;
pub use fit::Fit;
pub use levenberg_marquardt::Ending;
pub use number::Number;
pub use nurbs::Nurbs;
pub use polygon::{Crossing, first_crossing};
pub use profile::Profile;
pub use rigid::RigidMotion;
