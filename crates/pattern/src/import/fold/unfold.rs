//! A FOLD shape that is folded in space, laid out flat.

use std::collections::VecDeque;

use glam::{DMat2, DVec2, DVec3};

use super::super::ImportError;
use super::super::drawing::Role;
use super::FoldPattern;
use super::edges::EdgeMeaning;
use super::sides::{Sides, sides};
use crate::FrameNumber;

/// How far apart two faces may place a vertex, in parts of the extent of the shape.
const APART: f64 = 1e-4;
/// Fold angles this near to none or to a half turn do not say by themselves which way the crease folds, radians.
const UNSIGNED: f64 = 1e-6;

/// The faces of a shape, all seen from one side where the sheet has two.
pub(super) struct Unfolding<'a> {
    pattern: &'a FoldPattern<'a>,
    sides: Sides,
    /// The corners of each face, in the order in which the front sees them counter-clockwise.
    faces: Vec<Vec<u32>>,
    /// The vertices in the plane; those of no face at 0.
    pub(super) points: Vec<DVec2>,
}

/// Lays the faces side by side, each hinged to one that already lies.
///
/// # Errors
/// [`ImportError::NotDevelopable`].
pub(super) fn unfold<'a>(
    pattern: &'a FoldPattern<'a>,
    size: f64,
) -> Result<Unfolding<'a>, ImportError> {
    let mut unfolding = Unfolding {
        pattern,
        sides: sides(pattern.faces),
        faces: pattern.faces.to_vec(),
        points: vec![DVec2::ZERO; pattern.coordinates.len()],
    };
    let mut placed = vec![None; pattern.coordinates.len()];
    let mut is_laid = vec![false; unfolding.faces.len()];
    for first in 0..unfolding.faces.len() {
        if is_laid[first] {
            continue;
        }
        is_laid[first] = true;
        unfolding.place(first, None, &mut placed, APART * size)?;
        let mut reached = VecDeque::from([first]);
        while let Some(face) = reached.pop_front() {
            for ends in around(&unfolding.faces[face]) {
                let Some(next) = unfolding.beyond(face, ends) else { continue };
                if std::mem::replace(&mut is_laid[next], true) {
                    continue;
                }
                if around(&unfolding.faces[next]).contains(&ends) {
                    unfolding.faces[next].reverse();
                }
                unfolding.place(next, Some(ends), &mut placed, APART * size)?;
                reached.push_back(next);
            }
        }
    }
    unfolding.points = placed.into_iter().map(Option::unwrap_or_default).collect();
    Ok(unfolding)
}

/// The sides of a face in its order.
fn around(face: &[u32]) -> Vec<[u32; 2]> {
    let next = face.iter().cycle().skip(1);
    face.iter().zip(next).map(|(&a, &b)| [a, b]).collect()
}

impl Unfolding<'_> {
    /// The face beyond a side, if one other face is.
    fn beyond(&self, face: usize, [a, b]: [u32; 2]) -> Option<usize> {
        match *self.sides.get(&[a.min(b), a.max(b)])?.as_slice() {
            [f, g] if f as usize == face => Some(g as usize),
            [f, g] if g as usize == face => Some(f as usize),
            _ => None,
        }
    }

    fn normal(&self, face: usize) -> DVec3 {
        let corners = &self.faces[face];
        let first = self.pattern.coordinates[corners[0] as usize];
        let from_first = |v: u32| self.pattern.coordinates[v as usize] - first;
        let pairs = corners.windows(2).map(|p| from_first(p[0]).cross(from_first(p[1])));
        pairs.sum::<DVec3>().normalize_or(DVec3::Z)
    }

    /// Places the corners of a face; `hinge`: a side that lies already, in the order of the face beyond it.
    fn place(
        &self,
        face: usize,
        hinge: Option<[u32; 2]>,
        placed: &mut [Option<DVec2>],
        limit: f64,
    ) -> Result<(), ImportError> {
        let corners = &self.faces[face];
        let [a, b] = hinge.unwrap_or([corners[0], corners[1]]);
        let [from, to] = [a, b].map(|v| self.pattern.coordinates[v as usize]);
        let x = (to - from).normalize_or(DVec3::X);
        let y = self.normal(face).cross(x);
        let origin = placed[a as usize].unwrap_or_default();
        let along =
            placed[b as usize].map_or(DVec2::X, |end| (end - origin).normalize_or(DVec2::X));
        let turn = DMat2::from_cols(along, along.perp());
        for &v in corners {
            let local = self.pattern.coordinates[v as usize] - from;
            let point = origin + turn * DVec2::new(local.dot(x), local.dot(y));
            let before = *placed[v as usize].get_or_insert(point);
            let gap = before.distance(point);
            if gap > limit {
                return Err(ImportError::NotDevelopable {
                    frame: FrameNumber(self.pattern.frame),
                    vertex: v as usize,
                    gap,
                    limit,
                });
            }
        }
        Ok(())
    }

    /// The angle between the faces at an edge, radians, positive where their fronts face each other; `None` without
    /// two faces.
    fn angle(&self, [a, b]: [u32; 2]) -> Option<f64> {
        let &[f, g] = self.sides.get(&[a.min(b), a.max(b)])?.as_slice() else {
            return None;
        };
        let [left, right] =
            if around(&self.faces[f as usize]).contains(&[a, b]) { [f, g] } else { [g, f] };
        let [left, right] = [left, right].map(|face| self.normal(face as usize));
        let [from, to] = [a, b].map(|v| self.pattern.coordinates[v as usize]);
        let along = (to - from).normalize_or(DVec3::X);
        Some((-left.cross(right).dot(along)).atan2(left.dot(right)))
    }

    /// The meanings of the edges where those without a fold angle of their own take the angle between their faces.
    pub(super) fn meanings(&self) -> Vec<EdgeMeaning> {
        let edges = self.pattern.edges.iter().zip(&self.pattern.meanings);
        let measured = |(&ends, meaning): (&[u32; 2], &EdgeMeaning)| {
            let is_hinge = matches!(meaning.role, Role::Mountain | Role::Valley | Role::Free);
            match self.angle(ends) {
                Some(angle) if is_hinge && !meaning.has_angle => with_angle(meaning, angle),
                _ => *meaning,
            }
        };
        edges.map(measured).collect()
    }
}

fn with_angle(meaning: &EdgeMeaning, angle: f64) -> EdgeMeaning {
    let is_unsigned = angle.abs() < UNSIGNED || angle.abs() > std::f64::consts::PI - UNSIGNED;
    let role = match meaning.role {
        Role::Free if angle.abs() < UNSIGNED => return *meaning,
        drawn if is_unsigned && drawn != Role::Free => drawn,
        _ if angle < 0.0 => Role::Mountain,
        _ => Role::Valley,
    };
    let target = if role == Role::Mountain { -angle.abs() } else { angle.abs() };
    EdgeMeaning { role, target, warning: None, has_angle: true }
}
