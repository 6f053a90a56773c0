//! The division of a profile into segments (section 2 of the paper).

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::arc_length::piece_length;
use crate::compass::Samples;
use crate::levenberg_marquardt::{Chords, Minimum, minimise};
use crate::polygon::first_crossing;
use crate::{GeometryError, Profile};

/// The most segments a profile is divided into.
const MOST_SEGMENTS: usize = 1_000_000;
/// The shortest mean segment, over the largest coordinate.
const FINEST_SEGMENT: f64 = 1e-12;
/// The shortest mean segment, whatever the coordinates: products of lengths stay far from underflow.
const SHORTEST_SEGMENT: f64 = 1e-100;
/// How well the length is known before the resolution is checked, over the largest coordinate.
const LENGTH_ACCURACY: f64 = 1e-13;
/// Pieces of the arc length table a segment, at least.
const PIECES_PER_SEGMENT: usize = 4;
/// Pieces of the arc length table a knot span, at least.
const PIECES_PER_SPAN: usize = 32;

/// How a profile is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum DivisionMethod {
    /// Segments of equal length: E of equation 2 is minimised.
    #[default]
    EqualLength,
}

/// What the caller chooses about a division.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DivisionOptions {
    /// How.
    pub method: DivisionMethod,
    /// The iteration ends once |R_max| (dimensionless) is at most this; 0 asks for all that rounding allows.
    pub tolerance: f64,
    /// It ends after so many linear solves in any case.
    pub max_iterations: usize,
}

impl Default for DivisionOptions {
    fn default() -> Self {
        Self {
            method: DivisionMethod::EqualLength,
            tolerance: 1e-14,
            max_iterations: 200,
        }
    }
}

/// Why the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ending {
    /// |R_max| is within the tolerance.
    Tolerance,
    /// |R_max| is above the tolerance, but as small as the rounding of points and parameters lets it be.
    Rounding,
    /// No further step lowers E: a local minimum with unequal segments, or a corner of the curve in the way.
    Stalled,
    /// The iteration limit came first.
    Iterations,
}

/// A profile divided into segments.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Division {
    /// The sampling points s_1 … s_{Nr+1} as (x, z); bitwise Γ at `parameters`. The last equals the first where Γ is closed.
    pub points: Vec<DVec2>,
    /// Their parameters, strictly rising from 0 to 1.
    pub parameters: Vec<f64>,
    /// h̄, in the unit of the profile.
    pub mean_length: f64,
    /// |R_max| = max |h_k − h̄| / h̄.
    pub max_residual: f64,
    /// |R_ave| = Σ |h_k − h̄| / h̄ / Nr.
    pub mean_residual: f64,
    /// Linear solves made.
    pub iterations: usize,
    /// Why it ended.
    pub ending: Ending,
}

impl Division {
    /// Whether the segments are equal within the tolerance or within rounding.
    pub fn converged(&self) -> bool {
        matches!(self.ending, Ending::Tolerance | Ending::Rounding)
    }

    /// The length of the divided polygon, Nr h̄.
    pub fn length(&self) -> f64 {
        self.mean_length * (self.points.len() - 1) as f64
    }
}

/// Divides the profile into `segments` chords.
///
/// Equal length starts from points even in arc length, so that among several equal divisions the one near them is
/// taken. On ordinary curves |R_max| ends near ε (Nr + coordinate size / h̄): below 1e-13 up to some hundred segments. If
/// the iteration stalls, chords stepped off with compasses are a second start, and the better of the two ends is kept.
///
/// Limit: a hairpin or an acute corner tighter than a chord, at which a chord's length is least near the turn, can stall both
/// starts in a local minimum of E, typically at |R_max| ≈ 1e-2 (7 to 11 % of simple curves through 4 to 8 random control
/// points; gentle turns and corners of a right angle or more converged in every test). Such a division is
/// returned as it is: see [`Division::converged`]. One row more or fewer often helps.
///
/// # Errors
/// No segment, fewer than 3 for a closed profile, or more than a million; a negative or NaN tolerance; segments below
/// 1e-12 of the largest coordinate or 1e-100; a profile ([`Profile::check_simple`]) or a divided polygon (exact) that meets itself.
pub fn divide(
    profile: &Profile,
    segments: usize,
    options: &DivisionOptions,
) -> Result<Division, GeometryError> {
    check_request(profile, segments, options)?;
    let length = profile.arc_length(LENGTH_ACCURACY * profile.magnitude());
    check_resolution(length / segments as f64, profile)?;
    profile.check_simple()?;
    let DivisionMethod::EqualLength = options.method;
    let best = equal_length(profile, segments, options)?;
    finish(profile, best)
}

/// As [`divide`], with segments of equal length, from the caller's start: parameters that rise strictly from 0 to 1.
///
/// # Errors
/// As [`divide`]; parameters that do not rise so.
pub fn divide_from(
    profile: &Profile,
    start: &[f64],
    options: &DivisionOptions,
) -> Result<Division, GeometryError> {
    check_request(profile, start.len().saturating_sub(1), options)?;
    check_start(start)?;
    profile.check_simple()?;
    let minimum = minimise(
        profile,
        start.to_vec(),
        options.tolerance,
        options.max_iterations,
    )?;
    finish(profile, minimum)
}

