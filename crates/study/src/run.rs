//! Runs a study: fold, check, report, record.

use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

use foldmotion_check::{
    CollisionReport, FittedBox, Penetration, PenetrationKind, Verdict, bar_strain, collisions,
    facet_bending, fitted_box, relative_error,
};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{FoldHeader, Frame, Motion, UnitSheet};
use foldmotion_record::{FilmOptions, gif};
use foldmotion_solver::Stage;
use foldmotion_solver::dynamic::{self, DynamicOptions, Run, StageOutcome};
use glam::DVec2;

use crate::report::{
    BoxReport, CollisionSection, CompactReport, DivisionReport, EngineReport, ErrorReport,
    PatternReport, PenetrationReport, SecondsReport, StageReport, UnitName, UnitReport,
    VertexReport,
};
use crate::results::{REPORT, Results, write_error};
use crate::scene::OutputChoice;
use crate::{Report, Study, StudyError};

/// A part of a run, as progress names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The engine.
    Fold,
    /// The collision check.
    Check,
    /// Films and files.
    Record,
}

impl Phase {
    /// Its name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Check => "check",
            Self::Record => "record",
        }
    }
}

/// Told how much of a phase is done, from 0 to 1; answers whether to go on.
pub type Progress<'a> = &'a (dyn Fn(Phase, f64) -> bool + Sync);

/// FOLD's `file_creator` and the report's `version` name this.
const VERSION: &str = env!("CARGO_PKG_VERSION");

impl Study {
    /// Folds, checks, reports and records; writes the results into `folder` and returns the report.
    ///
    /// # Errors
    /// [`StudyError`] of the step that failed; the folder is then as it was.
    pub fn run(&self, folder: &Path, progress: Progress<'_>) -> Result<Report, StudyError> {
        let started = Instant::now();
        let mut results = Results::create(folder)?;
        self.require_space(&results)?;
        let (run, engine_seconds) = timed(|| self.fold(progress))?;
        let motion = self.place(&run);
        let (checked, check_seconds) = timed(|| self.check(&motion, progress))?;
        let ((), record_seconds) = timed(|| self.record(&motion, &mut results, progress))?;
        let seconds = SecondsReport {
            check: check_seconds,
            record: record_seconds,
            total: started.elapsed().as_secs_f64(),
        };
        let report = self.report(&run, &checked, engine_seconds, seconds, results.written());
        results.write(REPORT, |out| {
            out.write_all(report.to_json().as_bytes())
                .map_err(|e| write_error(folder, REPORT, e))
        })?;
        results.publish()?;
        Ok(report)
    }

    fn require_space(&self, results: &Results) -> Result<(), StudyError> {
        let available = results.available()?;
        let film = if self.outputs.contains(&OutputChoice::Gif) {
            film_size(&self.film)
        } else {
            0
        };
        let size = |frames| {
            let fold = self.outputs.contains(&OutputChoice::Fold);
            film + if fold {
                Motion::fold_file_size(&self.units.sheet, frames)
            } else {
                0
            }
        };
        let needed = size(self.frames);
        if needed <= available {
            return Ok(());
        }
        let a_frame = (size(self.frames) - size(0))
            .div_ceil(self.frames as u64)
            .max(1);
        let frames = (available.saturating_sub(size(0)) / a_frame) as usize;
        Err(StudyError::DiskTooSmall {
            path: results.folder().to_owned(),
            needed,
            available,
            frames,
        })
    }

    fn fold(&self, progress: Progress<'_>) -> Result<Run, StudyError> {
        let options = DynamicOptions {
            frames: self.frames,
            ..DynamicOptions::default()
        };
        let run = dynamic::run(
            &self.model,
            &self.schedule,
            &self.deployed,
            &options,
            &|t| progress(Phase::Fold, t / 2.0),
        )?;
        Ok(run)
    }

    /// The motion in the frame of the exact compact state: one rigid motion, applied to every frame alike.
    fn place(&self, run: &Run) -> Motion {
        let exact = self.units.compact();
        let fit = match run.frames.last() {
            Some(last) => RigidMotion::best_fit(&last.positions, &exact),
            None => RigidMotion::IDENTITY,
        };
        let mut frames = run.frames.clone();
        for position in frames.iter_mut().flat_map(|f| &mut f.positions) {
            *position = fit.apply(*position);
        }
        Motion {
            sheet: self.units.sheet.clone(),
            frames,
            compact_order: self.units.compact_order(),
        }
    }

