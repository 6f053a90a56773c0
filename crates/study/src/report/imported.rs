//! An imported pattern in the report.

use foldmotion_pattern::Assignment;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ImportedStudy;
use crate::resolve::mending::MendingReport;

/// An imported crease pattern.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ImportReport {
    /// The file of the pattern, as the scene names it.
    pub file: String,
    /// The part of its fold angles to which the pattern folds, in percent.
    pub fold_percent: f64,
    /// The number of stages given by the frames of the file; 1 if it has none.
    pub stages: usize,
    /// The facet that stays in place; null if none does.
    pub fixed_facet: Option<u32>,
    /// The mean length of its edges in `length_unit`: the unit of tolerances and separations.
    pub mean_edge: f64,
    /// The number of its mountain creases.
    pub mountains: usize,
    /// The number of its valley creases.
    pub valleys: usize,
    /// The number of hinges that nothing drives and nothing holds.
    pub free_hinges: usize,
    /// The number of border edges, including those of cuts and holes.
    pub borders: usize,
    /// V − E + F: 1 for a sheet without holes, one less for each hole or open cut.
    pub euler_characteristic: i64,
    /// What was done about lines that nearly meet, and which creases were left out.
    #[serde(default)]
    pub mending: MendingReport,
    /// What was changed or ignored while the file was read.
    pub warnings: Vec<String>,
}

impl ImportReport {
    pub(crate) fn new(study: &ImportedStudy) -> Self {
        let imported = &study.imported;
        let edges = &imported.sheet.edges;
        let count = |letter| edges.iter().filter(|e| e.assignment == letter).count();
        Self {
            file: study.file.clone(),
            fold_percent: study.fold_percent,
            stages: study.waypoints.len(),
            fixed_facet: study.fixed,
            mean_edge: imported.sheet.unit_length,
            mountains: count(Assignment::Mountain),
            valleys: count(Assignment::Valley),
            free_hinges: count(Assignment::Free),
            borders: count(Assignment::Border),
            euler_characteristic: imported.euler_characteristic(),
            mending: MendingReport::new(&imported.mending),
            warnings: imported.warnings.iter().map(ToString::to_string).collect(),
        }
    }

    /// The lines of the table.
    pub(crate) fn lines(&self, unit: &str) -> String {
        let stages = match self.stages {
            1 => String::new(),
            n => format!(" in {n} stages"),
        };
        let mut lines = format!(
            "pattern of {}, folded by {} %{stages}; mean edge {:.6} {unit}; {} mountain, {} valley and {} border edges, {} free hinges\n",
            self.file,
            self.fold_percent,
            self.mean_edge,
            self.mountains,
            self.valleys,
            self.borders,
            self.free_hinges
        );
        let mending = self.mending.line();
        for warning in mending.iter().chain(&self.warnings) {
            lines.push_str("note: ");
            lines.push_str(warning);
            lines.push('\n');
        }
        lines
    }
}
