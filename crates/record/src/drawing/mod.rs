//! A drawing: areas, lines, words and pictures on a page, written as SVG, PDF and PNG.
//!
//! Lengths are units of the page, x to the right, y down; colours are sRGB. SVG and PDF keep lines and words as such
//! and carry pictures inside; the PNG has [`PIXELS_A_UNIT`] pixels a unit. All come from the same items in the same
//! order.

mod deflate;
mod label;
mod pdf;
mod pdf_font;
mod png;
mod provenance;
mod svg;
mod width;

use glam::DVec2;

use crate::image::check_size;
use crate::{Image, RecordError};

pub use self::png::png;
pub use self::provenance::Provenance;
pub(crate) use self::width::words_width;

/// Pixels of a PNG, and of pictures inside a drawing, a unit of the page.
pub const PIXELS_A_UNIT: u32 = 2;

/// The length of a dot: round ends make it one, but some viewers draw nothing of no length.
const DOT: f64 = 0.01;

/// The millimetres of a unit unless said otherwise: a 96th of an inch, as in CSS.
const UNIT_MILLIMETRES: f64 = 25.4 / 96.0;

/// A line's look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// The colour of the line, sRGB.
    pub color: [u8; 3],
    /// The width of the line in units of the page.
    pub width: f64,
    /// The lengths of a dash, a gap, another dash and another gap; all ends are round and half a width longer.
    pub dash: Option<[f64; 4]>,
}

impl Stroke {
    /// A solid line.
    pub fn new(color: [u8; 3], width: f64) -> Self {
        Self { color, width, dash: None }
    }

    /// This line, dashed.
    #[must_use]
    pub fn dashed(self, dash: f64, gap: f64) -> Self {
        Self { dash: Some([dash, gap, dash, gap]), ..self }
    }

    /// This line, dashed with a dot in each gap.
    #[must_use]
    pub fn dash_dotted(self, dash: f64, gap: f64) -> Self {
        Self { dash: Some([dash, gap, DOT, gap]), ..self }
    }
}

/// Which part of a text is at its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Anchor {
    /// Its start.
    #[default]
    Start,
    /// The middle of the text is at the position.
    Middle,
    /// The end of the text is at the position.
    End,
}

/// An item of a drawing.
#[derive(Debug, Clone, PartialEq)]
enum Item {
    Area { outline: Vec<DVec2>, color: [u8; 3] },
    Shape { rings: Vec<Vec<DVec2>>, color: [u8; 3], bleed: f64 },
    Line { points: Vec<DVec2>, stroke: Stroke },
    Lines { parts: Vec<[DVec2; 2]>, stroke: Stroke },
    Words { at: DVec2, text: String, size: f64, anchor: Anchor },
    Picture { at: DVec2, image: Image },
}

/// The longest side of a page in millimetres: 14 400 points (ISO 32000-1, annex C).
const LONGEST_PAGE: f64 = 5080.0;

/// The colour of words.
const WORDS: [u8; 3] = [38, 38, 42];

/// A page with items, the later ones on top.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    size: [u32; 2],
    /// Millimetres of a unit, if they are said.
    unit: Option<f64>,
    background: Option<[u8; 3]>,
    provenance: Option<Provenance>,
    items: Vec<Item>,
}

impl Drawing {
    /// An empty white page of `size` units.
    ///
    /// # Errors
    /// [`RecordError::Size`] where its PNG would have no pixels or too many.
    pub fn new(size: [u32; 2]) -> Result<Self, RecordError> {
        check_size(size.map(|side| side.saturating_mul(PIXELS_A_UNIT)))?;
        Ok(Self {
            size,
            unit: None,
            background: Some([u8::MAX; 3]),
            provenance: None,
            items: Vec::new(),
        })
    }

    /// The page in print: `millimetres` a unit, else a 96th of an inch.
    ///
    /// # Errors
    /// [`RecordError::Unit`] where that is not a positive length, or the page would be longer than 5 m, more than a PDF
    /// may be.
    pub fn with_unit(mut self, millimetres: f64) -> Result<Self, RecordError> {
        let longest = f64::from(self.size[0].max(self.size[1])) * millimetres;
        if !(millimetres > 0.0 && longest <= LONGEST_PAGE) {
            return Err(RecordError::Unit { value: millimetres, limit: LONGEST_PAGE });
        }
        self.unit = Some(millimetres);
        Ok(self)
    }

    /// The page in another colour; `None` makes it transparent.
    #[must_use]
    pub fn with_background(mut self, background: Option<[u8; 3]>) -> Self {
        self.background = background;
        self
    }

