//! `foldmotion init`: a commented scene to start from.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write as _};
use std::path::Path;

use foldmotion_study::FIRST_SCENE;

use crate::{BAD_INPUT, FAILED, Failure};

/// Writes the scene; an existing file is kept.
pub(crate) fn write_scene(path: &Path) -> Result<(), Failure> {
    let failure = |message: String, status| Failure { message, status };
    let mut file =
        OpenOptions::new().write(true).create_new(true).open(path).map_err(|e| match e.kind() {
            ErrorKind::AlreadyExists => failure(
                format!("{}: already exists; choose another file", path.display()),
                BAD_INPUT,
            ),
            _ => failure(format!("{}: cannot be written: {e}", path.display()), FAILED),
        })?;
    file.write_all(FIRST_SCENE.as_bytes())
        .map_err(|e| failure(format!("{}: cannot be written: {e}", path.display()), FAILED))?;
    super::print(&format!("wrote {0}; next: foldmotion run {0}\n", path.display()))
}
