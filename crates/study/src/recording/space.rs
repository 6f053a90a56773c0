//! The sizes of the files of a recording, estimated before it begins.

use foldmotion_pattern::{Motion, Sheet};
use foldmotion_record::{FilmOptions, MAX_TARGETS};

use super::film_sample::FilmSizes;
use super::planned::pictures;
use crate::Recording;
use crate::resolve::recording::STATES;
use crate::results::Space;
use crate::scene::OutputChoice;

/// Bytes of a figure without its facets: letters, key and source information.
const PAGE: u64 = 200_000;

/// The largest average number of bytes for a facet in a figure.
const BYTES_A_FACET: u64 = 400;

/// Bytes of a vertex and of a triangle in an OBJ file.
const OBJ: [u64; 2] = [70, 24];

/// Bytes of a page without the motion: library, scripts and tables.
const LIBRARY: u64 = 1_000_000;

/// Bytes of a triangle in an STL file, and of its header.
const STL: u64 = 50;
const STL_HEADER: u64 = 84;

/// Bytes of a VTP file without its arrays, and of a triangle in it: three corners, an end, a facet and two values as base64.
const VTK_FILE: u64 = 1500;
const VTK_FACE: u64 = 72;

/// Bytes of the source information in a file.
const ORIGIN: u64 = 4_000;

/// Bytes of the description of a morph target in a GLB file.
const TARGET: u64 = 3000;

impl Recording {
    /// The bytes of all files except `motion.fold`, for a motion of `frames` frames: an upper bound, or an estimate if `films`
    /// are given.
    pub(crate) fn space(&self, sheet: &Sheet, frames: usize, films: Option<FilmSizes>) -> Space {
        let states = self.at.as_ref().map_or(STATES.len(), Vec::len) as u64;
        let faces = sheet.faces.len() as u64;
        // A solid facet has two sides and walls.
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
            OutputChoice::Vtk => {
                frames as u64 * (VTK_FILE + 32 * sheet.vertices.len() as u64 + VTK_FACE * faces)
            }
            OutputChoice::Html => {
                // The motion file inside is compressed to a third and encoded in base 64.
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

/// The number of pixels of all pictures of a film.
fn pixels(film: &FilmOptions) -> u64 {
    let [width, height] = film.size.map(u64::from);
    pictures(film) * width * height
}
