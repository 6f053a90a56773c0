//! The visible surface: which triangle is in front at a point of the screen.
//!
//! Every triangle is a plane, depth = c + g·p, over its projection. Where a point p lies on several triangles, the
//! one nearer to the viewer is in front, unless two of them lie closer to each other than [`TIE_TOLERANCE`] and their
//! layer order is known: then the order decides. Films ask this at the samples of pixels; figures can ask it at
//! points of an arrangement of edges. Both get the same answers, from [`Surface::in_front`].

mod samples;

use glam::{DVec2, DVec3};
use pulp::Arch;

use self::samples::{FindLayer, FindLines};
use crate::screen_face::ScreenFace;
use crate::segment::Segment;
use crate::square::{Mask, SAMPLES, Square, members};
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
    /// The index of the triangle.
    pub face: u32,
    /// Its depth there in pixels, larger is nearer.
    pub depth: f64,
    /// Whether the triangle itself covers the point; else only the outer half of one of its outlines does.
    pub covers: bool,
}

/// The comparison of two triangles.
struct Comparison {
    /// The depth difference below which they count as coincident.
    window: f64,
    /// Whether the first is in front there, if that is known.
    order: Option<bool>,
    /// For each, the depth difference below which it goes before an outline of the other.
    touch: [f64; 2],
    /// Beyond this depth difference the nearer one is in front.
    reach: f64,
    /// Whether the first has the lower index.
    is_first: bool,
}

impl Comparison {
    /// Whether the first is in front where it is nearer by `gap`. `covers`: whether they cover the point themselves.
    fn is_front(&self, gap: f64, covers: [bool; 2]) -> bool {
        let distance = gap.abs();
        if distance < self.window
            && let Some(is_front) = self.order
        {
            return is_front;
        }
        match covers {
            [true, false] if distance < self.touch[0] => true,
            [false, true] if distance < self.touch[1] => false,
            _ => gap > 0.0 || (gap == 0.0 && self.is_first),
        }
    }
}

/// A triangle at the samples of a pixel.
#[derive(Debug)]
pub(crate) struct Layer {
    pub(crate) face: u32,
    /// The samples that it covers.
    pub(crate) covered: Mask,
    /// Those that only its outlines cover.
    pub(crate) outlined: Mask,
    /// At each of these samples, larger is nearer.
    pub(crate) depths: [f64; SAMPLES],
}

impl Layer {
    /// The samples at which it may be seen.
    pub(crate) fn shown(&self) -> Mask {
        self.covered | self.outlined
    }

    /// At sample `k`, if it may be seen there.
    pub(crate) fn candidate(&self, k: usize) -> Option<Candidate> {
        (self.shown() >> k & 1 == 1).then_some(Candidate {
            face: self.face,
            depth: self.depths[k],
            covers: self.covered >> k & 1 == 1,
        })
    }
}

/// The sheet as the camera sees it.
#[derive(Debug)]
pub struct Surface<'a> {
    paper: &'a Paper<'a>,
    /// The vertices on the screen.
    points: Vec<DVec3>,
    faces: Vec<ScreenFace>,
    segments: Vec<Segment>,
    /// [`TIE_TOLERANCE`] in pixels.
    tie: f64,
    /// Half the width of lines in pixels.
    half_width: f64,
    /// The instruction set of the machine.
    arch: Arch,
}

impl<'a> Surface<'a> {
    /// The sheet of `paper` with its vertices at `positions`, seen by `camera`.
    ///
    /// Precondition: one finite position a vertex.
    pub fn new(paper: &'a Paper<'a>, positions: &[DVec3], camera: &Camera, style: &Style) -> Self {
        let points: Vec<DVec3> = positions.iter().map(|&p| camera.project(p)).collect();
        let corner = |v: u32| points[v as usize];
        let sheet = paper.sheet;
        let mut faces: Vec<ScreenFace> =
            sheet.faces.iter().map(|&face| ScreenFace::new(face, face.map(corner))).collect();
        let half_width = 0.5 * style.line_width;
        let mut segments = Vec::with_capacity(sheet.edges.len());
        for edge in &sheet.edges {
            let [left, right] = edge.faces.map(|face| Some(faces[face? as usize].faces_viewer()));
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
            points,
            faces,
            segments,
            tie: TIE_TOLERANCE * sheet.unit_length * camera.scale(),
            half_width,
            arch: Arch::new(),
        }
    }

