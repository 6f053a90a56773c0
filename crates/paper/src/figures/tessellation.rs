//! Figure 1: the waterbomb tessellation, its units and its vertices.

use std::f64::consts::TAU;

use foldmotion_pattern::{Case, Unit, UnitSheet, VertexType};
use foldmotion_record::{Anchor, Drawing};
use glam::DVec2;

use super::pattern::{PatternPlacement, SMALL, caption, draw, draw_unit};
use super::{Composed, page};
use crate::PaperError;

/// Figure 1: the tessellation.
pub(super) fn figure1() -> Result<Composed, PaperError> {
    let mut drawing = page(900.0, 600.0)?;
    let failed = |e| PaperError::pattern("figure 1", e);
    let unit = Unit::new(Case::E, 1.0, 1.0, None, None).map_err(failed)?;
    let units = UnitSheet::new(unit, 3, 5).map_err(failed)?;
    let placement = PatternPlacement::new(DVec2::new(30.0, 30.0), 90.0, 5.0);
    draw(&mut drawing, &units.sheet, &placement, 1.4, |_| true);
    caption(&mut drawing, DVec2::new(255.0, 325.0), "(a) N_r × N_c = 3 × 5 units");
    for (row, x, words) in [(0, 560.0, "(b) unit U^O"), (1, 740.0, "(c) unit U^E")] {
        draw_unit(&mut drawing, &unit, row, DVec2::new(x, 60.0), 120.0)?;
        caption(&mut drawing, DVec2::new(x + 60.0, 250.0), words);
    }
    let stars = [
        (VertexType::I, 160.0, "vertex I, centre of U^O"),
        (VertexType::J, 450.0, "(d) vertex J"),
        (VertexType::K, 740.0, "(e) vertex K"),
    ];
    for (kind, x, words) in stars {
        star(&mut drawing, &units, kind, DVec2::new(x, 455.0));
        caption(&mut drawing, DVec2::new(x, 572.0), words);
        let sums = "angles: 360° in all, alternate ones 180°";
        drawing.words(DVec2::new(x, 588.0), sums, SMALL, Anchor::Middle);
    }
    Ok((
        drawing,
        "Figure 1. The waterbomb tessellation (case E), mountains red, valleys blue; its units for odd rows (U^O) and even \
         rows (U^E); the three types of interior vertex with their sector angles.",
    ))
}

/// The facets around the first interior vertex of a kind, with its sector angles.
fn star(drawing: &mut Drawing, units: &UnitSheet, kind: VertexType, centre: DVec2) {
    let sheet = &units.sheet;
    let is_inner = |v: u32| {
        let y = sheet.vertices[v as usize].y;
        y > 0.9 && y < 4.1
    };
    let checks = units.check().vertices;
    let Some(check) = checks.iter().find(|c| c.kind == kind && is_inner(c.vertex)) else {
        return;
    };
    let (scale, position) = (95.0, sheet.vertices[check.vertex as usize]);
    let mut placement = PatternPlacement::new(DVec2::ZERO, scale, 5.0);
    placement.at = centre - placement.of(position);
    let touches = |f: u32| sheet.facets[f as usize].polygon.contains(&check.vertex);
    draw(drawing, sheet, &placement, 1.6, touches);
    let creases = sheet.edges.iter().filter(|edge| edge.is_crease());
    let mut headings: Vec<f64> = creases
        .filter(|edge| edge.vertices.contains(&check.vertex))
        .map(|edge| {
            let [a, b] = edge.vertices.map(|v| placement.of(sheet.vertices[v as usize]));
            let other = if edge.vertices[0] == check.vertex { b } else { a };
            (other - centre).to_angle()
        })
        .collect();
    headings.sort_by(f64::total_cmp);
    for (k, &heading) in headings.iter().enumerate() {
        let next = headings[(k + 1) % headings.len()];
        let sector = (next - heading).rem_euclid(TAU);
        let reach = if sector > 1.2 { 25.0 } else { 36.0 };
        let at = centre + reach * DVec2::from_angle(heading + 0.5 * sector);
        let words = format!("{:.0}°", sector.to_degrees());
        drawing.words(at + DVec2::new(0.0, 4.0), words, SMALL, Anchor::Middle);
    }
    drawing.dot(centre, 3.0, [38, 38, 42]);
}
