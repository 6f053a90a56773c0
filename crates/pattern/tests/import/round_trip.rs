//! What the project writes, read back.

use std::collections::BTreeMap;

use foldmotion_pattern::{
    Case, CutOptions, ImportOptions, ImportedPattern, LengthUnit, Sheet, Unit, UnitSheet,
    crease_pattern_fold, import_fold, import_svg, pattern_svg,
};
use glam::DVec2;

use crate::draw::{bird_base, frame, miura, pop_up, square_twist};
use crate::patterns::check_sheet;

/// Sheets of every case, in metres, drawn at 150 mm a unit.
fn sheets() -> Vec<UnitSheet> {
    let h = 1.0 / 3.0;
    let units = [
        Unit::new(Case::E, h, h, None, None),
        Unit::new(Case::T, 0.7 * h, h, None, None),
        Unit::new(Case::S, 1.6 * h, h, None, None),
        Unit::new(Case::SII, 1.6 * h, h, Some(0.7), None),
        Unit::new(Case::SII, 1.6 * h, h, Some(0.7), Some(0.0)),
        Unit::new(Case::Plain, 2.5 * h, h, None, None),
    ];
    units.map(|unit| UnitSheet::new(unit.unwrap(), 5, 4).unwrap()).to_vec()
}

const SCALE: f64 = 150.0;

/// Edges by their ends (to 1e-6 mm), with letter and target angle (to 1e-6 degrees).
type Edges = BTreeMap<[[i64; 2]; 2], (char, i64)>;

fn edges(
    sheet: &Sheet,
    targets: &[f64],
    is_drawn: impl Fn(usize) -> bool,
    place: impl Fn(DVec2) -> DVec2,
) -> Edges {
    let key =
        |v: u32| place(sheet.vertices[v as usize]).to_array().map(|c| (c * 1e6).round() as i64);
    let drawn = sheet.edges.iter().enumerate().filter(|(index, _)| is_drawn(*index));
    drawn
        .map(|(index, edge)| {
            let mut ends = edge.vertices.map(key);
            ends.sort_unstable();
            let degrees = if edge.is_crease() { targets[index].to_degrees() } else { 0.0 };
            (ends, (edge.assignment.letter(), (degrees * 1e6).round() as i64))
        })
        .collect()
}

fn high(sheet: &Sheet) -> DVec2 {
    sheet.vertices.iter().fold(DVec2::NEG_INFINITY, |m, v| m.max(*v))
}

fn low(sheet: &Sheet) -> DVec2 {
    sheet.vertices.iter().fold(DVec2::INFINITY, |m, v| m.min(*v))
}

#[test]
fn sheets_of_units_written_as_svg_come_back_in_form_and_size() {
    for units in sheets() {
        for draws_facets in [true, false] {
            for keeps_segments in [true, false] {
                let options = CutOptions {
                    draws_facets,
                    keeps_segments,
                    margin: 7.0,
                    ..CutOptions::new(SCALE)
                };
                let text = pattern_svg(&units, &options).unwrap();
                let imported = import_svg(text.as_bytes(), &ImportOptions::default()).unwrap();
                check_sheet(&imported);
                assert_eq!(imported.unit, LengthUnit::Millimetre);
                let sheet = &units.sheet;
                // On paper the sheet is turned by half a turn.
                let (corner, foot) = (high(sheet), low(sheet));
                let on_paper = |v: DVec2| {
                    let turned = DVec2::new(corner.x - v.x, -(v.y - foot.y));
                    turned * SCALE + DVec2::new(7.0, -7.0)
                };
                let is_line = |e: usize| draws_facets || sheet.edges[e].assignment.letter() != 'F';
                let expected = edges(sheet, units.compact_angles(), is_line, on_paper);
                let source = |e: usize| imported.edge_sources[e].is_some();
                let found = edges(&imported.sheet, &imported.targets, source, |v| v);
                assert_eq!(found, expected);
            }
        }
    }
}

#[test]
fn sheets_of_units_written_as_fold_come_back_vertex_by_vertex() {
    for units in sheets() {
        for draws_facets in [true, false] {
            let options = CutOptions { draws_facets, ..CutOptions::new(SCALE) };
            let sheet = &units.sheet;
            let text =
                crease_pattern_fold(sheet, units.compact_angles(), &options, "test").unwrap();
            let imported = import_fold(text.as_bytes(), &ImportOptions::default()).unwrap();
            check_sheet(&imported);
            assert!(imported.warnings.is_empty(), "{:?}", imported.warnings);
            assert_eq!(imported.unit, LengthUnit::Millimetre);
            let scaled: Vec<DVec2> = sheet.vertices.iter().map(|v| *v * SCALE).collect();
            assert_eq!(imported.sheet.vertices, scaled);
            assert_eq!(imported.sheet.unit_length, sheet.unit_length * SCALE);
            let mut faces = [imported.sheet.faces.clone(), sheet.faces.clone()];
            for triangle in faces.iter_mut().flatten() {
                let least = (0..3).min_by_key(|&i| triangle[i]).unwrap();
                triangle.rotate_left(least);
            }
            for list in &mut faces {
                list.sort_unstable();
            }
            assert_eq!(faces[0], faces[1]);
            let all = |_: usize| true;
            let found = edges(&imported.sheet, &imported.targets, all, |v| v);
            assert_eq!(found, edges(sheet, units.compact_angles(), all, |v| v * SCALE));
        }
    }
}

#[test]
fn imported_patterns_written_as_fold_come_back_as_they_are() {
    for pattern in [miura(4, 3), bird_base(), square_twist(), pop_up(), frame()] {
        let options = ImportOptions::default();
        let first = import_svg(pattern.svg().as_bytes(), &options).unwrap();
        let written = first.fold("test");
        let second = import_fold(written.as_bytes(), &options).unwrap();
        check_sheet(&second);
        let all = |_: usize| true;
        let found = |i: &ImportedPattern| edges(&i.sheet, &i.targets, all, |v| v);
        assert_eq!(found(&first), found(&second));
        assert_eq!(first.sheet.vertices, second.sheet.vertices);
        assert_eq!(first.sheet.unit_length, second.sheet.unit_length);
        assert_eq!(second.fold("test"), written);
    }
}
