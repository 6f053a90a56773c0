//! The font of a PDF: the letters it uses, out of the built-in one.
//!
//! A composite font with two bytes a glyph (ISO 32000-1, 9.7), embedded, with a table that tells viewers which
//! characters its glyphs represent, so that text can be searched and copied.

use std::collections::BTreeMap;

use epaint_default_fonts::UBUNTU_LIGHT;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Finish, Name, Pdf, Rect, Ref, Str};
use subsetter::GlyphRemapper;
use ttf_parser::{Face, GlyphId};

use super::deflate::deflated;
use crate::RecordError;

/// Its name: six letters tell a subset from the whole font.
const NAME: Name<'static> = Name(b"FOLDMO+Ubuntu-Light");

const SYSTEM: SystemInfo<'static> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The letters of a document.
pub(super) struct PdfFont {
    face: Face<'static>,
    glyphs: GlyphRemapper,
    /// For each letter the glyph in the font and in the subset.
    letters: BTreeMap<char, (GlyphId, u16)>,
}

impl PdfFont {
    /// The font with `letters`; one it has not is drawn as a box.
    pub(super) fn new(letters: impl Iterator<Item = char>) -> Result<Self, RecordError> {
        let face = Face::parse(UBUNTU_LIGHT, 0).map_err(failed)?;
        let mut glyphs = GlyphRemapper::new();
        let mut sorted: Vec<char> = letters.collect();
        sorted.sort_unstable();
        sorted.dedup();
        let glyph = |letter: char| {
            let glyph = face.glyph_index(letter).unwrap_or(GlyphId(0));
            (letter, (glyph, glyphs.remap(glyph.0)))
        };
        let letters = sorted.into_iter().map(glyph).collect();
        Ok(Self { face, glyphs, letters })
    }

    /// The bytes that show `text`, and its width as a part of the letters' size.
    pub(super) fn shown(&self, text: &str) -> (Vec<u8>, f64) {
        let letters = text.chars().filter_map(|letter| self.letters.get(&letter));
        let (mut bytes, mut width) = (Vec::new(), 0.0);
        for &(glyph, id) in letters {
            bytes.extend(id.to_be_bytes());
            width += self.advance(glyph);
        }
        (bytes, width)
    }

    fn advance(&self, glyph: GlyphId) -> f64 {
        let advance = self.face.glyph_hor_advance(glyph).unwrap_or(0);
        f64::from(advance) / f64::from(self.face.units_per_em())
    }

    /// Thousandths of the letters' size.
    fn thousandths(&self, units: i16) -> f32 {
        (1000.0 * f64::from(units) / f64::from(self.face.units_per_em())).round() as f32
    }

    /// Writes the font as object `ids[0]` and what it consists of as the others.
    pub(super) fn write(
        &self,
        pdf: &mut Pdf,
        [font, cid_font, descriptor, file, table]: [Ref; 5],
    ) -> Result<(), RecordError> {
        let subset = subsetter::subset(UBUNTU_LIGHT, 0, &self.glyphs).map_err(failed)?;
        pdf.type0_font(font)
            .base_font(NAME)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(cid_font)
            .to_unicode(table);
        let mut cid = pdf.cid_font(cid_font);
        cid.subtype(CidFontType::Type2)
            .base_font(NAME)
            .system_info(SYSTEM)
            .font_descriptor(descriptor)
            .default_width(0.0)
            .cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = cid.widths();
        for (id, glyph) in (0..).zip(self.glyphs.remapped_gids()) {
            let width = (1000.0 * self.advance(GlyphId(glyph))).round() as f32;
            widths.same(id, id, width);
        }
        widths.finish();
        cid.finish();
        self.describe(pdf, descriptor, file);
        let bytes = deflated(&subset);
        let mut stream = pdf.stream(file, &bytes);
        stream.filter(pdf_writer::Filter::FlateDecode);
        let length = i32::try_from(subset.len()).unwrap_or(i32::MAX);
        stream.pair(Name(b"Length1"), length);
        stream.finish();
        let mut characters = UnicodeCmap::new(Name(b"FoldmotionLetters"), SYSTEM);
        for (&letter, &(_, id)) in &self.letters {
            characters.pair(id, letter);
        }
        pdf.cmap(table, &characters.finish());
        Ok(())
    }

    fn describe(&self, pdf: &mut Pdf, descriptor: Ref, file: Ref) {
        let face = &self.face;
        let all = face.global_bounding_box();
        let [left, bottom, right, top] =
            [all.x_min, all.y_min, all.x_max, all.y_max].map(|side| self.thousandths(side));
        let ascent = self.thousandths(face.ascender());
        pdf.font_descriptor(descriptor)
            .name(NAME)
            .flags(FontFlags::NON_SYMBOLIC)
            .bbox(Rect::new(left, bottom, right, top))
            .italic_angle(0.0)
            .ascent(ascent)
            .descent(self.thousandths(face.descender()))
            .cap_height(face.capital_height().map_or(ascent, |h| self.thousandths(h)))
            .stem_v(60.0)
            .font_file2(file);
    }
}

fn failed(error: impl std::fmt::Display) -> RecordError {
    RecordError::Font { message: error.to_string() }
}
