//! The output folder of a command.

use std::path::Path;

/// The output folder of a command, and whether files of the user may be replaced.
#[derive(Debug, Clone, Copy)]
pub struct Destination<'a> {
    folder: &'a Path,
    replaces_all: bool,
}

impl<'a, P: AsRef<Path> + ?Sized> From<&'a P> for Destination<'a> {
    /// A folder in which only files that foldmotion made are replaced.
    fn from(folder: &'a P) -> Self {
        Self { folder: folder.as_ref(), replaces_all: false }
    }
}

impl<'a> Destination<'a> {
    /// The folder.
    pub fn folder(self) -> &'a Path {
        self.folder
    }

    /// Whether files that foldmotion did not make may be replaced.
    pub fn replaces_all(self) -> bool {
        self.replaces_all
    }

    /// This folder with `replaces_all`: whether files that foldmotion did not make may be replaced.
    #[must_use]
    pub fn replacing(self, replaces_all: bool) -> Self {
        Self { replaces_all, ..self }
    }
}
