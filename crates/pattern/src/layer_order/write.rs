//! The flat state as FOLD 1.2.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::FlatState;
use crate::fold::{CreasePattern, object_text};
use crate::{Assignment, LayerOrder, Sheet};

impl FlatState {
    /// The crease pattern as key frame, and this state with `faceOrders` as a frame of the class `foldedForm`.
    ///
    /// Faces are the triangles. Free hinges are mountains or valleys, as the order has them. `unit`: FOLD's name of the unit
    /// of length.
    pub fn fold(&self, order: &LayerOrder, title: &str, creator: &str, unit: &str) -> String {
        let sheet = self.creased(order);
        let target = |edge: &crate::Edge| match edge.assignment {
            Assignment::Valley => PI,
            Assignment::Mountain => -PI,
            _ => 0.0,
        };
        let targets: Vec<f64> = sheet.edges.iter().map(target).collect();
        let pattern = CreasePattern {
            sheet: &sheet,
            target_angles: &targets,
            title,
            creator,
            description: None,
            file_classes: &["singleModel"],
            unit,
            scale: 1.0,
            has_triangles: true,
        };
        let positions: Vec<[f64; 2]> = self.positions.iter().map(glam::DVec2::to_array).collect();
        // Each pair once: the sign of (f, g) follows from that of (g, f).
        let orders = order.iter().filter(|(f, g, _)| f < g);
        let orders: Vec<Value> = orders.map(|(f, g, sign)| json!([f, g, sign])).collect();
        let frame = json!({
            "frame_parent": 0, "frame_inherit": true, "frame_title": "flat state",
            "frame_classes": ["foldedForm"], "vertices_coords": positions, "faceOrders": orders,
        });
        let mut keys = pattern.keys();
        keys.push(("file_frames", json!([frame])));
        object_text(keys.iter().map(|(key, value)| (*key, value)))
    }

    /// The sheet with mountains and valleys at the free hinges that are folded.
    fn creased(&self, order: &LayerOrder) -> Sheet {
        let mut sheet = self.sheet.clone();
        for edge in &mut sheet.edges {
            if let (Assignment::Free, [Some(f), Some(g)]) = (edge.assignment, edge.faces) {
                edge.assignment = match order.sign(f, g) {
                    Some(1) => Assignment::Valley,
                    Some(_) => Assignment::Mountain,
                    None => Assignment::Free,
                };
            }
        }
        sheet
    }
}
