//! FOLD 1.0 to 1.2 as a crease pattern.
//!
//! Source: Demaine, Ku, Lang, "A New File Standard to Represent Folded Structures" (FOLD specification 1.2).

mod edges;
mod faces;
mod flat;
mod frames;
mod sides;
mod stages;
mod unfold;

use glam::{DVec2, DVec3};
use serde_json::{Map, Value};

use super::assemble::Assembled;
use super::drawing::{Drawing, Role};
use super::pieces::chosen;
use super::plan::Plan;
use super::warning::{WarningKind, Warnings};
use super::{
    ImportError, ImportOptions, ImportedPattern, LengthUnit, MOST_PIECES, MOST_VERTICES,
    MergeTolerance, Source, check_extent, check_size, near_origin, plan_of,
};
use crate::fold::check_vertices;
use frames::Frames;

/// Reads a crease pattern from FOLD.
///
/// The pattern is the first frame of the class `creasePattern`, otherwise the key frame (`file_frames[0]` where that
/// has no coordinates). Assignments and angles:
///
/// - B border; C cut, opened; F and J inside a facet; U a free hinge.
/// - M and V fold by their `edges_foldAngle`, which counts also where its sign is the other one; by −180° and 180° where
///   that list is missing; a null angle is a free hinge.
/// - An angle makes a crease of U, F, J and of edges without assignment; without either an edge is a free hinge.
/// - Every frame of `file_frames` with angles of its own is a stage, but for crease patterns, models of a `multiModel` file
///   and the frames of a recorded motion; a crease that a stage drives is not free.
/// - Small letters count like capitals, and angles up to 1e-6 degrees like 0.
///
/// Faces that are listed are kept, with their vertices, as facets if every edge but facet lines is a side of one and no
/// side is shorter than the merge tolerance; otherwise they are traced as in a drawing. Unused vertices are left out;
/// edges that only faces name are facet lines, or free hinges where the file lists no edges. A folded shape is laid out
/// flat by its faces, to fold by the angles between them. Keys that are not read are kept in [`ImportedPattern::keys`].
///
/// Not found: listed faces that overlap without sharing an edge.
///
/// # Errors
/// [`ImportError`]; texts name edges, faces and vertices by index.
pub fn import_fold(bytes: &[u8], options: &ImportOptions) -> Result<ImportedPattern, ImportError> {
    check_size(bytes)?;
    let mut frames = Frames::read(bytes)?;
    let mut warnings = Warnings::default();
    let pattern = frames.pattern()?;
    let file = FoldPattern::new(&frames, pattern)?;
    if file.is_unfolded {
        let frame = (pattern as u32).checked_sub(1);
        warnings.add(WarningKind::Unfolded, &frame.map_or(Source::KeyFrame, Source::FoldFrame));
    }
    let plan = file.plan(options, &mut warnings)?;
    let assembled = chosen(&plan, &options.pieces, &[], &mut warnings)?;
    let mut imported = file.imported(assembled, plan, &frames)?;
    imported.stages = stages::stages(&frames, &file, &imported, &mut warnings)?;
    imported.warnings = warnings.finish();
    imported.title = frames.take_title();
    Ok(imported)
}

/// The lists of the frame that is the pattern.
struct FoldPattern<'a> {
    frame: usize,
    coordinates: &'a [DVec3],
    edges: &'a [[u32; 2]],
    /// The meaning of each edge.
    meanings: Vec<edges::EdgeMeaning>,
    faces: &'a [Vec<u32>],
    /// The vertices in the plane.
    flat: Vec<DVec2>,
    /// Whether the frame is a folded shape, laid out flat.
    is_unfolded: bool,
}

