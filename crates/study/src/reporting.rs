//! From a finished run to its report.

use foldmotion_check::{
    CollisionReport, FittedBox, Penetration, PenetrationKind, Verdict, relative_error,
};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Frame, Unit, UnitSheet};
use foldmotion_solver::Stage;
use foldmotion_solver::quasi_static::Jam;
use glam::{DVec2, DVec3};

use crate::engine::StageSummary;
use crate::refinement::Folded;
use crate::report::{
    BoxReport, CollisionSection, CompactReport, DivisionReport, EnergyReport, EngineReport,
    ErrorReport, FitReport, JamReport, MapReport, PatternReport, PenetrationReport, ProfileReport,
    RowReport, SecondsReport, SkinReport, StageReport, UnfoldReport, UnitName, UnitReport,
    VertexReport,
};
use crate::run::VERSION;
use crate::scene::EngineChoice;
use crate::series::FrameFigures;
use crate::{Report, Study};

/// A vertex this close to a skin plane, in units of a, lies on it: wide enough for layers that keep a gap.
const SKIN_TOLERANCE: f64 = 0.05;

impl Study {
    pub(crate) fn report(
        &self,
        folded: &Folded,
        seconds: SecondsReport,
        files: &[String],
    ) -> Report {
        let unit = &self.units.unit;
        let Folded {
            computed, checked, ..
        } = folded;
        Report {
            title: self.title.clone(),
            version: VERSION.to_owned(),
            length_unit: self.unit_name.to_owned(),
            case: self.units.case_name(),
            rows: self.units.rows,
            columns: self.units.columns,
            unit: UnitReport {
                width: unit.width,
                height: unit.height,
                flap: unit.flap,
                side_pad: unit.side_pad,
                centre_pad: unit.centre_pad,
            },
            unequal_rows: self.row_reports(),
            map: self.map_report(),
            profile: ProfileReport {
                source: self.profile_source.clone(),
                closed: self.profile.is_closed(),
            },
            division: DivisionReport {
                method: self.division_method.name().to_owned(),
                fit: FitReport {
                    largest: self.fit.largest,
                    mean: self.fit.mean,
                },
                max_residual: self.division.max_residual,
                mean_residual: self.division.mean_residual,
                iterations: self.division.iterations,
                seconds: self.division_seconds,
                points: self.division.points.iter().map(DVec2::to_array).collect(),
            },
            pattern: self.pattern_report(),
            closed_form: self.closed_form.map(BoxReport::from),
            compact: self.compact_report(&checked.compact, folded.motion.frames.last()),
            unfold: UnfoldReport {
                method: self.unfolding.method().to_owned(),
                asked: self.unfolding.asked.name().to_owned(),
                certified: self.unfolding.certified,
                crosses_at: self.unfolding.crosses_at,
                steps: self.unfolding.path.as_ref().map(|path| path.steps),
                pieces: self
                    .unfolding
                    .path
                    .as_ref()
                    .map(|path| path.turns.len() - 1),
            },
            stages: computed
                .stages
                .iter()
                .map(|s| stage_report(s, &checked.series))
                .collect(),
            jam: computed.jam.as_ref().map(|j| self.jam_report(j)),
            collision: collision_section(&self.units, &checked.collision),
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
        }
    }

    fn row_reports(&self) -> Option<Vec<RowReport>> {
        let row = |unit: &Unit| RowReport {
            case: unit.case.name().to_owned(),
            height: unit.height,
        };
        let rows = self.units.row_units().iter().map(row);
        (!self.units.has_equal_rows()).then(|| rows.collect())
    }

    fn map_report(&self) -> Option<MapReport> {
        let layers = self.units.map_layers()?;
        Some(MapReport {
            layers,
            stack_height: self.thickness.map(|thickness| layers as f64 * thickness),
            waterbomb: self.units.waterbomb_box().map(BoxReport::from),
        })
    }

    fn compact_report(&self, measured: &FittedBox, last: Option<&Frame>) -> CompactReport {
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
            skin: last.and_then(|frame| self.skin_report(&frame.positions)),
        }
    }

    fn skin_report(&self, positions: &[DVec3]) -> Option<SkinReport> {
        let units = &self.units;
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

    fn jam_report(&self, jam: &Jam) -> JamReport {
        let blocking = jam.blocking.iter().take(10).map(|(faces, _)| {
            let facets = faces.map(|f| self.units.sheet.face_facets[f as usize]);
            (facets, facets.map(|f| unit_of(&self.units, f)))
        });
        let (facets, units) = blocking.unzip();
        JamReport {
            t: jam.time,
            fold_angle_error_deg: jam.fold_angle_error.to_degrees(),
            facets,
            units,
        }
    }

    fn pattern_report(&self) -> PatternReport {
        let vertices = self.pattern.groups().into_iter().map(|g| VertexReport {
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
            developable: self.pattern.is_developable(),
            flat_foldable: self.pattern.is_flat_foldable(),
            vertex_count: self.units.sheet.vertices.len(),
            facet_count: self.units.sheet.facets.len(),
            face_count: self.units.sheet.faces.len(),
            vertices: vertices.collect(),
        }
    }
}

fn collision_section(units: &UnitSheet, collision: &CollisionReport) -> CollisionSection {
    CollisionSection {
        verdict: verdict_name(collision.verdict).to_owned(),
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
    let named = facets.map(|f| unit_of(units, f));
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

pub(crate) fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Free => "free",
        Verdict::Touching => "touching",
        Verdict::Penetrating => "penetrating",
        Verdict::Undecided => "undecided",
    }
}

pub(crate) fn kind_name(kind: PenetrationKind) -> &'static str {
    match kind {
        PenetrationKind::VertexFacet => "vertex through facet",
        PenetrationKind::EdgeEdge => "edge through edge",
        PenetrationKind::FoldedThrough => "folded past a half turn",
        PenetrationKind::AroundVertex => "facets crossing around a shared vertex",
        PenetrationKind::PassedThrough => "facets changing sides",
        PenetrationKind::LayerOrder => "layers out of order",
    }
}

fn unit_of(units: &UnitSheet, facet: u32) -> UnitName {
    let facet = &units.sheet.facets[facet as usize];
    UnitName {
        row: facet.row,
        column: facet.column,
        name: UnitSheet::unit_name(facet.row).to_owned(),
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
