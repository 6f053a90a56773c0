//! The visible surface: which triangle is in front at a point of the screen.
//!
//! Every triangle is a plane, depth = c + g·p, over its projection. Where a point p lies on several triangles, the
//! one nearer to the viewer is in front, unless two of them lie closer to each other than [`TIE_TOLERANCE`] and their
//! layer order is known: then the order decides. Films ask this at the samples of pixels; figures can ask it at
//! points of an arrangement of edges. Both get the same answers, from [`Surface::in_front`].

use glam::{DVec2, DVec3};

use crate::{Camera, Paper, Style};

/// Triangles of known order closer than this count as coincident, in units of the sheet's `unit_length`.
///
/// Contact keeps layers about 1e-3 apart, and a motion without contact drives layers through each other by up to
/// about 1e-2 as they close, back and forth from frame to frame; below this distance depth is noise and the
/// order is the truth. A larger tolerance would do no harm to layers in their order: it only matters where depth and
/// order disagree.
pub const TIE_TOLERANCE: f64 = 1e-2;

/// An order holds between planes within 30° of each other; beyond that depth tells them apart.
const PARALLEL_COSINE: f64 = 0.866;

/// Seen at less than 15°, layers are compared as if at 15°: along the ray the window would grow without bound and take
/// in triangles that lie beside each other, not on each other.
const LEAST_COSINE: f64 = 0.26;

/// A triangle that may be seen at a point of the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The triangle.
    pub face: u32,
    /// Its depth there in pixels, larger is nearer.
    pub depth: f64,
    /// Whether the triangle itself covers the point; else only the outer half of one of its outlines does.
    pub covers: bool,
}

/// The side of a triangle's edge: n·p + c is the distance in pixels from the edge, positive inside.
#[derive(Debug, Clone, Copy)]
struct Side {
    n: DVec2,
    c: f64,
}

/// A triangle on the screen.
#[derive(Debug, Clone)]
pub(crate) struct ScreenFace {
    sides: [Side; 3],
    low: DVec2,
    high: DVec2,
    /// depth = offset + gradient·p, kept within the depths of the corners.
    gradient: DVec2,
    offset: f64,
    farthest: f64,
    nearest: f64,
    /// Unit front normal in the view: right, up, towards the viewer.
    pub(crate) normal: DVec3,
    /// Covers no point of the screen.
    is_edge_on: bool,
    /// How far an outline reaches beyond the triangle, in pixels.
    reach: f64,
}

/// An edge on the screen.
#[derive(Debug, Clone, Copy)]
struct Segment {
    start: DVec2,
    /// From the start to the end.
    along: DVec2,
    /// 1 / |along|², 0 for a segment seen end-on.
    inverse_squared: f64,
    /// Of the start and the end.
    depths: [f64; 2],
    /// Whether the sheet ends or turns over here, so that the line is drawn beyond its triangles too.
    is_outline: bool,
}

/// The sheet as the camera sees it.
#[derive(Debug)]
pub struct Surface<'a> {
    paper: &'a Paper<'a>,
    faces: Vec<ScreenFace>,
    segments: Vec<Segment>,
    /// [`TIE_TOLERANCE`] in pixels.
    tie: f64,
    /// Half the width of lines in pixels.
    half_width: f64,
}

impl<'a> Surface<'a> {
    /// The sheet of `paper` with its vertices at `positions`, seen by `camera`.
    ///
    /// Precondition: one finite position a vertex.
    pub fn new(paper: &'a Paper<'a>, positions: &[DVec3], camera: &Camera, style: &Style) -> Self {
        let points: Vec<DVec3> = positions.iter().map(|&p| camera.project(p)).collect();
        let corner = |v: u32| points[v as usize];
        let sheet = paper.sheet;
        let mut faces: Vec<ScreenFace> = sheet
            .faces
            .iter()
            .map(|&face| ScreenFace::new(face, face.map(corner)))
            .collect();
        let half_width = 0.5 * style.line_width;
        let mut segments = Vec::with_capacity(sheet.edges.len());
        for edge in &sheet.edges {
            let [left, right] = edge
                .faces
                .map(|face| Some(faces[face? as usize].faces_viewer()));
            segments.push(Segment::new(edge.vertices.map(corner), left != right));
        }
        for (index, face) in (0..).zip(&mut faces) {
            let mut edges = paper.edges_of_face(index).iter();
            if edges.any(|&edge| segments[edge as usize].is_outline) {
                face.reach = half_width;
            }
        }
        Self {
            paper,
            faces,
            segments,
            tie: TIE_TOLERANCE * sheet.unit_length * camera.scale(),
            half_width,
        }
    }

