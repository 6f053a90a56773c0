//! Unsaved scenes, kept in one file per window and offered for recovery at the next start.
//!
//! Each window locks a file beside its scene. The lock ends with the process, however that ends, so a scene that can be
//! locked was left behind.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use crate::document::{Document, write_whole};

/// The largest number of scenes that are kept; the oldest are removed first.
const MAX_COUNT: usize = 10;
/// Files larger than this are ignored.
const MAX_BYTES: u64 = 256 << 20;

/// A scene that was not saved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct UnsavedScene {
    #[serde(rename = "place")]
    location: String,
    path: Option<String>,
    base: String,
    text: String,
    /// When it was kept, in seconds since 1970.
    time: u64,
}

impl UnsavedScene {
    fn of(document: &Document) -> Self {
        let path = document.path().map(|path| path.to_string_lossy().into_owned());
        Self {
            location: document.location().to_string_lossy().into_owned(),
            path,
            base: document.saved_text().to_owned(),
            text: document.text().to_owned(),
            time: since_epoch().as_secs(),
        }
    }

    /// The scene as it was kept.
    pub(crate) fn document(&self) -> Document {
        let path = self.path.as_ref().map(Path::new);
        Document::restored(Path::new(&self.location), path, &self.base, &self.text)
    }

    /// For example `unsaved changes to shelter.toml, 5 minutes ago`.
    pub(crate) fn describe(&self) -> String {
        let name = Path::new(&self.location).file_name().unwrap_or_default();
        let age = since_epoch().as_secs().saturating_sub(self.time);
        format!("unsaved changes to {}, {}", name.to_string_lossy(), ago(age))
    }
}

fn since_epoch() -> Duration {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default()
}

fn ago(seconds: u64) -> String {
    let (count, unit) = match seconds {
        0..60 => return "a moment ago".to_owned(),
        60..3600 => (seconds / 60, "minute"),
        3600..86400 => (seconds / 3600, "hour"),
        _ => (seconds / 86400, "day"),
    };
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {unit}{plural} ago")
}

/// A file with its lock.
#[derive(Debug)]
struct LockedFile {
    path: PathBuf,
    /// The lock, which lasts as long as this value; `None` on file systems without locks.
    lock: Option<File>,
}

impl LockedFile {
    /// Locks a file; `None` if another window has locked it.
    fn take(path: PathBuf) -> Option<Self> {
        let lock = File::create(lock_of(&path)).ok()?;
        match lock.try_lock() {
            Ok(()) => Some(Self { path, lock: Some(lock) }),
            Err(TryLockError::WouldBlock) => None,
            Err(TryLockError::Error(_)) => Some(Self { path, lock: None }),
        }
    }

    fn remove(self) {
        // A file that cannot be removed is offered again, so nothing is lost.
        let _ = std::fs::remove_file(&self.path);
        let _ = std::fs::remove_file(lock_of(&self.path));
        drop(self.lock);
    }
}

fn lock_of(path: &Path) -> PathBuf {
    path.with_extension("lock")
}

/// The unsaved scenes of all windows.
#[derive(Debug)]
pub(crate) struct UnsavedScenes {
    folder: PathBuf,
    own: Option<LockedFile>,
    /// The text and the base that are in the file of this window.
    written: Option<(String, String)>,
    recovered: Vec<(UnsavedScene, LockedFile)>,
}

