//! The open built-in profiles that are drawn by hand: each is the curve of its control points.

use foldmotion_geometry::Closure;

use super::{CaseColumns, ProfileModel, Shape};

/// A foot lying on the ground, a steep wall, a roof of three segments, wall and foot: from the right foot over the roof
/// to the left one, mirror symmetric about x = 0. Doubled control points turn the curve sharply at the foot and at the
/// eaves; the feet are straight because four control points lie on the ground.
pub(super) const SHELTER: ProfileModel = ProfileModel {
    name: "shelter",
    title: "shelter: foot, wall, roof, wall, foot",
    shape: Shape::ControlPoints(&[
        [2.47, 0.0],
        [1.67, 0.0],
        [1.4, 0.0],
        [1.4, 0.0],
        [1.38, 0.49],
        [1.3, 1.02],
        [1.3, 1.02],
        [0.53, 1.66],
        [0.0, 1.67],
        [-0.53, 1.66],
        [-1.3, 1.02],
        [-1.3, 1.02],
        [-1.38, 0.49],
        [-1.4, 0.0],
        [-1.4, 0.0],
        [-1.67, 0.0],
        [-2.47, 0.0],
    ]),
    closure: Closure::Open,
    rows: 7,
    columns: CaseColumns { e: 5, t: 7, s: 3, ours: true },
    source: "drawn for foldmotion after figure 6a and table 1 (a) of the paper, which prints no control points",
};

/// A cantilever chair from the side: back, seat, front leg and the foot that runs back under the seat. Doubled control
/// points turn the curve sharply where the sides of the chair meet, about two and three segments apart.
pub(super) const CHAIR: ProfileModel = ProfileModel {
    name: "chair",
    title: "cantilever chair: back, seat, leg, foot",
    shape: Shape::ControlPoints(&[
        [-0.62, 2.62],
        [-0.5, 2.1],
        [-0.3, 1.55],
        [-0.15, 1.13],
        [-0.1, 1.0],
        [-0.1, 1.0],
        [0.25, 1.03],
        [0.65, 1.06],
        [1.0, 1.09],
        [1.0, 1.09],
        [0.95, 0.73],
        [0.9, 0.36],
        [0.84, 0.0],
        [0.84, 0.0],
        [0.47, 0.0],
        [0.1, 0.0],
        [-0.27, 0.0],
    ]),
    closure: Closure::Open,
    rows: 9,
    columns: CaseColumns { e: 4, t: 6, s: 2, ours: false },
    source: "drawn for foldmotion after figure 6b and table 1 (b) of the paper, which prints no control points",
};

/// A sheet that lies flat and rolls itself up for a turn and a half, each turn inside the one before.
pub(super) const ROLLING_PAPER: ProfileModel = ProfileModel {
    name: "rolling-paper",
    title: "sheet of paper, half rolled up",
    shape: Shape::ControlPoints(&[
        [4.6, 0.0],
        [3.6, 0.0],
        [2.4, 0.0],
        [1.2, 0.0],
        [0.0, 0.0],
        [-0.9, 0.42],
        [-1.28, 1.29],
        [-0.98, 2.13],
        [-0.24, 2.54],
        [0.54, 2.35],
        [0.96, 1.73],
        [0.86, 1.04],
        [0.35, 0.62],
        [-0.25, 0.66],
        [-0.64, 1.05],
        [-0.65, 1.56],
        [-0.35, 1.9],
    ]),
    closure: Closure::Open,
    rows: 12,
    columns: CaseColumns { e: 4, t: 6, s: 3, ours: true },
    source: "drawn for foldmotion after figure 6c and table 1 (c) of the paper, which prints no control points",
};

/// The letter Ω: from the right foot around the bowl to the left one, mirror symmetric about x = 0; the neck is
/// narrower than the bowl.
pub(super) const OMEGA: ProfileModel = ProfileModel {
    name: "omega",
    title: "capital omega",
    shape: Shape::ControlPoints(&[
        [2.0, 0.0],
        [1.4, 0.0],
        [0.75, 0.0],
        [0.45, 0.0],
        [0.42, 0.05],
        [0.45, 0.45],
        [1.1, 0.9],
        [1.35, 1.7],
        [0.85, 2.5],
        [0.0, 2.62],
        [-0.85, 2.5],
        [-1.35, 1.7],
        [-1.1, 0.9],
        [-0.45, 0.45],
        [-0.42, 0.05],
        [-0.45, 0.0],
        [-0.75, 0.0],
        [-1.4, 0.0],
        [-2.0, 0.0],
    ]),
    closure: Closure::Open,
    rows: 35,
    columns: CaseColumns { e: 5, t: 6, s: 4, ours: false },
    source: "drawn for foldmotion after figure 6e and table 1 (e) of the paper, which prints no control points",
};
