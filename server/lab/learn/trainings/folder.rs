//! The files of a training: what was asked and how far it is (`training.json`), the map, the policy that it starts from,
//! the checkpoint, and the cells and frames of its value maps.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::frame::{Cells, Frame};
use super::query::TrainingQuery;
use super::stage::TrainingStage;
use crate::learn::checkpoint::CheckpointError;
use crate::learn::examine::Marks;
use crate::learn::point::Point;
use ferry_core::policy::PolicyError;
use ferry_files::replace;

const RECORD: &str = "training.json";
const MAP: &str = "map.svg";
const START: &str = "start.safetensors";
const CHECKPOINT: &str = "checkpoint";
const CELLS: &str = "cells";
const FRAMES: &str = "frames";

/// What is saved at each change of the stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    pub query: TrainingQuery,
    /// The session that started it.
    #[serde(default)]
    pub owner: Option<String>,
    pub updates_total: u64,
    pub stage: TrainingStage,
    pub elapsed_s: f64,
    pub points: Vec<Point>,
    pub examined: Option<Marks>,
    pub policy: Option<String>,
    /// Version of the reader of its map ([`ferry_core::map::READER`]).
    #[serde(default = "ferry_core::map::first_reader")]
    pub reader: u32,
}

impl Record {
    pub fn write(&self, folder: &Path) -> std::io::Result<()> {
        replace(&folder.join(RECORD), &serde_json::to_vec(self)?)
    }

    pub fn read(folder: &Path) -> std::io::Result<Self> {
        Ok(serde_json::from_slice(&std::fs::read(folder.join(RECORD))?)?)
    }
}

/// Makes the folder with all that a new training needs. The record comes last: a folder without one is no training.
pub fn create(folder: &Path, record: &Record, svg: &str, start: Option<&[u8]>) -> std::io::Result<()> {
    let written = std::fs::create_dir_all(folder).and_then(|()| {
        std::fs::write(folder.join(MAP), svg)?;
        start.map_or(Ok(()), |bytes| std::fs::write(folder.join(START), bytes))?;
        record.write(folder)
    });
    if written.is_err() {
        remove(folder);
    }
    written
}

pub fn remove(folder: &Path) {
    match std::fs::remove_dir_all(folder) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            tracing::warn!(%error, folder = %folder.display(), "a training's files could not be deleted");
        }
        _ => {}
    }
}

pub fn map(folder: &Path) -> std::io::Result<String> {
    std::fs::read_to_string(folder.join(MAP))
}

/// The policy that a training starts from.
pub fn start_bytes(folder: &Path) -> Result<Option<Vec<u8>>, PolicyError> {
    let path = folder.join(START);
    match std::fs::read(&path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(PolicyError::Io { path: path.display().to_string(), error }),
    }
}

pub fn checkpoint(folder: &Path) -> PathBuf {
    folder.join(CHECKPOINT)
}

/// After the end only the policy is needed.
pub fn forget_checkpoint(folder: &Path) {
    let _ = std::fs::remove_file(checkpoint(folder));
    let _ = std::fs::remove_file(folder.join(START));
}

fn written(frame: &Frame) -> std::io::Result<Vec<u8>> {
    let bytes = postcard::to_stdvec(frame).map_err(std::io::Error::other)?;
    Ok([&(bytes.len() as u32).to_le_bytes(), bytes.as_slice()].concat())
}

fn failed(path: PathBuf) -> impl Fn(std::io::Error) -> CheckpointError {
    move |error| CheckpointError::Io { path: path.clone(), error }
}

/// Replaces the cells and all frames.
pub fn write_history(folder: &Path, cells: &Cells, frames: &[Arc<Frame>]) -> Result<(), CheckpointError> {
    let path = folder.join(CELLS);
    let bytes = postcard::to_stdvec(cells).map_err(std::io::Error::other);
    bytes.and_then(|bytes| replace(&path, &bytes)).map_err(failed(path))?;
    let path = folder.join(FRAMES);
    let bytes = frames.iter().map(|frame| written(frame)).collect::<std::io::Result<Vec<_>>>();
    bytes.and_then(|bytes| replace(&path, &bytes.concat())).map_err(failed(path))
}

/// Adds a frame. One that is cut off by the end of the server is left out when they are read.
pub fn append_frame(folder: &Path, frame: &Frame) -> Result<(), CheckpointError> {
    let path = folder.join(FRAMES);
    let file = OpenOptions::new().append(true).create(true).open(&path);
    file.and_then(|mut file| file.write_all(&written(frame)?)).map_err(failed(path))
}

/// The cells and all whole frames.
pub fn read_history(folder: &Path) -> (Option<Cells>, Vec<Frame>) {
    let read = |name| std::fs::read(folder.join(name)).unwrap_or_default();
    let (cells, bytes) = (postcard::from_bytes(&read(CELLS)).ok(), read(FRAMES));
    let mut rest = bytes.as_slice();
    let mut frames = Vec::new();
    while let Some((length, after)) = rest.split_first_chunk() {
        let Some((bytes, after)) = after.split_at_checked(u32::from_le_bytes(*length) as usize) else { break };
        let Ok(frame) = postcard::from_bytes(bytes) else { break };
        frames.push(frame);
        rest = after;
    }
    (cells, frames)
}
