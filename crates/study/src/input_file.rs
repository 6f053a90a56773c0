//! Input files: only regular files are read, up to a size limit that is checked first.
//!
//! Reading a pipe could block, and reading a device might never end.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use crate::StudyError;

/// The largest scene and the largest crease pattern, bytes: 16 MiB.
pub(crate) const LARGEST_SCENE: u64 = 16 << 20;

/// Refuses a path that is not a regular file.
///
/// # Errors
/// [`StudyError::Read`].
pub fn require_file(path: &Path) -> Result<(), StudyError> {
    size(path).map(drop)
}

/// The size of a regular file in bytes.
pub(crate) fn size(path: &Path) -> Result<u64, StudyError> {
    let data = std::fs::metadata(path).map_err(|e| failed(path, e))?;
    if data.is_file() {
        return Ok(data.len());
    }
    let message = if data.is_dir() {
        "it is a folder; specify a file in it"
    } else {
        "it is a device or a pipe; only regular files are read"
    };
    Err(failed(path, io::Error::new(io::ErrorKind::InvalidInput, message)))
}

/// Opens a regular file of at most `limit` bytes; returns it with its size.
pub(crate) fn open(path: &Path, limit: u64) -> Result<(File, u64), StudyError> {
    let size = size(path)?;
    if size > limit {
        return Err(StudyError::LargeFile { path: path.to_owned(), size, limit });
    }
    Ok((File::open(path).map_err(|e| failed(path, e))?, size))
}

/// The content of a regular file of at most `limit` bytes.
pub(crate) fn read(path: &Path, limit: u64) -> Result<Vec<u8>, StudyError> {
    let (file, size) = open(path, limit)?;
    let mut bytes = Vec::new();
    // The file may grow while it is read.
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|e| failed(path, e))?;
    let found = bytes.len() as u64;
    if found > limit {
        return Err(StudyError::LargeFile { path: path.to_owned(), size: size.max(found), limit });
    }
    Ok(bytes)
}

/// The text of a regular file of at most `limit` bytes.
pub(crate) fn read_text(path: &Path, limit: u64) -> Result<String, StudyError> {
    String::from_utf8(read(path, limit)?).map_err(|e| {
        let before = &e.as_bytes()[..e.utf8_error().valid_up_to()];
        let line = String::from_utf8_lossy(before).matches('\n').count();
        let message = format!("line {} is not valid UTF-8", line + 1);
        failed(path, io::Error::new(io::ErrorKind::InvalidData, message))
    })
}

/// Whether a file was read but is not UTF-8.
pub(crate) fn is_not_text(error: &StudyError) -> bool {
    matches!(error, StudyError::Read { source, .. } if source.kind() == io::ErrorKind::InvalidData)
}

fn failed(path: &Path, source: io::Error) -> StudyError {
    StudyError::Read { path: path.to_owned(), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_above_the_limit_are_refused_with_their_size() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("a.toml");
        std::fs::write(&path, "12345").unwrap();
        assert_eq!(read_text(&path, 5).unwrap(), "12345");
        let error = read(&path, 4).unwrap_err();
        assert_eq!(error.status(), 2);
        assert!(error.to_string().contains("5 bytes"), "{error}");
        std::fs::write(&path, b"a\nb\xff").unwrap();
        let error = read_text(&path, 5).unwrap_err().to_string();
        assert!(error.contains("line 2"), "{error}");
    }

    #[test]
    fn folders_and_devices_are_refused_before_they_are_opened() {
        let home = tempfile::tempdir().unwrap();
        let error = read(home.path(), 5).unwrap_err();
        assert!(error.to_string().contains("folder"), "{error}");
        #[cfg(unix)]
        for device in ["/dev/zero", "/dev/urandom", "/dev/null"] {
            let error = read(Path::new(device), 5).unwrap_err();
            assert_eq!(error.status(), 2);
            assert!(error.to_string().contains("device"), "{error}");
        }
    }
}
