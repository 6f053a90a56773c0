//! The notations of SVG.

use std::f64::consts::PI;

use foldmotion_pattern::{
    Assignment, CurvedFacets, ImportError, ImportOptions, ImportedPattern, LengthUnit, Source,
    UnknownElements, WarningKind, import_svg,
};
use glam::DVec2;

use crate::patterns::{check_sheet, counts};

pub(crate) fn document(attributes: &str, body: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" {attributes}>\n{body}\n</svg>")
}

fn import(attributes: &str, body: &str) -> ImportedPattern {
    let imported = import_svg(document(attributes, body).as_bytes(), &ImportOptions::default());
    let imported = imported.unwrap();
    check_sheet(&imported);
    imported
}

/// A square of side 10 with one crease across, drawn by `crease`.
fn square(crease: &str) -> ImportedPattern {
    import("", &format!("<rect width=\"10\" height=\"10\" stroke=\"#000\"/>{crease}"))
}

/// The one crease of a sheet: its assignment and target in degrees.
fn the_crease(imported: &ImportedPattern) -> (Assignment, f64) {
    let edges = imported.sheet.edges.iter().zip(&imported.targets);
    let mut creases = edges
        .zip(&imported.edge_sources)
        .filter(|((edge, _), source)| edge.is_hinge() && source.is_some());
    let ((edge, target), _) = creases.next().unwrap();
    assert!(creases.next().is_none());
    (edge.assignment, target.to_degrees())
}

#[test]
fn every_notation_of_a_colour_means_the_same() {
    use Assignment::{Facet, Free, Mountain, Valley};
    for (colours, assignment, degrees) in [
        (
            &["#f00", "#ff0000", "#F00", "red", "rgb(255,0,0)", "rgb(100%, 0%, 0%)", "Red"][..],
            Mountain,
            -180.0,
        ),
        (&["#00f", "#0000ff", "blue", "rgb(0 0 255)"], Valley, 180.0),
        (&["#ff0", "#FFFF00", "yellow"], Facet, 0.0),
        (&["#f0f", "magenta", "fuchsia", "rgba(255,0,255,1)"], Free, 0.0),
    ] {
        for colour in colours {
            for notation in [
                format!("stroke=\"{colour}\""),
                format!("style=\"stroke-width:2; stroke : {colour} ;fill:none\""),
                format!("stroke=\"#000\" style=\"stroke:{colour}\""),
            ] {
                let imported = square(&format!("<path d=\"M5 0V10\" {notation}/>"));
                assert_eq!(the_crease(&imported), (assignment, degrees), "{notation}");
            }
        }
    }
}

#[test]
fn opacity_is_the_angle_and_may_be_nothing() {
    for (attributes, degrees) in [
        ("stroke=\"#00f\" opacity=\"0.5\"", 90.0),
        ("stroke=\"#00f\" stroke-opacity=\"0.5\" opacity=\"0.5\"", 45.0),
        ("stroke=\"#f00\" style=\"stroke-opacity:25%\"", -45.0),
        ("stroke=\"#f00\" opacity=\"0\"", 0.0),
        ("stroke=\"#00f\" stroke-opacity=\"0\"", 0.0),
        ("stroke=\"rgba(0,0,255,0.2)\"", 36.0),
        ("stroke=\"#00f\" opacity=\"7\"", 180.0),
    ] {
        let imported = square(&format!("<line x1=\"5\" x2=\"5\" y2=\"10\" {attributes}/>"));
        let (_, found) = the_crease(&imported);
        assert!((found - degrees).abs() < 1e-9, "{attributes}: {found}");
    }
    let grouped = square(
        "<g opacity=\"0.5\" stroke=\"#00f\"><g><path d=\"M5 0v10\" opacity=\"0.5\"/></g></g>",
    );
    assert_eq!(the_crease(&grouped), (Assignment::Valley, 45.0));
}

#[test]
fn classes_ids_elements_and_groups_style_their_lines() {
    let style = "<style>/* all */ path{stroke:blue} .m, .x { stroke: #f00; stroke-opacity: .5 } \
                 #one { stroke: #f0f !important }</style>";
    for (crease, expected) in [
        ("<path d=\"M5 0V10\"/>", (Assignment::Valley, 180.0)),
        ("<path class=\"a m\" d=\"M5 0V10\"/>", (Assignment::Mountain, -90.0)),
        ("<path class=\"m\" style=\"stroke:#00f\" d=\"M5 0V10\"/>", (Assignment::Valley, 90.0)),
        ("<path id=\"one\" style=\"stroke:#00f\" d=\"M5 0V10\"/>", (Assignment::Free, 0.0)),
        ("<g stroke=\"blue\"><line x1=\"5\" x2=\"5\" y2=\"10\"/></g>", (Assignment::Valley, 180.0)),
        (
            "<g class=\"m\"><line x1=\"5\" x2=\"5\" y2=\"10\" stroke=\"inherit\"/></g>",
            (Assignment::Mountain, -90.0),
        ),
    ] {
        let imported = square(&format!("{style}{crease}"));
        assert_eq!(the_crease(&imported), expected, "{crease}");
    }
}

