//! The report: `report.json` and the table on the terminal.

use std::fmt::Write as _;

use foldmotion_geometry::Number;
use foldmotion_pattern::{CompactBox, SkinPlane, Unit};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::certificate::StoppedEntry;
use crate::results::Published;

pub use crate::fold_angles::FoldAngleReport;
pub use crate::imported_report::ImportReport;
pub use crate::outcome::{Outcome, OutcomeKind};
pub use crate::stop_report::StopReport;
pub use crate::symmetry::{Mirror, SymmetryReport};

/// `report.json`. Lengths are in `length_unit`, angles in degrees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "foldmotion report")]
pub struct Report {
    /// Title of the scene.
    pub title: String,
    /// Version of foldmotion.
    pub version: String,
    /// How the motion ended.
    pub outcome: Outcome,
    /// FOLD's name of the unit of length.
    pub length_unit: String,
    /// E, T, S, SII or plain; where rows of unequal height have several, joined by `+`. Null for an imported pattern, as
    /// are rows, columns, unit, profile, division, unfold.
    pub case: Option<String>,
    /// Nr.
    pub rows: Option<usize>,
    /// Nc.
    pub columns: Option<usize>,
    /// The unit.
    pub unit: Option<UnitReport>,
    /// The imported pattern; null for a sheet of units.
    pub import: Option<ImportReport>,
    /// The curve Γ.
    pub profile: Option<ProfileReport>,
    /// Height and case of each row where they differ; null where all rows are equal.
    pub unequal_rows: Option<Vec<RowReport>>,
    /// The sheet folded like a map; null where it folds unit by unit.
    pub map: Option<MapReport>,
    /// The division of Γ.
    pub division: Option<DivisionReport>,
    /// The crease pattern.
    pub pattern: PatternReport,
    /// Equations 3 to 7; null where the case has no closed form.
    pub closed_form: Option<BoxReport>,
    /// The compact state reached.
    pub compact: CompactReport,
    /// How close the creases came to the end of the motion.
    pub fold_angles: FoldAngleReport,
    /// How well the motion keeps the mirror symmetries of the sheet; empty where it has none, and for an imported pattern.
    pub symmetry: Vec<SymmetryReport>,
    /// How stage unfold moves the row creases.
    pub unfold: Option<UnfoldReport>,
    /// The stages of the motion.
    pub stages: Vec<StageReport>,
    /// Where contact stopped the motion; null where it did not.
    pub jam: Option<JamReport>,
    /// What ended the motion before its end; null where it was run to its end. A motion that stopped where layers push is
    /// jammed too.
    pub stop: Option<StopReport>,
    /// The verdict.
    pub collision: CollisionSection,
    /// The recorded path, between whose frames the verdict takes straight lines.
    pub path: PathReport,
    /// The engine; its timings and device are all that may differ between two runs of one scene.
    pub engine: EngineReport,
    /// Seconds a part of the run took.
    pub seconds: SecondsReport,
    /// The files written beside this report.
    pub files: Vec<String>,
    /// What became of other files in the folder; not part of report.json.
    #[serde(skip)]
    pub published: Published,
}

/// A row of its own height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RowReport {
    /// E, T, S or SII.
    pub case: String,
    /// Its h.
    pub height: f64,
}

/// A sheet folded like a map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MapReport {
    /// Nr·Nc.
    pub layers: usize,
    /// Height of the stack, layers times `material.thickness`; null where the sheet has no thickness.
    pub stack_height: Option<f64>,
    /// The box of the same sheet folded unit by unit; null where it has no closed form.
    pub waterbomb: Option<BoxReport>,
}

/// The unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnitReport {
    /// w.
    pub width: f64,
    /// h; the mean where rows differ.
    pub height: f64,
    /// a, the width of a flap.
    pub flap: f64,
    /// s, the width of a side pad.
    pub side_pad: f64,
    /// 2d, the width of the centre pad.
    pub centre_pad: f64,
}

/// The curve Γ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ProfileReport {
    /// Where it comes from: the source of a built-in profile, or the key or file of the scene.
    pub source: String,
    /// Whether it returns to its start.
    pub closed: bool,
}

/// Distances of Γ from the divided polygon.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FitReport {
    /// The largest.
    pub largest: f64,
    /// The mean over the length of Γ.
    pub mean: f64,
}

