//! Recently opened or saved files.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// The largest number of files that are kept.
const MAX_COUNT: usize = 10;

/// Files that were opened or saved, without duplicates, the latest first.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct RecentFiles(Vec<String>);

impl RecentFiles {
    /// Puts a file first. A path that is not Unicode is not kept.
    pub(crate) fn add(&mut self, path: &Path) {
        let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let Some(path) = path.to_str() else { return };
        self.0.retain(|other| other != path);
        self.0.insert(0, path.to_owned());
        self.0.truncate(MAX_COUNT);
    }

    /// The files that exist, then the others, each group with the latest first. This accesses the disk, so do not call
    /// it in every frame.
    pub(crate) fn existing_first(&self) -> Vec<(PathBuf, bool)> {
        let files = self.0.iter().take(MAX_COUNT).map(PathBuf::from);
        let mut files: Vec<_> = files.map(|path| (path.clone(), path.exists())).collect();
        files.sort_by_key(|(_, exists)| !exists);
        files
    }

    /// The folders of the files, without duplicates.
    pub(crate) fn folders(&self) -> Vec<PathBuf> {
        let mut folders: Vec<PathBuf> = Vec::new();
        for path in self.0.iter().take(MAX_COUNT) {
            if let Some(folder) = Path::new(path).parent()
                && !folders.iter().any(|other| other == folder)
            {
                folders.push(folder.to_owned());
            }
        }
        folders
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_latest_come_first_each_once_ten_at_most_existing_ones_before_others() {
        let folder = tempfile::tempdir().unwrap();
        let file = |k: usize| folder.path().join(format!("{k}.toml"));
        let mut recent = RecentFiles::default();
        for k in 0..12 {
            std::fs::write(file(k), "").unwrap();
            recent.add(&file(k));
        }
        recent.add(&folder.path().join("./5.toml"));
        assert_eq!(recent.0.len(), MAX_COUNT);
        assert!(recent.0[0].ends_with("5.toml") && recent.0[1].ends_with("11.toml"));
        std::fs::remove_file(file(5)).unwrap();
        let files = recent.existing_first();
        assert!(files[0].0.ends_with("11.toml") && files[0].1);
        assert!(files[9].0.ends_with("5.toml") && !files[9].1);
        assert_eq!(recent.folders().len(), 1);
    }
}
