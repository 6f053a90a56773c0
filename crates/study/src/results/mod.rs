//! The folder of results: written beside its place, then renamed into it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::StudyError;

pub(crate) use self::left_over::may_run;
pub(crate) use self::made::{MadeFile, Maker};
pub(crate) use self::names::{CERTIFICATE, FRAMES, MOTION, REPORT, is_of_a_run, is_picture};

use self::made::{LIST, MadeFiles, are_same};

mod left_over;
mod made;
mod names;

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

impl Destination<'_> {
    /// The same, but files of others that stand in the way are replaced too.
    #[must_use]
    pub fn replacing(self, replaces_all: bool) -> Self {
        Self {
            replaces_all,
            ..self
        }
    }
}

/// Results under way, in a temporary folder beside the output folder; removed unless published.
#[derive(Debug)]
pub(crate) struct Results {
    folder: PathBuf,
    temporary: PathBuf,
    /// Says that this process works in the temporary folder.
    lock: Option<File>,
    maker: Maker,
    /// Whether files of others are replaced.
    replaces_all: bool,
    /// What was made in the folder before.
    made: MadeFiles,
    /// The one that speaks of the others, if there is one, moved into place last.
    last: Option<&'static str>,
    written: Vec<String>,
    /// How many of those written were held against what stands in the folder.
    cleared: usize,
}

