//! The output folder: files are written into a temporary folder next to it and then moved into it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::StudyError;

pub use self::abandoned::process_may_exist;
pub use self::destination::Destination;
pub(crate) use self::manifest::{Command, ManifestEntry};
pub(crate) use self::names::{
    CERTIFICATE, FRAMES, MOTION, REPORT, SUBFOLDERS, VTK, is_of_a_run, is_picture, is_vtk_frame,
};
pub use self::published::Published;
pub use self::published::list_names;
pub(crate) use self::space::Space;
use self::space::size_words;

use self::manifest::{MANIFEST, Manifest, are_same};

mod abandoned;
mod destination;
mod manifest;
mod names;
mod published;
mod space;

/// The temporary folders of this process. The lock is held while files are moved into place.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    // A poisoned lock only means that another thread panicked; the list is intact.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Discards all unfinished results, for a process that is about to end. Results that are being moved into place are completed
/// first; later ones wait for ever.
pub fn discard_unfinished_results() {
    let folders = unfinished();
    for folder in folders.iter() {
        // A folder that cannot be removed is hidden and recognisable by its name.
        let _ = fs::remove_dir_all(folder);
    }
    std::mem::forget(folders);
}

/// Unfinished results in a temporary folder next to the output folder, which is removed unless they are published.
#[derive(Debug)]
pub(crate) struct Results {
    folder: PathBuf,
    temporary: PathBuf,
    /// The lock of this process in the temporary folder.
    lock: Option<File>,
    command: Command,
    /// Whether files that foldmotion did not make may be replaced.
    replaces_all: bool,
    /// The files that foldmotion made in the output folder before.
    manifest: Manifest,
    /// The file that describes the others, if there is one, which is moved into place last.
    last: Option<&'static str>,
    /// The names of the files written so far.
    written: Vec<String>,
    /// The number of these files that were already compared with the output folder.
    cleared: usize,
}

impl Results {
    /// Creates the temporary folder for the results of `command`. The file `last` describes the others. Temporary folders of
    /// killed processes are removed.
    pub(crate) fn open(
        destination: Destination<'_>,
        command: Command,
        last: Option<&'static str>,
    ) -> Result<Self, StudyError> {
        let folder = destination.folder();
        if folder.exists() && !folder.is_dir() {
            let source = io::Error::new(io::ErrorKind::NotADirectory, "it is a file, not a folder");
            return Err(output_error(folder, "cannot be used as output folder", source));
        }
        let parent = match folder.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        fs::create_dir_all(parent).map_err(|e| output_error(parent, "cannot be created", e))?;
        let name = folder.file_name().unwrap_or_else(|| "out".as_ref()).to_string_lossy();
        abandoned::remove(parent, &name);
        let temporary = abandoned::folder_of(parent, &name);
        fs::create_dir_all(&temporary)
            .map_err(|e| output_error(&temporary, "cannot be created", e))?;
        unfinished().push(temporary.clone());
        Ok(Self {
            folder: folder.to_owned(),
            lock: abandoned::lock(&temporary),
            temporary,
            command,
            replaces_all: destination.replaces_all(),
            manifest: Manifest::read(folder),
            last,
            written: Vec::new(),
            cleared: 0,
        })
    }

    /// The free space for the results, in bytes.
    pub(crate) fn available(&self) -> Result<u64, StudyError> {
        fs4::available_space(&self.temporary)
            .map_err(|e| output_error(&self.temporary, "cannot be measured", e))
    }

    /// Refuses results for which the disk has no space.
    pub(crate) fn require(&self, space: &Space) -> Result<(), StudyError> {
        let available = self.available()?;
        if space.total() <= available {
            return Ok(());
        }
        Err(self.too_small(space, available, space.remedy()))
    }

    /// The error of a disk with `available` free bytes, too few for `space`.
    pub(crate) fn too_small(&self, space: &Space, available: u64, remedy: String) -> StudyError {
        StudyError::DiskTooSmall {
            path: self.folder.clone(),
            needed: size_words(space.total()),
            parts: space.words(),
            available: size_words(available),
            remedy,
        }
    }

    /// Refuses, before anything is computed, an output folder with files that `is_planned` selects and that may not be replaced.
    pub(crate) fn require_clear(
        &self,
        is_planned: &dyn Fn(&str) -> bool,
    ) -> Result<(), StudyError> {
        let mut names = names_of(&self.folder)?;
        names.retain(|name| is_planned(name) && !self.may_replace(name));
        if names.is_empty() {
            return Ok(());
        }
        Err(StudyError::Conflict {
            path: self.folder.clone(),
            names: list_names(&names),
            command: self.command.name(),
        })
    }

