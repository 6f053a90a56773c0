//! The options the window is started with.

use std::path::PathBuf;

/// Options of the window.
#[derive(Debug, Clone, Default)]
pub struct ViewOptions {
    /// The scene, crease pattern or motion file to open.
    pub file: Option<PathBuf>,
    /// Whether to print timings and memory use to stderr when the window is closed.
    pub timings: bool,
    /// The folder in which unsaved scenes are kept. Default: the program's data folder on this system.
    pub unsaved: Option<PathBuf>,
}
