//! What the examples share: a motion from a file, and strains of its triangles.

use std::error::Error;
use std::fs::File;
use std::io::BufReader;

use foldmotion_pattern::{FoldError, FoldFile, LayerOrder, Motion, Sheet};
use glam::DVec3;

/// The largest change of length of a triangle's edges, per cent.
pub(crate) fn strains(sheet: &Sheet, positions: &[DVec3]) -> Vec<f64> {
    let flat = sheet.planar();
    let strain = |face: &[u32; 3]| {
        let edges = [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3]].map(|v| v as usize));
        let changes = edges.map(|[a, b]| {
            let rest = flat[a].distance(flat[b]);
            100.0 * (positions[a].distance(positions[b]) / rest - 1.0).abs()
        });
        changes.into_iter().fold(0.0, f64::max)
    };
    sheet.faces.iter().map(strain).collect()
}

/// The motion in the file, with the layer order of its last frame.
pub(crate) fn read(path: &str) -> Result<Motion, Box<dyn Error>> {
    let file = FoldFile::read(BufReader::new(File::open(path)?))?;
    let mut frames = Vec::new();
    let mut last = LayerOrder::default();
    file.frames::<FoldError>(BufReader::new(File::open(path)?), &mut |frame, order| {
        frames.push(frame);
        last = order.clone();
        Ok(())
    })?;
    // The order is that of the faces in the file; triangles of one face do not overlap.
    let mut of_face = vec![Vec::new(); file.polygons.len()];
    for (triangle, &face) in (0..).zip(&file.triangle_faces) {
        of_face[face as usize].push(triangle);
    }
    let mut compact_order = LayerOrder::default();
    for (f, g, sign) in last.iter() {
        for &a in &of_face[f as usize] {
            for &b in &of_face[g as usize] {
                compact_order.insert(a, b, sign);
            }
        }
    }
    Ok(Motion {
        sheet: file.sheet,
        frames,
        compact_order,
    })
}