impl UnsavedScenes {
    /// Locks the scenes that earlier windows left behind in a folder, the latest first.
    ///
    /// # Errors
    /// If the folder cannot be created or read.
    pub(crate) fn in_folder(folder: &Path) -> io::Result<Self> {
        std::fs::create_dir_all(folder)?;
        let mut recovered = Vec::new();
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == "json")
                && let Some(kept) = LockedFile::take(path)
                && let Some(scene) = read(&kept.path)
            {
                recovered.push((scene, kept));
            }
        }
        recovered.sort_by(|(a, x), (b, y)| b.time.cmp(&a.time).then_with(|| x.path.cmp(&y.path)));
        for (_, kept) in recovered.drain(recovered.len().min(MAX_COUNT)..) {
            kept.remove();
        }
        Ok(Self { folder: folder.to_owned(), own: None, written: None, recovered })
    }

    /// The scenes that earlier windows left behind, the latest first.
    pub(crate) fn recovered(&self) -> impl Iterator<Item = &UnsavedScene> {
        self.recovered.iter().map(|(scene, _)| scene)
    }

    /// Makes a recovered scene the scene of this window.
    ///
    /// # Errors
    /// If it cannot be kept under this window's name; the file is then unchanged.
    pub(crate) fn restore(&mut self, index: usize) -> io::Result<Option<Document>> {
        let Some((scene, _)) = self.recovered.get(index) else {
            return Ok(None);
        };
        let document = scene.document();
        self.keep(&document)?;
        self.discard(index);
        Ok(Some(document))
    }

    /// Deletes a recovered scene.
    pub(crate) fn discard(&mut self, index: usize) {
        if index < self.recovered.len() {
            self.recovered.remove(index).1.remove();
        }
    }

    /// Keeps the scene of this window while it is unsaved, and deletes it once it is saved. Does nothing if the text
    /// has not changed.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub(crate) fn keep(&mut self, document: &Document) -> io::Result<()> {
        if !document.is_modified() {
            self.clear();
            return Ok(());
        }
        let as_written = self
            .written
            .as_ref()
            .is_some_and(|(text, base)| text == document.text() && base == document.saved_text());
        if as_written {
            return Ok(());
        }
        let scene = UnsavedScene::of(document);
        let json = serde_json::to_string(&scene)?;
        let path = self.own_path()?;
        write_whole(&path, &json, false)?;
        self.written = Some((scene.text, scene.base));
        Ok(())
    }

    /// Deletes the scene of this window, after it was saved or its changes were discarded.
    pub(crate) fn clear(&mut self) {
        self.written = None;
        if let Some(own) = self.own.take() {
            own.remove();
        }
    }

    /// The file of this window, which no other window uses.
    fn own_path(&mut self) -> io::Result<PathBuf> {
        if let Some(own) = &self.own {
            return Ok(own.path.clone());
        }
        let name = format!("{}-{}.json", std::process::id(), since_epoch().as_nanos());
        let path = self.folder.join(name);
        let own = LockedFile::take(path.clone());
        let own = own.ok_or_else(|| io::Error::other("the file cannot be locked"))?;
        self.own = Some(own);
        Ok(path)
    }
}

