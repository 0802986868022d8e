//! Reads untrusted files up to a size limit, and replaces files as a whole.

pub mod open;

use std::fs::File;
use std::io::Read;
use std::path::Path;

#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file does not exist or could not be read.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// Larger than the limit.
    #[error("it has {bytes} bytes, the limit is {max}")]
    TooLarge {
        /// Size of the file, or the bytes read so far.
        bytes: u64,
        max: u64,
    },
}

/// The bytes of a file of at most `max` bytes.
///
/// # Errors
/// [`ReadError`].
pub fn read_at_most(path: &Path, max: u64) -> Result<Vec<u8>, ReadError> {
    let file = File::open(path)?;
    let bytes = file.metadata()?.len();
    if bytes > max {
        return Err(ReadError::TooLarge { bytes, max });
    }
    // A device or a pipe does not report its length, and a file may grow.
    let mut read = Vec::with_capacity(bytes as usize);
    file.take(max + 1).read_to_end(&mut read)?;
    match read.len() as u64 {
        bytes if bytes > max => Err(ReadError::TooLarge { bytes, max }),
        _ => Ok(read),
    }
}

/// Writes to a temporary name beside the file first, so that no reader finds half a file. Two writers of one file must
/// not run at the same time.
///
/// # Errors
/// The old file, if any, is unchanged.
pub fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let part = path.with_extension("part");
    let written = std::fs::write(&part, bytes).and_then(|()| std::fs::rename(&part, path));
    if written.is_err() {
        // Half a file on a full disk takes space.
        let _ = std::fs::remove_file(&part);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_a_large_file_without_reading_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        let read = || read_at_most(&path, 4);
        assert!(matches!(read(), Err(ReadError::Io(_))));
        std::fs::write(&path, "four").unwrap();
        assert_eq!(read().unwrap(), b"four");
        // A sparse file: larger than the memory of the machine.
        File::create(&path).unwrap().set_len(1 << 42).unwrap();
        assert!(matches!(read(), Err(ReadError::TooLarge { bytes, max: 4 }) if bytes == 1 << 42));
    }

    #[test]
    fn replaces_a_file_or_leaves_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file.json");
        replace(&path, b"one").unwrap();
        replace(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        std::fs::create_dir(folder.path().join("file.part")).unwrap();
        assert!(replace(&path, b"three").is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
    }

    #[cfg(unix)]
    #[test]
    fn refuses_an_endless_device() {
        let error = read_at_most(Path::new("/dev/zero"), 1 << 20).unwrap_err();
        assert!(matches!(error, ReadError::TooLarge { .. }), "{error}");
    }
}
