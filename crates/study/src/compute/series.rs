//! Figures of each frame (strain, bending, energy, separation), for the stages of the report, `motion.csv` and `plots.svg`.

use std::fmt::Write as _;

use foldmotion_check::{bar_strain, facet_bending};
use foldmotion_pattern::{Frame, Motion};
use foldmotion_record::{Curve, Panel};
use foldmotion_solver::{EnergyByKind, Stage};

use crate::Study;
use crate::compute::engine::EngineRun;

/// The figures of one frame.
#[derive(Debug, Clone, Copy)]
pub struct FrameFigures {
    /// The motion time of the frame.
    pub time: f64,
    /// The stage of the frame.
    pub stage: Stage,
    /// The largest |l / l₀ − 1| of an edge, with l₀ its length in the crease pattern; NaN if that is unknown.
    pub peak_strain: f64,
    /// The mean |l / l₀ − 1| over all edges.
    pub mean_strain: f64,
    /// The largest |fold angle| inside a facet, in degrees.
    pub peak_bending_deg: f64,
    /// The energy in units of EA·h for EA = 1; 0 for a motion of unknown material.
    pub energy: EnergyByKind,
    /// The energy of contact, in the same units.
    pub contact_energy: f64,
    /// The number of pairs in contact.
    pub contacts: usize,
    /// The smallest distance of facets that share no vertex, in units of h; NaN if all facets share vertices.
    pub separation: f64,
}

impl Study {
    /// The figures of each frame of `motion`.
    ///
    /// `separations` has one value for each frame, from the collision check, or is empty.
    pub(crate) fn series(
        &self,
        motion: &Motion,
        computed: &EngineRun,
        separations: &[f64],
    ) -> Vec<FrameFigures> {
        let mut angles = vec![0.0; self.model.hinges.len()];
        let mut targets = vec![0.0; self.model.hinges.len()];
        self.schedule.targets(Stage::Unfold, 0.0, &mut angles);
        let figures = |(index, frame): (usize, &Frame)| {
            let positions = self.model.to_model(&frame.positions);
            self.model.follow_angles(&positions, &mut angles);
            let (stage, local) = stage_at(frame.time, self.subject.stages());
            self.schedule.targets(stage, local, &mut targets);
            let strain = bar_strain(&motion.sheet, &frame.positions);
            let contact = computed.contacts.get(index);
            FrameFigures {
                time: frame.time,
                stage,
                peak_strain: strain.peak,
                mean_strain: strain.mean,
                peak_bending_deg: facet_bending(&motion.sheet, &frame.positions).peak_deg(),
                energy: self.model.energy_by_kind(&positions, &angles, &targets),
                // Adding 0 turns the −0 of an empty sum into 0.
                contact_energy: contact.map_or(0.0, |c| c.energy) + 0.0,
                contacts: contact.map_or(0, |c| c.count),
                separation: separations.get(index).copied().unwrap_or(f64::NAN),
            }
        };
        motion.frames.iter().enumerate().map(figures).collect()
    }
}

/// The stage of a motion time and the time within the stage. The planar state belongs to the end of stage unfold.
fn stage_at(time: f64, stages: &[Stage]) -> (Stage, f64) {
    if time <= 1.0 && stages.contains(&Stage::Unfold) {
        (Stage::Unfold, time)
    } else {
        (Stage::Fold, (time - 1.0).min(1.0))
    }
}

/// The text of `motion.csv`: one line for each frame.
pub(crate) fn csv(series: &[FrameFigures]) -> String {
    let mut out = "t,stage,peak_strain,mean_strain,peak_facet_bending_deg,energy_bars,energy_creases,energy_facets,\
                   energy_face_angles,energy_contact,contacts,separation\n"
        .to_owned();
    for f in series {
        let separation =
            if f.separation.is_finite() { format!("{:?}", f.separation) } else { String::new() };
        // The shortest digits that read back as the same number. Writing into a string cannot fail.
        let _ = writeln!(
            out,
            "{:?},{},{:?},{:?},{:?},{:?},{:?},{:?},{:?},{:?},{},{separation}",
            f.time,
            f.stage.name(),
            f.peak_strain,
            f.mean_strain,
            f.peak_bending_deg,
            f.energy.bars,
            f.energy.creases,
            f.energy.facets,
            f.energy.face_angles,
            f.contact_energy,
            f.contacts,
        );
    }
    out
}

/// The panels of `plots.svg`: strain, bending, energy and smallest separation over t.
///
/// The motion time `first_penetration` is drawn as a vertical line across the separation.
pub(crate) fn panels(series: &[FrameFigures], first_penetration: Option<f64>) -> Vec<Panel> {
    let curve = |name, value: fn(&FrameFigures) -> f64| Curve {
        name,
        points: series.iter().map(|f| (f.time, value(f))).collect(),
    };
    let has_contact = series.iter().any(|f| f.contacts > 0);
    let mut energy = vec![
        curve("bars", |f| f.energy.bars),
        curve("creases", |f| f.energy.creases),
        curve("facets", |f| f.energy.facets),
    ];
    if has_contact {
        energy.push(curve("contact", |f| f.contact_energy));
    }
    let mut separation = vec![curve("separation", |f| f.separation)];
    if let Some(time) = first_penetration {
        let drawn = series.iter().map(|f| f.separation);
        let drawn: Vec<f64> = drawn.filter(|s| s.is_finite() && *s > 0.0).collect();
        let lowest = drawn.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = drawn.iter().copied().fold(0.0, f64::max);
        separation
            .push(Curve { name: "penetration", points: vec![(time, lowest), (time, highest)] });
    }
    let panel = |title, is_logarithmic, curves| Panel { title, is_logarithmic, curves };
    vec![
        panel(
            "bar strain, %",
            false,
            vec![
                curve("peak", |f| 100.0 * f.peak_strain),
                curve("mean", |f| 100.0 * f.mean_strain),
            ],
        ),
        panel(
            "largest facet bending, degrees",
            false,
            vec![curve("bending", |f| f.peak_bending_deg)],
        ),
        panel("energy, units of EA h at EA = 1", false, energy),
        panel("smallest separation of facets that share no vertex, h", true, separation),
    ]
}
