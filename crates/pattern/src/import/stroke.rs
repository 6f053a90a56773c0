//! What a drawing is made of: strokes of straight pieces and curves, with what they mean.

use std::f64::consts::{FRAC_PI_4, PI};

use glam::{DAffine2, DVec2};

use super::Source;
use super::drawing::Role;
use super::names::Names;

/// The most chords of a curve.
const MOST_CHORDS: f64 = 1_000.0;

/// A piece of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Piece {
    Line([DVec2; 2]),
    /// A cubic Bézier curve by its control points.
    Curve([DVec2; 4]),
}

/// An element that means something.
#[derive(Debug)]
pub(super) struct Stroke {
    pub(super) source: Source,
    pub(super) names: Names,
    pub(super) role: Role,
    /// The target fold angle, radians.
    pub(super) target: f64,
    pub(super) pieces: Vec<Piece>,
}

impl Piece {
    pub(super) fn points(&self) -> &[DVec2] {
        match self {
            Self::Line(points) => points,
            Self::Curve(points) => points,
        }
    }

    pub(super) fn transformed(self, transform: &DAffine2) -> Self {
        match self {
            Self::Line(points) => Self::Line(points.map(|p| transform.transform_point2(p))),
            Self::Curve(points) => Self::Curve(points.map(|p| transform.transform_point2(p))),
        }
    }

    /// The quadratic Bézier curve of these control points, as a cubic.
    pub(super) fn quadratic([a, b, c]: [DVec2; 3]) -> Self {
        Self::Curve([a, a.lerp(b, 2.0 / 3.0), c.lerp(b, 2.0 / 3.0), c])
    }

    /// Points in order on the piece, such that it strays from the chords between them by no more than `tolerance`.
    ///
    /// The second derivative of a cubic is at most 6 M, M the longer of its second differences, so that n chords stray
    /// by at most 6 M / (8 n²).
    pub(super) fn chords(&self, tolerance: f64) -> Vec<DVec2> {
        let [a, b, c, d] = match *self {
            Self::Line(ends) => return ends.to_vec(),
            Self::Curve(points) => points,
        };
        let second = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
        #[expect(clippy::cast_sign_loss, reason = "clamped to at least 1")]
        let count = (0.75 * second / tolerance).sqrt().ceil().clamp(1.0, MOST_CHORDS) as u32;
        let at = |i: u32| {
            let t = f64::from(i) / f64::from(count);
            let s = 1.0 - t;
            a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
        };
        // The ends exactly.
        (0..=count)
            .map(|i| match i {
                0 => a,
                _ if i == count => d,
                _ => at(i),
            })
            .collect()
    }
}

/// Straight pieces from point to point, and back to the first if `closed`.
pub(super) fn chain(points: &[DVec2], closed: bool) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = points.windows(2).map(|p| Piece::Line([p[0], p[1]])).collect();
    if let (true, [first, .., last]) = (closed, points) {
        pieces.push(Piece::Line([*last, *first]));
    }
    pieces
}

/// An arc of an ellipse: centre + u cos φ + v sin φ, for φ from `start` on by `sweep` (radians).
///
/// Each piece spans at most 45°, so that it strays from the arc by 4e-6 of the longer of u and v (Goldapp 1991).
pub(super) fn arc(centre: DVec2, [u, v]: [DVec2; 2], start: f64, sweep: f64) -> Vec<Piece> {
    let sweep = sweep.clamp(-2.0 * PI, 2.0 * PI);
    #[expect(clippy::cast_sign_loss, reason = "the length of an arc is positive")]
    let count = ((sweep.abs() / FRAC_PI_4 - 1e-9).ceil() as u32).max(1);
    let step = sweep / f64::from(count);
    let handle = 4.0 / 3.0 * (step / 4.0).tan();
    let at = |i: u32| start + step * f64::from(i);
    let point = |i: u32| {
        // A whole ellipse ends where it starts.
        let is_end_of_whole = i == count && sweep.abs() == 2.0 * PI;
        let angle = at(if is_end_of_whole { 0 } else { i });
        centre + u * angle.cos() + v * angle.sin()
    };
    let along = |i: u32| handle * (v * at(i).cos() - u * at(i).sin());
    (0..count)
        .map(|i| {
            let (a, d) = (point(i), point(i + 1));
            Piece::Curve([a, a + along(i), d - along(i + 1), d])
        })
        .collect()
}
