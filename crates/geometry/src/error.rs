//! The errors of a profile or its division, with the evidence.

use glam::DVec2;
use thiserror::Error;

use crate::Number;

/// Why a profile cannot be built or divided.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// A cubic curve needs four control points.
    #[error("the profile has {count} control points; at least {minimum} are needed")]
    TooFewControlPoints {
        /// How many were given.
        count: usize,
        /// How many are needed.
        minimum: usize,
    },
    /// A control point is NaN, infinite or too large to be squared.
    #[error(
        "control point {index} is ({}, {}); coordinates must be finite and at most {} in size", Number(*x), Number(*z), Number(*limit)
    )]
    ControlPoint {
        /// The index of the control point, from 0.
        index: usize,
        /// Its x coordinate.
        x: f64,
        /// Its z coordinate.
        z: f64,
        /// The largest absolute value allowed.
        limit: f64,
    },
    /// Too few or too many points for a curve through them.
    #[error(
        "the outline has {count} points; {minimum} to {maximum} are allowed, at least {minimum} of them distinct"
    )]
    PointCount {
        /// How many were given.
        count: usize,
        /// 2, or 3 for a closed outline.
        minimum: usize,
        /// The largest number of points.
        maximum: usize,
    },
    /// A point is NaN, infinite or too large to be squared.
    #[error(
        "point {index} is ({}, {}); coordinates must be finite and at most {} in size", Number(*x), Number(*z), Number(*limit)
    )]
    Point {
        /// The index of the point, from 0.
        index: usize,
        /// Its x coordinate.
        x: f64,
        /// Its z coordinate.
        z: f64,
        /// The largest absolute value allowed.
        limit: f64,
    },
    /// Two consecutive points are equal or nearly so.
    #[error("points {index} and {next} are both at ({}, {}) or too close to it; remove one", Number(*x), Number(*z), next = index + 1)]
    RepeatedPoint {
        /// The index of the first of the two, from 0.
        index: usize,
        /// Its x coordinate.
        x: f64,
        /// Its z coordinate.
        z: f64,
    },
    /// A closed outline ends far from its start.
    #[error(
        "the closed outline ends {:.6} away from its start, more than twice its longest step ({:.6}); repeat its first point as the last, or do not declare it closed", Number(*gap), Number(*longest)
    )]
    EndsApart {
        /// The distance between the first and the last point.
        gap: f64,
        /// The longest distance between consecutive points.
        longest: f64,
    },
    /// The knot vector does not fit the control points.
    #[error("{count} knots for {control_points} control points; a cubic curve needs {expected}")]
    KnotCount {
        /// How many knots were given.
        count: usize,
        /// How many control points they are for, a repeated closing point included.
        control_points: usize,
        /// How many knots are needed: the number of control points + 4.
        expected: usize,
    },
    /// A knot is NaN or infinite.
    #[error("knot {index} is {}; knots must be finite", Number(*value))]
    KnotNotFinite {
        /// The index of the knot, from 0.
        index: usize,
        /// The value of the knot.
        value: f64,
    },
    /// The knots decrease.
    #[error(
        "knot {index} is {}, below the knot before it, {}; knots must not decrease", Number(*value), Number(*previous)
    )]
    KnotsDecrease {
        /// The index of the knot, from 0.
        index: usize,
        /// The value of the knot before it.
        previous: f64,
        /// The value of the knot.
        value: f64,
    },
    /// The range of the knots is empty or infinite.
    #[error(
        "the curve runs from knot {} to knot {}; the end must be above the start by a finite amount", Number(*start), Number(*end)
    )]
    KnotRange {
        /// The knot at which the curve starts (index 3).
        start: f64,
        /// The knot at which it ends (index = number of control points).
        end: f64,
    },
    /// A knot is repeated so often that the curve breaks.
    #[error(
        "the knot at u = {u} is repeated {count} times; at most {limit} times are allowed there"
    )]
    KnotMultiplicity {
        /// The value of the knot, normalised to [0, 1].
        u: f64,
        /// How often the value is repeated.
        count: usize,
        /// How often it may be repeated: 3 times inside the curve, 4 times at its ends.
        limit: usize,
    },
    /// Two knots differ by so little that derivatives lose their digits.
    #[error("knots {index} and {next} are {:.3} of the range apart; make them equal or at least {} apart", Number(*width), Number(*minimum), next = index + 1)]
    KnotSpanTooNarrow {
        /// The index of the first of the two, from 0.
        index: usize,
        /// Their distance, relative to the knot range.
        width: f64,
        /// The smallest distance allowed.
        minimum: f64,
    },
    /// Knots were given for a smooth closed profile, whose knots are uniform.
    #[error(
        "a profile that is closed smoothly has uniform knots; leave the knots out or close it with a corner"
    )]
    KnotsOfSmoothProfile,
    /// A closed profile with its own knots does not end at its start.
    #[error(
        "the closed profile ends {:.6} away from its start; clamp its knots (repeat the first and the last four times)", Number(*gap)
    )]
    NotClosed {
        /// The distance between its start and its end.
        gap: f64,
    },
    /// The scale is not a positive number, or takes the profile out of range.
    #[error(
        "the profile cannot be scaled by {}; a positive, finite factor of moderate size is needed", Number(*factor)
    )]
    Scale {
        /// The factor that was given.
        factor: f64,
    },
    /// The requested length is not a positive number.
    #[error("the requested polygon length is {}; it must be positive and finite", Number(*value))]
    Length {
        /// The length that was requested.
        value: f64,
    },
    /// Too few or too many segments.
    #[error("the division has {count} segments; this profile needs {minimum} to {maximum}")]
    SegmentCount {
        /// How many segments were requested.
        count: usize,
        /// The smallest number: 1, or 3 for a closed profile.
        minimum: usize,
        /// The largest number supported.
        maximum: usize,
    },
    /// Segments too short for f64 to distinguish their ends.
    #[error(
        "the mean segment is {:.3} long, below {:.3}, what f64 resolves at coordinates of this size; use fewer segments", Number(*length), Number(*minimum)
    )]
    SegmentTooShort {
        /// The mean length of the segments.
        length: f64,
        /// The smallest length allowed.
        minimum: f64,
    },
    /// The tolerance is not a number of at least 0.
    #[error("the division tolerance is {}; it must be a number of at least 0", Number(*value))]
    Tolerance {
        /// The tolerance that was given.
        value: f64,
    },
    /// The tolerance of Douglas and Peucker's method is not between 0 and 1.
    #[error(
        "the tolerance is {}; as a distance over the length of the profile it must lie between 0 and 1", Number(*tolerance)
    )]
    SplitTolerance {
        /// The tolerance that was given.
        tolerance: f64,
    },
    /// The tolerance of Douglas and Peucker's method leaves too few segments.
    #[error(
        "a tolerance of {tolerance} times its length leaves {segments} of the profile's segments; at least {minimum} are needed: use a smaller one"
    )]
    TooCoarse {
        /// The tolerance that was given, relative to the length of the profile.
        tolerance: f64,
        /// How many segments it leaves.
        segments: usize,
        /// The smallest number: 2, or 3 for a closed profile.
        minimum: usize,
    },
    /// Douglas and Peucker's method found nothing more to split.
    #[error(
        "only {possible} segments can be told apart by their distance from the curve, {count} are requested; use fewer, or another method"
    )]
    NothingToSplit {
        /// How many segments were requested.
        count: usize,
        /// How many segments are possible.
        possible: usize,
    },
    /// The parameters from which a division was to start do not increase from 0 to 1.
    #[error(
        "parameter {index} of the start is {value}; parameters must increase strictly from 0 to 1"
    )]
    Start {
        /// The index of the parameter, from 0.
        index: usize,
        /// The value of the parameter.
        value: f64,
    },
    /// The curve meets itself.
    #[error("the profile crosses itself near ({:.6}, {:.6}), at u = {:.6} and u = {:.6}; {}", point.x, point.y, parameters[0], parameters[1], uncrossed(*parameters))]
    CurveCrosses {
        /// The two parameters, in increasing order.
        parameters: [f64; 2],
        /// The point at which it meets itself, (x, z).
        point: DVec2,
    },
    /// The divided polygon meets itself although the curve does not.
    #[error("segments {} and {} of the divided profile cross near ({:.6}, {:.6}); use more rows or move the control points apart", segments[0], segments[1], point.x, point.y)]
    PolygonCrosses {
        /// The indices of the two segments, from 0, in increasing order.
        segments: [usize; 2],
        /// The point at which they cross, (x, z).
        point: DVec2,
    },
    /// The ends of a closed chain could not be separated.
    #[error(
        "the closed profile could not be opened at its seam: its first and last segment all but coincide; give them an angle"
    )]
    SeamClosed,
    /// The descent that straightens a chain ended before it was straight.
    #[error(
        "the profile could not be straightened: after {steps} steps its segments are {:.3} mean segments apart; move its layers apart", Number(*clearance)
    )]
    NotStraightened {
        /// The number of steps made.
        steps: usize,
        /// The smallest distance of segments that are not neighbours, in mean segments.
        clearance: f64,
    },
}

/// The advice for a curve that meets itself at two parameters.
fn uncrossed(parameters: [f64; 2]) -> &'static str {
    /// Crossings within this distance of both ends, in the parameter, count as meeting ends.
    const END: f64 = 0.02;
    if parameters[0] < END && parameters[1] > 1.0 - END {
        "its ends meet: close it (closed = \"corner\" or \"smooth\"), or move its points apart"
    } else {
        "a profile may not pass through itself there: move its points apart"
    }
}
