//! A state as areas and lines of the page.

use std::collections::BTreeMap;

use foldmotion_pattern::{Assignment, Edge};
use glam::{DVec2, DVec3};

use super::layout::{Cell, Layout};
use super::measure::measures;
use super::spot::ring;
use super::{FigureState, StripOptions, bounds};
use crate::line_width::line_width;
use crate::shade::{Inks, encoded, linear};
use crate::visible::{doubled_area, perimeter};
use crate::{
    Camera, Drawing, Paper, RecordError, Stroke, Style, Surface, Visible, VisibleLine, colour_of,
};

/// Areas are painted this much wider, half of it on each side, so that no seam opens between neighbours; lines cover
/// it.
const BLEED: f64 = 0.3;

/// Parts narrower than this would be all bleed, in units of the page.
const NARROWEST: f64 = 0.02;

/// A crease is drawn where the triangle beside it is at least this many line widths high.
const ROOM: f64 = 1.5;

/// The colour of the curve to compare with: bluish green (Okabe and Ito 2008).
const TARGET: [u8; 3] = [0, 158, 115];

/// Lines of one look.
type StyledLines = (Stroke, Vec<[DVec2; 2]>);

/// Draws states of a sheet.
pub(super) struct Painter<'a> {
    pub(super) paper: &'a Paper<'a>,
    pub(super) options: &'a StripOptions,
    pub(super) layout: &'a Layout,
}

