//! SVG, DXF and FOLD hold the same lines as the sheet.

use std::collections::BTreeMap;

use foldmotion_pattern::{
    Case, CutError, CutOptions, CutPattern, FoldFile, LineClass, Unit, UnitSheet,
    crease_pattern_fold, pattern_dxf, pattern_svg,
};

use crate::read::{self, ReadLine, expected, layer, sheets, totals};

/// What 1e-9 mm of rounding amounts to over all lines of a sheet.
const SUM: f64 = 1e-6;

fn every_edge(scale: f64) -> CutOptions {
    CutOptions { keeps_segments: true, draws_facets: true, margin: 12.5, ..CutOptions::new(scale) }
}

/// The lines of one layer, each from its lower end, sorted, to 1e-6.
fn sorted(lines: &[ReadLine], height: Option<f64>) -> Vec<(String, [[i64; 2]; 2])> {
    let mut all: Vec<_> = lines
        .iter()
        .map(|line| {
            let turned = |[x, y]: [f64; 2]| [x, height.map_or(y, |height| height - y)];
            let whole = |p: [f64; 2]| turned(p).map(|c| (c * 1e6).round() as i64);
            let mut ends = line.ends.map(whole);
            ends.sort_unstable();
            (line.layer.clone(), ends)
        })
        .collect();
    all.sort_unstable();
    all
}

#[test]
fn svg_and_dxf_hold_every_edge_of_the_sheet_once_at_its_length() {
    for units in sheets() {
        let options = every_edge(1000.0);
        let (_, svg) = read::svg(&pattern_svg(&units, &options).unwrap());
        let dxf = read::dxf(&pattern_dxf(&units, &options).unwrap());
        let wanted = expected(&units, 1000.0);
        for found in [totals(&svg), totals(&dxf)] {
            assert_eq!(found.len(), wanted.len());
            for (layer, (count, length)) in &wanted {
                assert_eq!(found[layer].0, *count, "{layer}");
                assert!((found[layer].1 - length).abs() < SUM, "{layer}");
            }
        }
        let height = 5.0 * units.unit.width * 1000.0 + 25.0;
        assert_eq!(sorted(&svg, None), sorted(&dxf, Some(height)));
        // Edge by edge, by the places the sheet gives them: a half turn, no mirror image.
        let place = |v: u32| {
            let p = units.sheet.vertices[v as usize] * 1000.0;
            [12.5 - p.x, 12.5 + p.y]
        };
        let edges: Vec<ReadLine> = units
            .sheet
            .edges
            .iter()
            .map(|edge| ReadLine {
                layer: layer(edge.assignment).to_owned(),
                ends: edge.vertices.map(place),
                words: BTreeMap::new(),
            })
            .collect();
        assert_eq!(sorted(&svg, None), sorted(&edges, None));
    }
}

#[test]
fn joined_lines_are_fewer_and_as_long_and_none_continues_another() {
    for units in sheets() {
        let (_, lines) = read::svg(&pattern_svg(&units, &CutOptions::new(1000.0)).unwrap());
        let (found, wanted) = (totals(&lines), expected(&units, 1000.0));
        assert!(!found.contains_key("facet"));
        for layer in ["mountain", "valley", "cut"] {
            assert!((found[layer].1 - wanted[layer].1).abs() < SUM, "{layer}");
            assert!(found[layer].0 <= wanted[layer].0, "{layer}");
        }
        assert_eq!(found["cut"].0, 4);
        assert!(found["mountain"].0 < wanted["mountain"].0);
        if units.unit.case == Case::E {
            // 6 row boundaries, 4 corner lines and 5 mid lines from side to side.
            assert_eq!(found["mountain"].0, 6 + 4 + 5);
        }
        let whole = |p: [f64; 2]| p.map(|c| (c * 1e6).round() as i64);
        let away = |line: &ReadLine, end: usize| {
            let [from, to] = [line.ends[end], line.ends[1 - end]];
            [0, 1].map(|i| (to[i] - from[i]) / line.length())
        };
        for (i, a) in lines.iter().enumerate() {
            for b in &lines[i + 1..] {
                let same = a.layer == b.layer
                    && a.words.get("stroke-opacity") == b.words.get("stroke-opacity");
                for (m, n) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    if !same || whole(a.ends[m]) != whole(b.ends[n]) {
                        continue;
                    }
                    let ([x, y], [u, v]) = (away(a, m), away(b, n));
                    assert!(x * u + y * v > -1.0 + 1e-9, "{a:?} {b:?}");
                }
            }
        }
    }
}

