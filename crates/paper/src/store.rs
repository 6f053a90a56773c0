//! The folder of the paper: finished parts are kept, and found again by what they were made from.
//!
//! `parts/NAME.json` holds what was found out in a part with a key: the SHA-256 of the program's version and the part's
//! inputs. A part of another key is made anew. Every file is written beside its place and renamed into it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::record::PaperRecord;
use crate::PaperError;

use foldmotion_study::VERSION;
use foldmotion_study::sha256;
use foldmotion_study::{StudyError, list_names, process_may_exist};

/// The record and the page.
pub(super) const RECORD: &str = "paper.json";
pub(super) const PAGE: &str = "index.html";

/// Where the parts lie in the folder.
const PARTS: &str = "parts";

/// What the name of a file ends with, before the number of the process that writes it.
const PARTIAL: &str = ".partial-";

/// `parts/NAME.json`.
#[derive(Debug, Serialize, Deserialize)]
struct Stored<T> {
    key: String,
    value: T,
}

/// The output folder.
#[derive(Debug)]
pub(super) struct Store {
    folder: PathBuf,
    made: AtomicUsize,
    reused: AtomicUsize,
}

impl Store {
    /// Opens the folder; makes it where it is missing.
    pub(super) fn open(folder: &Path) -> Result<Self, PaperError> {
        let parts = folder.join(PARTS);
        fs::create_dir_all(&parts).map_err(|e| output_error(&parts, "cannot be made", e))?;
        remove_left_over(folder);
        remove_left_over(&parts);
        Ok(Self {
            folder: folder.to_owned(),
            made: AtomicUsize::new(0),
            reused: AtomicUsize::new(0),
        })
    }

    /// The finished value of part `name` made from `inputs`, if it is there.
    pub(super) fn find<T: DeserializeOwned>(&self, name: &str, inputs: &str) -> Option<T> {
        let text = fs::read_to_string(self.part_path(name)).ok()?;
        let stored: Stored<T> = serde_json::from_str(&text).ok()?;
        (stored.key == key(inputs)).then_some(stored.value)
    }

    /// The finished value of part `name`, made by `make` where it is not there or was made from other inputs.
    pub(super) fn part<T: Serialize + DeserializeOwned>(
        &self,
        name: &str,
        inputs: &str,
        make: impl FnOnce() -> Result<T, PaperError>,
    ) -> Result<T, PaperError> {
        if let Some(value) = self.find(name, inputs) {
            self.reused.fetch_add(1, Ordering::Relaxed);
            return Ok(value);
        }
        let stored = Stored {
            key: key(inputs),
            value: make()?,
        };
        let path = self.part_path(name);
        let text = serde_json::to_string(&stored)
            .map_err(|e| output_error(&path, "cannot be written", e.into()))?;
        write(&path, text.as_bytes())?;
        self.made.fetch_add(1, Ordering::Relaxed);
        Ok(stored.value)
    }

    /// Forgets part `name`, so that it is made anew.
    pub(super) fn forget(&self, name: &str) -> Result<(), PaperError> {
        let path = self.part_path(name);
        match fs::remove_file(&path) {
            Err(e) if e.kind() != io::ErrorKind::NotFound => {
                Err(output_error(&path, "cannot be replaced", e))
            }
            _ => Ok(()),
        }
    }

    /// Writes `name` in the folder, at once or not at all.
    pub(super) fn write_file(&self, name: &str, bytes: &[u8]) -> Result<(), PaperError> {
        write(&self.folder.join(name), bytes)
    }

    /// The bytes of `name` in the folder.
    pub(super) fn read_file(&self, name: &str) -> io::Result<Vec<u8>> {
        fs::read(self.folder.join(name))
    }

    /// How many parts were made and how many found finished.
    pub(super) fn counts(&self) -> [usize; 2] {
        [&self.made, &self.reused].map(|count| count.load(Ordering::Relaxed))
    }

    fn part_path(&self, name: &str) -> PathBuf {
        self.folder.join(PARTS).join(format!("{name}.json"))
    }
}

