//! Composes the certificate of a motion file from a collision report.

use foldmotion_check::{CollisionReport, Penetration, Separation, Undecided};
use foldmotion_pattern::{FoldFile, Sheet};
use glam::DVec3;

use super::{
    Certificate, FORMAT, LayersEntry, PenetrationEntry, SeparationEntry, TrianglePair,
    UndecidedEntry,
};
use crate::VERSION;

/// A motion file without its frames; the same whether it was just written or read.
#[derive(Debug, Clone)]
pub(crate) struct MotionFile<'a> {
    pub(crate) title: Option<String>,
    pub(crate) sheet: &'a Sheet,
    /// The number of faces in the file.
    pub(crate) faces: usize,
    /// The number of faces with more than three corners.
    pub(crate) cut_faces: usize,
    /// The face of each triangle; `None` if all faces are triangles.
    pub(crate) triangle_faces: Option<&'a [u32]>,
    pub(crate) has_facets: bool,
    pub(crate) has_unit_length: bool,
}

/// A motion file with its collision report.
pub(crate) struct CertificateSource<'a> {
    /// The name of the file.
    pub(crate) name: &'a str,
    pub(crate) sha256: String,
    pub(crate) file: MotionFile<'a>,
    /// The motion times of the frames, at least one.
    pub(crate) times: &'a [f64],
    pub(crate) collision: &'a CollisionReport,
}

impl<'a> From<&'a FoldFile> for MotionFile<'a> {
    fn from(file: &'a FoldFile) -> Self {
        Self {
            title: file.title.clone(),
            sheet: &file.sheet,
            faces: file.polygons.len(),
            cut_faces: file.polygons.iter().filter(|p| p.len() > 3).count(),
            triangle_faces: Some(&file.triangle_faces),
            has_facets: file.has_facets,
            has_unit_length: file.has_unit_length,
        }
    }
}

impl MotionFile<'_> {
    /// The assumptions under which a verdict on the motion holds.
    pub(crate) fn assumptions(&self) -> Vec<String> {
        let polygons = match self.cut_faces {
            0 => "All faces are triangles.".to_owned(),
            cut => format!(
                "{cut} faces with more than three corners were cut into triangles, convex ones from their first \
                 corner, others ear by ear; each moves as its triangles do."
            ),
        };
        let unit = if self.has_unit_length {
            "The unit of length is the file's foldmotion:unitLength."
        } else {
            "The unit of length is the mean side of the faces in the key frame, or in the first frame where that has \
             none."
        };
        [
            "Between frames every vertex moves on a straight line at constant speed.",
            "Nothing is said of motion before, after or other than the recorded frames.",
            "Coordinates are taken as the f64 numbers nearest to the decimals of the file.",
            "The material has no thickness.",
            "Facets that overlap by at most the tolerance and leave on the side they came from touch.",
            "Facets in contact at the first frame lie on the side that the file's faceOrders give; without them, \
             creases folded by 180 degrees lie on the side of their assignment and others may lie on any side they \
             allow.",
            "Facets within the tolerance of one plane that overlap by more than ten tolerances in every direction are \
             layers. Their order is the side on which the motion has kept them since they were last seen apart; where \
             it never was, faceOrders decide, and otherwise it stays open.",
            "A cluster of layers is proved where every order is known and taco-taco, taco-tortilla, tortilla-tortilla, \
             bent creases and transitivity allow it; with open orders it is unproved, and does not change the verdict.",
            &polygons,
            unit,
        ]
        .map(str::to_owned)
        .to_vec()
    }

    pub(crate) fn face(&self, triangle: u32) -> u32 {
        self.triangle_faces.map_or(triangle, |faces| faces[triangle as usize])
    }

    pub(crate) fn pair(&self, triangles: [u32; 2]) -> TrianglePair {
        let facets = triangles.map(|t| self.sheet.face_facets[t as usize]);
        TrianglePair {
            triangles,
            faces: triangles.map(|t| self.face(t)),
            facets: self.has_facets.then_some(facets),
        }
    }
}

impl CertificateSource<'_> {
    pub(crate) fn certificate(self) -> Certificate {
        let report = self.collision;
        let ends = [self.times.first(), self.times.last()];
        Certificate {
            format: FORMAT,
            version: VERSION.to_owned(),
            file: self.name.to_owned(),
            verdict: report.verdict,
            tolerance: report.tolerance,
            unit_length: self.file.sheet.unit_length,
            assumptions: self.file.assumptions(),
            frames: self.times.len(),
            times: ends.map(|t| t.copied().unwrap_or(0.0)),
            vertices: self.file.sheet.vertices.len(),
            faces: self.file.faces,
            triangles: self.file.sheet.faces.len(),
            stopped: report.stopped,
            min_separation: report.min_separation.map(|s| self.separation(&s)),
            penetrations: self.penetrations(),
            undecided: report.undecided.iter().map(|u| self.undecided(u)).collect(),
            clusters: report.clusters.clone(),
            layer_orders: report.claims,
            title: self.file.title,
            sha256: self.sha256,
        }
    }

    fn separation(&self, s: &Separation) -> SeparationEntry {
        SeparationEntry {
            distance: s.distance,
            attained: s.attained,
            is_tight: s.is_tight,
            t: s.time,
            pair: self.file.pair(s.faces),
            points: s.points.map(DVec3::into),
        }
    }

    fn penetrations(&self) -> Vec<PenetrationEntry> {
        let entry = |p: &Penetration| {
            // A penetration that one frame shows by itself belongs to no interval.
            let at_frame = p.conflict.is_some() || (p.frame == 0 && p.passed == self.times[0]);
            let frames = [p.frame, if at_frame { p.frame } else { p.frame + 1 }];
            PenetrationEntry {
                frames,
                interval: frames.map(|k| self.times[k]),
                t: p.time,
                passed_t: p.passed,
                kind: p.kind,
                pair: self.file.pair(p.faces),
                vertices: p.vertices.clone(),
                point: p.point.into(),
                depth: p.depth,
                layers: p.conflict.as_ref().map(|conflict| LayersEntry {
                    rule: conflict.rule,
                    triangles: conflict.faces.clone(),
                    faces: conflict.faces.iter().map(|&t| self.file.face(t)).collect(),
                }),
            }
        };
        self.collision.penetrations.iter().map(entry).collect()
    }

    fn undecided(&self, u: &Undecided) -> UndecidedEntry {
        let frames = [u.frame, u.frame + 1];
        UndecidedEntry {
            frames,
            interval: frames.map(|k| self.times[k]),
            t: u.time,
            pair: self.file.pair(u.faces),
        }
    }
}
