//! Colours and light.
//!
//! Paper is lit by one soft light from the upper left behind the viewer and by the sky around it. With the unit
//! normal n of the side that is seen, in the view, and the direction l of the light, a side reflects
//!
//! s = a + (1 − a) (½ + ½ n·l)²
//!
//! of its colour: Lambert's cosine wrapped around the whole sphere, so that no facet turns black and neighbours that
//! face away from the light still differ. Both sides of the paper are lit alike.
//!
//! A colour that shows a value takes a part of that light only, and none where the facet is seen square on: there it
//! is the legend's.

use std::sync::LazyLock;

use foldmotion_pattern::Assignment;
use glam::{DVec3, Vec3};

use crate::RecordError;

/// a: what a facet turned away from the light still reflects.
const AMBIENT: f64 = 0.42;

/// The part of the light that colours of values take.
const VALUE_LIGHT: f32 = 0.8;

/// l: right, up, towards the viewer.
const LIGHT: DVec3 = DVec3::new(-0.52, 0.66, 0.54);

/// The widest line in pixels.
const MAX_LINE_WIDTH: f64 = 100.0;

/// The colours of a picture, sRGB.
///
/// The default can be told apart with every common colour blindness and in grey: the front is far lighter than the
/// back, red and blue differ on the axis all dichromats but the rare tritan keep, and in lightness.
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    /// Fully lit front of the paper.
    pub front: [u8; 3],
    /// Fully lit back of the paper.
    pub back: [u8; 3],
    /// The colour of mountain creases.
    pub mountain: [u8; 3],
    /// The colour of valley creases.
    pub valley: [u8; 3],
    /// The colour of the border of the sheet.
    pub border: [u8; 3],
    /// Fully lit facets that are marked, on both sides.
    pub mark: [u8; 3],
    /// The colour behind the sheet.
    pub background: [u8; 3],
    /// The width of all lines in pixels; 0 draws none.
    pub line_width: f64,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            front: [255, 246, 226],
            back: [148, 172, 192],
            mountain: [205, 38, 30],
            valley: [24, 78, 168],
            border: [38, 38, 42],
            mark: [233, 30, 160],
            background: [255, 255, 255],
            line_width: 1.8,
        }
    }
}

impl Style {
    /// Refuses widths that cannot be drawn.
    pub(crate) fn check(&self) -> Result<(), RecordError> {
        if (0.0..=MAX_LINE_WIDTH).contains(&self.line_width) {
            return Ok(());
        }
        Err(RecordError::LineWidth { value: self.line_width, limit: MAX_LINE_WIDTH })
    }

    /// The colours in linear light.
    pub(crate) fn inks(&self) -> Inks {
        Inks {
            front: linear(self.front),
            back: linear(self.back),
            mountain: linear(self.mountain),
            valley: linear(self.valley),
            border: linear(self.border),
            mark: linear(self.mark),
            background: linear(self.background),
        }
    }
}

/// The paint of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Paint {
    /// Its sides of the paper.
    Paper,
    /// The colour of marks.
    Mark,
    /// A colour in linear light that shows a value.
    Value(Vec3),
}

/// The colours of a [`Style`] in linear light.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inks {
    pub(crate) front: Vec3,
    pub(crate) back: Vec3,
    pub(crate) mountain: Vec3,
    pub(crate) valley: Vec3,
    pub(crate) border: Vec3,
    pub(crate) mark: Vec3,
    pub(crate) background: Vec3,
}

impl Inks {
    /// The colour of a triangle with the unit front normal `normal` in the view.
    pub(crate) fn paper(&self, normal: DVec3) -> Vec3 {
        if normal.z >= 0.0 {
            self.front * reflected(normal)
        } else {
            self.back * reflected(-normal)
        }
    }

    /// The colour of a marked triangle, whichever side is seen.
    pub(crate) fn marked(&self, normal: DVec3) -> Vec3 {
        let seen = if normal.z >= 0.0 { normal } else { -normal };
        self.mark * reflected(seen)
    }

    /// The colour of a triangle whose value has the colour `light`.
    pub(crate) fn valued(light: Vec3, normal: DVec3) -> Vec3 {
        let seen = if normal.z >= 0.0 { normal } else { -normal };
        light * (1.0 + VALUE_LIGHT * (reflected(seen) / reflected(DVec3::Z) - 1.0))
    }

    /// The colour of a line.
    pub(crate) fn line(&self, assignment: Assignment) -> Vec3 {
        match assignment {
            Assignment::Mountain => self.mountain,
            Assignment::Valley => self.valley,
            Assignment::Border | Assignment::Facet | Assignment::Free => self.border,
        }
    }
}