/// The division of Γ (equations 1 and 2).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DivisionReport {
    /// How.
    pub method: String,
    /// |R_max|.
    pub max_residual: f64,
    /// |R_ave|.
    pub mean_residual: f64,
    /// How far Γ is from the polygon.
    pub fit: FitReport,
    /// Iterations made.
    pub iterations: usize,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// The divided polygon, (x, z).
    pub points: Vec<[f64; 2]>,
}

/// The pattern check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PatternReport {
    /// Whether the angles around every interior vertex sum to 360°.
    pub developable: bool,
    /// Whether every interior vertex has an even number of creases and alternate angles that sum to 180°.
    pub flat_foldable: bool,
    /// Vertices of the sheet.
    pub vertex_count: usize,
    /// Facets of the crease pattern.
    pub facet_count: usize,
    /// Triangles of the sheet as computed.
    pub face_count: usize,
    /// Interior vertices by type and number of creases.
    pub vertices: Vec<VertexReport>,
}

/// Interior vertices of one type.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VertexReport {
    /// I, J, K, split, pad or grid; imported.
    #[serde(rename = "type")]
    pub kind: String,
    /// Creases that meet there.
    pub degree: usize,
    /// How many there are.
    pub count: usize,
    /// Mountain creases minus valley creases: +2 or −2 where a vertex folds flat (Maekawa).
    pub mountains_minus_valleys: i32,
    /// Sum of the sector angles, degrees.
    pub angle_sum_deg: f64,
    /// Sums of every other sector angle, degrees, the smaller first; null for an odd number of creases.
    pub alternate_sums_deg: Option<[f64; 2]>,
    /// Whether all are developable.
    pub developable: bool,
    /// Whether all are flat-foldable.
    pub flat_foldable: bool,
}

/// A bounding box.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BoxReport {
    /// Along the growing direction, the width, the flaps.
    pub extents: [f64; 3],
    /// x·z.
    pub area: f64,
    /// x·y·z.
    pub volume: f64,
}

impl MapReport {
    /// Its line in the table.
    fn line(&self, unit: &str) -> String {
        let mut line = format!("map          {} layers", self.layers);
        // Writing into a string cannot fail.
        if let Some(height) = self.stack_height {
            let _ = write!(line, ", {height:.6} {unit} high");
        }
        if let Some(BoxReport {
            extents: [x, y, z], ..
        }) = &self.waterbomb
        {
            let _ = write!(
                line,
                "; folded unit by unit {x:.6} x {y:.6} x {z:.6} {unit}"
            );
        }
        line
    }
}

impl From<&Unit> for UnitReport {
    fn from(unit: &Unit) -> Self {
        Self {
            width: unit.width,
            height: unit.height,
            flap: unit.flap,
            side_pad: unit.side_pad,
            centre_pad: unit.centre_pad,
        }
    }
}

impl From<CompactBox> for BoxReport {
    fn from(b: CompactBox) -> Self {
        Self {
            extents: b.extents,
            area: b.area,
            volume: b.volume,
        }
    }
}

/// The compact state reached, beside the exact one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CompactReport {
    /// Measured after the rigid motion that best fits the exact compact state; of an imported pattern along its
    /// principal axes, from the longest spread to the shortest.
    pub extents: [f64; 3],
    /// x·z.
    pub area: f64,
    /// x·y·z.
    pub volume: f64,
    /// Root mean square distance of the vertices to the exact compact state, in units of h; null for an
    /// imported pattern.
    pub rms_to_exact: Option<f64>,
    /// Against the closed form; null where the case has none.
    pub relative_error: Option<ErrorReport>,
    /// Why the box differs from the closed form, where an extent does by more than a hundredth (of h where the closed form
    /// is 0).
    pub explanation: Option<String>,
    /// What touches the two skin planes, after the same rigid motion; null where the case has none.
    pub skin: Option<SkinReport>,
}

/// What a compact sheet touches its skin planes with: the upper one, where the boundary vertices lie, and the lower
/// one, a below it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SkinReport {
    /// A vertex lies on a plane within this distance, in units of the flap width a.
    pub tolerance: f64,
    /// Measured.
    pub upper: SkinPlaneReport,
    /// Measured.
    pub lower: SkinPlaneReport,
    /// Of the exact compact state.
    pub exact_upper: SkinPlaneReport,
    /// Of the exact compact state.
    pub exact_lower: SkinPlaneReport,
}

