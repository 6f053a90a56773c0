//! Known patterns, as SVG and as FOLD: counts, angles, Kawasaki, Maekawa.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};
use std::path::Path;

use foldmotion_pattern::{
    Assignment, CreaseKind, Edge, ImportOptions, ImportedPattern, import_fold, import_svg,
};

use crate::crane::crane;
use crate::draw::{Pattern, bird_base, frame, miura, pop_up, square_twist};

pub(crate) fn both(pattern: &Pattern) -> [ImportedPattern; 2] {
    let options = ImportOptions::default();
    [
        import_svg(pattern.svg().as_bytes(), &options).unwrap(),
        import_fold(pattern.fold().to_string().as_bytes(), &options).unwrap(),
    ]
}

/// How many edges have a letter, without those that cut facets into triangles.
pub(crate) fn counts(imported: &ImportedPattern) -> BTreeMap<char, usize> {
    let mut counts = BTreeMap::new();
    let edges = imported.sheet.edges.iter().zip(&imported.edge_sources);
    for (edge, _) in edges.filter(|(_, source)| source.is_some()) {
        *counts.entry(edge.assignment.letter()).or_default() += 1;
    }
    counts
}

/// The guarantees that a sheet gives.
pub(crate) fn check_sheet(imported: &ImportedPattern) {
    let sheet = &imported.sheet;
    assert_eq!(sheet.edges.len(), imported.targets.len());
    assert_eq!(sheet.edges.len(), imported.edge_sources.len());
    assert_eq!(sheet.faces.len(), sheet.face_facets.len());
    let mut sides = BTreeMap::new();
    for (face, &[a, b, c]) in sheet.faces.iter().enumerate() {
        let [p, q, r] = [a, b, c].map(|v| sheet.vertices[v as usize]);
        assert!((q - p).perp_dot(r - p) > 0.0, "triangle {face}");
        for side in [[a, b], [b, c], [c, a]] {
            assert!(sides.insert(side, face as u32).is_none(), "{side:?} twice");
        }
    }
    let mut met = 0;
    for (edge, target) in sheet.edges.iter().zip(&imported.targets) {
        let [a, b] = edge.vertices;
        let faces = [[a, b], [b, a]].map(|side| sides.get(&side).copied());
        assert_eq!(edge.faces, faces);
        met += faces.iter().flatten().count();
        assert_eq!(edge.assignment == Assignment::Border, !edge.is_hinge());
        let kind = match edge.assignment {
            Assignment::Border => CreaseKind::Border,
            Assignment::Facet => CreaseKind::Facet,
            _ => CreaseKind::Imported,
        };
        assert_eq!(edge.kind, kind);
        match edge.assignment {
            Assignment::Mountain => assert!(*target <= 0.0),
            Assignment::Valley => assert!(*target >= 0.0),
            _ => assert_eq!(*target, 0.0),
        }
    }
    assert_eq!(met, 3 * sheet.faces.len());
    assert!(sheet.unit_length > 0.0);
}

/// Around every vertex inside, alternate sectors between creases sum to π (Kawasaki), and mountains and valleys differ
/// by two (Maekawa). Returns how many vertices lie inside.
fn check_flat_foldable(imported: &ImportedPattern) -> usize {
    let sheet = &imported.sheet;
    let mut around = vec![Some(Vec::new()); sheet.vertices.len()];
    for edge in &sheet.edges {
        let [a, b] = edge.vertices;
        for (at, to) in [(a, b), (b, a)] {
            match edge.assignment {
                Assignment::Border => around[at as usize] = None,
                Assignment::Mountain | Assignment::Valley => {
                    if let Some(creases) = &mut around[at as usize] {
                        let way = sheet.vertices[to as usize] - sheet.vertices[at as usize];
                        creases.push((way.to_angle(), edge.assignment));
                    }
                }
                _ => {}
            }
        }
    }
    let mut inside = 0;
    for mut creases in around.into_iter().flatten() {
        inside += 1;
        creases.sort_by(|a, b| a.0.total_cmp(&b.0));
        let n = creases.len();
        let sector = |i: usize| (creases[(i + 1) % n].0 - creases[i].0).rem_euclid(TAU);
        let alternate: f64 = (0..n).step_by(2).map(sector).sum();
        assert!(n.is_multiple_of(2) && (alternate - PI).abs() < 1e-9);
        let mountains = creases.iter().filter(|c| c.1 == Assignment::Mountain).count();
        assert_eq!((2 * mountains).abs_diff(n), 2);
    }
    inside
}

#[test]
fn a_miura_sheet_has_the_counts_of_its_closed_form_and_folds_flat() {
    for (m, n) in [(2, 2), (5, 4), (9, 13)] {
        let pattern = miura(m, n);
        for imported in both(&pattern) {
            check_sheet(&imported);
            assert_eq!(imported.sheet.vertices.len(), (m + 1) * (n + 1));
            assert_eq!(imported.sheet.facets.len(), m * n);
            assert_eq!(imported.sheet.faces.len(), 2 * m * n);
            let counts = counts(&imported);
            for letter in ['B', 'M', 'V'] {
                assert_eq!(counts[&letter], pattern.count(letter));
            }
            assert_eq!(counts[&'B'], 2 * (m + n));
            assert_eq!(imported.euler_characteristic(), 1);
            assert_eq!(check_flat_foldable(&imported), (m - 1) * (n - 1));
            assert!(imported.folds_flat() && imported.warnings.is_empty());
        }
    }
}

