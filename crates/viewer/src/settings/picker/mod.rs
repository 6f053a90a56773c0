//! Choosing a file inside the window.

mod folder;
mod show;

#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use folder::Entry;

/// What became of a picker.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum PickerResult {
    /// This file was chosen; one to be saved may exist, the user was asked.
    File(PathBuf),
    /// None was.
    Cancelled,
}

/// A modal in which a file is chosen.
#[derive(Debug)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "what is asked of the next frame is a switch each"
)]
pub(crate) struct FilePicker {
    title: String,
    is_saving: bool,
    endings: Vec<&'static str>,
    folder: PathBuf,
    entries: Vec<Entry>,
    /// Those of the entries that what is typed leaves.
    shown: Vec<usize>,
    /// The name or path in the text field.
    typed: String,
    /// Which of the shown is selected.
    selected: Option<usize>,
    hidden: bool,
    /// Folders to go to: home and recent ones.
    bookmarks: Vec<(String, PathBuf)>,
    message: Option<String>,
    /// The file that exists and may be overwritten.
    overwrites: Option<PathBuf>,
    /// Whether the list is to be scrolled to the selected entry.
    scrolls: bool,
    /// Whether the text field is to be focused, its cursor at the end.
    focuses: bool,
}

impl FilePicker {
    /// Chooses a file to open, among those with one of the endings (without dots).
    pub(crate) fn open(
        title: &str,
        endings: &[&'static str],
        folder: &Path,
        recent: &[PathBuf],
    ) -> Self {
        Self::new(title, endings, folder, recent)
    }

    /// Chooses a file to write; a name without an ending gets the first of them.
    pub(crate) fn save(
        title: &str,
        endings: &[&'static str],
        folder: &Path,
        name: &str,
        recent: &[PathBuf],
    ) -> Self {
        let mut picker = Self::new(title, endings, folder, recent);
        picker.is_saving = true;
        name.clone_into(&mut picker.typed);
        picker
    }

    fn new(title: &str, endings: &[&'static str], folder: &Path, recent: &[PathBuf]) -> Self {
        let home = std::env::home_dir().map(|home| ("Home".to_owned(), home));
        let named = recent.iter().map(|folder| {
            let name = folder.file_name().unwrap_or(folder.as_os_str());
            (name.to_string_lossy().into_owned(), folder.clone())
        });
        let mut picker = Self {
            title: title.to_owned(),
            is_saving: false,
            endings: endings.to_vec(),
            folder: PathBuf::new(),
            entries: Vec::new(),
            shown: Vec::new(),
            typed: String::new(),
            selected: None,
            hidden: false,
            bookmarks: home.into_iter().chain(named).collect(),
            message: None,
            overwrites: None,
            scrolls: false,
            focuses: true,
        };
        picker.go(folder);
        picker
    }

    /// Shows another folder; one that cannot be read is shown empty, with the reason.
    fn go(&mut self, folder: &Path) {
        let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        self.folder = whole.canonicalize().unwrap_or(whole);
        if !self.is_saving {
            self.typed.clear();
        }
        self.focuses = true;
        self.read();
    }

    fn read(&mut self) {
        self.message = None;
        self.entries = match folder::read(&self.folder, &self.endings, self.hidden) {
            Ok(entries) => entries,
            Err(error) => {
                self.message = Some(format!(
                    "{}: cannot be read: {error}",
                    self.folder.display()
                ));
                Vec::new()
            }
        };
        self.filter();
    }

    /// Leaves those whose name has what is typed in it, while that is no path; what is to be saved leaves all.
    fn filter(&mut self) {
        let typed = self.typed.trim().to_lowercase();
        let all = self.is_saving || typed.contains(['/', '\\', '~']);
        let entries = self.entries.iter().enumerate();
        let fitting = entries.filter(|(_, e)| all || e.name.to_lowercase().contains(&typed));
        self.shown = fitting.map(|(index, _)| index).collect();
        let searches = !all && !typed.is_empty() && !self.shown.is_empty();
        self.selected = searches.then_some(0);
        self.scrolls = true;
    }

    fn up(&mut self) {
        let left = self.folder.clone();
        if let Some(parent) = left.parent() {
            self.go(parent);
            let entry = self
                .shown
                .iter()
                .position(|&index| self.entries[index].path == left);
            self.selected = entry;
        }
    }

    /// Moves the selection by some rows.
    fn step(&mut self, by: isize) {
        let Some(last) = self.shown.len().checked_sub(1) else {
            return;
        };
        self.selected = Some(match self.selected {
            None if by < 0 => last,
            None => 0,
            Some(row) => row.saturating_add_signed(by).min(last),
        });
        self.scrolls = true;
        self.name_selected();
    }

    /// What is to be saved takes the name of the selected file.
    fn name_selected(&mut self) {
        let entry = self.selected.and_then(|row| self.shown.get(row));
        if let Some(entry) = entry.map(|&index| &self.entries[index])
            && self.is_saving
            && !entry.is_folder
        {
            self.typed.clone_from(&entry.name);
            self.focuses = true;
        }
    }

    /// Completes what is typed as far as it can be told.
    fn complete(&mut self) {
        if let Some(completed) = folder::completed(&self.folder, &self.typed, &self.endings) {
            self.typed = completed;
            self.focuses = true;
            self.filter();
        }
    }

    /// Goes into the selected folder, or chooses the selected file; without one, does what is typed.
    fn enter(&mut self) -> Option<PickerResult> {
        let entry = self.selected.and_then(|row| self.shown.get(row)).copied();
        match entry.map(|index| self.entries[index].clone()) {
            Some(entry) if entry.is_folder => {
                self.go(&entry.path);
                None
            }
            Some(entry) if !self.is_saving => Some(PickerResult::File(entry.path)),
            _ => self.enter_typed(),
        }
    }

    fn enter_typed(&mut self) -> Option<PickerResult> {
        if self.typed.trim().is_empty() {
            self.message = Some("type a name, or select one".to_owned());
            return None;
        }
        let path = folder::resolve(&self.folder, &self.typed);
        if path.is_dir() {
            if self.is_saving {
                self.typed.clear();
            }
            self.go(&path);
            return None;
        }
        if self.is_saving {
            return self.enter_new(path);
        }
        if path.is_file() {
            return Some(PickerResult::File(path));
        }
        self.message = Some(format!("{}: there is no such file", path.display()));
        None
    }

    /// Chooses a file to be written, or asks first where it exists.
    fn enter_new(&mut self, mut path: PathBuf) -> Option<PickerResult> {
        if let (None, Some(ending)) = (path.extension(), self.endings.first()) {
            path.set_extension(ending);
        }
        if !folder::has_ending(&path, &self.endings) {
            let endings = self.endings.join(", .");
            self.message = Some(format!("the name must end in .{endings}"));
        } else if !path.parent().is_some_and(Path::is_dir) {
            self.message = Some(format!("{}: there is no such folder", path.display()));
        } else if path.exists() {
            self.overwrites = Some(path);
        } else {
            return Some(PickerResult::File(path));
        }
        None
    }
}
