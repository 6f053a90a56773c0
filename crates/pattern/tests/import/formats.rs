//! Crease patterns in the formats of other programs, known by their content.

use std::fmt::Write as _;

use foldmotion_pattern::{
    Assignment, ImportError, ImportOptions, ImportedPattern, LengthUnit, PatternFileFormat,
    UnknownElements, WarningKind, import_pattern,
};
use glam::DVec2;

use crate::patterns::{check_sheet, counts};

fn read(text: &str) -> ImportedPattern {
    let imported = import_pattern(text.as_bytes(), None, &ImportOptions::default());
    let imported = imported.unwrap_or_else(|e| panic!("{e}: {text}"));
    check_sheet(&imported);
    imported
}

fn refused(bytes: &[u8]) -> ImportError {
    import_pattern(bytes, None, &ImportOptions::default()).unwrap_err()
}

fn format(text: &str) -> Option<PatternFileFormat> {
    PatternFileFormat::of_content(text.as_bytes())
}

fn warned(imported: &ImportedPattern, kind: WarningKind) -> usize {
    imported.warnings.iter().find(|w| w.kind == kind).map_or(0, |w| w.count)
}

/// Where the creases of a kind are: the x of their middles.
fn middles(imported: &ImportedPattern, kind: Assignment) -> Vec<f64> {
    let of_kind = imported.sheet.edges.iter().filter(|e| e.assignment == kind);
    let middle = |v: [u32; 2]| {
        let [a, b] = v.map(|v| imported.sheet.vertices[v as usize]);
        a.midpoint(b).x
    };
    let mut found: Vec<f64> = of_kind.map(|e| middle(e.vertices)).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// A rectangle of 40 by 20 with a mountain at x = 10, a valley at x = 20, and perhaps an auxiliary line at x = 30.
fn check_two_folds(imported: &ImportedPattern, auxiliary: usize) {
    assert_eq!(middles(imported, Assignment::Mountain), [10.0]);
    assert_eq!(middles(imported, Assignment::Valley), [20.0]);
    assert_eq!((imported.sheet.facets.len(), counts(imported)[&'B']), (3, 8));
    assert_eq!(warned(imported, WarningKind::Auxiliary), auxiliary);
}

const CP: &str = "1 0 0 40 0\n1 40 0 40 20\n1 40 20 0 20\n1 0 20 0 0\n2 10 0 10 20\n3 20.0 -0.0 2E1 20\n0 30 0 30 20\n";

#[test]
fn lines_of_oripa_are_read_with_their_types() {
    assert_eq!(format(CP), Some(PatternFileFormat::Cp));
    check_two_folds(&read(CP), 1);
    check_two_folds(&read(&CP.replace('\n', "\r\n\r\n")), 1);
    let free = read(&CP.replace("0 30 0 30 20", "4 30 0 30 20"));
    assert_eq!(counts(&free)[&'U'], 1);
    let source = free.sources.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    assert!(source.contains("type 2 (line 5)"), "{source}");
    // y runs downwards: the upper edge of the drawing is at y = 0.
    assert!(free.sheet.vertices.iter().all(|v| v.y <= 0.0));
    let strict = ImportOptions { unknown: UnknownElements::Refuse, ..ImportOptions::default() };
    let error = import_pattern(CP.as_bytes(), Some("cp"), &strict).unwrap_err();
    assert!(error.to_string().contains("type 0"), "{error}");
    let broken = import_pattern(b"1 0 0 40\n", Some("cp"), &ImportOptions::default());
    assert!(matches!(broken, Err(ImportError::Line { line: 1, .. })), "{broken:?}");
}

fn opx(lines: &[[f64; 5]]) -> String {
    let property = |name: &str, value: f64| {
        // Java omits what is 0.
        let kind = if name == "type" { "int" } else { "double" };
        match value {
            0.0 => String::new(),
            _ => format!("<void property=\"{name}\">\n<{kind}>{value}</{kind}>\n</void>\n"),
        }
    };
    let line = |[kind, x0, y0, x1, y1]: &[f64; 5]| {
        let values = [("type", kind), ("x0", x0), ("x1", x1), ("y0", y0), ("y1", y1)];
        let properties = values.map(|(name, value)| property(name, *value)).concat();
        format!(
            "<void index=\"0\"><object class=\"oripa.OriLineProxy\">{properties}</object></void>\n"
        )
    };
    let lines: Vec<String> = lines.iter().map(line).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<java class=\"java.beans.XMLDecoder\"><object class=\"oripa.DataSet\">\
         <void property=\"lines\"><array class=\"oripa.OriLineProxy\">{}</array></void>\
         <void property=\"title\"><string>Fold</string></void></object></java>",
        lines.concat()
    )
}

