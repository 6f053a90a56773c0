//! A file picker inside the window. It is our own because it must work on a bare X server and in headless tests: rfd
//! needs a desktop portal or GTK on Linux, and egui-file-dialog (0.15) is made for an older egui than ours.

mod folder;
mod show;

#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use folder::Entry;

/// The result of a file picker.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum PickerResult {
    /// The chosen file. If it is for saving and exists, the user has agreed to overwrite it.
    File(PathBuf),
    Cancelled,
}

/// A modal dialog for choosing a file.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent flags")]
pub(crate) struct FilePicker {
    title: String,
    is_saving: bool,
    endings: Vec<&'static str>,
    folder: PathBuf,
    entries: Vec<Entry>,
    /// Indices of the entries that match the typed text.
    shown: Vec<usize>,
    /// The name or path in the text field.
    typed: String,
    /// The selected row of the shown entries.
    selected: Option<usize>,
    hidden: bool,
    /// Named folders to jump to: the home folder and recent folders.
    bookmarks: Vec<(String, PathBuf)>,
    message: Option<String>,
    /// The existing file that the user is asked about overwriting.
    overwrites: Option<PathBuf>,
    /// Whether to scroll the list to the selected entry in the next frame.
    scrolls: bool,
    /// Whether to focus the text field in the next frame, with the cursor at the end.
    focuses: bool,
}

impl FilePicker {
    /// Chooses a file to write; a name without an extension gets the first one.
    pub(crate) fn save(
        title: &str,
        endings: &[&'static str],
        folder: &Path,
        name: &str,
        recent: &[PathBuf],
    ) -> Self {
        let mut picker = Self::open(title, endings, folder, recent);
        picker.is_saving = true;
        name.clone_into(&mut picker.typed);
        picker
    }

    /// Chooses an existing file with one of the extensions (without dots).
    pub(crate) fn open(
        title: &str,
        endings: &[&'static str],
        folder: &Path,
        recent: &[PathBuf],
    ) -> Self {
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

    /// Shows another folder. If it cannot be read, the list is empty and a message says why.
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
                self.message = Some(format!("{}: cannot be read: {error}", self.folder.display()));
                Vec::new()
            }
        };
        self.filter();
    }

    /// Shows the entries whose name contains the typed text, or all entries if the text is a path or the picker is for
    /// saving.
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
            let entry = self.shown.iter().position(|&index| self.entries[index].path == left);
            self.selected = entry;
        }
    }

    /// Moves the selection by a number of rows.
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

    /// Copies the name of the selected file into the text field when saving.
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

    /// Completes the typed text as far as it is unambiguous.
    fn complete(&mut self) {
        if let Some(completed) = folder::completed(&self.folder, &self.typed, &self.endings) {
            self.typed = completed;
            self.focuses = true;
            self.filter();
        }
    }

    /// Opens the selected folder or chooses the selected file; without a selection, uses the typed text.
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
            self.message = Some("Type a name or select one.".to_owned());
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
        self.message = Some(format!("{}: file not found", path.display()));
        None
    }

    /// Chooses a file to write, or asks first if it exists.
    fn enter_new(&mut self, mut path: PathBuf) -> Option<PickerResult> {
        if let (None, Some(ending)) = (path.extension(), self.endings.first()) {
            path.set_extension(ending);
        }
        if !folder::has_ending(&path, &self.endings) {
            let endings = self.endings.join(", .");
            self.message = Some(format!("The name must end in .{endings}"));
        } else if !path.parent().is_some_and(Path::is_dir) {
            self.message = Some(format!("{}: folder not found", path.display()));
        } else if path.exists() {
            self.overwrites = Some(path);
        } else {
            return Some(PickerResult::File(path));
        }
        None
    }
}
