//! The sheet prepared for drawing: what stays the same in every state of a motion.

use foldmotion_pattern::{Assignment, LayerOrder, Sheet};

/// A sheet with the lines of its facets and its layer order, ready to be looked up once a sample.
#[derive(Debug, Clone)]
pub struct Paper<'a> {
    /// The sheet that is drawn.
    pub sheet: &'a Sheet,
    /// The drawn edges of each triangle.
    face_edges: Vec<Vec<u32>>,
    /// The drawn edges of each facet, those of all its triangles.
    facet_edges: Vec<Vec<u32>>,
    /// For each triangle f the ordered (g, sign) of [`LayerOrder`]: a sorted row is found faster than a tree's node.
    layers: Vec<Vec<(u32, i8)>>,
}

impl<'a> Paper<'a> {
    /// Prepares `sheet`, whose coincident triangles lie in `order`.
    pub fn new(sheet: &'a Sheet, order: &LayerOrder) -> Self {
        let mut face_edges = vec![Vec::new(); sheet.faces.len()];
        let mut facet_edges = vec![Vec::new(); sheet.facets.len()];
        for (index, edge) in sheet.edges.iter().enumerate() {
            if edge.assignment == Assignment::Facet {
                continue;
            }
            for face in edge.faces.into_iter().flatten() {
                face_edges[face as usize].push(index as u32);
                let facet = sheet.face_facets[face as usize];
                facet_edges[facet as usize].push(index as u32);
            }
        }
        let mut layers = vec![Vec::new(); sheet.faces.len()];
        for (f, g, sign) in order.iter() {
            if let Some(row) = layers.get_mut(f as usize) {
                row.push((g, sign));
            }
        }
        Self { sheet, face_edges, facet_edges, layers }
    }

    /// The drawn edges of triangle `face`.
    pub(crate) fn edges_of_face(&self, face: u32) -> &[u32] {
        &self.face_edges[face as usize]
    }

    /// The drawn edges of the facet that triangle `face` belongs to: a line beside a sharp corner also covers a part
    /// of the facet's next triangle.
    pub(crate) fn edges_of_facet(&self, face: u32) -> &[u32] {
        &self.facet_edges[self.sheet.face_facets[face as usize] as usize]
    }

    /// The recorded sign of (f, g): on which side of g's front normal f lies.
    pub(crate) fn layer_sign(&self, f: u32, g: u32) -> Option<i8> {
        let row = &self.layers[f as usize];
        let index = row.binary_search_by_key(&g, |&(h, _)| h).ok()?;
        Some(row[index].1)
    }
}
