//! Near misses: the tolerance chosen from a drawing, and what is said about creases that are left out.

use foldmotion_pattern::{
    ImportOptions, ImportedPattern, MergeTolerance, WarningKind, import_fold, import_svg,
};
use serde_json::json;

use crate::draw::{Crease, Pattern, bird_base, miura, square_twist};
use crate::patterns::{check_sheet, counts};

fn import(pattern: &Pattern) -> ImportedPattern {
    let imported = import_svg(pattern.svg().as_bytes(), &ImportOptions::default()).unwrap();
    check_sheet(&imported);
    imported
}

/// The pattern with the ends of its creases moved at random, no farther than `miss` along each axis.
fn missed(pattern: &Pattern, miss: f64, seed: u64) -> Pattern {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut moved = |p: [f64; 2]| p.map(|x| x + miss * (2.0 * random.f64() - 1.0));
    let crease = |&(a, b, letter): &Crease| match letter {
        'B' => (a, b, letter),
        _ => (moved(a), moved(b), letter),
    };
    Pattern { creases: pattern.creases.iter().map(crease).collect() }
}

/// Six creases of a waterbomb base in a square of 200, whose ends miss the centre by 0.1 to 0.3.
fn centre_missed() -> Pattern {
    let mut pattern = Pattern::default();
    let corners = [[0.0, 0.0], [200.0, 0.0], [200.0, 200.0], [0.0, 200.0], [0.0, 0.0]];
    pattern.add('B', &corners);
    let ends = [
        ([100.2, 100.1], [200.0, 200.0], 'V'),
        ([99.8, 100.1], [0.0, 200.0], 'V'),
        ([99.9, 99.9], [0.0, 0.0], 'V'),
        ([100.1, 99.8], [200.0, 0.0], 'V'),
        ([100.0, 100.3], [100.0, 200.0], 'M'),
        ([99.9, 99.8], [100.0, 0.0], 'M'),
    ];
    pattern.creases.extend(ends);
    pattern
}

#[test]
fn creases_that_miss_each_other_a_little_meet() {
    let imported = import(&centre_missed());
    assert_eq!((counts(&imported)[&'V'], counts(&imported)[&'M']), (4, 2));
    assert_eq!((imported.sheet.facets.len(), imported.sheet.vertices.len()), (6, 7));
    let mending = &imported.mending;
    assert!(mending.chosen && mending.tolerance > 0.3 && mending.tolerance < 2.0, "{mending:?}");
    assert_eq!((mending.merged, mending.dropped), (5, 0));
    // With a tolerance below the misses creases are lost, and it is said which.
    let options =
        ImportOptions { merge: Some(MergeTolerance::Absolute(0.01)), ..ImportOptions::default() };
    let mut wide = centre_missed();
    wide.add('M', &[[0.0, 40.0], [200.0, 40.0]]);
    wide.add('M', &[[0.0, 160.0], [200.0, 160.0]]);
    wide.add('V', &[[0.0, 170.0], [200.0, 170.0]]);
    wide.add('V', &[[0.0, 180.0], [200.0, 180.0]]);
    let lost = import_svg(wide.svg().as_bytes(), &options).unwrap().mending;
    assert!(!lost.chosen && lost.dropped > 0 && lost.dropped_length > 50.0, "{lost:?}");
    assert_eq!(lost.dropped_creases.len(), lost.dropped);
    let named: f64 = lost.dropped_creases.iter().map(|crease| crease.length).sum();
    assert!((named - lost.dropped_length).abs() < 1e-9);
    let within = |crease: &foldmotion_pattern::DroppedCrease| {
        crease.middle.distance(glam::DVec2::new(100.0, 100.0)) < 100.0
    };
    assert!(lost.dropped_creases.iter().all(within), "{lost:?}");
}