    /// Sets the origin that every file of the drawing states.
    #[must_use]
    pub fn with_provenance(mut self, provenance: Provenance) -> Self {
        self.provenance = Some(provenance);
        self
    }

    /// Units across and down.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Millimetres of a unit.
    fn unit(&self) -> f64 {
        self.unit.unwrap_or(UNIT_MILLIMETRES)
    }

    /// Fills the polygon `outline`.
    pub fn area(&mut self, outline: impl IntoIterator<Item = DVec2>, color: [u8; 3]) {
        let outline = outline.into_iter().collect();
        self.items.push(Item::Area { outline, color });
    }

    /// Fills what closed `rings` wind around, holes in the opposite direction, and `bleed` around it: where shapes
    /// adjoin, a small one closes the seam that viewers leave between edges that they smooth one by one.
    pub fn shape(&mut self, rings: Vec<Vec<DVec2>>, color: [u8; 3], bleed: f64) {
        self.items.push(Item::Shape { rings, color, bleed });
    }

    /// Draws straight lines of one look.
    pub fn lines(&mut self, parts: Vec<[DVec2; 2]>, stroke: Stroke) {
        self.items.push(Item::Lines { parts, stroke });
    }

    /// Draws a line through `points`.
    pub fn line(&mut self, points: impl IntoIterator<Item = DVec2>, stroke: Stroke) {
        let points = points.into_iter().collect();
        self.items.push(Item::Line { points, stroke });
    }

    /// Fills a disc of radius `radius`, a polygon of 24 sides.
    pub fn dot(&mut self, at: DVec2, radius: f64, color: [u8; 3]) {
        let corner = |k: i32| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 24.0);
        self.area((0..24).map(|k| at + radius * corner(k)), color);
    }

    /// Writes `text` on the base line through `at`, letters `size` high in all. After `^` a character, or several in
    /// braces, are raised, after `_` lowered.
    pub fn words(&mut self, at: DVec2, text: impl Into<String>, size: f64, anchor: Anchor) {
        let text = text.into();
        self.items.push(Item::Words { at, text, size, anchor });
    }

    /// Puts `image` with its left upper corner at `at`; [`PIXELS_A_UNIT`] of its pixels are one unit.
    pub fn picture(&mut self, at: DVec2, image: Image) {
        self.items.push(Item::Picture { at, image });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A red square, a blue line across the page and a word.
    fn page() -> Drawing {
        let mut page = Drawing::new([40, 30]).unwrap();
        let square = [(5.0, 5.0), (15.0, 5.0), (15.0, 15.0), (5.0, 15.0)].map(DVec2::from);
        page.area(square, [255, 0, 0]);
        let ends = [DVec2::new(0.0, 20.0), DVec2::new(40.0, 20.0)];
        page.line(ends, Stroke::new([0, 0, 255], 2.0));
        page.words(DVec2::new(20.0, 12.0), "C_4^1 < λ", 8.0, Anchor::Start);
        page
    }

    #[test]
    fn areas_and_lines_show_in_the_png_where_they_were_put() {
        let image = page().image().unwrap();
        assert_eq!([image.width, image.height], [80, 60]);
        assert_eq!(image.pixel(20, 20), [255, 0, 0]);
        assert_eq!(image.pixel(70, 40), [0, 0, 255]);
        assert_eq!(image.pixel(70, 55), [255, 255, 255]);
        let dark = |x: u32| (10..30).any(|y| image.pixel(x, y)[0] < 128);
        assert!((40..80).any(dark), "the word leaves ink");
        assert!(!(32..40).any(dark), "and only where it is");
    }

    #[test]
    fn pictures_keep_their_pixels() {
        let mut page = Drawing::new([10, 10]).unwrap();
        let image =
            Image { width: 4, height: 2, pixels: (0..8).map(|k| [k * 30, 7, 200]).collect() };
        page.picture(DVec2::new(3.0, 2.0), image.clone());
        let drawn = page.image().unwrap();
        for (x, y) in (0..4).flat_map(|x| [(x, 0), (x, 1)]) {
            assert_eq!(drawn.pixel(6 + x, 4 + y), image.pixel(x, y));
        }
        assert_eq!(drawn.pixel(10, 4), [255, 255, 255]);
    }

    #[test]
    fn the_svg_is_well_formed_and_escapes_words() {
        let svg = page().svg().unwrap();
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        assert!(svg.contains("&lt; λ"), "{svg}");
        assert_eq!(svg.matches("<text").count(), 1);
        assert_eq!(svg.matches("<path").count(), 2);
    }

    #[test]
    fn a_page_without_area_is_refused() {
        assert!(Drawing::new([0, 10]).is_err());
        assert!(Drawing::new([u32::MAX, 10]).is_err());
    }
}
