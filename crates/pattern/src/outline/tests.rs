//! Outline files: what is read of them, and what is refused with its line.

use super::*;

fn read(text: &str, format: Format) -> Outline {
    Outline::parse(text, format).unwrap()
}

fn refused(text: &str, format: Format) -> OutlineError {
    Outline::parse(text, format).unwrap_err()
}

fn points(coordinates: &[[f64; 2]]) -> Vec<DVec2> {
    coordinates.iter().copied().map(DVec2::from).collect()
}

#[test]
fn tables_are_read_with_any_separator_names_and_comments() {
    let expected = points(&[[0.0, 1.0], [2.5, -3.0], [4.0, 1e-2]]);
    for text in [
        "0,1\n2.5,-3\n4,1e-2\n",
        "x;z\n0; 1\n\n# a comment\n2.5;-3\n4;0.01",
        "x z\r\n0 1\r\n2.5\t-3\r\n4 .01\r\n",
        "\u{feff}x, z\n0, 1\n2.5, -3\n4, 0.01\n",
        "\"x\",\"z\"\n\"0\",\"1\"\n\"2.5\", \"-3\"\n4,\"0.01\"\n",
        "\"0\" \"1\"\n\"2.5\"\t-3\n4 0.01\n",
    ] {
        let outline = read(text, Format::Csv);
        assert_eq!((outline.points, outline.closed), (expected.clone(), false));
    }
    assert!(read("0,0\n1,0\n1,1\n0,0\n", Format::Csv).closed);
}

#[test]
fn tables_with_errors_are_refused_with_their_line() {
    let cases = [
        ("", "no points"),
        ("# nothing\n", "no points"),
        ("0,0\n1,x\n", "line 2: \"x\""),
        ("0,0\n\"1\",\"x\"\n", "line 2: \"x\""),
        ("0,0\n1,nan\n", "line 2: \"nan\""),
        ("0,0\n\n1,inf\n", "line 3: \"inf\""),
        ("0,0\n1,2,3\n", "line 2: 3 values"),
        ("0,0\n1\n", "line 2: 1 values"),
        ("x,z\nx,z\n", "line 2: \"x\""),
    ];
    for (text, words) in cases {
        let message = refused(text, Format::Csv).to_string();
        assert!(message.contains(words), "{text:?}: {message}");
    }
}

const SELIG: &str = "NACA thing 12\n 1.00  0.001\n 0.5 0.08\n 0.0 0.0\n 0.5 -0.04\n 1.0 -0.001\n";
const LEDNICER: &str = "NACA thing 12\n 3. 3.\n\n 0.0 0.0\n 0.5 0.08\n 1.00 0.001\n\n 0.0 0.0\n 0.5 -0.04\n 1.0 -0.001\n";

#[test]
fn both_orders_of_an_airfoil_are_the_same_outline_closed_at_the_middle_of_its_trailing_edge() {
    let expected = points(&[[1.0, 0.0], [0.5, 0.08], [0.0, 0.0], [0.5, -0.04], [1.0, 0.0]]);
    for text in [SELIG, LEDNICER] {
        let outline = read(text, Format::Airfoil);
        assert_eq!(outline.points, expected);
        assert!(outline.closed);
    }
}

#[test]
fn an_airfoil_named_by_numbers_or_by_nothing_is_read_too() {
    let named = SELIG.replace("NACA thing 12", "4412 63");
    assert_eq!(read(&named, Format::Airfoil).points.len(), 5);
    let nameless = SELIG.replace("NACA thing 12\n", "");
    assert_eq!(read(&nameless, Format::Airfoil).points.len(), 5);
}

#[test]
fn a_wide_trailing_edge_is_left_as_it_is() {
    let wide = SELIG.replace("1.00  0.001", "1.00 0.1");
    let outline = read(&wide, Format::Airfoil);
    assert_eq!(outline.points[0], DVec2::new(1.0, 0.1));
}

#[test]
fn airfoils_with_errors_are_refused_with_their_line() {
    let counts = refused(&LEDNICER.replace("3. 3.", "3. 4."), Format::Airfoil);
    assert_eq!(counts, OutlineError::PointCounts { line: 2, upper: 3.0, lower: 4.0, found: 6 });
    assert!(matches!(refused("name\n", Format::Airfoil), OutlineError::Empty { .. }));
    let broken = SELIG.replace("-0.04", "oops");
    assert!(refused(&broken, Format::Airfoil).to_string().starts_with("line 5: \"oops\""));
    let triple = SELIG.replace("-0.04", "-0.04 7");
    assert!(matches!(
        refused(&triple, Format::Airfoil),
        OutlineError::NotAPoint { line: 5, count: 3 }
    ));
}

