//! The crease pattern as paper: lines to cut and to fold, in millimetres, for cutting machines, printers and
//! Origami Simulator (section 4.3 of the paper, whose figure 9 was cut from such lines).
//!
//! A [`CutPattern`] is every line once, in an order that a plotter follows without needless travel, creases before
//! the outline. A [`CutPage`] is one piece of paper: the whole pattern ([`CutPattern::whole`]) or a tile
//! of it ([`CutPattern::tiles`]). Pages are written as SVG or DXF; [`crease_pattern_fold`] is the same pattern as FOLD.
//!
//! The drawing is the sheet seen from its front: row 0 at the left, column 0 at the top. Mountain creases fold away
//! from the viewer, valley creases towards the viewer.

mod dxf;
mod error;
mod fold;
mod line;
mod long_lines;
mod options;
mod page;
mod paper;
mod pattern;
mod svg;
mod text;
mod tiles;
mod travel;

pub use error::CutError;
pub use fold::crease_pattern_fold;
pub use line::{CutLine, LineClass};
pub use options::CutOptions;
pub use page::{CutPage, PageNumber};
pub use paper::{PaperSize, parse_millimetres};
pub use pattern::CutPattern;
pub use tiles::{PageLayout, Tiles};

use crate::UnitSheet;

/// The whole crease pattern of a sheet of units as one SVG, creases at the fold angles of the compact state.
///
/// # Errors
/// [`CutError`]: options out of range, or a sheet that would be too small or too large to make.
pub fn pattern_svg(units: &UnitSheet, options: &CutOptions) -> Result<String, CutError> {
    let pattern = CutPattern::new(&units.sheet, units.compact_angles(), options)?;
    Ok(pattern.whole().svg())
}

/// The whole crease pattern of a sheet of units as one DXF; see [`CutPage::dxf`].
///
/// # Errors
/// As [`pattern_svg`].
pub fn pattern_dxf(units: &UnitSheet, options: &CutOptions) -> Result<String, CutError> {
    let pattern = CutPattern::new(&units.sheet, units.compact_angles(), options)?;
    Ok(pattern.whole().dxf())
}