/// Scales the profile so that its divided polygon is `length` long (within rounding), and divides it.
///
/// # Errors
/// As [`divide`]; a length that is not positive and finite, or that takes the profile out of range.
pub fn divide_to_length(
    profile: &Profile,
    segments: usize,
    length: f64,
    options: &DivisionOptions,
) -> Result<(Profile, Division), GeometryError> {
    if !(length > 0.0 && length.is_finite()) {
        return Err(GeometryError::Length { value: length });
    }
    let unscaled = divide(profile, segments, options)?;
    let scaled = profile.scaled(length / unscaled.length())?;
    // Scaling changes no residual; the points are taken anew so that they lie on the scaled curve.
    let chords = Chords::new(&scaled, &unscaled.parameters)?;
    let minimum = Minimum {
        parameters: unscaled.parameters,
        chords,
        iterations: unscaled.iterations,
        ending: unscaled.ending,
    };
    let division = finish(&scaled, minimum)?;
    Ok((scaled, division))
}

fn equal_length(
    profile: &Profile,
    segments: usize,
    options: &DivisionOptions,
) -> Result<Minimum, GeometryError> {
    let run = |start| minimise(profile, start, options.tolerance, options.max_iterations);
    let table = LengthTable::new(profile, segments);
    let start = table.even(segments);
    // Points that coincide in u are nearer than f64 resolves.
    check_start(&start).map_err(|_| too_short(0.0, profile))?;
    let first = run(start)?;
    if first.ending != Ending::Stalled {
        return Ok(first);
    }
    let Some(start) = table.stepped_off(profile, segments) else {
        return Ok(first);
    };
    let second = run(start)?;
    let better = second.chords.energy() < first.chords.energy();
    Ok(if better { second } else { first })
}

fn finish(profile: &Profile, minimum: Minimum) -> Result<Division, GeometryError> {
    let chords = minimum.chords;
    if let Some(crossing) = first_crossing(&chords.points, profile.is_closed()) {
        return Err(GeometryError::PolygonCrosses {
            segments: crossing.segments,
            point: crossing.point,
        });
    }
    Ok(Division {
        mean_length: chords.mean,
        max_residual: chords.max_residual(),
        mean_residual: chords.mean_residual(),
        points: chords.points,
        parameters: minimum.parameters,
        iterations: minimum.iterations,
        ending: minimum.ending,
    })
}

/// Arc length along a profile in pieces fine enough to start a division from.
struct LengthTable {
    parameters: Vec<f64>,
    /// Arc length from u = 0 to each parameter.
    lengths: Vec<f64>,
}

impl LengthTable {
    fn new(profile: &Profile, segments: usize) -> Self {
        let breakpoints = profile.curve().breakpoints();
        let spans = breakpoints.len() - 1;
        let pieces = PIECES_PER_SPAN.max((PIECES_PER_SEGMENT * segments).div_ceil(spans));
        let inner = breakpoints.windows(2).flat_map(|span| {
            let (start, width) = (span[0], span[1] - span[0]);
            (0..pieces).map(move |k| start + width * (k as f64 / pieces as f64))
        });
        let parameters: Vec<_> = inner.chain([1.0]).collect();
        let mut lengths = vec![0.0];
        let mut length = 0.0;
        for u in parameters.windows(2) {
            length += piece_length(profile.curve(), u[0], u[1]);
            lengths.push(length);
        }
        Self {
            parameters,
            lengths,
        }
    }

    fn total(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Parameters even in arc length, by linear interpolation.
    fn even(&self, segments: usize) -> Vec<f64> {
        let (u, s) = (&self.parameters, &self.lengths);
        let inner = (1..segments).map(|k| {
            let target = self.total() * (k as f64 / segments as f64);
            let above = s.partition_point(|&length| length <= target);
            let b = above.clamp(1, s.len() - 1);
            let share = (target - s[b - 1]) / (s[b] - s[b - 1]);
            u[b - 1] + (u[b] - u[b - 1]) * share
        });
        std::iter::once(0.0).chain(inner).chain([1.0]).collect()
    }

    /// Parameters of chords stepped off with compasses.
    fn stepped_off(&self, profile: &Profile, segments: usize) -> Option<Vec<f64>> {
        let points = self.parameters.iter().map(|&u| profile.position(u));
        let samples = Samples {
            points: points.collect(),
            parameters: self.parameters.clone(),
        };
        samples.step_off(segments, self.total())
    }
}

fn check_request(
    profile: &Profile,
    segments: usize,
    options: &DivisionOptions,
) -> Result<(), GeometryError> {
    let minimum = if profile.is_closed() { 3 } else { 1 };
    if !(minimum..=MOST_SEGMENTS).contains(&segments) {
        return Err(GeometryError::SegmentCount {
            count: segments,
            minimum,
            maximum: MOST_SEGMENTS,
        });
    }
    if options.tolerance.is_nan() || options.tolerance < 0.0 {
        return Err(GeometryError::Tolerance {
            value: options.tolerance,
        });
    }
    Ok(())
}

fn check_start(parameters: &[f64]) -> Result<(), GeometryError> {
    let last = parameters.len() - 1;
    for (index, &value) in parameters.iter().enumerate() {
        let right = match index {
            0 => value == 0.0,
            _ => value > parameters[index - 1] && (index < last || value == 1.0),
        };
        if !right {
            return Err(GeometryError::Start { index, value });
        }
    }
    Ok(())
}

/// Whether chords of this mean length can be told from rounding.
pub(crate) fn check_resolution(length: f64, profile: &Profile) -> Result<(), GeometryError> {
    if length > shortest_segment(profile) {
        return Ok(());
    }
    Err(too_short(length, profile))
}

fn too_short(length: f64, profile: &Profile) -> GeometryError {
    GeometryError::SegmentTooShort {
        length,
        minimum: shortest_segment(profile),
    }
}

fn shortest_segment(profile: &Profile) -> f64 {
    SHORTEST_SEGMENT.max(FINEST_SEGMENT * profile.magnitude())
}
