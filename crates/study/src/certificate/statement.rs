//! The statement of a certificate as input of the second proof, and what the motion file alone refutes of it.

use foldmotion_check::{
    CollisionReport, FilterCounts, LayerConflict, PairCounts, Penetration, PenetrationKind,
    Separation, Undecided,
};
use foldmotion_pattern::FoldFile;
use foldmotion_verify::Refutation;

use super::certify::MotionFile;
use super::{Certificate, PenetrationEntry, TrianglePair};
use crate::VERSION;

/// Refutes a field unless the stated value is the one found.
fn require<T: PartialEq + std::fmt::Debug>(
    refuted: &mut Vec<Refutation>,
    field: &str,
    stated: &T,
    found: &T,
) {
    if stated != found {
        let [stated, found] = [stated, found].map(|value| format!("{value:?}"));
        refuted.push(Refutation::new(field, stated, found));
    }
}

/// Refutations by the motion file without its frames.
pub(crate) fn against_file(certificate: &Certificate, file: &FoldFile) -> Vec<Refutation> {
    let file_info = MotionFile::from(file);
    let mut refuted = Vec::new();
    let r = &mut refuted;
    require(r, "version", &certificate.version, &VERSION.to_owned());
    require(r, "title", &certificate.title, &file.title);
    require(r, "unit_length", &certificate.unit_length, &file.sheet.unit_length);
    require(r, "assumptions", &certificate.assumptions, &file_info.assumptions());
    require(r, "frames", &certificate.frames, &file.frame_count());
    require(r, "vertices", &certificate.vertices, &file.sheet.vertices.len());
    require(r, "faces", &certificate.faces, &file.polygons.len());
    require(r, "triangles", &certificate.triangles, &file.sheet.faces.len());
    let value = certificate.tolerance;
    if !(value > 0.0 && value < 0.1) {
        r.push(Refutation::new("tolerance", value, "it must be positive and below 0.1"));
    }
    for (field, pair) in pairs(certificate) {
        let [f, g] = pair.triangles;
        if f >= g || g as usize >= file.sheet.faces.len() {
            let found = "two indices of triangles, the smaller first, are expected";
            r.push(Refutation::new(field, format!("{:?}", pair.triangles), found));
        } else {
            require(r, field, pair, &file_info.pair(pair.triangles));
        }
    }
    for layers in certificate.penetrations.iter().filter_map(|p| p.layers.as_ref()) {
        let count = file.sheet.faces.len();
        let found: Vec<Option<u32>> = layers
            .triangles
            .iter()
            .map(|&t| ((t as usize) < count).then(|| file_info.face(t)))
            .collect();
        let stated: Vec<Option<u32>> = layers.faces.iter().copied().map(Some).collect();
        require(r, "penetrations.layers.faces", &stated, &found);
    }
    refuted
}

fn pairs(certificate: &Certificate) -> impl Iterator<Item = (&'static str, &TrianglePair)> {
    let separation = certificate.min_separation.iter();
    let penetrations = certificate.penetrations.iter();
    let undecided = certificate.undecided.iter();
    separation
        .map(|s| ("min_separation.pair", &s.pair))
        .chain(penetrations.map(|p| ("penetrations.pair", &p.pair)))
        .chain(undecided.map(|u| ("undecided.pair", &u.pair)))
}

/// The time at which a contact begins, moved into the interval of the penetration if it is allowed to lie before it: what
/// passes through an edge may have been in contact since an earlier interval.
fn in_interval(p: &PenetrationEntry, first: f64) -> f64 {
    let is_long = p.kind == PenetrationKind::ThroughEdge;
    if is_long && (first..p.interval[0]).contains(&p.t) { p.interval[0] } else { p.t }
}

/// Refutations by the times of the frames.
pub(crate) fn against_times(certificate: &Certificate, times: &[f64]) -> Vec<Refutation> {
    let mut refuted = Vec::new();
    let r = &mut refuted;
    let ends = [times.first(), times.last()].map(|t| t.copied().unwrap_or(0.0));
    require(r, "times", &certificate.times, &ends);
    if let Some(stopped) = certificate.stopped {
        let found = times.get(stopped.frame).copied();
        require(r, "stopped.t", &Some(stopped.time), &found);
    }
    let penetrations = certificate.penetrations.iter();
    let intervals = penetrations
        .map(|p| {
            ("penetrations", p.frames, p.interval, in_interval(p, ends[0]), p.layers.is_some())
        })
        .chain(
            certificate.undecided.iter().map(|u| ("undecided", u.frames, u.interval, u.t, false)),
        );
    for (field, frames, interval, t, at_frame) in intervals {
        let of = frames.map(|k| times.get(k).copied().unwrap_or(f64::NAN));
        require(r, &format!("{field}.interval"), &interval, &of);
        let is_next = frames[0].checked_add(1) == Some(frames[1]) || frames == [0, 0];
        let is_fit = if at_frame { frames[0] == frames[1] } else { is_next };
        if !is_fit {
            let found = if at_frame {
                "layers are out of order at a single frame"
            } else {
                "an interval is between one frame and the next"
            };
            r.push(Refutation::new(format!("{field}.frames"), format!("{frames:?}"), found));
        }
        if !(interval[0]..=interval[1]).contains(&t) {
            let found = format!("the interval is {interval:?}");
            r.push(Refutation::new(format!("{field}.t"), t, found));
        }
    }
    refuted
}

/// The statement as a collision report, with zero counts of work.
pub(crate) fn claim(certificate: &Certificate) -> CollisionReport {
    let penetrations: Vec<_> = certificate.penetrations.iter().map(penetration).collect();
    let undecided = certificate.undecided.iter().map(|u| Undecided {
        time: u.t,
        frame: u.frames[0],
        faces: u.pair.triangles,
    });
    let separation = certificate.min_separation.map(|s| Separation {
        distance: s.distance,
        attained: s.attained,
        is_tight: s.is_tight,
        time: s.t,
        faces: s.pair.triangles,
        points: s.points.map(Into::into),
    });
    CollisionReport {
        verdict: certificate.verdict,
        tolerance: certificate.tolerance,
        first: penetrations.first().cloned(),
        penetrations,
        touching_pairs: 0,
        stopped: certificate.stopped,
        undecided: undecided.collect(),
        min_separation: separation,
        separation_series: Vec::new(),
        pairs_tested: PairCounts::default(),
        decided_by: FilterCounts::default(),
        clusters: certificate.clusters.clone(),
        claims: certificate.layer_orders,
    }
}

fn penetration(p: &PenetrationEntry) -> Penetration {
    Penetration {
        time: p.t,
        passed: p.passed_t,
        frame: p.frames[0],
        faces: p.pair.triangles,
        vertices: p.vertices.clone(),
        point: p.point.into(),
        depth: p.depth,
        kind: p.kind,
        conflict: p
            .layers
            .as_ref()
            .map(|layers| LayerConflict { rule: layers.rule, faces: layers.triangles.clone() }),
    }
}
