//! The palette of a film: at most 255 colours and a transparent one.
//!
//! All that is ever drawn is known beforehand: two sides of paper under a range of light, three lines, a background,
//! and their mixtures in edge pixels. So the palette is built from the style, finely where areas lie and coarsely
//! where single pixels do; it is the same in every frame, and colours cannot flicker as they would if each film or
//! frame were analysed anew. Nothing is dithered, for the same reason.

use std::array::from_fn;
use std::sync::OnceLock;

use glam::Vec3;

use crate::caption::ink;
use crate::colour_map::colour_of;
use crate::shade::{Inks, encoded, linear, reflected_range};
use crate::{Image, Style};

/// Light levels of each side of the paper.
const LEVELS: u16 = 56;

/// Light levels of marked facets.
const MARK_LEVELS: u16 = 24;

/// Levels of light that lines and edges are mixed with.
const MIXING_LEVELS: u16 = 4;

/// Levels of values, and the parts of light that they take.
const MAP_LEVELS: u16 = 40;
const MAP_LIGHTS: [f32; 4] = [1.0, 0.87, 0.74, 1.2];

/// Leading bits of a byte that tell in which cell of the colour cube it lies.
const CELL_BITS: u32 = 6;

/// The other bits of a byte.
const CELL_MASK: u8 = u8::MAX >> CELL_BITS;

/// The colours of a film.
#[derive(Debug, Clone)]
pub struct Palette {
    colors: Vec<[u8; 3]>,
    /// For each cell of the colour cube the colours that may be the nearest to one in it, found on first use.
    cells: Vec<OnceLock<Vec<u8>>>,
}

impl Palette {
    /// The index that means "as before".
    pub const TRANSPARENT: u8 = 255;

    /// The palette of `style`, the background first; `has_marks`: with the colour of marked facets.
    pub fn new(style: &Style, has_marks: bool) -> Self {
        let inks = style.inks();
        let mut palette = Self::of_lines(&inks);
        for side in [inks.front, inks.back] {
            for light in levels(LEVELS) {
                palette.push(side * light);
            }
        }
        if has_marks {
            for light in levels(MARK_LEVELS) {
                palette.push(inks.mark * light);
            }
        }
        palette.push_mixtures(&inks);
        palette
    }

    /// The palette of a film that shows values as colours: those of the map lead, paper and marks have what is left.
    pub(crate) fn of_values(style: &Style) -> Self {
        let inks = style.inks();
        let mut palette = Self::of_lines(&inks);
        palette.push_color(ink(style.background));
        for light in MAP_LIGHTS {
            for k in 0..MAP_LEVELS {
                let part = f64::from(k) / f64::from(MAP_LEVELS - 1);
                palette.push(light * linear(colour_of(part)));
            }
        }
        for side in [inks.front, inks.back, inks.mark] {
            for light in levels(MIXING_LEVELS) {
                palette.push(side * light);
            }
        }
        for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let colour = linear(colour_of(part));
            for other in [inks.background, inks.mountain, inks.valley, inks.border] {
                palette.push_between(colour, other, 3);
            }
        }
        palette
    }

    /// The colours of the background and of the lines.
    fn of_lines(inks: &Inks) -> Self {
        let mut palette =
            Self { colors: Vec::new(), cells: vec![OnceLock::new(); 1 << (3 * CELL_BITS)] };
        for color in [inks.background, inks.mountain, inks.valley, inks.border] {
            palette.push(color);
        }
        palette
    }

    /// Edge pixels: lines over either side of the paper and over the background, paper beside paper and background.
    fn push_mixtures(&mut self, inks: &Inks) {
        for line in [inks.mountain, inks.valley, inks.border] {
            self.push_between(line, inks.background, 4);
            for side in [inks.front, inks.back] {
                for light in levels(MIXING_LEVELS) {
                    self.push_between(line, side * light, 4);
                }
            }
        }
        for light in levels(MIXING_LEVELS) {
            self.push_between(inks.front * light, inks.back * light, 3);
            self.push_between(inks.back * light, inks.background, 2);
        }
    }

    /// `count` colours between two, evenly spaced as sRGB, where the eye sees even steps.
    fn push_between(&mut self, from: Vec3, to: Vec3, count: u16) {
        let [from, to] = [from, to].map(|light| Vec3::from(encoded(light).map(f32::from)));
        for k in 1..=count {
            let color = from.lerp(to, f32::from(k) / f32::from(count + 1));
            self.push_color(color.round().as_u8vec3().to_array());
        }
    }

    fn push(&mut self, light: Vec3) {
        self.push_color(encoded(light));
    }

    /// Mixtures that find no room are left to their neighbours.
    fn push_color(&mut self, color: [u8; 3]) {
        if self.colors.len() < usize::from(Self::TRANSPARENT) && !self.colors.contains(&color) {
            self.colors.push(color);
        }
    }

    /// The colours, index by index.
    pub fn colors(&self) -> &[[u8; 3]] {
        &self.colors
    }

    /// The index of the nearest colour, ties by the lower index.
    ///
    /// Distances are squared differences of sRGB bytes weighted 2 : 4 : 3, a plain stand-in for what the eye sees.
    pub fn nearest(&self, color: [u8; 3]) -> u8 {
        let low = color.map(|byte| byte & !CELL_MASK);
        let append = |cell, byte: &u8| cell << CELL_BITS | usize::from(byte >> (8 - CELL_BITS));
        let cell = &self.cells[low.iter().fold(0, append)];
        let near = cell.get_or_init(|| self.near_cell(low)).iter();
        let nearest = near.min_by_key(|&&index| distance(color, self.colors[usize::from(index)]));
        nearest.copied().unwrap_or(0)
    }

    /// The colours that may be the nearest to one in the cell from `low` on: no farther from the nearest one in it than
    /// another colour is from the farthest.
    fn near_cell(&self, low: [u8; 3]) -> Vec<u8> {
        let high = low.map(|byte| byte | CELL_MASK);
        let least = |color: [u8; 3]| distance(color, from_fn(|i| color[i].clamp(low[i], high[i])));
        let most = |color: [u8; 3]| {
            let is_high = |i: usize| color[i].abs_diff(high[i]) > color[i].abs_diff(low[i]);
            distance(color, from_fn(|i| if is_high(i) { high[i] } else { low[i] }))
        };
        let limit = self.colors.iter().map(|&color| most(color)).min();
        // The colours lead, so that the index never counts past the last of a full palette.
        let colors = self.colors.iter().zip(0..);
        let near = colors.filter(|(color, _)| Some(least(**color)) <= limit);
        near.map(|(_, index)| index).collect()
    }

    /// The index of every pixel.
    pub fn indices(&self, image: &Image) -> Vec<u8> {
        let mut indices = Vec::with_capacity(image.pixels.len());
        for run in image.pixels.chunk_by(|a, b| a == b) {
            indices.resize(indices.len() + run.len(), self.nearest(run[0]));
        }
        indices
    }
}

