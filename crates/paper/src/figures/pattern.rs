//! Crease patterns as lines: mountains red, valleys blue.

use foldmotion_pattern::{Assignment, Sheet, Unit, UnitSheet};
use foldmotion_record::{Anchor, Drawing, Stroke, Style};
use glam::DVec2;

use crate::PaperError;

/// The font size of captions.
pub(super) const WORDS: f64 = 13.0;
/// The font size of small labels.
pub(super) const SMALL: f64 = 10.0;

/// Writes a caption with its middle at `at`.
pub(super) fn caption(drawing: &mut Drawing, at: DVec2, words: impl Into<String>) {
    drawing.words(at, words, WORDS, Anchor::Middle);
}

/// The position and scale of a crease pattern on the page, seen from its front.
#[derive(Debug, Clone, Copy)]
pub(super) struct PatternPlacement {
    /// The left upper corner.
    pub(super) at: DVec2,
    /// The size of a unit of length on the page.
    pub(super) scale: f64,
    /// W, the width of the pattern.
    pub(super) width: f64,
    /// The distance by which the pattern is moved up, in its own unit of length.
    pub(super) skip: f64,
}

impl PatternPlacement {
    pub(super) fn new(at: DVec2, scale: f64, width: f64) -> Self {
        Self { at, scale, width, skip: 0.0 }
    }

    /// The position of a vertex on the page: rows run down, and the width runs to the left.
    pub(super) fn of(&self, vertex: DVec2) -> DVec2 {
        self.at + self.scale * DVec2::new(self.width - vertex.y, -vertex.x - self.skip)
    }
}

/// The stroke of an edge; `None` for an edge inside a facet.
pub(super) fn stroke(assignment: Assignment, width: f64) -> Option<Stroke> {
    let style = Style::default();
    let color = match assignment {
        Assignment::Mountain => style.mountain,
        Assignment::Valley => style.valley,
        Assignment::Border => style.border,
        Assignment::Facet | Assignment::Free => return None,
    };
    Some(Stroke::new(color, width))
}

/// Draws the facets of `sheet` that `shows` selects, with their creases, and their outline as a border.
pub(super) fn draw(
    drawing: &mut Drawing,
    sheet: &Sheet,
    placement: &PatternPlacement,
    line_width: f64,
    shows: impl Fn(u32) -> bool,
) {
    let front = Style::default().front;
    let corner = |v: &u32| placement.of(sheet.vertices[*v as usize]);
    for (index, facet) in (0..).zip(&sheet.facets) {
        if shows(index) {
            drawing.area(facet.polygon.iter().map(corner), front);
        }
    }
    for edge in &sheet.edges {
        let faces = edge.faces.into_iter().flatten();
        let shown = faces.filter(|&face| shows(sheet.face_facets[face as usize]));
        let look = match shown.count() {
            0 => None,
            1 => stroke(Assignment::Border, line_width),
            _ => stroke(edge.assignment, line_width),
        };
        if let Some(stroke) = look {
            drawing.line(edge.vertices.iter().map(corner), stroke);
        }
    }
}

/// One unit of the odd rows (`row` 0, U^O) or of the even ones (1, U^E), with the paper's names of its vertices and the
/// parts of its width below.
pub(super) fn draw_unit(
    drawing: &mut Drawing,
    unit: &Unit,
    row: u32,
    at: DVec2,
    scale: f64,
) -> Result<(), PaperError> {
    let units = one_column(unit)?;
    let placement = PatternPlacement {
        skip: f64::from(row) * unit.height,
        ..PatternPlacement::new(at, scale, unit.width)
    };
    let sheet = &units.sheet;
    draw(drawing, sheet, &placement, 1.4, |f| sheet.facets[f as usize].row == row);
    let size = scale * DVec2::new(unit.width, unit.height);
    for (vertex, &position) in (0..).zip(&sheet.vertices) {
        // The first corner of the paper's names stands on the left.
        let mirrored = DVec2::new(position.x, unit.width - position.y);
        if let Some(name) = units.vertex_name(vertex, row, 0) {
            let corner = placement.of(mirrored);
            label(drawing, corner, corner - at - 0.5 * size, 0.5 * size.y, &name);
        }
    }
    parts_below(drawing, unit, at + DVec2::new(0.0, size.y + 22.0), scale);
    let left = at + DVec2::new(-34.0, 0.5 * size.y + 4.0);
    drawing.words(left, "h", WORDS, Anchor::End);
    Ok(())
}

