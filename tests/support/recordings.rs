//! Files of recordings, and Rerun's tools for them.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// A tool from PyPI, such as `rerun-sdk` at the crate's version; `make test` installs it.
pub fn tool(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("target/venv/bin").join(name);
    assert!(path.exists(), "{} is missing; `make test` installs it", path.display());
    path
}

pub fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut found: Vec<_> = paths.filter(|path| path.extension().is_some_and(|found| found == ending)).collect();
    found.sort();
    found
}

/// The content of files, read with Rerun's own reader.
pub fn read(files: &[PathBuf]) -> Vec<Value> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/read_recording.py");
    let read = Command::new(tool("python")).arg(script).args(files).output().unwrap();
    assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
    serde_json::from_slice(&read.stdout).unwrap()
}
