//! Drawings as pixels.

use epaint_default_fonts::UBUNTU_LIGHT;
use glam::DVec2;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, PixmapPaint,
    PremultipliedColorU8, StrokeDash, Transform,
};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::label::runs;
use super::{Anchor, Drawing, Item, PIXELS_A_UNIT, Stroke, WORDS};
use crate::{Image, RecordError};

/// `image` as a PNG file.
///
/// # Errors
/// [`RecordError::Size`], [`RecordError::Png`].
pub fn png(image: &Image) -> Result<Vec<u8>, RecordError> {
    encoded(&pixmap_of(image)?)
}

impl Drawing {
    /// The drawing as a PNG file, [`PIXELS_A_UNIT`] pixels a unit.
    ///
    /// # Errors
    /// [`RecordError::Png`], [`RecordError::Font`].
    pub fn png(&self) -> Result<Vec<u8>, RecordError> {
        encoded(&self.pixmap()?)
    }

    /// The pixels of [`Self::png`].
    ///
    /// # Errors
    /// [`RecordError::Font`].
    pub fn image(&self) -> Result<Image, RecordError> {
        let pixmap = self.pixmap()?;
        let color = |p: &PremultipliedColorU8| [p.red(), p.green(), p.blue()];
        Ok(Image {
            width: pixmap.width(),
            height: pixmap.height(),
            pixels: pixmap.pixels().iter().map(color).collect(),
        })
    }

    fn pixmap(&self) -> Result<Pixmap, RecordError> {
        let face = Face::parse(UBUNTU_LIGHT, 0)
            .map_err(|e| RecordError::Font { message: e.to_string() })?;
        let mut pixmap = new_pixmap(self.size.map(|side| side * PIXELS_A_UNIT))?;
        if let Some([r, g, b]) = self.background {
            pixmap.fill(Color::from_rgba8(r, g, b, u8::MAX));
        }
        for item in &self.items {
            match item {
                Item::Area { outline, color } => fill(&mut pixmap, path(outline, true), *color),
                Item::Shape { rings, color, bleed } => {
                    let shape = joined(rings.iter().map(|ring| (&ring[..], true)));
                    let outline = Stroke::new(*color, *bleed);
                    stroke_path(&mut pixmap, shape.as_ref(), &outline);
                    fill(&mut pixmap, shape, *color);
                }
                Item::Line { points, stroke } => {
                    stroke_path(&mut pixmap, path(points, false).as_ref(), stroke);
                }
                Item::Lines { parts, stroke } => {
                    let lines = joined(parts.iter().map(|part| (&part[..], false)));
                    stroke_path(&mut pixmap, lines.as_ref(), stroke);
                }
                Item::Words { at, text, size, anchor } => {
                    fill(&mut pixmap, letters(&face, *at, text, *size, *anchor), WORDS);
                }
                Item::Picture { at, image } => {
                    // Whole pixels, so that nothing is sampled anew.
                    let at = (*at * f64::from(PIXELS_A_UNIT)).round().as_ivec2();
                    let (source, paint) = (pixmap_of(image)?, PixmapPaint::default());
                    let still = Transform::identity();
                    pixmap.draw_pixmap(at.x, at.y, source.as_ref(), &paint, still, None);
                }
            }
        }
        Ok(pixmap)
    }
}

fn new_pixmap([width, height]: [u32; 2]) -> Result<Pixmap, RecordError> {
    Pixmap::new(width, height).ok_or(RecordError::Size { width, height, limit: crate::MAX_PIXELS })
}

fn encoded(pixmap: &Pixmap) -> Result<Vec<u8>, RecordError> {
    pixmap.encode_png().map_err(|e| RecordError::Png { message: e.to_string() })
}

fn pixmap_of(image: &Image) -> Result<Pixmap, RecordError> {
    let mut pixmap = new_pixmap([image.width, image.height])?;
    for (pixel, &[r, g, b]) in pixmap.pixels_mut().iter_mut().zip(&image.pixels) {
        *pixel = tiny_skia::ColorU8::from_rgba(r, g, b, u8::MAX).premultiply();
    }
    Ok(pixmap)
}

fn paint([r, g, b]: [u8; 3]) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, u8::MAX);
    paint
}

/// Units of the page to pixels.
fn scaling() -> Transform {
    let scale = PIXELS_A_UNIT as f32;
    Transform::from_scale(scale, scale)
}

/// A path of no length has nothing to draw.
fn fill(pixmap: &mut Pixmap, path: Option<Path>, color: [u8; 3]) {
    if let Some(path) = path {
        let (rule, paint) = (FillRule::Winding, paint(color));
        pixmap.fill_path(&path, &paint, rule, scaling(), None);
    }
}

fn stroke_path(pixmap: &mut Pixmap, path: Option<&Path>, stroke: &Stroke) {
    let Some(path) = path.filter(|_| stroke.width > 0.0) else {
        return;
    };
    let dash = stroke.dash.map(|lengths| lengths.map(|l| l as f32).to_vec());
    let look = tiny_skia::Stroke {
        width: stroke.width as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        dash: dash.and_then(|lengths| StrokeDash::new(lengths, 0.0)),
        ..tiny_skia::Stroke::default()
    };
    pixmap.stroke_path(path, &paint(stroke.color), &look, scaling(), None);
}

fn path(points: &[DVec2], closed: bool) -> Option<Path> {
    joined(std::iter::once((points, closed)))
}

/// One path of several lines, each closed or not.
fn joined<'a>(parts: impl Iterator<Item = (&'a [DVec2], bool)>) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (points, closed) in parts {
        for (index, point) in points.iter().enumerate() {
            let [x, y] = point.as_vec2().to_array();
            if index == 0 {
                builder.move_to(x, y);
            } else {
                builder.line_to(x, y);
            }
        }
        if closed {
            builder.close();
        }
    }
    builder.finish()
}

/// The outlines of words.
fn letters(face: &Face<'_>, at: DVec2, text: &str, size: f64, anchor: Anchor) -> Option<Path> {
    let unit = size / f64::from(face.units_per_em());
    let mut pen = Pen { builder: PathBuilder::new(), at: DVec2::ZERO, scale: 1.0 };
    let mut x = 0.0;
    for run in runs(text) {
        pen.scale = unit * run.scale;
        for letter in run.text.chars() {
            let glyph = face.glyph_index(letter).unwrap_or(GlyphId(0));
            pen.at = DVec2::new(x, -run.rise * size);
            face.outline_glyph(glyph, &mut pen);
            x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * pen.scale;
        }
    }
    let start = match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * x,
        Anchor::End => x,
    };
    let shift = DVec2::new(at.x - start, at.y).as_vec2();
    pen.builder.finish()?.transform(Transform::from_translate(shift.x, shift.y))
}

/// Transforms the outline of a letter, y up, to its position on the page.
struct Pen {
    builder: PathBuilder,
    at: DVec2,
    scale: f64,
}

impl Pen {
    fn transform(&self, x: f32, y: f32) -> [f32; 2] {
        let point = DVec2::new(f64::from(x), -f64::from(y));
        (self.at + self.scale * point).as_vec2().to_array()
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.transform(x, y);
        self.builder.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.transform(x, y);
        self.builder.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ([x1, y1], [x, y]) = (self.transform(x1, y1), self.transform(x, y));
        self.builder.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ([x1, y1], [x2, y2]) = (self.transform(x1, y1), self.transform(x2, y2));
        let [x, y] = self.transform(x, y);
        self.builder.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.builder.close();
    }
}
