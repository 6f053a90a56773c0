//! What the edges of a FOLD frame mean.

use std::f64::consts::PI;

use super::super::drawing::{Line, Role};
use super::super::warning::{WarningKind, Warnings};
use super::super::{ImportError, Source};
use super::FoldPattern;
use super::frames::Frames;
use super::sides::Sides;

/// Angles up to this are those of a flat facet after rounding, degrees.
const ROUNDING_DEGREES: f64 = 1e-6;

/// The role of an edge and its target angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EdgeMeaning {
    pub(super) role: Role,
    /// Radians; 0 unless it is a crease.
    pub(super) target: f64,
    pub(super) warning: Option<WarningKind>,
    /// Whether the file gives the angle itself.
    pub(super) has_angle: bool,
}

/// The meaning of every edge of a frame.
pub(super) fn meanings(
    frames: &Frames,
    frame: usize,
    edges: usize,
) -> Result<Vec<EdgeMeaning>, ImportError> {
    let letters = frames.assignments(frame);
    let angles = frames.angles(frame);
    check_count("edges_assignment", letters.map(<[_]>::len), edges)?;
    check_count("edges_foldAngle", angles.map(<[_]>::len), edges)?;
    check_angles("edges_foldAngle", angles.unwrap_or(&[]))?;
    let staged = staged_signs(frames, frame, edges);
    (0..edges)
        .map(|edge| {
            let upper = letters.map(|l| l[edge].to_ascii_uppercase());
            let letter = upper.as_deref();
            let angle = match (angles, letter) {
                (Some(angles), _) => angles[edge],
                (None, Some("M")) => Some(-180.0),
                (None, Some("V")) => Some(180.0),
                (None, _) => None,
            };
            let is_given = angles.is_some_and(|angles| angles[edge].is_some());
            let meaning = meaning(letter, angle, staged[edge]);
            let meaning = meaning.map(|meaning| EdgeMeaning { has_angle: is_given, ..meaning });
            meaning.ok_or_else(|| ImportError::Assignment {
                edge,
                found: letter.unwrap_or("").chars().take(40).collect(),
            })
        })
        .collect()
}

/// The sign of the first angle that a stage gives each edge; 0 if none drives it.
fn staged_signs(frames: &Frames, pattern: usize, edges: usize) -> Vec<f64> {
    let mut signs = vec![0.0; edges];
    for (_, frame) in frames.stages(pattern) {
        let angles = frame.angles.iter().flatten();
        for (sign, angle) in signs.iter_mut().zip(angles) {
            if *sign == 0.0 {
                let bent = angle.filter(|a| a.abs() > ROUNDING_DEGREES);
                *sign = bent.map_or(0.0, f64::signum);
            }
        }
    }
    signs
}

/// The meaning of a letter and an angle in degrees; `None` for a letter that FOLD does not have.
fn meaning(letter: Option<&str>, angle: Option<f64>, staged: f64) -> Option<EdgeMeaning> {
    let plain = |role, warning| EdgeMeaning { role, target: 0.0, warning, has_angle: false };
    let crease = |sign: f64, degrees: f64, warning| EdgeMeaning {
        role: if sign < 0.0 { Role::Mountain } else { Role::Valley },
        target: degrees * (PI / 180.0),
        warning,
        has_angle: false,
    };
    let drawn = match letter {
        Some("M") => -1.0,
        Some("V") => 1.0,
        _ => 0.0,
    };
    let bent = angle.filter(|a| a.abs() > ROUNDING_DEGREES);
    Some(match (letter, bent) {
        (Some("B"), _) => plain(Role::Border, None),
        (Some("C"), _) => plain(Role::Cut, None),
        (Some("M" | "V"), Some(a)) => {
            let agrees = drawn * a > 0.0;
            crease(a, a, (!agrees).then_some(WarningKind::OtherSign))
        }
        (Some("F" | "J" | "U") | None, Some(a)) => crease(a, a, None),
        (Some("M" | "V"), None) if angle.is_some() || staged != 0.0 => crease(drawn, 0.0, None),
        (Some("M" | "V"), None) => plain(Role::Free, Some(WarningKind::MadeFree)),
        (Some("F" | "J" | "U") | None, None) if staged != 0.0 => crease(staged, 0.0, None),
        (Some("F" | "J"), None) => plain(Role::Facet, None),
        (Some("U"), None) => plain(Role::Free, None),
        (None, None) if angle.is_some() => plain(Role::Facet, None),
        (None, None) => plain(Role::Free, Some(WarningKind::Unassigned)),
        (Some(_), _) => return None,
    })
}

/// Every edge as a line; `sides`: the faces at each, where they are known.
pub(super) fn lines(
    pattern: &FoldPattern<'_>,
    sides: &Sides,
    warnings: &mut Warnings,
) -> Vec<Line> {
    let edges = pattern.edges.iter().zip(&pattern.meanings);
    let line = |((&ends, meaning), source): ((&[u32; 2], &EdgeMeaning), u32)| {
        let mut line =
            Line { ends, role: meaning.role, target: meaning.target, source, is_curved: false };
        let is_outer = sides.get(&line.key()).is_some_and(|faces| faces.len() == 1);
        match meaning.warning {
            // Only its position says what it is.
            Some(WarningKind::Unassigned) if is_outer => line.role = Role::Border,
            Some(kind) => warnings.add(kind, &Source::FoldEdge(source)),
            None => {}
        }
        line
    };
    edges.zip(0..).map(line).collect()
}

pub(super) fn check_count(
    key: &str,
    found: Option<usize>,
    edges: usize,
) -> Result<(), ImportError> {
    match found {
        Some(found) if found != edges => Err(ImportError::Count {
            key: key.to_owned(),
            found,
            expected: edges,
            of: "edges_vertices",
        }),
        _ => Ok(()),
    }
}

/// Refuses angles beyond a half turn.
pub(super) fn check_angles(key: &str, angles: &[Option<f64>]) -> Result<(), ImportError> {
    for (edge, angle) in angles.iter().enumerate() {
        match angle {
            Some(degrees) if !(-180.0..=180.0).contains(degrees) => {
                return Err(ImportError::FoldAngle {
                    key: key.to_owned(),
                    edge,
                    degrees: *degrees,
                });
            }
            _ => {}
        }
    }
    Ok(())
}
