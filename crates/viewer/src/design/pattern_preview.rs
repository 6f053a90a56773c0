//! The section that shows the crease pattern.

use eframe::egui::{self, FontId, RichText, Shape, Stroke, Ui};
use foldmotion_pattern::{Sheet, UnitSheet};
use foldmotion_study::Draft;
use glam::DVec2;

use super::creases::{Creases, MAX_EDGES};
use super::form::{Form, NOTE_SIZE};
use super::plane::{Plane, PlaneView, bounds, canvas, message};

/// How the pattern is rotated so that its long side is horizontal and its front faces the viewer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Orientation {
    /// Not rotated, for imported patterns.
    #[default]
    None,
    /// Rotated by half a turn: rows run to the right.
    Half,
    /// Rotated by a quarter turn: rows run downwards.
    Quarter,
}

impl Orientation {
    fn of(draft: &Draft) -> Self {
        let Draft::Units(draft) = draft else {
            return Self::None;
        };
        let units = &draft.units;
        let is_long = draft.division.length() >= units.unit.width * units.columns as f64;
        if is_long { Self::Half } else { Self::Quarter }
    }

    fn apply(self, p: DVec2) -> DVec2 {
        match self {
            Self::None => p,
            Self::Half => -p,
            Self::Quarter => DVec2::new(-p.y, p.x),
        }
    }

    fn undo(self, p: DVec2) -> DVec2 {
        match self {
            Self::None => p,
            Self::Half => -p,
            Self::Quarter => DVec2::new(p.y, -p.x),
        }
    }
}

/// State of the section that lasts from frame to frame.
#[derive(Debug, Default)]
pub(super) struct PatternPreview {
    view: PlaneView,
    creases: Creases,
    /// The number of the draft that the bounds belong to.
    of: Option<u64>,
    bounds: [DVec2; 2],
    orientation: Orientation,
}

impl PatternPreview {
    pub(super) fn show(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        form.section(ui, "Crease pattern", true, &[], |form, ui| {
            let Some(draft) = form.draft else {
                ui.label(RichText::new("no pattern yet").weak());
                return;
            };
            self.update(form.draft_number, draft);
            self.paint(form, ui, draft);
            form.scope(ui, "pattern buttons", |_, ui| {
                ui.horizontal(|ui| {
                    let [mountain, valley] = super::plane::crease_colours(ui);
                    ui.label(RichText::new("— mountain").size(NOTE_SIZE).color(mountain));
                    ui.label(RichText::new("- - valley").size(NOTE_SIZE).color(valley));
                    let fit =
                        ui.small_button("fit pattern").on_hover_text("Show the whole pattern");
                    if fit.clicked() {
                        self.view.fit();
                    }
                });
            });
        });
    }

    fn update(&mut self, draft_number: u64, draft: &Draft) {
        if self.of == Some(draft_number) {
            return;
        }
        self.of = Some(draft_number);
        self.orientation = Orientation::of(draft);
        let turned = draft.sheet().vertices.iter().map(|&v| self.orientation.apply(v));
        self.bounds = bounds(turned);
    }

    fn paint(&mut self, form: &Form<'_>, ui: &mut Ui, draft: &Draft) {
        let size = self.bounds[1] - self.bounds[0];
        let aspect = (size.y / size.x.max(1e-99)) as f32;
        let height = (ui.available_width() * aspect + 44.0).clamp(90.0, 260.0);
        let (response, painter) = canvas(ui, height, "crease pattern");
        let plane = self.view.plane(ui, &response, self.bounds);
        let sheet = draft.sheet();
        let orientation = self.orientation;
        let place = |v| orientation.apply(v);
        painter.add(self.creases.shape(ui, form.draft_number, sheet, &plane, place));
        if sheet.edges.len() > MAX_EDGES {
            let text = "only the first creases are shown";
            message(ui, &painter, &plane, text);
        }
        if let Some(at) = response.hover_pos() {
            let found = found(draft, orientation.undo(plane.to_plane(at)));
            if let Some((corners, text)) = found {
                let corners: Vec<_> =
                    corners.iter().map(|&c| plane.to_screen(orientation.apply(c))).collect();
                mark(ui, &painter, &plane, corners, &text);
            }
        }
    }
}

