//! The positions of the states on the page.

use glam::DVec2;

use super::measure::measures;
use super::{FigureState, StripOptions, UNIT, keys};
use crate::drawing::words_width;
use crate::{Camera, RecordError};

/// The distance of lines of text, in sizes of letters.
pub(super) const LINE: f64 = 1.25;

/// Kept free at the page's border and below states, in sizes of letters.
const GAP: f64 = 1.0;

/// Kept free between states, in sizes of letters: what is written below and beside them must not run together.
const BETWEEN: f64 = 1.6;

/// Halvings in the search for the scale: beyond the digits of an f64.
const HALVINGS: usize = 60;

/// The area of a state, without its label.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// The left upper corner.
    pub(super) at: DVec2,
    pub(super) size: DVec2,
    /// The position of the middle of the extent.
    pub(super) middle: DVec2,
    /// Across the view, to the right and up: the middle of what is shown there, in the sheet's unit of length.
    pub(super) extent: [DVec2; 2],
}

/// The page in its units.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) page: [u32; 2],
    /// The length of a unit, millimetres.
    pub(super) millimetres: f64,
    /// Units a length of the sheet.
    pub(super) scale: f64,
    pub(super) letters: f64,
    pub(super) line_width: f64,
    pub(super) cells: Vec<Cell>,
    /// The left upper corner and the width of the foot.
    pub(super) foot: (DVec2, f64),
}

/// The space that a state needs.
#[derive(Debug)]
struct SpaceNeeded {
    extent: [DVec2; 2],
    /// The text beside the state: its position from the middle of the extent at one unit a length, and its box
    /// there.
    beside: Vec<(DVec2, [DVec2; 2])>,
    /// The width of the text below.
    text: f64,
    lines: usize,
}

impl SpaceNeeded {
    fn new(
        state: &FigureState<'_>,
        options: &StripOptions,
        letters: f64,
    ) -> Result<Self, RecordError> {
        let mut extent = options.view.extent(state.points());
        if let Some([low, high]) = options.frame {
            extent = [extent[0].min(low), extent[1].max(high)];
        }
        let (mut text, mut lines) = (0.0, 0);
        for line in state.captions() {
            text = f64::max(text, words_width(line, letters)?);
            lines += 1;
        }
        let mut beside = Vec::new();
        if state.bounds.is_some() || !state.dimensions.is_empty() {
            let camera = Camera::centred(options.view, extent, [1, 1], 1.0)?;
            for measure in measures(state, &camera) {
                let boxes = measure.boxes(letters)?;
                let from_middle = |(point, around)| (point - DVec2::splat(0.5), around);
                beside.extend(boxes.map(from_middle));
            }
        }
        Ok(Self { extent, beside, text, lines })
    }

    /// All that is shown at `scale` around the middle of the extent, but for the height of the text below.
    fn around(&self, scale: f64) -> [DVec2; 2] {
        let half = 0.5 * scale * (self.extent[1] - self.extent[0]);
        let text = DVec2::new(0.5 * self.text, 0.0);
        let mut around = [-half.max(text), half.max(text)];
        for (point, [low, high]) in &self.beside {
            // Text on the far side would let a larger scale need less room.
            around[0] = around[0].min(scale * point.min(DVec2::ZERO) + *low);
            around[1] = around[1].max(scale * point.max(DVec2::ZERO) + *high);
        }
        around
    }

    fn size(&self, scale: f64) -> DVec2 {
        let [low, high] = self.around(scale);
        high - low
    }
}

impl Layout {
    pub(super) fn new(
        states: &[FigureState<'_>],
        options: &StripOptions,
    ) -> Result<Self, RecordError> {
        #[expect(clippy::cast_sign_loss, reason = "widths are positive")]
        let across = (options.width / UNIT).round().max(1.0) as u32;
        let width = f64::from(across);
        let millimetres = options.width / width;
        let letters = options.letters / millimetres;
        let needs = states.iter().map(|state| SpaceNeeded::new(state, options, letters));
        let needs: Vec<SpaceNeeded> = needs.collect::<Result<_, _>>()?;
        let rows: Vec<&[SpaceNeeded]> = needs.chunks(options.columns.max(1)).collect();
        let gap = GAP * letters;
        let inner = width - 2.0 * gap;
        let foot = keys::height(states, options, letters, inner)?;
        let room = options.height / millimetres - foot - gap;
        let scale = fitting_scale(&rows, [inner, room], letters);
        let scale = scale.ok_or(RecordError::NoRoom {
            width: options.width,
            height: options.height,
            states: states.len(),
        })?;
        let mut cells = Vec::with_capacity(states.len());
        let mut top = gap;
        for row in &rows {
            place_row(row, [inner, top, gap], scale, &mut cells);
            top += row_height(row, scale, letters);
        }
        #[expect(clippy::cast_sign_loss, reason = "heights are positive")]
        let down = (top + foot).ceil().max(1.0) as u32;
        Ok(Self {
            page: [across, down],
            millimetres,
            scale,
            letters,
            line_width: options.line_width / millimetres,
            cells,
            foot: (DVec2::new(gap, top), inner),
        })
    }
}

/// The widest scale at which every row and all rows together fit into `room`, `None` if the text alone does not.
fn fitting_scale(rows: &[&[SpaceNeeded]], room: [f64; 2], letters: f64) -> Option<f64> {
    let fits = |scale: f64| {
        let widest = rows.iter().map(|row| row_width(row, scale, letters));
        let high: f64 = rows.iter().map(|row| row_height(row, scale, letters)).sum();
        widest.fold(0.0, f64::max) <= room[0] && high <= room[1]
    };
    let needs = || rows.iter().copied().flatten();
    let largest = needs().map(|need| (need.extent[1] - need.extent[0]).max_element());
    let largest = largest.fold(0.0, f64::max);
    if !fits(0.0) || !largest.is_finite() {
        return None;
    }
    // States of no extent are shown at one unit a length.
    let mut too_large = if largest > 0.0 { (room[0] + room[1]) / largest } else { 1.0 };
    if fits(too_large) {
        return Some(too_large);
    }
    let mut fitting = 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (fitting + too_large);
        if fits(middle) {
            fitting = middle;
        } else {
            too_large = middle;
        }
    }
    (fitting > 0.0).then_some(fitting)
}

fn row_width(row: &[SpaceNeeded], scale: f64, letters: f64) -> f64 {
    let gaps = BETWEEN * letters * (row.len() - 1) as f64;
    gaps + row.iter().map(|need| need.size(scale).x).sum::<f64>()
}

fn row_height(row: &[SpaceNeeded], scale: f64, letters: f64) -> f64 {
    let high = row.iter().map(|need| need.size(scale).y);
    let lines = row.iter().map(|need| need.lines).max().unwrap_or(0);
    high.fold(0.0, f64::max) + letters * (LINE * lines as f64 + GAP)
}

/// Spreads a row over the width; the lower edges of the states are level.
fn place_row(row: &[SpaceNeeded], [inner, top, gap]: [f64; 3], scale: f64, cells: &mut Vec<Cell>) {
    let high = row.iter().map(|need| need.size(scale).y);
    let high = high.fold(0.0, f64::max);
    let used: f64 = row.iter().map(|need| need.size(scale).x).sum();
    let between = (inner - used) / row.len() as f64;
    let mut left = gap + 0.5 * between;
    for need in row {
        let size = need.size(scale);
        let at = DVec2::new(left, top + high - size.y);
        cells.push(Cell { at, size, middle: at - need.around(scale)[0], extent: need.extent });
        left += size.x + between;
    }
}
