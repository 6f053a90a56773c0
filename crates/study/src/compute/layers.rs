//! The order of layers of a flat state, found by the rules of flat folding and proved by the two proofs of a collision
//! verdict.
//!
//! The search lives in the pattern crate and says which orders its conditions allow. Neither proof shares its definition:
//! the first pairs creases that meet along a line, the second sorts all layers around each line and joins them like
//! brackets. Both read triangles and the orders between them, and nothing of the search.

use std::f64::consts::PI;

use foldmotion_check::{CheckError, Checker, CollisionOptions, Verdict, flat_layers};
use foldmotion_pattern::{
    ConditionCounts, FlatFolding, FlatState, FoundLayers, ImportedPattern, LayerOptions, LayerOrder,
};
use foldmotion_verify::Verifier;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The proofs count overlaps up to this multiple of their tolerance as none.
const NARROW: f64 = 10.0;
/// The most orders of two triangles that the second proof is run on, which takes seconds then.
const MOST_VERIFIED: usize = 10_000;
/// The most facets that are named.
const SHOWN: usize = 12;
/// Targets may differ from ±180° by this much, in radians.
const FLAT_ANGLE: f64 = 1e-6;

/// A proof of an order of layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LayerProofName {
    /// The first proof: the rules of flat foldings as `foldmotion check` tests them.
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
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
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
    /// The proofs that confirm the order that was found, neither of which shares the definition of the search. The second
    /// is run up to 10000 orders of two triangles.
    pub proved_by: Vec<LayerProofName>,
    /// Facets that cannot be put in order whatever the others do; empty if an order exists.
    pub contradicting: Vec<u32>,
    /// Why there is no flat state, or why it was not decided, or what the second proof does not confirm; null if every
    /// proof that was run confirms the order.
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

/// By what the width that counts as none is multiplied, in turn, until the order that is found is proved.
const WIDTHS: [f64; 5] = [1.0, 0.5, 0.25, 2.0, 4.0];
/// No other width is tried once all tried had this many conditions together, which takes a second.
const MOST_CONDITIONS: usize = 2_000_000;

impl FoundState {
    /// Folds a pattern flat, finds an order of its layers and proves it.
    ///
    /// Where layers are hardly wider than what counts as none, the search and the proofs may not see the same ones. Then
    /// other widths are tried, unless there is too much to put in order; if no order is proved at any, the result is that
    /// of the first.
    pub(crate) fn find(imported: &ImportedPattern, targets: &[f64]) -> Self {
        let first = Self::with_width(imported, targets, WIDTHS[0]);
        let ended_first = first.ordered.is_none() && first.report.exists.is_none();
        if first.report.pairs.is_none() || first.report.exists == Some(true) || ended_first {
            return first;
        }
        let mut conditions = first.conditions();
        for &width in &WIDTHS[1..] {
            if conditions > MOST_CONDITIONS {
                break;
            }
            let other = Self::with_width(imported, targets, width);
            if other.report.exists == Some(true) {
                return other;
            }
            conditions += other.conditions();
        }
        first
    }

    /// The number of conditions on the order of its layers.
    fn conditions(&self) -> usize {
        self.report.conditions.map_or(0, |conditions| conditions.total())
    }

    fn with_width(imported: &ImportedPattern, targets: &[f64], width: f64) -> Self {
        let mut report = LayerOrderReport::default();
        let options = LayerOptions { width, ..LayerOptions::default() };
        let folding = match FlatFolding::find(imported, targets, &options) {
            Ok(folding) => folding,
            Err(error) => {
                report.exists = (!error.is_of_size()).then_some(false);
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
                report.exists = Some(false);
                report.reason = Some(no_order(&facets, &given));
                report.contradicting = facets;
                None
            }
            FoundLayers::Undecided { steps } => {
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
    /// Runs the proofs on an order: the second one if it is not too large.
    fn prove(&mut self, state: &FlatState, order: &LayerOrder) {
        if let Err(reason) = first_proof(state, order) {
            self.reason = Some(reason);
            return;
        }
        self.exists = Some(true);
        self.proved_by.push(LayerProofName::Check);
        if order.len() > MOST_VERIFIED {
            return;
        }
        match second_proof(state, order) {
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

/// The first proof: the rules of flat foldings, tested on triangles.
fn first_proof(state: &FlatState, order: &LayerOrder) -> Result<(), String> {
    let proof = flat_layers(&state.sheet, &state.frame().positions, order, state.width);
    if proof.is_proved(state.width) {
        return Ok(());
    }
    let what = match proof.conflicts.first() {
        Some(conflict) => {
            let facets = conflict.faces.iter().map(|&face| state.sheet.face_facets[face as usize]);
            format!("{} of facets {:?}", conflict.rule, facets.collect::<Vec<_>>())
        }
        None if proof.stretch > state.width => {
            format!("an edge is longer or shorter by {:.6}", proof.stretch)
        }
        None => "some layers are hardly wider than what counts as none".to_owned(),
    };
    Err(format!("an order was found, but the check does not confirm it: {what}"))
}

/// The second proof, of what the collision check states.
fn second_proof(state: &FlatState, order: &LayerOrder) -> Result<(), String> {
    let options = CollisionOptions {
        touch_tolerance: state.width / (NARROW * state.sheet.unit_length),
        ..CollisionOptions::default()
    };
    let failed = |error: &CheckError| format!("the collision check does not confirm it: {error}");
    let frame = state.frame();
    let mut checker =
        Checker::new(&state.sheet, &frame, &options).map_err(|error| failed(&error))?;
    checker.claim(order, &|triangle| triangle).map_err(|error| failed(&error))?;
    let stated = checker.finish();
    if stated.verdict != Verdict::Touching {
        return Err(format!(
            "the collision check does not confirm it: its verdict is {}",
            stated.verdict
        ));
    }
    let mut verifier = Verifier::new(&state.sheet, frame, &stated);
    verifier.claim(order, &|triangle| triangle);
    let verification = verifier.finish();
    if let Some(refuted) = verification.refuted.first() {
        let (found, stated) = (&refuted.found, &refuted.stated);
        return Err(format!("the second proof finds {found} instead of {stated}"));
    }
    match verification.unproved.first() {
        None => Ok(()),
        Some(open) => {
            let [f, g] = open.faces.map(|face| state.sheet.face_facets[face as usize]);
            Err(format!("the second proof leaves open, of facets {f} and {g}: {}", open.what))
        }
    }
}
