//! The whole window, driven without a screen: what is asked of it by mouse and keys, and what it shows then.

#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

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
