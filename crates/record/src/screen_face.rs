//! A triangle on the screen: what it covers, and how deep it lies.

use glam::{DVec2, DVec3};

use crate::square::Square;

/// A triangle on the screen.
#[derive(Debug, Clone)]
pub(crate) struct ScreenFace {
    sides: [Side; 3],
    low: DVec2,
    high: DVec2,
    /// depth = offset + gradient·p, kept within the depths of the corners.
    gradient: DVec2,
    /// The largest change of depth a pixel along x and y together.
    steepness: f64,
    offset: f64,
    farthest: f64,
    nearest: f64,
    /// Unit front normal in the view: right, up, towards the viewer.
    pub(crate) normal: DVec3,
    /// Covers no point of the screen.
    is_edge_on: bool,
    /// How far an outline reaches beyond the triangle, in pixels.
    pub(crate) reach: f64,
}

/// The side of a triangle's edge: n·p + c is the distance in pixels from the edge, positive inside.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Side {
    pub(crate) n: DVec2,
    c: f64,
    /// |n.x| + |n.y|: how much nearer a corner of a square may be than its centre, a pixel of half its side.
    spread: f64,
}

impl ScreenFace {
    pub(crate) fn new(vertices: [u32; 3], corners: [DVec3; 3]) -> Self {
        // In the view y runs up.
        let in_view = corners.map(|p| DVec3::new(p.x, -p.y, p.z));
        let across = (in_view[1] - in_view[0]).cross(in_view[2] - in_view[0]);
        let normal = across.try_normalize().unwrap_or(DVec3::Z);
        let depths = corners.map(|p| p.z);
        let nearest = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let farthest = depths.into_iter().fold(f64::INFINITY, f64::min);
        let is_edge_on = normal.z.abs() < 1e-9;
        let gradient =
            if is_edge_on { DVec2::ZERO } else { DVec2::new(-normal.x, normal.y) / normal.z };
        let offset =
            if is_edge_on { nearest } else { corners[0].z - gradient.dot(corners[0].truncate()) };
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
            steepness: gradient.abs().element_sum(),
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

    /// The size of the cosine between its normal and the view.
    pub(crate) fn cosine(&self) -> f64 {
        self.normal.z.abs()
    }

    /// Whether it covers no point of the screen.
    pub(crate) fn is_edge_on(&self) -> bool {
        self.is_edge_on
    }

    /// The low and the high corner of the box around it.
    pub(crate) fn extent(&self) -> [DVec2; 2] {
        [self.low, self.high]
    }

    /// The depth halfway between its farthest and its nearest corner.
    pub(crate) fn middle(&self) -> f64 {
        0.5 * (self.farthest + self.nearest)
    }

    /// The change of its plane's depth a pixel along x and y.
    pub(crate) fn gradient(&self) -> DVec2 {
        self.gradient
    }

    /// The sides of its edges.
    pub(crate) fn sides(&self) -> &[Side; 3] {
        &self.sides
    }

    /// Inclusive: a point on an edge lies on both its triangles, so no gap opens between them.
    pub(crate) fn covers(&self, point: DVec2) -> bool {
        self.sides.iter().all(|side| side.distance(point) >= 0.0)
    }

    /// Whether it covers all of `square`.
    pub(crate) fn covers_square(&self, square: &Square) -> bool {
        let is_inside = |side: &Side| side.distance(square.centre) >= side.width(square);
        self.sides.iter().all(is_inside)
    }

    /// Whether it or one of its outlines may show in `square`.
    pub(crate) fn may_touch(&self, square: &Square) -> bool {
        let room = square.half + self.reach;
        let near_side =
            |side: &Side| side.distance(square.centre) >= -(side.width(square) + self.reach);
        (square.centre + room).cmpge(self.low).all()
            && (square.centre - room).cmple(self.high).all()
            && (self.is_edge_on || self.sides.iter().all(near_side))
    }

    /// The depth of its plane.
    #[inline]
    pub(crate) fn plane(&self, point: DVec2) -> f64 {
        self.offset + self.gradient.dot(point)
    }

    /// `f64::clamp` checks its bounds each time.
    #[inline]
    fn within(&self, depth: f64) -> f64 {
        let depth = if depth > self.nearest { self.nearest } else { depth };
        if depth < self.farthest { self.farthest } else { depth }
    }

    /// Kept within the corners' depths: the plane of a triangle seen edge-on is steep beyond measure.
    #[inline]
    pub(crate) fn depth(&self, point: DVec2) -> f64 {
        self.within(self.plane(point))
    }

    /// The farthest and the nearest it may be within `room` pixels of `square`.
    pub(crate) fn depths(&self, square: &Square, room: f64) -> [f64; 2] {
        if self.is_edge_on {
            return [self.farthest, self.nearest];
        }
        let plane = self.plane(square.centre);
        let rise = (square.half + room) * self.steepness;
        [self.within(plane - rise), self.within(plane + rise)]
    }
}

impl Side {
    /// Nothing lies inside: a triangle seen edge-on covers no point, only its outlines show.
    const NOWHERE: Self = Self { n: DVec2::ZERO, c: f64::NEG_INFINITY, spread: 0.0 };

    /// `inside` = 1 keeps the side that (−d.y, d.x) points to, d = end − start. Neighbours pass the same ends with
    /// opposite signs and get exactly opposite distances.
    fn new(start: DVec2, end: DVec2, inside: f64) -> Self {
        let d = end - start;
        let n = DVec2::new(-d.y, d.x).normalize_or_zero();
        Self { n: n * inside, c: -n.dot(start) * inside, spread: n.abs().element_sum() }
    }

    #[inline]
    pub(crate) fn distance(&self, point: DVec2) -> f64 {
        self.n.dot(point) + self.c
    }

    /// How much nearer or farther than its centre the points of `square` are.
    fn width(&self, square: &Square) -> f64 {
        square.half * self.spread
    }
}
