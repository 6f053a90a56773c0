//! The window: look at a fold, scrub it, edit its scene, run it, record it.

mod design;
mod document;
mod settings;
mod timeline;
mod view3d;
mod work;
