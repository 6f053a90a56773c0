//! Facets cut into triangles.

use glam::DVec2;

use super::ImportError;
use super::plan::Plan;
use super::predicate::{from_segment, side};
use super::rulings;
use crate::delaunay::delaunay;
use crate::facet_model::split;

/// A quadrilateral has a corner worth the name where its corners lie farther from the chords beside them than this, in
/// parts of the chord.
const FLAT_CORNER: f64 = 1e-3;

/// Triangles and the facet each belongs to.
#[derive(Debug, Default)]
pub(super) struct Triangles {
    pub(super) corners: Vec<[u32; 3]>,
    pub(super) facets: Vec<u32>,
}

/// The triangles of every facet, counter-clockwise, without new vertices.
///
/// Convex quadrilaterals are cut along the shorter diagonal (ties by the lowest vertex); facets with more corners, with
/// holes or with lines inside by the constrained Delaunay triangulation (Chew 1989), whose diagonals are exchanged for
/// rulings beside curved creases.
///
/// # Errors
/// [`ImportError::Facet`] for a facet whose loops cross or have no area.
pub(super) fn triangles(plan: &Plan) -> Result<Triangles, ImportError> {
    let mut triangles = Triangles::default();
    let lines = rulings::by_ends(&plan.lines);
    for (index, loops) in plan.facets.iter().enumerate() {
        let cut = match loops.as_slice() {
            [one] => simple(one, &plan.points),
            _ => None,
        };
        let mut cut = cut
            .or_else(|| delaunay(loops, &plan.points))
            .ok_or_else(|| facet_error(plan, index))?;
        if plan.has_rulings {
            let tangents = rulings::tangents(loops, &plan.points, &lines);
            if !tangents.is_empty() && cut.len() > 2 {
                rulings::align(&mut cut, &plan.points, &tangents, |key| lines.contains_key(&key));
            }
        }
        triangles.facets.extend(cut.iter().map(|_| index as u32));
        triangles.corners.extend(cut);
    }
    Ok(triangles)
}

fn facet_error(plan: &Plan, facet: usize) -> ImportError {
    let outline = plan.facets[facet].first();
    let corners: Vec<u32> = outline.into_iter().flatten().copied().collect();
    let is_side = |line: &&super::drawing::Line| line.ends.iter().all(|v| corners.contains(v));
    ImportError::Facet {
        facet,
        corners: corners.len(),
        sources: plan
            .lines
            .iter()
            .filter(is_side)
            .map(|line| plan.sources[line.source as usize].clone())
            .collect(),
    }
}

/// The triangles of a triangle or of a convex quadrilateral.
pub(super) fn simple(corners: &[u32], points: &[DVec2]) -> Option<Vec<[u32; 3]>> {
    let at = |i: usize| points[corners[i % corners.len()] as usize];
    let turns = |i: usize| side(at(i), at(i + 1), at(i + 2)) > 0.0;
    match corners.len() {
        3 => turns(0).then(|| split(points, corners)),
        4 => {
            let is_corner = |i: usize| {
                let chord = [at(i), at(i + 2)];
                let (off, _) = from_segment(chord, at(i + 1));
                turns(i) && off > FLAT_CORNER * chord[0].distance(chord[1])
            };
            (0..4).all(is_corner).then(|| split(points, corners))
        }
        _ => None,
    }
}