/// s, the part of its colour that a side with the unit normal `seen` reflects.
fn reflected(seen: DVec3) -> f32 {
    let wrapped = 0.5 + 0.5 * seen.dot(LIGHT.normalize());
    (AMBIENT + (1.0 - AMBIENT) * wrapped * wrapped) as f32
}

/// The least and the largest part that any side reflects.
pub(crate) fn reflected_range() -> [f32; 2] {
    // The seen side faces the viewer, so n·l ≥ −sqrt(1 − l_z²).
    let l = LIGHT.normalize();
    let darkest = DVec3::new(-l.x, -l.y, 0.0).normalize();
    [reflected(darkest), 1.0]
}

/// Linear light of an sRGB colour (IEC 61966-2-1).
pub(crate) fn linear(color: [u8; 3]) -> Vec3 {
    Vec3::from(color.map(|byte| decoded(f32::from(byte))))
}

/// The sRGB colour of linear light (IEC 61966-2-1), rounded.
pub(crate) fn encoded(light: Vec3) -> [u8; 3] {
    let encoding: &Encoding = &ENCODING;
    let [r, g, b] = light.to_array();
    [encoding.byte(r), encoding.byte(g), encoding.byte(b)]
}

/// Byte `value` of sRGB, also between two bytes, in linear light.
fn decoded(value: f32) -> f32 {
    let value = value / 255.0;
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// The inverse of [`decoded`], rounded, by looking it up.
struct Encoding {
    /// The byte of the least light in each of equal cells; bytes are farther apart than these.
    cells: Vec<u8>,
    /// The least light of the byte after each.
    limits: [f32; 256],
}

static ENCODING: LazyLock<Encoding> = LazyLock::new(Encoding::new);

impl Encoding {
    /// Cells from no light to 1.
    const CELLS: usize = 4096;

    fn new() -> Self {
        let mut limits = [f32::INFINITY; 256];
        for (byte, limit) in (0..255_u8).zip(&mut limits) {
            *limit = decoded(f32::from(byte) + 0.5);
        }
        let byte = |cell: usize| {
            let light = cell as f32 / Self::CELLS as f32;
            limits.partition_point(|&limit| limit <= light) as u8
        };
        Self { cells: (0..=Self::CELLS).map(byte).collect(), limits }
    }

    #[expect(clippy::cast_sign_loss, reason = "clamped to 0 to CELLS before")]
    fn byte(&self, light: f32) -> u8 {
        let cell = (light * Self::CELLS as f32).clamp(0.0, Self::CELLS as f32) as usize;
        let least = self.cells[cell];
        least + u8::from(light >= self.limits[usize::from(least)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_srgb_byte_survives_linear_light() {
        for value in 0..=255 {
            let color = [value, 255 - value, value / 2];
            assert_eq!(encoded(linear(color)), color);
        }
    }

    #[test]
    fn encoding_by_lookup_is_the_formula_rounded() {
        for i in -100..=20_100_i32 {
            let light = f64::from(i) / 20_000.0;
            let value = if light <= 0.003_130_8 {
                12.92 * light
            } else {
                1.055 * light.powf(1.0 / 2.4) - 0.055
            };
            let byte = (value * 255.0).clamp(0.0, 255.0);
            let found = encoded(Vec3::splat(light as f32))[0];
            assert!((byte - f64::from(found)).abs() < 0.5 + 1e-4, "{light}: {found}");
        }
    }

    #[test]
    fn every_seen_side_reflects_within_the_stated_range() {
        let [least, most] = reflected_range();
        for i in 0..64_i32 {
            for j in 0..=16_i32 {
                let (turn, rise) = (f64::from(i) * 0.1, f64::from(j) / 16.0);
                let across = (1.0 - rise * rise).sqrt();
                let s = reflected(DVec3::new(across * turn.cos(), across * turn.sin(), rise));
                assert!((least - 1e-6..=most).contains(&s), "{s}");
            }
        }
        assert!((reflected(LIGHT.normalize()) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn values_seen_square_on_have_the_colour_of_the_legend_and_slants_differ_a_little() {
        let colour = linear([124, 123, 120]);
        assert_eq!(Inks::valued(colour, DVec3::Z), colour);
        assert_eq!(Inks::valued(colour, DVec3::NEG_Z), colour);
        let toward = Inks::valued(colour, LIGHT.normalize()) / colour;
        let away = Inks::valued(colour, DVec3::new(0.9, -0.4, 0.1).normalize()) / colour;
        assert!(toward.x > 1.1 && toward.x < 1.3 && away.x < 0.9 && away.x > 0.65);
    }

    #[test]
    fn both_sides_are_lit_alike_but_coloured_apart() {
        let inks = Style::default().inks();
        let (front, back) = (inks.paper(DVec3::Z), inks.paper(DVec3::NEG_Z));
        assert!((front / inks.front - back / inks.back).length() < 1e-6);
        assert!((front - back).length() > 0.2);
    }
}
