//! The manifest of an output folder: the files that foldmotion made there, so that it never replaces a file of the user.

use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::names::REPORT;
use crate::digest::hexadecimal;

/// The name of the manifest file.
pub(crate) const MANIFEST: &str = ".foldmotion.json";

/// The largest manifest or report that is read, in bytes.
const LARGEST: u64 = 64 << 20;

/// A command that writes files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Command {
    Run,
    Record,
    Check,
    Pattern,
}

impl Command {
    /// The name of the command.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Record => "record",
            Self::Check => "check",
            Self::Pattern => "pattern",
        }
    }

    /// Whether this command may replace files of `other`. A run replaces only its own files.
    fn may_replace(self, other: Self) -> bool {
        self != Self::Run || other == Self::Run
    }
}

/// A file in the manifest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct ManifestEntry {
    /// The name of the file in the folder.
    pub(crate) name: String,
    /// The command that wrote the file.
    pub(crate) by: Command,
    /// The SHA-256 of the file; `None` for a report, whose timings vary, and for files that only a report lists.
    sha256: Option<String>,
    /// The SHA-256 of what the file shows: of the motion, or of the inputs of a pattern.
    pub(crate) of: Option<String>,
}

impl ManifestEntry {
    /// The entry of the file `name` in `folder`, written by `command` from the content with the SHA-256 `of`.
    pub(crate) fn new(command: Command, folder: &Path, name: &str, of: Option<&str>) -> Self {
        let sha256 = (name != REPORT).then(|| digest(&folder.join(name)));
        Self {
            name: name.to_owned(),
            by: command,
            sha256: sha256.flatten(),
            of: of.map(ToOwned::to_owned),
        }
    }

    /// Whether this file has the same bytes as `other` of another command.
    pub(super) fn is_same_by_other(&self, other: &Self) -> bool {
        self.by != other.by
            && self.name == other.name
            && self.sha256.is_some()
            && self.sha256 == other.sha256
    }
}

/// The manifest of an output folder.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Manifest {
    files: Vec<ManifestEntry>,
}

impl Manifest {
    /// Reads the manifest of `folder`. Default: the files that a report in the folder lists.
    pub(crate) fn read(folder: &Path) -> Self {
        let listed = read_bounded(&folder.join(MANIFEST));
        if let Some(list) = listed.and_then(|bytes| serde_json::from_slice(&bytes).ok()) {
            return list;
        }
        let files = files_of_report(&folder.join(REPORT)).unwrap_or_default();
        let made = |name| ManifestEntry { name, by: Command::Run, sha256: None, of: None };
        Self { files: files.into_iter().map(made).collect() }
    }

    /// Writes the manifest into `folder` atomically, by way of the folder `temporary`.
    pub(crate) fn write(&self, folder: &Path, temporary: &Path) -> io::Result<()> {
        let mut text = serde_json::to_string_pretty(self)?;
        text.push('\n');
        let path = temporary.join(MANIFEST);
        fs::write(&path, text)?;
        fs::rename(path, folder.join(MANIFEST))
    }

    /// Whether `command` may replace the file `name` of `folder`, because it wrote the file and the file was not changed.
    pub(crate) fn may_replace(&self, command: Command, folder: &Path, name: &str) -> bool {
        let path = folder.join(name);
        let mut candidates = self.files.iter().filter(|file| file.name == name);
        if name == REPORT {
            return candidates.any(|file| command.may_replace(file.by))
                && files_of_report(&path).is_some();
        }
        // The file is hashed only once for all entries with its name.
        let mut sha256 = None;
        candidates.any(|file| {
            command.may_replace(file.by)
                && file.sha256.as_ref().is_none_or(|made| {
                    let found = sha256.get_or_insert_with(|| digest(&path));
                    found.as_ref() == Some(made)
                })
        })
    }

    /// Whether `command` wrote the file `name`.
    pub(crate) fn has(&self, command: Command, name: &str) -> bool {
        let mut files = self.files.iter();
        files.any(|file| file.by == command && file.name == name)
    }

    /// The files of `command` that `is_stale` selects.
    pub(crate) fn stale(
        &self,
        command: Command,
        is_stale: &dyn Fn(&ManifestEntry) -> bool,
    ) -> impl Iterator<Item = &ManifestEntry> {
        let of_command = self.files.iter().filter(move |file| file.by == command);
        of_command.filter(move |file| is_stale(file))
    }

    /// Adds files to the manifest.
    pub(crate) fn extend(&mut self, files: &[ManifestEntry]) {
        self.files.extend_from_slice(files);
    }

    /// Keeps the files that `is_kept` selects.
    pub(crate) fn retain(&mut self, is_kept: impl Fn(&ManifestEntry) -> bool) {
        self.files.retain(is_kept);
    }
}

/// Whether two files have the same bytes.
pub(super) fn are_same(a: &Path, b: &Path) -> bool {
    let size = |path: &Path| fs::metadata(path).map(|data| data.len()).ok();
    size(a).is_some() && size(a) == size(b) && digest(a).is_some() && digest(a) == digest(b)
}

/// The SHA-256 of a file; `None` if it cannot be read.
fn digest(path: &Path) -> Option<String> {
    let mut file = File::open(path).ok()?;
    let mut hash = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer).ok()? {
            0 => return Some(hexadecimal(&hash.finalize())),
            count => hash.update(&buffer[..count]),
        }
    }
}

/// The files that a report of foldmotion lists; `None` for any other file.
fn files_of_report(path: &Path) -> Option<Vec<String>> {
    #[derive(Deserialize)]
    struct Listed {
        version: String,
        files: Vec<String>,
        #[serde(rename = "engine")]
        _engine: serde_json::Value,
    }
    let report: Listed = serde_json::from_slice(&read_bounded(path)?).ok()?;
    let mut files = report.files;
    files.push(REPORT.to_owned());
    (!report.version.is_empty()).then_some(files)
}

/// The bytes of a regular file that is not too large.
fn read_bounded(path: &Path) -> Option<Vec<u8>> {
    let data = fs::metadata(path).ok()?;
    (data.is_file() && data.len() <= LARGEST).then(|| fs::read(path).ok()).flatten()
}
