//! How much room the files of a recording take on a disk, estimated before it begins.

use foldmotion_pattern::{Motion, Sheet};
use foldmotion_record::{FilmOptions, MAX_TARGETS};

use super::film_sample::FilmSizes;
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

/// Bytes of a triangle in an STL file, and before the first one.
const STL: u64 = 50;
const STL_HEADER: u64 = 84;

/// Bytes by which a file says where it comes from.
const ORIGIN: u64 = 4_000;

/// Bytes by which a GLB describes a morph target.
const TARGET: u64 = 3000;

/// Bytes of the files of a recording, by output.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Space(Vec<(OutputChoice, u64)>);

impl Space {
    /// Of all.
    pub(crate) fn total(&self) -> u64 {
        self.0.iter().map(|(_, bytes)| bytes).sum()
    }

    /// Adds `bytes` to those of an output.
    pub(crate) fn add(&mut self, output: OutputChoice, bytes: u64) {
        let mut known = self.0.iter_mut();
        match known.find(|(known, _)| *known == output) {
            Some((_, sum)) => *sum += bytes,
            None => self.0.push((output, bytes)),
        }
    }

    /// The outputs with their bytes.
    #[cfg(test)]
    pub(super) fn each(&self) -> impl Iterator<Item = (OutputChoice, u64)> {
        self.0.iter().copied()
    }

    /// What makes the files smaller: the largest output smaller or left out.
    pub(crate) fn remedy(&self) -> String {
        let Some((output, _)) = self.0.iter().max_by_key(|(_, bytes)| *bytes) else {
            return "free space".to_owned();
        };
        let name = output.name();
        let mut remedy = format!("leave {name} out of record.outputs");
        if [OutputChoice::Gif, OutputChoice::Mp4, OutputChoice::Png].contains(output) {
            remedy += ", or make record.size, record.fps or record.seconds smaller";
        }
        remedy
    }

    /// In words: outputs with their sizes, the largest first.
    pub(crate) fn words(&self) -> String {
        let mut sizes = self.0.clone();
        sizes.sort_by_key(|&(output, bytes)| (std::cmp::Reverse(bytes), output));
        let words = sizes
            .iter()
            .map(|&(output, bytes)| format!("{} {}", output.name(), size_words(bytes)));
        words.collect::<Vec<_>>().join(", ")
    }
}

/// A number of bytes for people.
pub(crate) fn size_words(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} bytes"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

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
