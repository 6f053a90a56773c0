//! Crease patterns read from SVG and FOLD.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test stops where something is missing")]

mod as_drawn;
mod bad_fold;
mod bad_svg;
mod crane;
mod draw;
mod flat_crane;
mod fold;
mod folded;
mod formats;
mod frames;
mod geometry;
mod mending;
mod patterns;
mod round_trip;
mod svg;
