//! The order of layers of a flat state, found by the rules of flat folding and proved by the two proofs of a collision
//! verdict.
//!
//! The search lives in the pattern crate and says which orders its conditions allow. Neither proof shares its definition:
//! the first pairs creases that meet along a line, the second sorts all layers around each line and joins them like
//! brackets. Both read triangles and the orders between them, and nothing of the search.

use std::f64::consts::PI;

use foldmotion_check::{Checker, CollisionOptions, CollisionReport, LayerProof, Verdict};
use foldmotion_pattern::{
    ConditionCounts, FlatFolding, FlatState, FoundLayers, ImportedPattern, LayerOptions, LayerOrder,
};
use foldmotion_verify::Verifier;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The proofs count overlaps up to this multiple of their tolerance as none.
const NARROW: f64 = 10.0;
/// The most facets that are named.
const SHOWN: usize = 12;
/// Targets may differ from ±180° by this much, in radians.
const FLAT_ANGLE: f64 = 1e-6;

/// A proof of an order of layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LayerProofName {
    /// The first proof, that of `foldmotion check`.
    Check,
    /// The second proof, that of `foldmotion check --verify`.
    Verify,
}

impl LayerProofName {
    fn name(self) -> &'static str {
        match self {
            Self::Check => "check",
            Self::Verify => "verify",
        }
    }
}

/// The flat state of a crease pattern, found by reflections and the rules of flat folding, without a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LayerOrderReport {
    /// Whether the flat state exists: the reflections close and its layers have an order. Null if it was not decided.
    pub exists: Option<bool>,
    /// The number of pairs of facets that overlap in the flat state; of facets that are not convex, pairs of their
    /// triangles. Null if the pattern does not fold flat.
    pub pairs: Option<usize>,
    /// The number of conditions of each kind on the order of these pairs. Null if the pattern does not fold flat.
    pub conditions: Option<ConditionCounts>,
    /// The number of independent components that were searched after all that follows from mountains and valleys. Null
    /// if the pattern does not fold flat.
    pub components: Option<usize>,
    /// The proofs that confirm the order that was found, neither of which shares the definition of the search.
    pub proved_by: Vec<LayerProofName>,
    /// Facets that cannot be put in order whatever the others do; empty if an order exists.
    pub contradicting: Vec<u32>,
    /// Why there is no flat state, or why it was not decided or not proved; null if it is proved by both proofs.
    pub reason: Option<String>,
}

/// A flat state with what was found about its layers.
#[derive(Debug)]
pub(crate) struct FoundState {
    /// The flat state and an order of its layers; `None` if there is none or it was not found.
    pub(crate) ordered: Option<(FlatState, LayerOrder)>,
    pub(crate) report: LayerOrderReport,
}

/// Whether every fold angle is 0° or ±180° and one of them is not 0°.
pub(crate) fn are_flat(targets: &[f64]) -> bool {
    let is_flat = |t: &f64| t.abs() <= FLAT_ANGLE || (t.abs() - PI).abs() <= FLAT_ANGLE;
    targets.iter().all(is_flat) && targets.iter().any(|t| t.abs() > FLAT_ANGLE)
}

impl FoundState {
    /// Folds a pattern flat, finds an order of its layers and proves it.
    pub(crate) fn find(imported: &ImportedPattern, targets: &[f64]) -> Self {
        let mut report = LayerOrderReport {
            exists: Some(false),
            pairs: None,
            conditions: None,
            components: None,
            proved_by: Vec::new(),
            contradicting: Vec::new(),
            reason: None,
        };
        let folding = match FlatFolding::find(imported, targets, &LayerOptions::default()) {
            Ok(folding) => folding,
            Err(error) => {
                if error.is_of_size() {
                    report.exists = None;
                }
                report.reason = Some(error.to_string());
                return Self { ordered: None, report };
            }
        };
        report.pairs = Some(folding.pairs);
        report.conditions = Some(folding.conditions);
        report.components = Some(folding.components);
        let ordered = match folding.found {
            FoundLayers::Order { order, .. } => {
                report.prove(&folding.state, &order);
                Some((folding.state, order))
            }
            FoundLayers::None { facets, given } => {
                report.reason = Some(no_order(&facets, &given));
                report.contradicting = facets;
                None
            }
            FoundLayers::Undecided { steps } => {
                report.exists = None;
                report.reason = Some(format!(
                    "the search ended after {steps} conditions were looked at; whether an order exists is not decided"
                ));
                None
            }
        };
        Self { ordered, report }
    }
}

