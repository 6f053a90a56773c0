//! The crease pattern on paper: every line once.

use std::collections::BTreeSet;

use glam::DVec2;

use super::long_lines::{Segment, join};
use super::travel::{outline, sweep, travel};
use super::{CutError, CutLine, CutOptions, LineClass};
use crate::Sheet;

/// The least side of a sheet on paper, mm: nothing smaller can be cut.
const LEAST_SIDE: f64 = 1.0;
/// The longest side, mm.
const LONGEST_SIDE: f64 = 1e7;

/// The lines of a sheet on paper, in the order in which a plotter follows them: mountain creases, valley creases,
/// facet lines if requested, and the outline last.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPattern {
    /// Width and height of the sheet on paper, mm.
    pub size: DVec2,
    /// Every line once; x from 0 to the width and y, downwards, from 0 to the height.
    pub lines: Vec<CutLine>,
    /// The shortest edge of the crease pattern, mm. Origami Simulator takes ends of lines closer than 3 units (here
    /// mm) for one vertex, unless told otherwise.
    pub shortest_edge: f64,
    /// The height of a row of units, mm.
    pub(super) row: f64,
    pub(super) options: CutOptions,
}

impl CutPattern {
    /// Puts a sheet on paper.
    ///
    /// `target_angles`: the fold angle every edge is to take, radians, one for each edge; 0 if it is not a crease. A crease
    /// with the target 0 would be drawn invisible.
    ///
    /// # Errors
    /// [`CutError`]: options out of range, a sheet smaller than 1 mm or larger than 10 km.
    pub fn new(
        sheet: &Sheet,
        target_angles: &[f64],
        options: &CutOptions,
    ) -> Result<Self, CutError> {
        options.check()?;
        let (vertices, size) = on_paper(sheet, options.scale);
        let is_makeable = |side: f64| (LEAST_SIDE..=LONGEST_SIDE).contains(&side);
        if !(is_makeable(size.x) && is_makeable(size.y)) {
            return Err(CutError::Size {
                size: size.to_array(),
                minimum: LEAST_SIDE,
                maximum: LONGEST_SIDE,
            });
        }
        let row = sheet.unit_length * options.scale;
        let mut segments = segments(sheet, target_angles);
        if !options.draws_facets {
            segments.retain(|segment| segment.class != LineClass::Facet);
        }
        once_a_cut(&vertices, &mut segments);
        let length = |s: &Segment| {
            let [from, to] = s.ends.map(|v| vertices[v as usize]);
            from.distance(to)
        };
        let shortest_edge = segments.iter().map(length).fold(f64::INFINITY, f64::min);
        if !options.keeps_segments {
            segments = join(&vertices, &segments);
        }
        Ok(Self {
            size,
            lines: in_order(&vertices, &segments, row),
            shortest_edge,
            row,
            options: options.clone(),
        })
    }

    /// The number of lines of a class.
    pub fn count(&self, class: LineClass) -> usize {
        self.of(class).count()
    }

    /// The length of all lines of a class, mm.
    pub fn length(&self, class: LineClass) -> f64 {
        self.of(class).map(CutLine::length).sum()
    }

    /// The distance that the pen moves between lines, mm, starting at the upper left corner.
    pub fn travel(&self) -> f64 {
        travel(&self.lines)
    }

    fn of(&self, class: LineClass) -> impl Iterator<Item = &CutLine> {
        self.lines.iter().filter(move |line| line.class == class)
    }
}

/// The vertices on paper, mm, and the size of the sheet: a half turn of the pattern, so that rows run to the right
/// and columns downwards without a mirror image.
fn on_paper(sheet: &Sheet, scale: f64) -> (Vec<DVec2>, DVec2) {
    let far = DVec2::splat(f64::INFINITY);
    let (low, high) =
        sheet.vertices.iter().fold((far, -far), |(low, high), &v| (low.min(v), high.max(v)));
    let position = |v: &DVec2| DVec2::new(high.x - v.x, v.y - low.y) * scale;
    let vertices = sheet.vertices.iter().map(position).collect();
    (vertices, (high - low) * scale)
}

fn segments(sheet: &Sheet, target_angles: &[f64]) -> Vec<Segment> {
    let edges = sheet.edges.iter().zip(target_angles);
    edges
        .map(|(edge, &angle)| Segment {
            ends: edge.vertices,
            class: LineClass::of(edge.assignment),
            fold_angle: if edge.is_crease() { angle } else { 0.0 },
        })
        .collect()
}

/// Leaves out the second side of every cut inside the sheet, which lies on the first.
fn once_a_cut(vertices: &[DVec2], segments: &mut Vec<Segment>) {
    let mut drawn: BTreeSet<[[u64; 2]; 2]> = BTreeSet::new();
    segments.retain(|segment| {
        let mut ends = segment.ends.map(|v| vertices[v as usize].to_array().map(f64::to_bits));
        ends.sort_unstable();
        segment.class != LineClass::Cut || drawn.insert(ends)
    });
}

fn in_order(vertices: &[DVec2], segments: &[Segment], row: f64) -> Vec<CutLine> {
    let line = |segment: &Segment| CutLine {
        class: segment.class,
        ends: segment.ends.map(|v| vertices[v as usize]),
        fold_angle: segment.fold_angle,
    };
    let mut lines = Vec::with_capacity(segments.len());
    for class in LineClass::ALL {
        let of_class = segments.iter().filter(|s| s.class == class);
        if class == LineClass::Cut {
            let border: Vec<Segment> = of_class.copied().collect();
            lines.extend(outline(&border).iter().map(line));
        } else {
            let mut group: Vec<CutLine> = of_class.map(line).collect();
            sweep(&mut group, row);
            lines.append(&mut group);
        }
    }
    lines
}
