//! An evaluation in parts, on several machines or as several processes, and their merging.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use xxhash_rust::xxh3::{Xxh3Default, xxh3_64};

use super::{Cell, Episode, Experiment, Manner};
use crate::scenario::{ControllerName, Parameters};
use crate::trial::TrialError;

/// Format of a shard's file.
const FORMAT: u32 = 1;
/// Largest number of shards.
const SHARDS_MOST: u32 = 10_000;

/// One of several parts of an evaluation, `I/N`: every N-th trial, beginning with the I-th.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Shard {
    /// From 1.
    pub number: u32,
    pub count: u32,
}

/// A text that does not name a shard.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is not a shard: it must be I/N with 1 ≤ I ≤ N ≤ {SHARDS_MOST}, such as 2/8")]
pub struct ShardError(String);

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let parse = || {
            let (number, count) = text.split_once('/')?;
            let (number, count) = (number.parse().ok()?, count.parse().ok()?);
            ((1..=count).contains(&number) && count <= SHARDS_MOST).then_some(Self { number, count })
        };
        parse().ok_or_else(|| ShardError(text.to_owned()))
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

impl Shard {
    /// Its trials: the number of the experiment, and the index of the trial.
    pub fn trials(self, experiments: &[Experiment]) -> Vec<(usize, u32)> {
        self.of(&experiments.iter().map(|one| one.episodes).collect::<Vec<u32>>())
    }

    fn of(self, episodes: &[u32]) -> Vec<(usize, u32)> {
        let all = episodes.iter().enumerate().flat_map(|(number, &count)| (0..count).map(move |index| (number, index)));
        all.skip(self.number as usize - 1).step_by(self.count as usize).collect()
    }
}

/// What decides the bits of a result, besides the settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Machine {
    /// Hash of the program.
    build: String,
    /// Graphics adapter.
    adapter: String,
    /// The vector instructions of the processor.
    processor: String,
}

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