/// What lies on a skin plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SkinPlaneReport {
    /// Facets in the plane.
    pub facets: usize,
    /// Edges in the plane beside those facets.
    pub edges: usize,
    /// Vertices in the plane beside those facets and edges.
    pub vertices: usize,
    /// Area of the facets.
    pub area: f64,
    /// That area over x·y of the compact box in closed form; 0 where the box is flat.
    pub share: f64,
}

impl From<SkinPlane> for SkinPlaneReport {
    fn from(plane: SkinPlane) -> Self {
        let SkinPlane {
            facets,
            edges,
            vertices,
            area,
            share,
        } = plane;
        Self {
            facets,
            edges,
            vertices,
            area,
            share,
        }
    }
}

/// Differences to the closed form, each divided by it or, where it is 0, by h, h², h³.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ErrorReport {
    /// Of the three extents.
    pub extents: [f64; 3],
    /// Of the area.
    pub area: f64,
    /// Of the volume.
    pub volume: f64,
}

/// How stage unfold moves the row creases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnfoldReport {
    /// uniform or energy.
    pub method: String,
    /// uniform, energy or auto.
    pub asked: String,
    /// Whether the divided profile was proved not to cross itself on this path.
    pub certified: bool,
    /// Where uniform scaling makes it cross itself first, as a share of the stage; null where it does not or was not looked at.
    pub crosses_at: Option<f64>,
    /// Steps of the descent that found the path; null where uniform.
    pub steps: Option<usize>,
    /// Straight pieces the path has been thinned to; null where uniform.
    pub pieces: Option<usize>,
}

/// What happened in a stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageReport {
    /// unfold or fold.
    pub name: String,
    /// Largest |l/l0 − 1| of all edges and frames.
    pub peak_strain: f64,
    /// Motion time of the largest strain.
    pub peak_strain_t: f64,
    /// Mean |l/l0 − 1| over edges and frames.
    pub mean_strain: f64,
    /// Largest bend of a facet, degrees.
    pub peak_facet_bending_deg: f64,
    /// Motion time of the largest bend.
    pub peak_facet_bending_t: f64,
    /// Largest energy of each kind at any frame.
    pub peak_energy: EnergyReport,
    /// Pairs of primitives that push on each other, at most at any frame.
    pub most_contacts: usize,
    /// Whether the stage was run to its end in equilibrium.
    pub converged: bool,
    /// Motion time of its last state.
    pub reached_t: f64,
    /// Largest unbalanced force left, over the fold stiffness.
    pub residual: f64,
    /// Steps of the dynamic engine, Newton iterations of the quasi-static one.
    pub steps: u64,
    /// Load steps of the quasi-static engine.
    pub load_steps: Option<u64>,
    /// Load steps that found no equilibrium and were tried again shorter.
    pub shortened_load_steps: Option<u64>,
}

/// Energy by kind, in units of EA·h at EA = 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EnergyReport {
    /// Of the bars.
    pub bars: f64,
    /// Of the creases.
    pub creases: f64,
    /// Of the facet hinges.
    pub facets: f64,
    /// Of the angles of the triangles.
    pub face_angles: f64,
    /// Of the contact barriers.
    pub contact: f64,
}

/// Contact stopped the motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JamReport {
    /// From this motion time on the creases do not follow their targets.
    pub t: f64,
    /// Largest difference of a fold angle from its target where the motion ended, degrees.
    pub fold_angle_error_deg: f64,
    /// Pairs of facets that push hardest, hardest first; at most ten.
    pub facets: Vec<[u32; 2]>,
    /// Their units; none for an imported pattern.
    pub units: Vec<[UnitName; 2]>,
    /// Those facets in words.
    pub names: Vec<[String; 2]>,
}

