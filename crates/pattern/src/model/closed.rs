//! The closed built-in profiles that are drawn by hand: each is the curve of its control points.

use foldmotion_geometry::Closure;

use super::{CaseColumns, ProfileModel, Shape};

/// A mushroom from the side: from the right corner of the foot up the stem and over the cap, mirror symmetric about x =
/// 0; the seam is a corner of the foot, whose flat underside is one segment.
pub(super) const MUSHROOM: ProfileModel = ProfileModel {
    name: "mushroom",
    title: "mushroom: stem and cap",
    shape: Shape::ControlPoints(&[
        [0.31, 0.0],
        [0.31, 0.4],
        [0.31, 0.8],
        [0.31, 1.22],
        [0.31, 1.22],
        [0.7, 1.18],
        [1.05, 1.13],
        [1.36, 1.12],
        [1.36, 1.35],
        [1.25, 1.85],
        [0.75, 2.3],
        [0.0, 2.4],
        [-0.75, 2.3],
        [-1.25, 1.85],
        [-1.36, 1.35],
        [-1.36, 1.12],
        [-1.05, 1.13],
        [-0.7, 1.18],
        [-0.31, 1.22],
        [-0.31, 1.22],
        [-0.31, 0.8],
        [-0.31, 0.4],
        [-0.31, 0.0],
        [-0.31, 0.0],
        [-0.1, 0.0],
        [0.1, 0.0],
        [0.31, 0.0],
    ]),
    closure: Closure::Corner,
    rows: 14,
    columns: CaseColumns { e: 3, t: 5, s: 2, ours: false },
    source: "drawn for foldmotion after figure 6f and table 1 (f) of the paper, which prints no control points",
};

/// A whale swimming to the left, its fluke raised: from the notch of the fluke over the back and the head to the belly.
/// The seam is the notch.
pub(super) const WHALE: ProfileModel = ProfileModel {
    name: "whale",
    title: "whale with its fluke raised",
    shape: Shape::ControlPoints(&[
        [2.62, 1.42],
        [2.55, 1.58],
        [2.3, 1.9],
        [1.85, 2.05],
        [1.8, 1.85],
        [2.2, 1.5],
        [2.35, 1.1],
        [2.1, 0.85],
        [1.4, 0.9],
        [0.4, 1.3],
        [-0.7, 1.5],
        [-1.75, 1.35],
        [-2.2, 0.85],
        [-2.25, 0.25],
        [-1.7, -0.2],
        [-0.6, -0.38],
        [0.6, -0.3],
        [1.6, 0.1],
        [2.35, 0.72],
        [2.8, 1.12],
        [3.15, 1.45],
        [3.42, 1.9],
        [3.3, 2.0],
        [2.8, 1.6],
        [2.62, 1.42],
    ]),
    closure: Closure::Corner,
    rows: 20,
    columns: CaseColumns { e: 3, t: 4, s: 2, ours: true },
    source: "drawn for foldmotion after figure 6g and table 1 (g) of the paper, which prints no control points",
};