/// A sheet of two rows and one column.
pub(super) fn one_column(unit: &Unit) -> Result<UnitSheet, PaperError> {
    UnitSheet::new(*unit, 2, 1).map_err(|e| PaperError::pattern("a unit of a figure", e))
}

/// Writes a vertex's name outside the unit or, inside it, beside the vertex where no crease ends.
///
/// `away` is the position relative to the unit's centre, `half` half the unit's height.
fn label(drawing: &mut Drawing, at: DVec2, away: DVec2, half: f64, name: &str) {
    let sign = |value: f64| {
        if value.abs() < 1.0 { 0.0 } else { value.signum() }
    };
    let is_outside = away.y.abs() > half - 1.0;
    let (dx, dy) = match (sign(away.x), is_outside) {
        (0.0, true) => (4.0, 4.0 + 9.0 * sign(away.y)),
        (x, true) => (3.0 * x, 4.0 + 9.0 * sign(away.y)),
        (0.0, false) if sign(away.y) == 0.0 => (9.0, 3.5),
        (0.0, false) => (4.0, 3.5 - 4.5 * sign(away.y)),
        (x, false) => (3.0 * x, -4.0),
    };
    let anchor = if dx < 0.0 { Anchor::End } else { Anchor::Start };
    drawing.words(at + DVec2::new(dx, dy), with_subscript(name), SMALL, anchor);
}

/// `C4^1` with its number as a subscript: `C_4^1`.
fn with_subscript(name: &str) -> String {
    let Some((letter, number)) = name.split_at_checked(1) else {
        return name.to_owned();
    };
    let (number, half) = number.split_once('^').unwrap_or((number, ""));
    let half = if half.is_empty() { String::new() } else { format!("^{half}") };
    format!("{letter}_{number}{half}")
}

/// Draws the parts of the width below a unit, each between ticks with its name.
fn parts_below(drawing: &mut Drawing, unit: &Unit, at: DVec2, scale: f64) {
    let is_sii = unit.case == foldmotion_pattern::Case::SII;
    let has_pads = unit.side_pad > 0.0;
    let [side, flap] = match (is_sii, unit.centre_pad > 0.0) {
        (true, true) => ["w_1''", "w_2'"],
        (true, false) => ["w_1'", "w_2'"],
        _ => ["w_1", "w_2"],
    };
    let parts: Vec<(f64, &str)> = if has_pads {
        vec![
            (unit.side_pad, side),
            (unit.flap, flap),
            (unit.centre_pad, "2d"),
            (unit.flap, flap),
            (unit.side_pad, side),
        ]
    } else {
        vec![(unit.width, "w")]
    };
    let ink = Stroke::new([110, 110, 115], 0.8);
    let tick = |drawing: &mut Drawing, x: f64| {
        let ends = [DVec2::new(x, at.y - 4.0), DVec2::new(x, at.y + 4.0)];
        drawing.line(ends, ink);
    };
    let mut x = at.x;
    tick(drawing, x);
    for (width, name) in parts.into_iter().filter(|part| part.0 > 0.0) {
        let end = x + width * scale;
        drawing.line([DVec2::new(x, at.y), DVec2::new(end, at.y)], ink);
        tick(drawing, end);
        let below = DVec2::new(0.5 * (x + end), at.y + 15.0);
        drawing.words(below, name, SMALL, Anchor::Middle);
        x = end;
    }
}