/// The verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CollisionSection {
    /// free, touching, penetrating or undecided.
    pub verdict: String,
    /// τ, in units of h; of an imported pattern, as all lengths said to be in units of h, of its mean edge.
    pub tolerance: f64,
    /// The first penetration; null where there is none.
    pub first: Option<PenetrationReport>,
    /// The first penetration between two facets of one unit, which no path of its neighbours avoids; null where there
    /// is none.
    pub first_within_unit: Option<PenetrationReport>,
    /// Where the check ended early, as `check.stop_at` says: nothing is said of the frames after; null where all were
    /// judged.
    pub stopped: Option<StoppedEntry>,
    /// Pairs of facets (triangles) that penetrate somewhere.
    pub penetrating_pairs: usize,
    /// Pairs of facets (triangles) that touch somewhere, or were not shown to keep apart.
    pub touching_pairs: usize,
    /// Pairs of facets (triangles) that could not be decided.
    pub undecided_pairs: usize,
    /// Smallest distance of facets that share no vertex, in units of h.
    pub min_separation: Option<f64>,
    /// Motion time of the smallest distance.
    pub min_separation_t: Option<f64>,
    /// Pairs of triangles tested over intervals between frames.
    pub pairs_tested: u64,
    /// What decided the pairs, counted once an interval.
    pub decided_by: DecidedBy,
}

/// What decided the pairs of triangles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DecidedBy {
    /// The swept boxes lie apart.
    pub boxes: u64,
    /// One axis at rest separates, or the fold angle of a hinge keeps its sign.
    pub axis_at_rest: u64,
    /// Axes that turn along separate.
    pub turning_axis: u64,
    /// All axes were tried.
    pub search: u64,
    /// Share of the pairs that boxes, axes at rest and axes that turn along decided, so that not all axes had to be tried.
    pub share_without_search: f64,
}

/// A penetration, where it begins.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PenetrationReport {
    /// Motion time.
    pub t: f64,
    /// unfold or fold.
    pub stage: String,
    /// What went through what.
    pub kind: String,
    /// The two facets of the crease pattern.
    pub facets: [u32; 2],
    /// The two triangles.
    pub faces: [u32; 2],
    /// The vertices of the features that meet.
    pub vertices: Vec<u32>,
    /// The names the paper gives those vertices in the units below, where it names them.
    pub vertex_names: Vec<Option<String>>,
    /// The units of the two facets; null for an imported pattern.
    pub units: Option<[UnitName; 2]>,
    /// Where.
    pub point: [f64; 3],
    /// How deep the two overlap there, in units of h.
    pub depth: f64,
}

/// A unit by row, column and the paper's name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnitName {
    /// From 0.
    pub row: u32,
    /// From 0.
    pub column: u32,
    /// U^O or U^E.
    pub name: String,
}

/// The recorded path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PathReport {
    /// Frames recorded.
    pub frames: usize,
    /// Motion time of the last one.
    pub end_t: f64,
    /// How often the engine ran again because the verdict was open between frames.
    pub refinements: usize,
    /// Frames asked for between the first ones by these runs.
    pub added_frames: usize,
    /// How far a straight path between frames strays from the computed motion at most, in units of h: estimated from
    /// second differences of the frames; null where a stage has too few of them.
    pub straying: Option<f64>,
    /// Motion time of the frame after which it strays furthest.
    pub straying_t: Option<f64>,
}

/// The engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EngineReport {
    /// dynamic or quasi-static.
    pub name: String,
    /// Closest approach of layers, units of h; null without contact.
    pub contact_gap: Option<f64>,
    /// Steps of all stages.
    pub steps: u64,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// Threads it could use.
    pub threads: usize,
    /// What it ran on: cpu, or the name of the GPU.
    pub device: String,
    /// The processor, and the f64 numbers its vectors hold.
    pub instruction_set: String,
}

/// Wall-clock seconds of the parts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SecondsReport {
    /// Strain, box and collisions.
    pub check: f64,
    /// Films and files.
    pub record: f64,
    /// Everything.
    pub total: f64,
}

impl SecondsReport {
    /// Of a report that tells none.
    pub(crate) const NONE: Self = Self {
        check: 0.0,
        record: 0.0,
        total: 0.0,
    };
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

