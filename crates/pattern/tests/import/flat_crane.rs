//! The crane folded flat: counts, symmetry, where its tips lie, and the order of its layers.

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use foldmotion_pattern::{FlatFolding, FoundLayers, LayerOptions, LayerOrder};
use glam::DVec2;

use crate::crane::{BEAK, CENTRE, CORNER, Point, Quarter, WING_TIP, crane, on_ray, place};
use crate::draw::Crease;
use crate::folded::Folded;
use crate::patterns::{both, check_sheet, counts};

/// Under the front wing.
const FRONT: Point = [0.2, -0.2];

/// The place of every triangle in the stack, from front to back; the neck's quarters before the tail's beside them.
fn stack(folded: &Folded<'_>) -> Vec<usize> {
    let sheet = &folded.imported.sheet;
    let mut stack = vec![usize::MAX; sheet.faces.len()];
    for quarter in 0..4 {
        for (depth, corners) in Quarter::new(quarter < 2).layers().iter().enumerate() {
            let sum: DVec2 = corners.iter().map(|p| DVec2::from(*p)).sum();
            let middle = (sum / corners.len() as f64).to_array();
            let facet = sheet.face_facets[folded.face_at(place(quarter, middle))];
            let front = 2 * depth + quarter / 2;
            let layer = if quarter.is_multiple_of(2) { front } else { 63 - front };
            for (place, of) in stack.iter_mut().zip(&sheet.face_facets) {
                if *of == facet {
                    *place = layer;
                }
            }
        }
    }
    stack
}

#[test]
fn the_crane_has_its_counts_and_folds_flat_at_every_vertex() {
    let pattern = crane();
    for imported in both(&pattern) {
        check_sheet(&imported);
        assert!(imported.warnings.is_empty());
        // Centre, corners, middles of the sides; 4 + 3 more a quarter; 1 a leg; 9 where the head turns.
        assert_eq!(imported.sheet.vertices.len(), 9 + 4 * 7 + 2 + 9);
        // 17 creases a quarter, 2 hinges, 4 pieces of diagonal; 8 across the head, which splits 7 more. V − E + F = 1.
        let creases = 4 * 17 + 2 + 4 + 8 + 7;
        assert_eq!(imported.sheet.facets.len(), 1 + creases + 10 - 48);
        let counts = counts(&imported);
        assert_eq!((counts[&'B'], counts[&'M'] + counts[&'V']), (10, creases));
        assert_eq!(counts[&'M'], pattern.count('M'));
        let check = imported.check();
        assert_eq!(check.vertices.len(), 48 - 10);
        assert!(check.is_developable() && check.is_flat_foldable());
        assert!(imported.folds_flat());
        let area = |f: &[u32; 3]| {
            let [p, q, r] = f.map(|v| imported.sheet.vertices[v as usize]);
            (q - p).perp_dot(r - p) / 2.0
        };
        let area: f64 = imported.sheet.faces.iter().map(area).sum();
        assert!((area - 4.0).abs() < 1e-12);
    }
}

#[test]
fn the_crane_is_its_own_mirror_image_and_but_for_the_head_neck_and_tail_are_equal() {
    let key = |crease: &Crease, quarter| {
        let at = |p| place(quarter, p).map(|c| (c * 1e9).round() as i64);
        let mut ends = [at(crease.0), at(crease.1)];
        ends.sort_unstable();
        (ends, crease.2)
    };
    let creases = crane().creases;
    let all = |quarter| -> BTreeSet<_> { creases.iter().map(|c| key(c, quarter)).collect() };
    let [drawn, mirrored, turned] = [0, 1, 3].map(all);
    assert_eq!(drawn.len(), creases.len());
    assert_eq!(drawn, mirrored);
    // At each of the two legs: 8 creases across the head, and 9 pieces of rays that it splits against whole ones.
    let differ = drawn.symmetric_difference(&turned).count();
    assert_eq!(differ, 2 * (8 + 2 * 9 + 9));
}

