//! The document: the text of a scene, its undo history and its file.

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

/// The name of a scene without a file.
const UNTITLED: &str = "untitled.toml";

/// A scene that is being edited.
///
/// The text is authoritative: edits of the scene are written into the text, and the scene is parsed from it. While the
/// text has an error, `scene` is the last valid one.
#[derive(Debug)]
pub(crate) struct Document {
    /// The path that names the scene and that relative paths in it refer to.
    location: PathBuf,
    /// The file it was last read from or written to; `None` for a new scene and for one made from a crease pattern.
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
    /// A new scene with explanatory comments and without a file.
    pub(crate) fn new() -> Self {
        Self::with(PathBuf::from(UNTITLED), None, FIRST_SCENE)
    }

    /// Opens a scene, or makes a scene that names a crease pattern. A scene with errors is opened too.
    ///
    /// # Errors
    /// [`StudyError::Read`] if the file cannot be read.
    pub(crate) fn open(path: &Path) -> Result<Self, StudyError> {
        file::check_readable(path)?;
        let source = SceneSource::read(path)?;
        if !SceneSource::is_pattern(path) {
            return Ok(Self::with(path.to_owned(), Some(path.to_owned()), source.text()));
        }
        let text = edit::edited("", &Scene::default(), &source.scene()?).unwrap_or_default();
        Ok(Self::with(path.to_owned(), None, &text))
    }

    /// A recovered scene; `base` is the text of its file. Restoring can be undone.
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

    /// The path that it is named after: its file, the crease pattern that it was made from, or a file that does not
    /// exist yet.
    pub(crate) fn location(&self) -> &Path {
        &self.location
    }

    /// The file name, or `untitled.toml`.
    pub(crate) fn name(&self) -> String {
        let name = self.location.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    /// The folder that relative paths refer to.
    pub(crate) fn folder(&self) -> PathBuf {
        file::folder_of(&self.location)
    }

    /// The file name that is suggested when saving.
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

    /// The text with its path, ready to be resolved.
    pub(crate) fn source(&self) -> SceneSource {
        SceneSource::new(&self.location, self.text.to_string())
    }

    /// The scene that the text means; while the text has an error, the last valid scene.
    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The error in the text, if there is one.
    pub(crate) fn parse_error(&self) -> Option<&StudyError> {
        self.error.as_ref()
    }

    /// A number that increases with every change of the text.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether the text differs from what was last read or written.
    pub(crate) fn is_modified(&self) -> bool {
        self.text != self.saved
    }

    /// The path under which the scene names a file.
    pub(crate) fn name_of(&self, path: &Path) -> String {
        file::relative_to(&self.folder(), path)
    }

    /// Edits the text so that it means `scene`, writing only the differences. Returns false and changes nothing if the
    /// text has errors that the change does not correct.
    ///
    /// A change that `continues` the last one with the same label is undone together with it.
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

    /// Ends the current undo step, even if the next change continues it.
    pub(crate) fn end_step(&mut self) {
        self.history.end_step();
    }

    /// Undoes the last change and returns its label.
    pub(crate) fn undo(&mut self) -> Option<String> {
        let Step { label, before, .. } = self.history.undo()?.clone();
        self.set_current(before);
        Some(label)
    }

    /// Redoes the last change that was undone and returns its label.
    pub(crate) fn redo(&mut self) -> Option<String> {
        let Step { label, after, .. } = self.history.redo()?.clone();
        self.set_current(after);
        Some(label)
    }

    /// The label of the change that [`Self::undo`] would undo.
    pub(crate) fn can_undo(&self) -> Option<&str> {
        self.history.last_done()
    }

    /// The label of the change that [`Self::redo`] would redo.
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
        let step = Step { label: label.to_owned(), before: self.text.clone(), after: text.clone() };
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

    /// Whether the content of the file has changed since it was last read or written; false if the file is gone.
    pub(crate) fn changed_on_disk(&self) -> bool {
        let path = self.path.as_deref();
        let on_disk = path.and_then(|path| std::fs::read(path).ok());
        on_disk.is_some_and(|bytes| bytes != self.saved.as_bytes())
    }

    /// Writes the text to its file.
    ///
    /// # Errors
    /// [`SaveError::NoFile`] without a file, [`SaveError::Changed`] if another program has changed it, and
    /// [`SaveError::Write`].
    pub(crate) fn save(&mut self) -> Result<(), SaveError> {
        if let Some(path) = &self.path
            && self.changed_on_disk()
        {
            return Err(SaveError::Changed { path: path.clone() });
        }
        self.save_over()
    }

    /// Writes the text to its file, even if another program has changed it.
    ///
    /// # Errors
    /// [`SaveError::NoFile`] and [`SaveError::Write`].
    pub(crate) fn save_over(&mut self) -> Result<(), SaveError> {
        let path = self.path.clone().ok_or(SaveError::NoFile)?;
        self.write(&path)
    }

    /// Writes the text to another file, which becomes its file. Relative paths are rewritten to refer to the new
    /// folder, also in the undo history.
    ///
    /// # Errors
    /// [`SaveError::Ending`] for the file name of a crease pattern and [`SaveError::Write`]; the scene is then
    /// unchanged.
    pub(crate) fn save_as(&mut self, path: &Path) -> Result<(), SaveError> {
        if SceneSource::is_pattern(path) {
            return Err(SaveError::Ending { path: path.to_owned() });
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

    /// Returns to the text as it was last read or written; this can be undone.
    pub(crate) fn revert(&mut self) {
        self.replace_text(self.saved.clone(), "discarded edits", false);
    }

    /// Reads its file again; this can be undone.
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
        self.replace_text(self.saved.clone(), "reload", false);
        Ok(())
    }
}

fn write(path: &Path, text: &str) -> Result<(), SaveError> {
    write_whole(path, text, true)
        .map_err(|source| SaveError::Write { path: path.to_owned(), source })
}

/// The text of a scene that moves from one folder to another; `None` if no path in it changes.
fn moved_text(text: &str, old: &Path, new: &Path) -> Option<String> {
    let scene = SceneSource::new(Path::new(UNTITLED), text.to_owned()).scene().ok()?;
    let moved = file::moved(&scene, old, new);
    (moved != scene).then(|| edit::edited(text, &scene, &moved))?
}
