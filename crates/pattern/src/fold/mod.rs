//! FOLD 1.0 to 1.2: one reader, one writer.
//!
//! Source: Demaine, Ku, Lang, "A New File Standard to Represent Folded Structures" (FOLD specification 1.2).
//!
//! A FOLD file is a JSON object: the keys of the key frame (vertices, edges, faces) and `file_frames`, whose elements
//! inherit from the key frame or from each other.
//!
//! - Reading: [`read_frames`] streams the text and passes each frame on as [`FrameFields`], so that a file of any length
//!   needs the memory of one frame. [`FoldFile`] reads a motion from it, in two passes: the sheet first (`topology`,
//!   `triangulate`), then the positions of frame after frame (`inheritance`). `import::fold` reads a crease pattern from
//!   the same frames and says what its edges mean.
//! - Writing: [`CreasePattern`] makes the keys of a sheet, [`object_text`] puts keys into a file. `motion` writes a
//!   motion frame by frame, `cut::fold` a pattern in millimetres, `import::write_fold` an imported pattern.
//!
//! Keys with the prefix `foldmotion:` relate triangles to facets and frames to motion times.

mod error;
mod file;
mod frames;
mod inheritance;
mod motion;
mod topology;
mod triangulate;
mod utf8;
mod writer;

pub use error::{FoldError, FrameNumber};
pub use file::FoldFile;
pub(crate) use frames::{FrameFields, FrameVisitor, Selection, check_vertices, read_frames};
pub use motion::FoldHeader;
pub(crate) use writer::{CreasePattern, object_text};
