//! The clusters of layers at an instant, and the order in each.

use std::collections::BTreeMap;

use foldmotion_pattern::Sheet;
use glam::DVec2;
use rayon::prelude::*;

use crate::layer::{Layer, LayerTolerances, NARROW, corners};
use crate::line::{Junction, JunctionKey, LayerStacks, around};
use crate::plane::{Plane, holds, inset, least_width, within};
use foldmotion_check::{LayerProof, LayerRule};

/// The sides of triangles are moved inward by this share of τ, so that neighbours do not count as lying on each other.
const INSET: f64 = 0.1;

/// Layers whose orders are not possible together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contradiction {
    pub(crate) rule: LayerRule,
    /// The triangles, each once, in increasing order.
    pub(crate) faces: Vec<u32>,
    /// The vertices of what meets, each once, in increasing order; empty if any of the triangles may be named.
    pub(crate) vertices: Vec<u32>,
}

/// Triangles that lie on each other, directly or through others.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FoundCluster {
    /// The indices of the first and the last frame.
    pub(crate) frames: [usize; 2],
    pub(crate) times: [f64; 2],
    pub(crate) faces: Vec<u32>,
    /// The largest number of layers over any point.
    pub(crate) layers: usize,
    pub(crate) pairs: usize,
    pub(crate) order: LayerProof,
    pub(crate) contradictions: Vec<Contradiction>,
}

impl FoundCluster {
    /// Extends the cluster by the same triangles at the next frame.
    pub(crate) fn go_on(&mut self, next: &Self) {
        self.frames[1] = next.frames[1];
        self.times[1] = next.times[1];
        self.layers = self.layers.max(next.layers);
        self.pairs = self.pairs.max(next.pairs);
        self.order = self.order.max(next.order);
    }
}

/// Groups the layers of an instant and tests the order of each group.
pub(crate) fn prove(
    sheet: &Sheet,
    hinges: &[[Option<(u32, u32)>; 3]],
    positions: &[glam::DVec3],
    layers: &[Layer],
    scale: LayerTolerances,
) -> Vec<FoundCluster> {
    let stacks =
        LayerStacks { sheet, positions, scale, around: around(sheet.faces.len(), layers), hinges };
    let groups = stacks.groups();
    groups.into_iter().map(|group| stacks.prove(group)).collect()
}

impl LayerStacks<'_> {
    /// The connected components of the layers, in the order of their first triangles.
    fn groups(&self) -> Vec<Vec<u32>> {
        let mut is_seen = vec![false; self.around.len()];
        let mut groups = Vec::new();
        for first in 0..self.around.len() {
            if is_seen[first] || self.around[first].is_empty() {
                continue;
            }
            is_seen[first] = true;
            let mut group = vec![first as u32];
            let mut next = 0;
            while next < group.len() {
                for &(face, _) in &self.around[group[next] as usize] {
                    if !std::mem::replace(&mut is_seen[face as usize], true) {
                        group.push(face);
                    }
                }
                next += 1;
            }
            group.sort_unstable();
            groups.push(group);
        }
        groups
    }

    fn prove(&self, faces: Vec<u32>) -> FoundCluster {
        let mut contradictions = Vec::new();
        let mut is_open = false;
        for junction in self.junctions(&faces).values() {
            let Some(crosses) = junction.crosses else {
                is_open = true;
                continue;
            };
            if crosses {
                contradictions.push(Contradiction {
                    rule: junction.rule,
                    faces: junction.faces.clone(),
                    vertices: junction.vertices.clone(),
                });
            }
        }
        let flat = Flat::new(self, &faces);
        contradictions.extend(flat.rounds(self));
        let pairs = self.pairs(&faces);
        is_open |= pairs.clone().any(|(f, g)| self.below(f, g).is_none());
        let pairs = pairs.count();
        let order = if !contradictions.is_empty() {
            LayerProof::Contradicted
        } else if is_open {
            LayerProof::Unproved
        } else {
            LayerProof::Proved
        };
        FoundCluster {
            frames: [0; 2],
            times: [0.0; 2],
            layers: flat.depth(self),
            faces,
            pairs,
            order,
            contradictions,
        }
    }

    /// The pairs of layers of a cluster, the smaller index first.
    fn pairs<'a>(&'a self, faces: &'a [u32]) -> impl Iterator<Item = (u32, u32)> + Clone + 'a {
        let later = |f: u32| {
            let others = self.around[f as usize].iter().map(|&(g, _)| g);
            others.filter(move |&g| g > f).map(move |g| (f, g))
        };
        faces.iter().flat_map(move |&f| later(f))
    }

    fn junctions(&self, faces: &[u32]) -> BTreeMap<JunctionKey, Junction> {
        let of_face = |&face: &u32| {
            let mut junctions = BTreeMap::new();
            for i in 0..3 {
                self.meet(face, i, &mut junctions);
            }
            junctions
        };
        let parts: Vec<BTreeMap<JunctionKey, Junction>> = faces.par_iter().map(of_face).collect();
        let mut all = BTreeMap::new();
        for part in parts {
            for (key, junction) in part {
                let known: &mut Junction = all.entry(key).or_insert_with(|| junction.clone());
                if known.crosses != Some(true) && junction.crosses.is_some() {
                    *known = junction;
                }
            }
        }
        all
    }
}