    /// The triangle in front at `point`, none where the background shows: outlines count with half their width.
    pub fn front_at(&self, point: DVec2) -> Option<Candidate> {
        let all: Vec<u32> = (0..self.faces.len() as u32).collect();
        self.front_among(&all, point, &mut Vec::new())
    }

    /// Whether `a` is in front of `b` where both may be seen.
    ///
    /// Exactly one of `in_front(a, b)` and `in_front(b, a)` holds for two triangles. The distance compared with the
    /// tolerance is the one across the layers, depth difference times the smaller cosine of the two normals to the
    /// view, so that it does not grow where layers are seen at a slant. The order counts where the triangles are
    /// nearly parallel and the viewer stands on the same side of both. Where it is unknown, a triangle goes before
    /// the outline of another that lies within the tolerance of its plane; else the nearer one is in front, ties by
    /// the lower index.
    pub fn in_front(&self, a: &Candidate, b: &Candidate) -> bool {
        let gap = (a.depth - b.depth).abs();
        if gap < self.tie_window(a.face, b.face)
            && let Some(a_is_front) = self.order(a.face, b.face)
        {
            return a_is_front;
        }
        if a.covers != b.covers {
            let covering = if a.covers { a } else { b };
            if gap * self.face(covering.face).normal.z.abs() < self.tie {
                return a.covers;
            }
        }
        a.depth > b.depth || (a.depth == b.depth && a.face < b.face)
    }

    /// The depth difference below which `f` and `g` count as coincident.
    fn tie_window(&self, f: u32, g: u32) -> f64 {
        let cosine = |face: u32| self.face(face).normal.z.abs();
        self.tie / cosine(f).min(cosine(g)).max(LEAST_COSINE)
    }

    /// Whether `f` lies before `g` by the layer order, as far as that is known and holds from here.
    fn order(&self, f: u32, g: u32) -> Option<bool> {
        if f > g {
            return self.order(g, f).map(|g_is_front| !g_is_front);
        }
        let (above, is_g_base) = match self.paper.layer_sign(f, g) {
            Some(sign) => (sign > 0, true),
            None => (self.paper.layer_sign(g, f)? > 0, false),
        };
        let (face_f, face_g) = (self.face(f), self.face(g));
        let cosine = face_f.normal.dot(face_g.normal);
        let are_parallel = cosine.abs() > PARALLEL_COSINE;
        let same_side = (cosine > 0.0) == (face_f.faces_viewer() == face_g.faces_viewer());
        let base = if is_g_base { face_g } else { face_f };
        let upper_is_front = above == base.faces_viewer();
        (are_parallel && same_side).then_some(upper_is_front == is_g_base)
    }

    /// The triangle in front at `point` of those in `list`.
    ///
    /// From the farthest to the nearest each candidate takes the place of the one before unless that one is in
    /// front of it. One that is in front of all others is found in any sequence; this one makes the answer the same
    /// for every order of the triangles even where noise and layer order contradict each other in a circle.
    pub(crate) fn front_among(
        &self,
        list: &[u32],
        point: DVec2,
        found: &mut Vec<Candidate>,
    ) -> Option<Candidate> {
        found.clear();
        found.extend(list.iter().filter_map(|&face| self.candidate(face, point)));
        if found.len() > 1 {
            found.sort_unstable_by(|a, b| {
                let by_depth = a.depth.total_cmp(&b.depth);
                by_depth.then(b.face.cmp(&a.face))
            });
        }
        let mut candidates = found.iter();
        let mut front = candidates.next()?;
        for candidate in candidates {
            if self.in_front(candidate, front) {
                front = candidate;
            }
        }
        Some(*front)
    }