    fn check(&self, motion: &Motion, progress: Progress<'_>) -> Result<Checked, StudyError> {
        let collision = collisions(motion, &self.collision, &|done| {
            progress(Phase::Check, done)
        })?;
        let last = motion.frames.last().map_or(&[][..], |f| &f.positions);
        Ok(Checked {
            collision,
            states: states(motion),
            compact: fitted_box(last, &self.units.compact()),
        })
    }

    fn record(
        &self,
        motion: &Motion,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<(), StudyError> {
        for output in &self.outputs {
            match output {
                OutputChoice::Fold => {
                    let folder = results.folder().to_owned();
                    let header = FoldHeader {
                        title: &self.title,
                        creator: &format!("foldmotion {VERSION}"),
                        unit: self.unit_name,
                        target_angles: self.units.compact_angles(),
                    };
                    results.write("motion.fold", |out| {
                        motion
                            .write_fold(&header, out)
                            .map_err(|e| write_error(&folder, "motion.fold", e))
                    })?;
                }
                OutputChoice::Gif => {
                    results.write("motion.gif", |out| {
                        gif(motion, &self.film, out, &|done| {
                            progress(Phase::Record, done)
                        })
                        .map_err(StudyError::from)
                    })?;
                }
            }
        }
        Ok(())
    }

    fn report(
        &self,
        run: &Run,
        checked: &Checked,
        engine_seconds: f64,
        seconds: SecondsReport,
        files: &[&str],
    ) -> Report {
        let unit = &self.units.unit;
        Report {
            title: self.title.clone(),
            version: VERSION.to_owned(),
            length_unit: self.unit_name.to_owned(),
            case: unit.case.name().to_owned(),
            rows: self.units.rows,
            columns: self.units.columns,
            unit: UnitReport {
                width: unit.width,
                height: unit.height,
                flap: unit.flap,
                side_pad: unit.side_pad,
                centre_pad: unit.centre_pad,
            },
            division: DivisionReport {
                method: "equal-length".to_owned(),
                max_residual: self.division.max_residual,
                mean_residual: self.division.mean_residual,
                iterations: self.division.iterations,
                seconds: self.division_seconds,
                points: self.division.points.iter().map(DVec2::to_array).collect(),
            },
            pattern: self.pattern_report(),
            closed_form: self.closed_form.map(BoxReport::from),
            compact: self.compact_report(&checked.compact),
            stages: run
                .stages
                .iter()
                .map(|s| stage_report(s, checked))
                .collect(),
            collision: collision_section(&self.units, &checked.collision),
            engine: EngineReport {
                name: "dynamic".to_owned(),
                steps: run.steps,
                seconds: engine_seconds,
                threads: rayon::current_num_threads(),
                device: "cpu".to_owned(),
                instruction_set: std::env::consts::ARCH.to_owned(),
            },
            seconds,
            files: files.iter().map(|&f| f.to_owned()).collect(),
        }
    }

    fn compact_report(&self, measured: &FittedBox) -> CompactReport {
        let h = self.units.unit.height;
        let error = self.closed_form.map(|closed| {
            let error = relative_error(measured, closed.extents.into(), h);
            ErrorReport {
                extents: error.extents.into(),
                area: error.area,
                volume: error.volume,
            }
        });
        CompactReport {
            extents: measured.extents.into(),
            area: measured.area,
            volume: measured.volume,
            rms_to_exact: measured.rms_to_exact / h,
            relative_error: error,
        }
    }

    fn pattern_report(&self) -> PatternReport {
        let vertices = self.pattern.groups().into_iter().map(|g| VertexReport {
            kind: g.kind.name().to_owned(),
            degree: g.degree,
            count: g.count,
            angle_sum_deg: g.angle_sum.to_degrees(),
            alternate_sums_deg: g.alternate_sums.map(|s| s.map(f64::to_degrees)),
            developable: g.developable,
            flat_foldable: g.flat_foldable,
        });
        PatternReport {
            developable: self.pattern.is_developable(),
            flat_foldable: self.pattern.is_flat_foldable(),
            vertex_count: self.units.sheet.vertices.len(),
            facet_count: self.units.sheet.facets.len(),
            face_count: self.units.sheet.faces.len(),
            vertices: vertices.collect(),
        }
    }
}

/// What was found out about a motion.
struct Checked {
    collision: CollisionReport,
    states: Vec<StateReport>,
    compact: FittedBox,
}

/// Strain and bending of one frame.
struct StateReport {
    time: f64,
    peak_strain: f64,
    mean_strain: f64,
    peak_bending_deg: f64,
}

fn states(motion: &Motion) -> Vec<StateReport> {
    let state = |frame: &Frame| {
        let strain = bar_strain(&motion.sheet, &frame.positions);
        StateReport {
            time: frame.time,
            peak_strain: strain.peak,
            mean_strain: strain.mean,
            peak_bending_deg: facet_bending(&motion.sheet, &frame.positions).peak_deg(),
        }
    };
    motion.frames.iter().map(state).collect()
}

fn stage_report(outcome: &StageOutcome, checked: &Checked) -> StageReport {
    let start = outcome.stage.start_time();
    let within: Vec<&StateReport> = checked
        .states
        .iter()
        .filter(|s| (start..=start + 1.0).contains(&s.time))
        .collect();
    let peak = |value: fn(&StateReport) -> f64| {
        within
            .iter()
            .map(|s| (value(s), s.time))
            .fold((0.0, start), |a, b| if b.0 > a.0 { b } else { a })
    };
    let (peak_strain, peak_strain_t) = peak(|s| s.peak_strain);
    let (peak_facet_bending_deg, peak_facet_bending_t) = peak(|s| s.peak_bending_deg);
    StageReport {
        name: outcome.stage.name().to_owned(),
        peak_strain,
        peak_strain_t,
        mean_strain: within.iter().map(|s| s.mean_strain).sum::<f64>() / within.len().max(1) as f64,
        peak_facet_bending_deg,
        peak_facet_bending_t,
        converged: outcome.is_converged(),
        residual: outcome.residual,
        fold_angle_error_deg: outcome.fold_angle_error.to_degrees(),
        steps: outcome.steps,
    }
}

fn collision_section(units: &UnitSheet, collision: &CollisionReport) -> CollisionSection {
    CollisionSection {
        verdict: match collision.verdict {
            Verdict::Free => "free",
            Verdict::Touching => "touching",
            Verdict::Penetrating => "penetrating",
            Verdict::Undecided => "undecided",
        }
        .to_owned(),
        tolerance: collision.tolerance,
        first: collision
            .first
            .as_ref()
            .map(|p| penetration_report(units, p)),
        first_within_unit: collision
            .penetrations
            .iter()
            .map(|p| penetration_report(units, p))
            .find(|p| p.units[0] == p.units[1]),
        penetrating_pairs: collision.penetrations.len(),
        touching_pairs: collision.touching_pairs,
        undecided_pairs: collision.undecided.len(),
        min_separation: collision.min_separation.map(|s| s.distance),
        min_separation_t: collision.min_separation.map(|s| s.time),
        pairs_tested: collision.pairs_tested.total(),
    }
}

fn penetration_report(units: &UnitSheet, p: &Penetration) -> PenetrationReport {
    let facets = p.faces.map(|f| units.sheet.face_facets[f as usize]);
    let unit_of = |facet: u32| {
        let facet = &units.sheet.facets[facet as usize];
        UnitName {
            row: facet.row,
            column: facet.column,
            name: UnitSheet::unit_name(facet.row).to_owned(),
        }
    };
    let named = facets.map(unit_of);
    let vertex_name = |&v: &u32| {
        named
            .iter()
            .find_map(|u| units.vertex_name(v, u.row, u.column))
    };
    PenetrationReport {
        t: p.time,
        stage: if p.time < 1.0 {
            Stage::Unfold
        } else {
            Stage::Fold
        }
        .name()
        .to_owned(),
        kind: kind_name(p.kind).to_owned(),
        facets,
        faces: p.faces,
        vertex_names: p.vertices.iter().map(vertex_name).collect(),
        vertices: p.vertices.clone(),
        units: named,
        point: p.point.into(),
        depth: p.depth,
    }
}

fn kind_name(kind: PenetrationKind) -> &'static str {
    match kind {
        PenetrationKind::VertexFacet => "vertex through facet",
        PenetrationKind::EdgeEdge => "edge through edge",
        PenetrationKind::FoldedThrough => "folded past a half turn",
        PenetrationKind::AroundVertex => "facets crossing around a shared vertex",
        PenetrationKind::PassedThrough => "facets changing sides",
    }
}

fn timed<T>(work: impl FnOnce() -> Result<T, StudyError>) -> Result<(T, f64), StudyError> {
    let started = Instant::now();
    work().map(|value| (value, started.elapsed().as_secs_f64()))
}

/// Bytes a film takes at most: an eighth of its pixels, where nothing repeats.
fn film_size(film: &FilmOptions) -> u64 {
    let [width, height] = film.size.map(u64::from);
    let still_and_moving = 3.0 + (film.seconds.iter().sum::<f64>() * film.fps).ceil();
    #[expect(
        clippy::cast_sign_loss,
        reason = "the film's options were checked to be positive"
    )]
    let frames = still_and_moving as u64;
    frames * width * height / 8
}
