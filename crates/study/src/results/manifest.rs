//! What foldmotion made in a folder: a list beside the results, so that it never takes a file of others for its own.

use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::names::REPORT;
use crate::digest::hexadecimal;

/// The name of the list.
pub(crate) const LIST: &str = ".foldmotion.json";

/// The largest list, or report in place of one, that is read: bytes.
const LARGEST: u64 = 64 << 20;

/// The command that makes files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Command {
    Run,
    Record,
    Check,
    Pattern,
}

impl Command {
    /// The command.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Record => "record",
            Self::Check => "check",
            Self::Pattern => "pattern",
        }
    }

    /// Whether it may write over what `other` made. A run knows only its own; the others are asked for single files.
    fn may_replace(self, other: Self) -> bool {
        self != Self::Run || other == Self::Run
    }
}

/// A file that was made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct ManifestEntry {
    /// Its name in the folder.
    pub(crate) name: String,
    pub(crate) by: Command,
    /// Its SHA-256; none of a report, whose seconds differ from run to run, and of files that only a report lists.
    sha256: Option<String>,
    /// The SHA-256 of what it shows: of the motion, or of all that makes a pattern.
    pub(crate) of: Option<String>,
}

impl ManifestEntry {
    /// The file `name` of `command`, which stands in `folder` and shows what has the SHA-256 `of`.
    pub(crate) fn new(command: Command, folder: &Path, name: &str, of: Option<&str>) -> Self {
        let sha256 = (name != REPORT).then(|| digest(&folder.join(name)));
        Self {
            name: name.to_owned(),
            by: command,
            sha256: sha256.flatten(),
            of: of.map(ToOwned::to_owned),
        }
    }

    /// Whether it has the bytes of `other`, which another command made.
    pub(super) fn is_same_by_other(&self, other: &Self) -> bool {
        self.by != other.by
            && self.name == other.name
            && self.sha256.is_some()
            && self.sha256 == other.sha256
    }
}

/// The list.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Manifest {
    files: Vec<ManifestEntry>,
}

impl Manifest {
    /// The list in `folder`. Where there is none, a report lists the files of its run; else nothing is known.
    pub(crate) fn read(folder: &Path) -> Self {
        let listed = read_bounded(&folder.join(LIST));
        if let Some(list) = listed.and_then(|bytes| serde_json::from_slice(&bytes).ok()) {
            return list;
        }
        let files = files_of_report(&folder.join(REPORT)).unwrap_or_default();
        let made = |name| ManifestEntry {
            name,
            by: Command::Run,
            sha256: None,
            of: None,
        };
        Self {
            files: files.into_iter().map(made).collect(),
        }
    }

    /// Writes the list into `folder`, at once or not at all.
    pub(crate) fn write(&self, folder: &Path, temporary: &Path) -> io::Result<()> {
        let mut text = serde_json::to_string_pretty(self)?;
        text.push('\n');
        let path = temporary.join(LIST);
        fs::write(&path, text)?;
        fs::rename(path, folder.join(LIST))
    }

    /// Whether `command` may write over the file `name` of `folder`: it made it, and nobody has changed it since.
    pub(crate) fn may_replace(&self, command: Command, folder: &Path, name: &str) -> bool {
        let path = folder.join(name);
        let mut candidates = self.files.iter().filter(|file| file.name == name);
        if name == REPORT {
            return candidates.any(|file| command.may_replace(file.by))
                && files_of_report(&path).is_some();
        }
        // The file is hashed once for all entries of its name.
        let mut sha256 = None;
        candidates.any(|file| {
            command.may_replace(file.by)
                && file.sha256.as_ref().is_none_or(|made| {
                    let found = sha256.get_or_insert_with(|| digest(&path));
                    found.as_ref() == Some(made)
                })
        })
    }

    /// Whether `command` made the file `name`.
    pub(crate) fn has(&self, command: Command, name: &str) -> bool {
        let mut files = self.files.iter();
        files.any(|file| file.by == command && file.name == name)
    }

    /// Files of `command` that `is_stale` picks.
    pub(crate) fn stale(
        &self,
        command: Command,
        is_stale: &dyn Fn(&ManifestEntry) -> bool,
    ) -> impl Iterator<Item = &ManifestEntry> {
        let of_command = self.files.iter().filter(move |file| file.by == command);
        of_command.filter(move |file| is_stale(file))
    }

    /// Adds files.
    pub(crate) fn extend(&mut self, files: &[ManifestEntry]) {
        self.files.extend_from_slice(files);
    }

    /// Keeps the files that `is_kept` picks.
    pub(crate) fn retain(&mut self, is_kept: impl Fn(&ManifestEntry) -> bool) {
        self.files.retain(is_kept);
    }
}

/// Whether two files hold the same bytes.
pub(super) fn are_same(a: &Path, b: &Path) -> bool {
    let size = |path: &Path| fs::metadata(path).map(|data| data.len()).ok();
    size(a).is_some() && size(a) == size(b) && digest(a).is_some() && digest(a) == digest(b)
}

/// The SHA-256 of a file that can be read.
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

/// The files that a report of ours lists; none of any other file.
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

/// The bytes of a file that is there, a file, and not too large.
fn read_bounded(path: &Path) -> Option<Vec<u8>> {
    let data = fs::metadata(path).ok()?;
    (data.is_file() && data.len() <= LARGEST)
        .then(|| fs::read(path).ok())
        .flatten()
}
