//! Drawings as people and drawing programs make them.

use foldmotion_pattern::{
    Assignment, CurvedFacets, ImportError, ImportOptions, ImportedPattern, Pieces, UnknownElements,
    WarningKind, import_svg,
};
use glam::DVec2;

use crate::patterns::{check_sheet, counts};
use crate::svg::document;

fn read(text: &str) -> ImportedPattern {
    read_with(text, &ImportOptions::default())
}

fn read_with(text: &str, options: &ImportOptions) -> ImportedPattern {
    let imported = import_svg(text.as_bytes(), options).unwrap();
    check_sheet(&imported);
    imported
}

/// A sheet of 100 by 100 with something in it.
fn sheet(body: &str) -> ImportedPattern {
    read(&document("", &format!("<rect width=\"100\" height=\"100\" stroke=\"#000\"/>{body}")))
}

fn warned(imported: &ImportedPattern, kind: WarningKind) -> usize {
    imported.warnings.iter().find(|w| w.kind == kind).map_or(0, |w| w.count)
}

fn count(imported: &ImportedPattern, letter: char) -> usize {
    counts(imported).get(&letter).copied().unwrap_or_default()
}

/// The ends of the creases of a kind, sorted.
fn creases(imported: &ImportedPattern, kind: Assignment) -> Vec<[[i64; 2]; 2]> {
    let place =
        |v: u32| imported.sheet.vertices[v as usize].to_array().map(|c| (c * 1e6).round() as i64);
    let of_kind = imported.sheet.edges.iter().filter(|e| e.assignment == kind);
    let mut found: Vec<_> = of_kind
        .map(|e| {
            let mut ends = e.vertices.map(place);
            ends.sort_unstable();
            ends
        })
        .collect();
    found.sort_unstable();
    found
}

#[test]
fn every_command_of_a_curve_draws_the_same_as_its_long_form() {
    for (long, short) in [
        ("M0 50C20 20 40 20 50 50C60 80 80 80 100 50", "M0 50c20 -30 40 -30 50 0s30 30 50 0"),
        ("M0 50C20 20 40 20 50 50C60 80 80 80 100 50", "M0 50C20 20 40 20 50 50S80 80 100 50"),
        ("M0 50Q25 20 50 50Q75 80 100 50", "M0 50q25 -30 50 0t50 0"),
        ("M0 50Q25 20 50 50Q75 80 100 50", "M0 50Q25 20 50 50T100 50"),
        ("M0 50A60 60 0 0 1 100 50", "M0 50a60 60 0 0 1 100 0"),
        ("M0 50A60 40 30 0 1 100 50", "M0 50a60,40,30,01100,0"),
    ] {
        let [long, short] = [long, short]
            .map(|d| sheet(&format!("<path d=\"{d}\" fill=\"none\" stroke=\"red\"/>")));
        assert!(count(&long, 'M') > 5);
        assert_eq!(creases(&long, Assignment::Mountain), creases(&short, Assignment::Mountain));
        assert_eq!(warned(&short, WarningKind::Flattened), 1);
    }
}

