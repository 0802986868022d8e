//! The file of a shard of an evaluation, and the whole evaluation from all files.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use xxhash_rust::xxh3::xxh3_64;

use super::shard::{Machine, MergeError, PartError, Piece, Shard, check_all, read_part};
use super::{Cell, Episode, Experiment, Manner};
use ferry_core::scenario::{ControllerName, Parameters};
use ferry_core::trial::TrialError;

/// Format of a shard's file.
const FORMAT: u32 = 1;

/// What the trials of one row have in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Subject {
    cell: Cell,
    /// Hash of the drawing.
    map_hash: String,
    /// Hash of the policy's file; `None` without a policy.
    policy_hash: Option<String>,
    episodes: u32,
    seed: u64,
    parameters: Parameters,
    manner: Manner,
}

/// The trials of a shard, as a file.
#[derive(Debug, Serialize, Deserialize)]
pub struct Part {
    ferry_part: u32,
    shard: Shard,
    machine: Machine,
    subjects: Vec<Subject>,
    /// With the number of their row.
    episodes: Vec<(usize, Episode)>,
}

impl Part {
    /// # Errors
    /// [`PartError::Build`], [`PartError::Trial`].
    pub fn of(
        experiments: &[Experiment],
        shard: Shard,
        adapter: &str,
        episodes: Vec<(usize, Episode)>,
    ) -> Result<Self, PartError> {
        let machine = Machine::this(adapter)?;
        let subject = |one: &Experiment| -> Result<Subject, TrialError> {
            let arena = &one.venue.arena;
            let policy_hash = match one.cell.controller {
                ControllerName::Rl => Some(format!("{:016x}", arena.policy(&one.parameters.rl_policy)?.hash())),
                _ => None,
            };
            Ok(Subject {
                cell: one.cell.clone(),
                map_hash: format!("{:016x}", xxh3_64(arena.map.svg().as_bytes())),
                policy_hash,
                episodes: one.episodes,
                seed: one.seed,
                parameters: one.parameters.clone(),
                manner: one.manner,
            })
        };
        let subjects = experiments.iter().map(subject).collect::<Result<_, _>>()?;
        Ok(Self { ferry_part: FORMAT, shard, machine, subjects, episodes })
    }

    /// # Errors
    /// [`PartError::Foreign`], [`PartError::Format`], [`PartError::Setting`].
    pub fn read(bytes: &[u8]) -> Result<Self, PartError> {
        #[derive(Deserialize)]
        struct Head {
            ferry_part: u32,
        }
        let Head { ferry_part: found } = serde_json::from_slice(bytes)?;
        if found != FORMAT {
            return Err(PartError::Format { field: "ferry_part", found, reads: FORMAT });
        }
        read_part(bytes)
    }
}

impl Piece for Part {
    fn shard(&self) -> Shard {
        self.shard
    }

    fn common(&self) -> Value {
        serde_json::json!({ "machine": self.machine, "subjects": self.subjects })
    }

    fn is_whole(&self) -> bool {
        let has = self.episodes.iter().map(|(number, episode)| (*number, episode.index));
        // A file may claim any number of episodes, so that what it should have is never listed.
        has.eq(self.shard.of(self.subjects.iter().map(|subject| subject.episodes)))
    }
}

/// A whole evaluation.
#[derive(Debug)]
pub struct Merged {
    pub adapter: String,
    pub seed: u64,
    pub manner: Manner,
    rows: Vec<(Cell, Vec<Episode>)>,
}

impl Merged {
    /// The rows with their trials, in order.
    pub fn done(&self) -> Vec<(&Cell, &[Episode])> {
        self.rows.iter().map(|(cell, episodes)| (cell, episodes.as_slice())).collect()
    }
}

/// Merges all shards of an evaluation, each with the name of its file.
///
/// # Errors
/// [`MergeError`].
pub fn merge(parts: Vec<(String, Part)>) -> Result<Merged, MergeError> {
    let first = check_all(&parts)?;
    let adapter = first.machine.adapter.clone();
    let (seed, manner) = first.subjects.first().map_or_else(Default::default, |one| (one.seed, one.manner));
    let mut rows: Vec<(Cell, Vec<Episode>)> =
        first.subjects.iter().map(|subject| (subject.cell.clone(), Vec::new())).collect();
    for (number, episode) in parts.into_iter().flat_map(|(_, part)| part.episodes) {
        rows[number].1.push(episode);
    }
    for (_, episodes) in &mut rows {
        episodes.sort_by_key(|episode| episode.index);
    }
    Ok(Merged { adapter, seed, manner, rows })
}
