//! The contents of a folder.

use std::io;
use std::path::{Path, PathBuf};

/// The largest number of entries that are read.
const MAX_COUNT: usize = 200_000;

/// A folder, or a file that can be chosen.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) path: PathBuf,
    pub(super) is_folder: bool,
}

/// The folders, then the files with one of the extensions, sorted by name.
///
/// # Errors
/// If the folder cannot be read.
pub(super) fn read(folder: &Path, endings: &[&str], hidden: bool) -> io::Result<Vec<Entry>> {
    let entries = std::fs::read_dir(folder)?.take(MAX_COUNT);
    let entries = entries.filter_map(Result::ok).filter_map(|entry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = entry.path();
        let kind = entry.file_type().ok()?;
        // A symbolic link counts as what it points to.
        let is_folder = kind.is_dir() || (kind.is_symlink() && path.is_dir());
        let shown = hidden || !name.starts_with('.');
        let fits = is_folder || has_ending(&path, endings);
        (shown && fits).then_some(Entry { name, path, is_folder })
    });
    let mut entries: Vec<Entry> = entries.collect();
    entries.sort_by_cached_key(|e| (!e.is_folder, e.name.to_lowercase(), e.name.clone()));
    Ok(entries)
}

/// Whether a path has one of the extensions; true if there are none.
pub(super) fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let own = path.extension().and_then(|e| e.to_str());
    endings.is_empty() || endings.iter().any(|e| own.is_some_and(|own| own.eq_ignore_ascii_case(e)))
}

/// The path that was typed: absolute, relative to the home folder (`~/`), or relative to `folder`.
pub(super) fn resolve(folder: &Path, typed: &str) -> PathBuf {
    let typed = typed.trim();
    if let Some(rest) = typed.strip_prefix('~')
        && (rest.is_empty() || rest.starts_with(['/', '\\']))
        && let Some(home) = std::env::home_dir()
    {
        return home.join(rest.trim_start_matches(['/', '\\']));
    }
    folder.join(typed)
}

/// The typed path, extended by what all entries that begin with it have in common; `None` if there are none.
pub(super) fn completed(folder: &Path, typed: &str, endings: &[&str]) -> Option<String> {
    let split = typed.rfind(['/', '\\']).map_or(0, |at| at + 1);
    let (way, begun) = typed.split_at(split);
    let entries = read(&resolve(folder, way), endings, begun.starts_with('.')).ok()?;
    let alike = |e: &&Entry| e.name.starts_with(begun);
    let mut found: Vec<&Entry> = entries.iter().filter(alike).collect();
    if found.is_empty() {
        let begun = begun.to_lowercase();
        found = entries.iter().filter(|e| e.name.to_lowercase().starts_with(&begun)).collect();
    }
    let first = found.first()?;
    let common = found.iter().fold(first.name.as_str(), |common, e| {
        let pairs = common.char_indices().zip(e.name.chars());
        let end = pairs.take_while(|((_, a), b)| a == b).last();
        &common[..end.map_or(0, |((at, c), _)| at + c.len_utf8())]
    });
    let whole = found.len() == 1 && first.is_folder;
    let common = if common.len() < begun.len() { begun } else { common };
    Some(format!("{way}{common}{}", if whole { "/" } else { "" }))
}