#[test]
fn circles_ellipses_arcs_and_round_corners_lie_on_their_curves() {
    let ellipse = |p: DVec2| ((p.x - 50.0) / 40.0).hypot((p.y + 50.0) / 20.0);
    let circle = |p: DVec2| p.distance(DVec2::new(50.0, -50.0)) / 30.0;
    let corners = |p: DVec2| {
        let from_core = ((p - DVec2::new(50.0, -50.0)).abs() - 10.0).max(DVec2::ZERO);
        from_core.length() / 20.0
    };
    for (element, curve) in [
        ("<circle cx=\"50\" cy=\"50\" r=\"30\"", &circle as &dyn Fn(DVec2) -> f64),
        ("<path d=\"M20 50A30 30 0 0 1 80 50a30 30 0 0 1 -60 0\"", &circle),
        ("<path d=\"M50 20A30 30 0 1 0 80 50A30 30 0 0 0 50 20z\"", &circle),
        ("<ellipse cx=\"50\" cy=\"50\" rx=\"40\" ry=\"20\"", &ellipse),
        ("<path d=\"M10 50A40 20 0 0 0 90 50A40 20 0 0 0 10 50\"", &ellipse),
        (
            "<path transform=\"rotate(90 50 50)\" d=\"M50 10A4 2 90 0 0 50 90A4 2 90 0 0 50 10\"",
            &|p| ((p.x - 50.0) / 40.0).hypot((p.y + 50.0) / 20.0),
        ),
        ("<rect x=\"20\" y=\"20\" width=\"60\" height=\"60\" rx=\"20\"", &corners),
    ] {
        let imported = sheet(&format!("{element} fill=\"none\" stroke=\"#00f\"/>"));
        assert_eq!(imported.sheet.facets.len(), 2, "{element}");
        assert!(count(&imported, 'V') >= 16, "{element}");
        for edge in imported.sheet.edges.iter().filter(|e| e.assignment == Assignment::Valley) {
            for v in edge.vertices {
                let off = curve(imported.sheet.vertices[v as usize]);
                assert!((off - 1.0).abs() < 1e-4, "{element}: {off}");
            }
        }
    }
}

#[test]
fn a_used_element_is_drawn_where_its_uses_are() {
    let plain = sheet("<path d=\"M30 0V100M60 0V100\" stroke=\"blue\"/>");
    for body in [
        "<defs><line id=\"v\" y2=\"100\" stroke=\"blue\"/></defs><use href=\"#v\" x=\"30\"/><use href=\"#v\" x=\"60\"/>",
        "<defs xmlns:xlink=\"http://www.w3.org/1999/xlink\"><g id=\"g\"><line id=\"v\" y2=\"100\"/><use xlink:href=\"#v\" \
         x=\"30\"/></g></defs><use href=\"#g\" transform=\"translate(30)\" stroke=\"blue\"/>",
        "<symbol id=\"s\"><path d=\"M0 0V100\"/></symbol><g stroke=\"blue\"><use href=\"#s\" x=\"30\"/><use href=\"#s\" \
         transform=\"rotate(180)\" x=\"-60\" y=\"-100\"/></g>",
    ] {
        let used = sheet(body);
        let [used, plain] = [&used, &plain].map(|i| creases(i, Assignment::Valley));
        assert_eq!(used, plain, "{body}");
    }
}

#[test]
fn printed_colours_are_read_by_their_hue_and_grey_lines_are_left_out() {
    let line = |x: i32, colour: &str| format!("<path d=\"M{x} 0V100\" stroke=\"{colour}\"/>");
    let body = format!(
        "<rect width=\"100\" height=\"100\" stroke=\"#231F20\"/>{}",
        [(10, "#ED1C24"), (20, "#2E3192"), (30, "hsl(0, 100%, 50%)"), (40, "rgb(0 0 255)")]
            .iter()
            .chain(&[(50, "gray"), (60, "#808080"), (70, "rgba(128,128,128,0.5)"), (80, "#0ff")])
            .map(|(x, colour)| line(*x, colour))
            .collect::<String>()
    );
    let text = document("", &body);
    let imported = read(&text);
    assert_eq!([count(&imported, 'M'), count(&imported, 'V'), count(&imported, 'B')], [2, 2, 12]);
    let warning = |kind| imported.warnings.iter().find(|w| w.kind == kind).unwrap().to_string();
    assert!(warning(WarningKind::NearColour).contains("1 × #ED1C24 as mountain"));
    let auxiliary = warning(WarningKind::Auxiliary);
    for part in ["1 × #808080", "1 × gray", "1 × #0ff", "auxiliary"] {
        assert!(auxiliary.contains(part), "{auxiliary}");
    }
    let strict = ImportOptions { unknown: UnknownElements::Refuse, ..Default::default() };
    let refused = import_svg(text.as_bytes(), &strict).unwrap_err();
    assert!(matches!(&refused, ImportError::Unknown { elements, .. } if elements.len() == 4));
}

