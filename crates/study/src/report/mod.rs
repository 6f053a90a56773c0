//! The report: `report.json` and the table on the terminal.

mod collision;
mod compact;
mod imported;
mod motion;
mod sheet;
mod table;
mod thick;

use foldmotion_pattern::UnitSheet;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::results::Published;
use crate::{Study, VERSION};

pub use self::collision::{CollisionSection, DecidedBy, PenetrationReport};
pub use self::compact::{BoxReport, CompactReport, ErrorReport, SkinPlaneReport, SkinReport};
pub use self::imported::ImportReport;
use self::motion::stage_report;
pub use self::motion::{EnergyReport, EngineReport, SecondsReport, SnapReport, StageReport};
pub use self::sheet::{
    DivisionReport, FitReport, MapReport, PatternReport, ProfileReport, RowReport, UnfoldReport,
    UnitReport, VertexReport,
};
use self::sheet::{division_report, profile_report, row_reports, unfold_report};
pub use crate::compute::fold_angles::FoldAngleReport;
use crate::compute::folded::Folded;
pub use crate::compute::jam::JamReport;
pub use crate::compute::layers::{LayerOrderReport, LayerProofName};
pub use crate::compute::outcome::{Outcome, OutcomeKind};
pub use crate::compute::path::PathReport;
pub use crate::compute::stop::{StopCause, StopReport};
pub use crate::compute::symmetry::{Mirror, SymmetryReport};
pub use crate::resolve::flat_folding::FlatFoldingFault;
pub use crate::resolve::mending::{DroppedCreaseReport, MendingReport};
pub use crate::resolve::names::UnitName;

/// `report.json`. Lengths are in `length_unit`, angles in degrees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "foldmotion report")]
pub struct Report {
    /// The title of the scene, or of the pattern.
    pub title: String,
    /// The version of foldmotion that made the report.
    pub version: String,
    /// How the motion ended, with the reason.
    pub outcome: Outcome,
    /// FOLD's name of the unit of length.
    pub length_unit: String,
    /// E, T, S, SII or plain; if rows of unequal height have several cases, joined by `+`. Null for an imported
    /// pattern, as are rows, columns, unit, profile, division and unfold.
    pub case: Option<String>,
    /// Nr, the number of rows of units.
    pub rows: Option<usize>,
    /// Nc, the number of columns of units.
    pub columns: Option<usize>,
    /// The sizes of the unit, in `length_unit`.
    pub unit: Option<UnitReport>,
    /// The imported pattern; null for a sheet of units.
    pub import: Option<ImportReport>,
    /// The curve Γ that the sheet approximates.
    pub profile: Option<ProfileReport>,
    /// Height and case of each row if they differ; null if all rows are equal.
    pub unequal_rows: Option<Vec<RowReport>>,
    /// The sheet folded like a map; null if it folds unit by unit.
    pub map: Option<MapReport>,
    /// The division of Γ into the segments of the rows.
    pub division: Option<DivisionReport>,
    /// The crease pattern: counts, developability, flat-foldability.
    pub pattern: PatternReport,
    /// The compact box by equations 3 to 7; null if the case has no closed form.
    pub closed_form: Option<BoxReport>,
    /// The closed form with the thickness of the layers that meet along each axis; null without material.thickness. Then
    /// the errors of compact are those from this box.
    #[serde(default)]
    pub thick_closed_form: Option<BoxReport>,
    /// The compact state that the motion reached.
    pub compact: CompactReport,
    /// How close the creases came to their targets at the end of the motion.
    pub fold_angles: FoldAngleReport,
    /// How well the motion keeps the mirror symmetries of the sheet; empty if it has none, and for an imported
    /// pattern.
    pub symmetry: Vec<SymmetryReport>,
    /// How stage unfold flattens the profile.
    pub unfold: Option<UnfoldReport>,
    /// The stages of the motion, in order of time.
    pub stages: Vec<StageReport>,
    /// Where contact stopped the motion; null if it did not.
    pub jam: Option<JamReport>,
    /// What ended the motion before its end; null if it was computed to its end. A motion that stopped where layers
    /// push on each other has `jam` too.
    pub stop: Option<StopReport>,
    /// The flat state of an imported pattern, found without a motion, if the pattern is to fold flat and its motion ended
    /// short of that; null otherwise.
    #[serde(default)]
    pub layer_order: Option<LayerOrderReport>,
    /// The verdict of the collision check.
    pub collision: CollisionSection,
    /// The recorded path: the verdict takes straight lines between its frames.
    pub path: PathReport,
    /// The engine that computed the motion. Its timings and its device are all that may differ between two runs of
    /// the same scene.
    pub engine: EngineReport,
    /// How many seconds each part of the run took.
    pub seconds: SecondsReport,
    /// The names of the files written in addition to this report.
    pub files: Vec<String>,
    /// What happened to other files in the folder; not part of report.json.
    #[serde(skip)]
    pub published: Published,
}