    /// Triangle `face` at `point`: itself, or the outer half of its nearest outline.
    fn candidate(&self, face: u32, point: DVec2) -> Option<Candidate> {
        let screen = self.face(face);
        if screen.covers(point) {
            return Some(Candidate {
                face,
                depth: screen.depth(point),
                covers: true,
            });
        }
        if screen.reach == 0.0 || !screen.may_touch(point, 0.0) {
            return None;
        }
        let mut nearest = self.half_width * self.half_width;
        let mut depth = None;
        for &edge in self.paper.edges_of_face(face) {
            let segment = &self.segments[edge as usize];
            let (distance_squared, s) = segment.nearest(point);
            if segment.is_outline && distance_squared <= nearest {
                nearest = distance_squared;
                depth = Some(segment.depth(s));
            }
        }
        Some(Candidate {
            face,
            depth: depth?,
            covers: false,
        })
    }

    /// The drawn edge of the facet of `face` within `reach` pixels of `point`, the nearest of several.
    fn edge_within(&self, face: u32, point: DVec2, reach: f64) -> Option<u32> {
        let mut nearest = reach * reach;
        let mut found = None;
        for &edge in self.paper.edges_of_facet(face) {
            let (distance_squared, _) = self.segments[edge as usize].nearest(point);
            if distance_squared < nearest {
                nearest = distance_squared;
                found = Some(edge);
            }
        }
        found
    }

    /// The edge whose line covers `point` where triangle `face` is seen.
    ///
    /// Each triangle draws the halves of the lines of its facet that lie on it: a hidden line never shows, and no
    /// line needs a depth of its own.
    pub fn line_at(&self, face: u32, point: DVec2) -> Option<u32> {
        self.edge_within(face, point, self.half_width)
    }

    /// Whether a line that [`Surface::line_at`] finds may touch the square of half side `half` around `centre`.
    pub(crate) fn may_have_line(&self, face: u32, centre: DVec2, half: f64) -> bool {
        let reach = self.half_width + half * f64::sqrt(2.0);
        self.half_width > 0.0 && self.edge_within(face, centre, reach).is_some()
    }

    /// Whether no other triangle of `list` than `face` is seen in the square of half side `half` around `centre`,
    /// judged from bounds: true is certain, false is not. The list holds what may touch the square.
    pub(crate) fn fills(&self, face: u32, list: &[u32], centre: DVec2, half: f64) -> bool {
        let screen = self.face(face);
        if !screen.covers_square(centre, half) {
            return false;
        }
        let farthest = screen.depth(centre) - half * screen.steepness();
        list.iter()
            .all(|&other| other == face || self.is_before(face, farthest, other, centre, half))
    }

    /// Whether `face`, nowhere farther than `farthest`, is in front of `other` in the whole square.
    fn is_before(&self, face: u32, farthest: f64, other: u32, centre: DVec2, half: f64) -> bool {
        let screen = self.face(other);
        let rise = (half + screen.reach) * screen.steepness();
        let nearest = (screen.plane(centre) + rise).min(screen.nearest);
        let gap = farthest - nearest;
        let window = self.tie_window(face, other);
        if gap >= window {
            return true;
        }
        match self.order(face, other) {
            Some(is_front) => is_front && gap > -window,
            None => gap > 0.0,
        }
    }

    /// Whether triangle `face` or one of its outlines may show in the square.
    pub(crate) fn may_touch(&self, face: u32, centre: DVec2, half: f64) -> bool {
        self.face(face).may_touch(centre, half)
    }

    /// The box around triangle `face` with its outlines, on the screen.
    pub(crate) fn bounds(&self, face: u32) -> (DVec2, DVec2) {
        let screen = self.face(face);
        (screen.low - screen.reach, screen.high + screen.reach)
    }

    /// The prepared sheet.
    pub(crate) fn paper(&self) -> &Paper<'a> {
        self.paper
    }

    /// The triangles.
    pub(crate) fn faces(&self) -> &[ScreenFace] {
        &self.faces
    }

    fn face(&self, face: u32) -> &ScreenFace {
        &self.faces[face as usize]
    }
}