#[test]
fn border_lines_inside_the_sheet_are_cuts() {
    // Across the sheet it parts it; from the edge to the middle it opens where a crease ends; alone it stays closed.
    let parted = sheet("<path d=\"M20 0V100\" stroke=\"black\"/>");
    assert_eq!(warned(&parted, WarningKind::InnerBorder), 1);
    assert_eq!(warned(&parted, WarningKind::OtherPiece), 1);
    assert!(parted.sheet.vertices.iter().all(|v| v.x >= 20.0));
    let halves = sheet("<path d=\"M50 0V100\" stroke=\"black\"/>");
    assert_eq!((halves.sheet.facets.len(), warned(&halves, WarningKind::OtherPiece)), (2, 0));
    let notch = sheet(
        "<path d=\"M0 50H50\" stroke=\"black\"/><path d=\"M50 0V50\" stroke=\"red\"/><path d=\"M50 50V100\" \
         stroke=\"blue\"/>",
    );
    let cut = sheet(
        "<path d=\"M0 50H50\" stroke=\"#0f0\"/><path d=\"M50 0V50\" stroke=\"red\"/><path d=\"M50 50V100\" \
         stroke=\"blue\"/>",
    );
    assert_eq!(notch.sheet, cut.sheet);
    assert_eq!(warned(&notch, WarningKind::InnerBorder), 1);
    // Two holes that share a side are holes, and the side is left out.
    let holes = sheet(
        "<rect x=\"20\" y=\"20\" width=\"20\" height=\"20\" stroke=\"black\"/><rect x=\"40\" y=\"20\" width=\"20\" \
         height=\"20\" stroke=\"black\"/>",
    );
    assert_eq!((holes.euler_characteristic(), warned(&holes, WarningKind::InnerBorder)), (0, 0));
}

#[test]
fn a_grid_in_the_colour_of_the_border_does_not_cut_the_creases_apart() {
    // Squared paper: as cuts the lines would leave one of the three creases to each square.
    let grid = "<path d=\"M20 0V100M40 0V100M60 0V100M80 0V100M0 50H100\" stroke=\"black\"/>";
    let creases = "<path d=\"M0 0L20 50L40 0L60 50\" stroke=\"red\"/>";
    let imported = sheet(&(grid.to_owned() + creases));
    assert_eq!((count(&imported, 'M'), warned(&imported, WarningKind::InnerGrid)), (3, 1));
    assert_eq!(warned(&imported, WarningKind::OtherPiece), 0);
    assert_eq!(imported.euler_characteristic(), 1);
    assert_eq!(count(&imported, 'F'), 13);
    // No crease ends on it: it is nothing.
    let imported = sheet(&(grid.to_owned() + "<path d=\"M0 0L50 100L100 0\" stroke=\"red\"/>"));
    let found = ['M', 'F'].map(|letter| count(&imported, letter));
    assert_eq!((found, warned(&imported, WarningKind::InnerGrid)), ([2, 0], 1));
    assert_eq!(imported.mending.dropped, 0);
    // A grid all around, with creases on it, and the ends of its lines beyond it.
    let line = |k: i32| format!("<path d=\"M{0} -5V45M-5 {0}H45\" stroke=\"black\"/>", 10 * k);
    let lines = [0, 1, 2, 3, 4].map(line).concat();
    let single = lines.replace("M-5", "\" stroke=\"black\"/><path d=\"M-5");
    let body =
        single + "<path d=\"M20 0V40\" stroke=\"red\"/><path d=\"M0 0L40 40\" stroke=\"blue\"/>";
    let imported = read(&document("", &body));
    let found = ['M', 'V', 'B'].map(|letter| count(&imported, letter));
    assert_eq!((found, imported.euler_characteristic()), ([2, 2, 6], 1));
    assert_eq!(warned(&imported, WarningKind::InnerGrid), 10);
}

