//! How wide words are.

use epaint_default_fonts::UBUNTU_LIGHT;
use ttf_parser::{Face, GlyphId};

use super::label::runs;
use crate::RecordError;

/// The width of `text` in letters of `size`, with its raised and lowered parts, in the built-in font.
///
/// # Errors
/// [`RecordError::Font`].
pub(crate) fn words_width(text: &str, size: f64) -> Result<f64, RecordError> {
    let face =
        Face::parse(UBUNTU_LIGHT, 0).map_err(|e| RecordError::Font { message: e.to_string() })?;
    let advance = |letter: char| {
        let glyph = face.glyph_index(letter).unwrap_or(GlyphId(0));
        f64::from(face.glyph_hor_advance(glyph).unwrap_or(0))
    };
    let unit = size / f64::from(face.units_per_em());
    let runs = runs(text).into_iter();
    let widths = runs.map(|run| run.scale * run.text.chars().map(advance).sum::<f64>());
    Ok(unit * widths.sum::<f64>())
}