/// The difference of two colours, see [`Palette::nearest`].
fn distance(a: [u8; 3], b: [u8; 3]) -> i32 {
    let difference = |i: usize| i32::from(a[i]) - i32::from(b[i]);
    let (r, g, b) = (difference(0), difference(1), difference(2));
    2 * r * r + 4 * g * g + 3 * b * b
}

/// `count` parts of light over the range that sides reflect, evenly spaced as the eye sees them.
fn levels(count: u16) -> impl Iterator<Item = f32> {
    let [low, high] = reflected_range().map(|s| s.powf(1.0 / 2.4));
    (0..count).map(move |k| (low + (high - low) * f32::from(k) / f32::from(count - 1)).powf(2.4))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn colors_of_the_palette_are_their_own_nearest_and_leave_room_for_transparency() {
        let palette = Palette::new(&Style::default(), false);
        assert!(palette.colors().len() > 200, "{}", palette.colors().len());
        assert!(palette.colors().len() <= usize::from(Palette::TRANSPARENT));
        for (index, &color) in palette.colors().iter().enumerate() {
            assert_eq!(usize::from(palette.nearest(color)), index);
        }
    }

    #[test]
    fn the_nearest_color_is_that_of_a_search_through_all() {
        let palette = Palette::new(&Style::default(), false);
        for k in 0..40_000_u32 {
            let color = [k * 7, k * 11 / 3, k * 13 / 5].map(|value| (value % 256) as u8);
            let colors = palette.colors().iter();
            let all = (0..).zip(colors).min_by_key(|(_, other)| distance(color, **other));
            assert_eq!(Some(palette.nearest(color)), all.map(|(index, _)| index));
        }
    }

    #[test]
    fn areas_of_paper_are_off_by_at_most_two_steps_of_255() {
        let style = Style::default();
        let (palette, inks) = (Palette::new(&style, false), style.inks());
        for i in 0..200_i32 {
            let turn = f64::from(i) * 0.7;
            let rise = f64::from(i) / 100.0 - 1.0;
            let across = (1.0 - rise * rise).sqrt();
            let normal = DVec3::new(across * turn.cos(), across * turn.sin(), rise);
            let color = encoded(inks.paper(normal));
            let found = palette.colors()[usize::from(palette.nearest(color))];
            for channel in 0..3 {
                let error = color[channel].abs_diff(found[channel]);
                assert!(error <= 2, "{color:?} is drawn as {found:?}");
            }
        }
    }
}