    fn may_replace(&self, name: &str) -> bool {
        self.replaces_all || self.manifest.may_replace(self.command, &self.folder, name)
    }

    /// Discards written files that would replace files of the user; returns their names.
    pub(crate) fn skip_conflicts(&mut self) -> Vec<String> {
        let (folder, temporary) = (&self.folder, &self.temporary);
        let is_conflict = |name: &String| {
            let existing = folder.join(name);
            existing.exists()
                && !are_same(&existing, &temporary.join(name))
                && !self.may_replace(name)
        };
        let new = self.written[self.cleared..].iter();
        let skipped: Vec<String> = new.filter(|name| is_conflict(name)).cloned().collect();
        self.written.retain(|name| !skipped.contains(name));
        self.cleared = self.written.len();
        skipped
    }

    /// Opens one file of the results.
    pub(crate) fn create_file(&mut self, name: &str) -> Result<BufWriter<File>, StudyError> {
        let file = File::create(self.temporary.join(name));
        let file = file.map_err(|e| write_error(&self.folder, name, e))?;
        self.written.push(name.to_owned());
        Ok(BufWriter::new(file))
    }

    /// Creates a folder among the results and returns its path; [`Self::add`] takes the names of its files.
    pub(crate) fn create_subfolder(&self, name: &str) -> Result<PathBuf, StudyError> {
        let path = self.temporary.join(name);
        fs::create_dir_all(&path).map_err(|e| write_error(&self.folder, name, e))?;
        Ok(path)
    }

    /// Adds the names of files that were written into a subfolder.
    pub(crate) fn add(&mut self, names: Vec<String>) {
        self.written.extend(names);
    }

    /// The temporary folder.
    pub(crate) fn temporary(&self) -> &Path {
        &self.temporary
    }

    /// Writes one file through `write`.
    pub(crate) fn write(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut BufWriter<File>) -> Result<(), StudyError>,
    ) -> Result<(), StudyError> {
        let mut out = self.create_file(name)?;
        write(&mut out)?;
        out.flush().map_err(|e| write_error(&self.folder, name, e))
    }

    /// Writes one file with the content `bytes`.
    pub(crate) fn write_bytes(&mut self, name: &str, bytes: &[u8]) -> Result<(), StudyError> {
        let mut out = self.create_file(name)?;
        let written = out.write_all(bytes).and_then(|()| out.flush());
        written.map_err(|e| write_error(&self.folder, name, e))
    }

    /// The output folder.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// The names written so far.
    pub(crate) fn written(&self) -> &[String] {
        &self.written
    }

    /// Moves all files, which show the content with the SHA-256 `of`, into the output folder. Earlier files of this command that
    /// `is_stale` selects are removed; all other files are kept.
    pub(crate) fn publish(
        mut self,
        of: Option<&str>,
        is_stale: &dyn Fn(&ManifestEntry) -> bool,
    ) -> Result<Published, StudyError> {
        let skipped = self.skip_conflicts();
        let folder = self.folder.clone();
        let stale = self.stale(is_stale);
        let (before, after) = self.lists(of, &stale);
        // Discarding waits until all files are in place.
        let _moving = unfinished();
        fs::create_dir_all(&folder).map_err(|e| output_error(&folder, "cannot be created", e))?;
        self.write_list(&before)?;
        // From here on, an earlier report would not describe the files next to it.
        let last = self.last.filter(|&last| self.has(last));
        for name in last.into_iter().chain(stale.iter().map(String::as_str)) {
            match fs::remove_file(folder.join(name)) {
                Err(e) if e.kind() != io::ErrorKind::NotFound => {
                    return Err(output_error(&folder.join(name), "cannot be replaced", e));
                }
                _ => {}
            }
        }
        for subfolder in SUBFOLDERS {
            let path = folder.join(subfolder);
            let is_inside = |name: &String| Path::new(name).starts_with(subfolder);
            if self.written.iter().any(is_inside) {
                fs::create_dir_all(&path)
                    .map_err(|e| output_error(&path, "cannot be created", e))?;
            } else if stale.iter().any(is_inside) {
                // The folder is kept if it has other files.
                let _ = fs::remove_dir(&path);
            }
        }
        let (report, others): (Vec<&String>, Vec<&String>) =
            self.written.iter().partition(|&n| Some(n.as_str()) == self.last);
        for name in others.into_iter().chain(report) {
            let to = folder.join(name);
            fs::rename(self.temporary.join(name), &to)
                .map_err(|e| output_error(&to, "cannot be moved into place", e))?;
        }
        self.write_list(&after)?;
        let mut others = names_of(&folder)?;
        others.retain(|name| is_of_a_run(name) && !after.has(self.command, name));
        others.retain(|name| !skipped.contains(name));
        Ok(Published { skipped, removed: stale, others })
    }

    fn has(&self, name: &str) -> bool {
        self.written.iter().any(|written| written == name)
    }

    /// Unchanged earlier files of this command that `is_stale` selects and that are not written again.
    fn stale(&self, is_stale: &dyn Fn(&ManifestEntry) -> bool) -> Vec<String> {
        let stale = self.manifest.stale(self.command, is_stale);
        let mut names: Vec<String> = stale.map(|file| file.name.clone()).collect();
        let is_removed = |name: &String| {
            is_inside(name)
                && !self.has(name)
                && self.folder.join(name).exists()
                && self.manifest.may_replace(self.command, &self.folder, name)
        };
        names.retain(is_removed);
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Two manifests: one with both the new files and those they replace, so that the folder can be understood if the process is
    /// killed meanwhile, and one of the final files.
    fn lists(&self, of: Option<&str>, stale: &[String]) -> (Manifest, Manifest) {
        let new: Vec<ManifestEntry> = self
            .written
            .iter()
            .map(|name| ManifestEntry::new(self.command, &self.temporary, name, of))
            .collect();
        let (mut before, mut after) = (self.manifest.clone(), self.manifest.clone());
        before.extend(&new);
        let (folder, written) = (&self.folder, &self.written);
        let is_kept = |file: &ManifestEntry| {
            let is_written = written.contains(&file.name);
            // A file that two commands wrote with the same bytes belongs to both.
            let is_same = new.iter().any(|made| made.is_same_by_other(file));
            (!is_written || is_same)
                && !stale.contains(&file.name)
                && folder.join(&file.name).exists()
        };
        after.retain(is_kept);
        after.extend(&new);
        (before, after)
    }

    fn write_list(&self, list: &Manifest) -> Result<(), StudyError> {
        list.write(&self.folder, &self.temporary)
            .map_err(|e| write_error(&self.folder, MANIFEST, e))
    }
}

