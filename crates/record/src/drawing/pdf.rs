//! Drawings as PDF 1.7 (ISO 32000-1).

use glam::DVec2;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use super::deflate::deflated;
use super::label::runs;
use super::pdf_font::PdfFont;
use super::{Anchor, Drawing, Item, PIXELS_A_UNIT, Stroke, WORDS};
use crate::{Image, RecordError};

/// The number of points, the unit of PDF, in a millimetre.
const POINTS_A_MILLIMETRE: f64 = 72.0 / 25.4;

const FONT: Name<'static> = Name(b"F");

/// The objects of the file: these, then the pictures.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFORMATION: Ref = Ref::new(5);
const METADATA: Ref = Ref::new(6);
const FONT_PARTS: [Ref; 5] = [Ref::new(7), Ref::new(8), Ref::new(9), Ref::new(10), Ref::new(11)];
const FIRST_PICTURE: i32 = 12;

impl Drawing {
    /// The drawing as a PDF of one page, with the letters it uses.
    ///
    /// The same drawing gives the same bytes: there is no time in it.
    ///
    /// # Errors
    /// [`RecordError::Font`].
    pub fn pdf(&self) -> Result<Vec<u8>, RecordError> {
        let letters = self.items.iter().filter_map(|item| match item {
            Item::Words { text, .. } => Some(text.chars()),
            _ => None,
        });
        let font = PdfFont::new(letters.flatten())?;
        let points = self.unit() * POINTS_A_MILLIMETRE;
        let [width, height] = self.size.map(|side| (f64::from(side) * points) as f32);
        let (mut pdf, mut images) = (Pdf::new(), Vec::new());
        let content = deflated(&self.content(&font, points as f32, height, &mut images));
        pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
        pdf.pages(PAGES).kids([PAGE]).count(1);
        let mut page = pdf.page(PAGE);
        page.media_box(Rect::new(0.0, 0.0, width, height)).parent(PAGES).contents(CONTENT);
        let mut resources = page.resources();
        resources.fonts().pair(FONT, FONT_PARTS[0]);
        let mut pictures = resources.x_objects();
        for (k, _) in images.iter().enumerate() {
            pictures.pair(Name(picture_name(k).as_bytes()), picture_id(k));
        }
        pictures.finish();
        resources.finish();
        page.finish();
        font.write(&mut pdf, FONT_PARTS)?;
        for (k, image) in images.into_iter().enumerate() {
            write_picture(&mut pdf, picture_id(k), image);
        }
        self.write_origin(&mut pdf);
        Ok(pdf.finish())
    }

    /// The catalogue and what the document says of itself.
    fn write_origin(&self, pdf: &mut Pdf) {
        let Some(origin) = &self.provenance else {
            pdf.catalog(CATALOG).pages(PAGES);
            return;
        };
        let xmp = origin.xmp();
        // Not compressed, so that programs that know nothing of PDF find it.
        pdf.metadata(METADATA, xmp.as_bytes()).finish();
        pdf.document_info(INFORMATION)
            .title(TextStr(&origin.title))
            .subject(TextStr(&origin.hash))
            .producer(TextStr(&origin.producer));
        pdf.catalog(CATALOG).pages(PAGES).metadata(METADATA);
    }

    /// The page's content, `points` a unit; gathers the pictures.
    fn content<'a>(
        &'a self,
        font: &PdfFont,
        points: f32,
        height: f32,
        images: &mut Vec<&'a Image>,
    ) -> Vec<u8> {
        let mut content = Content::new();
        content.transform([points, 0.0, 0.0, -points, 0.0, height]);
        content.set_line_cap(LineCapStyle::RoundCap);
        content.set_line_join(LineJoinStyle::RoundJoin);
        if let Some(color) = self.background {
            set_fill(&mut content, color);
            let [width, height] = self.size.map(|side| side as f32);
            content.rect(0.0, 0.0, width, height).fill_nonzero();
        }
        for item in &self.items {
            match item {
                Item::Area { outline, color } => {
                    fill(&mut content, std::slice::from_ref(outline), *color, 0.0);
                }
                Item::Shape { rings, color, bleed } => fill(&mut content, rings, *color, *bleed),
                Item::Line { points, stroke } => draw(&mut content, [&points[..]], stroke),
                Item::Lines { parts, stroke } => {
                    draw(&mut content, parts.iter().map(|part| &part[..]), stroke);
                }
                Item::Words { at, text, size, anchor } => {
                    write(&mut content, font, *at, text, *size, *anchor);
                }
                Item::Picture { at, image } => {
                    draw_picture(&mut content, *at, image, &picture_name(images.len()));
                    images.push(image);
                }
            }
        }
        content.finish().into_vec()
    }
}

