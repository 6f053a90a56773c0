//! Ambiguous sides, narrowed down by the sides of the triangles beyond an edge.
//!
//! A pair that slid into contact may be on either side of each other, and so may each of two pairs across an edge. If
//! one of them is on one side, the other is on the side that fits together with it, from then on.

use glam::DVec3;

use crate::arcs::are_connected;
use crate::coupling::{CLEAR, ContactPair, oriented};
use crate::face_pair::FacePair;
use crate::neighbourhood::edges;
use crate::side::Side;
use crate::trail::{Trail, apart};
use crate::verifier::Verifier;

/// The largest number of rounds in which sides are passed on at an instant.
const MOST_ROUNDS: usize = 8;

impl Verifier<'_> {
    /// Finds which of the ambiguous sides at the last frame fit together.
    ///
    /// The order of layers depends only on the sides that were followed; the choice made here is used for passages
    /// only.
    pub(crate) fn narrow_sides(&mut self) {
        let is_open = |side: &[DVec3]| side.iter().any(|d| d.dot(side[0]) < 0.5);
        for _ in 0..MOST_ROUNDS {
            let mut changed = Vec::new();
            for (faces, side) in &self.sides {
                let known = self.narrowed.get(faces).unwrap_or(side);
                if is_open(&known.directions) {
                    let kept = self.fitting(*faces, known.directions.clone());
                    if kept.len() < known.directions.len() {
                        changed.push((*faces, kept));
                    }
                }
            }
            if changed.is_empty() {
                return;
            }
            for (faces, directions) in changed {
                self.narrowed.insert(faces, Side::contact(directions));
            }
        }
    }

    /// The directions of a pair that fit together with the sides of all pairs across an edge; all of them if none fits.
    fn fitting(&self, faces: [u32; 2], directions: Vec<DVec3>) -> Vec<DVec3> {
        let positions = &self.last.positions;
        let pair = FacePair::new(self.sheet, faces);
        let followed = ContactPair {
            pair: &pair,
            moving: pair.moving(positions, positions),
            trail: &Trail::default(),
            tolerance: self.limits.tolerance,
        };
        let mut kept = directions;
        for (wall, face) in [(faces[0], faces[1]), (faces[1], faces[0])] {
            let corners = self.around.corners(wall);
            for edge in edges(self.around.corners(face)) {
                if edge.iter().all(|v| corners.contains(v)) {
                    continue;
                }
                let poses = followed.to_edge(wall, edge, 1.0);
                for other in self.around.beyond(face, edge) {
                    let beyond = FacePair::new(self.sheet, [wall.min(other), wall.max(other)]);
                    let there = oriented(&beyond, wall, self.side_of_pair(&beyond));
                    let fits = |d: &DVec3| {
                        let here = oriented(&pair, wall, vec![*d]);
                        let level = CLEAR * self.limits.tolerance;
                        there.is_empty()
                            || poses.iter().all(|pose| are_connected(pose, &here, &there, level))
                    };
                    let fitting: Vec<DVec3> = kept.iter().copied().filter(fits).collect();
                    if !fitting.is_empty() {
                        kept = fitting;
                    }
                }
            }
        }
        kept
    }

    /// The directions of a pair at the last frame; empty if it has no side.
    fn side_of_pair(&self, pair: &FacePair) -> Vec<DVec3> {
        let faces = pair.faces;
        if let Some(narrowed) = self.narrowed.get(&faces) {
            return narrowed.directions.clone();
        }
        if let Ok(index) = self.sides.binary_search_by(|(f, _)| f.cmp(&faces)) {
            return self.sides[index].1.directions.clone();
        }
        let is_open =
            self.undecided.iter().any(|(open, frame)| *open == faces && frame + 1 == self.frames);
        if is_open
            || pair.shared > 2
            || self.lost.contains(&faces)
            || self.dropped.contains_key(&faces)
        {
            return Vec::new();
        }
        let positions = &self.last.positions;
        apart(&pair.moving(positions, positions), 0.0)
    }
}
