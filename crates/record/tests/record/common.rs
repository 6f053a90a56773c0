//! Small sheets built by hand.

use foldmotion_pattern::{
    Assignment, CreaseKind, Edge, Facet, FacetKind, Frame, LayerOrder, Motion, Sheet,
};
use foldmotion_record::{Camera, Image, Style, View, line_width, picture};
use glam::{DVec2, DVec3};

/// The picture's size in most tests.
pub(crate) const SIZE: [u32; 2] = [96, 72];

/// A sheet of `faces`, each its own facet; an edge between two of them has the assignment of `creases`, else F.
pub(crate) fn sheet(
    vertices: &[DVec2],
    faces: &[[u32; 3]],
    creases: &[([u32; 2], Assignment)],
) -> Sheet {
    let mut edges: Vec<Edge> = Vec::new();
    for (face, corners) in (0..).zip(faces) {
        for i in 0..3 {
            let [a, b] = [corners[i], corners[(i + 1) % 3]];
            if let Some(edge) = edges.iter_mut().find(|e| e.vertices == [b, a]) {
                edge.faces[1] = Some(face);
                let named = creases.iter().find(|c| c.0 == [a, b] || c.0 == [b, a]);
                edge.assignment = named.map_or(Assignment::Facet, |c| c.1);
                continue;
            }
            edges.push(Edge {
                vertices: [a, b],
                assignment: Assignment::Border,
                kind: CreaseKind::Border,
                row: 0,
                column: 0,
                faces: [Some(face), None],
            });
        }
    }
    let facet = |polygon: &[u32; 3]| Facet {
        polygon: polygon.to_vec(),
        row: 0,
        column: 0,
        kind: FacetKind::Plain,
    };
    Sheet {
        vertices: vertices.to_vec(),
        edges,
        faces: faces.to_vec(),
        face_facets: (0..faces.len() as u32).collect(),
        facets: faces.iter().map(facet).collect(),
        unit_length: 1.0,
    }
}

/// The unit square of two triangles that meet on the diagonal from (0, 0) to (1, 1).
pub(crate) fn square(diagonal: Assignment) -> Sheet {
    let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    sheet(&corners, &[[0, 1, 2], [0, 2, 3]], &[([0, 2], diagonal)])
}

/// Two squares of two triangles each: faces 0 and 1 with vertices 0 to 3, faces 2 and 3 with vertices 4 to 7.
pub(crate) fn two_squares() -> Sheet {
    let corner = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let vertices: Vec<_> = corner.into_iter().chain(corner).collect();
    let faces = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    sheet(&vertices, &faces, &[])
}

/// No lines, so that only paper shows.
pub(crate) fn plain() -> Style {
    Style { line_width: 0.0, ..Style::default() }
}

/// The camera from above that shows the square from −0.5 to 1.5 at `pixels` a unit.
pub(crate) fn camera() -> Camera {
    let corners = [DVec3::new(-0.5, -0.5, 0.0), DVec3::new(1.5, 1.5, 0.0)];
    Camera::fit(View::Top, corners, SIZE, 0.0).unwrap()
}

/// The picture of `positions` from above.
pub(crate) fn from_above(
    sheet: &Sheet,
    positions: &[DVec3],
    order: &LayerOrder,
    style: &Style,
) -> Image {
    picture(sheet, positions, order, &camera(), style, SIZE).unwrap()
}

/// The colour in the middle of the picture, where (0.5, 0.5) is seen.
pub(crate) fn middle(image: &Image) -> [u8; 3] {
    image.pixel(SIZE[0] / 2, SIZE[1] / 2)
}

/// `positions` turned upside down about the line y = 0.5, z = 0.
pub(crate) fn turned_over(positions: &[DVec3]) -> Vec<DVec3> {
    let turn = |p: &DVec3| DVec3::new(p.x, 1.0 - p.y, -p.z);
    positions.iter().map(turn).collect()
}

/// Linear light of an sRGB byte.
pub(crate) fn linear(byte: u8) -> f64 {
    let value = f64::from(byte) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// The square folded about its diagonal from flat at t = 0 by 90° at t = `last`.
pub(crate) fn folding_square(times: &[f64]) -> Motion {
    let sheet = square(Assignment::Valley);
    let last = times.last().copied().unwrap_or(1.0);
    let frame = |&time: &f64| {
        let mut positions = sheet.planar();
        let angle = std::f64::consts::FRAC_PI_2 * time / last.max(1e-300);
        let foot = DVec3::new(0.5, 0.5, 0.0);
        let arm = DVec3::new(-0.5, 0.5, 0.0);
        positions[3] = foot + arm * angle.cos() + DVec3::Z * (arm.length() * angle.sin());
        Frame { time, positions }
    };
    Motion {
        frames: times.iter().map(frame).collect(),
        compact_order: LayerOrder::default(),
        sheet,
    }
}

/// `style` with lines as narrow as a film draws them.
pub(crate) fn shown_style(
    sheet: &Sheet,
    positions: &[DVec3],
    camera: &Camera,
    style: &Style,
) -> Style {
    Style { line_width: line_width(sheet, positions, camera, style.line_width), ..style.clone() }
}
