//! The targets (Γ, W) of the paper: its profiles in four cases, with W = Nc·h of case E.

use std::path::Path;

use foldmotion_pattern::{Case, ProfileModel, find_model};

use crate::PaperError;
use foldmotion_study::{SceneSource, Study, UnitStudy};

/// The cases of tables and figures.
pub(super) const CASES: [Case; 4] = [Case::E, Case::T, Case::S, Case::SII];

/// λ of case SII (figure 5e).
pub(super) const LAMBDA: f64 = 0.7;

/// A scene of the built-in profile `model` in `case` with the lines `motion` under `[motion]`.
///
/// Rows and columns are those of tables 1 and 2, h = 1, d = w1'/2. Facets are cut along one diagonal, as in Origami Simulator,
/// which the paper uses.
pub(super) fn scene(model: &str, case: Case, motion: &str) -> String {
    let lambda = match case {
        Case::SII => format!("lambda = {LAMBDA}\n"),
        _ => String::new(),
    };
    format!(
        "[profile]\nmodel = \"{model}\"\n[sheet]\ncase = \"{}\"\n{lambda}[material]\nfacet_model = \"one-diagonal\"\n\
         [motion]\n{motion}",
        case.name()
    )
}

/// The study of such a scene.
pub(super) fn study(scene: String) -> Result<Study, PaperError> {
    Ok(Study::resolve(&SceneSource::new(Path::new("paper.toml"), scene))?)
}

/// The sheet of such a scene.
pub(super) fn unit_study(scene: String) -> Result<UnitStudy, PaperError> {
    Ok(UnitStudy::resolve(&SceneSource::new(Path::new("paper.toml"), scene))?)
}

/// The sheet of `model` in `case` with its exact states, without a simulation.
pub(super) fn sheet(model: &str, case: Case) -> Result<UnitStudy, PaperError> {
    unit_study(scene(model, case, ""))
}

/// The inputs of a part about `scene`, as text: the scene and the curve of its profile.
pub(super) fn inputs(model: &str, scene: &str) -> String {
    let model: Option<&ProfileModel> = find_model(model);
    format!("{scene}\n{model:?}")
}
