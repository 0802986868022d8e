//! Files of others, read only if they are no larger than what they should hold.

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Why a file was not read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The disk, or no such file.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// Larger than what it should hold can be.
    #[error("it has {bytes} bytes, the limit is {most}")]
    TooLarge {
        /// Bytes of the file, as far as is known.
        bytes: u64,
        /// The limit.
        most: u64,
    },
}

/// The bytes of a file; nothing of one over `most` bytes is kept.
///
/// # Errors
/// [`ReadError`].
pub fn read_at_most(path: &Path, most: u64) -> Result<Vec<u8>, ReadError> {
    let file = File::open(path)?;
    let bytes = file.metadata()?.len();
    if bytes > most {
        return Err(ReadError::TooLarge { bytes, most });
    }
    // A device or a pipe says nothing of its length, and a file may grow.
    let mut read = Vec::with_capacity(bytes as usize);
    file.take(most + 1).read_to_end(&mut read)?;
    match read.len() as u64 {
        bytes if bytes > most => Err(ReadError::TooLarge { bytes, most }),
        _ => Ok(read),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_large_is_refused_unread() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        let read = || read_at_most(&path, 4);
        assert!(matches!(read(), Err(ReadError::Io(_))));
        std::fs::write(&path, "four").unwrap();
        assert_eq!(read().unwrap(), b"four");
        // Holes: more than the memory of this machine could be read.
        File::create(&path).unwrap().set_len(1 << 42).unwrap();
        assert!(matches!(read(), Err(ReadError::TooLarge { bytes, most: 4 }) if bytes == 1 << 42));
    }

    #[cfg(unix)]
    #[test]
    fn a_device_that_never_ends_is_refused_too() {
        let error = read_at_most(Path::new("/dev/zero"), 1 << 20).unwrap_err();
        assert!(matches!(error, ReadError::TooLarge { .. }), "{error}");
    }
}
