//! The clusters of a frame, and what is proved about their order.

use foldmotion_pattern::{Assignment, Sheet};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{
    Cluster, FaceEdges, LayerConflict, LayerPair, LayerProof, LayerRule, NARROW, RuleCounts,
    acyclic::LayerStack,
    flat, front_normal,
    hinges::{FrameLayers, Junction},
};

/// The number of pairs below which starting another thread does not pay.
const PAIRS_A_TASK: usize = 64;

/// The clusters of a frame, without frame index and time, and the contradictions in them.
#[derive(Debug)]
pub(crate) struct Proof {
    pub(crate) clusters: Vec<Cluster>,
    pub(crate) contradictions: Vec<Contradiction>,
}

/// Layers whose orders are not possible together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contradiction {
    /// Two of the layers, the smaller index first.
    pub(crate) faces: [u32; 2],
    pub(crate) conflict: LayerConflict,
    pub(crate) vertices: Vec<u32>,
    /// A point at which they lie on each other.
    pub(crate) point: DVec3,
}

/// Groups the layers of a frame into clusters and tests the rules in each.
///
/// `pairs`: sorted by their faces. `tolerance`: τ, a length.
pub(crate) fn prove(
    sheet: &Sheet,
    edges: &FaceEdges,
    positions: &[DVec3],
    pairs: &[LayerPair],
    tolerance: f64,
) -> Proof {
    let layers = FrameLayers { sheet, edges, positions, pairs, tolerance };
    let groups = groups(sheet.faces.len(), pairs);
    let mut proof =
        Proof { clusters: Vec::with_capacity(groups.len()), contradictions: Vec::new() };
    for group in &groups {
        let mut tests = ClusterTests::default();
        layers.test_hinges(group, &mut tests);
        let depth = layers.test_cycles(group, &mut tests);
        layers.count_creases(group, &mut tests);
        let all_known = group.pairs.iter().all(|&i| pairs[i].up.is_some());
        let order = match (tests.contradictions.is_empty(), all_known && !tests.is_partial) {
            (false, _) => LayerProof::Contradicted,
            (true, true) => LayerProof::Proved,
            (true, false) => LayerProof::Unproved,
        };
        proof.clusters.push(Cluster {
            frames: [0; 2],
            times: [0.0; 2],
            faces: group.faces.clone(),
            layers: depth,
            pairs: group.pairs.len(),
            order,
            rules: tests.counts,
        });
        proof.contradictions.append(&mut tests.contradictions);
    }
    proof
}

/// A connected component of the layers.
struct Group {
    /// The triangles, in increasing order.
    faces: Vec<u32>,
    /// The indices of its pairs, in increasing order.
    pairs: Vec<usize>,
}

/// The connected components, in the order of their first triangles.
fn groups(faces: usize, pairs: &[LayerPair]) -> Vec<Group> {
    let mut parent: Vec<u32> = (0..faces as u32).collect();
    for pair in pairs {
        let [f, g] = pair.faces.map(|face| root(&mut parent, face));
        parent[f.max(g) as usize] = f.min(g);
    }
    // The root is the smallest triangle, so groups come in the order of their roots.
    let mut group_of = vec![usize::MAX; faces];
    let mut groups: Vec<Group> = Vec::new();
    let mut is_layer = vec![false; faces];
    for face in pairs.iter().flat_map(|pair| pair.faces) {
        is_layer[face as usize] = true;
    }
    for face in (0..faces as u32).filter(|&f| is_layer[f as usize]) {
        let root = root(&mut parent, face) as usize;
        if group_of[root] == usize::MAX {
            group_of[root] = groups.len();
            groups.push(Group { faces: Vec::new(), pairs: Vec::new() });
        }
        groups[group_of[root]].faces.push(face);
    }
    for (index, pair) in pairs.iter().enumerate() {
        let root = root(&mut parent, pair.faces[0]) as usize;
        groups[group_of[root]].pairs.push(index);
    }
    groups
}

fn root(parent: &mut [u32], face: u32) -> u32 {
    let mut at = face;
    while parent[at as usize] != at {
        parent[at as usize] = parent[parent[at as usize] as usize];
        at = parent[at as usize];
    }
    at
}

