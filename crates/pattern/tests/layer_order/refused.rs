//! Patterns that do not fold flat.

use std::f64::consts::PI;

use foldmotion_pattern::{FlatFolding, LayerError, LayerOptions};

use crate::grids::{find, of_fold, of_lines, strip};

/// The border of the square from −1 to 1.
const SQUARE: [(char, f64, f64, f64, f64); 4] = [
    ('B', -1.0, -1.0, 1.0, -1.0),
    ('B', 1.0, -1.0, 1.0, 1.0),
    ('B', 1.0, 1.0, -1.0, 1.0),
    ('B', -1.0, 1.0, -1.0, -1.0),
];

fn refused(creases: &[(char, f64, f64, f64, f64)]) -> LayerError {
    find(&of_lines(&[&SQUARE[..], creases].concat())).unwrap_err()
}

#[test]
fn a_crease_that_stops_halfway_is_named_with_its_angle() {
    let pattern = of_fold(&strip(&[1.0, 1.0], "V"));
    let targets: Vec<f64> = pattern.targets.iter().map(|t| t / 2.0).collect();
    let error = FlatFolding::find(&pattern, &targets, &LayerOptions::default()).unwrap_err();
    assert!(matches!(error, LayerError::TargetNotFlat { degrees, .. } if degrees == 90.0));
    assert!(error.to_string().contains("folds to 90.000°"), "{error}");
    assert!(
        FlatFolding::find(&pattern, &vec![0.0; targets.len()], &LayerOptions::default()).is_ok()
    );
    assert!((pattern.targets.iter().copied().fold(0.0, f64::max) - PI).abs() < 1e-15);
}

#[test]
fn a_vertex_with_three_creases_is_named() {
    let error = refused(&[
        ('V', 0.0, 0.0, 1.0, 0.0),
        ('V', 0.0, 0.0, -1.0, 1.0),
        ('V', 0.0, 0.0, -1.0, -1.0),
    ]);
    assert!(matches!(error, LayerError::OddCreases { creases: 3, position: [0.0, 0.0], .. }));
}

#[test]
fn angles_that_do_not_sum_to_180_degrees_are_named_with_their_sums() {
    let error = refused(&[
        ('V', 0.0, 0.0, 1.0, 0.0),
        ('V', 0.0, 0.0, 0.0, 1.0),
        ('V', 0.0, 0.0, -1.0, 0.0),
        ('M', 0.0, 0.0, -1.0, -1.0),
    ]);
    let LayerError::AngleSums { mut sums, .. } = error else { panic!("{error}") };
    sums.sort_by(f64::total_cmp);
    assert!((sums[0] - 135.0).abs() < 1e-9 && (sums[1] - 225.0).abs() < 1e-9, "{sums:?}");
}

#[test]
fn as_many_mountains_as_valleys_are_refused() {
    let error = refused(&[
        ('V', 0.0, 0.0, 1.0, 0.0),
        ('V', 0.0, 0.0, 0.0, 1.0),
        ('M', 0.0, 0.0, -1.0, 0.0),
        ('M', 0.0, 0.0, 0.0, -1.0),
    ]);
    assert!(matches!(error, LayerError::MountainsAndValleys { mountains: 2, valleys: 2, .. }));
}

/// A square with a square hole, creased once from the hole to the border: folded, it would have to tear.
#[test]
fn a_ring_with_one_crease_does_not_close() {
    let hole = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    let side = |k: usize| {
        let ((a, b), (c, d)) = (hole[k], hole[(k + 1) % 4]);
        ('B', a, b, c, d)
    };
    let ring = [side(0), side(1), side(2), side(3)];
    let error = refused(&[&ring[..], &[('V', 0.5, 0.5, 1.0, 1.0)]].concat());
    assert!(matches!(error, LayerError::OddLoop { .. } | LayerError::NotClosed { .. }), "{error}");
    let both = [('V', 0.5, 0.0, 1.0, 0.0), ('V', 0.0, 0.5, 0.0, 1.0)];
    let error = refused(&[&ring[..], &both].concat());
    assert!(matches!(error, LayerError::NotClosed { .. }), "{error}");
    let across = [('V', 0.5, 0.0, 1.0, 0.0), ('V', -1.0, 0.0, -0.5, 0.0)];
    assert!(find(&of_lines(&[&SQUARE[..], &ring, &across].concat())).is_ok());
}
