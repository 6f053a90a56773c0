//! SVG that cannot be read: each fault with its error, by element; hostile files within bounds.

use std::fmt::Write as _;

use foldmotion_pattern::{
    ImportError, ImportOptions, LARGEST_IMPORT_FILE, MOST_LINES, MOST_NESTED, UnknownElements,
    import_svg,
};

use crate::svg::document;

fn error(text: &str) -> ImportError {
    let options = ImportOptions { unknown: UnknownElements::Ignore, ..ImportOptions::default() };
    import_svg(text.as_bytes(), &options).unwrap_err()
}

const SQUARE: &str = "<rect width=\"10\" height=\"10\" stroke=\"black\"/>";

#[test]
fn files_that_are_no_svg_are_refused() {
    let options = ImportOptions::default();
    let not_utf8 = import_svg(b"<svg>\xff</svg>", &options).unwrap_err();
    assert_eq!(not_utf8, ImportError::NotUtf8 { byte: 5 });
    for text in ["", "plain", "<svg>", "<svg/><svg/>", "{\"file_spec\": 1}", "<svg><g></svg>"] {
        assert!(matches!(error(text), ImportError::Xml { .. }), "{text}");
    }
    assert!(matches!(error("<html/>"), ImportError::NotSvg { .. }));
    let large = vec![b' '; LARGEST_IMPORT_FILE + 1];
    let too_large = import_svg(&large, &options).unwrap_err();
    assert!(matches!(too_large, ImportError::TooLarge { .. }));
}

#[test]
fn entity_bombs_are_refused() {
    let with = |entities: &str, body: &str| {
        error(&format!("<!DOCTYPE svg [{entities}]>{}", document("", body)))
    };
    let nested = "<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;\">";
    let long = format!("<!ENTITY a \"{}\">", "M0 0".repeat(2_000));
    let many = "<!ENTITY a \"b\">".repeat(300);
    let wide = format!("<!ENTITY a \"{}\">", "M0 0".repeat(1_000));
    for (entities, body) in [
        (nested, "<path d=\"&b;\"/>".to_owned()),
        (&long, "<path d=\"&a;\"/>".to_owned()),
        (&many, "<path d=\"&a;\"/>".to_owned()),
        (&wide, format!("<path d=\"{}\"/>", "&a;".repeat(10_000))),
    ] {
        let refused = with(entities, &body);
        assert!(matches!(refused, ImportError::Entities { .. }), "{refused}");
    }
    let unknown = with("<!ENTITY a SYSTEM \"/etc/passwd\">", "<path d=\"&a;\"/>");
    assert!(matches!(unknown, ImportError::Xml { .. }), "{unknown}");
}

#[test]
fn uses_that_grow_without_bound_are_refused() {
    let own = document("", "<g id=\"a\"><use href=\"#a\"/></g>");
    assert!(matches!(error(&own), ImportError::Attribute { name: "href", .. }));
    let each_other = "<defs><g id=\"a\"><use href=\"#b\"/></g><g id=\"b\"><use href=\"#a\"/></g></defs>\
                      <use href=\"#a\"/>";
    let refused = error(&document("", each_other));
    assert!(matches!(refused, ImportError::Attribute { name: "href", .. }), "{refused}");
    let mut laughs = "<g id=\"l0\"><path d=\"M0 0H1\" stroke=\"red\"/></g>".to_owned();
    for level in 1..10 {
        let used = format!("<use href=\"#l{}\"/>", level - 1).repeat(10);
        let _ = write!(laughs, "<g id=\"l{level}\">{used}</g>");
    }
    let refused = error(&document("", &format!("<defs>{laughs}</defs><use href=\"#l9\"/>")));
    assert!(matches!(refused, ImportError::TooMany { .. }), "{refused}");
}

#[test]
fn a_document_type_without_entities_is_no_harm() {
    let drawing = document("", "<rect width=\"4\" height=\"4\" stroke=\"#000\"/>");
    let doctype = "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">";
    let typed = import_svg(format!("{doctype}{drawing}").as_bytes(), &ImportOptions::default());
    assert_eq!(typed.unwrap().sheet.facets.len(), 1);
}

#[test]
fn nothing_drawn_and_nothing_bounded_are_distinguished() {
    assert_eq!(error(&document("", "")), ImportError::Empty);
    let unfilled = "<rect width=\"4\" height=\"4\" fill=\"none\"/>";
    assert_eq!(error(&document("", unfilled)), ImportError::Empty);
    let open = document("", "<path d=\"M0 0H10V10\" stroke=\"black\"/>");
    assert_eq!(error(&open), ImportError::NoFaces);
    let point = document("", "<path d=\"M3 3L3 3\" stroke=\"black\"/>");
    assert!(matches!(error(&point), ImportError::Extent { .. }));
}

