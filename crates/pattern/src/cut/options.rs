//! How a crease pattern is put on paper.

use super::{CutError, LineClass};

/// The most entries of a dash pattern: what DXF's linetypes hold.
const MOST_DASHES: usize = 12;
/// A row of units is this many dash units long, unless dashes are given.
const DASH_UNITS_A_ROW: f64 = 25.0;
/// The shortest dash unit, mm: shorter ones run together.
const SHORTEST_DASH: f64 = 0.5;
/// The diagonal of a page is this many line widths long, unless a width is given.
const STROKES_A_DIAGONAL: f64 = 2000.0;
/// The thinnest line, mm, unless a width is given.
const THINNEST_STROKE: f64 = 0.1;

/// The options of a crease pattern on paper. Lengths in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct CutOptions {
    /// `<title>` in SVG, a comment in DXF, `file_title` in FOLD.
    pub title: String,
    /// A note on the size for the reader, such as "1 m of the scene is 50 mm".
    pub note: String,
    /// Millimetres on paper for one unit of length of the sheet.
    pub scale: f64,
    /// White space around the whole pattern.
    pub margin: f64,
    /// Whether every edge of the crease pattern stays a line of its own; collinear ones are joined otherwise.
    pub keeps_segments: bool,
    /// Whether the lines that cut facets into triangles are drawn.
    pub draws_facets: bool,
    /// Dash, gap, dash, gap …; empty for a solid line, by the height of a row if omitted.
    pub mountain_dashes: Option<Vec<f64>>,
    /// Dash, gap, dash, gap … of valley lines, as for `mountain_dashes`.
    pub valley_dashes: Option<Vec<f64>>,
    /// The width of the lines; a 2000th of the page's diagonal if omitted, at least 0.1 mm.
    pub stroke_width: Option<f64>,
}

impl CutOptions {
    /// Joined lines without margin, `scale` mm for one unit of length of the sheet.
    pub fn new(scale: f64) -> Self {
        Self {
            title: String::new(),
            note: String::new(),
            scale,
            margin: 0.0,
            keeps_segments: false,
            draws_facets: false,
            mountain_dashes: None,
            valley_dashes: None,
            stroke_width: None,
        }
    }

    pub(super) fn check(&self) -> Result<(), CutError> {
        let is_positive = |value: f64| value > 0.0 && value.is_finite();
        let positive =
            [("the scale", self.scale), ("the line width", self.stroke_width.unwrap_or(1.0))];
        if let Some((name, value)) = positive.into_iter().find(|&(_, v)| !is_positive(v)) {
            return Err(CutError::NotPositive { name, value });
        }
        if !(self.margin >= 0.0 && self.margin.is_finite()) {
            return Err(CutError::Negative { name: "the margin", value: self.margin });
        }
        let given = [
            (LineClass::Mountain, &self.mountain_dashes),
            (LineClass::Valley, &self.valley_dashes),
        ];
        for (class, dashes) in given {
            let dashes = dashes.as_deref().unwrap_or_default();
            let is_pattern = dashes.len().is_multiple_of(2) && dashes.len() <= MOST_DASHES;
            if !is_pattern || !dashes.iter().all(|&d| is_positive(d)) {
                return Err(CutError::Dashes {
                    class,
                    dashes: dashes.to_owned(),
                    limit: MOST_DASHES,
                });
            }
        }
        Ok(())
    }

    /// The dashes of a class; empty for solid lines. `row`: the height of a row of units, mm.
    ///
    /// Mountain lines are long dash, short dash; valley lines are even dashes.
    pub(super) fn dashes(&self, class: LineClass, row: f64) -> Vec<f64> {
        let unit = (row / DASH_UNITS_A_ROW).max(SHORTEST_DASH);
        let standard = |lengths: &[f64]| lengths.iter().map(|l| l * unit).collect();
        match class {
            LineClass::Mountain => {
                self.mountain_dashes.clone().unwrap_or_else(|| standard(&[3.0, 1.0, 1.0, 1.0]))
            }
            LineClass::Valley => {
                self.valley_dashes.clone().unwrap_or_else(|| standard(&[2.0, 1.0]))
            }
            LineClass::Free | LineClass::Facet | LineClass::Cut => Vec::new(),
        }
    }

    /// The width of the lines of a page with this diagonal.
    pub(super) fn stroke(&self, diagonal: f64) -> f64 {
        let standard = (diagonal / STROKES_A_DIAGONAL).max(THINNEST_STROKE);
        self.stroke_width.unwrap_or(standard)
    }
}