#[test]
fn objects_of_oripa_are_read_where_java_omits_zeros() {
    let lines: Vec<[f64; 5]> = CP
        .lines()
        .map(|line| {
            let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        })
        .collect();
    let text = opx(&lines);
    assert_eq!(format(&text), Some(PatternFileFormat::Opx));
    let imported = read(&text);
    check_two_folds(&imported, 1);
    assert_eq!(imported.title.as_deref(), Some("Fold"));
    assert_eq!(imported.sheet, read(CP).sheet);
    let wrong = refused(text.replace("<double>20</double>", "<double>NaN</double>").as_bytes());
    assert!(matches!(wrong, ImportError::Line { .. }), "{wrong}");
}

#[test]
fn lines_of_orihime_are_read_in_both_encodings() {
    let colours = [(0, "0,0,40,0"), (0, "40,0,40,20"), (0, "40,20,0,20"), (0, "0,20,0,0")];
    let folds = [(1, "10.0,0.0,10.0,20.0"), (2, "20,0,20,20"), (3, "30,0,30,20")];
    let mut text = "<タイトル>\nタイトル,_\n<線分集合>\n".to_owned();
    for (index, (colour, ends)) in colours.iter().chain(&folds).enumerate() {
        let number = index + 1;
        let _ = write!(text, "番号,{number}\n色,{colour}\n<tpp>0</tpp>\n座標,{ends}\n");
    }
    text +=
        "<円集合>\n番号,1\n座標,1,2,3,4\n<補助線分集合>\n補助番号,1\n補助色,4\n補助座標,5,0,5,20\n";
    assert_eq!(format(&text), Some(PatternFileFormat::Orh));
    let unicode = read(&text);
    check_two_folds(&unicode, 1);
    let words: [(&str, &[u8]); 4] = [
        ("線分集合", b"\x90\xfc\x95\xaa\x8f\x57\x8d\x87"),
        ("座標", b"\x8d\xc0\x95\x57"),
        ("番号", b"\x94\xd4\x8d\x86"),
        ("色", b"\x90\x46"),
    ];
    let mut shift_jis = text.into_bytes();
    for (word, bytes) in words {
        let mut replaced = Vec::new();
        let mut rest = shift_jis.as_slice();
        while let Some(at) = rest.windows(word.len()).position(|w| w == word.as_bytes()) {
            replaced.extend_from_slice(&rest[..at]);
            replaced.extend_from_slice(bytes);
            rest = &rest[at + word.len()..];
        }
        replaced.extend_from_slice(rest);
        shift_jis = replaced;
    }
    let options = ImportOptions::default();
    assert_eq!(import_pattern(&shift_jis, None, &options).unwrap().sheet, unicode.sheet);
}

#[test]
fn lines_of_obj_mean_what_their_groups_are_called() {
    let text = "# lines\nv 0 0 0\nv 40 0 0\nv 40 0 -20\nv 0 0 -20\nv 10 0 0\nv 10 0 -20\nv 20 0 0\nv 20 0 -20\n\
                v 30 0 0\nv 30 0 -20\ng Border\nl 1 2 3 4 1\ng layer-mountain\nl 5 6\no x\nusemtl valley folds\nl -4 -3\n\
                usemtl aux\nl 9 10\n";
    assert_eq!(format(text), Some(PatternFileFormat::Obj));
    let imported = read(text);
    check_two_folds(&imported, 1);
    assert!(imported.names.iter().any(|n| n.ids == ["layer-mountain"]));
    assert!(imported.names.iter().any(|n| n.classes == ["valley folds"]));
    let off = refused(text.replace("v 10 0 0", "v 10 1 1").as_bytes());
    assert!(matches!(off, ImportError::Line { .. }), "{off}");
    let none = refused(text.replace("l 5 6", "l 5 99").as_bytes());
    assert!(matches!(none, ImportError::Line { line: 15, .. }), "{none}");
}

