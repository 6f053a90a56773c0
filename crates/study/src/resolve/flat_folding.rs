//! Vertices of an imported pattern that cannot fold flat by themselves.

use std::collections::BTreeSet;

use foldmotion_pattern::{ImportedPattern, PatternCheck, VertexCheck};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A vertex that cannot fold flat by itself.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FlatFoldingFault {
    /// The index of the vertex in the sheet.
    pub vertex: u32,
    /// Its coordinates in the flat sheet, in `length_unit`.
    pub position: [f64; 2],
    /// The sums of alternate sector angles in degrees, the smaller first (Kawasaki: both 180); null for an odd number of
    /// creases.
    pub alternate_sums_deg: Option<[f64; 2]>,
    /// Mountain creases minus valley creases (Maekawa: 2 or -2).
    pub mountains_minus_valleys: i32,
}

impl FlatFoldingFault {
    fn words(&self) -> String {
        let [x, y] = self.position;
        let sums = match self.alternate_sums_deg {
            Some([a, b]) => format!("alternate angles sum to {a:.4} and {b:.4} degrees"),
            None => "an odd number of creases".to_owned(),
        };
        let difference = self.mountains_minus_valleys;
        format!(
            "vertex {} at ({x:.4}, {y:.4}): {sums}, mountains - valleys = {difference}",
            self.vertex
        )
    }

    /// How far from folding flat: mountains and valleys that do not match count like a straight angle.
    fn badness(&self) -> f64 {
        let angle = self.alternate_sums_deg.map_or(180.0, |[a, _]| 180.0 - a);
        angle + if self.mountains_minus_valleys.abs() == 2 { 0.0 } else { 180.0 }
    }
}

/// The vertices of a pattern that cannot fold flat, the worst first. Those at free hinges, which may fold or not, are left
/// out.
pub(crate) fn faults(imported: &ImportedPattern, check: &PatternCheck) -> Vec<FlatFoldingFault> {
    let free = imported.free_hinges().map(|edge| &imported.sheet.edges[edge as usize]);
    let at_free: BTreeSet<u32> = free.flat_map(|edge| edge.vertices).collect();
    let is_bad =
        |check: &&VertexCheck| !check.is_flat_foldable() && !at_free.contains(&check.vertex);
    let bad = check.vertices.iter().filter(is_bad);
    let mut faults: Vec<FlatFoldingFault> = bad
        .map(|check| FlatFoldingFault {
            vertex: check.vertex,
            position: imported.sheet.vertices[check.vertex as usize].to_array(),
            alternate_sums_deg: check
                .alternate_sums()
                .map(|[a, b]| [a.min(b), a.max(b)].map(f64::to_degrees)),
            mountains_minus_valleys: check.mountains_minus_valleys,
        })
        .collect();
    faults.sort_by(|a, b| b.badness().total_cmp(&a.badness()).then(a.vertex.cmp(&b.vertex)));
    faults
}

/// Names the vertices that cannot fold flat by themselves, the worst first; `None` if there are none.
pub(crate) fn not_flat_foldable(
    imported: &ImportedPattern,
    check: &PatternCheck,
) -> Option<String> {
    const NAMED: usize = 3;
    let faults = faults(imported, check);
    if faults.is_empty() {
        return None;
    }
    let named: Vec<String> = faults.iter().take(NAMED).map(FlatFoldingFault::words).collect();
    let more = match faults.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    Some(format!(
        "{} of {} interior vertices are not locally flat-foldable, though all creases are to fold flat (alternate angles sum \
         to 180 degrees, mountains and valleys differ by 2): {}{more}",
        faults.len(),
        check.vertices.len(),
        named.join("; ")
    ))
}