impl ScreenFace {
    fn new(vertices: [u32; 3], corners: [DVec3; 3]) -> Self {
        // In the view y runs up.
        let in_view = corners.map(|p| DVec3::new(p.x, -p.y, p.z));
        let across = (in_view[1] - in_view[0]).cross(in_view[2] - in_view[0]);
        let normal = across.try_normalize().unwrap_or(DVec3::Z);
        let depths = corners.map(|p| p.z);
        let nearest = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let farthest = depths.into_iter().fold(f64::INFINITY, f64::min);
        let is_edge_on = normal.z.abs() < 1e-9;
        let gradient = if is_edge_on {
            DVec2::ZERO
        } else {
            DVec2::new(-normal.x, normal.y) / normal.z
        };
        let offset = if is_edge_on {
            nearest
        } else {
            corners[0].z - gradient.dot(corners[0].truncate())
        };
        let flat = corners.map(DVec3::truncate);
        let inside = if normal.z < 0.0 { 1.0 } else { -1.0 };
        let side = |i: usize| {
            let j = (i + 1) % 3;
            if is_edge_on {
                Side::NOWHERE
            } else if vertices[i] < vertices[j] {
                Side::new(flat[i], flat[j], inside)
            } else {
                Side::new(flat[j], flat[i], -inside)
            }
        };
        Self {
            sides: [side(0), side(1), side(2)],
            low: flat[0].min(flat[1]).min(flat[2]),
            high: flat[0].max(flat[1]).max(flat[2]),
            gradient,
            offset,
            farthest,
            nearest,
            normal,
            is_edge_on,
            reach: 0.0,
        }
    }

    /// Whether the front is seen.
    pub(crate) fn faces_viewer(&self) -> bool {
        self.normal.z >= 0.0
    }

    /// Inclusive: a point on an edge lies on both its triangles, so no gap opens between them.
    fn covers(&self, point: DVec2) -> bool {
        let [a, b, c] = self.sides.map(|side| side.distance(point));
        a.min(b).min(c) >= 0.0
    }

    fn covers_square(&self, centre: DVec2, half: f64) -> bool {
        let inside = |side: &Side| side.distance(centre) >= half * side.n.abs().element_sum();
        self.sides.iter().all(inside)
    }

    fn may_touch(&self, centre: DVec2, half: f64) -> bool {
        let room = half + self.reach;
        let near_side = |side: &Side| {
            side.distance(centre) >= -(half * side.n.abs().element_sum() + self.reach)
        };
        (centre + room).cmpge(self.low).all()
            && (centre - room).cmple(self.high).all()
            && (self.is_edge_on || self.sides.iter().all(near_side))
    }

    fn plane(&self, point: DVec2) -> f64 {
        self.offset + self.gradient.dot(point)
    }

    /// Kept within the corners' depths: the plane of a triangle seen edge-on is steep beyond measure.
    fn depth(&self, point: DVec2) -> f64 {
        self.plane(point).clamp(self.farthest, self.nearest)
    }

    /// The largest change of depth a pixel along x and y together.
    fn steepness(&self) -> f64 {
        self.gradient.abs().element_sum()
    }
}

impl Side {
    /// Nothing lies inside: a triangle seen edge-on covers no point, only its outlines show.
    const NOWHERE: Self = Self {
        n: DVec2::ZERO,
        c: f64::NEG_INFINITY,
    };

    /// `inside` = 1 keeps the side that (−d.y, d.x) points to, d = end − start. Neighbours pass the same ends with
    /// opposite signs and get exactly opposite distances.
    fn new(start: DVec2, end: DVec2, inside: f64) -> Self {
        let d = end - start;
        let n = DVec2::new(-d.y, d.x).normalize_or_zero();
        Self {
            n: n * inside,
            c: -n.dot(start) * inside,
        }
    }

    fn distance(&self, point: DVec2) -> f64 {
        self.n.dot(point) + self.c
    }
}

impl Segment {
    fn new([start, end]: [DVec3; 2], is_outline: bool) -> Self {
        let along = (end - start).truncate();
        let length_squared = along.length_squared();
        Self {
            start: start.truncate(),
            along,
            inverse_squared: if length_squared > 0.0 {
                length_squared.recip()
            } else {
                0.0
            },
            depths: [start.z, end.z],
            is_outline,
        }
    }

    /// The squared distance of `point` and the parameter of the nearest point, 0 at the start, 1 at the end.
    fn nearest(&self, point: DVec2) -> (f64, f64) {
        let from_start = point - self.start;
        let s = (from_start.dot(self.along) * self.inverse_squared).clamp(0.0, 1.0);
        ((from_start - self.along * s).length_squared(), s)
    }

    fn depth(&self, s: f64) -> f64 {
        self.depths[0] + s * (self.depths[1] - self.depths[0])
    }
}
