//! The window: look at a fold, scrub it, edit its scene, run it, record it.
//!
//! [`view`] opens it and returns when it is closed; [`Viewer`] is the window itself, for whoever drives it without one.
//! A scene's text is what is edited (`document`); what becomes of it is worked out in the background (`work`) and shown
//! when it comes. egui draws all but the sheet (`view3d`, on wgpu). What is drawn here is for the eye: results are made by
//! `foldmotion-study`, from the window as from the command line.

mod design;
mod document;
mod error;
mod launch;
mod results;
mod settings;
mod timeline;
mod timings;
mod view3d;
mod window;
mod work;

pub use error::ViewerError;
pub use launch::{ViewOptions, view};
pub use window::Viewer;
