//! A crease pattern as a mesh: mountains solid, valleys dashed, and the border. The mesh is cached until something
//! changes.

use std::sync::Arc;

use eframe::egui::epaint::{ClippedShape, Mesh, Primitive};
use eframe::egui::{Color32, Pos2, Rect, Shape, Stroke, Ui, Vec2};
use foldmotion_pattern::{Assignment, Sheet};
use glam::DVec2;

use super::plane::{Plane, crease_colours};

/// The largest number of edges that are drawn.
pub(super) const MAX_EDGES: usize = 60_000;
/// A valley crease shorter than this, in points on the screen, is drawn without gaps.
const SHORTEST_DASHED: f32 = 9.0;

/// What a mesh depends on; it is made again when this changes.
#[derive(Debug, Clone, Copy, PartialEq)]
struct MeshKey {
    draft_number: u64,
    /// The plane, moved so that its frame starts at the origin of the screen.
    plane: Plane,
    pixels_per_point: f32,
    colours: [Color32; 2],
    corner: Pos2,
}

/// The last mesh and its key.
#[derive(Debug, Default)]
pub(super) struct Creases {
    made: Option<(MeshKey, Arc<Mesh>)>,
}

impl Creases {
    /// The creases as a shape on the screen. `place` maps a vertex of the pattern to a point of the plane.
    pub(super) fn shape(
        &mut self,
        ui: &Ui,
        draft_number: u64,
        sheet: &Sheet,
        plane: &Plane,
        place: impl Fn(DVec2) -> DVec2,
    ) -> Shape {
        let corner = plane.rect.min;
        let key = MeshKey {
            draft_number,
            plane: Plane { rect: plane.rect.translate(-corner.to_vec2()), ..*plane },
            pixels_per_point: ui.pixels_per_point(),
            colours: crease_colours(ui),
            corner,
        };
        if let Some((made, mesh)) = &mut self.made {
            let shift = corner - made.corner;
            let moved = MeshKey { corner, ..*made };
            if moved == key {
                if shift != Vec2::ZERO {
                    Arc::make_mut(mesh).translate(shift);
                    made.corner = corner;
                }
                return Shape::mesh(Arc::clone(mesh));
            }
        }
        let mesh = Arc::new(mesh(ui, sheet, plane, place));
        self.made = Some((key, Arc::clone(&mesh)));
        Shape::mesh(mesh)
    }
}

fn mesh(ui: &Ui, sheet: &Sheet, plane: &Plane, place: impl Fn(DVec2) -> DVec2) -> Mesh {
    let [mountain, valley] = crease_colours(ui);
    let border = Stroke::new(1.4, ui.visuals().text_color());
    let free = Stroke::new(1.0, ui.visuals().weak_text_color());
    let on_screen: Vec<Pos2> = sheet.vertices.iter().map(|&v| plane.to_screen(place(v))).collect();
    let mut shapes = Vec::with_capacity(sheet.edges.len());
    for edge in sheet.edges.iter().take(MAX_EDGES) {
        let ends = edge.vertices.map(|v| on_screen[v as usize]);
        if !Rect::from_two_pos(ends[0], ends[1]).intersects(plane.rect) {
            continue;
        }
        match edge.assignment {
            Assignment::Facet => {}
            Assignment::Mountain => {
                shapes.push(Shape::line_segment(ends, Stroke::new(1.1, mountain)));
            }
            Assignment::Border => shapes.push(Shape::line_segment(ends, border)),
            Assignment::Free => shapes.push(Shape::line_segment(ends, free)),
            Assignment::Valley => {
                let stroke = Stroke::new(1.1, valley);
                let is_short = ends[0].distance(ends[1]) < SHORTEST_DASHED;
                if is_short {
                    shapes.push(Shape::line_segment(ends, stroke));
                } else {
                    let dashes = Shape::dashed_line(&ends, stroke, 4.0, 2.5);
                    shapes.extend(dashes);
                }
            }
        }
    }
    let clipped = ClippedShape::new(plane.rect, Shape::Vec(shapes));
    let mut whole = Mesh::default();
    for primitive in ui.tessellate(vec![clipped], ui.pixels_per_point()) {
        if let Primitive::Mesh(mesh) = primitive.primitive {
            whole.append(mesh);
        }
    }
    whole
}
