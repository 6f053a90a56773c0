//! States of a sheet as pictures in a drawing.

use foldmotion_pattern::{LayerOrder, Sheet};
use foldmotion_record::{Camera, Drawing, PIXELS_A_UNIT, Style, View, picture};
use glam::{DVec2, DVec3};

use crate::PaperError;
use foldmotion_study::UnitStudy;

/// The largest width of lines in pictures, in units of the page.
const LINE_WIDTH: f64 = 0.9;
/// The largest width of lines as a part of the rows' height, since small rows need thin lines.
const LINE_PART: f64 = 0.03;
/// The margin around a state, in units of the page.
const MARGIN: f64 = 4.0;

/// A state of a sheet, for a picture.
#[derive(Debug)]
pub(super) struct SheetState<'a> {
    pub(super) sheet: &'a Sheet,
    pub(super) positions: Vec<DVec3>,
    pub(super) order: LayerOrder,
}

impl<'a> SheetState<'a> {
    /// A state without coincident facets.
    pub(super) fn new(study: &'a UnitStudy, positions: Vec<DVec3>) -> Self {
        Self { sheet: &study.units.sheet, positions, order: LayerOrder::default() }
    }

    /// The deployed state.
    pub(super) fn deployed(study: &'a UnitStudy) -> Self {
        Self::new(study, study.deployed.clone())
    }

    /// The exact compact state.
    pub(super) fn compact(study: &'a UnitStudy) -> Self {
        Self::new(study, study.units.compact()).layered(study)
    }

    /// This state with the compact layer order.
    pub(super) fn layered(self, study: &UnitStudy) -> Self {
        Self { order: study.units.compact_order(), ..self }
    }

    fn size(&self, view: View) -> DVec2 {
        let [low, high] = view.extent(self.positions.iter().copied());
        high - low
    }

    /// Draws the state in the middle of a cell; `scale` is the size of a unit of length on the page.
    pub(super) fn show(
        &self,
        drawing: &mut Drawing,
        view: View,
        cell: Cell,
        scale: f64,
    ) -> Result<(), PaperError> {
        let pixels = f64::from(PIXELS_A_UNIT);
        #[expect(clippy::cast_sign_loss, reason = "cells are positive")]
        let size = (cell.size * pixels).to_array().map(|side| side as u32);
        let extent = view.extent(self.positions.iter().copied());
        let camera = Camera::centred(view, extent, size, scale * pixels)?;
        let style = Style {
            line_width: LINE_WIDTH.min(LINE_PART * scale * self.sheet.unit_length) * pixels,
            ..Style::default()
        };
        let image = picture(self.sheet, &self.positions, &self.order, &camera, &style, size)?;
        drawing.picture(cell.at, image);
        Ok(())
    }
}

/// A rectangle of the page.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// Its left upper corner.
    pub(super) at: DVec2,
    pub(super) size: DVec2,
}

impl Cell {
    pub(super) fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { at: DVec2::new(x, y), size: DVec2::new(width, height) }
    }
}

/// The largest scale at which every state fits into a cell of size `size`.
pub(super) fn common_scale(states: &[SheetState<'_>], view: View, size: DVec2) -> f64 {
    let space = size - 2.0 * MARGIN;
    let fit = |state: &SheetState<'_>| (space / state.size(view)).min_element();
    states.iter().map(fit).fold(f64::INFINITY, f64::min)
}
