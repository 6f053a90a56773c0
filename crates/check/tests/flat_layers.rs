//! Flat states and orders of their layers, proved without a motion.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

use foldmotion_check::{FlatLayers, LayerRule, flat_layers};
use foldmotion_pattern::{Assignment, Case, LayerOrder, Unit, UnitSheet};
use glam::DVec3;

const WIDTH: f64 = 1e-5;

/// A map of 3 x 4 units, which folds into one stack.
fn map() -> (UnitSheet, Vec<DVec3>) {
    let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
    let units = UnitSheet::map_folded(&[unit; 3], 4).unwrap();
    assert_eq!(units.map_layers(), Some(12));
    let positions = units.compact();
    (units, positions)
}

fn proof(units: &UnitSheet, positions: &[DVec3], order: &LayerOrder) -> FlatLayers {
    let mut sheet = units.sheet.clone();
    for (edge, &angle) in sheet.edges.iter_mut().zip(units.compact_angles()) {
        let folded = if angle > 0.0 { Assignment::Valley } else { Assignment::Mountain };
        if edge.is_hinge() {
            let is_flat = angle.abs() < 1.0;
            edge.assignment = if is_flat { Assignment::Facet } else { folded };
        }
    }
    flat_layers(&sheet, positions, order, WIDTH)
}

#[test]
fn the_exact_order_of_a_map_is_proved() {
    let (units, positions) = map();
    let proof = proof(&units, &positions, &units.compact_order());
    assert!(proof.is_proved(1e-9), "{:?}", proof.conflicts);
    let pairs: usize = proof.clusters.iter().map(|cluster| cluster.pairs).sum();
    assert_eq!(2 * pairs, units.compact_order().len());
}

#[test]
fn an_order_with_one_pair_missing_or_turned_is_not_proved() {
    let (units, positions) = map();
    let order = units.compact_order();
    let (f, g, sign) = order.iter().nth(40).unwrap();
    let mut missing = LayerOrder::default();
    for (a, b, sign) in order.iter().filter(|&(a, b, _)| [a, b] != [f, g] && [a, b] != [g, f]) {
        missing.insert(a, b, sign);
    }
    let open = proof(&units, &positions, &missing);
    assert!(!open.is_proved(1e-9) && open.conflicts.is_empty());
    let mut turned = order.clone();
    turned.insert(f, g, -sign);
    let found = proof(&units, &positions, &turned);
    assert!(found.conflicts.iter().any(|c| c.rule == LayerRule::Claim), "{:?}", found.conflicts);
    let back = order.sign(g, f).unwrap();
    turned.insert(g, f, -back);
    assert!(!proof(&units, &positions, &turned).conflicts.is_empty());
}

#[test]
fn a_stretched_state_is_not_proved() {
    let (units, mut positions) = map();
    let order = units.compact_order();
    let highest = positions.iter().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max);
    for position in positions.iter_mut().filter(|p| p.x > highest - 1e-9) {
        position.x += 1e-3;
    }
    let stretched = proof(&units, &positions, &order);
    assert!((stretched.stretch - 1e-3).abs() < 1e-9);
    assert!(stretched.is_proved(2e-3) && !stretched.is_proved(1e-4));
}
