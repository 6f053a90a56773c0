//! A crease pattern read from a file.

use std::f64::consts::PI;

use glam::DVec3;
use serde_json::{Map, Value};

use super::{ImportError, LengthUnit, Mending, Names, Source, Warning};
use crate::{Assignment, Sheet};

/// The key of a FOLD file of a motion with the fold angles of every edge at the end of each stage, degrees.
pub(super) const RECORDED_STAGES: &str = "foldmotion:stages";

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
    /// What was done about lines that nearly meet, and which creases were left out.
    pub mending: Mending,
    /// What was changed or left out, one warning for each kind.
    pub warnings: Vec<Warning>,
    /// The orders of two facets that a FOLD file gives for the flat state, `faceOrders`: the first lies on the side of the
    /// second one's front (1) or back (−1).
    pub face_orders: Vec<(u32, u32, i8)>,
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
    /// The keys of a FOLD file of a motion of this pattern that ends each of its stages at `waypoints`, the fold angles of
    /// every edge in radians: those of [`Self::keys_of_triangles`], and the stages if there are several.
    pub fn keys_of_motion(&self, waypoints: &[Vec<f64>]) -> Map<String, Value> {
        let mut keys = self.keys_of_triangles();
        if waypoints.len() > 1 {
            let is_hinge = |edge: &crate::Edge| edge.is_crease() && edge.is_hinge();
            let degrees = |(edge, angle): (&crate::Edge, &f64)| {
                is_hinge(edge).then(|| angle.to_degrees().clamp(-180.0, 180.0))
            };
            let stage = |angles: &Vec<f64>| -> Vec<Option<f64>> {
                self.sheet.edges.iter().zip(angles).map(degrees).collect()
            };
            let stages: Vec<_> = waypoints.iter().map(stage).collect();
            keys.insert(RECORDED_STAGES.to_owned(), serde_json::json!(stages));
        }
        keys
    }

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

    /// Whether two facets meet at a mountain or valley crease or at a free hinge.
    pub fn has_creases(&self) -> bool {
        let mut edges = self.sheet.edges.iter();
        edges.any(|edge| {
            edge.is_hinge() && (edge.is_crease() || edge.assignment == Assignment::Free)
        })
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