    /// The table for the terminal.
    pub fn table(&self) -> String {
        let mut out = String::new();
        let unit = &self.length_unit;
        // Writing into a string cannot fail.
        let _ = writeln!(out, "{}\n\n{}", self.outcome.line(), self.title);
        self.write_subject(&mut out);
        let _ = writeln!(
            out,
            "pattern: {}developable, {}flat-foldable; {} vertices, {} facets",
            if self.pattern.developable { "" } else { "not " },
            if self.pattern.flat_foldable {
                ""
            } else {
                "not "
            },
            self.pattern.vertex_count,
            self.pattern.facet_count
        );
        self.write_box(&mut out);
        if let Some(map) = &self.map {
            let _ = writeln!(out, "{}", map.line(unit));
        }
        let _ = writeln!(
            out,
            "\nstage    peak strain   mean strain   facet bending   converged   residual"
        );
        for s in &self.stages {
            let _ = writeln!(
                out,
                "{:<8} {:>10.3} %  {:>10.4} %  {:>11.2} deg   {:<9}   {:.2}",
                s.name,
                s.peak_strain * 100.0,
                s.mean_strain * 100.0,
                s.peak_facet_bending_deg,
                if s.converged { "yes" } else { "no" },
                Number(s.residual)
            );
        }
        let _ = writeln!(out, "{}", self.fold_angles.words());
        for symmetry in &self.symmetry {
            let _ = writeln!(out, "{}", symmetry.line());
        }
        let _ = writeln!(
            out,
            "strain is |l/l0 - 1|: its peak over the edges and frames of a stage, its mean over both; residual is the \
             largest unbalanced force left"
        );
        if let Some(stop) = &self.stop {
            let _ = writeln!(out, "{}", stop.line());
        }
        self.write_verdict(&mut out);
        self.write_path(&mut out);
        let e = &self.engine;
        let _ = writeln!(
            out,
            "engine {}: {} steps in {:.2} s, {} thread(s), {}; check {:.2} s, record {:.2} s",
            e.name,
            e.steps,
            e.seconds,
            e.threads,
            e.device,
            self.seconds.check,
            self.seconds.record
        );
        out
    }

    /// What is folded.
    fn write_subject(&self, out: &mut String) {
        let unit = &self.length_unit;
        if let Some(import) = &self.import {
            out.push_str(&import.lines(unit));
        }
        if let (Some(case), Some(rows), Some(columns), Some(of_unit), Some(division)) = (
            &self.case,
            self.rows,
            self.columns,
            self.unit,
            &self.division,
        ) {
            let _ = writeln!(
                out,
                "case {case}, {rows} x {columns} units, w = {:.6} {unit}, h = {:.6} {unit}; rows equal to |R_max| = {:.2} after {} iterations",
                Number(of_unit.width),
                Number(of_unit.height),
                Number(division.max_residual),
                division.iterations
            );
        }
        if let Some(unfold) = &self.unfold {
            let _ = writeln!(out, "{}", unfold.line());
        }
    }

