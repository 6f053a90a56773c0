//! Folders of results that were never finished, because their process was killed.
//!
//! A process holds a lock in its folder, which ends with it however it ends. Where the disk knows no locks, or the folder
//! has none, the number of the process in the folder's name decides, where the system tells which processes there are.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// The file in the folder that its process locks.
const LOCK: &str = ".lock";

/// The folder of this process for results called `name`, in `parent`.
pub(super) fn folder_of(parent: &Path, name: &str) -> PathBuf {
    parent.join(format!("{}{}", prefix(name), std::process::id()))
}

/// Says that this process works in `folder`, as long as the answer lives; nothing where the disk knows no locks.
pub(super) fn lock(folder: &Path) -> Option<File> {
    let lock = File::create(folder.join(LOCK)).ok()?;
    lock.try_lock().ok().map(|()| lock)
}

/// Removes what killed processes left in `parent` of results called `name`.
pub(super) fn remove(parent: &Path, name: &str) {
    let prefix = prefix(name);
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        let file_name = entry.file_name();
        let number = file_name.to_str().and_then(|n| n.strip_prefix(&prefix));
        let process = number.and_then(|n| n.parse().ok());
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if let (Some(process), true) = (process, is_folder)
            && is_abandoned(&entry.path(), process)
        {
            // What cannot be removed is a hidden folder that says what it is.
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

fn prefix(name: &str) -> String {
    format!(".{name}.partial-")
}

fn is_abandoned(folder: &Path, process: u32) -> bool {
    match File::open(folder.join(LOCK)).map(|lock| lock.try_lock()) {
        Ok(Ok(())) => true,
        Ok(Err(TryLockError::WouldBlock)) => false,
        Ok(Err(TryLockError::Error(_))) | Err(_) => !process_may_exist(process),
    }
}

/// Whether there may be a process of this number.
pub fn process_may_exist(process: u32) -> bool {
    let processes = Path::new("/proc");
    !processes.join("self").exists() || processes.join(process.to_string()).exists()
}