fn mark(ui: &Ui, painter: &egui::Painter, plane: &Plane, corners: Vec<egui::Pos2>, text: &str) {
    let stroke = Stroke::new(2.0, ui.visuals().strong_text_color());
    painter.add(Shape::closed_line(corners, stroke));
    let at = plane.rect.left_bottom() + egui::vec2(5.0, -4.0);
    let font = FontId::proportional(11.0);
    let galley = painter.layout_no_wrap(text.to_owned(), font, ui.visuals().strong_text_color());
    let at = egui::pos2(at.x, at.y - galley.size().y);
    let ground = galley.rect.translate(at.to_vec2()).expand(2.0);
    painter.rect_filled(ground, 2.0, ui.visuals().extreme_bg_color);
    painter.galley(at, galley, ui.visuals().strong_text_color());
}

/// The corners and the name of the unit or facet at a point of the pattern.
fn found(draft: &Draft, at: DVec2) -> Option<(Vec<DVec2>, String)> {
    match draft {
        Draft::Units(draft) => unit_at(&draft.units, at),
        Draft::Imported(study) => facet_at(&study.imported.sheet, at),
    }
}

fn unit_at(units: &UnitSheet, at: DVec2) -> Option<(Vec<DVec2>, String)> {
    let width = units.unit.width;
    let column = (at.y / width).floor();
    if !(0.0..units.columns as f64).contains(&column) || at.x > 0.0 {
        return None;
    }
    let mut top = 0.0;
    for (row, unit) in units.row_units().iter().enumerate() {
        let bottom = top - unit.height;
        if at.x >= bottom {
            let (left, right) = (column * width, (column + 1.0) * width);
            let corners = vec![
                DVec2::new(top, left),
                DVec2::new(top, right),
                DVec2::new(bottom, right),
                DVec2::new(bottom, left),
            ];
            let kind = UnitSheet::unit_name(row as u32);
            let text = format!("row {row}, column {column}: {kind}, case {}", unit.case.name());
            return Some((corners, text));
        }
        top = bottom;
    }
    None
}

fn facet_at(sheet: &Sheet, at: DVec2) -> Option<(Vec<DVec2>, String)> {
    let is_inside = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| sheet.vertices[v as usize]);
        [(a, b), (b, c), (c, a)].into_iter().all(|(p, q)| (q - p).perp_dot(at - p) >= 0.0)
    };
    let face = sheet.faces.iter().position(is_inside)?;
    let facet = sheet.face_facets[face];
    let polygon = &sheet.facets[facet as usize].polygon;
    let corners = polygon.iter().map(|&v| sheet.vertices[v as usize]).collect();
    Some((corners, format!("facet {facet}")))
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit};

    use super::*;

    #[test]
    fn every_unit_is_found_at_its_centre_and_none_outside() {
        let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
        let units = UnitSheet::new(unit, 3, 2).unwrap();
        for (row, column) in [(0, 0), (1, 1), (2, 0)] {
            let at = DVec2::new(-(f64::from(row) + 0.5), (f64::from(column) + 0.5) * 1.6);
            let (corners, text) = unit_at(&units, at).unwrap();
            assert!(text.starts_with(&format!("row {row}, column {column}")), "{text}");
            let centre = corners.iter().sum::<DVec2>() / 4.0;
            assert!(centre.distance(at) < 1e-12);
        }
        for outside in [DVec2::new(0.1, 0.5), DVec2::new(-3.1, 0.5), DVec2::new(-1.0, 3.3)] {
            assert!(unit_at(&units, outside).is_none());
        }
    }

    #[test]
    fn turns_are_undone_and_keep_the_front_in_front() {
        for orientation in [Orientation::None, Orientation::Half, Orientation::Quarter] {
            let (a, b) = (DVec2::new(1.0, 2.0), DVec2::new(-3.0, 0.5));
            assert_eq!(orientation.undo(orientation.apply(a)), a);
            let turned = orientation.apply(a).perp_dot(orientation.apply(b));
            assert!((turned - a.perp_dot(b)).abs() < 1e-12, "{orientation:?}");
        }
    }
}
