//! What the view shows.

use eframe::egui::Color32;
use foldmotion_pattern::Sheet;
use foldmotion_record::{Layers, Style};
use glam::DVec3;

use super::CreaseClasses;

/// What the view shows in a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Picture<'a> {
    pub(crate) sheet: &'a Sheet,
    /// A number that changes with the sheet or its layers.
    pub(crate) sheet_key: u64,
    /// The position of each vertex. If one is missing or not finite, the view is empty.
    pub(crate) positions: &'a [DVec3],
    /// A number that changes with the positions.
    pub(crate) state_key: u64,
    /// The order of coinciding triangles, if it is known.
    pub(crate) layers: Option<&'a Layers>,
    /// How triangles are coloured.
    pub(crate) colours: Colours<'a>,
    /// The classes of creases that are drawn.
    pub(crate) creases: CreaseClasses,
    /// Colours of paper and lines. The line width is in points; the background is not used.
    pub(crate) style: &'a Style,
    /// The colour behind the sheet.
    pub(crate) background: Color32,
    /// Lines and dots over the sheet, dimmed where the sheet hides them.
    pub(crate) overlays: &'a [Overlay<'a>],
    /// Triangles drawn in the colour of marks, in any order.
    pub(crate) flash: &'a [u32],
    /// The strength of that colour, from 0 (paper) to 1.
    pub(crate) pulse: f32,
    /// The vertex that is being pulled.
    pub(crate) pull: Option<VertexPull>,
    /// Whether a vertex can be pulled.
    pub(crate) can_pull: bool,
}

impl Picture<'_> {
    /// Whether every vertex has a position.
    pub(super) fn is_whole(&self) -> bool {
        self.positions.len() == self.sheet.vertices.len() && !self.positions.is_empty()
    }

    /// Whether there are layers and they match the sheet.
    pub(super) fn has_layers(&self) -> bool {
        let count = self.layers.map(|layers| layers.before.len());
        count == Some(self.sheet.faces.len())
    }
}

/// How triangles are coloured.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Colours<'a> {
    Plain,
    /// Values in the colours of films.
    Values {
        /// The value of each triangle; one that is not a number shows paper.
        values: &'a [f64],
        /// The values of the first and the last colour.
        range: [f64; 2],
        /// A number that changes with the values.
        key: u64,
    },
    /// Five tints, different for neighbouring units.
    Units,
    /// The position in the stack of the compact state.
    Layers,
}

/// A vertex that is being pulled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct VertexPull {
    pub(crate) vertex: u32,
    /// The point it is pulled towards.
    pub(crate) target: DVec3,
}

/// Lines or dots over the sheet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Overlay<'a> {
    pub(crate) shape: Shape<'a>,
    pub(crate) colour: Color32,
    /// The width of lines or the diameter of dots, points.
    pub(crate) width: f32,
}

/// The shape of an [`Overlay`].
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shape<'a> {
    /// A polyline.
    Path(&'a [DVec3]),
    /// The twelve edges of a box: a corner and the three edges from it.
    Box(DVec3, [DVec3; 3]),
    /// Dots, also visible through the sheet.
    Dots(&'a [DVec3]),
}
