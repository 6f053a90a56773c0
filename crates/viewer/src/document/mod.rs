//! The scene at hand: its text, its edits and their history, its file.

mod edit;
mod file;
mod history;

#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use foldmotion_study::{FIRST_SCENE, Scene, SceneSource, StudyError};

pub(crate) use file::{SaveError, write_whole};
use history::{History, Step};

/// What a scene is called before it has a file.
const UNTITLED: &str = "untitled.toml";

/// A scene that is being edited.
///
/// Its text is the truth: edits of the scene are written into it, and what it says is read back. While the text has an
/// error, the scene is the last that had none.
#[derive(Debug)]
pub(crate) struct Document {
    /// Names the scene; relative files that it names are beside this.
    location: PathBuf,
    /// Where it was last read or written; none for a new scene and one of a crease pattern.
    path: Option<PathBuf>,
    text: Arc<str>,
    /// The text as it was last read or written.
    saved: Arc<str>,
    scene: Scene,
    error: Option<StudyError>,
    history: History,
    revision: u64,
}

impl Document {
    /// A commented scene to start from, without a file.
    pub(crate) fn new() -> Self {
        Self::with(PathBuf::from(UNTITLED), None, FIRST_SCENE)
    }

    /// Opens a scene, or a crease pattern as the scene that names it. One with errors opens all the same.
    ///
    /// # Errors
    /// [`StudyError::Read`] for what cannot be read.
    pub(crate) fn open(path: &Path) -> Result<Self, StudyError> {
        file::check_readable(path)?;
        let source = SceneSource::read(path)?;
        if !SceneSource::is_pattern(path) {
            return Ok(Self::with(
                path.to_owned(),
                Some(path.to_owned()),
                source.text(),
            ));
        }
        let text = edit::edited("", &Scene::default(), &source.scene()?).unwrap_or_default();
        Ok(Self::with(path.to_owned(), None, &text))
    }

    /// A scene as it was left unsaved: `base` is what its file said. The restored text can be undone.
    pub(crate) fn restored(location: &Path, path: Option<&Path>, base: &str, text: &str) -> Self {
        let mut document = Self::with(location.to_owned(), path.map(Path::to_owned), base);
        document.replace_text(text.into(), "restored changes", false);
        document
    }

    fn with(location: PathBuf, path: Option<PathBuf>, text: &str) -> Self {
        let text: Arc<str> = text.into();
        let mut document = Self {
            location,
            path,
            text: text.clone(),
            saved: text,
            scene: Scene::default(),
            error: None,
            history: History::default(),
            revision: 0,
        };
        document.read_text();
        document
    }

    /// Its file, if it has one.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The file that it is named after: its own, the crease pattern it was made of, or one that does not exist yet.
    pub(crate) fn location(&self) -> &Path {
        &self.location
    }

