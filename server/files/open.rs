//! What a user names: something shipped by its name, or a file by its path.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use crate::{ReadError, read_at_most};
use ferry_core::map::{MAX_SVG_BYTES, Map, MapError, check_format, decoded};
use ferry_core::policy::{MAX_BYTES, Policy, PolicyError};
use ferry_core::scenario::{Shipped, ShippedError};
use ferry_core::trial::{Arena, Case, InputLog, LogError, LoggedMap};

/// Largest file of a case; an hour of dragging needs a tenth of it.
const CASE_BYTES_MOST: u64 = 64 << 20;
/// Largest file of a log.
const LOG_BYTES_MOST: u64 = 1 << 30;

/// A shipped map by name, or a file by its path. No name has a dot or a slash.
///
/// # Errors
/// [`MapError`].
pub fn map(name_or_path: &str) -> Result<Map, MapError> {
    let path = Path::new(name_or_path);
    let shipped = Map::shipped(name_or_path);
    if shipped.is_ok() || !(name_or_path.contains(['.', '/']) || path.is_file()) {
        return shipped;
    }
    let unreadable = |error| MapError::Io { path: name_or_path.to_owned(), error };
    if path.is_file() {
        // Another format is named also where the file is too large.
        let mut head = Vec::new();
        File::open(path).and_then(|file| file.take(16).read_to_end(&mut head)).map_err(unreadable)?;
        check_format(&head)?;
    }
    let bytes = read_at_most(path, MAX_SVG_BYTES as u64).map_err(|error| match error {
        ReadError::Io(error) => unreadable(error),
        ReadError::TooLarge { bytes, .. } => MapError::TooLarge { bytes: bytes as usize },
    })?;
    let name = path.file_stem().map_or("map".into(), |stem| stem.to_string_lossy());
    Map::from_svg(&name, &decoded(&bytes)?)
}

/// The same, prepared for trials.
///
/// # Errors
/// [`MapError`].
pub fn arena(name_or_path: &str) -> Result<Arc<Arena>, MapError> {
    Ok(Arena::of(map(name_or_path)?))
}

/// The arena of a case: that of its drawing, or else of the map that its scenario names.
///
/// # Errors
/// [`MapError`].
pub fn arena_of(case: &Case) -> Result<Arc<Arena>, MapError> {
    case.map.as_ref().map_or_else(|| arena(&case.scenario.map), LoggedMap::arena)
}

/// A policy's file.
///
/// # Errors
/// [`PolicyError`]. A file over 16 MiB is not read.
pub fn policy(path: &Path) -> Result<Policy, PolicyError> {
    let read = read_at_most(path, MAX_BYTES).map_err(|error| match error {
        ReadError::Io(error) => PolicyError::Io { path: path.display().to_string(), error },
        ReadError::TooLarge { bytes, .. } => PolicyError::TooLarge { bytes },
    })?;
    Policy::from_bytes(&read)
}

/// A shipped scenario by name, or a case's file when `name_or_path` ends in `.json`.
///
/// # Errors
/// [`ShippedError`].
pub fn case(name_or_path: &str) -> Result<Case, ShippedError> {
    if !name_or_path.ends_with(".json") {
        let Shipped { about, scenario } = Shipped::open(name_or_path)?;
        return Ok(Case { about, scenario, map: None, inputs: Vec::new(), expect: None });
    }
    let unreadable = |reason: String| ShippedError::Unreadable { path: name_or_path.to_owned(), reason };
    let bytes =
        read_at_most(Path::new(name_or_path), CASE_BYTES_MOST).map_err(|error| unreadable(error.to_string()))?;
    Case::from_json(&bytes).map_err(|error| unreadable(error.to_string()))
}

/// An input log's file.
///
/// # Errors
/// [`LogError`]. A file over 1 GiB is not read.
pub fn log(path: &Path) -> Result<InputLog, LogError> {
    log_at_most(path, LOG_BYTES_MOST)
}

/// The same with another limit.
///
/// # Errors
/// [`LogError`].
pub fn log_at_most(path: &Path, bytes_most: u64) -> Result<InputLog, LogError> {
    let read = read_at_most(path, bytes_most).map_err(|error| match error {
        ReadError::Io(error) => LogError::Io(error),
        ReadError::TooLarge { bytes, max } => LogError::TooLarge { bytes, max },
    })?;
    InputLog::read(&read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_file_is_refused_without_reading_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large");
        // A sparse file: larger than the memory of the machine.
        for large in [MAX_BYTES + 1, 1 << 42] {
            File::create(&path).unwrap().set_len(large).unwrap();
            let found = policy(&path);
            assert!(matches!(found, Err(PolicyError::TooLarge { bytes }) if bytes == large), "{found:?}");
        }
        assert!(matches!(log(&path), Err(LogError::TooLarge { bytes, .. }) if bytes == 1 << 42));
        File::create(&path).unwrap().set_len(MAX_BYTES).unwrap();
        assert!(matches!(policy(&path), Err(PolicyError::Format(_))), "the file is read but empty");
        let missing = policy(&folder.path().join("none")).unwrap_err().to_string();
        assert!(missing.contains("none"), "{missing}");
    }

    #[cfg(unix)]
    #[test]
    fn an_endless_device_is_refused() {
        let error = policy(Path::new("/dev/zero")).unwrap_err();
        assert!(matches!(error, PolicyError::TooLarge { .. }), "{error}");
    }
}
