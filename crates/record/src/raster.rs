//! Pixels of the visible surface.
//!
//! A pixel is the mean, in linear light, of 16 samples: a Hammersley set, which has one sample in each of the 4 × 4
//! cells and in each of 16 rows and columns, so that steep and flat edges get 16 steps where a regular grid has 4.
//! Squares of pixels, and then pixels, that one triangle fills alone are found from bounds and get its colour at once.

use foldmotion_pattern::{LayerOrder, Sheet};
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::image::check_size;
use crate::shade::{Inks, encoded};
use crate::surface::{Candidate, ScreenFace};
use crate::{Camera, Image, Paper, RecordError, Style, Surface};

/// The side of the squares the picture is worked through in.
const TILE: usize = 8;

/// Samples a pixel.
const SAMPLES: u32 = 16;

/// One state of a sheet.
///
/// `positions`: one a vertex. `order`: of the triangles that coincide. The picture does not depend on the number of
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
    Ok(raster(&paper, positions, camera, style, size))
}

/// Refuses positions that are too few, too many or not finite.
pub(crate) fn check_positions(
    sheet: &Sheet,
    frame: usize,
    positions: &[DVec3],
) -> Result<(), RecordError> {
    let (found, expected) = (positions.len(), sheet.vertices.len());
    if found != expected {
        return Err(RecordError::VertexCount {
            frame,
            found,
            expected,
        });
    }
    match positions.iter().position(|p| !p.is_finite()) {
        None => Ok(()),
        Some(vertex) => Err(RecordError::NotFinite {
            frame,
            vertex,
            position: positions[vertex].to_array(),
        }),
    }
}

/// [`picture`] of a prepared sheet and checked input.
pub(crate) fn raster(
    paper: &Paper<'_>,
    positions: &[DVec3],
    camera: &Camera,
    style: &Style,
    size: [u32; 2],
) -> Image {
    let surface = Surface::new(paper, positions, camera, style);
    let [width, height] = size.map(|side| side as usize);
    let canvas = Canvas::new(&surface, style);
    let columns = width.div_ceil(TILE);
    let tiles = tiles(&surface, columns, height.div_ceil(TILE));
    let mut pixels = vec![style.background; width * height];
    pixels
        .par_chunks_mut(width * TILE)
        .zip(tiles.par_chunks(columns))
        .enumerate()
        .for_each_init(Scratch::default, |scratch, (row, (rows, lists))| {
            for (column, list) in lists.iter().enumerate() {
                canvas.tile(list, [column * TILE, row * TILE], rows, width, scratch);
            }
        });
    Image {
        width: size[0],
        height: size[1],
        pixels,
    }
}

/// The triangles that may show in each tile, row by row, in the order of the sheet.
fn tiles(surface: &Surface<'_>, columns: usize, rows: usize) -> Vec<Vec<u32>> {
    let mut tiles = vec![Vec::new(); columns * rows];
    for face in 0..surface.faces().len() as u32 {
        let (low, high) = surface.bounds(face);
        let (x, y) = (span(low.x, high.x, columns), span(low.y, high.y, rows));
        for row in y {
            for column in x.clone() {
                let corner = DVec2::new(column as f64, row as f64) * TILE as f64;
                let half = 0.5 * TILE as f64;
                if surface.may_touch(face, corner + half, half) {
                    tiles[row * columns + column].push(face);
                }
            }
        }
    }
    tiles
}

/// The tiles from pixel `low` to pixel `high`, of `count`.
#[expect(clippy::cast_sign_loss, reason = "clamped to 0 and above before")]
fn span(low: f64, high: f64, count: usize) -> std::ops::Range<usize> {
    let tile = |pixel: f64| (pixel / TILE as f64).floor().clamp(-1.0, count as f64);
    let start = tile(low).max(0.0) as usize;
    let end = (tile(high) + 1.0).max(0.0) as usize;
    start..end.min(count)
}

/// Lists kept from pixel to pixel.
#[derive(Default)]
struct Scratch {
    /// The triangles that may show in the pixel.
    near: Vec<u32>,
    /// Those at a point.
    found: Vec<Candidate>,
}

/// What colours a sample: the surface with the colour of each triangle.
struct Canvas<'a> {
    surface: &'a Surface<'a>,
    inks: Inks,
    faces: Vec<Vec3>,
    samples: Vec<DVec2>,
}

