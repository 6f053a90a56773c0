//! The guarantees of a sheet.

use std::collections::BTreeMap;

use foldmotion_pattern::{Assignment, ImportedPattern};

/// Panics if an import is not a valid sheet.
pub fn check(imported: &ImportedPattern) {
    let sheet = &imported.sheet;
    let mut sides = BTreeMap::new();
    for (face, &[a, b, c]) in (0..).zip(&sheet.faces) {
        let [p, q, r] = [a, b, c].map(|v| sheet.vertices[v as usize]);
        assert!((q - p).perp_dot(r - p) >= 0.0, "triangle {face} turns right");
        for side in [[a, b], [b, c], [c, a]] {
            assert!(sides.insert(side, face).is_none(), "two triangles on one side of {side:?}");
        }
    }
    let mut met = 0;
    for (edge, target) in sheet.edges.iter().zip(&imported.targets) {
        let [a, b] = edge.vertices;
        assert_eq!(edge.faces, [[a, b], [b, a]].map(|side| sides.get(&side).copied()));
        assert_eq!(edge.assignment == Assignment::Border, !edge.is_hinge());
        assert!(target.abs() <= std::f64::consts::PI);
        met += edge.faces.iter().flatten().count();
    }
    assert_eq!(met, 3 * sheet.faces.len());
    assert!(sheet.unit_length > 0.0 && sheet.unit_length.is_finite());
    assert_eq!(imported.edge_sources.len(), sheet.edges.len());
}
