//! What a certificate states, as the second proof takes it; and what of it the motion file alone refutes.

use foldmotion_check::{
    Claims, CollisionReport, FilterCounts, PairCounts, Penetration, PenetrationKind, Refutation,
    Separation, Undecided, Verdict,
};
use foldmotion_pattern::FoldFile;

use crate::certificate::{Certificate, DecidedBy, PairsTested, TrianglePair};
use crate::certify::MotionFile;
use crate::reporting::{kind_name, verdict_name};
use crate::run::VERSION;

const VERDICTS: [Verdict; 4] = [
    Verdict::Free,
    Verdict::Touching,
    Verdict::Penetrating,
    Verdict::Undecided,
];
const KINDS: [PenetrationKind; 5] = [
    PenetrationKind::VertexFacet,
    PenetrationKind::EdgeEdge,
    PenetrationKind::FoldedThrough,
    PenetrationKind::AroundVertex,
    PenetrationKind::PassedThrough,
];

/// Refutes a field unless it is what it should be.
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

/// What the file without its frames refutes.
pub(crate) fn against_file(certificate: &Certificate, file: &FoldFile) -> Vec<Refutation> {
    let known = MotionFile::from(file);
    let mut refuted = Vec::new();
    let r = &mut refuted;
    require(r, "version", &certificate.version, &VERSION.to_owned());
    require(r, "title", &certificate.title, &file.title);
    require(
        r,
        "unit_length",
        &certificate.unit_length,
        &file.sheet.unit_length,
    );
    require(
        r,
        "assumptions",
        &certificate.assumptions,
        &known.assumptions(),
    );
    require(r, "frames", &certificate.frames, &file.frame_count());
    require(
        r,
        "vertices",
        &certificate.vertices,
        &file.sheet.vertices.len(),
    );
    require(r, "faces", &certificate.faces, &file.polygons.len());
    require(
        r,
        "triangles",
        &certificate.triangles,
        &file.sheet.faces.len(),
    );
    let value = certificate.tolerance;
    if !(value > 0.0 && value < 0.1) {
        r.push(Refutation::new(
            "tolerance",
            value,
            "it must be positive and below 0.1",
        ));
    }
    sums(certificate, r);
    for (field, pair) in pairs(certificate) {
        let [f, g] = pair.triangles;
        if f >= g || g as usize >= file.sheet.faces.len() {
            let found = "there are no such triangles, the smaller number first";
            r.push(Refutation::new(
                field,
                format!("{:?}", pair.triangles),
                found,
            ));
        } else {
            require(r, field, pair, &known.pair(pair.triangles));
        }
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

fn sums(certificate: &Certificate, refuted: &mut Vec<Refutation>) {
    let PairsTested {
        disjoint,
        shared_vertex,
        shared_crease,
        total,
    } = certificate.pairs_tested;
    let sum = disjoint
        .saturating_add(shared_vertex)
        .saturating_add(shared_crease);
    require(refuted, "pairs_tested.total", &total, &sum);
    let DecidedBy {
        boxes,
        axis_at_rest,
        turning_axis,
        search,
        share_without_search,
    } = certificate.decided_by;
    let quick = boxes
        .saturating_add(axis_at_rest)
        .saturating_add(turning_axis);
    let share = quick as f64 / quick.saturating_add(search).max(1) as f64;
    require(
        refuted,
        "decided_by.share_without_search",
        &share_without_search,
        &share,
    );
}

/// What the times of the frames refute.
pub(crate) fn against_times(certificate: &Certificate, times: &[f64]) -> Vec<Refutation> {
    let mut refuted = Vec::new();
    let ends = [times.first(), times.last()].map(|t| t.copied().unwrap_or(0.0));
    require(&mut refuted, "times", &certificate.times, &ends);
    let penetrations = certificate.penetrations.iter();
    let intervals = penetrations
        .filter(|p| p.layers.is_none())
        .map(|p| ("penetrations", p.frames, p.interval, p.t))
        .chain(
            certificate
                .undecided
                .iter()
                .map(|u| ("undecided", u.frames, u.interval, u.t)),
        );
    for (field, frames, interval, t) in intervals {
        let of = frames.map(|k| times.get(k).copied().unwrap_or(f64::NAN));
        require(&mut refuted, &format!("{field}.interval"), &interval, &of);
        let is_next = frames[0].checked_add(1) == Some(frames[1]) || frames == [0, 0];
        if !is_next {
            let found = "an interval is between one frame and the next";
            refuted.push(Refutation::new(
                format!("{field}.frames"),
                format!("{frames:?}"),
                found,
            ));
        }
        if !(interval[0]..=interval[1]).contains(&t) {
            let found = format!("the interval is {interval:?}");
            refuted.push(Refutation::new(format!("{field}.t"), t, found));
        }
    }
    refuted
}

/// What the order of the layers refutes, as the check finds it: `found`.
pub(crate) fn against_layers(stated: &Certificate, found: &Certificate) -> Vec<Refutation> {
    let mut refuted = Vec::new();
    let r = &mut refuted;
    require(r, "clusters", &stated.clusters, &found.clusters);
    require(r, "layer_orders", &stated.layer_orders, &found.layer_orders);
    let [stated, found] = [stated, found].map(|certificate| {
        let all = certificate.penetrations.iter();
        all.filter(|p| p.layers.is_some()).collect::<Vec<_>>()
    });
    require(r, "penetrations.layers", &stated, &found);
    refuted
}

/// The verdict without penetrations.
fn verdict_without(certificate: &Certificate) -> Verdict {
    let separation = certificate.min_separation;
    let is_close = separation.is_some_and(|s| s.distance <= certificate.tolerance);
    if !certificate.undecided.is_empty() {
        Verdict::Undecided
    } else if certificate.touching_pairs > 0 || is_close {
        Verdict::Touching
    } else {
        Verdict::Free
    }
}

/// The statement in the terms of the check, but for the order of layers.
pub(crate) fn claim(certificate: &Certificate) -> Result<CollisionReport, Refutation> {
    let verdict = VERDICTS
        .into_iter()
        .find(|&v| verdict_name(v) == certificate.verdict);
    let unknown = |field: &str, name: &str| Refutation::new(field, name, "there is no such one");
    let verdict = verdict.ok_or_else(|| unknown("verdict", &certificate.verdict))?;
    let of_pairs = certificate
        .penetrations
        .iter()
        .filter(|p| p.layers.is_none());
    let penetrations: Result<Vec<_>, _> = of_pairs
        .map(|p| {
            let kind = KINDS.into_iter().find(|&k| kind_name(k) == p.kind);
            Ok(Penetration {
                time: p.t,
                passed: p.passed_t,
                frame: p.frames[0],
                faces: p.pair.triangles,
                vertices: p.vertices.clone(),
                point: p.point.into(),
                depth: p.depth,
                kind: kind.ok_or_else(|| unknown("penetrations.kind", &p.kind))?,
                conflict: None,
            })
        })
        .collect();
    let undecided = certificate.undecided.iter().map(|u| Undecided {
        time: u.t,
        frame: u.frames[0],
        faces: u.pair.triangles,
    });
    let separation = certificate.min_separation.map(|s| Separation {
        distance: s.distance,
        time: s.t,
        faces: s.pair.triangles,
        points: s.points.map(Into::into),
    });
    let (tested, by) = (certificate.pairs_tested, certificate.decided_by);
    let penetrations = penetrations?;
    let has_layers_only = penetrations.is_empty() && !certificate.penetrations.is_empty();
    let verdict = match verdict {
        Verdict::Penetrating if has_layers_only => verdict_without(certificate),
        // Layers out of order leave no other verdict; the second proof sees none of them.
        _ if has_layers_only => return Err(unknown("verdict", &certificate.verdict)),
        _ => verdict,
    };
    Ok(CollisionReport {
        verdict,
        tolerance: certificate.tolerance,
        first: penetrations.first().cloned(),
        penetrations,
        touching_pairs: certificate.touching_pairs,
        undecided: undecided.collect(),
        min_separation: separation,
        separation_series: Vec::new(),
        pairs_tested: PairCounts {
            disjoint: tested.disjoint,
            shared_vertex: tested.shared_vertex,
            shared_crease: tested.shared_crease,
        },
        decided_by: FilterCounts {
            boxes: by.boxes,
            axis_at_rest: by.axis_at_rest,
            turning_axis: by.turning_axis,
            search: by.search,
        },
        clusters: Vec::new(),
        claims: Claims::default(),
    })
}
