//! From a finished run to its report.

use std::collections::BTreeSet;

use foldmotion_check::{
    CollisionReport, FilterCounts, FittedBox, Penetration, Verdict, relative_error,
};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Facet, Frame, Motion, Unit, UnitSheet};
use foldmotion_solver::Stage;
use glam::{DVec2, DVec3};

use crate::certify::stopped;
use crate::engine::{Computed, StageSummary};
use crate::folded::Folded;
use crate::outcome::Parts;
use crate::report::{
    BoxReport, CollisionSection, CompactReport, DecidedBy, DivisionReport, EnergyReport,
    EngineReport, ErrorReport, FitReport, FoldAngleReport, ImportReport, JamReport, MapReport,
    Outcome, PatternReport, PenetrationReport, ProfileReport, RowReport, SecondsReport, SkinReport,
    StageReport, StopReport, SymmetryReport, UnfoldReport, UnitName, UnitReport, VertexReport,
};
use crate::results::Published;
use crate::run::VERSION;
use crate::scene::EngineChoice;
use crate::series::FrameFigures;
use crate::{Report, Study, Unfolding, UnitStudy};

/// A vertex this close to a skin plane, in units of a, lies on it: wide enough for layers that keep a gap.
const SKIN_TOLERANCE: f64 = 0.05;

/// An extent further than this from its closed form is explained: relative, or in h where the closed form is 0.
const LARGE_ERROR: f64 = 0.01;