impl Painter<'_> {
    /// Draws `state` into `cell`.
    pub(super) fn paint(
        &self,
        drawing: &mut Drawing,
        state: &FigureState<'_>,
        cell: &Cell,
    ) -> Result<(), RecordError> {
        let (options, scale) = (self.options, self.layout.scale);
        let camera = Camera::centred(options.view, cell.extent, [1, 1], scale)?;
        let shift = cell.middle - DVec2::splat(0.5);
        let project = |point: DVec3| camera.project(point).truncate() + shift;
        let style = Style { line_width: 0.0, ..options.style.clone() };
        let surface = Surface::new(self.paper, &state.positions, &camera, &style);
        let visible = surface.visible();
        let widest = self.layout.line_width;
        if let Some(bounds) = &state.bounds {
            bounds::draw_back(drawing, bounds, &camera, shift, widest);
        }
        let width = line_width(self.paper.sheet, &state.positions, &camera, widest);
        let seen = ShownState { surface: &surface, visible: &visible, shift, width };
        self.areas(drawing, state, &seen);
        self.lines(drawing, state, &seen);
        if let Some(bounds) = &state.bounds {
            bounds::draw_front(drawing, bounds, &camera, shift, widest);
        }
        for measure in measures(state, &camera) {
            measure.draw(drawing, shift, self.layout.letters, self.layout.line_width);
        }
        if let Some(spot) = state.spot {
            ring(drawing, project(spot), options.style.mark, self.layout.letters);
        }
        if state.target.len() > 1 {
            let width = 2.0 * self.layout.line_width;
            let stroke = Stroke::new(TARGET, width).dashed(4.0 * width, 3.0 * width);
            drawing.line(state.target.iter().map(|&p| project(p)), stroke);
        }
        Ok(())
    }

    fn areas(&self, drawing: &mut Drawing, state: &FigureState<'_>, seen: &ShownState<'_>) {
        let (surface, visible, shift) = (seen.surface, seen.visible, seen.shift);
        let inks = self.options.style.inks();
        let color = |face: usize| {
            let normal = surface.face(face as u32).normal;
            if state.marked.get(face) == Some(&true) {
                return encoded(inks.marked(normal));
            }
            let value = state.values.get(face).and_then(|&value| self.color_of(value));
            encoded(match value {
                Some(color) => Inks::valued(linear(color), normal),
                None => inks.paper(normal),
            })
        };
        for level in visible.areas.chunk_by(|a, b| a.level == b.level) {
            // One path a colour keeps files small.
            let mut by_color: BTreeMap<[u8; 3], Vec<Vec<DVec2>>> = BTreeMap::new();
            for area in level {
                let rings = by_color.entry(color(area.face as usize)).or_default();
                let wide = area
                    .rings
                    .iter()
                    .filter(|ring| doubled_area(ring).abs() > NARROWEST * perimeter(ring));
                rings.extend(wide.map(|ring| ring.iter().map(|&p| p + shift).collect()));
            }
            for (color, rings) in by_color {
                if !rings.is_empty() {
                    drawing.shape(rings, color, BLEED);
                }
            }
        }
    }

    fn lines(&self, drawing: &mut Drawing, state: &FigureState<'_>, seen: &ShownState<'_>) {
        let (options, width) = (self.options, seen.width);
        for level in seen.visible.lines.chunk_by(|a, b| a.level == b.level) {
            // The border comes last, where it goes over the ends of creases.
            let mut looks: BTreeMap<(u8, [u8; 3], usize), StyledLines> = BTreeMap::new();
            for line in level.iter().filter(|line| self.has_room(line, seen)) {
                let edge = &self.paper.sheet.edges[line.edge as usize];
                let assignment = edge.assignment;
                let value = state.bars.get(line.edge as usize);
                let value = value.and_then(|&value| self.color_of(value));
                let (rank, step, stroke) = if let Some(color) = value {
                    (4, 0, Stroke::new(color, 3.0 * width))
                } else {
                    let color = options.style.line(assignment);
                    let [start, end] = seen.ends(edge);
                    let step = options.lines.step(assignment, width, start.distance(end));
                    let stroke = options.lines.stroke(assignment, color, width, step);
                    (rank(assignment), step, stroke)
                };
                let look = looks.entry((rank, stroke.color, step));
                let (_, parts) = look.or_insert_with(|| (stroke, Vec::new()));
                parts.push(line.ends.map(|p| p + seen.shift));
            }
            for (stroke, parts) in looks.into_values() {
                drawing.lines(parts, stroke);
            }
        }
    }

    /// Whether `line` has room beside it on the screen: creases of facets seen nearly edge-on would run together to a
    /// blot. What bounds the shape always has.
    fn has_room(&self, line: &VisibleLine, shown: &ShownState<'_>) -> bool {
        let surface = shown.surface;
        let edge = &self.paper.sheet.edges[line.edge as usize];
        let [Some(left), Some(right)] = edge.faces else {
            return true;
        };
        if surface.face(left).faces_viewer() != surface.face(right).faces_viewer() {
            return true;
        }
        let [start, end] = shown.ends(edge);
        let along = (end - start).normalize_or_zero();
        let sides = [left, right].into_iter().zip(line.seen);
        sides.filter(|side| side.1).any(|(face, _)| {
            let apex = self.paper.sheet.apex(face, edge);
            let apex = apex.map_or(start, |v| surface.points()[v as usize].truncate());
            along.perp_dot(apex - start).abs() > ROOM * shown.width
        })
    }

    /// The colour of a value, if values are shown and it is one.
    fn color_of(&self, value: f64) -> Option<[u8; 3]> {
        let [low, high] = self.options.legend.as_ref()?.range;
        let part = (value - low) / (high - low);
        (!part.is_nan()).then(|| colour_of(part))
    }
}

/// A state on the page.
struct ShownState<'a> {
    surface: &'a Surface<'a>,
    visible: &'a Visible,
    /// From the screen to the page.
    shift: DVec2,
    /// The width of its lines.
    width: f64,
}

impl ShownState<'_> {
    /// The ends of `edge` on the screen.
    fn ends(&self, edge: &Edge) -> [DVec2; 2] {
        let points = self.surface.points();
        edge.vertices.map(|v| points[v as usize].truncate())
    }
}

/// The rank of a line in the order of painting within a level.
fn rank(assignment: Assignment) -> u8 {
    match assignment {
        Assignment::Facet | Assignment::Free => 0,
        Assignment::Valley => 1,
        Assignment::Mountain => 2,
        Assignment::Border => 3,
    }
}
