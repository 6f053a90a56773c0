//! Motions as FOLD files: read, refused, written.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod read;
mod write;
