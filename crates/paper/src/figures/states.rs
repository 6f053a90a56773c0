//! Figure 2: target surface, tiling, flat-folded state.

use foldmotion_pattern::{Assignment, Case, CreaseKind, Edge, Facet, FacetKind, LayerOrder, Sheet};
use foldmotion_record::{Stroke, View};
use glam::{DVec2, DVec3};

use super::panel::{Cell, SheetState, common_scale};
use super::pattern::caption;
use super::{Composed, page};
use crate::PaperError;
use crate::targets::sheet;
use foldmotion_study::UnitStudy;

/// The number of strips that approximate the smooth surface.
const STRIPS: u32 = 240;

/// Figure 2: a target surface, its tiling and the folded sheet.
pub(super) fn figure2() -> Result<Composed, PaperError> {
    let study = sheet("shelter", Case::E)?;
    let (smooth, positions) = swept_surface(&study);
    let surface = SheetState { sheet: &smooth, positions, order: LayerOrder::default() };
    let cell = DVec2::new(300.0, 300.0);
    let states = [surface, SheetState::deployed(&study)];
    let scale = common_scale(&states, View::Iso, cell);
    let mut drawing = page(960.0, 350.0)?;
    let words = ["(a) target surface Φ^T: Γ swept by W", "(b) tiled with 7 × 5 units"];
    for (k, (state, words)) in states.iter().zip(words).enumerate() {
        let x = 10.0 + 310.0 * k as f64;
        let cell = Cell::new(x, 10.0, cell.x, cell.y);
        state.show(&mut drawing, View::Iso, cell, scale)?;
        caption(&mut drawing, DVec2::new(x + 150.0, 335.0), words);
    }
    let cell = Cell::new(630.0, 100.0, 320.0, 110.0);
    SheetState::compact(&study).show(&mut drawing, View::Front, cell, scale)?;
    let ink = Stroke::new([110, 110, 115], 1.0);
    let half = 0.5 * scale * study.closed_form.map_or(0.0, |form| form.extents[0]);
    let (left, right) = (DVec2::new(790.0 - half, 230.0), DVec2::new(790.0 + half, 230.0));
    drawing.line([left, right], ink);
    for dy in [-5.0, 5.0] {
        drawing.line([left, left + DVec2::new(9.0, dy)], ink);
    }
    caption(&mut drawing, DVec2::new(790.0, 248.0), "growing line G_r");
    caption(&mut drawing, DVec2::new(790.0, 335.0), "(c) folded flat, seen along the width");
    Ok((
        drawing,
        "Figure 2. A target surface approximated with square units (case E) and folded flat, all at one scale; the box is \
         4 h × h/2, its area equation 3.",
    ))
}

/// Γ swept along the width as a sheet of narrow strips without creases, and its positions.
fn swept_surface(study: &UnitStudy) -> (Sheet, Vec<DVec3>) {
    let width = study.units.unit.width * study.units.columns as f64;
    let corner = |k: u32| {
        let [column, step] = [k % 2, k / 2];
        let point = study.profile.position(f64::from(step) / f64::from(STRIPS));
        DVec3::new(point.x, width * f64::from(1 - column), point.y)
    };
    let positions: Vec<DVec3> = (0..2 * (STRIPS + 1)).map(corner).collect();
    let flat = |k: u32| DVec2::new(-f64::from(k / 2), f64::from(k % 2));
    let strip = |k: u32| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]];
    let edge = |vertices: [u32; 2], faces: [Option<u32>; 2]| {
        let is_border = faces.contains(&None);
        Edge {
            vertices,
            assignment: if is_border { Assignment::Border } else { Assignment::Facet },
            kind: if is_border { CreaseKind::Border } else { CreaseKind::Facet },
            row: 0,
            column: 0,
            faces,
        }
    };
    let mut edges = Vec::new();
    for k in 0..STRIPS {
        let (v, f) = (2 * k, 2 * k);
        edges.push(edge([v, v + 2], [Some(f), None]));
        edges.push(edge([v + 1, v + 3], [Some(f + 1), None]));
        edges.push(edge([v, v + 3], [Some(f), Some(f + 1)]));
        edges.push(edge([v, v + 1], [Some(f + 1), k.checked_sub(1).map(|_| f - 2)]));
    }
    edges.push(edge([2 * STRIPS, 2 * STRIPS + 1], [Some(2 * STRIPS - 2), None]));
    let facet = Facet {
        polygon: vec![0, 2 * STRIPS, 2 * STRIPS + 1, 1],
        row: 0,
        column: 0,
        kind: FacetKind::Plain,
    };
    let smooth = Sheet {
        vertices: (0..2 * (STRIPS + 1)).map(flat).collect(),
        edges,
        faces: (0..STRIPS).flat_map(strip).collect(),
        face_facets: vec![0; 2 * STRIPS as usize],
        facets: vec![facet],
        unit_length: study.units.unit.height,
    };
    (smooth, positions)
}