    /// The unit of tolerances and separations.
    fn tolerance_unit(&self) -> &'static str {
        if self.import.is_some() {
            "mean edges"
        } else {
            "h"
        }
    }

    fn write_box(&self, out: &mut String) {
        let unit = &self.length_unit;
        let title = if self.outcome.is_at_end() {
            "compact box".to_owned()
        } else {
            format!("at t={:.4}", self.path.end_t)
        };
        let _ = writeln!(
            out,
            "\n{title:<18} x            y            z            area         volume"
        );
        let row = |name: &str, extents: [f64; 3], area: f64, volume: f64| {
            let mut line = format!("{name:<12}");
            for value in extents.into_iter().chain([area, volume]) {
                let _ = write!(line, " {value:>12.6}");
            }
            line
        };
        let c = &self.compact;
        let _ = writeln!(
            out,
            "{}  ({unit})",
            row("measured", c.extents, c.area, c.volume)
        );
        if let Some(f) = &self.closed_form {
            let _ = writeln!(out, "{}", row("closed form", f.extents, f.area, f.volume));
        } else if self.import.is_none() {
            let _ = writeln!(out, "closed form  none for an unmodified rectangle");
        }
        if let Some(e) = &c.relative_error {
            let mut line = format!("{:<12}", "error");
            for value in e.extents.into_iter().chain([e.area, e.volume]) {
                let _ = write!(line, " {:>12}", format!("{:.2}", Number(value)));
            }
            let _ = writeln!(out, "{line}");
            let absolute = [("x", 0), ("y", 1), ("z", 2)].map(|(name, axis)| {
                let is_flat = self.closed_form.is_some_and(|f| f.extents[axis] == 0.0);
                if is_flat { name } else { "" }
            });
            if absolute.concat() != "" {
                let _ = writeln!(
                    out,
                    "(errors of {} and what is made of it are absolute, in h, h\u{b2}, h\u{b3}: the closed form is 0)",
                    absolute.concat()
                );
            }
        }
        if let Some(words) = &c.explanation {
            let _ = writeln!(out, "{words}");
        }
        if let Some(rms) = c.rms_to_exact {
            let _ = writeln!(
                out,
                "vertices lie {:.2} h (rms) from the exact compact state",
                Number(rms)
            );
        }
    }

    fn write_path(&self, out: &mut String) {
        let p = &self.path;
        let refined = match p.refinements {
            0 => String::new(),
            n => format!(
                ", {} of them added in {n} further run(s) to decide between frames",
                p.added_frames
            ),
        };
        let straying = match (p.straying, p.straying_t) {
            (Some(stray), Some(t)) => format!(
                "straight paths between them stray from the computed motion by about {:.2} {} at most (t = {t:.4})",
                Number(stray),
                self.tolerance_unit()
            ),
            _ => {
                "how far straight paths between them stray is not known: too few frames".to_owned()
            }
        };
        let _ = writeln!(out, "{} frames{refined}; {straying}", p.frames);
    }

    /// Which part of the motion the verdict is about, where it is not all of it.
    fn part_judged(&self) -> &'static str {
        match self.outcome.kind {
            OutcomeKind::Jammed | OutcomeKind::Stopped => " of the motion as far as it came",
            _ => "",
        }
    }

    fn write_verdict(&self, out: &mut String) {
        let c = &self.collision;
        let h = self.tolerance_unit();
        let _ = writeln!(
            out,
            "\ncollisions{}: {} (tolerance {} {h}; {} pairs tested; {} touch, {} penetrate)",
            self.part_judged(),
            c.verdict,
            Number(c.tolerance),
            c.pairs_tested,
            c.touching_pairs,
            c.penetrating_pairs
        );
        if let Some(stopped) = &c.stopped {
            let _ = writeln!(out, "{}", stopped.line());
        }
        if let (Some(d), Some(t)) = (c.min_separation, c.min_separation_t) {
            let _ = writeln!(
                out,
                "smallest separation of facets that share no vertex: {:.4} {h} at t = {t:.4}",
                Number(d)
            );
        }
        if let Some(first) = &c.first {
            let _ = writeln!(out, "first at {}", first.line(h));
        }
        if let Some(within) = c
            .first_within_unit
            .as_ref()
            .filter(|w| c.first.as_ref() != Some(w))
        {
            let _ = writeln!(out, "first within one unit at {}", within.line(h));
        }
    }
}

impl UnfoldReport {
    /// A line for the terminal.
    fn line(&self) -> String {
        let certified = if self.certified {
            "the profile is proved not to cross itself"
        } else {
            "not proved free of crossings"
        };
        let crosses = self.crosses_at.map_or_else(String::new, |share| {
            format!(" (uniform scaling crosses at t = {share:.4})")
        });
        format!("unfold: {}, {certified}{crosses}", self.method)
    }
}

impl JamReport {
    /// What blocks, in words.
    pub(crate) fn words(&self) -> String {
        let pairs = self
            .names
            .iter()
            .take(3)
            .map(|[a, b]| format!("{a} on {b}"));
        let pairs = pairs.collect::<Vec<_>>().join(", ");
        format!("facets that push hardest: {pairs}")
    }
}

impl PenetrationReport {
    /// A line for the terminal; `h`: the unit of the depth.
    fn line(&self, h: &str) -> String {
        let unit = |side: usize| {
            let unit = self.units.as_ref().map(|pair| &pair[side]);
            unit.map_or_else(String::new, |u| {
                format!(" ({} row {} column {})", u.name, u.row, u.column)
            })
        };
        let names: Vec<&str> = self
            .vertex_names
            .iter()
            .flatten()
            .map(String::as_str)
            .collect();
        format!(
            "t = {:.5} ({}): {}, facets {}{} and {}{}, vertices {:?}{}, depth {:.2} {h}",
            self.t,
            self.stage,
            self.kind,
            self.facets[0],
            unit(0),
            self.facets[1],
            unit(1),
            self.vertices,
            if names.is_empty() {
                String::new()
            } else {
                format!(" ({})", names.join(", "))
            },
            Number(self.depth)
        )
    }
}