#[test]
fn colours_and_opacities_are_those_origami_simulator_reads() {
    for units in sheets() {
        let (_, lines) = read::svg(&pattern_svg(&units, &every_edge(1000.0)).unwrap());
        let mut angles: BTreeMap<String, f64> = BTreeMap::new();
        for line in &lines {
            let colour = match line.layer.as_str() {
                "mountain" => "#f00",
                "valley" => "#00f",
                "facet" => "#ff0",
                _ => "#000",
            };
            assert_eq!(line.words["stroke"], colour);
            let is_crease = matches!(line.layer.as_str(), "mountain" | "valley");
            assert_eq!(line.words.contains_key("stroke-opacity"), is_crease);
            assert_eq!(line.words.contains_key("stroke-dasharray"), is_crease);
            if is_crease {
                let opacity: f64 = line.words["stroke-opacity"].parse().unwrap();
                *angles.entry(format!("{} {}", line.layer, 180.0 * opacity)).or_default() +=
                    line.length();
            }
        }
        let mut wanted: BTreeMap<String, f64> = BTreeMap::new();
        for (edge, angle) in units.sheet.edges.iter().zip(units.compact_angles()) {
            if edge.is_crease() {
                let [a, b] = edge.vertices.map(|v| units.sheet.vertices[v as usize]);
                let name = format!("{} {}", layer(edge.assignment), angle.abs().to_degrees());
                *wanted.entry(name).or_default() += a.distance(b) * 1000.0;
            }
        }
        assert!(angles.keys().eq(wanted.keys()), "{angles:?} {wanted:?}");
        assert!(angles.values().zip(wanted.values()).all(|(a, w)| (a - w).abs() < SUM));
    }
}

#[test]
fn the_page_is_as_large_as_the_sheet_in_its_unit_and_its_margins() {
    let units = UnitSheet::new(Unit::new(Case::T, 0.5, 2.0, None, None).unwrap(), 3, 4).unwrap();
    for (scale, size) in [(1000.0, [6000.0, 2000.0]), (25.4, [152.4, 50.8]), (0.75, [4.5, 1.5])] {
        let options = CutOptions { margin: 5.0, ..CutOptions::new(scale) };
        let (root, _) = read::svg(&pattern_svg(&units, &options).unwrap());
        let [width, height] = size.map(|side| side + 10.0);
        assert_eq!(root["width"], format!("{width}mm"));
        assert_eq!(root["height"], format!("{height}mm"));
        assert_eq!(root["viewBox"], format!("0 0 {width} {height}"));
        let dxf = read::pairs(&pattern_dxf(&units, &options).unwrap());
        let after = |name: &str| dxf.iter().position(|(_, value)| value == name).unwrap() + 1;
        assert_eq!(dxf[after("$INSUNITS")], (70, "4".to_owned()));
        assert_eq!(dxf[after("$EXTMAX")], (10, width.to_string()));
        assert_eq!(dxf[after("$EXTMAX") + 1], (20, height.to_string()));
    }
}

#[test]
fn creases_come_before_the_outline_and_the_outline_is_one_way_round() {
    for units in sheets() {
        let text = pattern_dxf(&units, &CutOptions::new(1000.0)).unwrap();
        let lines = read::dxf(&text);
        let rank = |l: &ReadLine| ["mountain", "valley", "cut"].iter().position(|n| *n == l.layer);
        assert!(lines.is_sorted_by_key(|l| rank(l).unwrap()));
        let cut = &lines[lines.len() - 4..];
        for side in 0..4 {
            assert_eq!(cut[side].ends[1], cut[(side + 1) % 4].ends[0]);
        }
    }
}

#[test]
fn the_pen_travels_less_than_in_the_order_of_the_sheet() {
    for units in sheets() {
        let options = every_edge(1000.0);
        let pattern = CutPattern::new(&units.sheet, units.compact_angles(), &options).unwrap();
        let mut pen = glam::DVec2::ZERO;
        let mut unsorted = 0.0;
        let by_class = LineClass::ALL.into_iter().flat_map(|class| {
            let edges = units.sheet.edges.iter();
            edges.filter(move |e| LineClass::of(e.assignment) == class)
        });
        for edge in by_class {
            let [a, b] = edge.vertices.map(|v| units.sheet.vertices[v as usize] * 1000.0);
            unsorted += pen.distance(a);
            pen = b;
        }
        assert!(pattern.travel() < 0.75 * unsorted, "{} {unsorted}", pattern.travel());
    }
}

#[test]
fn dxf_layers_have_colour_and_a_linetype_with_the_dashes_asked_for() {
    let options = CutOptions {
        mountain_dashes: Some(vec![6.0, 2.0, 1.0, 2.0]),
        valley_dashes: Some(Vec::new()),
        ..CutOptions::new(1000.0)
    };
    let pairs = read::pairs(&pattern_dxf(&sheets()[2], &options).unwrap());
    let record = |kind: &str, name: &str| {
        let start = pairs
            .windows(2)
            .position(|w| w[0] == (0, kind.to_owned()) && w[1] == (2, name.to_owned()))
            .unwrap();
        let rest = pairs[start + 1..].iter();
        rest.take_while(|(code, _)| *code != 0).cloned().collect::<Vec<_>>()
    };
    let has = |record: &[(u16, String)], code: u16, value: &str| {
        record.contains(&(code, value.to_owned()))
    };
    for (name, colour, linetype) in
        [("MOUNTAIN", "1", "DASHDOT"), ("VALLEY", "5", "DASHED"), ("CUT", "7", "CONTINUOUS")]
    {
        let layer = record("LAYER", name);
        assert!(has(&layer, 62, colour) && has(&layer, 6, linetype), "{layer:?}");
    }
    let dashes: Vec<_> = record("LTYPE", "DASHDOT").into_iter().filter(|(c, _)| *c == 49).collect();
    assert_eq!(dashes.iter().map(|(_, v)| v.as_str()).collect::<Vec<_>>(), ["6", "-2", "1", "-2"]);
    assert!(has(&record("LTYPE", "DASHED"), 73, "0"));
    let svg = pattern_svg(&sheets()[2], &options).unwrap();
    let (_, lines) = read::svg(&svg);
    for line in lines {
        let dashes = line.words.get("stroke-dasharray").map(String::as_str);
        assert_eq!(dashes, (line.layer == "mountain").then_some("6 2 1 2"));
    }
}

