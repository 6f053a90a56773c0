//! Patterns that fold flat at every vertex and have no order of layers.

use foldmotion_pattern::{FlatFolding, FoundLayers, LayerOptions};

use crate::grids::{contradicting, find, grid, of_fold, strip};

/// Both ends are longer than the middle and fold over it to one side: each would have to lie over the other.
#[test]
fn a_letter_whose_both_ends_are_too_long_has_no_order() {
    for letters in ["VV", "MM"] {
        let letter = of_fold(&strip(&[2.0, 1.0, 2.0], letters));
        assert_eq!(contradicting(&letter), [0, 1, 2]);
    }
}

/// The letter folded in half: every vertex meets the conditions of Kawasaki and Maekawa.
#[test]
fn two_pleats_that_collide_are_found_though_every_vertex_folds_flat() {
    let upright = |_: usize, j: usize| if j == 0 { 'V' } else { 'M' };
    let xs = [0.0, 2.0, 3.0, 5.0];
    let pattern = of_fold(&grid(&xs, &[0.0, 1.0, 2.0], &upright, &|_, _| 'V'));
    assert!(pattern.check().is_flat_foldable());
    let facets = contradicting(&pattern);
    // One of the two rows is reason enough.
    assert!(facets == [0, 1, 2] || facets == [3, 4, 5], "{facets:?}");
}

/// The reason lies at one end of a long strip.
#[test]
fn the_facets_named_are_those_that_cannot_be_ordered() {
    let mut lengths = vec![1.0; 20];
    lengths.extend([3.0, 1.0, 3.0]);
    let letters = "MV".repeat(10) + "VV";
    let facets = contradicting(&of_fold(&strip(&lengths, &letters)));
    assert_eq!(facets, [20, 21, 22]);
}

#[test]
fn a_search_that_runs_out_of_steps_says_so() {
    let strip = of_fold(&strip(&[1.0; 8], "UUUUUUU"));
    let options = LayerOptions { steps: 10, ..LayerOptions::default() };
    let folding = FlatFolding::find(&strip, &strip.targets, &options).unwrap();
    assert!(matches!(folding.found, FoundLayers::Undecided { steps } if steps >= 10));
    assert!(matches!(find(&strip).unwrap().found, FoundLayers::Order { .. }));
}