fn no_order(facets: &[u32], given: &[[u32; 2]]) -> String {
    let names: Vec<String> = facets.iter().take(SHOWN).map(ToString::to_string).collect();
    let more = match facets.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let names = names.join(", ");
    match given.first() {
        None => format!("no order of layers exists: facets {names}{more} cannot be put in order"),
        Some([f, g]) => format!(
            "no order of layers agrees with faceOrders of the file: facets {names}{more} cannot be put in order with what it \
             says of facets {f} and {g}; without faceOrders an order exists"
        ),
    }
}

impl LayerOrderReport {
    /// Runs both proofs on an order.
    fn prove(&mut self, state: &FlatState, order: &LayerOrder) {
        self.exists = None;
        let checked = first_proof(state, order);
        let verified = checked.and_then(|report| {
            self.exists = Some(true);
            self.proved_by.push(LayerProofName::Check);
            second_proof(state, order, &report)
        });
        match verified {
            Ok(()) => self.proved_by.push(LayerProofName::Verify),
            Err(reason) => self.reason = Some(reason),
        }
    }

    /// The sentence of the table.
    pub fn line(&self) -> String {
        let reason = self.reason.as_deref().unwrap_or_default();
        let proofs: Vec<&str> = self.proved_by.iter().map(|proof| proof.name()).collect();
        match self.exists {
            Some(true) => {
                let pairs = self.pairs.unwrap_or_default();
                let doubt = if reason.is_empty() { "" } else { "; " };
                format!(
                    "a flat state exists, with its order of layers proved ({pairs} overlapping pairs; by {}{doubt}{reason})",
                    proofs.join(" and ")
                )
            }
            Some(false) => format!("the pattern has no flat state: {reason}"),
            None => format!("whether a flat state exists is not decided: {reason}"),
        }
    }
}

/// The first proof of an order, all of whose statements must be proved; otherwise why not.
fn first_proof(state: &FlatState, order: &LayerOrder) -> Result<CollisionReport, String> {
    let options = CollisionOptions {
        touch_tolerance: state.width / (NARROW * state.sheet.unit_length),
        ..CollisionOptions::default()
    };
    let failed = |error: &dyn std::fmt::Display| {
        format!("an order was found, but the check does not confirm it: {error}")
    };
    let frame = state.frame();
    let mut checker =
        Checker::new(&state.sheet, &frame, &options).map_err(|error| failed(&error))?;
    checker.claim(order, &|triangle| triangle).map_err(|error| failed(&error))?;
    let report = checker.finish();
    if let Some(first) = report.penetrations.first() {
        return Err(failed(&first_words(state, first.faces, first.kind.name())));
    }
    if let Some(cluster) = report.clusters.iter().find(|c| c.order != LayerProof::Proved) {
        let words =
            format!("the order of {} triangles is not known everywhere", cluster.faces.len());
        return Err(failed(&words));
    }
    if !matches!(report.verdict, Verdict::Free | Verdict::Touching) {
        return Err(failed(&format!("its verdict is {}", report.verdict)));
    }
    Ok(report)
}

fn first_words(state: &FlatState, faces: [u32; 2], kind: &str) -> String {
    let [f, g] = faces.map(|face| state.sheet.face_facets[face as usize]);
    format!("facets {f} and {g}, {kind}")
}

/// The second proof, of what the first one states.
fn second_proof(
    state: &FlatState,
    order: &LayerOrder,
    stated: &CollisionReport,
) -> Result<(), String> {
    let mut verifier = Verifier::new(&state.sheet, state.frame(), stated);
    verifier.claim(order, &|triangle| triangle);
    let verification = verifier.finish();
    if let Some(refuted) = verification.refuted.first() {
        return Err(format!(
            "the second proof finds {} instead of {}",
            refuted.found, refuted.stated
        ));
    }
    match verification.unproved.first() {
        None => Ok(()),
        Some(open) => {
            let what = first_words(state, open.faces, &open.what);
            Err(format!("the second proof leaves open: {what}"))
        }
    }
}