    /// The name of the file, or `untitled.toml`.
    pub(crate) fn name(&self) -> String {
        let name = self.location.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    /// The folder that it lies in.
    pub(crate) fn folder(&self) -> PathBuf {
        file::folder_of(&self.location)
    }

    /// The name it is to be saved under, unless another is chosen.
    pub(crate) fn name_to_save(&self) -> String {
        let path = self.location.with_extension("toml");
        let name = path.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The text as it was last read or written.
    pub(crate) fn saved_text(&self) -> &str {
        &self.saved
    }

    /// The text with its location, ready to be resolved.
    pub(crate) fn source(&self) -> SceneSource {
        SceneSource::new(&self.location, self.text.to_string())
    }

    /// What the text says; while it has an error, what it last said.
    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What is wrong with the text.
    pub(crate) fn parse_error(&self) -> Option<&StudyError> {
        self.error.as_ref()
    }

    /// A number that changes with every text.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether the text differs from what was last read or written.
    pub(crate) fn is_modified(&self) -> bool {
        self.text != self.saved
    }

    /// How the scene names a file, so that it is found from where the scene lies.
    pub(crate) fn name_of(&self, path: &Path) -> String {
        file::relative_to(&self.folder(), path)
    }

    /// Makes the text say `scene`: only what differs is written. False, and nothing is changed, where the text has errors
    /// that the change does not mend.
    ///
    /// A change that `continues` the one before it, under the same label, is undone together with it.
    pub(crate) fn change(&mut self, scene: Scene, label: &str, continues: bool) -> bool {
        if self.error.is_none() && scene == self.scene {
            return true;
        }
        let Some(text) = edit::edited(&self.text, &self.scene, &scene) else {
            return false;
        };
        let says = SceneSource::new(&self.location, text.clone()).scene();
        if !says.is_ok_and(|says| says == scene) {
            return false;
        }
        self.record(text.into(), label, continues);
        self.scene = scene;
        self.error = None;
        true
    }

    /// Replaces the text, as edited by hand.
    pub(crate) fn set_text(&mut self, text: &str, continues: bool) {
        self.replace_text(text.into(), "text", continues);
    }

    /// The next change is undone by itself, even if it continues the last.
    pub(crate) fn end_step(&mut self) {
        self.history.end_step();
    }

    /// Takes the last change back; its label.
    pub(crate) fn undo(&mut self) -> Option<String> {
        let Step { label, before, .. } = self.history.undo()?.clone();
        self.set_current(before);
        Some(label)
    }

    /// Makes the last change that was taken back again; its label.
    pub(crate) fn redo(&mut self) -> Option<String> {
        let Step { label, after, .. } = self.history.redo()?.clone();
        self.set_current(after);
        Some(label)
    }

    /// The label of the change that [`Self::undo`] takes back.
    pub(crate) fn can_undo(&self) -> Option<&str> {
        self.history.last_done()
    }

    /// The label of the change that [`Self::redo`] makes again.
    pub(crate) fn can_redo(&self) -> Option<&str> {
        self.history.last_undone()
    }

    fn replace_text(&mut self, text: Arc<str>, label: &str, continues: bool) {
        if text != self.text {
            self.record(text, label, continues);
            self.read_text();
        }
    }

    fn record(&mut self, text: Arc<str>, label: &str, continues: bool) {
        let step = Step {
            label: label.to_owned(),
            before: self.text.clone(),
            after: text.clone(),
        };
        self.history.record(step, continues);
        self.text = text;
        self.revision += 1;
    }

    fn set_current(&mut self, text: Arc<str>) {
        self.text = text;
        self.revision += 1;
        self.read_text();
    }

    fn read_text(&mut self) {
        match self.source().scene() {
            Ok(scene) => {
                self.scene = scene;
                self.error = None;
            }
            Err(error) => self.error = Some(error),
        }
    }

    /// Whether the file says something else than when it was last read or written; a file that is gone does not.
    pub(crate) fn changed_on_disk(&self) -> bool {
        let path = self.path.as_deref();
        let on_disk = path.and_then(|path| std::fs::read(path).ok());
        on_disk.is_some_and(|bytes| bytes != self.saved.as_bytes())
    }

    /// Writes the text to its file.
    ///
    /// # Errors
    /// [`SaveError::NoFile`] without one, [`SaveError::Changed`] where another program has changed it since, and
    /// [`SaveError::Write`].
    pub(crate) fn save(&mut self) -> Result<(), SaveError> {
        if let Some(path) = &self.path
            && self.changed_on_disk()
        {
            return Err(SaveError::Changed { path: path.clone() });
        }
        self.save_over()
    }

    /// Writes the text to its file, whatever that says.
    ///
    /// # Errors
    /// [`SaveError::NoFile`], [`SaveError::Write`].
    pub(crate) fn save_over(&mut self) -> Result<(), SaveError> {
        let path = self.path.clone().ok_or(SaveError::NoFile)?;
        self.write(&path)
    }

    /// Writes the text to another file, which becomes its own. Relative files that it names are then named as they are
    /// seen from there, in everything that can be undone too.
    ///
    /// # Errors
    /// [`SaveError::Ending`] for the name of a crease pattern, [`SaveError::Write`]; the scene is then as before.
    pub(crate) fn save_as(&mut self, path: &Path) -> Result<(), SaveError> {
        if SceneSource::is_pattern(path) {
            return Err(SaveError::Ending {
                path: path.to_owned(),
            });
        }
        let (old, new) = (self.folder(), file::folder_of(path));
        let moved = |text: &str| moved_text(text, &old, &new);
        let text = moved(&self.text).unwrap_or_else(|| self.text.to_string());
        write(path, &text)?;
        self.history.rewrite(moved);
        path.clone_into(&mut self.location);
        self.path = Some(path.to_owned());
        self.saved = text.into();
        self.history.end_step();
        self.set_current(self.saved.clone());
        Ok(())
    }

    fn write(&mut self, path: &Path) -> Result<(), SaveError> {
        write(path, &self.text)?;
        self.saved = self.text.clone();
        self.history.end_step();
        Ok(())
    }

    /// Goes back to the text as it was last read or written; that can be undone.
    pub(crate) fn revert(&mut self) {
        self.replace_text(self.saved.clone(), "edits given up", false);
    }

    /// Reads its file again; that can be undone.
    ///
    /// # Errors
    /// [`StudyError::Read`].
    pub(crate) fn reload(&mut self) -> Result<(), StudyError> {
        let Some(path) = self.path.clone() else {
            return Ok(());
        };
        file::check_readable(&path)?;
        let source = SceneSource::read(&path)?;
        self.saved = source.text().into();
        self.replace_text(self.saved.clone(), "read again", false);
        Ok(())
    }
}

fn write(path: &Path, text: &str) -> Result<(), SaveError> {
    write_whole(path, text, true).map_err(|source| SaveError::Write {
        path: path.to_owned(),
        source,
    })
}

/// The text of a scene that moves from one folder to another; none where it names no file that must be named anew.
fn moved_text(text: &str, old: &Path, new: &Path) -> Option<String> {
    let scene = SceneSource::new(Path::new(UNTITLED), text.to_owned())
        .scene()
        .ok()?;
    let moved = file::moved(&scene, old, new);
    (moved != scene).then(|| edit::edited(text, &scene, &moved))?
}
