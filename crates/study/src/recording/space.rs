//! How much room the files of a recording take on a disk, estimated before it begins.

use foldmotion_pattern::{Motion, Sheet};
use foldmotion_record::{FilmOptions, MAX_TARGETS};

use super::film_sample::FilmSizes;
use super::planned::pictures;
use crate::Recording;
use crate::resolve::recording::STATES;
use crate::results::Space;
use crate::scene::OutputChoice;

/// Bytes of a figure beside its facets: letters, keys and what it says of its source_info.
const PAGE: u64 = 200_000;

/// Bytes a facet takes in a figure at most on average.
const BYTES_A_FACET: u64 = 400;

/// Bytes of a vertex and of a triangle in an OBJ file.
const OBJ: [u64; 2] = [70, 24];

/// Bytes of a page beside what moves: the library, scripts and tables.
const LIBRARY: u64 = 1_000_000;

/// Bytes of a triangle in an STL file, and before the first one.
const STL: u64 = 50;
const STL_HEADER: u64 = 84;

/// Bytes by which a file says where it comes from.
const ORIGIN: u64 = 4_000;

/// Bytes by which a GLB describes a morph target.
const TARGET: u64 = 3000;

impl Recording {
    /// Bytes of everything but `motion.fold`, for a motion of `frames` frames: at most, or about, where `films` are known.
    pub(crate) fn space(&self, sheet: &Sheet, frames: usize, films: Option<FilmSizes>) -> Space {
        let states = self.at.as_ref().map_or(STATES.len(), Vec::len) as u64;
        let faces = sheet.faces.len() as u64;
        // A plate has two sides and walls.
        let plates = if self.thickness.is_some() { 8 } else { 1 };
        let film = |known: fn(FilmSizes) -> u64, pixels_a_byte| match films {
            Some(films) => known(films),
            None => pixels(&self.film) / pixels_a_byte,
        };
        let size = |output: &OutputChoice| match output {
            OutputChoice::Fold => 0,
            OutputChoice::Csv => 200 * frames as u64 + PAGE,
            OutputChoice::Gif => film(|films| films.gif, 8),
            OutputChoice::Mp4 => film(|films| films.mp4, 16),
            OutputChoice::Png => film(|films| films.png, 2),
            OutputChoice::Svg => PAGE + BYTES_A_FACET * faces * states,
            OutputChoice::Pdf => PAGE + BYTES_A_FACET * faces * states / 2,
            OutputChoice::Glb => {
                let keys = frames.min(MAX_TARGETS) as u64 + 1;
                let corners = 9 * faces + 2 * sheet.edges.len() as u64;
                keys * (12 * corners + TARGET) + PAGE
            }
            OutputChoice::Obj => {
                let vertices = OBJ[0] * sheet.vertices.len() as u64;
                states * (ORIGIN + plates * (vertices + OBJ[1] * faces))
            }
            OutputChoice::Stl => states * (STL_HEADER + plates * STL * faces),
            OutputChoice::Html => {
                // The motion file inside is packed to a third and written in base 64.
                Motion::fold_file_size(sheet, frames) / 2 + LIBRARY + 24 * faces * frames as u64
            }
        };
        let mut space = Space::default();
        for output in &self.outputs {
            space.add(*output, size(output));
        }
        space
    }

    /// Whether films are among the outputs.
    pub(crate) fn has_films(&self) -> bool {
        [OutputChoice::Gif, OutputChoice::Mp4, OutputChoice::Png].map(|o| self.has(o)) != [false; 3]
    }
}

/// Pixels of all pictures of a film of the whole motion.
fn pixels(film: &FilmOptions) -> u64 {
    let [width, height] = film.size.map(u64::from);
    pictures(film) * width * height
}
