//! Why a crease pattern cannot be put on paper.

use thiserror::Error;

use super::LineClass;

/// Errors of the crease pattern on paper; each carries the value found and what would be right.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CutError {
    /// A length or factor that must be positive is not.
    #[error("{name} is {value}: it must be a positive, finite number")]
    NotPositive {
        /// The name of the quantity or option.
        name: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A length that may be 0 is negative or no number.
    #[error("{name} is {value} mm: it must be 0 or a positive, finite length")]
    Negative {
        /// The name of the quantity or option.
        name: &'static str,
        /// The value that was given, mm.
        value: f64,
    },
    /// The sheet is too small or too large to make.
    #[error(
        "the sheet would be {} mm x {} mm: each side must lie between {minimum} mm and {maximum} mm; \
         choose another scale or width",
        size[0], size[1]
    )]
    Size {
        /// Width and height of the sheet on paper, mm.
        size: [f64; 2],
        /// The shortest side allowed, mm.
        minimum: f64,
        /// The longest side allowed, mm.
        maximum: f64,
    },
    /// A dash pattern that does not alternate dashes and gaps.
    #[error(
        "the dashes of {} lines are {dashes:?}: lengths in mm are needed, dash and gap in turn, all positive, at most {limit}",
        class.name()
    )]
    Dashes {
        /// The class of the lines with these dashes.
        class: LineClass,
        /// The dashes that were given, mm.
        dashes: Vec<f64>,
        /// The largest number of entries allowed.
        limit: usize,
    },
    /// Margins leave no room on the paper.
    #[error(
        "paper of {} mm x {} mm has no room between margins of {margin} mm; choose larger paper or a smaller margin",
        paper[0], paper[1]
    )]
    PaperTooSmall {
        /// Width and height of the paper, mm.
        paper: [f64; 2],
        /// The margin on every side, mm.
        margin: f64,
    },
    /// Pages would overlap by more than half.
    #[error(
        "the overlap is {value} mm: it must lie between 0 and {limit} mm, half of the paper between its margins"
    )]
    Overlap {
        /// The overlap that was given, mm.
        value: f64,
        /// The largest overlap allowed, mm.
        limit: f64,
    },
    /// More pages than anyone glues.
    #[error(
        "the pattern needs {pages} pages: at most {limit} are made; choose larger paper or a smaller scale"
    )]
    TooManyPages {
        /// The number of pages that the pattern would need.
        pages: f64,
        /// The largest number allowed.
        limit: usize,
    },
    /// A text that is no length.
    #[error("\"{text}\" is not a length: write a number with mm, cm, m, in or pt, such as 10mm")]
    LengthText {
        /// The text that was given.
        text: String,
    },
    /// A text that names no paper.
    #[error(
        "\"{text}\" is not a paper size: write A0 to A6, letter, legal or tabloid (with -landscape for the long side across), or \
         WIDTHxHEIGHT such as 300x600mm"
    )]
    PaperText {
        /// The text that was given.
        text: String,
    },
}
