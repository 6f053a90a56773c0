//! What a page may do, what it shows, and what is refused.

use super::*;

/// The names of all tags, as a browser meets them; of scripts and styles only their ends.
fn tags(html: &str) -> Vec<&str> {
    let (mut tags, mut rest) = (Vec::new(), html);
    while let Some(start) = rest.find('<') {
        rest = &rest[start + 1..];
        let end = rest.find([' ', '>', '\n']).unwrap();
        let name = &rest[..end];
        tags.push(name);
        if ["script", "style"].contains(&name) {
            rest = &rest[rest.find(&format!("</{name}")).unwrap()..];
        }
    }
    tags
}

fn told(words: &str) -> (PageOptions, Vec<Values>, String, String) {
    let options = PageOptions {
        provenance: Provenance {
            title: words.to_owned(),
            producer: words.to_owned(),
            scene: words.to_owned(),
            hash: words.to_owned(),
        },
        ..PageOptions::default()
    };
    let values =
        vec![Values { title: words.to_owned(), range: [0.0, 1.0], frames: vec![vec![0.0; 2]; 2] }];
    let report = serde_json::json!({
        "case": words, "rows": 7, "columns": 3, "length_unit": words,
        "closed_form": {"extents": [1.0, 2.0, 3.0], "area": words, "volume": 6.0},
        "stages": [{"name": words, "peak_strain": 0.1, "converged": true}],
        "profile": {"source": words}, "unfold": {"method": words},
        "pattern": {"vertices": [{"type": words, "degree": 4}]},
        "jam": {"t": words},
    });
    let certificate = serde_json::json!({
        "verdict": words, "sha256": words, "assumptions": [words],
        "penetrations": [{"t": 0.5, "kind": words, "pair": {"faces": [1, 2]}, "depth": 1e-3}],
    });
    (options, values, report.to_string(), certificate.to_string())
}

#[test]
fn no_words_become_tags_scripts_or_attributes() {
    let motion = folding_square(&[0.0, 1.0]);
    let marks = Marks::default();
    let panels = [Panel {
        title: "a < b",
        is_logarithmic: false,
        curves: vec![Curve { name: "c", points: vec![(0.0, 1.0), (1.0, 2.0)] }],
    }];
    let html = |words: &str| {
        let (options, values, report, certificate) = told(words);
        let contents = Page {
            values: &values,
            panels: &panels,
            report: Some(&report),
            certificate: Some(&certificate),
            ..bare(&motion, &marks)
        };
        written(&contents, &options)
    };
    let plain = "a title that is harmless, and longer than a line of facts";
    let hostile =
        "</script></title><b onclick=\"x\">'\"><!-- {{script}} </style> &lt; longer than a line";
    let (expected, found) = (html(plain), html(hostile));
    assert_eq!(tags(&expected), tags(&found));
    assert!(tags(&expected).len() > 100);
    assert!(!found.contains("<b onclick"), "{hostile}");
    // What is embedded reads back as it was.
    let provenance: Value = serde_json::from_str(block(&found, "provenance")).unwrap();
    for key in ["title", "producer", "scene", "hash"] {
        assert_eq!(provenance[key], hostile);
    }
    assert_eq!(read(&found).0["values"][0]["title"], hostile);
    let ascii = format!("</title>{plain}");
    assert_ne!(
        tags(&found.replacen("<title>", &format!("<title>{ascii}"), 1)),
        tags(&expected),
        "a tag more is seen"
    );
}

#[test]
fn a_page_may_run_its_own_two_scripts_only_and_fetch_nothing() {
    let motion = tower();
    let html = written(&bare(&motion, &Marks::default()), &PageOptions::default());
    let policy = html.split("Policy\" content=\"").nth(1).unwrap();
    let policy = &policy[..policy.find('"').unwrap()];
    assert!(policy.starts_with("default-src 'none'; img-src data:;"));
    assert!(!policy.contains("unsafe"));
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    let scripts: Vec<&str> = html.split("<script>").skip(1).collect();
    assert_eq!(scripts.len(), 2);
    for script in scripts {
        let script = &script[..script.find("</script>").unwrap()];
        assert!(policy.contains(&hash(script)));
    }
    for scheme in ["http://", "https://", "//cdn", "src=\"/", "@import", "import("] {
        for place in html.match_indices(scheme) {
            let address: String = html[place.0..].chars().take(40).collect();
            assert!(address.starts_with("http://www.w3.org/1999/"), "{address}");
        }
    }
    assert!(html.contains("Permission is hereby granted"), "the library's licence");
}