#[test]
fn a_grid_that_goes_on_beyond_the_border_leaves_neither_lines_nor_paper() {
    // The lower side lies a little off the grid, so that lines of the grid would cut slivers from the sheet.
    let line = |k: i32| {
        format!(
            "<path d=\"M{0} -35V135\" stroke=\"black\"/><path d=\"M-35 {0}H135\" stroke=\"black\"/>",
            20 * k
        )
    };
    let grid = (-1..7).map(line).collect::<String>();
    let sides = ["0 0V100", "0 100L100 100.4", "100 100.4V0", "100 0H0"];
    let sides = sides.map(|side| format!("<path d=\"M{side}\" stroke=\"black\"/>")).concat();
    let creases =
        "<path d=\"M0 0L100 100.4\" stroke=\"red\"/><path d=\"M50 50.2L0 100\" stroke=\"blue\"/>";
    for body in [grid.clone() + &sides + creases, sides.clone() + creases + &grid] {
        let imported = read(&document("", &body));
        let found = ['M', 'V', 'B', 'F'].map(|letter| count(&imported, letter));
        assert_eq!((found, imported.sheet.facets.len()), ([2, 1, 4, 0], 3));
        assert_eq!(warned(&imported, WarningKind::InnerGrid), 16);
        assert_eq!(imported.mending.dropped, 0);
    }
}

#[test]
fn a_filled_outline_without_a_stroke_is_the_border_if_no_line_is() {
    let crease = "<path d=\"M50 0V100\" stroke=\"red\"/>";
    for outline in [
        "<rect width=\"100\" height=\"100\" fill=\"#eee\"/>",
        "<rect width=\"100\" height=\"100\"/>",
        "<polygon points=\"0 0 100 0 100 100 0 100\" style=\"fill:white\"/>",
        "<path d=\"M0 0H100V100H0z\" fill=\"white\" stroke=\"none\"/>",
    ] {
        let imported = read(&document("", &(outline.to_owned() + crease)));
        assert_eq!((imported.sheet.facets.len(), count(&imported, 'M')), (2, 1), "{outline}");
        assert_eq!(warned(&imported, WarningKind::FilledBorder), 1);
        let bordered = sheet(&(outline.replace("100", "80") + crease));
        assert_eq!((bordered.sheet.facets.len(), count(&bordered, 'M')), (2, 1), "{outline}");
        assert_eq!(warned(&bordered, WarningKind::FilledBorder), 0);
    }
    let unfilled = "<rect width=\"100\" height=\"100\" fill=\"none\"/>";
    let imported = read(&document("", &(unfilled.to_owned() + crease)));
    assert_eq!(warned(&imported, WarningKind::FilledBorder), 0);
}

#[test]
fn a_missing_border_is_the_outline_of_the_lines() {
    // Creases on the outline stay creases: the sheet reaches to the page.
    let lines = "<path d=\"M30 10V90\" stroke=\"red\"/><path d=\"M60 10V90\" stroke=\"blue\"/>";
    let imported = read(&document("viewBox=\"0 0 90 100\"", lines));
    assert_eq!((imported.sheet.facets.len(), warned(&imported, WarningKind::AddedBorder)), (3, 1));
    let far = imported.sheet.vertices.iter().fold(DVec2::ZERO, |far, v| far.max(v.abs()));
    assert_eq!(far, DVec2::new(90.0, 90.0));
    assert_eq!(read(&document("", lines)).sheet.facets.len(), 3);
    let one = read(&document("", "<path d=\"M30 10V90\" stroke=\"red\"/>"));
    assert_eq!((one.sheet.facets.len(), count(&one, 'M')), (2, 1));
    // Otherwise it is the convex hull: an octagon around four lines through its middle.
    let line =
        |turn: u32| format!("<path transform=\"rotate({turn})\" d=\"M-9 0H9\" stroke=\"red\"/>");
    let star = [0, 45, 90, 135].map(line).concat();
    let imported = read(&document("", &star));
    assert_eq!([count(&imported, 'M'), count(&imported, 'B')], [8, 8]);
    // Lines that close the pattern need none, not even if they miss each other a little.
    for closed in [
        "<path d=\"M0 0H9V9H0ZL9 9\" stroke=\"red\"/>",
        "<path d=\"M0 0H80V40H40V80H0.05V0.05\" stroke=\"red\"/><path d=\"M0 0.04L39.96 40\" stroke=\"blue\"/>",
    ] {
        let imported = read(&document("", closed));
        assert_eq!(warned(&imported, WarningKind::AddedBorder), 0);
        assert_eq!((imported.sheet.facets.len(), imported.mending.dropped), (2, 0));
    }
}