impl<'a> FoldPattern<'a> {
    fn new(frames: &'a Frames, frame: usize) -> Result<Self, ImportError> {
        let coordinates = frames.coordinates(frame).unwrap_or(&[]);
        let edges = frames.edges(frame).unwrap_or(&[]);
        let faces = frames.faces(frame).unwrap_or(&[]);
        let corners = faces.iter().map(Vec::len).sum();
        for (what, found, limit) in [
            ("vertices", coordinates.len(), MOST_VERTICES),
            ("edges", edges.len(), MOST_PIECES),
            ("corners of faces", corners, 4 * MOST_VERTICES),
        ] {
            if found > limit {
                return Err(ImportError::TooMany { what, found, limit });
            }
        }
        for (element, ends) in edges.iter().enumerate() {
            check_vertices("edges_vertices", element, ends, coordinates.len())?;
        }
        for (element, corners) in faces.iter().enumerate() {
            check_vertices("faces_vertices", element, corners, coordinates.len())?;
        }
        let mut pattern = Self {
            frame,
            coordinates,
            edges,
            meanings: edges::meanings(frames, frame, edges.len())?,
            faces,
            flat: Vec::new(),
            is_unfolded: false,
        };
        pattern.lay_flat(frames.is_folded(frame))?;
        Ok(pattern)
    }

    /// Finds the vertices in the plane; `is_folded`: whether the file says that the frame is a folded shape.
    fn lay_flat(&mut self, is_folded: bool) -> Result<(), ImportError> {
        let in_plane = flat::in_plane(self);
        let is_in_space = matches!(in_plane, Err(ImportError::NotFlat { .. }));
        if self.faces.is_empty() || !(is_folded || is_in_space) {
            self.flat = in_plane?;
            let bounds = self.flat_bounds()?;
            check_extent(bounds[0], bounds[1])?;
            near_origin(&mut self.flat, bounds);
            return Ok(());
        }
        let unfolding = unfold::unfold(self, flat::size(self)?)?;
        let (points, meanings) = (unfolding.points.clone(), unfolding.meanings());
        (self.flat, self.meanings, self.is_unfolded) = (points, meanings, true);
        Ok(())
    }

    fn plan(&self, options: &ImportOptions, warnings: &mut Warnings) -> Result<Plan, ImportError> {
        let flat = self.flat.clone();
        let mut is_used = vec![false; flat.len()];
        for v in self.edges.iter().flatten().chain(self.faces.iter().flatten()) {
            is_used[*v as usize] = true;
        }
        for (vertex, _) in (0..).zip(&is_used).filter(|(_, used)| !**used) {
            warnings.add(WarningKind::UnusedVertex, &Source::FoldVertex(vertex));
        }
        let merge = options.merge.unwrap_or(MergeTolerance::LISTED);
        if self.is_unfolded || self.has_usable_faces(merge, warnings)? {
            return faces::plan(self, flat, warnings);
        }
        let drawing = Drawing {
            points: flat,
            lines: edges::lines(self, &sides::Sides::new(), warnings),
            sources: (0..self.edges.len() as u32).map(Source::FoldEdge).collect(),
        };
        plan_of(drawing, merge, 1.0, false, warnings)
    }

    /// The bounds of the vertices of faces and edges in the plane.
    fn flat_bounds(&self) -> Result<[DVec2; 2], ImportError> {
        let used: Vec<DVec2> = flat::used(self).map(|&v| self.flat[v as usize]).collect();
        super::drawing::bounds(&used).ok_or(ImportError::Empty)
    }

    /// Whether the listed faces have every edge as a side, and no side is so short that its ends are one vertex.
    fn has_usable_faces(
        &self,
        merge: MergeTolerance,
        warnings: &mut Warnings,
    ) -> Result<bool, ImportError> {
        if self.faces.is_empty() {
            return Ok(false);
        }
        if self.edges.is_empty() {
            return Ok(true);
        }
        let sides = sides::sides(self.faces);
        let edges = self.edges.iter().zip(&self.meanings).zip(0..);
        let is_beside = |((ends, meaning), _): &((&[u32; 2], &edges::EdgeMeaning), u32)| {
            let [a, b] = **ends;
            meaning.role != Role::Facet && !sides.contains_key(&[a.min(b), a.max(b)])
        };
        let beside: Vec<u32> = edges.filter(is_beside).map(|(_, edge)| edge).collect();
        for &edge in &beside {
            warnings.add(WarningKind::StaleFaces, &Source::FoldEdge(edge));
        }
        let [low, high] = self.flat_bounds()?;
        let tolerance = merge.length(low.distance(high), 1.0)?;
        let length = |[a, b]: &[u32; 2]| self.flat[*a as usize].distance(self.flat[*b as usize]);
        Ok(beside.is_empty() && sides.keys().all(|ends| length(ends) > tolerance))
    }