#[test]
fn the_closing_segment_of_a_path_folds_as_the_others() {
    let imported = import(
        "",
        "<rect width=\"30\" height=\"30\" stroke=\"black\"/>\
         <path d=\"M10 10h10v10h-10z\" stroke=\"#00f\" opacity=\".5\"/>\
         <path d=\"M0 0L10 10M30 0L20 10M30 30L20 20M0 30L10 20\" stroke=\"red\"/>",
    );
    let valleys: Vec<f64> = imported
        .sheet
        .edges
        .iter()
        .zip(&imported.targets)
        .filter(|(edge, _)| edge.assignment == Assignment::Valley)
        .map(|(_, target)| *target)
        .collect();
    assert_eq!(valleys, [PI / 2.0; 4]);
}

#[test]
fn shapes_and_transforms_place_the_same_sheet() {
    let plain = square("<line x1=\"5\" x2=\"5\" y2=\"10\" stroke=\"red\"/>");
    let crease = "<polyline points=\"5,0 5 10\" stroke=\"red\"/>";
    for border in [
        "<polygon points=\"0,0 10,0 10,10 0,10\" stroke=\"black\"/>",
        "<polyline points=\"0 0 10 0 10 10 0 10 0 0\" stroke=\"black\"/>",
        "<path d=\"m0,0 10,0 l0,10 -10,0z\" stroke=\"black\"/>",
        "<path d=\"M0,0H10V10H0Z\" stroke=\"black\"/>",
        "<g transform=\"translate(-10 20)\"><g transform=\"scale(2) rotate(90)\"><rect x=\"-10\" y=\"-10\" \
         width=\"5\" height=\"5\" stroke=\"black\"/></g></g>",
        "<rect transform=\"matrix(0 1 1 0 0 0)\" width=\"10\" height=\"10\" stroke=\"black\"/>",
        "<svg x=\"0\" y=\"0\" width=\"10\" height=\"20\" viewBox=\"5 5 2 2\"><rect x=\"5\" y=\"4\" width=\"2\" \
         height=\"2\" stroke=\"black\"/></svg>",
        "<a><switch><rect width=\"10\" height=\"10\" stroke=\"black\"/></switch></a>",
    ] {
        let imported = import("", &format!("{border}{crease}"));
        let sorted = |i: &ImportedPattern| {
            let mut points = i.sheet.vertices.clone();
            let key = |p: &DVec2| [p.x, p.y].map(|c| (c * 1e6).round() as i64);
            points.sort_by_key(key);
            points
        };
        let (found, expected) = (sorted(&imported), sorted(&plain));
        assert_eq!(found.len(), expected.len(), "{border}");
        let far = found.iter().zip(&expected).map(|(a, b)| a.distance(*b));
        assert!(far.fold(0.0, f64::max) < 1e-9, "{border}: {found:?}");
        assert_eq!(counts(&imported), counts(&plain));
    }
}

#[test]
fn the_drawing_lies_as_it_is_seen() {
    let imported = square("<path d=\"M0 0L10 5\" stroke=\"red\"/>");
    assert!(imported.sheet.vertices.contains(&DVec2::new(10.0, -5.0)));
}

#[test]
fn physical_sizes_are_kept() {
    let body = "<rect width=\"4\" height=\"2\" stroke=\"black\"/>";
    for (attributes, unit, size) in [
        (
            "width=\"80mm\" height=\"40mm\" viewBox=\"0 0 8 4\"",
            LengthUnit::Millimetre,
            [40.0, 20.0],
        ),
        ("width=\"8cm\" viewBox=\"0 0 8 4\"", LengthUnit::Millimetre, [40.0, 20.0]),
        ("width=\"8in\" height=\"4in\" viewBox=\"0 0 8 4\"", LengthUnit::Millimetre, [101.6, 50.8]),
        ("width=\"72pt\" height=\"6pc\" viewBox=\"0 0 8 8\"", LengthUnit::Millimetre, [12.7, 6.35]),
        (
            "width=\"80mm\" height=\"80mm\"",
            LengthUnit::Millimetre,
            [4.0 * 25.4 / 96.0, 2.0 * 25.4 / 96.0],
        ),
        (
            "width=\"80mm\" height=\"80mm\" viewBox=\"0 0 8 4\" preserveAspectRatio=\"none\"",
            LengthUnit::Millimetre,
            [40.0, 40.0],
        ),
        (
            "width=\"80mm\" height=\"80mm\" viewBox=\"0 0 8 4\"",
            LengthUnit::Millimetre,
            [40.0, 20.0],
        ),
        ("width=\"800\" height=\"400px\" viewBox=\"0 0 8 4\"", LengthUnit::Unit, [4.0, 2.0]),
        ("width=\"100%\" viewBox=\"0 0 8 4\"", LengthUnit::Unit, [4.0, 2.0]),
        ("", LengthUnit::Unit, [4.0, 2.0]),
    ] {
        let imported = import(attributes, body);
        assert_eq!(imported.unit, unit, "{attributes}");
        let far = imported.sheet.vertices.iter().fold(DVec2::ZERO, |m, v| m.max(v.abs()));
        assert!((far - DVec2::from(size)).length() < 1e-9, "{attributes}: {far}");
    }
}

