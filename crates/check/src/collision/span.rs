//! How long a penetration lasts.

use foldmotion_pattern::Motion;
use glam::DVec3;

use super::{CollisionReport, Penetration, PenetrationKind, face_pair::FacePair};

/// The motion times between which a pair of triangles penetrates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PenetrationSpan {
    /// The indices of the two triangles.
    pub faces: [u32; 2],
    /// The motion time at which the contact begins that leads to the penetration.
    pub from: f64,
    /// The motion time of the last frame up to which every frame shows them deeper than τ in each other; at least the
    /// end of the interval in which they penetrate.
    pub to: f64,
}

/// The span of each penetration of `report`, in the order of the report; `motion` is the motion it is about.
///
/// A pair that has passed through to the other side is no longer deep, so its span ends with the interval. Layers out
/// of order are reported at the time of a single frame.
pub fn penetration_spans(motion: &Motion, report: &CollisionReport) -> Vec<PenetrationSpan> {
    let tolerance = report.tolerance * motion.sheet.unit_length;
    let span = |p: &Penetration| PenetrationSpan {
        faces: p.faces,
        from: p.time,
        to: match p.kind {
            PenetrationKind::LayerOrder => p.time,
            _ => last_deep(motion, p, tolerance),
        },
    };
    report.penetrations.iter().map(span).collect()
}

fn last_deep(motion: &Motion, p: &Penetration, tolerance: f64) -> f64 {
    let pair = FacePair::new(&motion.sheet, p.faces[0], p.faces[1]);
    let is_deep = |positions: &[DVec3]| pair.pose(positions).depth().overlap > tolerance;
    let after = motion.frames.iter().skip(p.frame + 1);
    let interval_end = motion.frames.get(p.frame + 1).map_or(p.passed, |f| f.time);
    after
        .take_while(|frame| is_deep(&frame.positions))
        .last()
        .map_or(interval_end, |frame| frame.time)
}
