//! The folder of results: written beside its place, then renamed into it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::StudyError;

pub use self::abandoned::process_may_exist;
pub use self::destination::Destination;
pub(crate) use self::manifest::{Command, ManifestEntry};
pub(crate) use self::names::{CERTIFICATE, FRAMES, MOTION, REPORT, is_of_a_run, is_picture};
pub use self::published::Published;
pub use self::published::list_names;
pub(crate) use self::space::{Space, size_words};

use self::manifest::{LIST, Manifest, are_same};

mod abandoned;
mod destination;
mod manifest;
mod names;
mod published;
mod space;

/// The temporary folders of this process. Held while files are moved into place.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    // A poisoned lock only means that another thread panicked; the list is whole.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Gives up all results under way, for a process that ends now: those being moved into place get there, all others are
/// removed. Whatever would be published later waits for ever.
pub fn discard_unfinished_results() {
    let folders = unfinished();
    for folder in folders.iter() {
        // What cannot be removed is a hidden folder that says what it is.
        let _ = fs::remove_dir_all(folder);
    }
    std::mem::forget(folders);
}

/// Results under way, in a temporary folder beside the output folder; removed unless published.
#[derive(Debug)]
pub(crate) struct Results {
    folder: PathBuf,
    temporary: PathBuf,
    /// Says that this process works in the temporary folder.
    lock: Option<File>,
    command: Command,
    /// Whether files of others are replaced.
    replaces_all: bool,
    /// What was made in the folder before.
    manifest: Manifest,
    /// The one that speaks of the others, if there is one, moved into place last.
    last: Option<&'static str>,
    written: Vec<String>,
    /// How many of those written were held against what stands in the folder.
    cleared: usize,
}

