//! Pixels of the visible surface.
//!
//! The picture is divided as Warnock did (1969, A hidden surface algorithm for computer generated halftone pictures):
//! a square in which nothing shows, or one triangle without lines alone, is filled at once; any other is divided into
//! four, which inherit the triangles that may show in it, down to single pixels. These are the mean of 16 samples.

use foldmotion_pattern::{LayerOrder, Sheet};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::image::check_size;
use crate::pixel::{Canvas, Pixel};
use crate::shade::{Paint, encoded};
use crate::square::Square;
use crate::surface::Candidate;
use crate::{Camera, Image, Paper, RecordError, Style, Surface};

/// The side of the squares that the division starts from, a power of 2.
const LARGEST: usize = 64;

/// One state of a sheet.
///
/// `positions`: one for each vertex. `order`: of the triangles that coincide. The picture does not depend on the number of
/// threads, nor on the sequence of the triangles (but for exact ties of unordered triangles).
///
/// # Errors
/// [`RecordError::Size`], [`RecordError::LineWidth`], [`RecordError::VertexCount`], [`RecordError::NotFinite`].
pub fn picture(
    sheet: &Sheet,
    positions: &[DVec3],
    order: &LayerOrder,
    camera: &Camera,
    style: &Style,
    size: [u32; 2],
) -> Result<Image, RecordError> {
    check_size(size)?;
    style.check()?;
    check_positions(sheet, 0, positions)?;
    let paper = Paper::new(sheet, order);
    Ok(raster(&paper, positions, camera, style, &[], size))
}

/// Refuses positions that are too few, too many or not finite.
pub(crate) fn check_positions(
    sheet: &Sheet,
    frame: usize,
    positions: &[DVec3],
) -> Result<(), RecordError> {
    let (found, expected) = (positions.len(), sheet.vertices.len());
    if found != expected {
        return Err(RecordError::VertexCount { frame, found, expected });
    }
    match positions.iter().position(|p| !p.is_finite()) {
        None => Ok(()),
        Some(vertex) => {
            Err(RecordError::NotFinite { frame, vertex, position: positions[vertex].to_array() })
        }
    }
}

/// [`picture`] of a prepared sheet and checked input, each triangle painted as `paints` says.
pub(crate) fn raster(
    paper: &Paper<'_>,
    positions: &[DVec3],
    camera: &Camera,
    style: &Style,
    paints: &[Paint],
    size: [u32; 2],
) -> Image {
    let surface = Surface::new(paper, positions, camera, style);
    let canvas = Canvas::new(&surface, style, paints);
    let [width, height] = size.map(|side| side as usize);
    let mut pixels = vec![style.background; width * height];
    pixels
        .par_chunks_mut(width * LARGEST)
        .enumerate()
        .for_each(|(index, rows)| Strip::new(&canvas, rows, width, index * LARGEST).draw());
    Image { width: size[0], height: size[1], pixels }
}

/// A square of pixels; `left` and `top` are those of its first pixel.
#[derive(Clone, Copy)]
struct Region {
    left: usize,
    top: usize,
    side: usize,
}

impl Region {
    fn square(self) -> Square {
        let half = 0.5 * self.side as f64;
        let corner = DVec2::new(self.left as f64, self.top as f64);
        Square { centre: corner + half, half }
    }

    fn quarters(self) -> [Self; 4] {
        let side = self.side / 2;
        [(0, 0), (side, 0), (0, side), (side, side)].map(|(x, y)| Self {
            left: self.left + x,
            top: self.top + y,
            side,
        })
    }
}

/// Some rows of a picture while they are drawn.
struct Strip<'a> {
    canvas: &'a Canvas<'a>,
    pixels: &'a mut [[u8; 3]],
    width: usize,
    /// The first row and the one after the last.
    rows: [usize; 2],
    /// The triangles that may show in the current square, after those of the squares around it.
    faces: Vec<u32>,
    /// The edges whose lines may show, stacked in the same way.
    edges: Vec<u32>,
    found: Vec<Candidate>,
    pixel: Pixel,
}

impl<'a> Strip<'a> {
    fn new(canvas: &'a Canvas<'a>, pixels: &'a mut [[u8; 3]], width: usize, top: usize) -> Self {
        Self {
            rows: [top, top + pixels.len() / width],
            canvas,
            pixels,
            width,
            faces: (0..canvas.surface.faces().len() as u32).collect(),
            edges: Vec::new(),
            found: Vec::new(),
            pixel: Pixel::default(),
        }
    }

    fn draw(&mut self) {
        for left in (0..self.width).step_by(LARGEST) {
            let region = Region { left, top: self.rows[0], side: LARGEST };
            self.divide(region, 0);
        }
    }

