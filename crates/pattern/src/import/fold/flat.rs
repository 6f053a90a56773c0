//! A FOLD pattern in the plane z = 0, fronts up.

use glam::{DVec2, DVec3};

use super::super::{ImportError, check_extent};
use super::FoldPattern;
use crate::FrameNumber;

/// How far from a plane the vertices of a flat pattern may lie, in parts of their extent.
const FLATNESS: f64 = 1e-6;

/// The vertices in their plane.
///
/// x and y as they are where all z are equal and the faces counter-clockwise; otherwise turned so that the front of the
/// faces, or without faces the side from which z (else y, else x) grows, faces up, and x stays along x where it can.
pub(super) fn in_plane(pattern: &FoldPattern<'_>) -> Result<Vec<DVec2>, ImportError> {
    let points = pattern.coordinates;
    let size = size(pattern)?;
    let (low, high) = bounds(pattern);
    let Some(normal) = normal(pattern, size) else {
        // Without area; that is found where facets are cut.
        return Ok(points.iter().map(|p| p.truncate()).collect());
    };
    let origin = if low.z == high.z { DVec3::new(0.0, 0.0, low.z) } else { points[0] };
    let origin = used(pattern)
        .next()
        .map_or(origin, |&v| if low.z == high.z { origin } else { points[v as usize] });
    let height = |&v: &u32| (v, (points[v as usize] - origin).dot(normal).abs());
    let highest = used(pattern).map(height).max_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((vertex, height)) = highest.filter(|(_, h)| *h > FLATNESS * size) {
        return Err(ImportError::NotFlat {
            frame: FrameNumber(pattern.frame),
            vertex: vertex as usize,
            height,
            limit: FLATNESS * size,
        });
    }
    if normal == DVec3::Z {
        return Ok(points.iter().map(|p| p.truncate()).collect());
    }
    let along = |axis: DVec3| axis - normal * axis.dot(normal);
    let x = if along(DVec3::X).length() > 0.1 {
        along(DVec3::X).normalize()
    } else {
        along(DVec3::Y).normalize()
    };
    let y = normal.cross(x);
    Ok(points.iter().map(|p| DVec2::new(p.dot(x), p.dot(y))).collect())
}

/// The vertices of faces and edges.
pub(super) fn used<'a>(pattern: &'a FoldPattern<'_>) -> impl Iterator<Item = &'a u32> {
    pattern.faces.iter().flatten().chain(pattern.edges.iter().flatten())
}

/// The lower and the upper corner of the vertices used.
fn bounds(pattern: &FoldPattern<'_>) -> (DVec3, DVec3) {
    let used = used(pattern).map(|&v| pattern.coordinates[v as usize]);
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    used.fold(none, |(low, high), p| (low.min(p), high.max(p)))
}

/// The extent of the vertices used.
///
/// # Errors
/// [`ImportError::Empty`], [`ImportError::Extent`].
pub(super) fn size(pattern: &FoldPattern<'_>) -> Result<f64, ImportError> {
    let (low, high) = bounds(pattern);
    if !low.is_finite() {
        return Err(ImportError::Empty);
    }
    let flat_bounds = |a: DVec3| DVec2::new(a.truncate().length(), a.z);
    check_extent(flat_bounds(DVec3::ZERO), flat_bounds(high - low))
}

/// The unit normal of the pattern; `None` if it has no area.
fn normal(pattern: &FoldPattern<'_>, size: f64) -> Option<DVec3> {
    let points = pattern.coordinates;
    let (low, high) = bounds(pattern);
    let is_level = low.z == high.z;
    let area = |face: &Vec<u32>| {
        let first = points[*face.first()? as usize];
        let corner = |v: &u32| points[*v as usize] - first;
        let pairs = face.windows(2);
        Some(pairs.map(|p| corner(&p[0]).cross(corner(&p[1]))).sum::<DVec3>())
    };
    let total: DVec3 = pattern.faces.iter().filter_map(area).sum();
    if total.length() > 1e-12 * size * size {
        let normal = total.normalize();
        // Exactly, so that coordinates stay as they are.
        return Some(if is_level { DVec3::Z * normal.z.signum() } else { normal });
    }
    if is_level {
        return Some(DVec3::Z);
    }
    let first = points[pattern.edges.first()?[0] as usize];
    let ends = || pattern.edges.iter().flatten().map(|&v| points[v as usize] - first);
    let longest = ends().max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let across = ends().map(|p| longest.cross(p));
    let normal = across.max_by(|a, b| a.length().total_cmp(&b.length()))?;
    if normal.length() <= 1e-12 * size * size {
        return None;
    }
    let normal = normal.normalize();
    let lead = [normal.z, normal.y, normal.x].into_iter().find(|c| c.abs() > 1e-9)?;
    Some(normal * lead.signum())
}