impl Results {
    /// Opens the temporary folder of results of `maker`, of which `last` speaks of the others. What killed processes left
    /// beside it is removed.
    pub(crate) fn open(
        destination: Destination<'_>,
        maker: Maker,
        last: Option<&'static str>,
    ) -> Result<Self, StudyError> {
        let folder = destination.folder;
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
        left_over::remove(parent, &name);
        let temporary = left_over::folder_of(parent, &name);
        fs::create_dir_all(&temporary)
            .map_err(|e| output_error(&temporary, "cannot be made", e))?;
        Ok(Self {
            folder: folder.to_owned(),
            lock: left_over::lock(&temporary),
            temporary,
            maker,
            replaces_all: destination.replaces_all,
            made: MadeFiles::read(folder),
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
    pub(crate) fn require(&self, needed: u64) -> Result<(), StudyError> {
        let available = self.available()?;
        if needed <= available {
            return Ok(());
        }
        let message = format!("about {needed} bytes are needed, but only {available} are free");
        let source = io::Error::new(io::ErrorKind::StorageFull, message);
        Err(output_error(&self.folder, "cannot hold the files", source))
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
        Err(StudyError::InTheWay {
            path: self.folder.clone(),
            names: listed(&names),
            command: self.maker.name(),
        })
    }

    fn may_replace(&self, name: &str) -> bool {
        self.replaces_all || self.made.may_replace(self.maker, &self.folder, name)
    }

    /// Gives up what was written under the names of files that are not to be replaced; answers their names.
    pub(crate) fn set_aside(&mut self) -> Vec<String> {
        let (folder, temporary) = (&self.folder, &self.temporary);
        let is_in_the_way = |name: &String| {
            let standing = folder.join(name);
            standing.exists()
                && !are_same(&standing, &temporary.join(name))
                && !self.may_replace(name)
        };
        let new = self.written[self.cleared..].iter();
        let aside: Vec<String> = new.filter(|name| is_in_the_way(name)).cloned().collect();
        self.written.retain(|name| !aside.contains(name));
        self.cleared = self.written.len();
        aside
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

    /// Renames every file, which shows what has the SHA-256 `of`, into the output folder, the one that speaks of the others
    /// last. Of what this maker made before, `is_stale` picks what is removed; all else stays. The names of files of
    /// others that stayed under the name of one of these come back.
    pub(crate) fn publish(
        mut self,
        of: Option<&str>,
        is_stale: &dyn Fn(&MadeFile) -> bool,
    ) -> Result<Published, StudyError> {
        let aside = self.set_aside();
        let folder = self.folder.clone();
        fs::create_dir_all(&folder).map_err(|e| output_error(&folder, "cannot be made", e))?;
        let stale = self.stale(is_stale);
        self.list(of, &stale)?;
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
        self.write_list()?;
        let mut others = names_of(&folder)?;
        others.retain(|name| is_of_a_run(name) && !self.made.has(self.maker, name));
        others.retain(|name| !aside.contains(name));
        Ok(Published {
            aside,
            removed: stale,
            others,
        })
    }

    fn has(&self, name: &str) -> bool {
        self.written.iter().any(|written| written == name)
    }

    /// Files that this maker made before, that `is_stale` picks, that these do not replace and nobody has changed.
    fn stale(&self, is_stale: &dyn Fn(&MadeFile) -> bool) -> Vec<String> {
        let stale = self.made.stale(self.maker, is_stale);
        let mut names: Vec<String> = stale.map(|file| file.name.clone()).collect();
        let is_removed = |name: &String| {
            is_inside(name)
                && !self.has(name)
                && self.folder.join(name).exists()
                && self.made.may_replace(self.maker, &self.folder, name)
        };
        names.retain(is_removed);
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Lists the files about to be moved beside those in their places, so that whatever ends this process, the next one
    /// knows both; then, in memory, only what will be there.
    fn list(&mut self, of: Option<&str>, stale: &[String]) -> Result<(), StudyError> {
        let new: Vec<MadeFile> = self
            .written
            .iter()
            .map(|name| MadeFile::new(self.maker, &self.temporary, name, of))
            .collect();
        self.made.extend(&new);
        self.write_list()?;
        let (folder, written) = (&self.folder, &self.written);
        let is_kept = |file: &MadeFile| {
            let is_written = written.contains(&file.name);
            // Made again by another command with the same bytes, a file is of both.
            let is_same = new.iter().any(|made| made.is_same_by_other(file));
            (!is_written || is_same)
                && !stale.contains(&file.name)
                && folder.join(&file.name).exists()
        };
        self.made.retain(is_kept);
        self.made.extend(&new);
        Ok(())
    }

    fn write_list(&self) -> Result<(), StudyError> {
        self.made
            .write(&self.folder, &self.temporary)
            .map_err(|e| write_error(&self.folder, LIST, e))
    }
}

/// What became of the other files in a folder of results.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Published {
    /// Files of others that stayed under the name of one of the results.
    pub aside: Vec<String>,
    /// Files made before that were removed.
    pub removed: Vec<String>,
    /// Files of others that have names of results.
    pub others: Vec<String>,
}

impl Published {
    /// In words, a line each.
    pub fn words(&self) -> Vec<String> {
        let lines = [
            (
                "left as they are and not written, because this command did not make them or they were changed since (--force \
                 replaces them)",
                &self.aside,
            ),
            ("removed, because an earlier motion made them", &self.removed),
            ("left as they are, though not of this run", &self.others),
        ];
        let told = lines.into_iter().filter(|(_, names)| !names.is_empty());
        told.map(|(what, names)| format!("{what}: {}", listed(names)))
            .collect()
    }
}

/// Whether a name of the list stays in the folder: what a list says must not reach elsewhere.
fn is_inside(name: &str) -> bool {
    let file = name.strip_prefix("frames/").unwrap_or(name);
    !file.contains(['/', '\\']) && !matches!(file, "" | "." | "..")
}

/// Names for a message, not too many.
pub(crate) fn listed(names: &[String]) -> String {
    const MOST: usize = 8;
    let mut text = names.iter().take(MOST).cloned().collect::<Vec<_>>();
    if names.len() > MOST {
        text.push(format!("{} more", names.len() - MOST));
    }
    text.join(", ")
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

    fn write(results: &mut Results, name: &str, text: &str) {
        results
            .write(name, |out| {
                out.write_all(text.as_bytes()).unwrap();
                Ok(())
            })
            .unwrap();
    }

    fn open(folder: &Path) -> Results {
        Results::open(folder.into(), Maker::Run, Some(REPORT)).unwrap()
    }

    /// Publishes as a run of the motion `of` does.
    fn publish(results: Results, of: &str) -> Published {
        let is_stale = |file: &MadeFile| file.of.as_deref() != Some(of);
        results.publish(Some(of), &is_stale).unwrap()
    }

    fn text(folder: &Path, name: &str) -> String {
        fs::read_to_string(folder.join(name)).unwrap()
    }

    const OLD_REPORT: &str = r#"{"version": "0.1.0", "engine": {}, "files": ["motion.gif"]}"#;

    #[test]
    fn published_results_replace_earlier_ones_and_leave_foreign_files() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("out/scene");
        let mut first = open(&folder);
        write(&mut first, "motion.gif", "old film");
        write(&mut first, CERTIFICATE, "old certificate");
        write(&mut first, REPORT, OLD_REPORT);
        publish(first, "old motion");
        for name in ["notes.txt", "figure.pdf"] {
            fs::write(folder.join(name), "mine").unwrap();
        }
        let mut second = open(&folder);
        write(&mut second, "motion.fold", "new motion");
        write(&mut second, REPORT, "new report");
        let published = publish(second, "new motion");
        assert_eq!(published.removed, [CERTIFICATE, "motion.gif"]);
        assert_eq!(published.others, ["figure.pdf"]);
        assert_eq!(text(&folder, REPORT), "new report");
        assert_eq!(text(&folder, "notes.txt"), "mine");
        assert_eq!(text(&folder, "figure.pdf"), "mine");
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
    fn earlier_results_of_the_same_motion_stay_and_may_be_replaced_later() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        for name in ["motion.gif", "motion.mp4", "motion.gif"] {
            let mut results = open(&folder);
            results.require_clear(&|_| true).unwrap();
            write(&mut results, name, "a film");
            write(&mut results, REPORT, OLD_REPORT);
            assert_eq!(publish(results, "motion"), Published::default());
        }
        assert_eq!(text(&folder, "motion.mp4"), "a film");
        assert_eq!(text(&folder, "motion.gif"), "a film");
    }

    #[test]
    fn files_that_no_earlier_run_made_are_named_and_stay_unless_forced() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        let mut first = open(&folder);
        write(&mut first, "motion.gif", "a film");
        write(&mut first, "plots.svg", "plots");
        publish(first, "motion");
        // One of its own is changed, one is new, one is of another command.
        fs::write(folder.join("motion.gif"), "an edited film").unwrap();
        fs::write(folder.join("figure.pdf"), "mine").unwrap();
        let mut record = Results::open((&folder).into(), Maker::Record, None).unwrap();
        write(&mut record, "motion.mp4", "another film");
        record.publish(Some("motion"), &|_| false).unwrap();
        let names = ["figure.pdf", "motion.gif", "motion.mp4"];
        let error = open(&folder).require_clear(&|_| true).unwrap_err();
        assert_eq!(error.status(), 2);
        for word in names.iter().chain(&["--force", "foldmotion run"]) {
            assert!(error.to_string().contains(word), "{error}");
        }
        assert!(!error.to_string().contains("plots.svg"), "{error}");
        // Had they come while the run was computed.
        let mut late = open(&folder);
        names.iter().for_each(|name| write(&mut late, name, "new"));
        let published = publish(late, "motion");
        assert_eq!(published.aside, names);
        assert_eq!(text(&folder, "figure.pdf"), "mine");
        assert_eq!(text(&folder, "motion.gif"), "an edited film");
        assert_eq!(text(&folder, "motion.mp4"), "another film");
        let forced = Destination::from(&folder).replacing(true);
        let mut forced = Results::open(forced, Maker::Run, Some(REPORT)).unwrap();
        forced.require_clear(&|_| true).unwrap();
        names.iter().for_each(|name| write(&mut forced, name, "new"));
        assert_eq!(publish(forced, "motion"), Published::default());
        assert_eq!(text(&folder, "figure.pdf"), "new");
        // From then on they are the run's.
        open(&folder).require_clear(&|_| true).unwrap();
    }

    #[test]
    fn what_is_written_with_the_same_bytes_is_in_nobodys_way() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        let mut run = open(&folder);
        write(&mut run, CERTIFICATE, "a certificate");
        publish(run, "motion");
        let mut check = Results::open((&folder).into(), Maker::Check, None).unwrap();
        write(&mut check, CERTIFICATE, "a certificate");
        check.publish(Some("motion"), &|_| false).unwrap();
        open(&folder).require_clear(&|_| true).unwrap();
    }

    #[test]
    fn without_a_list_a_report_of_a_run_says_what_it_made_and_any_other_report_stays() {
        let home = tempfile::tempdir().unwrap();
        for name in ["motion.gif", "plots.svg"] {
            fs::write(home.path().join(name), "old").unwrap();
        }
        fs::write(home.path().join(REPORT), OLD_REPORT).unwrap();
        let refused = |names: &[&str]| {
            let results = open(home.path());
            let error = results.require_clear(&|_| true).unwrap_err().to_string();
            names.iter().all(|name| error.contains(name)) && !error.contains("motion.gif")
        };
        assert!(refused(&["plots.svg"]));
        fs::write(home.path().join(REPORT), r#"{"of": "mine"}"#).unwrap();
        fs::remove_file(home.path().join("motion.gif")).unwrap();
        assert!(refused(&["plots.svg", REPORT]));
    }

    #[test]
    fn a_list_that_names_files_elsewhere_removes_none() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        fs::create_dir(&folder).unwrap();
        fs::write(home.path().join("mine.txt"), "mine").unwrap();
        let list = r#"{"files": [{"name": "../mine.txt", "by": "run", "sha256": null, "of": null}]}"#;
        fs::write(folder.join(LIST), list).unwrap();
        assert_eq!(publish(open(&folder), "motion"), Published::default());
        assert_eq!(text(home.path(), "mine.txt"), "mine");
    }

    #[test]
    fn what_killed_runs_left_is_removed_and_folders_of_living_ones_stay() {
        let home = tempfile::tempdir().unwrap();
        // No system gives a process this number.
        let dead = home.path().join(".scene.partial-4294967295");
        let other = home.path().join(".other.partial-4294967295");
        let living = home.path().join(".scene.partial-1");
        let locked = home.path().join(".scene.partial-4294967294");
        for folder in [&dead, &other, &living, &locked] {
            fs::create_dir(folder).unwrap();
            fs::write(folder.join(MOTION), "half a motion").unwrap();
        }
        let lock = left_over::lock(&locked);
        drop(open(&home.path().join("scene")));
        assert!(!dead.exists());
        assert!(other.exists() && living.exists() && locked.exists());
        drop(lock);
        drop(open(&home.path().join("scene")));
        assert!(!locked.exists());
    }

    #[test]
    fn results_that_are_dropped_leave_earlier_ones_as_they_were() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        let mut first = open(&folder);
        write(&mut first, REPORT, "earlier");
        publish(first, "motion");
        let mut failed = open(&folder);
        write(&mut failed, REPORT, "never");
        drop(failed);
        assert_eq!(text(&folder, REPORT), "earlier");
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_file_in_the_way_of_the_folder_is_refused() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("scene");
        fs::write(&folder, "a file").unwrap();
        let error = Results::open((&folder).into(), Maker::Run, None).unwrap_err();
        assert!(error.to_string().contains("it is a file"), "{error}");
        assert_eq!(fs::read_to_string(&folder).unwrap(), "a file");
    }
}
