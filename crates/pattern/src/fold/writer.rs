//! The writer: the keys of a crease pattern, and keys as the text of a file.

use serde_json::{Value, json};

use crate::{Assignment, Edge, Facet, Sheet};

/// A crease pattern as the key frame of a FOLD file.
pub(crate) struct CreasePattern<'a> {
    pub(crate) sheet: &'a Sheet,
    /// The fold angle every edge of the sheet is to take, radians.
    pub(crate) target_angles: &'a [f64],
    pub(crate) title: &'a str,
    pub(crate) creator: &'a str,
    pub(crate) description: Option<&'a str>,
    pub(crate) file_classes: &'a [&'a str],
    /// `frame_unit`.
    pub(crate) unit: &'a str,
    /// The length in the file of a unit of the sheet.
    pub(crate) scale: f64,
    /// Whether the faces are triangles, joined by F edges, rather than facets.
    pub(crate) has_triangles: bool,
}

impl CreasePattern<'_> {
    /// The keys in the order in which they are written.
    pub(crate) fn keys(&self) -> Vec<(&'static str, Value)> {
        let sheet = self.sheet;
        let is_written = |edge: &Edge| self.has_triangles || edge.assignment != Assignment::Facet;
        let edges = sheet.edges.iter().zip(self.target_angles);
        let edges: Vec<(&Edge, &f64)> = edges.filter(|(edge, _)| is_written(edge)).collect();
        let vertices = sheet.vertices.iter().map(|&v| (v * self.scale).to_array());
        let degrees = |(edge, angle): &(&Edge, &f64)| edge.is_hinge().then(|| angle.to_degrees());
        let of_edges = |value: &dyn Fn(&(&Edge, &f64)) -> Value| -> Value {
            edges.iter().map(value).collect()
        };
        let mut keys = vec![
            ("file_spec", json!(1.2)),
            ("file_creator", json!(self.creator)),
            ("file_title", json!(self.title)),
        ];
        keys.extend(self.description.map(|text| ("file_description", json!(text))));
        keys.extend([
            ("file_classes", json!(self.file_classes)),
            ("frame_title", json!("crease pattern")),
            ("frame_classes", json!(["creasePattern"])),
            ("frame_attributes", json!(["2D", "manifold", "orientable", "noCuts", "noJoins"])),
            ("frame_unit", json!(self.unit)),
            ("foldmotion:unitLength", json!(sheet.unit_length * self.scale)),
            ("vertices_coords", vertices.collect()),
            ("edges_vertices", of_edges(&|(edge, _)| json!(edge.vertices))),
            ("edges_assignment", of_edges(&|(edge, _)| json!(edge.assignment))),
            ("edges_foldAngle", of_edges(&|edge| json!(degrees(edge)))),
        ]);
        keys.extend(self.faces());
        keys
    }

    /// The faces, and the facet, row, column and kind of each.
    fn faces(&self) -> [(&'static str, Value); 5] {
        let sheet = self.sheet;
        let (polygons, facets): (Value, Vec<u32>) = if self.has_triangles {
            (json!(sheet.faces), sheet.face_facets.clone())
        } else {
            let polygons = sheet.facets.iter().map(|f| json!(f.polygon)).collect();
            (polygons, (0..sheet.facets.len() as u32).collect())
        };
        let of_facets = |value: fn(&Facet) -> Value| -> Value {
            let facet = |&index: &u32| value(&sheet.facets[index as usize]);
            facets.iter().map(facet).collect()
        };
        [
            ("faces_vertices", polygons),
            ("faces_foldmotion:facet", json!(facets)),
            ("faces_foldmotion:row", of_facets(|f| json!(f.row))),
            ("faces_foldmotion:column", of_facets(|f| json!(f.column))),
            ("faces_foldmotion:kind", of_facets(|f| json!(f.kind))),
        ]
    }
}

/// The text of a file with these keys, one a line.
pub(crate) fn object_text<'a>(keys: impl IntoIterator<Item = (&'a str, &'a Value)>) -> String {
    let line = |(key, value): (&str, &Value)| format!("{}: {value}", json!(key));
    let lines: Vec<String> = keys.into_iter().map(line).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}
