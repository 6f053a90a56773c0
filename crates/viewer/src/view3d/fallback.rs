//! The sheet drawn by egui's painter, without a GPU: triangles sorted from the farthest to the nearest, together with
//! their lines. The order is decided per triangle, so triangles that intersect are drawn wrongly.

use std::sync::Arc;

use eframe::egui::epaint::Vertex;
use eframe::egui::{Color32, Mesh, Painter, Pos2, Rect, Rgba, Shape, Vec2, pos2, vec2};
use foldmotion_record::Style;
use glam::{DVec3, Vec3};

use super::CreaseClasses;
use super::creases::ink;
use super::paints::{MARK, PaintKey, TINT, VALUE, paints, unpacked};
use super::picture::Picture;
use super::prepared::PreparedSheet;
use super::projection::Projection;
use super::segments::segments;

/// The light of films and of the shader.
const LIGHT: DVec3 = DVec3::new(-0.52, 0.66, 0.54);
const AMBIENT: f64 = 0.42;
const TINTED_BACK: f32 = 0.62;

/// What the mesh depends on; it is made again when this changes.
#[derive(Debug, PartialEq)]
struct MeshKey {
    sheet_key: u64,
    state_key: u64,
    creases: CreaseClasses,
    paints: PaintKey,
    style: Style,
    pulse: f32,
    projection: Projection,
    corner: Pos2,
}

/// Draws the sheet without a GPU; keeps the mesh until something changes.
#[derive(Debug, Default)]
pub(super) struct FallbackRenderer {
    source: Option<MeshKey>,
    mesh: Arc<Mesh>,
}

impl FallbackRenderer {
    pub(super) fn paint(
        &mut self,
        painter: &Painter,
        rect: Rect,
        picture: &Picture<'_>,
        projection: &Projection,
        prepared: Option<&PreparedSheet>,
    ) {
        let source = Some(MeshKey {
            sheet_key: picture.sheet_key,
            state_key: picture.state_key,
            creases: picture.creases,
            paints: PaintKey::of(picture),
            style: picture.style.clone(),
            pulse: picture.pulse,
            projection: *projection,
            corner: rect.min,
        });
        if self.source != source {
            self.source = source;
            self.mesh = Arc::new(mesh(picture, projection, rect.min, prepared));
        }
        painter.add(Shape::Mesh(Arc::clone(&self.mesh)));
        for segment in segments(picture) {
            let [a, b] = segment.ends.map(|end| at(rect.min, projection.project(end)));
            if a == b {
                painter.circle_filled(a, 0.5 * segment.width, segment.colour);
            } else {
                painter.line_segment([a, b], (segment.width, segment.colour));
            }
        }
    }
}

fn at(corner: Pos2, point: DVec3) -> Pos2 {
    corner + vec2(point.x as f32, point.y as f32)
}

/// The triangles with their lines, from the farthest to the nearest.
fn mesh(
    picture: &Picture<'_>,
    projection: &Projection,
    corner: Pos2,
    prepared: Option<&PreparedSheet>,
) -> Mesh {
    let sheet = picture.sheet;
    let points: Vec<DVec3> = picture.positions.iter().map(|&p| projection.project(p)).collect();
    let mut lines = vec![Vec::new(); sheet.faces.len()];
    for edge in sheet.edges.iter().filter(|edge| picture.creases.shows(edge)) {
        for face in edge.faces.into_iter().flatten() {
            lines[face as usize].push(edge);
        }
    }
    let paints = paints(picture);
    let mut faces: Vec<(f64, usize, Vec3)> = (0..sheet.faces.len())
        .map(|index| {
            let corners = sheet.faces[index].map(|v| points[v as usize]);
            let n = normal(picture, projection, index);
            let side = if is_front(corners) { 1.0 } else { -1.0 };
            let depth_offset = prepared
                .map_or(0.0, |prepared| prepared.depth_offset(index, side, sheet.unit_length));
            let depth = corners.iter().map(|p| p.z).sum::<f64>() / 3.0;
            let light = painted(picture, paints[index], side, side * n);
            (depth - depth_offset, index, light)
        })
        .collect();
    faces.sort_by(|(a, i, _), (b, j, _)| a.total_cmp(b).then(j.cmp(i)));
    let mut mesh = Mesh::default();
    let width = picture.style.line_width as f32;
    for (_, index, light) in faces {
        let colour = Color32::from(Rgba::from_rgb(light.x, light.y, light.z));
        polygon(&mut mesh, &sheet.faces[index].map(|v| at(corner, points[v as usize])), colour);
        for edge in &lines[index] {
            let ends = edge.vertices.map(|v| at(corner, points[v as usize]));
            let [r, g, b] = match ink(edge.assignment) {
                1 => picture.style.mountain,
                2 => picture.style.valley,
                _ => picture.style.border,
            };
            line(&mut mesh, ends, width, Color32::from_rgb(r, g, b));
        }
    }
    mesh
}

fn polygon(mesh: &mut Mesh, corners: &[Pos2], color: Color32) {
    let first = mesh.vertices.len() as u32;
    let vertex = |&pos: &Pos2| Vertex { pos, uv: pos2(0.0, 0.0), color };
    mesh.vertices.extend(corners.iter().map(vertex));
    for k in 2..corners.len() as u32 {
        mesh.add_triangle(first, first + k - 1, first + k);
    }
}

fn line(mesh: &mut Mesh, [a, b]: [Pos2; 2], width: f32, colour: Color32) {
    let along: Vec2 = (b - a).normalized();
    let aside = 0.5 * width * along.rot90();
    polygon(mesh, &[a - aside, b - aside, b + aside, a + aside], colour);
}

/// Whether the front of a triangle is visible: its corners are counter-clockwise, with y pointing down.
fn is_front([a, b, c]: [DVec3; 3]) -> bool {
    (b - a).truncate().perp_dot((c - a).truncate()) <= 0.0
}

/// The unit normal of a triangle, in the axes of the view.
fn normal(picture: &Picture<'_>, projection: &Projection, face: usize) -> DVec3 {
    let [a, b, c] = picture.sheet.faces[face].map(|v| picture.positions[v as usize]);
    let n = (b - a).cross(c - a).normalize_or_zero();
    DVec3::from_array(projection.axes().map(|axis| axis.dot(n)))
}

/// The colour of a triangle in linear light, as in the shader. `n` is the unit normal of the visible side.
fn painted(picture: &Picture<'_>, paint: u32, side: f64, n: DVec3) -> Vec3 {
    let light = |[r, g, b]: [u8; 3]| {
        let [r, g, b, _] = Rgba::from(Color32::from_rgb(r, g, b)).to_array();
        Vec3::new(r, g, b)
    };
    let (kind, colour) = unpacked(paint);
    let paper = light(if side > 0.0 { picture.style.front } else { picture.style.back });
    let base = match kind {
        VALUE => return light(colour),
        TINT => light(colour) * if side > 0.0 { 1.0 } else { TINTED_BACK },
        MARK => paper.lerp(light(picture.style.mark), picture.pulse.clamp(0.0, 1.0)),
        _ => paper,
    };
    let wrapped = 0.5 + 0.5 * n.dot(LIGHT.normalize());
    base * (AMBIENT + (1.0 - AMBIENT) * wrapped * wrapped) as f32
}
