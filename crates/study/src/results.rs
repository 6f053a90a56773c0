//! The folder of results: written beside its place, then renamed into it.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::StudyError;

/// Files a run may write, beside pictures and states; those of an earlier run that a new run does not write are removed
/// with it.
const NAMES: &[&str] = &[
    "report.json",
    MOTION,
    CERTIFICATE,
    "motion.gif",
    "motion.mp4",
    "motion.glb",
    "motion.html",
    "motion.csv",
    "plots.svg",
    "figure.svg",
    "figure.pdf",
];

/// Whether a run may write a file of this name.
fn is_of_a_run(name: &str) -> bool {
    NAMES.contains(&name) || is_picture(name) || is_state(name)
}

/// `frames/0001.png` and so on.
fn is_picture(name: &str) -> bool {
    let file = name.strip_prefix(FRAMES).and_then(|n| n.strip_prefix('/'));
    let number = file.and_then(|n| n.strip_suffix(".png"));
    number.is_some_and(|n| n.len() >= 4 && n.bytes().all(|b| b.is_ascii_digit()))
}

/// `state-0.5.obj` and so on.
fn is_state(name: &str) -> bool {
    let rest = name.strip_prefix("state-");
    let time = rest.and_then(|n| n.strip_suffix(".obj").or(n.strip_suffix(".stl")));
    time.is_some_and(|time| time.parse::<f64>().is_ok())
}

/// The name under which the motion stands.
pub(crate) const MOTION: &str = "motion.fold";

/// The folder of pictures among the results.
pub(crate) const FRAMES: &str = "frames";

/// The name under which the report stands.
pub(crate) const REPORT: &str = "report.json";

/// The name under which the certificate of a motion stands.
pub(crate) const CERTIFICATE: &str = "certificate.json";

/// Results under way, in a temporary folder beside the output folder; removed unless published.
#[derive(Debug)]
pub(crate) struct Results {
    folder: PathBuf,
    temporary: PathBuf,
    /// Whether a file of this name may be written; those there already are replaced or removed.
    is_ours: fn(&str) -> bool,
    /// The one that speaks of the others, if there is one, moved into place last.
    last: Option<&'static str>,
    written: Vec<String>,
}

impl Results {
    /// Opens the temporary folder of a run.
    pub(crate) fn create(folder: &Path) -> Result<Self, StudyError> {
        Self::of(folder, is_of_a_run, Some(REPORT))
    }

    /// Opens the temporary folder of the results whose names `is_ours` knows, of which `last` speaks of the others.
    pub(crate) fn of(
        folder: &Path,
        is_ours: fn(&str) -> bool,
        last: Option<&'static str>,
    ) -> Result<Self, StudyError> {
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
        let temporary = parent.join(format!(".{name}.partial-{}", std::process::id()));
        fs::create_dir_all(&temporary)
            .map_err(|e| output_error(&temporary, "cannot be made", e))?;
        Ok(Self {
            folder: folder.to_owned(),
            temporary,
            is_ours,
            last,
            written: Vec::new(),
        })
    }

    /// Bytes free where the results go.
    pub(crate) fn available(&self) -> Result<u64, StudyError> {
        fs4::available_space(&self.temporary)
            .map_err(|e| output_error(&self.temporary, "cannot be measured", e))
    }

    /// Refuses what the disk cannot hold.
    pub(crate) fn require(&self, needed: u64) -> Result<(), StudyError> {
        let available = self.available()?;
        if needed <= available {
            return Ok(());
        }
        let message = format!("about {needed} bytes are needed, but only {available} are free");
        let source = io::Error::new(io::ErrorKind::StorageFull, message);
        Err(output_error(&self.folder, "cannot hold the files", source))
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

    /// The output folder.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// The names written so far.
    pub(crate) fn written(&self) -> &[String] {
        &self.written
    }

    /// Renames every file into the output folder, the report last; files the run does not know stay.
    pub(crate) fn publish(self) -> Result<(), StudyError> {
        let folder = &self.folder;
        fs::create_dir_all(folder).map_err(|e| output_error(folder, "cannot be made", e))?;
        // From here on a report in the folder would speak of other files than those beside it.
        let stale = self.stale()?;
        for name in self
            .last
            .into_iter()
            .chain(stale.iter().map(String::as_str))
        {
            match fs::remove_file(folder.join(name)) {
                Err(e) if e.kind() != io::ErrorKind::NotFound => {
                    return Err(output_error(&folder.join(name), "cannot be replaced", e));
                }
                _ => {}
            }
        }
        let frames = folder.join(FRAMES);
        if self.temporary.join(FRAMES).is_dir() {
            fs::create_dir_all(&frames).map_err(|e| output_error(&frames, "cannot be made", e))?;
        } else if stale.iter().any(|name| is_picture(name)) {
            // Where foreign files lie in it, it stays.
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
        Ok(())
    }

    /// Files of earlier results that these do not replace.
    fn stale(&self) -> Result<Vec<String>, StudyError> {
        let written: BTreeSet<&str> = self.written.iter().map(String::as_str).collect();
        let mut stale = names_in(&self.folder, "")?;
        if self.folder.join(FRAMES).is_dir() {
            let pictures = names_in(&self.folder.join(FRAMES), "frames/")?;
            stale.extend(pictures);
        }
        stale.retain(|name| (self.is_ours)(name) && !written.contains(name.as_str()));
        Ok(stale)
    }
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
mod tests {
    use super::*;

    fn write(results: &mut Results, name: &'static str, text: &str) {
        results
            .write(name, |out| {
                out.write_all(text.as_bytes()).unwrap();
                Ok(())
            })
            .unwrap();
    }

    #[test]
    fn published_results_replace_earlier_ones_and_leave_foreign_files() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("out/scene");
        let mut first = Results::create(&folder).unwrap();
        write(&mut first, "motion.gif", "old film");
        write(&mut first, CERTIFICATE, "old certificate");
        write(&mut first, REPORT, "old report");
        first.publish().unwrap();
        fs::write(folder.join("notes.txt"), "mine").unwrap();
        let mut second = Results::create(&folder).unwrap();
        write(&mut second, "motion.fold", "new motion");
        write(&mut second, REPORT, "new report");
        second.publish().unwrap();
        assert_eq!(
            fs::read_to_string(folder.join(REPORT)).unwrap(),
            "new report"
        );
        assert_eq!(
            fs::read_to_string(folder.join("notes.txt")).unwrap(),
            "mine"
        );
        assert!(
            !folder.join("motion.gif").exists(),
            "a film of another motion would mislead"
        );
        assert!(!folder.join(CERTIFICATE).exists());
        assert_eq!(
            fs::read_dir(home.path().join("out")).unwrap().count(),
            1,
            "nothing temporary is left"
        );
    }

    #[test]
    fn results_that_are_dropped_leave_earlier_ones_as_they_were() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        let mut first = Results::create(&folder).unwrap();
        write(&mut first, REPORT, "earlier");
        first.publish().unwrap();
        let mut failed = Results::create(&folder).unwrap();
        write(&mut failed, REPORT, "never");
        drop(failed);
        assert_eq!(fs::read_to_string(folder.join(REPORT)).unwrap(), "earlier");
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_file_in_the_way_of_the_folder_is_refused() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        fs::write(&folder, "a file").unwrap();
        let error = Results::create(&folder).unwrap_err();
        assert!(error.to_string().contains("it is a file"), "{error}");
        assert_eq!(fs::read_to_string(&folder).unwrap(), "a file");
    }
}
