//! Patterns in several pieces.

use foldmotion_pattern::{FlatFolding, FoundLayers, ImportedPattern};

use crate::grids::{find, of_fold, of_lines, strip};

/// A strip of height 1 with creases at these places, and its border.
fn strip_from(from: f64, to: f64, creases: &[(char, f64)]) -> Vec<(char, f64, f64, f64, f64)> {
    let mut lines = vec![
        ('B', from, 0.0, to, 0.0),
        ('B', to, 0.0, to, 1.0),
        ('B', to, 1.0, from, 1.0),
        ('B', from, 1.0, from, 0.0),
    ];
    lines.extend(creases.iter().map(|&(letter, x)| (letter, x, 0.0, x, 1.0)));
    lines
}

fn has_order(folding: &FlatFolding) -> bool {
    matches!(folding.found, FoundLayers::Order { .. })
}

/// The extent of each piece along x, in the pattern and in the flat state: those of the vertices up to x = 2.5 and beyond.
fn extents(pattern: &ImportedPattern, folding: &FlatFolding) -> [[f64; 2]; 2] {
    [false, true].map(|is_second| {
        let vertices = pattern.sheet.vertices.iter().zip(&folding.state.positions);
        let of_piece = vertices.filter(|(vertex, _)| (vertex.x > 2.5) == is_second);
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        of_piece.fold(start, |[low, high], (_, at)| [low.min(at.x), high.max(at.x)])
    })
}

#[test]
fn every_piece_is_folded() {
    let first = strip_from(0.0, 2.0, &[('V', 1.0)]);
    let both = [first, strip_from(3.0, 5.0, &[('M', 4.0)])].concat();
    let pattern = of_lines(&both);
    let folding = find(&pattern).unwrap();
    assert!(has_order(&folding));
    assert_eq!((folding.pairs, folding.state.misfit), (2, 0.0));
    assert_eq!(folding.state.is_turned.iter().filter(|turned| **turned).count(), 4);
    assert_eq!(extents(&pattern, &folding), [[0.0, 1.0], [3.0, 4.0]]);
}

#[test]
fn a_piece_that_would_lie_on_another_is_moved_beside_it() {
    // The flap of the second strip, 1.9 long, would come to lie on the first one.
    let first = strip_from(0.0, 2.4, &[('V', 1.2)]);
    let both = [first, strip_from(2.6, 6.5, &[('M', 4.6), ('M', 2.7)])].concat();
    let pattern = of_lines(&both);
    let folding = find(&pattern).unwrap();
    assert!(has_order(&folding));
    let [[_, high], [low, _]] = extents(&pattern, &folding);
    assert!(low > high, "{low} {high}");
}

#[test]
fn a_fault_of_any_piece_is_named() {
    let first = strip_from(0.0, 2.0, &[]);
    let second = strip_from(3.0, 5.0, &[('V', 3.5), ('V', 4.5)]);
    assert!(has_order(&find(&of_lines(&[first, second].concat())).unwrap()));
    let narrow = strip_from(3.0, 5.0, &[('V', 3.9), ('V', 4.1)]);
    let folding = find(&of_lines(&[strip_from(0.0, 2.0, &[]), narrow].concat())).unwrap();
    assert!(!has_order(&folding));
    assert!(!has_order(&find(&of_fold(&strip(&[1.0, 0.2, 1.0], "VV"))).unwrap()));
}
