//! The verdict in the report.

use foldmotion_check::{
    CollisionReport, FilterCounts, Penetration, PenetrationKind, Stopped, Verdict,
};
use foldmotion_geometry::Number;
use foldmotion_solver::Stage;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Study;
use crate::resolve::names::UnitName;

/// The verdict of the collision check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CollisionSection {
    /// Whether the sheet passes through itself.
    pub verdict: Verdict,
    /// The tolerance τ in units of h. For an imported pattern, this and all other lengths in units of h are in units
    /// of its mean edge.
    pub tolerance: f64,
    /// The first penetration; null if there is none.
    pub first: Option<PenetrationReport>,
    /// The first penetration between two facets of the same unit, which no path of its neighbours avoids; null if
    /// there is none.
    pub first_within_unit: Option<PenetrationReport>,
    /// Where the check ended early because of `check.stop_at`; later frames were not checked. Null if all frames were
    /// checked.
    pub stopped: Option<Stopped>,
    /// The number of pairs of triangles that penetrate somewhere.
    pub penetrating_pairs: usize,
    /// The number of pairs of triangles that touch somewhere, or were not shown to stay apart.
    pub touching_pairs: usize,
    /// The number of pairs of triangles that could not be decided.
    pub undecided_pairs: usize,
    /// The smallest distance of facets that share no vertex, in units of h.
    pub min_separation: Option<f64>,
    /// The motion time of the smallest distance.
    pub min_separation_t: Option<f64>,
    /// The number of pairs of triangles tested, counted once for each interval between frames.
    pub pairs_tested: u64,
    /// What decided these pairs, counted once for each interval between frames.
    pub decided_by: DecidedBy,
}

/// What decided the pairs of triangles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DecidedBy {
    /// Pairs whose swept boxes lie apart.
    pub boxes: u64,
    /// Pairs separated by one fixed axis, and hinges whose fold angle keeps its sign.
    pub axis_at_rest: u64,
    /// Pairs separated by an axis that turns with them.
    pub turning_axis: u64,
    /// Pairs for which all axes had to be tried.
    pub search: u64,
    /// The share of pairs that were decided without trying all axes.
    pub share_without_search: f64,
}

/// A penetration, at the time at which it begins.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PenetrationReport {
    /// The motion time at which it begins.
    pub t: f64,
    /// The stage in which it begins: unfold or fold.
    pub stage: Stage,
    /// Which parts of the two facets meet, and how.
    pub kind: PenetrationKind,
    /// The two facets of the crease pattern.
    pub facets: [u32; 2],
    /// The two triangles, parts of these facets.
    pub faces: [u32; 2],
    /// The vertices of the features that meet.
    pub vertices: Vec<u32>,
    /// The names that the paper gives these vertices in the units below; null for vertices without a name.
    pub vertex_names: Vec<Option<String>>,
    /// The units of the two facets; null for an imported pattern.
    pub units: Option<[UnitName; 2]>,
    /// The point at which the two facets meet.
    pub point: [f64; 3],
    /// How deep the two facets overlap at that point, in units of h.
    pub depth: f64,
}

impl PenetrationReport {
    /// A line for the terminal; `h` is the unit of the depth.
    pub(super) fn line(&self, h: &str) -> String {
        let unit = |side: usize| {
            let unit = self.units.as_ref().map(|pair| &pair[side]);
            unit.map_or_else(String::new, |u| {
                format!(" ({} row {} column {})", u.name, u.row, u.column)
            })
        };
        let names: Vec<&str> = self.vertex_names.iter().flatten().map(String::as_str).collect();
        format!(
            "t = {:.5} ({}): {}, facets {}{} and {}{}, vertices {:?}{}, depth {:.2} {h}",
            self.t,
            self.stage.name(),
            self.kind,
            self.facets[0],
            unit(0),
            self.facets[1],
            unit(1),
            self.vertices,
            if names.is_empty() { String::new() } else { format!(" ({})", names.join(", ")) },
            Number(self.depth)
        )
    }
}

impl Study {
    pub(super) fn collision_section(&self, collision: &CollisionReport) -> CollisionSection {
        let is_within_unit = |p: &PenetrationReport| p.units.as_ref().is_some_and(|u| u[0] == u[1]);
        CollisionSection {
            verdict: collision.verdict,
            tolerance: collision.tolerance,
            first: collision.first.as_ref().map(|p| self.penetration_report(p)),
            first_within_unit: collision
                .penetrations
                .iter()
                .map(|p| self.penetration_report(p))
                .find(is_within_unit),
            stopped: collision.stopped,
            penetrating_pairs: collision.penetrations.len(),
            touching_pairs: collision.touching_pairs,
            undecided_pairs: collision.undecided.len(),
            min_separation: collision.min_separation.map(|s| s.distance),
            min_separation_t: collision.min_separation.map(|s| s.time),
            pairs_tested: collision.pairs_tested.total(),
            decided_by: decided_by(collision.decided_by),
        }
    }

    pub(super) fn penetration_report(&self, p: &Penetration) -> PenetrationReport {
        let facets = p.faces.map(|f| self.subject.sheet().face_facets[f as usize]);
        let units = self.subject.units_of(facets);
        let vertex_name = |&v: &u32| {
            let sheet = &self.subject.units()?.units;
            let pair = units.as_ref()?;
            pair.iter().find_map(|u| sheet.vertex_name(v, u.row, u.column))
        };
        let stage = if p.time < 1.0 { Stage::Unfold } else { Stage::Fold };
        PenetrationReport {
            t: p.time,
            stage,
            kind: p.kind,
            facets,
            faces: p.faces,
            vertex_names: p.vertices.iter().map(vertex_name).collect(),
            vertices: p.vertices.clone(),
            units,
            point: p.point.into(),
            depth: p.depth,
        }
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
