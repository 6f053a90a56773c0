//! Scene files, which are written completely or not at all, and relative paths of the files that a scene names.

use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Component, Path, PathBuf};

use foldmotion_study::{Scene, SceneSource, StudyError};
use thiserror::Error;

/// Why a scene could not be saved.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum SaveError {
    /// The scene has no file yet.
    #[error("the scene has no file yet; choose one")]
    NoFile,
    /// The file has changed since it was last read or written.
    #[error("{}: another program has changed the file; overwrite or reload it", path.display())]
    Changed { path: PathBuf },
    /// Saving would overwrite a crease pattern.
    #[error("{}: this is the file name of a crease pattern; save the scene under a name that ends in .toml", path.display())]
    Ending { path: PathBuf },
    /// The file cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write { path: PathBuf, source: io::Error },
}

/// The largest size of a scene file, bytes.
const MAX_BYTES: u64 = 16 << 20;

/// Checks that the path is a regular file, not too large for a scene, and readable.
pub(super) fn check_readable(path: &Path) -> Result<(), StudyError> {
    let checked = std::fs::metadata(path).and_then(|metadata| {
        if !metadata.is_file() {
            return Err(io::Error::other("not a regular file"));
        }
        if metadata.len() > MAX_BYTES && !SceneSource::is_pattern(path) {
            let size = metadata.len();
            let message = format!("{size} bytes are too many for a scene (at most {MAX_BYTES})");
            return Err(io::Error::other(message));
        }
        File::open(path).map(drop)
    });
    checked.map_err(|source| StudyError::Read { path: path.to_owned(), source })
}

/// Writes a temporary file beside `path` and renames it: after a crash there is either the old file or the new one.
///
/// Symbolic links and permissions are kept. A `durable` write also survives a power failure, but has to wait for the
/// disk.
pub(crate) fn write_whole(path: &Path, text: &str, durable: bool) -> io::Result<()> {
    let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let permissions = std::fs::metadata(&target).map(|m| m.permissions()).ok();
    if permissions.as_ref().is_some_and(Permissions::readonly) {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "the file is read-only"));
    }
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let beside = target.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let written = || -> io::Result<()> {
        let mut file = OpenOptions::new().write(true).create(true).truncate(true).open(&beside)?;
        file.write_all(text.as_bytes())?;
        if let Some(permissions) = permissions {
            file.set_permissions(permissions)?;
        }
        if durable {
            file.sync_all()?;
        }
        std::fs::rename(&beside, &target)
    };
    written().inspect_err(|_| {
        // The incomplete file is of no use, and the first error is the one to report.
        let _ = std::fs::remove_file(&beside);
    })
}

/// The scene with the relative paths in it, which refer to folder `old`, rewritten to refer to `new`.
pub(super) fn moved(scene: &Scene, old: &Path, new: &Path) -> Scene {
    let mut moved = scene.clone();
    if real_path(old) == real_path(new) {
        return moved;
    }
    let profile = moved.profile.file.as_mut();
    let pattern = moved.pattern.as_mut().map(|pattern| &mut pattern.file);
    for file in profile.into_iter().chain(pattern) {
        if !file.is_empty() && Path::new(file.as_str()).is_relative() {
            *file = relative_to(new, &old.join(file.as_str()));
        }
    }
    moved
}

/// The path under which a scene in `folder` names a file: relative, or absolute if they share no folder.
pub(super) fn relative_to(folder: &Path, file: &Path) -> String {
    let folder = real_path(folder);
    // A symbolic link keeps its own name.
    let file = match file.file_name() {
        Some(name) => real_path(&folder_of(file)).join(name),
        None => real_path(file),
    };
    let pairs = folder.components().zip(file.components());
    let shared = pairs.take_while(|(a, b)| a == b);
    let named = |c: &Component<'_>| matches!(c, Component::Normal(_));
    let common: Vec<Component<'_>> = shared.map(|(a, _)| a).collect();
    if !common.iter().any(named) {
        return file.to_string_lossy().into_owned();
    }
    let up = folder.components().skip(common.len()).map(|_| "..".into());
    let down = file.components().skip(common.len());
    let down = down.map(|c| c.as_os_str().to_string_lossy().into_owned());
    let way: Vec<String> = up.chain(down).collect();
    way.join("/")
}

/// The absolute path, with symbolic links resolved as far as it exists.
fn real_path(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    if let Ok(real) = whole.canonicalize() {
        return real;
    }
    match (whole.parent(), whole.components().next_back()) {
        (Some(parent), Some(Component::ParentDir)) => {
            let parent = real_path(parent);
            parent.parent().unwrap_or(&parent).to_owned()
        }
        (Some(parent), Some(last)) => real_path(parent).join(last),
        _ => whole,
    }
}

/// The folder that contains a path.
pub(super) fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}
