//! Where results go.

use std::path::Path;

/// Where results go.
#[derive(Debug, Clone, Copy)]
pub struct Destination<'a> {
    folder: &'a Path,
    replaces_all: bool,
}

impl<'a, P: AsRef<Path> + ?Sized> From<&'a P> for Destination<'a> {
    /// A folder in which only what foldmotion made is replaced.
    fn from(folder: &'a P) -> Self {
        Self {
            folder: folder.as_ref(),
            replaces_all: false,
        }
    }
}

impl<'a> Destination<'a> {
    /// The folder.
    pub fn folder(self) -> &'a Path {
        self.folder
    }

    /// Whether files of others are replaced too.
    pub fn replaces_all(self) -> bool {
        self.replaces_all
    }

    /// The same, but files of others that stand in the way are replaced too.
    #[must_use]
    pub fn replacing(self, replaces_all: bool) -> Self {
        Self {
            replaces_all,
            ..self
        }
    }
}