#[test]
fn the_largest_piece_is_read_or_the_one_named_or_all() {
    let piece = |x: f64, size: f64, colour: &str, id: &str| {
        format!(
            "<g id=\"{id}\"><rect x=\"{x}\" width=\"{size}\" height=\"{size}\" stroke=\"black\"/><path d=\"M{} 0v{size}\" \
             stroke=\"{colour}\"/></g>",
            x + size / 2.0
        )
    };
    let body = piece(0.0, 10.0, "red", "left") + &piece(20.0, 20.0, "blue", "right");
    let text = document("", &body);
    let of = |pieces| {
        let options = ImportOptions { pieces, ..ImportOptions::default() };
        let imported = read_with(&text, &options);
        let found = [count(&imported, 'M'), count(&imported, 'V')];
        (found, warned(&imported, WarningKind::OtherPiece))
    };
    let named = |name: &str| of(Pieces::Named(name.to_owned()));
    assert_eq!([of(Pieces::Main), of(Pieces::Largest)], [([0, 1], 1); 2]);
    assert_eq!(of(Pieces::All), ([1, 1], 0));
    assert_eq!([named("left"), named("0")], [([1, 0], 1); 2]);
    assert_eq!([named("right"), named("1")], [([0, 1], 1); 2]);
    // One half as large and more stands beside it.
    let text =
        document("", &(piece(0.0, 15.0, "red", "left") + &piece(20.0, 20.0, "blue", "right")));
    let both = read(&text);
    assert_eq!([count(&both, 'M'), count(&both, 'V')], [1, 1]);
    let options = ImportOptions { pieces: Pieces::Named("2".to_owned()), ..Default::default() };
    let refused = import_svg(text.as_bytes(), &options).unwrap_err();
    assert!(
        refused.to_string().contains("0 to 1") && refused.to_string().contains("pattern.piece")
    );
}

#[test]
fn every_encoding_of_a_drawing_program_is_read() {
    let body = "<title>Fächer</title><rect width=\"9\" height=\"9\" stroke=\"#000\"/>";
    let text = format!("<?xml version=\"1.0\" encoding=\"UTF-16\"?>{}", document("", body));
    let units: Vec<u16> = text.encode_utf16().collect();
    let marked: Vec<u16> = std::iter::once(0xfeff).chain(units.iter().copied()).collect();
    let little = |units: &[u16]| units.iter().flat_map(|u| u.to_le_bytes()).collect::<Vec<u8>>();
    let big = |units: &[u16]| units.iter().flat_map(|u| u.to_be_bytes()).collect::<Vec<u8>>();
    let latin = text.replace("UTF-16", "ISO-8859-1");
    for bytes in [
        [b"\xef\xbb\xbf", text.as_bytes()].concat(),
        little(&marked),
        big(&marked),
        little(&units),
        big(&units),
        latin.chars().map(|letter| letter as u8).collect(),
    ] {
        let imported = import_svg(&bytes, &ImportOptions::default()).unwrap();
        assert_eq!(imported.title.as_deref(), Some("Fächer"));
        assert_eq!(imported.sheet.facets.len(), 1);
    }
    let cut_off = &little(&marked)[..31];
    let refused = import_svg(cut_off, &ImportOptions::default()).unwrap_err();
    assert_eq!(refused, ImportError::NotUtf16);
}

