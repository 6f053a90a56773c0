//! Scene file → study → run → results: the only place that knows the order of the steps.
//!
//! A [`SceneSource`] is the text the user wrote, a [`Scene`] what it says, a [`Study`] everything resolved and ready
//! to run; [`Study::run`] folds, checks, reports and records, [`Study::compute`] folds and checks, for whoever shows the
//! [`Folded`] motion.

mod budget;
pub mod certificate;
mod certify;
mod check_file;
mod checked_file;
mod choice;
mod digest;
mod draft;
mod engine;
mod error;
mod exact_array;
mod fold_angles;
mod folded;
mod gap;
mod imported_report;
mod imported_study;
mod input_file;
mod opened;
mod outcome;
pub mod paper;
mod pattern_files;
mod pattern_scene;
mod placement;
mod preview;
mod profile;
mod record_scene;
mod recording;
mod refinement;
pub mod report;
mod reporting;
mod results;
mod rows;
mod run;
pub mod scene;
mod schema;
mod series;
mod source;
mod statement;
mod stop_report;
mod study;
mod subject;
mod symmetry;
#[cfg(test)]
mod symmetry_tests;
mod unfolding;
mod unit_study;
mod verify_file;

pub use budget::MotionBudget;
pub use certificate::Certificate;
pub use check_file::{CheckOptions, check_file};
pub use checked_file::CheckedFile;
pub use draft::{Draft, UnitDraft};
pub use error::StudyError;
pub use folded::{Findings, Folded};
pub use foldmotion_pattern::{
    CutError, CutOptions, PaperSize, ProfileModel, models, parse_millimetres,
};
pub use foldmotion_solver::Snapshot;
pub use foldmotion_solver::dynamic::Device;
pub use imported_study::ImportedStudy;
pub use input_file::require_file;
pub use opened::{Opened, OpenedMotion};
pub use pattern_files::{PatternFormat, PatternOptions, PatternScale, PatternStudy};
pub use preview::Preview;
pub use recording::{Again, MotionRecord, Quantity, Recording, record_again, record_file};
pub use report::Report;
pub use results::{Destination, Published, give_up_results};
pub use rows::draw_clashes;
pub use run::{Phase, Progress, Watch};
pub use scene::Scene;
pub use schema::{certificate_schema, paper_schema, report_schema, scene_schema};
pub use series::FrameFigures;
pub use source::{FIRST_SCENE, SceneSource};
pub use study::Study;
pub use subject::Subject;
pub use unfolding::Unfolding;
pub use unit_study::UnitStudy;
pub use verify_file::{VerifiedCertificate, verify_file};
