//! Scene file → study → run → results: the only place that knows the order of the steps.
//!
//! | module | contains |
//! |---|---|
//! | [`scene`] | the scene file as data, exactly as the user wrote it |
//! | `resolve` | from a scene to a [`Study`], or to an error that names the line |
//! | `compute` | fold, check and refine: from a study to a [`Folded`] motion |
//! | [`report`] | `report.json` and the table on the terminal |
//! | [`certificate`] | checks a motion file, writes its certificate and verifies it |
//! | `recording` | films, figures, 3D models and pages of a motion |
//! | `results` | the output folder |
//! | `run` | all steps, from a study to a folder of results |
//!
//! Each module uses only those above it. [`Study::run`] folds, checks, reports and records; [`Study::compute`] folds and checks
//! without writing files.
//!
//! ```
//! use std::path::Path;
//!
//! use foldmotion_study::{SceneSource, Study};
//!
//! let text = "[profile]\nmodel = \"shelter\"\n[sheet]\nrows = 2\ncolumns = 1\n[motion]\ncontact = false\nframes = 8\n";
//! let source = SceneSource::new(Path::new("scene.toml"), text.to_owned());
//! let study = Study::resolve(&source)?;
//! let folded = study.compute(&|_, _| true)?;
//! assert_eq!(folded.findings.collision.verdict.name(), "touching");
//! assert_eq!(folded.outcome.headline(), "folded");
//! # Ok::<(), foldmotion_study::StudyError>(())
//! ```

pub mod certificate;
mod compute;
mod digest;
mod draft;
mod error;
mod folded_pattern;
mod input_file;
mod opened;
mod pattern_files;
mod progress;
mod recording;
pub mod report;
mod resolve;
mod results;
mod run;
pub mod scene;
mod schema;

pub use certificate::Certificate;
pub use certificate::check_file::{CheckOptions, check_file};
pub use certificate::checked::CheckedFile;
pub use certificate::verify_file::{VerifiedCertificate, verify_file};
pub use compute::folded::{Findings, Folded};
pub use compute::preview::Preview;
pub use compute::series::FrameFigures;
pub use digest::sha256;
pub use draft::{Draft, UnitDraft};
pub use error::StudyError;
pub use foldmotion_pattern::{
    CutError, CutOptions, PaperSize, ProfileModel, models, parse_millimetres,
};
pub use foldmotion_solver::Snapshot;
pub use foldmotion_solver::dynamic::Device;
pub use input_file::require_file;
pub use opened::{OpenedFile, OpenedMotion};
pub use pattern_files::{
    PatternFormat, PatternOptions, PatternScale, PatternStudy, PatternSubject,
};
pub use progress::{Phase, Progress, Watch};
pub use recording::{MotionRecord, Quantity, Reproduction, record_file, reproduce_file};
pub use report::Report;
pub use resolve::Study;
pub use resolve::budget::MotionBudget;
pub use resolve::imported::ImportedStudy;
pub use resolve::recording::Recording;
pub use resolve::rows::clash_drawing;
pub use resolve::subject::Subject;
pub use resolve::unfolding::Unfolding;
pub use resolve::units::UnitStudy;
pub use results::{
    Destination, Published, discard_unfinished_results, list_names, process_may_exist,
};
pub use scene::Scene;
pub use scene::source::{FIRST_SCENE, SceneSource};
pub use schema::{certificate_schema, report_schema, scene_schema, schema_text};

/// The version of foldmotion, in FOLD's `file_creator` and in reports.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
