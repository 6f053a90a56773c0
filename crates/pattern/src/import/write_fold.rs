//! An imported pattern as FOLD 1.2.

use serde_json::{Map, Value, json};

use super::ImportedPattern;
use super::imported::RECORDED_STAGES;
use crate::fold::object_text;
use crate::{Assignment, Sheet};

/// Keys of FOLD that say what this writer says itself, or that a changed sheet makes wrong.
const OWN: [&str; 19] = [
    RECORDED_STAGES,
    "file_spec",
    "file_creator",
    "file_frames",
    "frame_parent",
    "frame_inherit",
    "frame_attributes",
    "vertices_edges",
    "vertices_faces",
    "vertices_vertices",
    "edges_edges",
    "edges_faces",
    "edges_length",
    "edges_lengths",
    "edgeOrders",
    "faceOrders",
    "faces_edges",
    "faces_faces",
    "faces_vertices",
];

impl ImportedPattern {
    /// The pattern as FOLD 1.2: its vertices, edges with assignment and target fold angle (degrees; null where an edge
    /// has none), faces, and a frame for each stage.
    ///
    /// Faces are the facets where each is one polygon without holes or cuts inside; otherwise all are triangles, with F
    /// edges between those of one facet. Keys that were not read are written as they were: lists with an entry for each
    /// vertex, edge or face (`edges_name:key`) are put in the order of the sheet, null where it has a new element;
    /// other keys as they are. Lists that relate elements to each other are left out.
    pub fn fold(&self, creator: &str) -> String {
        let written = WrittenElements::new(self);
        let mut file = written.kept();
        let edges = |of: &dyn Fn(usize) -> Value| -> Value {
            written.edges.iter().map(|&edge| of(edge)).collect()
        };
        let sheet = &self.sheet;
        file.insert("file_spec".into(), json!(1.2));
        file.insert("file_creator".into(), json!(creator));
        if let Some(title) = &self.title {
            file.insert("file_title".into(), json!(title));
        }
        file.insert("frame_classes".into(), json!(["creasePattern"]));
        file.insert("frame_unit".into(), json!(self.unit.name()));
        file.insert("foldmotion:unitLength".into(), json!(sheet.unit_length));
        let position = |v: &glam::DVec2| json!(v.to_array());
        file.insert("vertices_coords".into(), sheet.vertices.iter().map(position).collect());
        file.insert("edges_vertices".into(), edges(&|e| json!(sheet.edges[e].vertices)));
        file.insert("edges_assignment".into(), edges(&|e| json!(sheet.edges[e].assignment)));
        file.insert("edges_foldAngle".into(), edges(&|e| json!(self.target_degrees(e))));
        file.insert("faces_vertices".into(), written.faces.clone());
        let frames: Vec<Value> = self
            .stages
            .iter()
            .map(|stage| {
                let angle = |e: usize| json!(stage.angles[e].map(f64::to_degrees));
                let mut frame = json!({
                    "frame_parent": 0, "frame_inherit": true, "edges_foldAngle": edges(&angle),
                });
                if let Some(title) = &stage.title {
                    frame["frame_title"] = json!(title);
                }
                frame
            })
            .collect();
        if !frames.is_empty() {
            file.insert("file_frames".into(), json!(frames));
        }
        object_text(file.iter().map(|(key, value)| (key.as_str(), value)))
    }

    /// The keys of the FOLD file that were not read, for a file whose faces are the triangles of the sheet:
    /// as in [`Self::fold`].
    pub fn keys_of_triangles(&self) -> Map<String, Value> {
        WrittenElements::of_triangles(self).kept()
    }

    fn target_degrees(&self, edge: usize) -> Option<f64> {
        match self.sheet.edges[edge].assignment {
            Assignment::Border | Assignment::Free => None,
            Assignment::Mountain | Assignment::Valley | Assignment::Facet => {
                Some(self.targets[edge].to_degrees())
            }
        }
    }
}

/// The elements that are written, and where they come from.
struct WrittenElements<'a> {
    imported: &'a ImportedPattern,
    /// The indices of the edges that are written.
    edges: Vec<usize>,
    /// `faces_vertices`.
    faces: Value,
    /// The facet of each face.
    face_facets: Vec<u32>,
}

impl<'a> WrittenElements<'a> {
    fn new(imported: &'a ImportedPattern) -> Self {
        let sheet = &imported.sheet;
        let are_polygons = are_polygons(sheet);
        let is_written = |edge: &usize| !are_polygons || imported.edge_sources[*edge].is_some();
        let (faces, face_facets) = if are_polygons {
            let polygons = sheet.facets.iter().map(|f| json!(f.polygon)).collect();
            (polygons, (0..sheet.facets.len() as u32).collect())
        } else {
            (json!(sheet.faces), sheet.face_facets.clone())
        };
        Self {
            imported,
            edges: (0..sheet.edges.len()).filter(is_written).collect(),
            faces,
            face_facets,
        }
    }

    fn of_triangles(imported: &'a ImportedPattern) -> Self {
        let sheet = &imported.sheet;
        Self {
            imported,
            edges: (0..sheet.edges.len()).collect(),
            faces: json!(sheet.faces),
            face_facets: sheet.face_facets.clone(),
        }
    }

    /// The keys that were not read.
    fn kept(&self) -> Map<String, Value> {
        let keys = self.imported.keys.iter();
        let kept = keys.filter(|(key, _)| !OWN.contains(&key.as_str()));
        kept.map(|(key, value)| (key.clone(), self.reordered(key, value))).collect()
    }

    /// A list of the file in the order of the sheet; any other value as it is.
    fn reordered(&self, key: &str, value: &Value) -> Value {
        let imported = self.imported;
        let Some(list) = value.as_array() else {
            return value.clone();
        };
        let take = |from: Vec<Option<u32>>| -> Value {
            let entry = |index: Option<u32>| list.get(index? as usize).cloned();
            from.into_iter().map(|i| entry(i).unwrap_or(Value::Null)).collect()
        };
        // The element is named first (`edges_name:key`) or after a prefix (`name:edges_key`).
        let of = |kind: &str| key.split(':').any(|part| part.starts_with(kind));
        let [vertices, edges, faces] = imported.listed;
        if of("vertices_") && list.len() == vertices {
            take(imported.vertex_sources.clone())
        } else if of("edges_") && list.len() == edges {
            take(self.edges.iter().map(|&e| imported.fold_edge(e)).collect())
        } else if of("faces_") && list.len() == faces {
            take(self.face_facets.iter().map(|&f| Some(f)).collect())
        } else {
            value.clone()
        }
    }
}

/// Whether every facet is one polygon with edges of its own around it, no two corners in one point.
fn are_polygons(sheet: &Sheet) -> bool {
    let mut triangles = vec![0; sheet.facets.len()];
    for &facet in &sheet.face_facets {
        triangles[facet as usize] += 1;
    }
    let is_polygon = |(facet, count): (&crate::Facet, &usize)| {
        let mut places: Vec<[u64; 2]> = facet
            .polygon
            .iter()
            .map(|&v| sheet.vertices[v as usize].to_array().map(f64::to_bits))
            .collect();
        places.sort_unstable();
        places.dedup();
        places.len() == count + 2 && facet.polygon.len() == count + 2
    };
    sheet.facets.iter().zip(&triangles).all(is_polygon)
}
