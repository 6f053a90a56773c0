//! The division of a profile into segments (section 2 of the paper).

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::chain;
use crate::chords::{Chords, check_resolution, too_short};
use crate::douglas_peucker::split;
use crate::length_table::LengthTable;
use crate::levenberg_marquardt::{Ending, Minimum, minimise};
use crate::polygon::first_crossing;
use crate::{GeometryError, Profile};

/// The largest number of segments of a division.
const MOST_SEGMENTS: usize = 1_000_000;
/// Parameters of one division reached from two starts, at most apart.
const SAME_DIVISION: f64 = 1e-9;

/// How a profile is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum DivisionMethod {
    /// Segments of equal length: E of equation 2 is minimised.
    #[default]
    EqualLength,
    /// Segments at equal steps of the parameter u.
    Parametric,
    /// The segment from which the curve deviates most is split repeatedly (Douglas and Peucker 1973).
    DouglasPeucker,
}

/// The choices that the caller has about a division.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DivisionOptions {
    /// The method by which the profile is divided.
    pub method: DivisionMethod,
    /// The iteration ends once |R_max| (dimensionless) is at most this; 0 continues as far as rounding allows.
    pub tolerance: f64,
    /// The iteration ends after this many linear solves in any case.
    pub max_iterations: usize,
}

impl Default for DivisionOptions {
    fn default() -> Self {
        Self { method: DivisionMethod::EqualLength, tolerance: 1e-14, max_iterations: 200 }
    }
}

/// A profile divided into segments.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Division {
    /// The sampling points s_1 … s_{Nr+1} as (x, z), bitwise Γ at `parameters`. The last equals the first if Γ is
    /// closed.
    pub points: Vec<DVec2>,
    /// The parameters of the points, strictly increasing from 0 to 1.
    pub parameters: Vec<f64>,
    /// The mean segment length h̄, in the unit of the profile.
    pub mean_length: f64,
    /// The largest residual, |R_max| = max |h_k − h̄| / h̄.
    pub max_residual: f64,
    /// The mean residual, |R_ave| = Σ |h_k − h̄| / h̄ / Nr.
    pub mean_residual: f64,
    /// The number of linear solves.
    pub iterations: usize,
    /// The reason why the iteration ended.
    pub ending: Ending,
}

impl Division {
    /// Whether the segments are equal within the tolerance or within rounding.
    pub fn converged(&self) -> bool {
        self.ending.converged()
    }

    /// The length of the divided polygon, Nr h̄.
    pub fn length(&self) -> f64 {
        self.mean_length * (self.points.len() - 1) as f64
    }
}

/// Divides the profile into `segments` chords.
///
/// *Equal length* starts from points at equal steps of arc length, so that of several equal divisions the one near them
/// is found. On ordinary curves |R_max| ends near ε (Nr + coordinate size / h̄): below 1e-13 for up to some hundred
/// segments. If a turn tighter than a chord holds the iteration in a local minimum of E, chains of equal chords are
/// continued along the curve to its end; an open curve that does not meet itself has an equal division there. If that
/// fails too (chains that shrink into an acute seam of a closed profile: 0.3 % of random curves with such turns, of
/// which the iteration alone misses 7 to 11 %), the best division found is returned: see [`Division::converged`]. Cost:
/// linear in `segments` without such turns.
///
/// *Douglas–Peucker* splits the segment from which the curve deviates most until there are `segments`; distances are
/// those of samples, at least 64 for each segment. See [`simplify`] for a tolerance instead of a number.
///
/// # Errors
/// No segment, fewer than 3 for a closed profile, or more than a million; a negative or NaN tolerance; segments below
/// 1e-12 of the largest coordinate or 1e-100; a profile ([`Profile::check_simple`]) or a divided polygon (exact) that
/// meets itself; more segments than samples for Douglas–Peucker, as on a straight line.
pub fn divide(
    profile: &Profile,
    segments: usize,
    options: &DivisionOptions,
) -> Result<Division, GeometryError> {
    check_request(profile, segments, options)?;
    let table = LengthTable::new(profile, segments);
    check_resolution(table.total() / segments as f64, profile)?;
    profile.check_simple()?;
    let minimum = match options.method {
        DivisionMethod::EqualLength => equal_length(profile, segments, &table, options)?,
        DivisionMethod::Parametric => {
            let even = (0..=segments).map(|k| k as f64 / segments as f64);
            direct(profile, even.collect())?
        }
        DivisionMethod::DouglasPeucker => direct(profile, split(profile, segments, 0.0)?)?,
    };
    finish(profile, minimum)
}