/// Refuses a folder with files under the names of the paper's, but without its record: they are of others.
pub(super) fn require_clear(folder: &Path) -> Result<(), PaperError> {
    let is_ours = |name: &str| {
        let figure = name
            .strip_prefix("fig")
            .and_then(|rest| rest.split_once('.'));
        let is_figure = figure.is_some_and(|(_, ending)| matches!(ending, "svg" | "png"));
        is_figure || [RECORD, PAGE].contains(&name)
    };
    let record = fs::read(folder.join(RECORD)).ok();
    if record.is_some_and(|bytes| serde_json::from_slice::<PaperRecord>(&bytes).is_ok()) {
        return Ok(());
    }
    let mut names: Vec<String> = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        names.extend(
            entry
                .file_name()
                .into_string()
                .ok()
                .filter(|name| is_ours(name)),
        );
    }
    if names.is_empty() {
        return Ok(());
    }
    names.sort_unstable();
    Err(PaperError::Study(StudyError::Conflict {
        path: folder.to_owned(),
        names: list_names(&names),
        command: "paper",
    }))
}

fn output_error(path: &Path, action: &'static str, source: io::Error) -> PaperError {
    PaperError::Study(StudyError::Output {
        path: path.to_owned(),
        action,
        source,
    })
}

/// Removes files that killed processes left half written in `folder`.
fn remove_left_over(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let parts = name.to_str().and_then(|name| name.rsplit_once(PARTIAL));
        let process = parts.and_then(|(_, number)| number.parse().ok());
        if process.is_some_and(|process| !process_may_exist(process)) {
            // What cannot be removed says by its name what it is.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Writes a file beside its place and renames it into it.
fn write(path: &Path, bytes: &[u8]) -> Result<(), PaperError> {
    let ending = format!("{PARTIAL}{}", std::process::id());
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(ending);
    let temporary = PathBuf::from(temporary);
    let written = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|e| {
        // What cannot be removed says by its name what it is.
        let _ = fs::remove_file(&temporary);
        output_error(path, "cannot be written", e)
    })
}

fn key(inputs: &str) -> String {
    sha256(format!("foldmotion {VERSION}\n{inputs}").as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_made_once_and_anew_where_its_inputs_change() {
        let home = tempfile::tempdir().unwrap();
        let made = AtomicUsize::new(0);
        let get = |store: &Store, inputs: &str| {
            let make = || Ok(made.fetch_add(1, Ordering::Relaxed));
            store.part("a", inputs, make).unwrap()
        };
        let store = Store::open(home.path()).unwrap();
        assert_eq!((get(&store, "x"), get(&store, "x")), (0, 0));
        let again = Store::open(home.path()).unwrap();
        assert_eq!((get(&again, "x"), get(&again, "y")), (0, 1));
        assert_eq!((store.counts(), again.counts()), ([1, 1], [1, 1]));
        assert_eq!(again.find::<usize>("a", "x"), None);
    }

    #[test]
    fn a_damaged_part_is_made_anew_and_a_failed_one_leaves_nothing() {
        let home = tempfile::tempdir().unwrap();
        let store = Store::open(home.path()).unwrap();
        store.part("a", "x", || Ok(1)).unwrap();
        store.write_file("parts/a.json", b"{\"key\": \"").unwrap();
        assert_eq!(store.part("a", "x", || Ok(2)).unwrap(), 2);
        let failed = store.part::<i32>("b", "x", || Err(PaperError::INTERRUPTED));
        assert!(failed.is_err());
        let names = fs::read_dir(home.path().join(PARTS)).unwrap();
        assert_eq!(names.count(), 1);
    }

    #[test]
    fn files_that_killed_processes_left_half_written_are_removed() {
        let home = tempfile::tempdir().unwrap();
        let names = ["a.svg.partial-4294967295", "a.svg.partial-1", "a.partial-x"];
        for name in names {
            fs::write(home.path().join(name), "half").unwrap();
        }
        Store::open(home.path()).unwrap();
        let stays = names.map(|name| home.path().join(name).exists());
        assert_eq!(stays, [false, true, true]);
    }

    #[test]
    fn files_of_others_under_the_papers_names_are_refused_where_no_record_of_it_lies() {
        let home = tempfile::tempdir().unwrap();
        fs::write(home.path().join("notes.txt"), "mine").unwrap();
        require_clear(home.path()).unwrap();
        for (name, text) in [(PAGE, "mine"), ("fig3.png", "mine"), (RECORD, "{}")] {
            fs::write(home.path().join(name), text).unwrap();
            let error = require_clear(home.path()).unwrap_err();
            assert!(
                error.status() == 2 && error.to_string().contains(name),
                "{error}"
            );
        }
    }

    #[test]
    fn a_file_in_the_way_of_the_folder_is_refused() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("file");
        fs::write(&path, "mine").unwrap();
        assert_eq!(Store::open(&path).unwrap_err().status(), 3);
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    }
}