#[test]
fn the_same_page_has_the_same_bytes_and_shows_no_time_and_no_device() {
    let motion = tower();
    let marks = Marks::default();
    let report = |seconds: f64, device: &str| {
        serde_json::json!({
            "rows": 3, "columns": 2, "case": "SII",
            "division": {"method": "equal-length", "max_residual": 1e-15, "seconds": seconds},
            "engine": {"name": "quasi-static", "seconds": seconds, "device": device, "threads": seconds,
                "instruction_set": device},
            "seconds": {"total": seconds},
            "collision": {"verdict": "free", "min_separation": 1e-3, "min_separation_t": 2.0},
        })
        .to_string()
    };
    let html = |report: &str| {
        let contents = Page { report: Some(report), ..bare(&motion, &marks) };
        written(&contents, &PageOptions::default())
    };
    let first = html(&report(12.5, "a fast card"));
    assert_eq!(first, html(&report(99.25, "a slow one")));
    assert!(first.contains("free</strong>") && first.contains("0.001 h at t = 2"));
}

#[test]
fn marks_are_listed_by_triangle_and_span_within_the_motion() {
    let motion = folding_square(&[0.0, 1.0]);
    let mut marks = Marks::default();
    marks.insert(1, 0.25, 0.5);
    marks.insert(0, -7.0, f64::INFINITY);
    for (face, from, to) in [(9, 0.0, 1.0), (0, 1.5, 2.0), (0, 0.7, 0.6), (0, f64::NAN, 1.0)] {
        marks.insert(face, from, to);
    }
    let (header, _) = read(&written(&bare(&motion, &marks), &PageOptions::default()));
    assert_eq!(header["marks"], serde_json::json!([[0.25, 0.5, 1], [0.0, 1.0, 0]]));
}

#[test]
fn what_cannot_be_shown_is_refused_before_anything_is_written() {
    let motion = folding_square(&[0.0, 1.0]);
    let marks = Marks::default();
    let good = bare(&motion, &marks);
    let refused = |contents: &Page<'_>, options: &PageOptions| {
        let mut bytes = Vec::new();
        let error = page(contents, options, &mut bytes).unwrap_err();
        assert!(bytes.is_empty(), "{error}");
        error
    };
    let usual = PageOptions::default();
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = PageOptions { tolerance, ..usual.clone() };
        assert!(matches!(refused(&good, &options), RecordError::NotPositive { .. }));
    }
    let options = PageOptions { seconds: [1.0, 0.0], ..usual.clone() };
    assert!(matches!(
        refused(&good, &options),
        RecordError::NotPositive { name: "seconds[1]", .. }
    ));
    for words in ["", "{", "\u{0}"] {
        let contents = Page { report: Some(words), ..good };
        assert!(matches!(refused(&contents, &usual), RecordError::Json { name: "report", .. }));
        let contents = Page { certificate: Some(words), ..good };
        assert!(matches!(
            refused(&contents, &usual),
            RecordError::Json { name: "certificate", .. }
        ));
    }
    let values = [Values { title: String::new(), range: [0.0, 1.0], frames: vec![vec![0.0; 2]] }];
    let contents = Page { values: &values, ..good };
    assert!(matches!(refused(&contents, &usual), RecordError::ValueCount { frame: 1, .. }));
    let large = vec![0; (1 << 28) + 1];
    let contents = Page { fold: Some(&large), ..good };
    assert!(matches!(refused(&contents, &usual), RecordError::FileSize { format: "HTML", .. }));
    let still = Motion {
        frames: Vec::new(),
        compact_order: LayerOrder::default(),
        sheet: motion.sheet.clone(),
    };
    assert!(matches!(refused(&bare(&still, &marks), &usual), RecordError::NoFrames));
}

#[test]
fn reports_and_certificates_of_other_shapes_are_shown_as_far_as_they_go() {
    let motion = folding_square(&[0.0]);
    let marks = Marks::default();
    for words in [
        "null",
        "[]",
        "7",
        "{\"rows\": {}, \"stages\": 3, \"closed_form\": []}",
        "{\"pair\": {\"faces\": []}, \"penetrations\": [1, null]}",
    ] {
        let contents =
            Page { report: Some(words), certificate: Some(words), ..bare(&motion, &marks) };
        let html = written(&contents, &PageOptions::default());
        assert!(html.ends_with("</html>\n"));
    }
}
