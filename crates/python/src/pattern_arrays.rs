//! A crease pattern given as arrays, as FOLD.

use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::array::{indices, numbers};
use crate::error::bad_input;

/// The letters of edges.
const LETTERS: [&str; 7] = ["M", "V", "B", "F", "U", "C", "J"];

/// The arrays of a crease pattern.
pub(crate) struct PatternArrays {
    vertices: Vec<Vec<f64>>,
    edges: Vec<Vec<i64>>,
    assignment: Vec<String>,
    /// In degrees; `None` for those of flat folding.
    fold_angles: Option<Vec<f64>>,
}

impl PatternArrays {
    /// Reads the arrays; refuses those of the wrong shape or type, and numbers that are not finite.
    pub(crate) fn read(
        py: Python<'_>,
        vertices: &Bound<'_, PyAny>,
        edges: Option<&Bound<'_, PyAny>>,
        assignment: Option<&Bound<'_, PyAny>>,
        fold_angles: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (Some(edges), Some(assignment)) = (edges, assignment) else {
            return Err(bad_input(py, "an array of vertices needs edges and assignment"));
        };
        let vertices = numbers("vertices", vertices, 2)?;
        if vertices.is_empty() {
            return Err(bad_input(py, "vertices: there are none"));
        }
        let edges = indices("edges", edges, 2, vertices.len())?;
        let assignment = letters(py, assignment, edges.len())?;
        let fold_angles =
            fold_angles.map(|angles| numbers("fold_angles", angles, 0)).transpose()?;
        let fold_angles: Option<Vec<f64>> = fold_angles.map(|rows| rows.concat());
        if let Some(angles) = fold_angles.as_ref().filter(|angles| angles.len() != edges.len()) {
            let message = format!("fold_angles: {} values for {} edges", angles.len(), edges.len());
            return Err(bad_input(py, message));
        }
        Ok(Self { vertices, edges, assignment, fold_angles })
    }

    /// The pattern as FOLD 1.2.
    pub(crate) fn fold(&self) -> String {
        let mut fold = json!({
            "file_spec": 1.2,
            "file_classes": ["singleModel"],
            "frame_classes": ["creasePattern"],
            "vertices_coords": self.vertices,
            "edges_vertices": self.edges,
            "edges_assignment": self.assignment,
        });
        if let Some(angles) = &self.fold_angles {
            fold["edges_foldAngle"] = Value::from(angles.clone());
        }
        fold.to_string()
    }
}

/// One letter for each edge.
fn letters(py: Python<'_>, object: &Bound<'_, PyAny>, edges: usize) -> PyResult<Vec<String>> {
    let letters: Vec<String> = object
        .try_iter()
        .and_then(|items| items.map(|item| item?.extract()).collect())
        .map_err(|_| bad_input(py, "assignment: expected a letter for each edge"))?;
    if letters.len() != edges {
        let message = format!("assignment: {} letters for {edges} edges", letters.len());
        return Err(bad_input(py, message));
    }
    match letters.iter().position(|letter| !LETTERS.contains(&letter.as_str())) {
        Some(edge) => {
            let known = LETTERS.join(", ");
            let message = format!("assignment[{edge}] = {:?}: expected {known}", letters[edge]);
            Err(bad_input(py, message))
        }
        None => Ok(letters),
    }
}
