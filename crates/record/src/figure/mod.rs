//! A figure of chosen states of a motion, side by side at one scale, as lines and areas.
//!
//! Each state is what [`Surface::visible`](crate::Surface::visible) sees of it, so a figure hides what pictures of pixels hide. Areas take the
//! light of pictures; lines are drawn over them, those in front last. States are arranged in rows with a label below
//! each; keys of scale, lines and colours are at the foot. Creases of facets seen so nearly edge-on that their lines
//! would run together are left out.

mod bounds;
mod foot;
mod keys;
mod layout;
mod look;
mod measure;
mod paint;
mod spot;
mod state;

use glam::DVec2;

pub use self::look::LineStyle;
pub use self::state::{Bounds, Dimension, FigureState};

use self::layout::Layout;
use self::paint::Painter;
use crate::raster::check_positions;
use crate::{Anchor, Drawing, Paper, RecordError, Style, View};
use foldmotion_pattern::Sheet;

/// The millimetres of a unit of the page, a 96th of an inch; a page is stretched from it to its exact width.
const UNIT: f64 = 25.4 / 96.0;

/// The widest page and the highest, millimetres.
const MAX_SIDE: f64 = 5000.0;

/// The meaning of colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Legend {
    /// The quantity with its unit.
    pub title: String,
    /// The values of the first and the last colour of [`crate::colour_of`]; others are clamped.
    pub range: [f64; 2],
}

/// The options of a strip of states. Lengths on the page are millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct StripOptions {
    /// The width of the page.
    pub width: f64,
    /// The largest height of the page.
    pub height: f64,
    /// States in a row, at most; at least one.
    pub columns: usize,
    /// The direction from which the states are seen.
    pub view: View,
    /// Across the view, see [`View::extent`]: the extent that each state shows at least; if `None`, its own extent.
    pub frame: Option<[DVec2; 2]>,
    /// Colours; [`Style::grey`] for print without them. Its width of lines and its background do not count here.
    pub style: Style,
    /// How mountains and valleys are distinguished.
    pub lines: LineStyle,
    /// The width of all lines.
    pub line_width: f64,
    /// The size of letters.
    pub letters: f64,
    /// The name of the sheet's unit of length, for a bar of scale; empty: no bar.
    pub unit: String,
    /// Whether samples of the lines are shown at the foot.
    pub has_key: bool,
    /// The meaning of the values of [`FigureState::values`] and [`FigureState::bars`]; without it they are not shown.
    pub legend: Option<Legend>,
    /// The colour behind everything; `None` leaves the figure transparent.
    pub background: Option<[u8; 3]>,
}

impl Default for StripOptions {
    fn default() -> Self {
        Self {
            width: 180.0,
            height: 240.0,
            columns: 5,
            view: View::default(),
            frame: None,
            style: Style::default(),
            lines: LineStyle::default(),
            line_width: 0.15,
            letters: 2.8,
            unit: String::new(),
            has_key: true,
            legend: None,
            background: Some([u8::MAX; 3]),
        }
    }
}

impl StripOptions {
    fn check(&self) -> Result<(), RecordError> {
        let sides = [
            ("width", self.width),
            ("height", self.height),
            ("line_width", self.line_width),
            ("letters", self.letters),
        ];
        for (name, value) in sides {
            if !(value > 0.0 && value <= MAX_SIDE) {
                return Err(RecordError::Length { name, value, limit: MAX_SIDE });
            }
        }
        match self.legend {
            Some(Legend { range: [low, high], .. })
                if !(low.is_finite() && high.is_finite() && low < high) =>
            {
                Err(RecordError::Range { low, high })
            }
            _ => Ok(()),
        }
    }
}

/// The states `states` of `sheet` in rows, as large as they fit, all at one scale and from one direction.
///
/// # Errors
/// [`RecordError::NoFrames`] without states; [`RecordError::VertexCount`], [`RecordError::NotFinite`],
/// [`RecordError::ValueCount`] with the index of the state as frame; [`RecordError::Length`], [`RecordError::Range`];
/// [`RecordError::NoRoom`] where labels and keys leave no room for the states; [`RecordError::Size`].
pub fn strip(
    sheet: &Sheet,
    states: &[FigureState<'_>],
    options: &StripOptions,
) -> Result<Drawing, RecordError> {
    options.check()?;
    if states.is_empty() {
        return Err(RecordError::NoFrames);
    }
    for (index, state) in states.iter().enumerate() {
        check_positions(sheet, index, &state.positions)?;
        state.check(sheet, index)?;
    }
    let layout = Layout::new(states, options)?;
    let mut drawing = Drawing::new(layout.page)?
        .with_unit(layout.millimetres)?
        .with_background(options.background);
    for (state, cell) in states.iter().zip(&layout.cells) {
        let paper = Paper::new(sheet, state.order);
        let painter = Painter { paper: &paper, options, layout: &layout };
        painter.paint(&mut drawing, state, cell)?;
        for (line, text) in state.captions().enumerate() {
            let y = cell.at.y + cell.size.y + layout.letters * (1.2 + layout::LINE * line as f64);
            let at = DVec2::new(cell.middle.x, y);
            drawing.words(at, text, layout.letters, Anchor::Middle);
        }
    }
    foot::draw(&mut drawing, states, options, &layout)?;
    Ok(drawing)
}