/// A cluster projected along the normal of its first triangle.
struct Flat<'a> {
    faces: &'a [u32],
    /// The projected triangles, in the order of `faces`.
    triangles: Vec<[DVec2; 3]>,
    plane: Option<Plane>,
}

impl<'a> Flat<'a> {
    fn new(stacks: &LayerStacks<'_>, faces: &'a [u32]) -> Self {
        let of = |face: u32| corners(stacks.sheet, stacks.positions, face);
        let plane = Plane::of(&of(faces[0]));
        let flat = |&face: &u32| plane.map_or([DVec2::ZERO; 3], |p| p.triangle(&of(face)));
        Self { faces, triangles: faces.iter().map(flat).collect(), plane }
    }

    fn triangle(&self, face: u32) -> &[DVec2; 3] {
        &self.triangles[self.faces.partition_point(|&f| f < face)]
    }

    /// Every three layers over a common region of which each lies above the one before, in a cycle.
    ///
    /// All triples are tried: layers over one point have a strict order exactly if no three of them form a cycle.
    fn rounds(&self, stacks: &LayerStacks<'_>) -> Vec<Contradiction> {
        let Some(plane) = self.plane else {
            return Vec::new();
        };
        let is_below = |f: u32, g: u32| Some(stacks.below(f, g)?.dot(plane.normal) > 0.0);
        let of_face = |&f: &u32| {
            let later = stacks.around[f as usize].iter().filter(|(g, _)| *g > f);
            let later: Vec<(u32, bool)> =
                later.filter_map(|&(g, up)| Some((g, up?.dot(plane.normal) > 0.0))).collect();
            let mut found = Vec::new();
            for (k, &(g, f_below_g)) in later.iter().enumerate() {
                for &(h, f_below_h) in &later[k + 1..] {
                    let goes_round = f_below_g != f_below_h && is_below(g, h) == Some(f_below_g);
                    if goes_round && self.is_common([f, g, h], stacks.scale.narrow()) {
                        found.push(Contradiction {
                            rule: LayerRule::Transitivity,
                            faces: vec![f, g, h],
                            vertices: Vec::new(),
                        });
                    }
                }
            }
            found
        };
        self.faces.par_iter().flat_map_iter(of_face).collect()
    }

    fn is_common(&self, [f, g, h]: [u32; 3], narrow: f64) -> bool {
        let two = within(self.triangle(f), self.triangle(g));
        least_width(&within(&two, self.triangle(h))) > narrow
    }

    /// The largest number of layers over any point.
    ///
    /// The region under the deepest stack is a convex polygon. Its first corner, ordered by coordinates, is also the
    /// first corner of the common region of two of its layers, whichever these are; so it is enough to count at such
    /// corners. All triangles are slightly shrunk here, so that those that only touch at the corner are not counted.
    fn depth(&self, stacks: &LayerStacks<'_>) -> usize {
        let by = INSET * stacks.scale.narrow() / NARROW;
        let small: Vec<_> = self.triangles.iter().map(|t| inset(t, by)).collect();
        let of = |face: u32| &small[self.faces.partition_point(|&f| f < face)];
        let at = |&f: &u32| {
            let others = &stacks.around[f as usize];
            let mut most = 1;
            for &(g, _) in others {
                let common = within(of(f), of(g));
                let first =
                    common.iter().min_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
                let Some(&corner) = first else { continue };
                let over = others.iter().filter(|&&(h, _)| holds(of(h), corner, 0.2 * by));
                most = most.max(1 + over.count());
            }
            most
        };
        self.faces.par_iter().map(at).max().unwrap_or(0)
    }
}