impl<'a> Canvas<'a> {
    fn new(surface: &'a Surface<'a>, style: &Style) -> Self {
        let inks = style.inks();
        let color = |face: &ScreenFace| inks.paper(face.normal);
        let faces = surface.faces().iter().map(color).collect();
        let sample = |k: u32| {
            let mirrored = (k.reverse_bits() >> (u32::BITS - SAMPLES.ilog2())) & (SAMPLES - 1);
            let place = DVec2::new(f64::from(k), f64::from(mirrored));
            (place + 0.5) / f64::from(SAMPLES) - 0.5
        };
        Self {
            surface,
            inks,
            faces,
            samples: (0..SAMPLES).map(sample).collect(),
        }
    }

    /// Draws the tile at `corner` (x, y) into `rows`, the pixels of its row of tiles.
    fn tile(
        &self,
        list: &[u32],
        corner: [usize; 2],
        rows: &mut [[u8; 3]],
        width: usize,
        scratch: &mut Scratch,
    ) {
        if list.is_empty() {
            return;
        }
        let [left, top] = corner;
        let right = (left + TILE).min(width);
        let centre = DVec2::new(left as f64, top as f64) + 0.5 * TILE as f64;
        let half = 0.5 * TILE as f64;
        let filler = self.filler(list, centre, half, &mut scratch.found);
        if let Some(face) = filler
            && !self.surface.may_have_line(face, centre, half)
        {
            let color = encoded(self.faces[face as usize]);
            for row in rows.chunks_mut(width) {
                row[left..right].fill(color);
            }
            return;
        }
        for (y, row) in rows.chunks_mut(width).enumerate() {
            for (x, pixel) in row[left..right].iter_mut().enumerate() {
                let centre = DVec2::new((left + x) as f64, (top + y) as f64) + 0.5;
                let light = match filler {
                    Some(face) => self.lined(face, centre),
                    None => self.pixel(list, centre, scratch),
                };
                *pixel = encoded(light);
            }
        }
    }

    /// The one triangle that is seen in the square of half side `half` around `centre`, if that is certain.
    fn filler(
        &self,
        list: &[u32],
        centre: DVec2,
        half: f64,
        found: &mut Vec<Candidate>,
    ) -> Option<u32> {
        let face = self.surface.front_among(list, centre, found)?.face;
        let fills = self.surface.fills(face, list, centre, half);
        fills.then_some(face)
    }

    /// The light of the pixel around `centre`.
    fn pixel(&self, list: &[u32], centre: DVec2, scratch: &mut Scratch) -> Vec3 {
        let Scratch { near, found } = scratch;
        near.clear();
        let touches = |&face: &u32| self.surface.may_touch(face, centre, 0.5);
        near.extend(list.iter().copied().filter(touches));
        if near.is_empty() {
            return self.inks.background;
        }
        if let Some(face) = self.filler(near, centre, 0.5, found) {
            return self.lined(face, centre);
        }
        self.mean(
            |sample| match self.surface.front_among(near, centre + *sample, found) {
                Some(front) => self.seen(front.face, centre + *sample),
                None => self.inks.background,
            },
        )
    }

    /// The light of the pixel around `centre`, which `face` fills, with its lines.
    fn lined(&self, face: u32, centre: DVec2) -> Vec3 {
        if self.surface.may_have_line(face, centre, 0.5) {
            self.mean(|sample| self.seen(face, centre + *sample))
        } else {
            self.faces[face as usize]
        }
    }

    /// The light at `point` where `face` is seen.
    fn seen(&self, face: u32, point: DVec2) -> Vec3 {
        match self.surface.line_at(face, point) {
            Some(edge) => {
                let sheet = self.surface.paper().sheet;
                self.inks.line(sheet.edges[edge as usize].assignment)
            }
            None => self.faces[face as usize],
        }
    }

    /// The mean over the samples of a pixel; exactly the common value where all are alike.
    fn mean(&self, light: impl FnMut(&DVec2) -> Vec3) -> Vec3 {
        let sum: Vec3 = self.samples.iter().map(light).sum();
        sum / SAMPLES as f32
    }
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;
    use crate::View;

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
                let image = raster(&paper, &state, &camera, &style, size);
                let surface = Surface::new(&paper, &state, &camera, &style);
                let canvas = Canvas::new(&surface, &style);
                for (index, &pixel) in (0..).zip(&image.pixels) {
                    let place = [index % size[0], index / size[0]].map(f64::from);
                    let centre = DVec2::from(place) + 0.5;
                    let light = canvas.mean(|sample| {
                        let front = surface.front_at(centre + *sample);
                        front.map_or(canvas.inks.background, |front| {
                            canvas.seen(front.face, centre + *sample)
                        })
                    });
                    let expected = encoded(light);
                    let error = (0..3).map(|c| pixel[c].abs_diff(expected[c])).max();
                    assert!(
                        error <= Some(1),
                        "{case:?} {part} {place:?}: {pixel:?} {expected:?}"
                    );
                }
            }
        }
    }
}