#[test]
fn the_crane_closes_around_every_vertex_and_its_tips_lie_where_the_folds_put_them() {
    for imported in both(&crane()) {
        let folded = Folded::new(&imported, FRONT);
        assert!(folded.closes());
        // Seen along the axis from the hinge of the wings to their tips: 1 long, as the legs were before they turned.
        let [wing, back] = [WING_TIP, [-1.0, 1.0]].map(|p| folded.at(p));
        let hinge = folded.at(place(0, on_ray(0, 1.0)));
        let up = wing - hinge;
        assert!(wing.distance(back) < 1e-12 && (up.length() - 1.0).abs() < 1e-12);
        let seen = |p: Point| {
            let from_hinge = folded.at(p) - hinge;
            DVec2::new(from_hinge.perp_dot(up), from_hinge.dot(up))
        };
        let slant = FRAC_1_SQRT_2;
        // Neck and tail stand at 45° on both sides; the beak, at a right angle to the neck, points down.
        for (drawn, expected) in [
            (CENTRE, DVec2::new(0.0, SQRT_2 - 1.0)),
            ([-1.0, -1.0], DVec2::new(-slant, slant)),
            (on_ray(0, BEAK), (1.0 - BEAK) * DVec2::new(slant, slant)),
            (CORNER, DVec2::new(slant, slant * (1.0 - 2.0 * BEAK))),
        ] {
            let found = seen(drawn);
            assert!(found.distance(expected) < 1e-12, "{drawn:?} {found}");
        }
        let mut bent = imported.clone();
        bent.sheet.vertices[imported.check().vertices[0].vertex as usize].y += 1e-3;
        assert!(!Folded::new(&bent, FRONT).closes());
    }
}

#[test]
fn the_layers_of_the_crane_lie_in_an_order_in_which_no_paper_crosses() {
    for imported in both(&crane()) {
        let folded = Folded::new(&imported, FRONT);
        let stack = stack(&folded);
        let used: BTreeSet<_> = stack.iter().collect();
        assert_eq!(used.len(), imported.sheet.facets.len());
        assert_eq!((folded.denied(&stack), folded.crossings(&stack)), (0, 0));
        let creases = crane().count('M') + crane().count('V');
        let turned: Vec<usize> = stack.iter().map(|layer| 63 - layer).collect();
        assert_eq!(folded.denied(&turned), creases);
        // With the beak before the body, or the front wing behind all, paper crosses.
        for (inside, layer) in [([0.95, 0.93], 0), ([0.95, -0.94], 99)] {
            let facets = &imported.sheet.face_facets;
            let moved = facets[folded.face_at(inside)];
            let places = stack.iter().zip(facets);
            let wrong = places.map(|(place, facet)| if *facet == moved { layer } else { *place });
            assert!(folded.crossings(&wrong.collect::<Vec<_>>()) > 0);
        }
    }
}

/// The place of every triangle in a stack that an order allows, from front to back; triangles of one facet share theirs.
fn stack_of(folded: &Folded<'_>, order: &LayerOrder) -> Vec<usize> {
    let facets = &folded.imported.sheet.face_facets;
    let mut behind = vec![BTreeSet::new(); folded.imported.sheet.facets.len()];
    for (f, g, sign) in order.iter() {
        if (sign > 0) == folded.shows_front(g) {
            behind[facets[f as usize] as usize].insert(facets[g as usize] as usize);
        }
    }
    let mut places = vec![usize::MAX; behind.len()];
    for place in 0..places.len() {
        let is_in_front = |&facet: &usize| {
            let hides = |(other, hidden): (usize, &BTreeSet<usize>)| {
                places[other] == usize::MAX && hidden.contains(&facet)
            };
            places[facet] == usize::MAX && !behind.iter().enumerate().any(hides)
        };
        let next = (0..places.len()).find(is_in_front).unwrap();
        places[next] = place;
    }
    facets.iter().map(|&facet| places[facet as usize]).collect()
}

#[test]
fn the_order_that_is_found_for_the_crane_is_one_in_which_no_paper_crosses() {
    for imported in both(&crane()) {
        let options = LayerOptions { solutions: 100_000, ..LayerOptions::default() };
        let folding = FlatFolding::find(&imported, &imported.targets, &options).unwrap();
        assert!(folding.state.misfit < 1e-12);
        let FoundLayers::Order { order, solutions } = folding.found else {
            panic!("{:?}", folding.found);
        };
        assert!(solutions.unwrap() >= 1);
        let folded = Folded::new(&imported, FRONT);
        let stack = stack_of(&folded, &order);
        assert_eq!((folded.denied(&stack), folded.crossings(&stack)), (0, 0));
    }
}