/// Why a shard has no file, or a file is not that of a shard.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    #[error("not a shard of an evaluation: {0}")]
    Foreign(#[from] serde_json::Error),
    #[error("ferry_part is {found}, this Ferry reads {FORMAT}")]
    Format { found: u32 },
    #[error("the program could not be read: {0}")]
    Build(#[from] std::io::Error),
    #[error(transparent)]
    Trial(#[from] TrialError),
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
        let machine = Machine { build: build()?, adapter: adapter.to_owned(), processor: processor() };
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
    /// [`PartError::Foreign`], [`PartError::Format`].
    pub fn read(bytes: &[u8]) -> Result<Self, PartError> {
        #[derive(Deserialize)]
        struct Head {
            ferry_part: u32,
        }
        let Head { ferry_part } = serde_json::from_slice(bytes)?;
        if ferry_part != FORMAT {
            return Err(PartError::Format { found: ferry_part });
        }
        Ok(serde_json::from_slice(bytes)?)
    }
}

/// Why shards do not belong together.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum MergeError {
    #[error("no file is given")]
    None,
    #[error("{file}: {field} is {value}, but {other_value} in {other}")]
    Differs { file: String, field: String, value: String, other: String, other_value: String },
    #[error("{file}: shard {shard} is in {other}, too")]
    Twice { file: String, shard: Shard, other: String },
    #[error("{} missing: {}", if .0.len() == 1 { "a shard is" } else { "shards are" }, .0.iter().map(Shard::to_string).collect::<Vec<_>>().join(", "))]
    Missing(Vec<Shard>),
    #[error("{file}: it does not have the trials of shard {shard}")]
    Trials { file: String, shard: Shard },
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
    let (first_file, first) = parts.first().ok_or(MergeError::None)?;
    let (common, count) = (common(first), first.shard.count);
    let mut files: BTreeMap<Shard, &str> = BTreeMap::new();
    for (file, part) in &parts {
        if let Some((field, value, other_value)) = first_difference(&self::common(part), &common, "") {
            return Err(MergeError::Differs {
                file: file.clone(),
                field,
                value,
                other: first_file.clone(),
                other_value,
            });
        }
        let shard = part.shard;
        if let Some(other) = files.insert(shard, file) {
            return Err(MergeError::Twice { file: file.clone(), shard, other: other.to_owned() });
        }
        let episodes: Vec<u32> = part.subjects.iter().map(|subject| subject.episodes).collect();
        let has: Vec<(usize, u32)> = part.episodes.iter().map(|(number, episode)| (*number, episode.index)).collect();
        if has != shard.of(&episodes) {
            return Err(MergeError::Trials { file: file.clone(), shard });
        }
    }
    let all = (1..=count).map(|number| Shard { number, count });
    let missing: Vec<Shard> = all.filter(|shard| !files.contains_key(shard)).collect();
    if !missing.is_empty() {
        return Err(MergeError::Missing(missing));
    }
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

/// What all shards of an evaluation share.
fn common(part: &Part) -> Value {
    serde_json::json!({ "shard": { "count": part.shard.count }, "machine": part.machine, "subjects": part.subjects })
}

/// The path of the first difference, and both values.
fn first_difference(one: &Value, other: &Value, path: &str) -> Option<(String, String, String)> {
    match (one, other) {
        (Value::Object(fields), Value::Object(others)) if fields.len() == others.len() => {
            fields.iter().find_map(|(name, value)| {
                let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                first_difference(value, others.get(name).unwrap_or(&Value::Null), &path)
            })
        }
        (Value::Array(values), Value::Array(others)) if values.len() == others.len() => values
            .iter()
            .zip(others)
            .enumerate()
            .find_map(|(index, (value, other))| first_difference(value, other, &format!("{path}[{index}]"))),
        _ if one == other => None,
        _ => {
            let short = |value: &Value| {
                let text = value.to_string();
                if text.chars().count() > 60 {
                    format!("{}…", text.chars().take(60).collect::<String>())
                } else {
                    text
                }
            };
            Some((path.to_owned(), short(one), short(other)))
        }
    }
}

/// Hash of the file that this code was loaded from: the program, or the library of the Python package.
fn build() -> std::io::Result<String> {
    let mut file = std::fs::File::open(loaded_from().map_or_else(std::env::current_exe, Ok)?)?;
    let mut hash = Xxh3Default::new();
    let mut buffer = vec![0; 1 << 20];
    loop {
        match std::io::Read::read(&mut file, &mut buffer)? {
            0 => return Ok(format!("{:016x}", hash.digest())),
            count => hash.update(&buffer[..count]),
        }
    }
}

/// On Linux, the file whose mapping has this function.
fn loaded_from() -> Option<PathBuf> {
    let own = loaded_from as *const () as usize;
    let maps = std::fs::read_to_string("/proc/self/maps").ok()?;
    maps.lines().find_map(|line| {
        let (range, rest) = line.split_once(' ')?;
        let (from, to) = range.split_once('-')?;
        let hex = |text: &str| usize::from_str_radix(text, 16).ok();
        let path = rest.find('/').map(|at| PathBuf::from(&rest[at..]))?;
        (hex(from)?..hex(to)?).contains(&own).then_some(path)
    })
}

fn processor() -> String {
    #[cfg(target_arch = "x86_64")]
    let features = [
        ("avx2", std::arch::is_x86_feature_detected!("avx2")),
        ("fma", std::arch::is_x86_feature_detected!("fma")),
        ("avx512f", std::arch::is_x86_feature_detected!("avx512f")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let features: [(&str, bool); 0] = [];
    let has = features.iter().filter(|(_, has)| *has).map(|(name, _)| *name);
    std::iter::once(std::env::consts::ARCH).chain(has).collect::<Vec<_>>().join("+")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_trials() {
        let shards: Vec<Shard> = (1..=3).map(|number| Shard { number, count: 3 }).collect();
        let mut all: Vec<(usize, u32)> = shards.iter().flat_map(|shard| shard.of(&[4, 3])).collect();
        all.sort_unstable();
        assert_eq!(all, [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2)]);
        assert_eq!("2/8".parse::<Shard>().unwrap().to_string(), "2/8");
        for text in ["0/3", "4/3", "1/10001", "1", "a/b", "1/0", "-1/3", ""] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn the_program_knows_its_file_and_processor() {
        assert_eq!(loaded_from(), std::env::current_exe().ok());
        assert_eq!(build().unwrap().len(), 16);
        assert!(processor().starts_with(std::env::consts::ARCH));
    }

    #[test]
    fn a_difference_is_named_by_its_path() {
        let one = serde_json::json!({"a": [{"b": 1, "c": 2}], "d": 1});
        let other = serde_json::json!({"a": [{"b": 1, "c": 3}], "d": 1});
        assert_eq!(first_difference(&one, &one, ""), None);
        let found = first_difference(&one, &other, "").unwrap();
        assert_eq!(found, ("a[0].c".to_owned(), "2".to_owned(), "3".to_owned()));
    }
}