#[test]
fn known_patterns_drawn_carelessly_keep_their_counts() {
    for (pattern, miss) in [(miura(6, 5), 0.01), (bird_base(), 0.002), (square_twist(), 0.01)] {
        let exact = import(&pattern);
        for seed in 0..8 {
            let imported = import(&missed(&pattern, miss, seed));
            assert_eq!(counts(&imported), counts(&exact), "seed {seed}");
            assert_eq!(imported.sheet.facets.len(), exact.sheet.facets.len());
            assert_eq!(imported.mending.dropped, 0);
        }
        assert_eq!(exact.mending.dropped, 0);
    }
}

#[test]
fn small_features_of_a_clean_drawing_stay() {
    // Pleats 1/2000 of the diagonal apart: closer than the misses that are mended elsewhere.
    let mut pattern = Pattern::default();
    let gap = 2f64.sqrt() * 100.0 / 2000.0;
    let corners = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0], [0.0, 0.0]];
    pattern.add('B', &corners);
    for k in 0..6 {
        let x = 50.0 + gap * f64::from(k);
        pattern.add(if k % 2 == 0 { 'M' } else { 'V' }, &[[x, 0.0], [x, 100.0]]);
    }
    let imported = import(&pattern);
    assert_eq!((counts(&imported)[&'M'], counts(&imported)[&'V']), (3, 3));
    assert_eq!(imported.sheet.facets.len(), 7);
    // The same with a crease beside them that misses the border by less than the pleats are wide.
    pattern.add('V', &[[20.0, 0.4 * gap], [20.0, 100.0]]);
    let imported = import(&pattern);
    assert_eq!((counts(&imported)[&'M'], counts(&imported)[&'V']), (3, 4));
    assert_eq!(imported.mending.dropped, 0);
}

#[test]
fn the_scale_of_a_drawing_does_not_matter() {
    let scaled = |factor: f64| {
        let scale = |p: [f64; 2]| p.map(|x| x * factor);
        let creases = centre_missed().creases.into_iter();
        let creases = creases.map(|(a, b, letter)| (scale(a), scale(b), letter)).collect();
        import(&Pattern { creases })
    };
    let one = scaled(1.0);
    for factor in [0.015_625, 4.0, 1024.0] {
        let other = scaled(factor);
        assert_eq!(counts(&other), counts(&one));
        assert_eq!(other.mending.merged, one.mending.merged);
        assert_eq!(other.mending.tolerance, one.mending.tolerance * factor);
    }
}

#[test]
fn listed_vertices_nearly_on_each_other_are_one_within_a_stated_tolerance() {
    for has_faces in [false, true] {
        let mut file = json!({
            "vertices_coords": [[0, 0], [3, 0], [3, 2], [0, 2], [1, 0], [1, 2], [1.000_000_5, 0]],
            "edges_vertices": [[0, 4], [4, 6], [6, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5]],
            "edges_assignment": ["B", "B", "B", "B", "B", "B", "B", "M"],
        });
        if has_faces {
            file["faces_vertices"] = json!([[0, 4, 5, 3], [4, 6, 1, 2, 5]]);
        }
        let imported = import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap();
        check_sheet(&imported);
        assert_eq!((imported.sheet.vertices.len(), counts(&imported)[&'M']), (6, 1));
        assert!(imported.warnings.iter().any(|w| w.kind == WarningKind::TooShort));
        assert!((imported.mending.tolerance - 1e-6 * 13f64.sqrt()).abs() < 1e-12);
        assert_eq!(imported.mending.merged, 1);
    }
}

#[test]
fn a_vertex_beside_a_crease_lies_on_it() {
    let file = json!({
        "vertices_coords": [[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1], [1.000_001, 0.5]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0], [1, 4], [1, 6], [6, 4]],
        "edges_assignment": ["B", "B", "B", "B", "B", "B", "V", "F", "F"],
    });
    let imported = import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap();
    check_sheet(&imported);
    assert_eq!((imported.sheet.facets.len(), imported.mending.snapped), (2, 1));
    assert_eq!(counts(&imported).get(&'V'), Some(&2));
}