impl Results {
    /// Opens the temporary folder of results of `command`, of which `last` speaks of the others. What killed processes left
    /// beside it is removed.
    pub(crate) fn open(
        destination: Destination<'_>,
        command: Command,
        last: Option<&'static str>,
    ) -> Result<Self, StudyError> {
        let folder = destination.folder();
        if folder.exists() && !folder.is_dir() {
            let source = io::Error::new(io::ErrorKind::NotADirectory, "it is a file");
            return Err(output_error(
                folder,
                "cannot be used as output folder",
                source,
            ));
        }
        let parent = match folder.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        fs::create_dir_all(parent).map_err(|e| output_error(parent, "cannot be made", e))?;
        let name = folder
            .file_name()
            .unwrap_or_else(|| "out".as_ref())
            .to_string_lossy();
        abandoned::remove(parent, &name);
        let temporary = abandoned::folder_of(parent, &name);
        fs::create_dir_all(&temporary)
            .map_err(|e| output_error(&temporary, "cannot be made", e))?;
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

    /// Bytes free where the results go.
    pub(crate) fn available(&self) -> Result<u64, StudyError> {
        fs4::available_space(&self.temporary)
            .map_err(|e| output_error(&self.temporary, "cannot be measured", e))
    }

    /// Refuses what the disk cannot hold.
    pub(crate) fn require(&self, space: &Space) -> Result<(), StudyError> {
        let available = self.available()?;
        if space.total() <= available {
            return Ok(());
        }
        Err(StudyError::DiskTooSmall {
            path: self.folder.clone(),
            needed: size_words(space.total()),
            parts: space.words(),
            available: size_words(available),
            remedy: space.remedy(),
        })
    }

    /// Refuses, before anything is computed, files in the folder that `is_planned` says will be written and that are not
    /// to be replaced.
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

    /// Gives up what was written under the names of files that are not to be replaced; answers their names.
    pub(crate) fn skip_conflicts(&mut self) -> Vec<String> {
        let (folder, temporary) = (&self.folder, &self.temporary);
        let is_in_the_way = |name: &String| {
            let standing = folder.join(name);
            standing.exists()
                && !are_same(&standing, &temporary.join(name))
                && !self.may_replace(name)
        };
        let new = self.written[self.cleared..].iter();
        let skipped: Vec<String> = new.filter(|name| is_in_the_way(name)).cloned().collect();
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

    /// Makes a folder among the results and answers where files go; [`Self::add`] then names them.
    pub(crate) fn create_subfolder(&self, name: &str) -> Result<PathBuf, StudyError> {
        let path = self.temporary.join(name);
        fs::create_dir_all(&path).map_err(|e| write_error(&self.folder, name, e))?;
        Ok(path)
    }

    /// Takes up files that were written into a subfolder.
    pub(crate) fn add(&mut self, names: Vec<String>) {
        self.written.extend(names);
    }

    /// Where the files are until they are published.
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

    /// Writes `bytes` as one file.
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

    /// Renames every file, which shows what has the SHA-256 `of`, into the output folder, the one that speaks of the others
    /// last. Of what this command made before, `is_stale` picks what is removed; all else stays. The names of files of
    /// others that stayed under the name of one of these come back.
    pub(crate) fn publish(
        mut self,
        of: Option<&str>,
        is_stale: &dyn Fn(&ManifestEntry) -> bool,
    ) -> Result<Published, StudyError> {
        let skipped = self.skip_conflicts();
        let folder = self.folder.clone();
        let stale = self.stale(is_stale);
        let (before, after) = self.lists(of, &stale);
        // Whoever gives up waits until all files are in place.
        let _moving = unfinished();
        fs::create_dir_all(&folder).map_err(|e| output_error(&folder, "cannot be made", e))?;
        self.write_list(&before)?;
        // From here on a report in the folder would speak of other files than those beside it.
        let last = self.last.filter(|&last| self.has(last));
        for name in last.into_iter().chain(stale.iter().map(String::as_str)) {
            match fs::remove_file(folder.join(name)) {
                Err(e) if e.kind() != io::ErrorKind::NotFound => {
                    return Err(output_error(&folder.join(name), "cannot be replaced", e));
                }
                _ => {}
            }
        }
        let frames = folder.join(FRAMES);
        if self.written.iter().any(|name| is_picture(name)) {
            fs::create_dir_all(&frames).map_err(|e| output_error(&frames, "cannot be made", e))?;
        } else if stale.iter().any(|name| is_picture(name)) {
            // Where other files lie in it, it stays.
            let _ = fs::remove_dir(&frames);
        }
        let (report, others): (Vec<&String>, Vec<&String>) = self
            .written
            .iter()
            .partition(|&n| Some(n.as_str()) == self.last);
        for name in others.into_iter().chain(report) {
            let to = folder.join(name);
            fs::rename(self.temporary.join(name), &to)
                .map_err(|e| output_error(&to, "cannot be moved into place", e))?;
        }
        self.write_list(&after)?;
        let mut others = names_of(&folder)?;
        others.retain(|name| is_of_a_run(name) && !after.has(self.command, name));
        others.retain(|name| !skipped.contains(name));
        Ok(Published {
            skipped,
            removed: stale,
            others,
        })
    }

    fn has(&self, name: &str) -> bool {
        self.written.iter().any(|written| written == name)
    }

    /// Files that this command made before, that `is_stale` picks, that these do not replace and nobody has changed.
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

    /// A list of the files about to be moved beside those in their places, so that whatever ends this process, the next
    /// one knows both; and one of what will be there.
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
            // Made again by another command with the same bytes, a file is of both.
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
            .map_err(|e| write_error(&self.folder, LIST, e))
    }
}

/// Whether a name of the list stays in the folder: what a list says must not reach elsewhere.
fn is_inside(name: &str) -> bool {
    let file = name.strip_prefix("frames/").unwrap_or(name);
    !file.contains(['/', '\\']) && !matches!(file, "" | "." | "..")
}

/// The names of files in `folder` and its folder of pictures; none where there is no folder.
pub(crate) fn names_of(folder: &Path) -> Result<Vec<String>, StudyError> {
    let mut names = Vec::new();
    if folder.is_dir() {
        names.extend(names_in(folder, "")?);
    }
    if folder.join(FRAMES).is_dir() {
        names.extend(names_in(&folder.join(FRAMES), "frames/")?);
    }
    names.retain(|name| name != LIST);
    names.sort_unstable();
    Ok(names)
}

/// The names in `folder`, each after `prefix`. A name that is no UTF-8 is none of ours.
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
        // What cannot be removed is a hidden folder that says what it is; nothing is lost.
        let _ = fs::remove_dir_all(&self.temporary);
    }
}

/// An error about writing the result `name` of `folder`.
pub(crate) fn write_error(folder: &Path, name: &str, source: io::Error) -> StudyError {
    output_error(&folder.join(name), "cannot be written", source)
}

pub(crate) fn output_error(path: &Path, action: &'static str, source: io::Error) -> StudyError {
    StudyError::Output {
        path: path.to_owned(),
        action,
        source,
    }
}

#[cfg(test)]
mod tests;
