//! How much room the files of a recording take on a disk, estimated before it begins.

use foldmotion_pattern::{Motion, Sheet};
use foldmotion_record::{FilmOptions, MAX_TARGETS};

use super::planned::pictures;
use super::{Recording, STATES};
use crate::scene::OutputChoice;

/// Bytes of a figure beside its facets: letters, keys and what it says of its origin.
const PAGE: u64 = 200_000;

/// Bytes a facet takes in a figure at most on average.
const BYTES_A_FACET: u64 = 400;

/// Bytes of a vertex and of a triangle in an OBJ file.
const OBJ: [u64; 2] = [70, 24];

/// Bytes of a page beside what moves: the library, scripts and tables.
const LIBRARY: u64 = 1_000_000;

/// Bytes of a triangle in an STL file.
const STL: u64 = 50;

impl Recording {
    /// Bytes of everything but `motion.fold` at most, for a motion of `frames` frames.
    pub(crate) fn space(&self, sheet: &Sheet, frames: usize) -> u64 {
        let states = self.at.as_ref().map_or(STATES.len(), Vec::len) as u64;
        let faces = sheet.faces.len() as u64;
        // A plate has two sides and walls.
        let plates = if self.thickness.is_some() { 8 } else { 1 };
        let size = |output: &OutputChoice| match output {
            OutputChoice::Fold => 0,
            OutputChoice::Csv => 200 * frames as u64 + PAGE,
            // An eighth of the pixels, where nothing repeats.
            OutputChoice::Gif => pixels(&self.film) / 8,
            OutputChoice::Mp4 => pixels(&self.film) / 16,
            OutputChoice::Png => pixels(&self.film) / 2,
            OutputChoice::Svg => PAGE + BYTES_A_FACET * faces * states,
            OutputChoice::Pdf => PAGE + BYTES_A_FACET * faces * states / 2,
            OutputChoice::Glb => {
                let keys = frames.min(MAX_TARGETS) as u64 + 1;
                12 * keys * (9 * faces + 2 * sheet.edges.len() as u64) + PAGE
            }
            OutputChoice::Obj => {
                let vertices = OBJ[0] * sheet.vertices.len() as u64;
                states * plates * (vertices + OBJ[1] * faces)
            }
            OutputChoice::Stl => states * plates * STL * faces,
            OutputChoice::Html => {
                // The motion file inside is packed to a third and written in base 64.
                Motion::fold_file_size(sheet, frames) / 2 + LIBRARY + 24 * faces * frames as u64
            }
        };
        self.outputs.iter().map(size).sum()
    }
}

/// Pixels of all pictures of a film of the whole motion.
fn pixels(film: &FilmOptions) -> u64 {
    let [width, height] = film.size.map(u64::from);
    pictures(film) * width * height
}
