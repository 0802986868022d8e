//! Files from which a training run resumes.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    #[error("checkpoint: {path}: {error}")]
    Io { path: PathBuf, error: std::io::Error },
    /// A checkpoint is damaged, or has another version, recipe, seed or map.
    #[error("checkpoint: {path}: {reason}")]
    Refused { path: PathBuf, reason: String },
}

impl CheckpointError {
    pub fn refused(path: &Path, reason: impl Into<String>) -> Self {
        Self::Refused { path: path.to_owned(), reason: reason.into() }
    }
}

/// Which settings of a kept recipe differ from the wanted one; `None` if all are equal.
pub fn differences<R: Serialize + PartialEq>(kept: &R, wanted: &R) -> Option<String> {
    fn list(name: &str, kept: &Value, wanted: &Value, found: &mut Vec<String>) {
        match (kept, wanted) {
            (Value::Object(kept), Value::Object(wanted)) => {
                let inside = |field: &String| if name.is_empty() { field.clone() } else { format!("{name}.{field}") };
                kept.iter().for_each(|(field, value)| list(&inside(field), value, &wanted[field], found));
            }
            _ if kept == wanted => {}
            _ => found.push(format!("{name} is {kept} there and {wanted} now")),
        }
    }
    let value = |recipe: &R| serde_json::to_value(recipe).unwrap_or_default();
    let mut found = Vec::new();
    list("", &value(kept), &value(wanted), &mut found);
    (kept != wanted).then(|| format!("it has another recipe: {}", found.join(", ")))
}

/// Saves a run and `spent_s`, the seconds that it took so far. Writes to a temporary name first, so that no reader finds
/// half a file.
///
/// # Errors
/// [`CheckpointError::Io`].
pub fn write(path: &Path, version: u32, spent_s: f64, run: &impl Serialize) -> Result<(), CheckpointError> {
    let io = |error| CheckpointError::Io { path: path.to_owned(), error };
    let bytes = postcard::to_stdvec(&(version, spent_s, run)).map_err(std::io::Error::other).map_err(io)?;
    let hash = xxhash_rust::xxh3::xxh3_64(&bytes).to_le_bytes();
    let part = path.with_extension("part");
    let written = File::create(&part).and_then(|mut file| {
        file.write_all(&hash)?;
        file.write_all(&bytes)?;
        file.sync_all()?;
        std::fs::rename(&part, path)
    });
    if written.is_err() {
        // Half a file on a full disk takes space.
        let _ = std::fs::remove_file(&part);
    }
    written.map_err(io)
}

/// Reads a run and the seconds that it took.
///
/// # Errors
/// [`CheckpointError`].
pub fn read<T: DeserializeOwned>(path: &Path, version: u32) -> Result<(T, f64), CheckpointError> {
    let bytes = std::fs::read(path).map_err(|error| CheckpointError::Io { path: path.to_owned(), error })?;
    let refuse = |reason: &str| CheckpointError::refused(path, reason);
    let (hash, bytes) = bytes.split_at_checked(8).ok_or_else(|| refuse("it is damaged"))?;
    if xxhash_rust::xxh3::xxh3_64(bytes).to_le_bytes() != hash {
        return Err(refuse("it is damaged or edited"));
    }
    let (found, rest): (u32, _) = postcard::take_from_bytes(bytes).map_err(|_| refuse("it is damaged"))?;
    if found != version {
        return Err(refuse(&format!("its version is {found}, expected {version}")));
    }
    let (spent_s, run) = postcard::from_bytes(rest).map_err(|error| refuse(&error.to_string()))?;
    Ok((run, spent_s))
}
