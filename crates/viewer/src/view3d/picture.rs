//! What is to be seen.

use eframe::egui::Color32;
use foldmotion_pattern::Sheet;
use foldmotion_record::{Layers, Style};
use glam::DVec3;

use super::CreaseClasses;

/// What the view shows in a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Picture<'a> {
    /// The sheet.
    pub(crate) sheet: &'a Sheet,
    /// Another number when another sheet, or other layers, come.
    pub(crate) sheet_key: u64,
    /// One a vertex. Places that are missing or not finite leave the view empty.
    pub(crate) positions: &'a [DVec3],
    /// Another number when the positions change.
    pub(crate) state_key: u64,
    /// The order of triangles that coincide, where it is known.
    pub(crate) layers: Option<&'a Layers>,
    /// What triangles are painted with.
    pub(crate) colours: Colours<'a>,
    /// The lines that are drawn.
    pub(crate) creases: CreaseClasses,
    /// The colours of paper and lines. Its line width is in points, its background is not used.
    pub(crate) style: &'a Style,
    /// Behind the sheet.
    pub(crate) background: Color32,
    /// Lines over the sheet, dimmed where paper hides them.
    pub(crate) overlays: &'a [Overlay<'a>],
    /// Triangles painted in the colour of marks, in any order.
    pub(crate) flash: &'a [u32],
    /// How bright they are: 0 paper to 1.
    pub(crate) pulse: f32,
    /// A vertex that a hand has, and where it is pulled to.
    pub(crate) pull: Option<VertexPull>,
    /// Whether a vertex can be taken.
    pub(crate) can_pull: bool,
}

impl Picture<'_> {
    /// Whether there is a place for every vertex.
    pub(super) fn is_whole(&self) -> bool {
        self.positions.len() == self.sheet.vertices.len() && !self.positions.is_empty()
    }

    /// Whether there are layers and they belong to the sheet.
    pub(super) fn has_layers(&self) -> bool {
        let count = self.layers.map(|layers| layers.before.len());
        count == Some(self.sheet.faces.len())
    }
}

/// What triangles are painted with.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Colours<'a> {
    /// The two sides of the paper.
    Plain,
    /// Values as colours of record's map.
    Values {
        /// One a triangle; those that are not numbers show paper.
        values: &'a [f64],
        /// The values of the first and the last colour.
        range: [f64; 2],
        /// Another number when the values change.
        key: u64,
    },
    /// Neighbouring units of five tints.
    Units,
    /// The place in the stack of the compact state.
    Layers,
}

/// A vertex that a hand has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct VertexPull {
    /// The vertex.
    pub(crate) vertex: u32,
    /// Where it is pulled to.
    pub(crate) target: DVec3,
}

/// A line, box or dots over the sheet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Overlay<'a> {
    /// What.
    pub(crate) shape: Shape<'a>,
    /// Its colour.
    pub(crate) colour: Color32,
    /// The width of its lines, or the diameter of its dots, in points.
    pub(crate) width: f32,
}

/// The shape of an [`Overlay`].
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shape<'a> {
    /// From point to point.
    Path(&'a [DVec3]),
    /// The twelve edges of a box: a corner and the three edges from it.
    Box(DVec3, [DVec3; 3]),
    /// Dots, seen also behind paper: where facets meet.
    Dots(&'a [DVec3]),
}