#[test]
fn obj_with_creases_in_comments_is_flattened_by_its_texture() {
    // A strip of two squares that Origami Simulator has folded by 90°.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nvt 0 0\nvt .5 0\nvt 1 0\nvt 0 .5\nvt .5 .5\nvt 1 .5\n\
                f 1/1 4/4 5/5\nf 1/1 5/5 2/2\nf 2/2 5/5 6/6\nf 2/2 6/6 3/3\n#e 1 2 0 0\n#e 2 3 0 0\n#e 4 5 0 0\n#e 5 6 0 0\n\
                #e 1 4 0 0\n#e 3 6 0 0\n#e 2 5 2 0\n#e 1 5 1 0\n#e 2 6 1 0\n";
    let imported = read(text);
    let counts = counts(&imported);
    assert_eq!([counts[&'V'], counts[&'F'], counts[&'B']], [1, 2, 6]);
    assert_eq!(imported.sheet.facets.len(), 4);
    // Without them only the faces are known.
    let flat = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    assert_eq!(crate::patterns::counts(&read(flat))[&'U'], 1);
}

fn dxf(header: &str, layers: &str, entities: &str) -> String {
    format!(
        "999\nmade by hand\n0\nSECTION\n2\nHEADER\n{header}0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n{layers}\
         0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    )
}

fn dxf_line(codes: &str, [x1, y1, x2, y2]: [f64; 4]) -> String {
    format!("0\nLINE\n{codes}10\n{x1}\n20\n{y1}\n11\n{x2}\n21\n{y2}\n")
}

const DXF_BORDER: &str = "0\nLWPOLYLINE\n8\nBorder\n90\n4\n70\n1\n10\n0\n20\n0\n10\n40\n20\n0\n10\n40\n20\n20\n10\n0\n20\n20\n";

#[test]
fn entities_of_dxf_mean_what_their_layers_and_colours_say() {
    let layer = |name: &str, colour: i32| format!("0\nLAYER\n2\n{name}\n70\n0\n62\n{colour}\n");
    let layers = layer("RED", 1) + &layer("x", 5) + &layer("off", -1);
    let at = |x: f64| [x, 0.0, x, 20.0];
    for (mountain, valley) in [
        ("8\nMountain folds\n62\n3\n", "8\nvalley\n"),
        ("8\nRED\n", "8\nx\n"),
        ("8\n0\n62\n1\n", "8\n0\n62\n5\n"),
        ("8\n0\n420\n16711680\n", "8\nx\n62\n256\n"),
        ("8\n0\n62\n12\n", "8\n0\n62\n170\n"),
    ] {
        let entities = DXF_BORDER.to_owned()
            + &dxf_line(mountain, at(10.0))
            + &dxf_line(valley, at(20.0))
            + &dxf_line("8\n0\n62\n8\n", at(30.0))
            + &dxf_line("8\noff\n", at(35.0));
        let text = dxf("9\n$INSUNITS\n70\n4\n", &layers, &entities);
        assert_eq!(format(&text), Some(PatternFileFormat::Dxf));
        let imported = read(&text);
        check_two_folds(&imported, 1);
        assert_eq!(imported.unit, LengthUnit::Millimetre);
        assert_eq!(warned(&imported, WarningKind::NotDrawn), 1);
        assert!(imported.sheet.vertices.iter().all(|v| v.y >= 0.0));
    }
    let spline = dxf("", "", &(DXF_BORDER.to_owned() + "0\nSPLINE\n8\nvalley\n"));
    assert!(matches!(refused(spline.as_bytes()), ImportError::Unknown { .. }));
}

#[test]
fn arcs_circles_ellipses_and_bulges_of_dxf_lie_on_their_curves() {
    let round = |p: DVec2| (p - DVec2::new(20.0, 10.0)).length() / 5.0;
    let mirrored = "0\nARC\n8\nvalley\n10\n-20\n20\n10\n40\n5\n50\n0\n51\n360\n230\n-1\n";
    for entity in [
        "0\nCIRCLE\n8\nvalley\n10\n20\n20\n10\n40\n5\n",
        "0\nARC\n8\nvalley\n10\n20\n20\n10\n40\n5\n50\n90\n51\n270\n0\nARC\n8\nvalley\n10\n20\n20\n10\n40\n5\n50\n270\n51\n90\n",
        "0\nELLIPSE\n8\nvalley\n10\n20\n20\n10\n11\n5\n21\n0\n40\n1\n41\n0\n42\n6.283185307179586\n",
        "0\nLWPOLYLINE\n8\nvalley\n70\n1\n10\n15\n20\n10\n42\n1\n10\n25\n20\n10\n42\n1\n",
        "0\nPOLYLINE\n8\nvalley\n66\n1\n70\n1\n0\nVERTEX\n10\n15\n20\n10\n42\n-1\n0\nVERTEX\n10\n25\n20\n10\n42\n-1\n0\nSEQEND\n",
        mirrored,
    ] {
        let imported = read(&dxf("", "", &(DXF_BORDER.to_owned() + entity)));
        assert_eq!(imported.sheet.facets.len(), 2, "{entity}");
        let valleys = imported.sheet.edges.iter().filter(|e| e.assignment == Assignment::Valley);
        let ends: Vec<u32> = valleys.flat_map(|e| e.vertices).collect();
        assert!(ends.len() > 20, "{entity}");
        for v in ends {
            let off = round(imported.sheet.vertices[v as usize]);
            assert!((off - 1.0).abs() < 1e-4, "{entity}: {off}");
        }
    }
}

#[test]
fn the_content_decides_and_an_unknown_one_names_the_formats() {
    let svg = crate::svg::document("", "<rect width=\"9\" height=\"9\" stroke=\"#000\"/>");
    assert_eq!(format(&svg), Some(PatternFileFormat::Svg));
    assert_eq!(format("\n {\"file_spec\": 1.1}"), Some(PatternFileFormat::Fold));
    for text in ["", "[profile]\nmodel = \"shelter\"\n", "<html/>", "one two", "title = 3\n"] {
        assert_eq!(format(text), None, "{text}");
        let error = refused(text.as_bytes());
        assert_eq!(error, ImportError::Format);
        for name in [".fold", "SVG", ".cp", ".opx", ".orh", "OBJ", "DXF"] {
            assert!(error.to_string().contains(name), "{error}");
        }
    }
    // An SVG under the name of another format is an SVG.
    let options = ImportOptions::default();
    assert!(import_pattern(svg.as_bytes(), Some("fold"), &options).is_ok());
    // Text that is nothing is read as its extension says, so that the error is that of the format.
    let error = import_pattern(b"<sgv/>", Some("SVG"), &options).unwrap_err();
    assert!(matches!(error, ImportError::NotSvg { .. }), "{error}");
    let utf16: Vec<u8> = CP.encode_utf16().flat_map(u16::to_le_bytes).collect();
    check_two_folds(&import_pattern(&utf16, None, &options).unwrap(), 1);
}

#[test]
fn every_prefix_of_a_text_file_is_read_or_refused_without_a_panic() {
    let dxf = dxf("", "", DXF_BORDER);
    for text in [CP, dxf.as_str(), &opx(&[[1.0, 0.0, 0.0, 4.0, 4.0]])] {
        for end in 0..text.len() {
            for extension in [None, Some("dxf"), Some("obj"), Some("orh"), Some("opx")] {
                let _ =
                    import_pattern(&text.as_bytes()[..end], extension, &ImportOptions::default());
            }
        }
    }
}