    /// The triangle in front at `point`, `None` if the background shows: outlines count with half their width.
    pub fn front_at(&self, point: DVec2) -> Option<Candidate> {
        let all: Vec<u32> = (0..self.faces.len() as u32).collect();
        self.front_among(&all, point, &mut Vec::new())
    }

    /// Whether `a` is in front of `b` where both may be seen.
    ///
    /// Exactly one of `in_front(a, b)` and `in_front(b, a)` holds for two triangles. The distance compared with the
    /// tolerance is the one across the layers, depth difference times the smaller cosine of the two normals to the
    /// view, so that it does not grow where layers are seen at a slant. The order counts where the triangles are
    /// nearly parallel and the viewer is on the same side of both. Where it is unknown, a triangle goes before
    /// the outline of another that lies within the tolerance of its plane; else the nearer one is in front, ties by
    /// the lower index.
    pub fn in_front(&self, a: &Candidate, b: &Candidate) -> bool {
        let gap = a.depth - b.depth;
        let pair = self.pair(a.face, b.face, gap.abs());
        pair.is_front(gap, [a.covers, b.covers])
    }

    /// The samples at which `a` is in front of `b`, of those in `asked`, where both may be seen.
    pub(crate) fn before(&self, a: &Layer, b: &Layer, asked: Mask) -> Mask {
        let mut gaps = a.depths;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (gap, depth) in gaps.iter_mut().zip(b.depths) {
            *gap -= depth;
            low = if *gap < low { *gap } else { low };
            high = if *gap > high { *gap } else { high };
        }
        let pair = self.pair(a.face, b.face, low.max(-high));
        if low > pair.reach {
            return asked;
        }
        if high < -pair.reach {
            return 0;
        }
        let is_front = |k: usize| {
            let covers = [a.covered, b.covered].map(|covered| covered >> k & 1 == 1);
            pair.is_front(gaps[k], covers)
        };
        members(asked).fold(0, |mask, k| mask | Mask::from(is_front(k)) << k)
    }

    /// How triangles `f` and `g` compare where their depths differ by at least `closest`.
    fn pair(&self, f: u32, g: u32, closest: f64) -> Comparison {
        let cosines = [f, g].map(|face| self.face(face).cosine());
        let reach = self.tie / cosines[0].min(cosines[1]);
        let window = self.tie_window(f, g);
        let order = if closest < window { self.order(f, g) } else { None };
        Comparison {
            window,
            order,
            touch: cosines.map(|cosine| self.tie / cosine),
            reach,
            is_first: f < g,
        }
    }

    /// The depth difference below which `f` and `g` count as coincident.
    fn tie_window(&self, f: u32, g: u32) -> f64 {
        let cosine = self.face(f).cosine().min(self.face(g).cosine());
        self.tie / cosine.max(LEAST_COSINE)
    }

    /// Whether `f` lies before `g` by the layer order, as far as that is known and holds from here.
    fn order(&self, f: u32, g: u32) -> Option<bool> {
        if f > g {
            return self.order(g, f).map(|g_is_front| !g_is_front);
        }
        let (face_f, face_g) = (self.face(f), self.face(g));
        let cosine = face_f.normal.dot(face_g.normal);
        let same_side = (cosine > 0.0) == (face_f.faces_viewer() == face_g.faces_viewer());
        if cosine.abs() <= PARALLEL_COSINE || !same_side {
            return None;
        }
        let (above, is_g_base) = match self.paper.layer_sign(f, g) {
            Some(sign) => (sign > 0, true),
            None => (self.paper.layer_sign(g, f)? > 0, false),
        };
        let base = if is_g_base { face_g } else { face_f };
        let upper_is_front = above == base.faces_viewer();
        Some(upper_is_front == is_g_base)
    }

