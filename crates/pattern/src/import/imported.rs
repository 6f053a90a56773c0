//! A crease pattern read from a file.

use std::f64::consts::PI;

use glam::DVec3;
use serde_json::{Map, Value};

use super::{ImportError, LengthUnit, Names, Source, Warning};
use crate::{Assignment, Sheet};

/// A crease pattern read from a file: the sheet, and what it is to fold to.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedPattern {
    /// `file_title` of FOLD, `<title>` of SVG.
    pub title: Option<String>,
    /// The flat pattern. Creases have [`crate::CreaseKind::Imported`], facets [`crate::FacetKind::Plain`], rows and
    /// columns are 0; cuts are open; free hinges are [`Assignment::Free`]. [`Sheet::unit_length`] is the mean length of
    /// the edges of its facets, or what `foldmotion:unitLength` says.
    ///
    /// The sheet of an SVG lies as it is seen, its front towards the viewer: x to the right, y upwards.
    pub sheet: Sheet,
    /// The unit of length of the coordinates.
    pub unit: LengthUnit,
    /// The fold angle every edge is to take, radians; 0 if it is not a crease.
    pub targets: Vec<f64>,
    /// The fold angles to pass through, if the frames of a FOLD file give any, in the order of the frames.
    pub stages: Vec<PatternStage>,
    /// The facets held in place, if a FOLD file names them by `faces_foldmotion:fixed` or by fixing all their corners
    /// with `rtori:os:vertices_fixed`; in order.
    pub fixed_facets: Vec<u32>,
    /// The elements of the file that the edges come from.
    pub sources: Vec<Source>,
    /// The names of each of `sources`; empty for FOLD.
    pub names: Vec<Names>,
    /// The index in `sources` of every edge; `None` for those that cut facets into triangles.
    pub edge_sources: Vec<Option<u32>>,
    /// The FOLD vertex every vertex comes from; `None` if lines were drawn or split.
    pub vertex_sources: Vec<Option<u32>>,
    /// The vertices as a FOLD file places them, if they are not in the plane z = 0 with the fronts up: its
    /// coordinates, for the vertices of the sheet.
    pub shape: Option<Vec<DVec3>>,
    /// What was changed or left out, one warning for each kind.
    pub warnings: Vec<Warning>,
    /// The keys of a FOLD file's key frame that are not read; see [`Self::fold`].
    pub keys: Map<String, Value>,
    /// The numbers of vertices, edges and faces that the FOLD file lists.
    pub(super) listed: [usize; 3],
}

/// The fold angles that a frame of a FOLD file asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct PatternStage {
    /// The element of `file_frames`.
    pub frame: u32,
    /// The title of the frame, `frame_title`.
    pub title: Option<String>,
    /// The fold angle of every edge, radians; `None` if the frame leaves the edge free or it has no angle.
    pub angles: Vec<Option<f64>>,
}

impl ImportedPattern {
    /// The fold angle of every edge, radians, at a fold percentage as in Origami Simulator: the targets times
    /// `fraction`, −1 to 1.
    ///
    /// # Errors
    /// [`ImportError::Percentage`].
    pub fn angles_at(&self, fraction: f64) -> Result<Vec<f64>, ImportError> {
        if !(-1.0..=1.0).contains(&fraction) {
            return Err(ImportError::Percentage { value: fraction });
        }
        Ok(self.targets.iter().map(|target| target * fraction).collect())
    }

    /// The edges that nothing drives and nothing holds.
    pub fn free_hinges(&self) -> impl Iterator<Item = u32> + '_ {
        let edges = self.sheet.edges.iter().zip(0..);
        edges.filter(|(edge, _)| edge.assignment == Assignment::Free).map(|(_, index)| index)
    }

    /// The element that edge `edge` comes from; `None` for one that cuts a facet into triangles.
    pub fn edge_source(&self, edge: u32) -> Option<&Source> {
        let source = (*self.edge_sources.get(edge as usize)?)?;
        self.sources.get(source as usize)
    }

    /// The FOLD edge that edge `edge` comes from.
    pub(super) fn fold_edge(&self, edge: usize) -> Option<u32> {
        match self.edge_source(edge as u32)? {
            Source::FoldEdge(listed) => Some(*listed),
            _ => None,
        }
    }

    /// Whether every crease is to fold flat, by ±180°.
    pub fn folds_flat(&self) -> bool {
        let edges = self.sheet.edges.iter().zip(&self.targets);
        edges
            .filter(|(edge, _)| edge.is_crease())
            .all(|(_, target)| (target.abs() - PI).abs() < 1e-12)
    }

    /// The Euler characteristic V − E + F of the triangulated sheet: 1 for a disk, 0 for a sheet with one hole.
    pub fn euler_characteristic(&self) -> i64 {
        let sheet = &self.sheet;
        let [vertices, edges, faces] =
            [sheet.vertices.len(), sheet.edges.len(), sheet.faces.len()].map(|n| n as i128);
        (vertices - edges + faces) as i64
    }
}