    /// Draws `region`, in which the triangles from `start` on the stack may show.
    fn divide(&mut self, region: Region, start: usize) {
        if !self.shows(region) {
            return;
        }
        let (surface, square, own) = (self.canvas.surface, region.square(), self.faces.len());
        for index in start..own {
            let face = self.faces[index];
            if surface.face(face).may_touch(&square) {
                self.faces.push(face);
            }
        }
        if self.faces.len() == own {
            return;
        }
        if region.side == 1 {
            let list = &self.faces[own..];
            let light = self.pixel.light(self.canvas, list, square.centre);
            self.fill(region, encoded(light));
        } else if let Some(face) = self.filler(&square, own) {
            self.edges.extend(surface.lines(face));
            self.divide_filled(region, face, 0);
            self.edges.clear();
        } else {
            for quarter in region.quarters() {
                self.divide(quarter, own);
            }
        }
        self.faces.truncate(own);
    }

    /// The one triangle that is seen in `square` of those from `own` on the stack, if that is certain; drops some that
    /// are hidden.
    fn filler(&mut self, square: &Square, own: usize) -> Option<u32> {
        let surface = self.canvas.surface;
        if !surface.drop_hidden(&mut self.faces, own, square) {
            return None;
        }
        let list = &self.faces[own..];
        let front = surface.front_among(list, square.centre, &mut self.found)?;
        let fills = surface.fills(front.face, list, square);
        fills.then_some(front.face)
    }

    /// Draws `region`, which `face` fills and in which the lines of the edges from `start` on the stack may show.
    fn divide_filled(&mut self, region: Region, face: u32, start: usize) {
        if !self.shows(region) {
            return;
        }
        let (square, own) = (region.square(), self.edges.len());
        for index in start..own {
            let edge = self.edges[index];
            if self.canvas.surface.may_have_line(edge, &square) {
                self.edges.push(edge);
            }
        }
        if self.edges.len() == own {
            self.fill(region, self.canvas.colors[face as usize]);
        } else if region.side == 1 {
            let list = &self.edges[own..];
            let light = self.pixel.filled(self.canvas, face, list, square.centre);
            self.fill(region, encoded(light));
        } else {
            for quarter in region.quarters() {
                self.divide_filled(quarter, face, own);
            }
        }
        self.edges.truncate(own);
    }

    /// Whether a part of `region` lies in the picture.
    fn shows(&self, region: Region) -> bool {
        region.left < self.width && region.top < self.rows[1]
    }

    fn fill(&mut self, region: Region, color: [u8; 3]) {
        let Region { left, top, side } = region;
        let right = (left + side).min(self.width);
        for y in top..(top + side).min(self.rows[1]) {
            let row = (y - self.rows[0]) * self.width;
            self.pixels[row + left..row + right].fill(color);
        }
    }
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};
    use glam::Vec3;

    use super::*;
    use crate::View;
    use crate::square::{SAMPLES, at_samples};

    #[test]
    fn pixels_filled_from_bounds_are_those_found_sample_by_sample() {
        let size = [72, 54];
        let style = Style::default();
        let cases = [(Case::E, 1.0, None), (Case::SII, 1.6, Some(0.7))];
        for (case, width, lambda) in cases {
            let unit = Unit::new(case, width, 1.0, lambda, None).unwrap();
            let units = UnitSheet::new(unit, 3, 2).unwrap();
            let order = units.compact_order();
            let paper = Paper::new(&units.sheet, &order);
            let (flat, compact) = (units.sheet.planar(), units.compact());
            for part in [0.0, 0.7, 0.999, 1.0] {
                let pairs = flat.iter().zip(&compact);
                let state: Vec<_> = pairs.map(|(&p, &q)| p.lerp(q, part)).collect();
                let camera = Camera::fit(View::Iso, state.clone(), size, 0.05).unwrap();
                let image = raster(&paper, &state, &camera, &style, &[], size);
                let surface = Surface::new(&paper, &state, &camera, &style);
                let canvas = Canvas::new(&surface, &style, &[]);
                for (index, &pixel) in (0..).zip(&image.pixels) {
                    let corner = [index % size[0], index / size[0]].map(f64::from);
                    let centre = DVec2::from(corner) + 0.5;
                    let light = |point| match surface.front_at(point) {
                        Some(front) => match surface.line_at(front.face, point) {
                            Some(edge) => canvas.line(edge),
                            None => canvas.faces[front.face as usize],
                        },
                        None => canvas.inks.background,
                    };
                    let sum: Vec3 = at_samples(centre, light).into_iter().sum();
                    let expected = encoded(sum / SAMPLES as f32);
                    let error = (0..3).map(|c| pixel[c].abs_diff(expected[c])).max();
                    assert!(error <= Some(1), "{case:?} {part} {corner:?}: {pixel:?} {expected:?}");
                }
            }
        }
    }
}
