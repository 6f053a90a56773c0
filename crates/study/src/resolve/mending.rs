//! What an import did about lines that nearly meet, for the user.

use foldmotion_geometry::Number;
use foldmotion_pattern::Mending;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What was done about lines that nearly meet, and which creases were left out.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct MendingReport {
    /// How far apart two points may lie to be one vertex, in lengths of the file; 0 if the facets that the file lists were
    /// kept as they are.
    pub tolerance: f64,
    /// Whether the tolerance was chosen from the drawing; false if the scene gives it.
    pub chosen_from_drawing: bool,
    /// The number of ends of lines that became a vertex near them.
    pub merged_ends: usize,
    /// The number of vertices beside a line that it now passes through.
    pub snapped_vertices: usize,
    /// The number of creases, or parts of creases, left out because they end nowhere or lie beside the sheet.
    pub dropped_creases: usize,
    /// The length of these in all, in lengths of the file.
    pub dropped_length: f64,
    /// The length of all creases drawn, in lengths of the file.
    pub crease_length: f64,
    /// The first hundred of the creases left out.
    pub dropped: Vec<DroppedCreaseReport>,
}

/// A crease, or a part of one, that was left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DroppedCreaseReport {
    /// The element of the file that was left out.
    pub element: String,
    /// The point half-way, in the coordinates of the flat sheet.
    pub middle: [f64; 2],
    /// Its length, in lengths of the file.
    pub length: f64,
}

impl MendingReport {
    pub(crate) fn new(mending: &Mending) -> Self {
        let dropped = mending.dropped_creases.iter().map(|crease| DroppedCreaseReport {
            element: crease.source.to_string(),
            middle: crease.middle.to_array(),
            length: crease.length,
        });
        Self {
            tolerance: mending.tolerance,
            chosen_from_drawing: mending.chosen,
            merged_ends: mending.merged,
            snapped_vertices: mending.snapped,
            dropped_creases: mending.dropped,
            dropped_length: mending.dropped_length,
            crease_length: mending.crease_length,
            dropped: dropped.collect(),
        }
    }

    /// What the user is told; `None` if nothing was changed.
    pub(crate) fn line(&self) -> Option<String> {
        let mended = self.mended();
        let Some(first) = self.dropped.first() else { return mended };
        let chosen =
            if self.chosen_from_drawing { "chosen from the drawing" } else { "of the scene" };
        let dropped = format!(
            "{} creases or parts of creases, {:.4} of {:.4} long in all, were left out, for they end nowhere or lie beside the \
             sheet: the first is {} near ({:.4}, {:.4}); where a line should meet another, set pattern.vertex_tolerance \
             above the distance between them (now {:.3}, {chosen})",
            self.dropped_creases,
            self.dropped_length,
            self.crease_length,
            first.element,
            first.middle[0],
            first.middle[1],
            Number(self.tolerance)
        );
        Some(mended.map_or(dropped.clone(), |mended| format!("{mended}; {dropped}")))
    }

    fn mended(&self) -> Option<String> {
        (self.merged_ends + self.snapped_vertices > 0).then(|| {
            let chosen = if self.chosen_from_drawing { " (chosen from the drawing)" } else { "" };
            format!(
                "lines within {:.3} of each other meet{chosen}: {} ends became vertices near them, {} vertices lie on lines \
                 beside them",
                Number(self.tolerance),
                self.merged_ends,
                self.snapped_vertices
            )
        })
    }
}
