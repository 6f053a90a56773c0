//! What is recorded of a motion, read back: pictures, films, figures, models and pages.

#![expect(clippy::unwrap_used, reason = "what cannot be made or read must fail its test")]

mod common;
mod figures;
mod film_writers;
mod films;
mod models;
#[cfg(feature = "mp4")]
mod mp4;
mod pages;
mod pictures;
mod visible;