fn read(path: &Path) -> Option<UnsavedScene> {
    let size = std::fs::metadata(path).ok()?.len();
    let text = (size <= MAX_BYTES).then(|| std::fs::read_to_string(path).ok())??;
    serde_json::from_str(&text).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edited(rows: i64) -> Document {
        let mut document = Document::new();
        let mut scene = document.scene().clone();
        scene.sheet.rows = Some(rows);
        assert!(document.change(scene, "rows", false));
        document
    }

    fn files(folder: &Path) -> usize {
        std::fs::read_dir(folder).unwrap().count()
    }

    #[test]
    fn an_unsaved_scene_outlives_its_window_and_is_offered_until_restored_and_saved() {
        let folder = tempfile::tempdir().unwrap();
        let document = edited(9);
        {
            let mut window = UnsavedScenes::in_folder(folder.path()).unwrap();
            window.keep(&document).unwrap();
            window.keep(&edited(10)).unwrap();
        }
        let mut next = UnsavedScenes::in_folder(folder.path()).unwrap();
        let described = next.recovered().next().unwrap().describe();
        assert_eq!(described, "unsaved changes to untitled.toml, a moment ago");
        let mut restored = next.restore(0).unwrap().unwrap();
        assert_eq!(restored.text(), edited(10).text());
        assert!(restored.is_modified() && next.recovered().next().is_none());
        restored.save_as(&folder.path().join("saved.toml")).unwrap();
        next.keep(&restored).unwrap();
        assert_eq!(files(folder.path()), 1);
    }

    #[test]
    fn simultaneous_windows_do_not_touch_each_others_scenes() {
        let folder = tempfile::tempdir().unwrap();
        let mut first = UnsavedScenes::in_folder(folder.path()).unwrap();
        first.keep(&edited(9)).unwrap();
        let mut second = UnsavedScenes::in_folder(folder.path()).unwrap();
        assert!(second.recovered().next().is_none());
        second.keep(&edited(11)).unwrap();
        second.clear();
        drop(first);
        let third = UnsavedScenes::in_folder(folder.path()).unwrap();
        assert_eq!(third.recovered().count(), 1);
        assert_eq!(third.recovered().next().unwrap().text, edited(9).text());
        // A scene that one window offers is not offered by another.
        let fourth = UnsavedScenes::in_folder(folder.path()).unwrap();
        assert_eq!(fourth.recovered().count(), 0);
    }

    /// Tells the child process of the next test in which folder to keep its scene.
    const FOLDER: &str = "FOLDMOTION_TEST_UNSAVED";

    #[test]
    fn a_scene_of_a_killed_process_is_offered_and_that_of_a_living_one_is_not() {
        if let Some(folder) = std::env::var_os(FOLDER) {
            let mut window = UnsavedScenes::in_folder(Path::new(&folder)).unwrap();
            window.keep(&edited(9)).unwrap();
            std::thread::sleep(Duration::from_mins(1));
        }
        let folder = tempfile::tempdir().unwrap();
        let name = "settings::unsaved::tests::a_scene_of_a_killed_process_is_offered_and_that_of_a_living_one_is_not";
        let mut other = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--exact", name])
            .env(FOLDER, folder.path())
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        let is_kept = || {
            let entries = std::fs::read_dir(folder.path()).unwrap();
            entries.flatten().any(|e| e.path().extension().is_some_and(|e| e == "json"))
        };
        while !is_kept() {
            assert!(other.try_wait().unwrap().is_none());
            std::thread::sleep(Duration::from_millis(10));
        }
        let offered = || UnsavedScenes::in_folder(folder.path()).unwrap().recovered().count();
        assert_eq!(offered(), 0);
        other.kill().unwrap();
        other.wait().unwrap();
        assert_eq!(offered(), 1);
    }

    #[test]
    fn ten_are_kept_and_what_is_discarded_is_gone() {
        let folder = tempfile::tempdir().unwrap();
        for k in 0..13 {
            let scene = UnsavedScene { time: k, ..UnsavedScene::of(&edited(9)) };
            let path = folder.path().join(format!("{k}.json"));
            std::fs::write(path, serde_json::to_string(&scene).unwrap()).unwrap();
        }
        std::fs::write(folder.path().join("broken.json"), "{").unwrap();
        let mut scenes = UnsavedScenes::in_folder(folder.path()).unwrap();
        let times: Vec<u64> = scenes.recovered().map(|scene| scene.time).collect();
        assert_eq!(times, (3..13).rev().collect::<Vec<_>>());
        scenes.discard(0);
        drop(scenes);
        assert_eq!(UnsavedScenes::in_folder(folder.path()).unwrap().recovered().count(), 9);
    }

    #[test]
    fn a_saved_or_untouched_scene_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut window = UnsavedScenes::in_folder(folder.path()).unwrap();
        window.keep(&Document::new()).unwrap();
        let mut document = edited(9);
        window.keep(&document).unwrap();
        assert_eq!(files(folder.path()), 2);
        document.undo();
        window.keep(&document).unwrap();
        assert_eq!(files(folder.path()), 0);
    }

    #[test]
    fn ages_are_given_in_the_largest_unit() {
        assert_eq!(
            [59, 60, 7300, 200_000].map(ago),
            ["a moment ago", "1 minute ago", "2 hours ago", "2 days ago"]
        );
    }
}
