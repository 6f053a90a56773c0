//! The output folder of the paper, in which finished parts are stored with the hash of their inputs.
//!
//! `parts/NAME.json` has the value of a part and a key: the SHA-256 of the program's version and the inputs of the part. A part
//! with another key is computed again. Each file is written under a temporary name and then renamed.

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

/// The names of the record and of the page.
pub(super) const RECORD: &str = "paper.json";
pub(super) const PAGE: &str = "index.html";

/// The name of the folder of the parts.
const PARTS: &str = "parts";

/// The suffix of temporary names, before the number of the process.
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
    computed: AtomicUsize,
    reused: AtomicUsize,
}

impl Store {
    /// Opens the folder; creates it if necessary.
    pub(super) fn open(folder: &Path) -> Result<Self, PaperError> {
        let parts = folder.join(PARTS);
        fs::create_dir_all(&parts).map_err(|e| output_error(&parts, "cannot be created", e))?;
        remove_left_over(folder);
        remove_left_over(&parts);
        Ok(Self {
            folder: folder.to_owned(),
            computed: AtomicUsize::new(0),
            reused: AtomicUsize::new(0),
        })
    }

    /// The stored value of part `name`; `None` if it is missing or has other inputs.
    pub(super) fn find<T: DeserializeOwned>(&self, name: &str, inputs: &str) -> Option<T> {
        let text = fs::read_to_string(self.part_path(name)).ok()?;
        let stored: Stored<T> = serde_json::from_str(&text).ok()?;
        (stored.key == key(inputs)).then_some(stored.value)
    }

    /// The stored value of part `name`, which is computed by `make` if it is missing or has other inputs.
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
        let stored = Stored { key: key(inputs), value: make()? };
        let path = self.part_path(name);
        let text = serde_json::to_string(&stored)
            .map_err(|e| output_error(&path, "cannot be written", e.into()))?;
        write(&path, text.as_bytes())?;
        self.computed.fetch_add(1, Ordering::Relaxed);
        Ok(stored.value)
    }

    /// Removes part `name`, so that it is computed again.
    pub(super) fn forget(&self, name: &str) -> Result<(), PaperError> {
        let path = self.part_path(name);
        match fs::remove_file(&path) {
            Err(e) if e.kind() != io::ErrorKind::NotFound => {
                Err(output_error(&path, "cannot be replaced", e))
            }
            _ => Ok(()),
        }
    }

    /// Writes the file `name` in the folder atomically.
    pub(super) fn write_file(&self, name: &str, bytes: &[u8]) -> Result<(), PaperError> {
        write(&self.folder.join(name), bytes)
    }

    /// The bytes of `name` in the folder.
    pub(super) fn read_file(&self, name: &str) -> io::Result<Vec<u8>> {
        fs::read(self.folder.join(name))
    }

    /// The numbers of computed and of reused parts.
    pub(super) fn counts(&self) -> [usize; 2] {
        [&self.computed, &self.reused].map(|count| count.load(Ordering::Relaxed))
    }

    fn part_path(&self, name: &str) -> PathBuf {
        self.folder.join(PARTS).join(format!("{name}.json"))
    }
}

/// Refuses a folder that has files with names of the paper but no record: they are files of the user.
pub(super) fn require_clear(folder: &Path) -> Result<(), PaperError> {
    let has_name_of_paper = |name: &str| {
        let figure = name.strip_prefix("fig").and_then(|rest| rest.split_once('.'));
        let is_figure = figure.is_some_and(|(_, ending)| matches!(ending, "svg" | "png"));
        is_figure || [RECORD, PAGE].contains(&name)
    };
    let record = fs::read(folder.join(RECORD)).ok();
    if record.is_some_and(|bytes| serde_json::from_slice::<PaperRecord>(&bytes).is_ok()) {
        return Ok(());
    }
    let mut names: Vec<String> = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        names.extend(entry.file_name().into_string().ok().filter(|name| has_name_of_paper(name)));
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
    PaperError::Study(StudyError::Output { path: path.to_owned(), action, source })
}

/// Removes the temporary files of killed processes in `folder`.
fn remove_left_over(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let parts = name.to_str().and_then(|name| name.rsplit_once(PARTIAL));
        let process = parts.and_then(|(_, number)| number.parse().ok());
        if process.is_some_and(|process| !process_may_exist(process)) {
            // A file that cannot be removed is recognisable by its name.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Writes a file under a temporary name and renames it.
fn write(path: &Path, bytes: &[u8]) -> Result<(), PaperError> {
    let ending = format!("{PARTIAL}{}", std::process::id());
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(ending);
    let temporary = PathBuf::from(temporary);
    let written = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|e| {
        // A file that cannot be removed is recognisable by its name.
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
    fn a_part_is_computed_once_and_again_if_its_inputs_change() {
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
    fn a_damaged_part_is_computed_again_and_a_failed_one_is_not_stored() {
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
    fn temporary_files_of_killed_processes_are_removed() {
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
    fn files_of_the_user_with_names_of_the_paper_are_refused() {
        let home = tempfile::tempdir().unwrap();
        fs::write(home.path().join("notes.txt"), "mine").unwrap();
        require_clear(home.path()).unwrap();
        for (name, text) in [(PAGE, "mine"), ("fig3.png", "mine"), (RECORD, "{}")] {
            fs::write(home.path().join(name), text).unwrap();
            let error = require_clear(home.path()).unwrap_err();
            assert!(error.status() == 2 && error.to_string().contains(name), "{error}");
        }
    }

    #[test]
    fn a_file_with_the_name_of_the_folder_is_refused() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("file");
        fs::write(&path, "mine").unwrap();
        assert_eq!(Store::open(&path).unwrap_err().status(), 3);
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    }
}