const LIGHT: &str = "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n3\n70\n1\n10\n0.0\n20\n0.0\n10\n2.0\n20\n0.5\n10\n1.0\n20\n3.0\n0\nENDSEC\n0\nEOF\n";
const HEAVY: &str = "0\nPOLYLINE\n8\n0\n10\n9.0\n20\n9.0\n70\n0\n0\nVERTEX\n10\n0.0\n20\n0.0\n0\nVERTEX\n10\n2.0\n20\n0.5\n42\n0.0\n0\nVERTEX\n10\n1.0\n20\n3.0\n0\nSEQEND\n0\nCIRCLE\n10\n5.0\n20\n5.0\n40\n1.0\n0\nEOF\n";

#[test]
fn both_kinds_of_polyline_are_read_and_other_entities_left_out() {
    let expected = points(&[[0.0, 0.0], [2.0, 0.5], [1.0, 3.0]]);
    let light = read(LIGHT, Format::Dxf);
    let ring = [expected.clone(), points(&[[0.0, 0.0]])].concat();
    assert_eq!((light.points, light.closed), (ring, true));
    let heavy = read(HEAVY, Format::Dxf);
    assert_eq!((heavy.points, heavy.closed), (expected, false));
}

#[test]
fn drawings_with_errors_are_refused_by_name() {
    let cases = [
        (HEAVY.replace("42\n0.0", "42\n0.5"), "arc (bulge 0.5)"),
        (HEAVY.replace("70\n0", "70\n4"), "curve-fitted"),
        (format!("{}{LIGHT}", HEAVY.replace("0\nEOF\n", "")), "2 polylines"),
        (LIGHT.replace("LWPOLYLINE", "SPLINE"), "line 6: SPLINE is not read"),
        (LIGHT.replace("LWPOLYLINE", "ARC"), "line 6: ARC is not read"),
        (LIGHT.replace("LWPOLYLINE", "TEXT"), "no points"),
        (LIGHT.replace("90\n3", "90\n4"), "announces 4 vertices (code 90), but 3"),
        (LIGHT.replace("0\nENDSEC\n0\nEOF\n", ""), "line 24: the drawing ends here"),
        (LIGHT.replace("0\nEOF\n", "0\n"), "the drawing ends here"),
        (LIGHT.replace("10\n2.0", "10\ntwo"), "\"two\""),
        (LIGHT.replace("90\n3", "ninety\n3"), "group code"),
        ("AutoCAD Binary DXF\r\n\u{1a}".to_owned(), "binary"),
    ];
    for (text, words) in cases {
        let message = refused(&text, Format::Dxf).to_string();
        assert!(message.contains(words), "{words}: {message}");
    }
}

/// A drawing of LINEs.
fn lines(ends: &[[f64; 4]]) -> String {
    let line = |[x, y, u, v]: &[f64; 4]| {
        format!("0\nLINE\n8\n0\n10\n{x}\n20\n{y}\n30\n0.0\n11\n{u}\n21\n{v}\n31\n0.0\n")
    };
    let lines: String = ends.iter().map(line).collect();
    format!("0\nSECTION\n2\nENTITIES\n{lines}0\nENDSEC\n0\nEOF\n")
}

#[test]
fn lines_in_any_order_and_direction_are_one_chain() {
    let open = [[2.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 0.0], [3.0, 1.0, 2.0, 1.000_000_1]];
    let outline = read(&lines(&open), Format::Dxf);
    let expected = [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [3.0, 1.0]];
    assert!(!outline.closed && outline.points.len() == expected.len());
    for (point, expected) in outline.points.iter().zip(points(&expected)) {
        assert!(point.distance(expected) < 1e-6, "{point}");
    }
    let ring = [[0.0, 0.0, 1.0, 0.0], [0.0, 5.0, 0.0, 0.0], [1.0, 0.0, 0.0, 5.0]];
    let outline = read(&lines(&ring), Format::Dxf);
    assert!(outline.closed);
    let expected = points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 5.0], [0.0, 0.0]]);
    assert_eq!(outline.points, expected);
}

#[test]
fn lines_that_branch_or_lie_apart_are_refused() {
    let branch = [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 2.0, 0.0], [1.0, 0.0, 1.0, 1.0]];
    let text = refused(&lines(&branch), Format::Dxf).to_string();
    assert!(text.contains("more than two LINEs meet"), "{text}");
    let apart = [[0.0, 0.0, 1.0, 0.0], [1.5, 0.0, 2.0, 0.0]];
    let text = refused(&lines(&apart), Format::Dxf).to_string();
    assert!(text.contains("line 22") && text.contains("not joined"), "{text}");
}

#[test]
fn a_ring_whose_drawing_closes_it_may_have_a_long_last_side() {
    let outline = read(&LIGHT.replace("10\n1.0", "10\n90.0"), Format::Dxf);
    assert_eq!(outline.points.first(), outline.points.last());
}

#[test]
fn files_of_unknown_or_no_format_and_missing_ones_are_refused() {
    for name in ["outline.svg", "outline"] {
        let error = Outline::read(Path::new(name)).unwrap_err();
        assert!(matches!(error, OutlineError::UnknownEnding { .. }));
    }
    let missing = Outline::read(Path::new("no/such/outline.CSV")).unwrap_err();
    assert!(matches!(missing, OutlineError::Read { .. }));
}
