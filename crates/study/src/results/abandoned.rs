//! Temporary folders of processes that were killed.
//!
//! A process holds a lock in its temporary folder, which the system releases when the process ends. If the file system has no
//! locks, or the folder has no lock file, the process number in the name of the folder decides, on systems with `/proc`.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// The file in the folder that its process locks.
const LOCK: &str = ".lock";

/// The temporary folder of this process for the output folder `name` in `parent`.
pub(super) fn folder_of(parent: &Path, name: &str) -> PathBuf {
    parent.join(format!("{}{}", prefix(name), std::process::id()))
}

/// Locks `folder` until the returned file is dropped; `None` if the file system has no locks.
pub(super) fn lock(folder: &Path) -> Option<File> {
    let lock = File::create(folder.join(LOCK)).ok()?;
    lock.try_lock().ok().map(|()| lock)
}

/// Removes the temporary folders in `parent` that killed processes left for the output folder `name`.
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
            // A folder that cannot be removed is hidden and recognisable by its name.
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

/// Whether a process with this number may exist.
pub fn process_may_exist(process: u32) -> bool {
    let processes = Path::new("/proc");
    !processes.join("self").exists() || processes.join(process.to_string()).exists()
}