/// Whether a name of the manifest is inside the output folder: a manifest must not lead to other folders.
fn is_inside(name: &str) -> bool {
    let mut folders = SUBFOLDERS.iter();
    let file = folders.find_map(|folder| name.strip_prefix(folder)?.strip_prefix('/'));
    let file = file.unwrap_or(name);
    !file.contains(['/', '\\']) && !matches!(file, "" | "." | "..")
}

/// The names of the files in `folder` and its folders of results; empty if there is no such folder.
pub(crate) fn names_of(folder: &Path) -> Result<Vec<String>, StudyError> {
    let mut names = Vec::new();
    if folder.is_dir() {
        names.extend(names_in(folder, "")?);
    }
    for subfolder in SUBFOLDERS {
        if folder.join(subfolder).is_dir() {
            names.extend(names_in(&folder.join(subfolder), &format!("{subfolder}/"))?);
        }
    }
    names.retain(|name| name != MANIFEST);
    names.sort_unstable();
    Ok(names)
}

/// The names in `folder`, each with `prefix`. Names that are not UTF-8 are never those of results.
fn names_in(folder: &Path, prefix: &str) -> Result<Vec<String>, StudyError> {
    let unread = |e| output_error(folder, "cannot be read", e);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(unread)? {
        if let Ok(name) = entry.map_err(unread)?.file_name().into_string() {
            names.push(format!("{prefix}{name}"));
        }
    }
    Ok(names)
}

impl Drop for Results {
    fn drop(&mut self) {
        self.lock = None;
        unfinished().retain(|folder| *folder != self.temporary);
        // A folder that cannot be removed is hidden and recognisable by its name.
        let _ = fs::remove_dir_all(&self.temporary);
    }
}

/// The error of writing the file `name` of `folder`.
pub(crate) fn write_error(folder: &Path, name: &str, source: io::Error) -> StudyError {
    output_error(&folder.join(name), "cannot be written", source)
}

pub(crate) fn output_error(path: &Path, action: &'static str, source: io::Error) -> StudyError {
    StudyError::Output { path: path.to_owned(), action, source }
}

#[cfg(test)]
mod tests;