/// Divides the profile by Douglas and Peucker's method into as few chords as keep it within `tolerance` of them.
///
/// `tolerance` is a distance relative to the length of the profile, so that scaling changes nothing. Distances are
/// those of samples, as in [`divide`].
///
/// # Errors
/// As for [`divide`]; a tolerance outside (0, 1), or one that leaves a single segment (fewer than 3 of a closed
/// profile).
pub fn simplify(profile: &Profile, tolerance: f64) -> Result<Division, GeometryError> {
    if !(tolerance > 0.0 && tolerance < 1.0) {
        return Err(GeometryError::SplitTolerance { tolerance });
    }
    let table = LengthTable::new(profile, 1);
    check_resolution(table.total(), profile)?;
    profile.check_simple()?;
    let parameters = split(profile, MOST_SEGMENTS, tolerance * table.total())?;
    let segments = parameters.len() - 1;
    let minimum = if profile.is_closed() { 3 } else { 2 };
    if segments < minimum {
        return Err(GeometryError::TooCoarse { tolerance, segments, minimum });
    }
    finish(profile, direct(profile, parameters)?)
}

/// Divides the profile as [`divide`] does, with segments of equal length, starting from the caller's parameters, which
/// increase strictly from 0 to 1.
///
/// The start decides how the iteration runs, never which division is returned: if it leads to another equal division
/// than points at equal steps of arc length do, or to none, the division from those points is returned.
///
/// # Errors
/// As for [`divide`]; parameters that do not increase strictly from 0 to 1.
pub fn divide_from(
    profile: &Profile,
    start: &[f64],
    options: &DivisionOptions,
) -> Result<Division, GeometryError> {
    check_request(profile, start.len().saturating_sub(1), options)?;
    check_start(start)?;
    profile.check_simple()?;
    let segments = start.len() - 1;
    let table = LengthTable::new(profile, segments);
    check_resolution(table.total() / segments as f64, profile)?;
    let own = run(profile, start.to_vec(), options)?;
    let even = equal_length(profile, segments, &table, options)?;
    let same = |u: (&f64, &f64)| (u.0 - u.1).abs() <= SAME_DIVISION;
    let reached = own.converged() && own.parameters.iter().zip(&even.parameters).all(same);
    let better = reached || (own.converged() && !even.converged());
    finish(profile, if better { own } else { even })
}

/// Scales the profile so that its divided polygon is `length` long (within rounding), and divides it.
///
/// # Errors
/// As for [`divide`]; a length that is not positive and finite, or that takes the profile out of range.
pub fn divide_to_length(
    profile: &Profile,
    segments: usize,
    length: f64,
    options: &DivisionOptions,
) -> Result<(Profile, Division), GeometryError> {
    check_length(length)?;
    scaled_to_length(profile, divide(profile, segments, options)?, length)
}

/// Scales and divides the profile as [`divide_to_length`] does, with the method of [`simplify`].
///
/// # Errors
/// As for [`simplify`] and [`divide_to_length`].
pub fn simplify_to_length(
    profile: &Profile,
    tolerance: f64,
    length: f64,
) -> Result<(Profile, Division), GeometryError> {
    check_length(length)?;
    scaled_to_length(profile, simplify(profile, tolerance)?, length)
}

fn scaled_to_length(
    profile: &Profile,
    unscaled: Division,
    length: f64,
) -> Result<(Profile, Division), GeometryError> {
    let scaled = profile.scaled(length / unscaled.length())?;
    // Scaling changes no residual; the points are computed anew so that they lie on the scaled curve.
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

fn run(
    profile: &Profile,
    start: Vec<f64>,
    options: &DivisionOptions,
) -> Result<Minimum, GeometryError> {
    minimise(profile, start, options.tolerance, options.max_iterations)
}

fn equal_length(
    profile: &Profile,
    segments: usize,
    table: &LengthTable,
    options: &DivisionOptions,
) -> Result<Minimum, GeometryError> {
    let even = table.even(segments).map_err(|_| too_short(0.0, profile))?;
    let mut best = run(profile, even, options)?;
    if best.converged() || segments < 3 {
        return Ok(best);
    }
    for start in chain::divisions(profile, segments, table) {
        let next = run(profile, start, options)?;
        let iterations = best.iterations + next.iterations;
        if next.chords.energy() < best.chords.energy() {
            best = next;
        }
        best.iterations = iterations;
        if best.converged() {
            break;
        }
    }
    Ok(best)
}

fn direct(profile: &Profile, parameters: Vec<f64>) -> Result<Minimum, GeometryError> {
    Ok(Minimum {
        chords: Chords::new(profile, &parameters)?,
        parameters,
        iterations: 0,
        ending: Ending::Direct,
    })
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
        return Err(GeometryError::Tolerance { value: options.tolerance });
    }
    Ok(())
}

fn check_length(length: f64) -> Result<(), GeometryError> {
    if length > 0.0 && length.is_finite() {
        return Ok(());
    }
    Err(GeometryError::Length { value: length })
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