#[test]
fn values_that_cannot_be_read_are_named_with_their_element() {
    for (attributes, body, name) in [
        ("", "<path id=\"x\" d=\"M0 0L1\" stroke=\"red\"/>", "d"),
        ("", "<path id=\"x\" d=\"M0 0 L NaN 3\" stroke=\"red\"/>", "d"),
        ("", "<path id=\"x\" d=\"M0 0L1e999 3\" stroke=\"red\"/>", "d"),
        ("", "<path id=\"x\" d=\"L3 4\" stroke=\"red\"/>", "d"),
        ("", "<polygon id=\"x\" points=\"0 0 1\" stroke=\"red\"/>", "points"),
        ("", "<polyline id=\"x\" points=\"0 0 1 inf\" stroke=\"red\"/>", "points"),
        ("", "<rect id=\"x\" width=\"-4\" height=\"3\" stroke=\"red\"/>", "width"),
        ("", "<rect id=\"x\" width=\"5%\" height=\"3\" stroke=\"red\"/>", "width"),
        ("", "<line id=\"x\" x1=\"1e400\" stroke=\"red\"/>", "x1"),
        ("", "<line id=\"x\" x2=\"two\" stroke=\"red\"/>", "x2"),
        ("", "<path id=\"x\" transform=\"spin(3)\" d=\"M0 0H1\" stroke=\"red\"/>", "transform"),
        (
            "",
            "<path id=\"x\" transform=\"scale(1e999)\" d=\"M0 0H1\" stroke=\"red\"/>",
            "transform",
        ),
        ("", "<path id=\"x\" opacity=\"half\" d=\"M0 0H1\" stroke=\"red\"/>", "opacity"),
        (
            "",
            "<path id=\"x\" style=\"stroke-opacity:nan\" d=\"M0 0H1\" stroke=\"red\"/>",
            "stroke-opacity",
        ),
        ("id=\"x\" width=\"-5mm\"", SQUARE, "width"),
        ("id=\"x\" height=\"0\"", SQUARE, "height"),
        ("id=\"x\" viewBox=\"0 0 0 4\"", SQUARE, "viewBox"),
        ("id=\"x\" viewBox=\"0 0 4\"", SQUARE, "viewBox"),
        (
            "id=\"x\" viewBox=\"0 0 4 4\" width=\"3mm\" preserveAspectRatio=\"fit\"",
            SQUARE,
            "preserveAspectRatio",
        ),
    ] {
        let refused = error(&document(attributes, body));
        let ImportError::Attribute { name: found, .. } = &refused else {
            panic!("{body}: {refused}")
        };
        assert_eq!(*found, name, "{body}");
        assert!(refused.to_string().contains("\"x\"> (line "), "{refused}");
    }
}

#[test]
fn deep_and_large_files_end_in_an_error() {
    let deep = |n: usize| {
        let body = format!("{}{SQUARE}{}", "<g>".repeat(n), "</g>".repeat(n));
        import_svg(document("", &body).as_bytes(), &ImportOptions::default())
    };
    assert!(deep(MOST_NESTED - 1).is_ok());
    for n in [MOST_NESTED + 1, 100_000] {
        assert!(matches!(deep(n), Err(ImportError::TooMany { .. } | ImportError::Xml { .. })));
    }
    let many = format!("<path d=\"M0 0{}\" stroke=\"red\"/>", "h1v1".repeat(MOST_LINES / 2 + 1));
    assert!(matches!(error(&document("", &many)), ImportError::TooMany { what: "lines", .. }));
    let nodes = "<a/>".repeat(300_000);
    assert!(matches!(error(&document("", &nodes)), ImportError::Xml { .. }));
    let rules = format!("<style>{}</style>", ".a{stroke:red}".repeat(500));
    assert!(matches!(error(&document("", &rules)), ImportError::TooMany { .. }));
    let lists = format!("<style>{}b{{{}}}</style>", ".a,".repeat(900), "x:y;".repeat(5_000));
    assert!(matches!(error(&document("", &lists)), ImportError::TooMany { .. }));
}

#[test]
fn a_tangle_with_too_many_crossings_is_refused_before_it_is_made() {
    let mut body = SQUARE.to_owned();
    for k in 0..700 {
        let at = 10.0 * f64::from(k) / 700.0;
        let _ = write!(body, "<path d=\"M{at} 0V10M0 {at}H10\" stroke=\"red\"/>");
    }
    let refused = error(&document("", &body));
    assert!(matches!(refused, ImportError::TooMany { .. }), "{refused}");
}

#[test]
fn sizes_beyond_reckoning_are_refused() {
    for scale in ["1e-40", "1e35", "1e308"] {
        let overflows = scale == "1e308";
        let body = format!("<g transform=\"scale({scale})\">{SQUARE}</g>");
        let refused = error(&document("", &body));
        let is_named = match &refused {
            ImportError::Extent { .. } => !overflows,
            ImportError::Attribute { value, .. } => overflows && value.contains(scale),
            _ => false,
        };
        assert!(is_named, "{refused}");
    }
    let far = format!("<g transform=\"translate(1e12 0)\">{SQUARE}</g>");
    assert!(matches!(error(&document("", &far)), ImportError::Extent { .. }));
}

#[test]
fn every_prefix_of_a_file_is_read_or_refused_without_a_panic() {
    let text = crate::draw::pop_up().svg();
    for end in 0..text.len() {
        let _ = import_svg(&text.as_bytes()[..end], &ImportOptions::default());
    }
}
