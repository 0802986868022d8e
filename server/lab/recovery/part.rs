//! The file of a shard of a recovery map, and the whole map from all files.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::findings::Cell;
use super::{Findings, Recovery, Spot, Subject, Tried};
use crate::evaluate::{Machine, MergeError, PartError, Piece, Shard, check_all, read_part};

/// Format of a shard's file.
const FORMAT: u32 = 1;

#[derive(Deserialize)]
struct Head {
    ferry_recovery_part: u32,
}

/// A trial that has ended: its cell, controller and repeat, by index.
#[derive(Debug, Serialize, Deserialize)]
struct Ended(usize, usize, usize, Tried);

/// The trials of a shard, as a file.
#[derive(Debug, Serialize, Deserialize)]
pub struct RecoveryPart {
    ferry_recovery_part: u32,
    shard: Shard,
    machine: Machine,
    subject: Subject,
    /// Each with its number.
    cells: Vec<(Spot, u64)>,
    room_m2: Option<f64>,
    trials: Vec<Ended>,
}

impl RecoveryPart {
    /// The trials of a shard, after [`Recovery::run`].
    ///
    /// # Errors
    /// [`PartError::Build`], [`PartError::Trial`].
    pub fn of(recovery: &Recovery, shard: Shard, adapter: &str, findings: &Findings) -> Result<Self, PartError> {
        let trials = findings.cells.iter().enumerate().flat_map(|(cell, found)| {
            found.tries.iter().enumerate().flat_map(move |(controller, tries)| {
                let ended = tries.iter().enumerate().filter_map(|(repeat, tried)| Some((repeat, (*tried)?)));
                ended.map(move |(repeat, tried)| Ended(cell, controller, repeat, tried))
            })
        });
        Ok(Self {
            ferry_recovery_part: FORMAT,
            shard,
            machine: Machine::this(adapter)?,
            subject: recovery.subject()?,
            room_m2: findings.room_m2,
            cells: findings.cells.iter().map(|cell| (cell.spot, cell.number)).collect(),
            trials: trials.collect(),
        })
    }

    /// # Errors
    /// [`PartError::Foreign`], [`PartError::Format`], [`PartError::Setting`].
    pub fn read(bytes: &[u8]) -> Result<Self, PartError> {
        let Head { ferry_recovery_part: found } = serde_json::from_slice(bytes)?;
        if found != FORMAT {
            return Err(PartError::Format { field: "ferry_recovery_part", found, reads: FORMAT });
        }
        let part: Self = read_part(bytes)?;
        let (named, asked) = (part.subject.controllers.len(), part.subject.query.controllers.len());
        if named != asked {
            let reason = format!("subject.controllers has {named} entries, but subject.query.controllers {asked}");
            return Err(PartError::Setting(reason));
        }
        part.subject.query.check(true).map_err(|error| PartError::Setting(error.to_string()))?;
        Ok(part)
    }

    /// Whether these bytes say that they are the file of a shard of a recovery map.
    pub fn is_named_in(bytes: &[u8]) -> bool {
        serde_json::from_slice::<Head>(bytes).is_ok()
    }

    /// Number of trials of the whole map.
    fn whole(&self) -> usize {
        let cells = self.cells.len().saturating_mul(self.subject.query.controllers.len());
        cells.saturating_mul(self.subject.query.repeats as usize)
    }
}

impl Piece for RecoveryPart {
    fn shard(&self) -> Shard {
        self.shard
    }

    fn common(&self) -> Value {
        serde_json::json!({ "machine": self.machine, "subject": self.subject, "cells": self.cells, "room_m2": self.room_m2 })
    }

    fn is_whole(&self) -> bool {
        self.trials.len() == self.shard.share(self.whole())
    }
}

/// A whole recovery map.
#[derive(Debug)]
pub struct MergedRecovery {
    pub adapter: String,
    pub subject: Subject,
    pub findings: Findings,
}

/// Merges all shards of a recovery map, each with the name of its file.
///
/// # Errors
/// [`MergeError`].
pub fn merge_recovery(parts: Vec<(String, RecoveryPart)>) -> Result<MergedRecovery, MergeError> {
    let first = check_all(&parts)?;
    let (adapter, subject, whole) = (first.machine.adapter.clone(), first.subject.clone(), first.whole());
    let (controllers, repeats) = (subject.query.controllers.len(), subject.query.repeats);
    let cells = first.cells.iter().map(|&(spot, number)| Cell::new(spot, number, controllers, repeats)).collect();
    let mut findings = Findings { cells, done: whole, planned: whole, room_m2: first.room_m2 };
    for (file, part) in parts {
        for Ended(cell, controller, repeat, tried) in part.trials {
            let place = findings.cells.get_mut(cell).and_then(|cell| cell.tries.get_mut(controller)?.get_mut(repeat));
            // Each file has the right number of trials, so that none is missing if none comes twice.
            match place {
                Some(place @ None) => *place = Some(tried),
                _ => return Err(MergeError::Trials { file, shard: part.shard }),
            }
        }
    }
    Ok(MergedRecovery { adapter, subject, findings })
}