#[test]
fn entities_of_the_document_type_are_read() {
    let text = "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://www.w3.org/svg11.dtd\" [<!ENTITY ns_svg \
                \"http://www.w3.org/2000/svg\"><!ENTITY ns_ai 'http://ns.adobe.com/ai'>]>\
                <svg xmlns=\"&ns_svg;\" xmlns:i=\"&ns_ai;\"><rect width=\"9\" height=\"9\" stroke=\"#000\"/></svg>";
    assert_eq!(read(text).sheet.facets.len(), 1);
}

#[test]
fn a_pattern_far_from_the_origin_is_the_same_pattern() {
    let body = "<rect width=\"1\" height=\"1\" stroke=\"#000\"/><path d=\"M0.25 0V1L0.75 0\" stroke=\"red\"/>";
    let near = read(&document("", body));
    let far = format!("<g transform=\"translate(1000000 -500000)\">{body}</g>");
    let far = read(&document("", &far));
    assert_eq!(counts(&far), counts(&near));
    assert!(far.sheet.vertices.iter().all(|v| v.length() < 2.0));
    let lengths = |i: &ImportedPattern| -> Vec<i64> {
        let vertices = &i.sheet.vertices;
        let edges = i.sheet.edges.iter().map(|e| e.vertices.map(|v| vertices[v as usize]));
        let mut lengths: Vec<i64> = edges.map(|[a, b]| (a.distance(b) * 1e8) as i64).collect();
        lengths.sort_unstable();
        lengths
    };
    let differ = lengths(&far).iter().zip(lengths(&near)).map(|(a, b)| (a - b).abs()).max();
    assert!(differ.unwrap() <= 1);
}

/// The angles, degrees, between the lines inside facets and the curved crease they end on, a circle around `centre`.
fn angles_to_circle(imported: &ImportedPattern, centre: DVec2, radius: f64) -> Vec<f64> {
    let vertices = &imported.sheet.vertices;
    let facet_lines = imported.sheet.edges.iter().filter(|e| e.assignment == Assignment::Facet);
    let mut angles = Vec::new();
    for edge in facet_lines {
        let ends = edge.vertices.map(|v| vertices[v as usize] - centre);
        for (end, other) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            if (end.length() - radius).abs() < 1e-3 * radius {
                let cosine = end.normalize().dot((other - end).normalize()).abs().min(1.0);
                angles.push(90.0 - cosine.acos().to_degrees());
            }
        }
    }
    angles
}

#[test]
fn facets_between_curved_creases_are_cut_along_their_rulings() {
    // A ring between two circles, its rulings radial; and the sheet outside, whose border gets vertices for them.
    let body = "<circle cx=\"50\" cy=\"50\" r=\"20\" fill=\"none\" stroke=\"red\"/><circle cx=\"50\" cy=\"50\" r=\"35\" \
                fill=\"none\" stroke=\"blue\"/>";
    let text = document("", &format!("<rect width=\"100\" height=\"100\" stroke=\"#000\"/>{body}"));
    let ruled = read(&text);
    let options = ImportOptions { curved_facets: CurvedFacets::Delaunay, ..Default::default() };
    let plain = read_with(&text, &options);
    let centre = DVec2::new(50.0, -50.0);
    let outer = |i: &ImportedPattern| {
        let angles = angles_to_circle(i, centre, 35.0);
        angles.iter().sum::<f64>() / angles.len() as f64
    };
    assert!(outer(&ruled) > 70.0 && outer(&ruled) > outer(&plain) + 2.0);
    assert!(count(&ruled, 'B') > count(&plain, 'B') + 8);
    assert_eq!([count(&ruled, 'M'), count(&ruled, 'V')], [count(&plain, 'M'), count(&plain, 'V')]);
}

#[test]
fn rulings_of_a_half_circle_across_the_sheet_reach_the_border() {
    let arc = "<path d=\"M0 80A50 50 0 0 1 100 80\" fill=\"none\" stroke=\"red\"/>";
    let imported = sheet(arc);
    let angles = angles_to_circle(&imported, DVec2::new(50.0, -80.0), 50.0);
    let steep = angles.iter().filter(|angle| **angle > 60.0).count();
    assert!(10 * steep >= 8 * angles.len(), "{steep} of {}: {angles:?}", angles.len());
}
