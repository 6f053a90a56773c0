//! From facets to a sheet.

use std::collections::BTreeMap;

use glam::DVec2;

use super::drawing::{Line, Role};
use super::open_cuts::{Sides, end_of, open_cuts, sides};
use super::plan::Plan;
use super::triangles::{Triangles, simple, triangles};
use super::warning::{WarningKind, Warnings};
use super::{ImportError, Source};
use crate::{Assignment, CreaseKind, Edge, Facet, FacetKind, Sheet};

/// A sheet and where its parts come from.
#[derive(Debug)]
pub(super) struct Assembled {
    pub(super) sheet: Sheet,
    /// The fold angle every edge is to take, radians; 0 if it is not a crease.
    pub(super) targets: Vec<f64>,
    /// The line of the plan each edge comes from; `None` for those that cut facets into triangles.
    pub(super) edge_lines: Vec<Option<u32>>,
    /// The point of the plan each vertex comes from.
    pub(super) vertex_points: Vec<u32>,
}

/// Cuts the facets into triangles, opens the cuts, and leaves out points of no facet.
///
/// # Errors
/// [`ImportError::Facet`], [`ImportError::NonManifold`], [`ImportError::Overlap`].
pub(super) fn assemble(plan: &Plan, warnings: &mut Warnings) -> Result<Assembled, ImportError> {
    let lines: BTreeMap<[u32; 2], u32> =
        (0..).zip(&plan.lines).map(|(i, l)| (l.key(), i)).collect();
    let Triangles { mut corners, facets: face_facets } = triangles(plan)?;
    check_manifold(plan, &lines, &corners, &face_facets)?;
    note_inner_borders(plan, &lines, &corners, warnings);
    let role =
        |key: [u32; 2]| lines.get(&key).map_or(Role::Facet, |&i| plan.lines[i as usize].role);
    let origins = open_cuts(&mut corners, plan.points.len(), role);
    let vertex_points = without_unused(&mut corners, &origins);
    let vertices: Vec<_> = vertex_points.iter().map(|&p| plan.points[p as usize]).collect();
    split_again(&mut corners, &face_facets, &vertices);
    let assembly = Assembly { plan, lines, vertex_points: &vertex_points };
    let (edges, edge_lines) = assembly.edges(&corners, warnings);
    let drawn = edges.iter().zip(&edge_lines).filter(|(_, line)| line.is_some());
    let lengths = drawn.map(|(edge, _)| {
        let [a, b] = edge.vertices.map(|v| vertices[v as usize]);
        a.distance(b)
    });
    let unit_length = lengths.clone().sum::<f64>() / lengths.count() as f64;
    let target = |line: &Option<u32>| line.map_or(0.0, |l| plan.lines[l as usize].target);
    let targets = edge_lines
        .iter()
        .zip(&edges)
        .map(|(line, edge)| if edge.is_crease() { target(line) } else { 0.0 });
    let targets = targets.collect();
    let facets = facets(plan.facets.len(), &corners, &face_facets);
    let sheet = Sheet { vertices, edges, faces: corners, face_facets, facets, unit_length };
    Ok(Assembled { sheet, targets, edge_lines, vertex_points })
}

fn sources_of(plan: &Plan, lines: &BTreeMap<[u32; 2], u32>, key: [u32; 2]) -> Vec<Source> {
    let line = lines.get(&key).map(|&i| plan.lines[i as usize]);
    line.iter().map(|l| plan.sources[l.source as usize].clone()).collect()
}

/// Refuses more than two triangles at a side, and two on the same side of it.
fn check_manifold(
    plan: &Plan,
    lines: &BTreeMap<[u32; 2], u32>,
    corners: &[[u32; 3]],
    face_facets: &[u32],
) -> Result<(), ImportError> {
    for (ends, starts) in sides(corners) {
        let facets = || starts.iter().map(|&s| face_facets[s as usize / 3]).collect();
        let at = |start: u32| corners[start as usize / 3][start as usize % 3];
        let sources = || sources_of(plan, lines, ends);
        match *starts.as_slice() {
            [_] => {}
            [s, t] if at(s) != at(t) => {}
            [_, _] => {
                return Err(ImportError::Overlap {
                    vertices: ends,
                    facets: facets(),
                    sources: sources(),
                });
            }
            _ => {
                return Err(ImportError::NonManifold {
                    vertices: ends,
                    facets: facets(),
                    sources: sources(),
                });
            }
        }
    }
    Ok(())
}

/// Warns of border lines with triangles on both sides, which are cuts.
fn note_inner_borders(
    plan: &Plan,
    lines: &BTreeMap<[u32; 2], u32>,
    corners: &[[u32; 3]],
    warnings: &mut Warnings,
) {
    for (ends, starts) in sides(corners) {
        let line = lines.get(&ends).map(|&index| plan.lines[index as usize]);
        if let Some(line) = line.filter(|line| line.role == Role::Border && starts.len() == 2) {
            warnings.add(WarningKind::InnerBorder, &plan.sources[line.source as usize]);
        }
    }
}

