//! The window: view a folding motion, scrub through it, edit its scene, run it and record it.
//!
//! [`view`] opens the window and returns when it is closed; [`Viewer`] is the window itself, for tests that drive it without
//! a display. The user edits the text of a scene (`document`). Everything that follows from the text is computed in the
//! background (`work`) and shown when it is ready. egui draws everything except the sheet, which `view3d` draws with wgpu.
//! The window only displays results: `foldmotion-study` computes and writes them, as it does for the command line.

mod design;
mod document;
mod error;
mod launch;
mod options;
mod results;
mod settings;
mod timeline;
mod timings;
mod view3d;
mod window;
mod work;

pub use error::ViewerError;
pub use launch::view;
pub use options::ViewOptions;
pub use window::Viewer;