#[test]
fn every_edge_knows_its_element_and_line() {
    let imported = import(
        "",
        "<rect id=\"edge\" width=\"10\" height=\"10\" stroke=\"black\"/>\n\n<path id=\"fold\"\n d=\"M5 0V10\" \
         stroke=\"red\"/>",
    );
    for (index, edge) in imported.sheet.edges.iter().enumerate() {
        let (tag, id, line) = match edge.assignment {
            Assignment::Border => ("rect", "edge", 2),
            Assignment::Mountain => ("path", "fold", 4),
            _ => {
                assert_eq!(imported.edge_source(index as u32), None);
                continue;
            }
        };
        let expected =
            Source::Svg { tag: tag.to_owned(), id: Some(id.to_owned()), line, column: 1 };
        assert_eq!(imported.edge_source(index as u32), Some(&expected));
        assert!(expected.to_string().contains("line "));
    }
}

#[test]
fn unknown_strokes_are_refused_by_element_or_left_out() {
    let body = "<rect width=\"10\" height=\"10\" stroke=\"black\"/>\n<path id=\"p\" d=\"M5 0V10\" stroke=\"#888\"/>\n\
                <path d=\"M1 1L5 5\" stroke=\"#zzz\"/><use href=\"#none\"/>";
    let text = document("", body);
    let mut options = ImportOptions { unknown: UnknownElements::Refuse, ..Default::default() };
    let refused = import_svg(text.as_bytes(), &options).unwrap_err();
    let ImportError::Unknown { elements, reasons } = &refused else { panic!("{refused}") };
    assert_eq!((elements.len(), reasons.len()), (3, 3), "{refused}");
    let message = refused.to_string();
    for part in ["<path id=\"p\"> (line 3)", "#888", "#zzz", "#none", "pattern.unknown"] {
        assert!(message.contains(part), "{message}");
    }
    options.unknown = UnknownElements::Auxiliary;
    let refused = import_svg(text.as_bytes(), &options).unwrap_err();
    assert!(matches!(&refused, ImportError::Unknown { elements, .. } if elements.len() == 2));
    options.unknown = UnknownElements::Ignore;
    let imported = import_svg(text.as_bytes(), &options).unwrap();
    assert_eq!(imported.sheet.facets.len(), 1);
    let ignored = imported.warnings.iter().find(|w| w.kind == WarningKind::Ignored);
    assert_eq!(ignored.unwrap().count, 2);
}

#[test]
fn what_is_not_drawn_is_left_out_with_a_warning() {
    let imported = square(
        "<path d=\"M5 0V10\"/><path d=\"M5 0V10\" stroke=\"none\"/><path d=\"M5 0V10\" stroke=\"red\" \
         display=\"none\"/><g visibility=\"hidden\" stroke=\"red\"><path d=\"M5 0V10\"/></g>\
         <defs><path d=\"M5 0V10\" stroke=\"red\"/></defs><path d=\"\" stroke=\"red\"/>\
         <g style=\"display:none\"><path d=\"M5 0V10\" stroke=\"red\"/></g><text stroke=\"red\">x</text>",
    );
    assert_eq!(imported.sheet.facets.len(), 1);
    let count = |kind| {
        let found = imported.warnings.iter().find(|w| w.kind == kind);
        found.map_or(0, |w| w.count)
    };
    assert_eq!(count(WarningKind::Ignored), 1);
    assert!(count(WarningKind::NotDrawn) >= 2);
}

#[test]
fn flattened_curves_stay_within_their_tolerance_of_the_circle_they_draw() {
    // A quarter of a circle of radius 10 as a cubic strays from it by 0.03 % of the radius.
    let k = 10.0 * 0.552_284_749_8;
    let body = format!(
        "<path d=\"M0 0H10C10 {k} {k} 10 0 10Z\" stroke=\"black\" transform=\"translate(3 4)\"/>"
    );
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let options = ImportOptions {
            curve_tolerance: Some(tolerance),
            curved_facets: CurvedFacets::Delaunay,
            ..ImportOptions::default()
        };
        let imported = import_svg(document("", &body).as_bytes(), &options).unwrap();
        check_sheet(&imported);
        let centre = DVec2::new(3.0, -4.0);
        let allowed = tolerance * 10.0 * 2f64.sqrt() + 0.003;
        let vertices = &imported.sheet.vertices;
        for edge in imported.sheet.edges.iter().filter(|e| !e.is_hinge()) {
            let [a, b] = edge.vertices.map(|v| vertices[v as usize] - centre);
            if a.length() > 9.9 && b.length() > 9.9 {
                assert!((a.midpoint(b).length() - 10.0).abs() <= allowed);
            }
        }
        // A chord that strays by s from a circle of radius r spans 2 √(2 s / r).
        let fewest = PI / 4.0 / (2.0 * allowed / 10.0).sqrt();
        assert!(vertices.len() as f64 > fewest && vertices.len() < 200);
    }
}
