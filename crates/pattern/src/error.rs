//! Why a sheet cannot be made.

use foldmotion_geometry::Number;
use thiserror::Error;

/// Errors of this crate; each carries the value found and what would be right.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PatternError {
    /// A size that must be positive and finite is not.
    #[error("{name} is {}: it must be a positive, finite number", Number(*value))]
    NotPositive {
        /// The name of the quantity or option.
        name: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// Rows or columns are missing or too many for 32-bit indices.
    #[error("{name} is {value}: it must lie between 1 and {limit}")]
    CountOutOfRange {
        /// `rows` or `columns`.
        name: &'static str,
        /// The value that was given.
        value: usize,
        /// The largest value allowed with the other count.
        limit: usize,
    },
    /// Width and height of the unit contradict the case.
    #[error(
        "case {case} needs units with {need}, but w = {:.9} and h = {:.9} (w/h = {:.9}); {remedy}",
        Number(*width),
        Number(*height),
        Number(width / height)
    )]
    CaseContradictsUnit {
        /// The name of the case that was requested.
        case: &'static str,
        /// The relation between w and h that the case needs.
        need: &'static str,
        /// The width w of the unit.
        width: f64,
        /// The height h of the unit.
        height: f64,
        /// What to change so that it works.
        remedy: &'static str,
    },
    /// λ is missing or out of range.
    #[error("lambda {}: case SII needs it strictly between 0 and 1", stated(*value))]
    LambdaOutOfRange {
        /// The value given, NaN where it is missing.
        value: f64,
    },
    /// λ of a common flap is out of range.
    #[error(
        "lambda is {}: one flap width for rows of unequal height needs it above 0 and at most 1", Number(*value)
    )]
    CommonFlapOutOfRange {
        /// The value that was given.
        value: f64,
    },
    /// d is out of range.
    #[error("offset d is {}: it must satisfy 0 <= d < w1' = {}", Number(*value), Number(*limit))]
    OffsetOutOfRange {
        /// The value that was given.
        value: f64,
        /// w1' = w/2 − λh/2.
        limit: f64,
    },
    /// A key that only case SII knows.
    #[error("{key} is given, but case {case} has none; leave it out or choose case SII")]
    KeyWithoutCase {
        /// `lambda` or `offset`.
        key: &'static str,
        /// The name of the case that was requested.
        case: &'static str,
    },
    /// The divided profile does not have one point more than the sheet has rows.
    #[error("the divided profile has {found} points, but {rows} rows need {expected}", expected = rows + 1)]
    WrongPolygon {
        /// The number of points of the divided profile.
        found: usize,
        /// The number of rows of the sheet.
        rows: usize,
    },
    /// The creases of two neighbouring rows do not end at the same positions.
    #[error(
        "row {row} ({upper}) and row {next} ({lower}) clash: {reason}; take one flap width for every row, or equal heights",
        next = row + 1
    )]
    RowsClash {
        /// The upper of the two rows.
        row: usize,
        /// Case and ratio w/h of the upper row.
        upper: String,
        /// Case and ratio w/h of the lower row.
        lower: String,
        /// The creases and the positions where they end.
        reason: String,
    },
    /// Unit parts too thin for the arithmetic.
    #[error("{part} of the unit is {} wide, less than 1e-9 of h = {}; {remedy}", Number(*value), Number(*height))]
    DegenerateUnit {
        /// The name of the part that is too narrow.
        part: &'static str,
        /// The width of the part, in the unit of h.
        value: f64,
        /// The height h of the unit.
        height: f64,
        /// What to change so that it works.
        remedy: &'static str,
    },
}

/// What is said of a value that may be missing.
fn stated(value: f64) -> String {
    if value.is_nan() { "is missing".to_owned() } else { format!("is {}", Number(value)) }
}
