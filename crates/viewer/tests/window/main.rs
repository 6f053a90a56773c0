//! Tests of the whole window without a screen: mouse and keyboard input, and what is shown after it.

#![expect(clippy::unwrap_used, reason = "a test stops where something is missing")]

mod commands;
mod driver;
mod edits;
mod files;
mod interaction;
mod looks;
mod openings;
mod pictures;
mod records;
mod runs;
mod storage;
mod system;
mod timeline;
mod unsaved;
