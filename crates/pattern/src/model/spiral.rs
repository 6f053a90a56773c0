//! Fermat's spiral, r² = a² θ, with both arms.

use foldmotion_geometry::Closure;
use glam::DVec2;

use super::{CaseColumns, ProfileModel, Shape};

/// Points of one arm, even in θ, at which the curve is held to the formula.
const POINTS_PER_ARM: usize = 60;

/// Both arms to θ = 6π, with a = 1: from the end of one through the centre to the end of the other.
pub(super) const FERMAT_SPIRAL: ProfileModel = ProfileModel {
    name: "fermat-spiral",
    title: "Fermat's spiral, both arms of three turns",
    shape: Shape::FermatSpiral { turns: 3.0 },
    closure: Closure::Open,
    rows: 100,
    columns: CaseColumns { e: 2, t: 3, s: 1, ours: true },
    source: "r^2 = a^2 theta (figure 6d of the paper); both arms to theta = 6 pi are ours",
};

/// The point at t = ±√θ, r = t: positive on one arm, negative on the other, smooth through the centre.
pub(super) fn point(t: f64) -> DVec2 {
    t * DVec2::from_angle(t * t)
}

/// Points along both arms of so many turns each.
pub(super) fn points(turns: f64) -> Vec<DVec2> {
    let end = std::f64::consts::TAU * turns;
    let arm = |k: usize| (end * k as f64 / POINTS_PER_ARM as f64).sqrt();
    let inward = (1..=POINTS_PER_ARM).rev().map(|k| point(-arm(k)));
    let outward = (0..=POINTS_PER_ARM).map(|k| point(arm(k)));
    inward.chain(outward).collect()
}
