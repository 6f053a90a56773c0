//! The report of a jam.

use std::collections::BTreeSet;

use foldmotion_solver::quasi_static::Jam;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::resolve::names::UnitName;
use crate::resolve::subject::Subject;

/// A motion that was stopped by contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JamReport {
    /// From this motion time on the creases do not follow their targets.
    pub t: f64,
    /// The largest difference of a fold angle from its target where the motion ended, in degrees.
    pub fold_angle_error_deg: f64,
    /// The pairs of facets that push hardest on each other, hardest first; at most ten.
    pub facets: Vec<[u32; 2]>,
    /// The units of these facets; empty for an imported pattern.
    pub units: Vec<[UnitName; 2]>,
    /// These pairs of facets in words: kind, index and unit.
    pub names: Vec<[String; 2]>,
}

impl JamReport {
    /// The facets that block the motion, as part of a sentence.
    pub(crate) fn words(&self) -> String {
        let pairs = self.names.iter().take(3).map(|[a, b]| format!("{a} on {b}"));
        let pairs = pairs.collect::<Vec<_>>().join(", ");
        format!("facets that push hardest: {pairs}")
    }

    /// The report of `jam`, with the names of the facets of `subject`.
    pub(crate) fn new(jam: &Jam, subject: &Subject) -> Self {
        let sheet = subject.sheet();
        let facets = |(faces, _): &([u32; 2], f64)| faces.map(|f| sheet.face_facets[f as usize]);
        let mut seen = BTreeSet::new();
        let facets: Vec<[u32; 2]> = jam.blocking.iter().map(facets).collect();
        let facets = facets.into_iter().filter(|pair| seen.insert(*pair));
        let facets: Vec<[u32; 2]> = facets.take(10).collect();
        let units = facets.iter().filter_map(|pair| subject.units_of(*pair));
        let units = units.collect();
        let names = facets.iter().map(|pair| pair.map(|f| subject.facet_name(f)));
        let names = names.collect();
        Self {
            t: jam.time,
            fold_angle_error_deg: jam.fold_angle_error.to_degrees(),
            facets,
            units,
            names,
        }
    }
}