    /// The triangle in front at `point` of those in `list`.
    pub(crate) fn front_among(
        &self,
        list: &[u32],
        point: DVec2,
        found: &mut Vec<Candidate>,
    ) -> Option<Candidate> {
        found.clear();
        found.extend(list.iter().filter_map(|&face| self.candidate(face, point)));
        self.front_of(found)
    }

    /// The front one among those triangles that cover the point themselves.
    pub(crate) fn front_covering(
        &self,
        list: &[u32],
        point: DVec2,
        found: &mut Vec<Candidate>,
    ) -> Option<Candidate> {
        found.clear();
        let covering = list.iter().filter(|&&face| self.face(face).covers(point));
        found.extend(covering.map(|&face| Candidate {
            face,
            depth: self.face(face).depth(point),
            covers: true,
        }));
        self.front_of(found)
    }

    /// The one in front of those `found` at a point.
    ///
    /// From the farthest to the nearest each candidate replaces the one before unless that one is in
    /// front of it. One that is in front of all others is found in any sequence, mostly the nearest, which is tried
    /// first; this one makes the answer the same for every order of the triangles even where noise and layer order
    /// contradict each other in a circle.
    pub(crate) fn front_of(&self, found: &mut [Candidate]) -> Option<Candidate> {
        let by_depth =
            |a: &Candidate, b: &Candidate| a.depth.total_cmp(&b.depth).then(b.face.cmp(&a.face));
        let nearest = *found.iter().max_by(|a, b| by_depth(a, b))?;
        let mut others = found.iter().filter(|other| other.face != nearest.face);
        if others.all(|other| self.in_front(&nearest, other)) {
            return Some(nearest);
        }
        found.sort_unstable_by(by_depth);
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
            return Some(Candidate { face, depth: screen.depth(point), covers: true });
        }
        let square = Square { centre: point, half: 0.0 };
        if screen.reach == 0.0 || !screen.may_touch(&square) {
            return None;
        }
        Some(Candidate { face, depth: self.outline_depth(face, point)?, covers: false })
    }

    /// The depth of the nearest outline of triangle `face` that covers `point`.
    fn outline_depth(&self, face: u32, point: DVec2) -> Option<f64> {
        let mut nearest = self.half_width * self.half_width;
        let mut depth = None;
        for segment in self.outlines(face) {
            let (distance_squared, s) = segment.nearest(point);
            if distance_squared <= nearest {
                nearest = distance_squared;
                depth = Some(segment.depth(s));
            }
        }
        depth
    }

    /// Adds triangle `face` at the samples of the pixel around `centre` to `layers` where it may be seen.
    pub(crate) fn find_layer(&self, face: u32, centre: DVec2, layers: &mut Vec<Layer>) {
        let surface = self;
        self.arch.dispatch(FindLayer { surface, face, centre, layers });
    }

    fn outlines(&self, face: u32) -> impl Iterator<Item = &Segment> {
        let edges = self.paper.edges_of_face(face).iter();
        let segments = edges.map(|&edge| &self.segments[edge as usize]);
        segments.filter(|segment| segment.is_outline)
    }

    /// The edges whose lines may cover points where triangle `face` is seen.
    ///
    /// Each triangle draws the halves of the lines of its facet that lie on it: a hidden line never shows, and no
    /// line needs a depth of its own.
    pub(crate) fn lines(&self, face: u32) -> &[u32] {
        if self.half_width > 0.0 { self.paper.edges_of_facet(face) } else { &[] }
    }

    /// The edge whose line covers `point` where triangle `face` is seen, the nearest of several.
    pub fn line_at(&self, face: u32, point: DVec2) -> Option<u32> {
        let mut nearest = self.half_width * self.half_width;
        let mut found = None;
        for &edge in self.lines(face) {
            let (distance_squared, _) = self.segments[edge as usize].nearest(point);
            if distance_squared < nearest {
                nearest = distance_squared;
                found = Some(edge);
            }
        }
        found
    }

    /// Whether the line of `edge` may touch `square`.
    pub(crate) fn may_have_line(&self, edge: u32, square: &Square) -> bool {
        let reach = self.half_width + square.corner();
        self.segments[edge as usize].nearest(square.centre).0 < reach * reach
    }

    /// [`Surface::line_at`] for the samples of the pixel around `centre`: the lines of `edges` found in it, each with
    /// its samples.
    pub(crate) fn find_lines(&self, edges: &[u32], centre: DVec2, found: &mut Vec<(u32, Mask)>) {
        found.clear();
        let surface = self;
        self.arch.dispatch(FindLines { surface, edges, centre, found });
    }

    /// Whether no other triangle of `list` than `face` is seen in `square`, judged from bounds: true is certain, false
    /// is not. The list holds what may touch the square.
    pub(crate) fn fills(&self, face: u32, list: &[u32], square: &Square) -> bool {
        let screen = self.face(face);
        if !screen.covers_square(square) {
            return false;
        }
        let [farthest, _] = screen.depths(square, 0.0);
        list.iter().all(|&other| other == face || self.is_before(face, farthest, other, square))
    }

    /// Whether `face`, nowhere farther than `farthest`, is in front of `other` in the whole square.
    fn is_before(&self, face: u32, farthest: f64, other: u32, square: &Square) -> bool {
        let screen = self.face(other);
        let [_, nearest] = screen.depths(square, screen.reach);
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

    /// Drops from `list`, from index `start` on, the triangles hidden in all of `square` behind one that covers it;
    /// returns whether one covers it.
    ///
    /// Only what lies so deep that no order with any third triangle between them can lift it is dropped.
    pub(crate) fn drop_hidden(&self, list: &mut Vec<u32>, start: usize, square: &Square) -> bool {
        if let [only] = list[start..] {
            return self.face(only).covers_square(square);
        }
        let mut horizon = f64::NEG_INFINITY;
        for &face in &list[start..] {
            let screen = self.face(face);
            if screen.covers_square(square) {
                horizon = horizon.max(screen.depths(square, 0.0)[0]);
            }
        }
        let limit = horizon - 2.0 * self.tie / LEAST_COSINE;
        let mut end = start;
        for index in start..list.len() {
            let screen = self.face(list[index]);
            if screen.depths(square, screen.reach)[1] >= limit {
                list[end] = list[index];
                end += 1;
            }
        }
        list.truncate(end);
        horizon > f64::NEG_INFINITY
    }

    /// Where `front` covers `back`, it is in front if it is nearer by more than this.
    pub(crate) fn threshold(&self, front: u32, back: u32) -> f64 {
        let window = self.tie_window(front, back);
        match self.order(front, back) {
            Some(true) => -window,
            Some(false) => window,
            None => 0.0,
        }
    }

    /// [`Surface::threshold`] against an outline of `back` where `back` itself covers no point.
    pub(crate) fn outline_threshold(&self, front: u32, back: u32) -> f64 {
        match self.order(front, back) {
            Some(_) => self.threshold(front, back),
            None => -self.tie / self.face(front).cosine(),
        }
    }

    /// The vertices on the screen: pixels and depth.
    pub(crate) fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The sheet and its layer order.
    pub(crate) fn paper(&self) -> &Paper<'a> {
        self.paper
    }

    /// The triangles.
    pub(crate) fn faces(&self) -> &[ScreenFace] {
        &self.faces
    }

    /// Triangle `face`.
    pub(crate) fn face(&self, face: u32) -> &ScreenFace {
        &self.faces[face as usize]
    }
}
