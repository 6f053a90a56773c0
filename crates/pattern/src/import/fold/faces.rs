//! The facets of a FOLD pattern that lists its faces.

use std::collections::BTreeMap;

use glam::DVec2;

use super::super::drawing::{Line, Role};
use super::super::mending::Mending;
use super::super::plan::Plan;
use super::super::warning::{WarningKind, Warnings};
use super::super::{ImportError, Source};
use super::FoldPattern;
use super::sides::sides;
use crate::FoldError;

/// The listed faces as facets, counter-clockwise; `points`: the vertices in the plane.
pub(super) fn plan(
    pattern: &FoldPattern<'_>,
    points: Vec<DVec2>,
    warnings: &mut Warnings,
) -> Result<Plan, ImportError> {
    let mut facets = Vec::with_capacity(pattern.faces.len());
    for (index, face) in pattern.faces.iter().enumerate() {
        if face.len() < 3 {
            return Err(FoldError::Corners {
                face: index,
                corners: face.len(),
                limit: 4 * super::MOST_VERTICES,
            }
            .into());
        }
        let mut outline = face.clone();
        if twice_area(face, &points) < 0.0 {
            outline.reverse();
            warnings.add(WarningKind::Turned, &Source::FoldFace(index as u32));
        }
        facets.push(vec![outline]);
    }
    let sides = sides(pattern.faces);
    let edges = pattern.edges.len() as u32;
    let mut sources: Vec<Source> = (0..edges).map(Source::FoldEdge).collect();
    let mut lines: Vec<Line> = Vec::with_capacity(sides.len());
    let mut of_ends: BTreeMap<[u32; 2], Line> = BTreeMap::new();
    let mut mending = Mending::default();
    for line in super::edges::lines(pattern, &sides, warnings) {
        mending.draw(&line, &points);
        let source = &sources[line.source as usize];
        if !sides.contains_key(&line.key()) {
            warnings.add(WarningKind::NoFace, source);
            mending.drop(&line, &points, &sources);
            continue;
        }
        match of_ends.get(&line.key()) {
            None => {
                of_ends.insert(line.key(), line);
                lines.push(line);
            }
            Some(first) if first.role == line.role && first.target == line.target => {
                warnings.add(WarningKind::Duplicate, source);
            }
            Some(_) => warnings.add(WarningKind::Conflict, source),
        }
    }
    let unlisted = if pattern.edges.is_empty() { Role::Free } else { Role::Facet };
    for (ends, faces) in sides.into_iter().filter(|(ends, _)| !of_ends.contains_key(ends)) {
        let source = Source::FoldFace(faces[0]);
        if unlisted == Role::Free && faces.len() > 1 {
            warnings.add(WarningKind::Unassigned, &source);
        }
        lines.push(Line {
            ends,
            role: if faces.len() > 1 { unlisted } else { Role::Border },
            target: 0.0,
            source: sources.len() as u32,
            is_curved: false,
        });
        sources.push(source);
    }
    let origins = (0..points.len() as u32).map(Some).collect();
    let (has_rulings, are_listed) = (false, true);
    Ok(Plan { points, origins, lines, facets, sources, mending, has_rulings, are_listed })
}

fn twice_area(face: &[u32], points: &[DVec2]) -> f64 {
    let corner = |v: u32| points[v as usize] - points[face[0] as usize];
    let pairs = face.windows(2);
    pairs.map(|p| corner(p[0]).perp_dot(corner(p[1]))).sum()
}