impl Study {
    pub(crate) fn report(
        &self,
        folded: &Folded,
        seconds: SecondsReport,
        files: &[String],
    ) -> Report {
        let units = self.subject.units();
        let sheet = units.map(|study| &study.units);
        let Folded {
            computed, findings, ..
        } = folded;
        let fold_angles = self.fold_angles(&folded.motion);
        let mut compact = self.compact_report(&folded.compact, folded.motion.frames.last());
        compact.explanation = self.explanation(&compact, &folded.outcome, &fold_angles);
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
            compact,
            unfold: units.map(|study| unfold_report(&study.unfolding)),
            stages: computed
                .stages
                .iter()
                .map(|s| stage_report(s, &findings.series))
                .collect(),
            fold_angles,
            symmetry: units.map_or_else(Vec::new, |_| SymmetryReport::all(&folded.motion)),
            jam: self.jam_report(computed),
            stop: stop_report(computed),
            collision: self.collision_section(&findings.collision),
            path: folded.path,
            engine: EngineReport {
                name: match self.engine {
                    EngineChoice::Dynamic => "dynamic",
                    EngineChoice::QuasiStatic => "quasi-static",
                }
                .to_owned(),
                contact_gap: self.contact_gap,
                steps: computed.steps,
                seconds: folded.engine_seconds,
                threads: rayon::current_num_threads(),
                device: computed.device.clone(),
                instruction_set: foldmotion_solver::dynamic::instruction_set(),
            },
            seconds,
            files: files.to_vec(),
            published: Published::default(),
        }
    }

    /// How a motion ended.
    pub(crate) fn outcome(
        &self,
        computed: &Computed,
        motion: &Motion,
        collision: &CollisionReport,
    ) -> Outcome {
        let undecided = collision.undecided.iter().map(|u| u.time);
        Outcome::of(&Parts {
            end: motion.frames.last().map_or(0.0, |frame| frame.time),
            jam: self.jam_report(computed).as_ref(),
            stop: stop_report(computed).as_ref(),
            fold_angles: &self.fold_angles(motion),
            verdict: collision.verdict,
            collision: &self.collision_section(collision),
            undecided: undecided.min_by(f64::total_cmp),
        })
    }

    fn fold_angles(&self, motion: &Motion) -> FoldAngleReport {
        let last = motion.frames.last();
        let positions = last.map_or(&[][..], |frame| &frame.positions);
        FoldAngleReport::new(self.subject.sheet(), positions, self.subject.end_angles())
    }

    fn map_report(&self, sheet: &UnitSheet) -> Option<MapReport> {
        let layers = sheet.map_layers()?;
        Some(MapReport {
            layers,
            stack_height: self.thickness.map(|thickness| layers as f64 * thickness),
            waterbomb: sheet.waterbomb_box().map(BoxReport::from),
        })
    }

    fn compact_report(&self, measured: &FittedBox, last: Option<&Frame>) -> CompactReport {
        let h = self.subject.sheet().unit_length;
        let error = self.subject.closed_form().map(|closed| {
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
            rms_to_exact: measured.rms_to_exact.map(|rms| rms / h),
            relative_error: error,
            explanation: None,
            skin: last.and_then(|frame| self.skin_report(&frame.positions)),
        }
    }

    /// Why an extent differs from the closed form by more than [`LARGE_ERROR`].
    fn explanation(
        &self,
        compact: &CompactReport,
        outcome: &Outcome,
        fold_angles: &FoldAngleReport,
    ) -> Option<String> {
        let error = compact.relative_error?;
        let is_large = |axis: &usize| error.extents[*axis].abs() > LARGE_ERROR;
        let axes: Vec<&str> = (0..3)
            .filter(is_large)
            .map(|axis| ["x", "y", "z"][axis])
            .collect();
        if axes.is_empty() {
            return None;
        }
        let axes = axes.join(", ");
        if !outcome.is_at_end() {
            return Some(format!(
                "{axes}: the sheet did not reach its compact state; this is the box of the last state reached"
            ));
        }
        let gap = self.contact_gap.map_or_else(
            || "without contact".to_owned(),
            |gap| format!("every layer keeps a gap of {gap} h from the next"),
        );
        Some(format!(
            "{axes}: {gap}, and {}, which adds up over the length of the sheet",
            fold_angles.words()
        ))
    }

    fn skin_report(&self, positions: &[DVec3]) -> Option<SkinReport> {
        let units = &self.subject.units()?.units;
        let exact = units.compact();
        let fit = RigidMotion::best_fit(positions, &exact);
        let fitted: Vec<DVec3> = positions.iter().map(|&p| fit.apply(p)).collect();
        let tolerance = SKIN_TOLERANCE * units.unit.flap;
        let (measured, exact) = (
            units.skin(&fitted, tolerance)?,
            units.skin(&exact, tolerance)?,
        );
        Some(SkinReport {
            tolerance: SKIN_TOLERANCE,
            upper: measured.upper.into(),
            lower: measured.lower.into(),
            exact_upper: exact.upper.into(),
            exact_lower: exact.lower.into(),
        })
    }

    fn jam_report(&self, computed: &Computed) -> Option<JamReport> {
        let jam = computed.jam.as_ref()?;
        let facets = |(faces, _): &([u32; 2], f64)| {
            faces.map(|f| self.subject.sheet().face_facets[f as usize])
        };
        let mut seen = BTreeSet::new();
        let facets: Vec<[u32; 2]> = jam.blocking.iter().map(facets).collect();
        let facets = facets.into_iter().filter(|pair| seen.insert(*pair));
        let facets: Vec<[u32; 2]> = facets.take(10).collect();
        let units = facets.iter().filter_map(|pair| self.units_of(*pair));
        let units = units.collect();
        let names = facets.iter().map(|pair| pair.map(|f| self.facet_name(f)));
        let names = names.collect();
        Some(JamReport {
            t: jam.time,
            fold_angle_error_deg: jam.fold_angle_error.to_degrees(),
            facets,
            units,
            names,
        })
    }

    /// A facet in words: its kind and unit where it has one.
    fn facet_name(&self, facet: u32) -> String {
        let Some(units) = self.subject.units() else {
            return format!("facet {facet}");
        };
        let Facet {
            row, column, kind, ..
        } = units.units.sheet.facets[facet as usize];
        let unit = UnitSheet::unit_name(row);
        format!(
            "{} {facet} of unit {unit} row {row} column {column}",
            kind.name()
        )
    }

    fn pattern_report(&self) -> PatternReport {
        let check = self.subject.pattern_check();
        let sheet = self.subject.sheet();
        let vertices = check.groups().into_iter().map(|g| VertexReport {
            kind: g.kind.name().to_owned(),
            degree: g.degree,
            mountains_minus_valleys: g.mountains_minus_valleys,
            count: g.count,
            angle_sum_deg: g.angle_sum.to_degrees(),
            alternate_sums_deg: g.alternate_sums.map(|s| s.map(f64::to_degrees)),
            developable: g.developable,
            flat_foldable: g.flat_foldable,
        });
        PatternReport {
            developable: check.is_developable(),
            flat_foldable: check.is_flat_foldable(),
            vertex_count: sheet.vertices.len(),
            facet_count: sheet.facets.len(),
            face_count: sheet.faces.len(),
            vertices: vertices.collect(),
        }
    }

    fn collision_section(&self, collision: &CollisionReport) -> CollisionSection {
        let is_within_unit = |p: &PenetrationReport| p.units.as_ref().is_some_and(|u| u[0] == u[1]);
        CollisionSection {
            verdict: verdict_name(collision.verdict).to_owned(),
            tolerance: collision.tolerance,
            first: collision.first.as_ref().map(|p| self.penetration_report(p)),
            first_within_unit: collision
                .penetrations
                .iter()
                .map(|p| self.penetration_report(p))
                .find(is_within_unit),
            stopped: collision.stopped.map(stopped),
            penetrating_pairs: collision.penetrations.len(),
            touching_pairs: collision.touching_pairs,
            undecided_pairs: collision.undecided.len(),
            min_separation: collision.min_separation.map(|s| s.distance),
            min_separation_t: collision.min_separation.map(|s| s.time),
            pairs_tested: collision.pairs_tested.total(),
            decided_by: decided_by(collision.decided_by),
        }
    }

    fn penetration_report(&self, p: &Penetration) -> PenetrationReport {
        let facets = p
            .faces
            .map(|f| self.subject.sheet().face_facets[f as usize]);
        let units = self.units_of(facets);
        let vertex_name = |&v: &u32| {
            let sheet = &self.subject.units()?.units;
            let pair = units.as_ref()?;
            pair.iter()
                .find_map(|u| sheet.vertex_name(v, u.row, u.column))
        };
        let stage = if p.time < 1.0 {
            Stage::Unfold
        } else {
            Stage::Fold
        };
        PenetrationReport {
            t: p.time,
            stage: stage.name().to_owned(),
            kind: p.kind.name().to_owned(),
            facets,
            faces: p.faces,
            vertex_names: p.vertices.iter().map(vertex_name).collect(),
            vertices: p.vertices.clone(),
            units,
            point: p.point.into(),
            depth: p.depth,
        }
    }

    /// The units of two facets; none for an imported pattern.
    fn units_of(&self, facets: [u32; 2]) -> Option<[UnitName; 2]> {
        let sheet = &self.subject.units()?.units.sheet;
        Some(facets.map(|facet| {
            let facet = &sheet.facets[facet as usize];
            UnitName {
                row: facet.row,
                column: facet.column,
                name: UnitSheet::unit_name(facet.row).to_owned(),
            }
        }))
    }
}