impl Report {
    /// The exit status, that of the outcome.
    pub fn status(&self) -> u8 {
        self.outcome.status()
    }

    /// The text of `report.json`.
    pub fn to_json(&self) -> String {
        // Strings, numbers and lists always serialise.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }
}

impl Study {
    /// The report of `folded` before any files are written.
    pub fn report_of(&self, folded: &Folded) -> Report {
        let seconds = SecondsReport {
            check: folded.check_seconds,
            record: 0.0,
            total: folded.duration().as_secs_f64(),
        };
        self.report(folded, seconds, &[])
    }

    pub(crate) fn report(
        &self,
        folded: &Folded,
        seconds: SecondsReport,
        files: &[String],
    ) -> Report {
        let units = self.subject.units();
        let sheet = units.map(|study| &study.units);
        let Folded { computed, findings, .. } = folded;
        let fold_angles = folded.fold_angles;
        let thick = self.thick_closed_form();
        let last = folded.motion.frames.last();
        let mut compact = self.compact_report(&folded.compact, thick.as_ref(), last);
        compact.explanation =
            compact.explanation(&folded.outcome, &fold_angles, computed.gap_reached);
        Report {
            title: self.title.clone(),
            version: VERSION.to_owned(),
            outcome: folded.outcome.clone(),
            length_unit: self.unit_name.to_owned(),
            case: sheet.map(UnitSheet::case_name),
            rows: sheet.map(|sheet| sheet.rows),
            columns: sheet.map(|sheet| sheet.columns),
            unit: sheet.map(|sheet| UnitReport::from(&sheet.unit)),
            import: self.subject.imported().map(ImportReport::new),
            unequal_rows: sheet.and_then(row_reports),
            map: sheet.and_then(|sheet| self.map_report(sheet)),
            profile: units.map(profile_report),
            division: units.map(division_report),
            pattern: self.pattern_report(),
            closed_form: self.subject.closed_form().map(BoxReport::from),
            thick_closed_form: thick,
            compact,
            unfold: units.map(|study| unfold_report(&study.unfolding)),
            stages: computed.stages.iter().map(|s| stage_report(s, &findings.series)).collect(),
            fold_angles,
            symmetry: folded.symmetry.clone(),
            jam: folded.jam.clone(),
            stop: folded.stop,
            layer_order: folded.layer_order.clone(),
            collision: self.collision_section(&findings.collision),
            path: folded.path,
            engine: EngineReport {
                name: self.engine,
                contact_gap: self.contact.map(|contact| contact.gap),
                final_gap: computed.gap_reached,
                steps: computed.steps,
                seconds: folded.engine_seconds,
                threads: folded.threads,
                device: computed.device.clone(),
                instruction_set: foldmotion_solver::dynamic::instruction_set(),
            },
            seconds,
            files: files.to_vec(),
            published: Published::default(),
        }
    }
}