#[test]
fn the_bird_base_of_the_crane_imports_and_folds_flat() {
    let pattern = bird_base();
    for imported in both(&pattern) {
        check_sheet(&imported);
        // Centre, middles, corners, 4 on the middle lines, 4 on the diagonals.
        assert_eq!(imported.sheet.vertices.len(), 17);
        // V − E + F = 1 with 8 + 24 creases and 8 border edges, all facets but none with more than 3 corners.
        assert_eq!(imported.sheet.facets.len(), 1 + 40 - 17);
        let counts = counts(&imported);
        assert_eq!((counts[&'B'], counts[&'M'] + counts[&'V']), (8, 32));
        assert_eq!(counts[&'M'], pattern.count('M'));
        assert_eq!(imported.euler_characteristic(), 1);
        assert_eq!(check_flat_foldable(&imported), 9);
    }
}

#[test]
fn a_square_twist_imports_and_folds_flat() {
    for imported in both(&square_twist()) {
        check_sheet(&imported);
        assert_eq!(imported.sheet.vertices.len(), 16);
        assert_eq!(imported.sheet.facets.len(), 9);
        let counts = counts(&imported);
        assert_eq!((counts[&'B'], counts[&'M'], counts[&'V']), (12, 8, 4));
        assert_eq!(check_flat_foldable(&imported), 4);
    }
}

#[test]
fn cuts_open_into_two_borders_and_make_a_hole_each() {
    for imported in both(&pop_up()) {
        check_sheet(&imported);
        // 12 points, of which the middles of the two cuts stand twice.
        assert_eq!(imported.sheet.vertices.len(), 14);
        assert_eq!(imported.sheet.facets.len(), 4);
        let counts = counts(&imported);
        assert_eq!((counts[&'B'], counts[&'M'], counts[&'V']), (6 + 8, 1, 4));
        assert_eq!(imported.euler_characteristic(), 1 - 2);
    }
}

#[test]
fn a_frame_keeps_its_hole() {
    for imported in both(&frame()) {
        check_sheet(&imported);
        assert_eq!(imported.sheet.vertices.len(), 8);
        assert_eq!(imported.sheet.facets.len(), 4);
        assert_eq!(counts(&imported)[&'B'], 8);
        assert_eq!(imported.euler_characteristic(), 0);
        let area: f64 = imported
            .sheet
            .faces
            .iter()
            .map(|f| {
                let [p, q, r] = f.map(|v| imported.sheet.vertices[v as usize]);
                (q - p).perp_dot(r - p) / 2.0
            })
            .sum();
        assert!((area - 32.0).abs() < 1e-12);
    }
}

#[test]
fn both_formats_say_the_same() {
    for pattern in [miura(4, 5), bird_base(), crane(), square_twist(), pop_up(), frame()] {
        let [svg, fold] = both(&pattern);
        assert_eq!(counts(&svg), counts(&fold));
        let lines = |i: &ImportedPattern| -> BTreeSet<([[i64; 2]; 2], char)> {
            let key = |v: u32| (i.sheet.vertices[v as usize] * 1e9).round().as_i64vec2();
            let drawn = i.sheet.edges.iter().zip(&i.edge_sources);
            let drawn = drawn.filter(|(_, source)| source.is_some());
            let line = |edge: &Edge| {
                let mut ends = edge.vertices.map(|v| key(v).to_array());
                ends.sort_unstable();
                (ends, edge.assignment.letter())
            };
            drawn.map(|(edge, _)| line(edge)).collect()
        };
        assert_eq!(lines(&svg), lines(&fold));
        let sum = |i: &ImportedPattern| i.targets.iter().sum::<f64>();
        assert!((sum(&svg) - sum(&fold)).abs() < 1e-9);
        assert!((svg.sheet.unit_length - fold.sheet.unit_length).abs() < 1e-12);
    }
}

#[test]
fn the_fold_percentage_scales_every_target() {
    let [svg, _] = both(&miura(3, 3));
    for fraction in [-1.0, -0.25, 0.0, 0.6, 1.0] {
        let angles = svg.angles_at(fraction).unwrap();
        let scaled = svg.targets.iter().map(|t| t * fraction);
        assert!(angles.into_iter().eq(scaled));
    }
    for fraction in [-1.01, 1.5, f64::NAN, f64::INFINITY] {
        assert!(svg.angles_at(fraction).is_err());
    }
}

#[test]
fn the_stored_examples_are_these_patterns() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/imported");
    for (name, pattern) in [
        ("miura", miura(4, 4)),
        ("bird-base", bird_base()),
        ("crane", crane()),
        ("square-twist", square_twist()),
        ("pop-up", pop_up()),
        ("frame", frame()),
    ] {
        let fold = serde_json::to_string(&pattern.fold()).unwrap() + "\n";
        for (ending, text) in [("svg", pattern.svg()), ("fold", fold)] {
            let path = folder.join(format!("{name}.{ending}"));
            if std::env::var_os("UPDATE_EXAMPLES").is_some() {
                std::fs::write(&path, &text).unwrap();
            }
            let stored = std::fs::read_to_string(&path).unwrap_or_default();
            assert!(
                stored == text,
                "{name}.{ending} is not current: run the tests once with UPDATE_EXAMPLES=1"
            );
        }
    }
}
