//! The chords between points of a profile, and the shortest length that f64 resolves.

use glam::DVec2;

use crate::{GeometryError, Profile};

/// The shortest mean segment, relative to the largest coordinate.
const FINEST_SEGMENT: f64 = 1e-12;
/// The shortest mean segment in absolute terms, chosen so that products of lengths stay far from underflow.
const SHORTEST_SEGMENT: f64 = 1e-100;

/// The chords between consecutive points of the profile.
#[derive(Debug, Clone)]
pub(crate) struct Chords {
    pub(crate) points: Vec<DVec2>,
    pub(crate) mean: f64,
    /// The residuals r_k of equation 1.
    pub(crate) residuals: Vec<f64>,
}

impl Chords {
    /// # Errors
    /// A mean chord that f64 does not resolve at the size of the coordinates.
    pub(crate) fn new(profile: &Profile, parameters: &[f64]) -> Result<Self, GeometryError> {
        let points: Vec<_> = parameters.iter().map(|&u| profile.position(u)).collect();
        let lengths: Vec<_> = points.windows(2).map(|p| p[0].distance(p[1])).collect();
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        check_resolution(mean, profile)?;
        Ok(Self { points, mean, residuals: lengths.iter().map(|h| (h - mean) / mean).collect() })
    }

    /// The energy E of equation 2.
    pub(crate) fn energy(&self) -> f64 {
        0.5 * dot(&self.residuals, &self.residuals)
    }

    /// The largest residual, |R_max|.
    pub(crate) fn max_residual(&self) -> f64 {
        self.residuals.iter().fold(0.0, |max, r| r.abs().max(max))
    }

    /// The mean residual, |R_ave|.
    pub(crate) fn mean_residual(&self) -> f64 {
        let sum: f64 = self.residuals.iter().map(|r| r.abs()).sum();
        sum / self.residuals.len() as f64
    }
}

/// Checks that chords of this mean length can be told from rounding.
pub(crate) fn check_resolution(length: f64, profile: &Profile) -> Result<(), GeometryError> {
    if length > shortest_segment(profile) {
        return Ok(());
    }
    Err(too_short(length, profile))
}

pub(crate) fn too_short(length: f64, profile: &Profile) -> GeometryError {
    GeometryError::SegmentTooShort { length, minimum: shortest_segment(profile) }
}

fn shortest_segment(profile: &Profile) -> f64 {
    SHORTEST_SEGMENT.max(FINEST_SEGMENT * profile.magnitude())
}

/// The scalar product of two vectors of equal length.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