/// The results of the tests in a cluster.
#[derive(Default)]
struct ClusterTests {
    counts: RuleCounts,
    contradictions: Vec<Contradiction>,
    /// Whether a test was skipped because an order is unknown.
    is_partial: bool,
}

impl FrameLayers<'_> {
    /// Tests taco–taco, taco–tortilla, tortilla–tortilla and bent creases.
    fn test_hinges(&self, group: &Group, tests: &mut ClusterTests) {
        let indices = group.pairs.par_iter().with_min_len(PAIRS_A_TASK);
        let mut junctions: Vec<_> = indices.flat_map_iter(|&i| self.junctions(i)).collect();
        junctions.sort_by_key(Junction::key);
        junctions.dedup_by(|p, q| p.key() == q.key());
        let outcomes: Vec<_> = junctions
            .par_iter()
            .with_min_len(PAIRS_A_TASK)
            .map(|junction| self.test(junction))
            .collect();
        for (junction, outcome) in junctions.iter().zip(outcomes) {
            let Some((rule, is_kept)) = outcome else {
                tests.is_partial = true;
                continue;
            };
            tests.counts.count(rule);
            if !is_kept {
                tests.contradictions.push(Contradiction {
                    faces: self.pairs[junction.pair].faces,
                    conflict: LayerConflict { rule, faces: junction.all_faces() },
                    vertices: junction.vertices(self.sheet),
                    point: junction.point,
                });
            }
        }
    }

    /// Tests transitivity. Returns the depth of the stack.
    fn test_cycles(&self, group: &Group, tests: &mut ClusterTests) -> usize {
        let corners =
            |face: u32| self.sheet.faces[face as usize].map(|v| self.positions[v as usize]);
        let normal = front_normal(self.sheet, group.faces[0], self.positions);
        let origin = corners(group.faces[0])[0];
        let (x, y) = normal.any_orthonormal_pair();
        let flat = |p: DVec3| DVec2::new(x.dot(p - origin), y.dot(p - origin));
        let local = |face: u32| group.faces.binary_search(&face).unwrap_or(0);
        let mut neighbours = vec![Vec::new(); group.faces.len()];
        let mut stack = LayerStack {
            triangles: group
                .faces
                .iter()
                .map(|&f| flat::counter_clockwise(corners(f).map(flat)))
                .collect(),
            above: neighbours.clone(),
        };
        for pair in group.pairs.iter().map(|&i| &self.pairs[i]) {
            let [f, g] = pair.faces.map(local);
            neighbours[f].push(g);
            neighbours[g].push(f);
            let Some(up) = pair.up else { continue };
            let (low, high) = if up.dot(normal) > 0.0 { (f, g) } else { (g, f) };
            stack.above[low].push(high);
            tests.counts.count(LayerRule::Transitivity);
        }
        for above in &mut stack.above {
            above.sort_unstable();
        }
        for (cycle, point) in stack.cycles(NARROW * self.tolerance) {
            let mut faces = cycle.map(|i| group.faces[i]);
            faces.sort_unstable();
            tests.contradictions.push(Contradiction {
                faces: [faces[0], faces[1]],
                conflict: LayerConflict { rule: LayerRule::Transitivity, faces: faces.to_vec() },
                vertices: self.sheet.faces[faces[0] as usize].to_vec(),
                point: origin + x * point.x + y * point.y,
            });
        }
        stack.depth(&neighbours, NARROW * self.tolerance)
    }

    /// Counts the creases that are folded flat to the side of their assignment.
    ///
    /// A crease folded to the other side is no contradiction: the motion shows how it came there.
    fn count_creases(&self, group: &Group, tests: &mut ClusterTests) {
        for pair in group.pairs.iter().map(|&i| &self.pairs[i]) {
            let [f, g] = pair.faces;
            let edge = (0..3)
                .filter_map(|i| self.edges.hinge(self.sheet, f, i))
                .find(|&(_, beyond)| beyond == g);
            let (Some((edge, _)), Some(up)) = (edge, pair.up) else {
                continue;
            };
            let is_front = front_normal(self.sheet, f, self.positions).dot(up) > 0.0;
            let expected = match self.sheet.edges[edge as usize].assignment {
                Assignment::Valley => true,
                Assignment::Mountain => false,
                _ => continue,
            };
            if is_front == expected {
                tests.counts.count(LayerRule::Crease);
            }
        }
    }
}