/// To a thousandth, so that numbers are short.
fn short(value: f64) -> f32 {
    ((value * 1000.0).round() / 1000.0) as f32
}

fn parts([r, g, b]: [u8; 3]) -> [f32; 3] {
    [r, g, b].map(|byte| short(f64::from(byte) / 255.0))
}

fn set_fill(content: &mut Content, color: [u8; 3]) {
    let [r, g, b] = parts(color);
    content.set_fill_rgb(r, g, b);
}

fn set_stroke(content: &mut Content, color: [u8; 3], width: f64) {
    let [r, g, b] = parts(color);
    content.set_stroke_rgb(r, g, b);
    content.set_line_width(short(width));
}

fn trace(content: &mut Content, points: &[DVec2]) {
    for (k, point) in points.iter().enumerate() {
        let [x, y] = point.to_array().map(short);
        if k == 0 {
            content.move_to(x, y);
        } else {
            content.line_to(x, y);
        }
    }
}

fn fill(content: &mut Content, rings: &[Vec<DVec2>], color: [u8; 3], bleed: f64) {
    set_fill(content, color);
    if bleed > 0.0 {
        set_stroke(content, color, bleed);
    }
    for ring in rings {
        trace(content, ring);
        content.close_path();
    }
    if bleed > 0.0 {
        content.fill_nonzero_and_stroke();
    } else {
        content.fill_nonzero();
    }
}

fn draw<'a>(content: &mut Content, parts: impl IntoIterator<Item = &'a [DVec2]>, stroke: &Stroke) {
    set_stroke(content, stroke.color, stroke.width);
    if let Some(lengths) = stroke.dash {
        content.set_dash_pattern(lengths.map(short), 0.0);
    }
    for part in parts {
        trace(content, part);
    }
    content.stroke();
    if stroke.dash.is_some() {
        content.set_dash_pattern([], 0.0);
    }
}

fn write(content: &mut Content, font: &PdfFont, at: DVec2, text: &str, size: f64, anchor: Anchor) {
    let runs = runs(text);
    let shown = runs.iter().map(|run| (run, font.shown(&run.text)));
    let shown: Vec<_> = shown.collect();
    let width: f64 = shown.iter().map(|(run, (_, w))| w * run.scale * size).sum();
    let start = match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * width,
        Anchor::End => width,
    };
    let mut x = at.x - start;
    set_fill(content, WORDS);
    content.begin_text();
    for (run, (bytes, width)) in shown {
        let letters = run.scale * size;
        content.set_font(FONT, short(letters));
        let y = at.y - run.rise * size;
        content.set_text_matrix([1.0, 0.0, 0.0, -1.0, short(x), short(y)]);
        content.show(Str(&bytes));
        x += width * letters;
    }
    content.end_text();
}

fn draw_picture(content: &mut Content, at: DVec2, image: &Image, name: &str) {
    let [width, height] =
        [image.width, image.height].map(|side| f64::from(side) / f64::from(PIXELS_A_UNIT));
    let [x, y, w, h] = [at.x, at.y + height, width, height].map(short);
    content.save_state();
    content.transform([w, 0.0, 0.0, -h, x, y]);
    content.x_object(Name(name.as_bytes()));
    content.restore_state();
}

fn picture_name(index: usize) -> String {
    format!("P{index}")
}

fn picture_id(index: usize) -> Ref {
    Ref::new(FIRST_PICTURE.saturating_add(i32::try_from(index).unwrap_or(i32::MAX)))
}

fn write_picture(pdf: &mut Pdf, id: Ref, image: &Image) {
    let bytes = deflated(image.pixels.as_flattened());
    let mut object = pdf.image_xobject(id, &bytes);
    object.filter(Filter::FlateDecode);
    object.width(image.width.cast_signed());
    object.height(image.height.cast_signed());
    object.color_space().device_rgb();
    object.bits_per_component(8);
}