/// Numbers the vertices of triangles without gaps, in order; returns the point each comes from.
fn without_unused(corners: &mut [[u32; 3]], origins: &[u32]) -> Vec<u32> {
    let mut number = vec![None; origins.len()];
    for &v in corners.iter().flatten() {
        number[v as usize] = Some(0);
    }
    let mut vertex_points = Vec::new();
    for (vertex, number) in number.iter_mut().enumerate().filter(|(_, n)| n.is_some()) {
        *number = Some(vertex_points.len() as u32);
        vertex_points.push(origins[vertex]);
    }
    for corner in corners.iter_mut().flatten() {
        *corner = number[*corner as usize].unwrap_or(*corner);
    }
    vertex_points
}

/// Cuts quadrilaterals again, now that opened cuts have numbered their corners anew: ties go by the lowest.
fn split_again(corners: &mut [[u32; 3]], face_facets: &[u32], vertices: &[DVec2]) {
    let mut first = 0;
    for pair in face_facets.chunk_by(|a, b| a == b) {
        if let [s, t] = &mut corners[first..first + pair.len()] {
            let cut = simple(&outline(&[*s, *t]), vertices);
            if let Some([a, b]) = cut.as_deref() {
                (*s, *t) = (*a, *b);
            }
        }
        first += pair.len();
    }
}

struct Assembly<'a> {
    plan: &'a Plan,
    lines: BTreeMap<[u32; 2], u32>,
    vertex_points: &'a [u32],
}

impl Assembly<'_> {
    /// Every side of the triangles once, those of lines in the order of the lines first; and the lines.
    fn edges(
        &self,
        corners: &[[u32; 3]],
        warnings: &mut Warnings,
    ) -> (Vec<Edge>, Vec<Option<u32>>) {
        let sides: Sides = sides(corners);
        let point = |v: u32| self.vertex_points[v as usize];
        let line = |ends: [u32; 2]| {
            let [a, b] = ends.map(point);
            self.lines.get(&[a.min(b), a.max(b)]).copied()
        };
        let mut order: Vec<_> = sides.iter().map(|(ends, at)| (line(*ends), *ends, at)).collect();
        order.sort_by_key(|(line, ends, _)| (line.unwrap_or(u32::MAX), *ends));
        let mut edges = Vec::with_capacity(order.len());
        for (line, ends, starts) in &order {
            let drawn = line.map(|l| self.plan.lines[l as usize]);
            let vertex = |start: u32| corners[start as usize / 3][start as usize % 3];
            // Along the line as it was drawn.
            let from = match drawn {
                Some(drawn) if point(ends[0]) != drawn.ends[0] => ends[1],
                _ => ends[0],
            };
            let to = if from == ends[0] { ends[1] } else { ends[0] };
            let on = |is_left: bool| {
                let start = starts.iter().find(|&&s| (vertex(s) == from) == is_left);
                start.map(|s| s / 3)
            };
            let faces = [on(true), on(false)];
            let assignment = self.assignment(drawn, starts.len() == 2, warnings);
            edges.push(Edge {
                vertices: [from, to],
                assignment,
                kind: match assignment {
                    Assignment::Border => CreaseKind::Border,
                    Assignment::Facet => CreaseKind::Facet,
                    _ => CreaseKind::Imported,
                },
                row: 0,
                column: 0,
                faces,
            });
        }
        (edges, order.into_iter().map(|(line, ..)| line).collect())
    }

    fn assignment(
        &self,
        line: Option<Line>,
        is_joined: bool,
        warnings: &mut Warnings,
    ) -> Assignment {
        let Some(line) = line else {
            // A side without a line at the edge: of a face in a file that lists no such edge.
            return if is_joined { Assignment::Facet } else { Assignment::Border };
        };
        let source = &self.plan.sources[line.source as usize];
        match (line.role, is_joined) {
            (Role::Border | Role::Cut, true) => {
                warnings.add(WarningKind::ClosedCut, source);
                Assignment::Free
            }
            (role, true) => role.assignment(),
            (Role::Border | Role::Cut, false) => Assignment::Border,
            (_, false) => {
                warnings.add(WarningKind::MadeBorder, source);
                Assignment::Border
            }
        }
    }
}

/// The facets, with their outer borders as corners.
fn facets(count: usize, corners: &[[u32; 3]], face_facets: &[u32]) -> Vec<Facet> {
    let mut of_facet = vec![Vec::new(); count];
    for (triangle, &facet) in corners.iter().zip(face_facets) {
        of_facet[facet as usize].push(*triangle);
    }
    let facet = |triangles: &Vec<[u32; 3]>| Facet {
        polygon: outline(triangles),
        row: 0,
        column: 0,
        kind: FacetKind::Plain,
    };
    of_facet.iter().map(facet).collect()
}

/// The longest loop around the union of triangles, from its lowest vertex.
fn outline(triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut starts: Vec<(u32, u32)> = Vec::new();
    for (&[a, b], starts_at) in &sides(triangles) {
        if let &[start] = starts_at.as_slice() {
            let from = triangles[start as usize / 3][start as usize % 3];
            let end = end_of(start);
            let to = triangles[end as usize / 3][end as usize % 3];
            debug_assert_eq!([a, b], [from.min(to), from.max(to)]);
            starts.push((from, to));
        }
    }
    let mut next: BTreeMap<u32, u32> = starts.into_iter().collect();
    let mut longest: Vec<u32> = Vec::new();
    while let Some((start, mut at)) = next.pop_first() {
        let mut found = vec![start];
        while at != start {
            found.push(at);
            let Some(to) = next.remove(&at) else { break };
            at = to;
        }
        if found.len() > longest.len() {
            longest = found;
        }
    }
    longest
}