    fn imported(
        &self,
        assembled: Assembled,
        plan: Plan,
        frames: &Frames,
    ) -> Result<ImportedPattern, ImportError> {
        let Assembled { mut sheet, targets, edge_lines, vertex_points } = assembled;
        match frames.unit_length() {
            Some(length) if length > 0.0 => sheet.unit_length = length,
            Some(value) => return Err(crate::FoldError::UnitLength { value }.into()),
            None => {}
        }
        let unit = match frames.unit(self.frame) {
            None => LengthUnit::Unit,
            Some(name) => LengthUnit::named(name)
                .ok_or_else(|| ImportError::Unit { found: name.chars().take(40).collect() })?,
        };
        let lines = edge_lines.into_iter();
        let edge_sources = lines.map(|l| Some(plan.lines[l? as usize].source)).collect();
        let vertex_sources: Vec<Option<u32>> =
            vertex_points.iter().map(|&p| plan.origins[p as usize]).collect();
        let position = |v: &Option<u32>| v.map(|v| self.coordinates[v as usize]);
        let shape: Option<Vec<DVec3>> = vertex_sources.iter().map(position).collect();
        let shape = shape.filter(|shape| *shape != sheet.planar());
        let mut keys = frames.keys().clone();
        let are_listed = plan.are_listed && sheet.facets.len() == self.faces.len();
        if !self.faces.is_empty() && !are_listed {
            // Pieces or stale faces were left out: lists for each face no longer fit.
            keys.retain(|key, _| !key.contains("faces_"));
        }
        let fixed_facets = fixed_facets(&keys, &sheet, &vertex_sources, self.faces.len());
        Ok(ImportedPattern {
            title: None,
            sheet,
            unit,
            targets,
            stages: Vec::new(),
            fixed_facets,
            names: Vec::new(),
            sources: plan.sources,
            mending: plan.mending,
            edge_sources,
            vertex_sources,
            shape,
            warnings: Vec::new(),
            keys,
            face_orders: if are_listed { self.face_orders(frames) } else { Vec::new() },
            listed: [self.coordinates.len(), self.edges.len(), self.faces.len()],
        })
    }
}

impl FoldPattern<'_> {
    /// The orders of facets that are the listed faces.
    fn face_orders(&self, frames: &Frames) -> Vec<(u32, u32, i8)> {
        let faces = self.faces.len();
        let orders = frames.face_orders(self.frame).iter().copied();
        let is_order = |&(f, g, sign): &(u32, u32, i8)| {
            let is_listed = (f as usize) < faces && (g as usize) < faces;
            is_listed && f != g && sign.abs() == 1
        };
        orders.filter(is_order).collect()
    }
}

/// The facets that a key fixes; `faces`: how many the file lists.
fn fixed_facets(
    keys: &Map<String, Value>,
    sheet: &crate::Sheet,
    vertex_sources: &[Option<u32>],
    faces: usize,
) -> Vec<u32> {
    let is_set = |list: &[Value], index: usize| {
        let value = list.get(index);
        value.is_some_and(|v| v.as_bool() == Some(true) || v.as_f64().is_some_and(|n| n != 0.0))
    };
    let list = |key: &str| keys.get(key).and_then(Value::as_array);
    let by_face = list("faces_foldmotion:fixed").filter(|list| list.len() == faces);
    let by_vertex = list("rtori:os:vertices_fixed");
    let is_fixed = |facet: usize| {
        let by_face = by_face.is_some_and(|list| is_set(list, facet));
        let corner = |v: &u32| vertex_sources[*v as usize];
        let mut corners = sheet.facets[facet].polygon.iter().map(corner);
        by_face
            || by_vertex
                .is_some_and(|list| corners.all(|v| v.is_some_and(|v| is_set(list, v as usize))))
    };
    (0..sheet.facets.len()).filter(|&facet| is_fixed(facet)).map(|facet| facet as u32).collect()
}
