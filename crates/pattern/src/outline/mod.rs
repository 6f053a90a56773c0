//! Outlines in files: the points of a user's own profile.
//!
//! Read are tables of coordinates (`.csv`), airfoil sections (`.dat`, in Selig's and Lednicer's order) and polylines
//! and chains of lines of drawings (`.dxf`, ASCII).

mod airfoil_file;
mod chain;
mod csv;
mod dxf;
mod error;

use std::path::Path;

use glam::DVec2;

pub use error::OutlineError;

/// The most bytes of a file.
pub const LARGEST_OUTLINE_FILE: u64 = 16 << 20;

/// Points (x, z) in order and whether the file says that they return to their start.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// The points; of a closed outline the last is the first.
    pub points: Vec<DVec2>,
    /// Whether the outline is closed: its last point is its first, or the file says so.
    pub closed: bool,
}

/// The formats of outline files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Csv,
    Airfoil,
    Dxf,
}

impl Outline {
    /// Reads a file; its ending tells the format: `.csv`, `.dat` or `.dxf`.
    ///
    /// # Errors
    /// An unknown ending, a file that cannot be read or is above 16 MiB, and what is wrong in it, with the line.
    pub fn read(path: &Path) -> Result<Self, OutlineError> {
        let format = format_of(path)?;
        let unreadable =
            |source: std::io::Error| OutlineError::Read { message: source.to_string() };
        let data = std::fs::metadata(path).map_err(unreadable)?;
        if !data.is_file() {
            return Err(OutlineError::Read {
                message: "it is a folder, a device or a pipe; only regular files are read"
                    .to_owned(),
            });
        }
        let size = data.len();
        if size > LARGEST_OUTLINE_FILE {
            return Err(OutlineError::TooLarge { size, limit: LARGEST_OUTLINE_FILE });
        }
        let bytes = std::fs::read(path).map_err(unreadable)?;
        // Names and comments may be in any encoding; numbers are ASCII.
        Self::parse(&String::from_utf8_lossy(&bytes), format)
    }

    fn parse(text: &str, format: Format) -> Result<Self, OutlineError> {
        match format {
            Format::Csv => csv::parse(text),
            Format::Airfoil => airfoil_file::parse(text),
            Format::Dxf => dxf::parse(text),
        }
    }

    /// The outline of points in order: closed where the last is the first.
    fn of(points: Vec<DVec2>) -> Self {
        let closed = points.len() > 2 && points.first() == points.last();
        Self { points, closed }
    }
}

fn format_of(path: &Path) -> Result<Format, OutlineError> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    match ending.to_ascii_lowercase().as_str() {
        "csv" => Ok(Format::Csv),
        "dat" => Ok(Format::Airfoil),
        "dxf" => Ok(Format::Dxf),
        _ => Err(OutlineError::UnknownEnding { ending: ending.into_owned() }),
    }
}

/// A finite number, or an error with the line.
fn number(text: &str, line: usize) -> Result<f64, OutlineError> {
    let value = text.trim().parse().ok().filter(|v: &f64| v.is_finite());
    value.ok_or_else(|| OutlineError::NotANumber {
        line,
        value: text.trim().chars().take(40).collect(),
    })
}

#[cfg(test)]
mod tests;
