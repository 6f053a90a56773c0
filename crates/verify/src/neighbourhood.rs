//! Which triangles surround which edges and vertices of the sheet.

use std::collections::BTreeMap;

use foldmotion_pattern::Sheet;

use crate::piercing::Surface;

/// The triangles of the sheet, looked up by their edges and vertices.
#[derive(Debug)]
pub(crate) struct Neighbourhood {
    pub(crate) faces: Vec<[u32; 3]>,
    at_edge: BTreeMap<[u32; 2], Vec<u32>>,
    at_vertex: Vec<Vec<u32>>,
}

impl Neighbourhood {
    pub(crate) fn new(sheet: &Sheet) -> Self {
        let mut at_edge: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
        let mut at_vertex = vec![Vec::new(); sheet.vertices.len()];
        for (face, corners) in (0..).zip(&sheet.faces) {
            for edge in edges(corners) {
                at_edge.entry(edge).or_default().push(face);
            }
            for &v in corners {
                at_vertex[v as usize].push(face);
            }
        }
        Self { faces: sheet.faces.clone(), at_edge, at_vertex }
    }

    /// The triangles beyond an edge of a triangle.
    pub(crate) fn beyond(&self, face: u32, edge: [u32; 2]) -> impl Iterator<Item = u32> {
        let all = self.at_edge.get(&edge).into_iter().flatten().copied();
        all.filter(move |&other| other != face)
    }

    pub(crate) fn corners(&self, face: u32) -> &[u32; 3] {
        &self.faces[face as usize]
    }

    /// Whether two triangles are the same or have a vertex in common.
    pub(crate) fn meet(&self, f: u32, g: u32) -> bool {
        let g = self.corners(g);
        self.corners(f).iter().any(|v| g.contains(v))
    }

    /// Whether a pair is around another: each triangle of it shares a vertex with a different triangle of the other.
    pub(crate) fn is_around(&self, [f, g]: [u32; 2], [p, q]: [u32; 2]) -> bool {
        (self.meet(f, p) && self.meet(g, q)) || (self.meet(f, q) && self.meet(g, p))
    }

    /// The triangles with a vertex among those given, each once.
    pub(crate) fn faces_at(&self, vertices: &[u32]) -> Vec<u32> {
        let mut faces: Vec<u32> =
            vertices.iter().flat_map(|&v| self.at_vertex[v as usize].iter().copied()).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// A triangle, the two triangles at each of its edges, and the triangles around each of its vertices.
    pub(crate) fn surfaces_of(&self, face: u32) -> Vec<Surface> {
        let corners = self.corners(face);
        let at_edges = edges(corners).map(|side| self.at_edge.get(&side));
        let at_vertices = corners.map(|v| self.at_vertex.get(v as usize));
        let several = at_edges.into_iter().chain(at_vertices).flatten();
        let all = several.map(|faces| faces.iter().map(|&f| *self.corners(f)).collect());
        let all = std::iter::once(vec![*corners]).chain(all);
        all.filter_map(|triangles: Vec<[u32; 3]>| Surface::of(&triangles)).collect()
    }

    /// The triangles with a vertex among those given, the two at each of their edges, and the triangles around each of
    /// the vertices.
    pub(crate) fn surfaces_at(&self, vertices: &[u32]) -> Vec<Surface> {
        let faces = self.faces_at(vertices);
        let mut sides: Vec<[u32; 2]> = faces.iter().flat_map(|&f| edges(self.corners(f))).collect();
        sides.sort_unstable();
        sides.dedup();
        let at_edges = sides.iter().filter_map(|side| self.at_edge.get(side));
        let at_vertices = vertices.iter().map(|&v| &self.at_vertex[v as usize]);
        let several = at_edges.chain(at_vertices).filter(|faces| faces.len() > 1);
        let corners = |f: &u32| *self.corners(*f);
        let several = several.map(|faces| faces.iter().map(corners).collect());
        let single = faces.iter().map(|f| vec![corners(f)]);
        let all = single.chain(several);
        all.filter_map(|triangles: Vec<[u32; 3]>| Surface::of(&triangles)).collect()
    }

    /// The edges with an end among the vertices given, each once.
    pub(crate) fn edges_at(&self, vertices: &[u32]) -> Vec<[u32; 2]> {
        let faces = self.faces_at(vertices);
        let all = faces.iter().flat_map(|&face| edges(self.corners(face)));
        let mut ending: Vec<[u32; 2]> =
            all.filter(|edge| edge.iter().any(|v| vertices.contains(v))).collect();
        ending.sort_unstable();
        ending.dedup();
        ending
    }
}

/// The edges of a triangle, the lower end first.
pub(crate) fn edges(corners: &[u32; 3]) -> [[u32; 2]; 3] {
    [0, 1, 2].map(|i| {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        [p.min(q), p.max(q)]
    })
}