fn stop_report(computed: &Computed) -> Option<StopReport> {
    computed.stages.iter().find_map(StopReport::of)
}

fn row_reports(sheet: &UnitSheet) -> Option<Vec<RowReport>> {
    let row = |unit: &Unit| RowReport {
        case: unit.case.name().to_owned(),
        height: unit.height,
    };
    let rows = sheet.row_units().iter().map(row);
    (!sheet.has_equal_rows()).then(|| rows.collect())
}

fn profile_report(study: &UnitStudy) -> ProfileReport {
    ProfileReport {
        source: study.profile_source.clone(),
        closed: study.profile.is_closed(),
    }
}

fn division_report(study: &UnitStudy) -> DivisionReport {
    DivisionReport {
        method: study.division_method.name().to_owned(),
        fit: FitReport {
            largest: study.fit.largest,
            mean: study.fit.mean,
        },
        max_residual: study.division.max_residual,
        mean_residual: study.division.mean_residual,
        iterations: study.division.iterations,
        seconds: study.division_seconds,
        points: study.division.points.iter().map(DVec2::to_array).collect(),
    }
}

fn unfold_report(unfolding: &Unfolding) -> UnfoldReport {
    let path = unfolding.path.as_ref();
    UnfoldReport {
        method: unfolding.method().to_owned(),
        asked: unfolding.asked.name().to_owned(),
        certified: unfolding.certified,
        crosses_at: unfolding.crosses_at,
        steps: path.map(|path| path.steps),
        pieces: path.map(|path| path.turns.len() - 1),
    }
}

fn decided_by(counts: FilterCounts) -> DecidedBy {
    DecidedBy {
        boxes: counts.boxes,
        axis_at_rest: counts.axis_at_rest,
        turning_axis: counts.turning_axis,
        search: counts.search,
        share_without_search: counts.share_without_search(),
    }
}

pub(crate) fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Free => "free",
        Verdict::Touching => "touching",
        Verdict::Penetrating => "penetrating",
        Verdict::Undecided => "undecided",
    }
}

fn stage_report(outcome: &StageSummary, series: &[FrameFigures]) -> StageReport {
    let start = outcome.stage.start_time();
    let within: Vec<&FrameFigures> = series
        .iter()
        .filter(|f| (start..=start + 1.0).contains(&f.time))
        .collect();
    let peak = |value: fn(&FrameFigures) -> f64| {
        within
            .iter()
            .map(|f| (value(f), f.time))
            .fold((0.0, start), |a, b| if b.0 > a.0 { b } else { a })
    };
    let (peak_strain, peak_strain_t) = peak(|f| f.peak_strain);
    let (peak_facet_bending_deg, peak_facet_bending_t) = peak(|f| f.peak_bending_deg);
    let most = |value: fn(&FrameFigures) -> f64| peak(value).0;
    StageReport {
        name: outcome.stage.name().to_owned(),
        peak_strain,
        peak_strain_t,
        mean_strain: within.iter().map(|f| f.mean_strain).sum::<f64>() / within.len().max(1) as f64,
        peak_facet_bending_deg,
        peak_facet_bending_t,
        peak_energy: EnergyReport {
            bars: most(|f| f.energy.bars),
            creases: most(|f| f.energy.creases),
            facets: most(|f| f.energy.facets),
            face_angles: most(|f| f.energy.face_angles),
            contact: most(|f| f.contact_energy),
        },
        most_contacts: within.iter().map(|f| f.contacts).max().unwrap_or(0),
        converged: outcome.converged,
        reached_t: outcome.reached,
        residual: outcome.residual,
        steps: outcome.steps,
        load_steps: outcome.load_steps.map(|n| n[0]),
        shortened_load_steps: outcome.load_steps.map(|n| n[1]),
    }
}
