//! Crease patterns on paper, read back from the files.

#![expect(clippy::unwrap_used, reason = "a test stops where something is missing")]

mod files;
mod read;
mod tiles;