#[test]
fn the_fold_file_reads_back_as_the_sheet_in_millimetres() {
    for units in sheets() {
        for draws_facets in [false, true] {
            let options = CutOptions { draws_facets, ..CutOptions::new(1000.0) };
            let angles = units.compact_angles();
            let text = crease_pattern_fold(&units.sheet, angles, &options, "test").unwrap();
            let file = FoldFile::read(text.as_bytes()).unwrap();
            let same = |(a, b): (&glam::DVec2, &glam::DVec2)| *a == *b * 1000.0;
            assert!(file.sheet.vertices.iter().zip(&units.sheet.vertices).all(same));
            let edges = |sheet: &foldmotion_pattern::Sheet| -> BTreeMap<[u32; 2], char> {
                let edge = |e: &foldmotion_pattern::Edge| {
                    let [a, b] = e.vertices;
                    ([a.min(b), a.max(b)], e.assignment.letter())
                };
                sheet.edges.iter().map(edge).collect()
            };
            // Facets with equal diagonals may be split by the other one.
            let mut found = edges(&file.sheet);
            let mut wanted = edges(&units.sheet);
            let has_quads = wanted.values().any(|&letter| letter == 'F');
            if !draws_facets {
                found.retain(|_, letter| *letter != 'F');
                wanted.retain(|_, letter| *letter != 'F');
            }
            assert!(found == wanted, "{:?}", units.unit.case);
            let value: serde_json::Value = serde_json::from_str(&text).unwrap();
            assert_eq!(value["frame_unit"], "mm");
            let drawn = value["edges_assignment"].as_array().unwrap();
            assert_eq!(drawn.iter().any(|a| a == "F"), draws_facets && has_quads);
            let kept = units.sheet.edges.iter().zip(angles);
            let kept = kept.filter(|(e, _)| draws_facets || e.assignment.letter() != 'F');
            for ((edge, angle), read) in kept.zip(value["edges_foldAngle"].as_array().unwrap()) {
                assert_eq!(read.as_f64(), edge.is_hinge().then(|| angle.to_degrees()));
            }
        }
    }
}

#[test]
fn titles_cannot_break_the_files() {
    let options = CutOptions {
        title: "a<b>&\"\n0\nEOF\n".to_owned(),
        note: "</desc>\u{1}".to_owned(),
        ..CutOptions::new(1000.0)
    };
    let units = &sheets()[0];
    let plain = CutOptions::new(1000.0);
    let (_, lines) = read::svg(&pattern_svg(units, &options).unwrap());
    assert_eq!(lines, read::svg(&pattern_svg(units, &plain).unwrap()).1);
    let dxf = pattern_dxf(units, &options).unwrap();
    assert_eq!(read::dxf(&dxf), read::dxf(&pattern_dxf(units, &plain).unwrap()));
}

#[test]
fn sizes_and_options_out_of_range_are_refused() {
    let units = &sheets()[0];
    let refused = |options: &CutOptions| pattern_svg(units, options).unwrap_err();
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(&CutOptions::new(scale));
        assert!(matches!(error, CutError::NotPositive { .. }), "{error}");
    }
    for scale in [1e-9, 0.5, 1e8, 1e300] {
        let error = refused(&CutOptions::new(scale));
        assert!(matches!(error, CutError::Size { .. }), "{error}");
    }
    let good = CutOptions::new(1000.0);
    for margin in [-1.0, f64::NAN, f64::INFINITY] {
        let error = refused(&CutOptions { margin, ..good.clone() });
        assert!(matches!(error, CutError::Negative { .. }), "{error}");
    }
    for dashes in [vec![1.0], vec![1.0, 0.0], vec![1.0, -1.0], vec![f64::NAN; 2], vec![1.0; 14]] {
        let valley_dashes = Some(dashes);
        let error = refused(&CutOptions { valley_dashes, ..good.clone() });
        let is_valley = matches!(error, CutError::Dashes { class: LineClass::Valley, .. });
        assert!(is_valley, "{error}");
    }
    let stroke_width = Some(0.0);
    let error = refused(&CutOptions { stroke_width, ..good });
    assert!(matches!(error, CutError::NotPositive { .. }), "{error}");
}
