//! What can go wrong while a motion is drawn.

use std::io;

use thiserror::Error;

/// Why a picture or a film could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The picture has no pixels or too many.
    #[error(
        "a picture of {width} × {height} pixels cannot be made: each side must lie in 1 to 65535 and the area be at most {limit} pixels"
    )]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The largest area.
        limit: u64,
    },
    /// The rate of film frames is out of range.
    #[error("fps = {value} cannot be filmed: it must lie above 0 and be at most {limit}")]
    FramesPerSecond {
        /// The value that was requested.
        value: f64,
        /// The largest rate: viewers slow down GIF frames shorter than two hundredths of a second.
        limit: f64,
    },
    /// A duration is negative, too long or not a number.
    #[error("{name} = {value} s cannot be filmed: it must lie in 0 to {limit} s")]
    Seconds {
        /// The name of the option.
        name: &'static str,
        /// The value that was requested.
        value: f64,
        /// The longest duration.
        limit: f64,
    },
    /// The camera turns too far or by a value that is not a number.
    #[error("turn = {value}° cannot be filmed: it must lie in −{limit}° to {limit}°")]
    Turn {
        /// The value that was requested.
        value: f64,
        /// The largest turn.
        limit: f64,
    },
    /// Values to show have no range.
    #[error("values from {low} to {high} cannot be shown: the range must be finite and rise")]
    Range {
        /// The value of the first colour.
        low: f64,
        /// The value of the last colour.
        high: f64,
    },
    /// Values to show do not fit the motion.
    #[error(
        "frame {frame} has {found} values: every frame of the motion needs one for each of {expected} triangles"
    )]
    ValueCount {
        /// The first frame that is wrong, missing or too many.
        frame: usize,
        /// Its values.
        found: usize,
        /// Triangles of the sheet.
        expected: usize,
    },
    /// The program was built without a part that is needed.
    #[error(
        "{what} cannot be written: this build lacks the feature \"{feature}\"; build with --features {feature}"
    )]
    Feature {
        /// The output that was requested.
        what: &'static str,
        /// The cargo feature.
        feature: &'static str,
    },
    /// The H.264 encoder failed or refuses the size.
    #[error("the film could not be encoded as H.264: {message}")]
    H264 {
        /// The reason, as the system or library gave it.
        message: String,
    },
    /// A 3D file would be too large.
    #[error("a {format} file of {bytes} bytes cannot be written: at most {limit} fit; {remedy}")]
    FileSize {
        /// The name of the file format.
        format: &'static str,
        /// The size that the file would have, bytes.
        bytes: u64,
        /// The largest size.
        limit: u64,
        /// How to make the file smaller.
        remedy: &'static str,
    },
    /// A motion needs more morph targets than viewers take.
    #[error(
        "a GLB within {tolerance} of the motion needs {needed} morph targets: viewers take {limit}; raise the tolerance or film a part"
    )]
    Targets {
        /// Those needed.
        needed: usize,
        /// Those that viewers take.
        limit: usize,
        /// The tolerance, in the sheet's unit of length.
        tolerance: f64,
    },
    /// A tolerance, a duration or a thickness is not positive and finite.
    #[error("{name} = {value} cannot be used: it must be finite and above 0")]
    NotPositive {
        /// The name of the option.
        name: &'static str,
        /// The value that was requested.
        value: f64,
    },
    /// A line width is negative, too wide or not a number.
    #[error("line_width = {value} cannot be drawn: it must lie in 0 to {limit} pixels")]
    LineWidth {
        /// The value that was requested.
        value: f64,
        /// The widest line.
        limit: f64,
    },
    /// A margin leaves no room for the sheet.
    #[error("margin = {value} leaves no room: it must lie in 0 to below 0.5")]
    Margin {
        /// The margin that was requested, as a part of the picture's sides.
        value: f64,
    },
    /// A PNG could not be encoded.
    #[error("a PNG could not be written: {message}")]
    Png {
        /// The encoder's words.
        message: String,
    },
    /// The unit of a page has no length, or the page is too long.
    #[error(
        "a page with {value} mm a unit cannot be made: that must lie above 0 and no side of the page be longer than {limit} mm"
    )]
    Unit {
        /// The value that was requested.
        value: f64,
        /// The longest side.
        limit: f64,
    },
    /// A length of a figure is not positive or too large.
    #[error("{name} = {value} mm cannot be drawn: it must lie above 0 and be at most {limit} mm")]
    Length {
        /// The name of the option.
        name: &'static str,
        /// The value that was requested.
        value: f64,
        /// The largest length.
        limit: f64,
    },
    /// The words of a figure leave no room for its states.
    #[error(
        "{states} states do not fit on {width} × {height} mm beside their labels: allow a larger page, smaller letters or fewer states a row"
    )]
    NoRoom {
        /// The width of the page, millimetres.
        width: f64,
        /// The largest height of the page, millimetres.
        height: f64,
        /// The number of states.
        states: usize,
    },
    /// The built-in font cannot be read.
    #[error("the built-in font cannot be read: {message}")]
    Font {
        /// The parser's words.
        message: String,
    },
    /// The motion has no frames.
    #[error("the motion has no frames: a film needs at least one")]
    NoFrames,
    /// A frame does not hold one position for each vertex.
    #[error("frame {frame} has {found} positions: the sheet has {expected} vertices")]
    VertexCount {
        /// The frame, 0 for a single picture.
        frame: usize,
        /// Positions found.
        found: usize,
        /// Vertices of the sheet.
        expected: usize,
    },
    /// A position is not a number.
    #[error(
        "vertex {vertex} of frame {frame} lies at {position:?}: every coordinate must be finite"
    )]
    NotFinite {
        /// The frame, 0 for a single picture.
        frame: usize,
        /// The index of the vertex.
        vertex: usize,
        /// The position of the vertex.
        position: [f64; 3],
    },
    /// The times of a motion's frames do not increase.
    #[error(
        "frame {frame} has the time {time}: times must be finite and increase from frame to frame"
    )]
    Time {
        /// The frame with the error.
        frame: usize,
        /// The motion time of the frame.
        time: f64,
    },
    /// The points cannot be brought into the picture.
    #[error(
        "points that span {width} by {height} across the view cannot be scaled into the picture"
    )]
    Extent {
        /// Across.
        width: f64,
        /// Up.
        height: f64,
    },
    /// A report or certificate cannot be read.
    #[error("the {name} cannot be shown: it is not JSON: {message}")]
    Json {
        /// The name of the data that were to be shown.
        name: &'static str,
        /// The parser's words.
        message: String,
    },
    /// The progress callback asked to stop.
    #[error("the film was interrupted")]
    Interrupted,
    /// The film could not be written.
    #[error("the film could not be written: {0}")]
    Write(#[from] io::Error),
    /// The GIF encoder refused a frame.
    #[error("the film could not be encoded: {0}")]
    Encode(::gif::EncodingError),
}

impl From<::gif::EncodingError> for RecordError {
    fn from(error: ::gif::EncodingError) -> Self {
        match error {
            ::gif::EncodingError::Io(error) => Self::Write(error),
            other => Self::Encode(other),
        }
    }
}

impl From<::png::EncodingError> for RecordError {
    fn from(error: ::png::EncodingError) -> Self {
        match error {
            ::png::EncodingError::IoError(error) => Self::Write(error),
            other => Self::Png { message: other.to_string() },
        }
    }
}
