//! The paint of each triangle as the shader reads it: its kind in the highest byte, its sRGB colour in the others.

use foldmotion_pattern::Sheet;
use foldmotion_record::{Layers, colour_of};

use super::picture::{Colours, Picture};

/// The colour of the front or back of the paper.
pub(super) const PAPER: u32 = 0;
/// A colour that represents a value and is not shaded.
pub(super) const VALUE: u32 = 1;
/// A tint of the paper.
pub(super) const TINT: u32 = 2;
/// The colour of marks.
pub(super) const MARK: u32 = 3;

/// Tints of units that can be told apart with colour blindness (after Okabe and Ito 2008, Color universal design) and
/// are light enough for lines on them.
const TINTS: [[u8; 3]; 5] =
    [[242, 207, 138], [158, 208, 238], [140, 211, 186], [240, 232, 150], [232, 184, 212]];

fn packed(kind: u32, [r, g, b]: [u8; 3]) -> u32 {
    kind << 24 | u32::from(b) << 16 | u32::from(g) << 8 | u32::from(r)
}

/// The kind and the colour of a paint.
pub(super) fn unpacked(paint: u32) -> (u32, [u8; 3]) {
    let [r, g, b, kind] = paint.to_le_bytes();
    (u32::from(kind), [r, g, b])
}

/// What the paints depend on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PaintKey {
    colours: (u8, [f64; 2], u64),
    flash: Vec<u32>,
}

impl PaintKey {
    pub(super) fn of(picture: &Picture<'_>) -> Self {
        let colours = match picture.colours {
            Colours::Plain => (0, [0.0; 2], 0),
            Colours::Values { range, key, .. } => (1, range, key),
            Colours::Units => (2, [0.0; 2], 0),
            Colours::Layers => (3, [0.0; 2], 0),
        };
        Self { colours, flash: picture.flash.to_vec() }
    }
}

/// The paint of each triangle of `picture`.
pub(super) fn paints(picture: &Picture<'_>) -> Vec<u32> {
    let sheet = picture.sheet;
    let mut paints = match picture.colours {
        Colours::Plain => vec![PAPER; sheet.faces.len()],
        Colours::Values { values, range, .. } => of_values(sheet, values, range),
        Colours::Units => of_units(sheet),
        Colours::Layers => of_layers(sheet, picture.layers),
    };
    for &face in picture.flash {
        if let Some(paint) = paints.get_mut(face as usize) {
            *paint = packed(MARK, [0; 3]);
        }
    }
    paints
}

fn of_values(sheet: &Sheet, values: &[f64], [low, high]: [f64; 2]) -> Vec<u32> {
    let paint = |face: usize| {
        let value = values.get(face).copied().unwrap_or(f64::NAN);
        let part = (value - low) / (high - low);
        if part.is_nan() { PAPER } else { packed(VALUE, colour_of(part)) }
    };
    (0..sheet.faces.len()).map(paint).collect()
}

fn of_units(sheet: &Sheet) -> Vec<u32> {
    let paint = |&facet: &u32| {
        let facet = &sheet.facets[facet as usize];
        // Units that touch, even at a corner, get different tints.
        let tint = (facet.row + 2 * facet.column) as usize % TINTS.len();
        packed(TINT, TINTS[tint])
    };
    sheet.face_facets.iter().map(paint).collect()
}

/// Colours from the lowest to the highest layer of all stacks; triangles outside stacks show paper.
fn of_layers(sheet: &Sheet, layers: Option<&Layers>) -> Vec<u32> {
    let layers = layers.filter(|layers| layers.heights.len() == sheet.faces.len());
    let Some(layers) = layers else {
        return vec![PAPER; sheet.faces.len()];
    };
    let top = layers.heights.iter().copied().max().unwrap_or(0).max(1);
    let paint = |(&height, before): (&i32, &[i32; 2])| {
        if *before == [0; 2] {
            return PAPER;
        }
        packed(TINT, colour_of(f64::from(height) / f64::from(top)))
    };
    layers.heights.iter().zip(&layers.before).map(paint).collect()
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;

    fn sheet() -> Sheet {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        UnitSheet::new(unit, 4, 3).unwrap().sheet
    }

    #[test]
    fn units_that_touch_have_tints_of_their_own() {
        let sheet = sheet();
        let paints = of_units(&sheet);
        let unit = |face: usize| {
            let facet = &sheet.facets[sheet.face_facets[face] as usize];
            [facet.row, facet.column]
        };
        for edge in &sheet.edges {
            if let [Some(f), Some(g)] = edge.faces.map(|face| face.map(|f| f as usize)) {
                assert_eq!(unit(f) == unit(g), paints[f] == paints[g]);
            }
        }
    }

    #[test]
    fn values_get_the_colours_of_films_and_not_a_number_shows_paper() {
        let sheet = sheet();
        let paints = of_values(&sheet, &[0.0, 2.0, f64::NAN], [0.0, 2.0]);
        let shown = [unpacked(paints[0]), unpacked(paints[1])];
        assert_eq!(shown, [(VALUE, colour_of(0.0)), (VALUE, colour_of(1.0))]);
        assert_eq!([paints[2], paints[3]], [PAPER; 2]);
        assert_eq!(paints.len(), sheet.faces.len());
    }
}
