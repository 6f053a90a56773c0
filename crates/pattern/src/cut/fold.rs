//! The crease pattern as FOLD 1.2.
//!
//! Source: Demaine, Ku, Lang, "A New File Standard to Represent Folded Structures" (FOLD specification 1.2).

use serde_json::{Value, json};

use super::{CutError, CutOptions};
use crate::{Assignment, Edge, Sheet};

/// The crease pattern alone, as FOLD 1.2 in mm: vertices in the sheet's own axes, edges with assignment and target
/// fold angle (degrees, null on the border), faces.
///
/// The faces are the facets, unless `options.draws_facets`: then they are the triangles, joined by F edges.
/// `target_angles` as in [`super::CutPattern::new`].
///
/// # Errors
/// [`CutError`]: options out of range.
pub fn crease_pattern_fold(
    sheet: &Sheet,
    target_angles: &[f64],
    options: &CutOptions,
    creator: &str,
) -> Result<String, CutError> {
    options.check()?;
    let edges: Vec<(&Edge, f64)> = sheet
        .edges
        .iter()
        .zip(target_angles.iter().copied())
        .filter(|(edge, _)| options.draws_facets || edge.assignment != Assignment::Facet)
        .collect();
    let vertices = sheet
        .vertices
        .iter()
        .map(|&v| (v * options.scale).to_array());
    let angle = |(edge, angle): &(&Edge, f64)| edge.is_hinge().then(|| angle.to_degrees());
    let mut fields = vec![
        ("file_spec", json!(1.2)),
        ("file_creator", json!(creator)),
        ("file_title", json!(options.title)),
        ("file_description", json!(options.note)),
        ("file_classes", json!(["singleModel"])),
        ("frame_title", json!("crease pattern")),
        ("frame_classes", json!(["creasePattern"])),
        (
            "frame_attributes",
            json!(["2D", "manifold", "orientable", "noCuts", "noJoins"]),
        ),
        ("frame_unit", json!("mm")),
        (
            "foldmotion:unitLength",
            json!(sheet.unit_length * options.scale),
        ),
        ("vertices_coords", vertices.collect()),
        (
            "edges_vertices",
            edges.iter().map(|(edge, _)| json!(edge.vertices)).collect(),
        ),
        (
            "edges_assignment",
            edges
                .iter()
                .map(|(edge, _)| json!(edge.assignment))
                .collect(),
        ),
        (
            "edges_foldAngle",
            edges.iter().map(|e| json!(angle(e))).collect(),
        ),
    ];
    fields.extend(faces(sheet, options.draws_facets));
    let lines: Vec<String> = fields
        .iter()
        .map(|(key, value)| format!("\"{key}\": {value}"))
        .collect();
    Ok(format!("{{\n{}\n}}\n", lines.join(",\n")))
}

/// The faces and where they lie in the paper's units.
fn faces(sheet: &Sheet, are_triangles: bool) -> Vec<(&'static str, Value)> {
    let (polygons, facets): (Value, Vec<u32>) = if are_triangles {
        (json!(sheet.faces), sheet.face_facets.clone())
    } else {
        let polygons = sheet.facets.iter().map(|f| json!(f.polygon)).collect();
        (polygons, (0..sheet.facets.len() as u32).collect())
    };
    let of = |value: fn(&crate::Facet) -> Value| -> Value {
        let facet = |&index: &u32| value(&sheet.facets[index as usize]);
        facets.iter().map(facet).collect()
    };
    vec![
        ("faces_vertices", polygons),
        ("faces_foldmotion:facet", json!(facets)),
        ("faces_foldmotion:row", of(|f| json!(f.row))),
        ("faces_foldmotion:column", of(|f| json!(f.column))),
        ("faces_foldmotion:kind", of(|f| json!(f.kind))),
    ]
}
