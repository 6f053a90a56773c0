//! The pieces of a path.

use glam::DVec2;
use svgtypes::{PathParser, PathSegment};

use super::super::stroke::{Piece, arc};

/// A path being followed.
#[derive(Default)]
struct Pen {
    pieces: Vec<Piece>,
    start: DVec2,
    at: DVec2,
    /// The last control point of the curve just drawn, and whether it was cubic.
    control: Option<(DVec2, bool)>,
}

/// The pieces that the commands of a path draw; `None` if they cannot be read.
pub(super) fn path(text: &str) -> Option<Vec<Piece>> {
    let mut pen = Pen::default();
    for segment in PathParser::from(text) {
        pen.follow(segment.ok()?);
    }
    let is_finite = pen.pieces.iter().flat_map(Piece::points).all(|p| p.is_finite());
    is_finite.then_some(pen.pieces)
}

impl Pen {
    fn follow(&mut self, segment: PathSegment) {
        let from = self.at;
        let place = |abs: bool, x: f64, y: f64| {
            let point = DVec2::new(x, y);
            if abs { point } else { from + point }
        };
        let control = self.control.take();
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                self.at = place(abs, x, y);
                self.start = self.at;
            }
            PathSegment::LineTo { abs, x, y } => self.line(place(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                self.line(DVec2::new(place(abs, x, 0.0).x, from.y));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                self.line(DVec2::new(from.x, place(abs, 0.0, y).y));
            }
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.cubic([place(abs, x1, y1), place(abs, x2, y2), place(abs, x, y)]);
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let first = mirrored(from, control, true);
                self.cubic([first, place(abs, x2, y2), place(abs, x, y)]);
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                self.quadratic(place(abs, x1, y1), place(abs, x, y));
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                self.quadratic(mirrored(from, control, false), place(abs, x, y));
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let to = place(abs, x, y);
                let radii = DVec2::new(rx, ry).abs();
                let pieces =
                    elliptical(from, to, radii, x_axis_rotation.to_radians(), large_arc, sweep);
                self.pieces.extend(pieces);
                self.at = to;
            }
            PathSegment::ClosePath { .. } => {
                if self.at != self.start {
                    self.line(self.start);
                }
            }
        }
    }

    fn line(&mut self, to: DVec2) {
        self.pieces.push(Piece::Line([self.at, to]));
        self.at = to;
    }

    fn cubic(&mut self, [b, c, d]: [DVec2; 3]) {
        self.pieces.push(Piece::Curve([self.at, b, c, d]));
        (self.at, self.control) = (d, Some((c, true)));
    }

    fn quadratic(&mut self, b: DVec2, c: DVec2) {
        self.pieces.push(Piece::quadratic([self.at, b, c]));
        (self.at, self.control) = (c, Some((b, false)));
    }
}

/// The first control point of a smooth curve: the last one of the curve before, mirrored, if that was of the same kind.
fn mirrored(at: DVec2, control: Option<(DVec2, bool)>, is_cubic: bool) -> DVec2 {
    match control {
        Some((point, cubic)) if cubic == is_cubic => 2.0 * at - point,
        _ => at,
    }
}

/// An elliptical arc from its ends (SVG 1.1, appendix F.6.5 and F.6.6).
fn elliptical(
    from: DVec2,
    to: DVec2,
    mut radii: DVec2,
    rotation: f64,
    is_large: bool,
    is_positive: bool,
) -> Vec<Piece> {
    if from == to {
        return Vec::new();
    }
    if radii.min_element() <= 0.0 {
        return vec![Piece::Line([from, to])];
    }
    let turn = DVec2::from_angle(rotation);
    // Half the chord, in the directions of the axes.
    let half = DVec2::new(turn.dot(from - to), turn.perp_dot(from - to)) / 2.0;
    let reach = (half / radii).length_squared();
    if reach > 1.0 {
        radii *= reach.sqrt();
    }
    let [rx, ry] = radii.to_array();
    let across = (rx * half.y).powi(2) + (ry * half.x).powi(2);
    let off = (((rx * ry).powi(2) - across) / across).max(0.0).sqrt();
    let off = if is_large == is_positive { -off } else { off };
    let local = off * DVec2::new(rx * half.y / ry, -ry * half.x / rx);
    let centre = turn.rotate(local) + from.midpoint(to);
    let angle_of = |end: DVec2| ((end - local) / radii).to_angle();
    let start = angle_of(half);
    let sweep = (angle_of(-half) - start).rem_euclid(std::f64::consts::TAU);
    let sweep = if is_positive { sweep } else { sweep - std::f64::consts::TAU };
    let axes = [turn * rx, turn.perp() * ry];
    let mut pieces = arc(centre, axes, start, sweep);
    // The ends exactly.
    if let Some(Piece::Curve(first)) = pieces.first_mut() {
        first[0] = from;
    }
    if let Some(Piece::Curve(last)) = pieces.last_mut() {
        last[3] = to;
    }
    pieces
}

/// A whole ellipse, or a corner of a rounded rectangle: the axes along x and y.
pub(super) fn axis_parallel(centre: DVec2, radii: DVec2, start: f64, sweep: f64) -> Vec<Piece> {
    arc(centre, [DVec2::X * radii.x, DVec2::Y * radii.y], start, sweep)
}
