//! Parts of an evaluation or a recovery map, on several machines or as several processes.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::str::FromStr;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use xxhash_rust::xxh3::Xxh3Default;

use super::Experiment;
use ferry_core::trial::TrialError;

/// Largest number of shards.
const SHARDS_MOST: u32 = 10_000;

/// One of several parts, `I/N`: every N-th trial, beginning with the I-th.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub struct Shard {
    /// From 1.
    pub number: u32,
    pub count: u32,
}

#[derive(Deserialize)]
struct Unchecked {
    number: u32,
    count: u32,
}

impl TryFrom<Unchecked> for Shard {
    type Error = ShardError;

    fn try_from(Unchecked { number, count }: Unchecked) -> Result<Self, ShardError> {
        let is_one = (1..=count).contains(&number) && count <= SHARDS_MOST;
        is_one.then_some(Self { number, count }).ok_or_else(|| ShardError(format!("{number}/{count}")))
    }
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
            Self::try_from(Unchecked { number: number.parse().ok()?, count: count.parse().ok()? }).ok()
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
        self.of(experiments.iter().map(|one| one.episodes)).collect()
    }

    pub(super) fn of(self, episodes: impl Iterator<Item = u32>) -> impl Iterator<Item = (usize, u32)> {
        self.among(episodes.enumerate().flat_map(|(number, count)| (0..count).map(move |index| (number, index))))
    }

    /// Its share of all trials.
    pub fn among<T>(self, all: impl Iterator<Item = T>) -> impl Iterator<Item = T> {
        all.skip(self.number as usize - 1).step_by(self.count as usize)
    }

    /// The number of its trials among `all`.
    pub fn share(self, all: usize) -> usize {
        all.saturating_sub(self.number as usize - 1).div_ceil(self.count as usize)
    }
}

/// What decides the bits of a result, besides the settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Hash of the program.
    build: String,
    /// Graphics adapter.
    pub adapter: String,
    /// The vector instructions of the processor.
    processor: String,
}

impl Machine {
    /// This one, with a graphics adapter.
    ///
    /// # Errors
    /// The program's own file cannot be read.
    pub fn this(adapter: &str) -> std::io::Result<Self> {
        Ok(Self { build: build()?, adapter: adapter.to_owned(), processor: processor() })
    }
}

/// What the file of a shard has.
pub trait Piece {
    fn shard(&self) -> Shard;

    /// What all shards share.
    fn common(&self) -> Value;

    /// Whether it has the trials of its shard.
    fn is_whole(&self) -> bool;
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

/// Checks that files, each with its name, are all shards of one whole, and returns the first one.
///
/// # Errors
/// [`MergeError`].
pub fn check_all<P: Piece>(pieces: &[(String, P)]) -> Result<&P, MergeError> {
    let (first_file, first) = pieces.first().ok_or(MergeError::None)?;
    let with_count =
        |piece: &P| serde_json::json!({ "shard": { "count": piece.shard().count }, "common": piece.common() });
    let common = with_count(first);
    let mut files: BTreeMap<Shard, &str> = BTreeMap::new();
    for (file, piece) in pieces {
        if let Some((field, value, other_value)) = first_difference(&with_count(piece), &common, "") {
            let field = field.strip_prefix("common.").unwrap_or(&field).to_owned();
            return Err(MergeError::Differs {
                file: file.clone(),
                field,
                value,
                other: first_file.clone(),
                other_value,
            });
        }
        let shard = piece.shard();
        if let Some(other) = files.insert(shard, file) {
            return Err(MergeError::Twice { file: file.clone(), shard, other: other.to_owned() });
        }
        if !piece.is_whole() {
            return Err(MergeError::Trials { file: file.clone(), shard });
        }
    }
    let count = first.shard().count;
    let all = (1..=count).map(|number| Shard { number, count });
    let missing: Vec<Shard> = all.filter(|shard| !files.contains_key(shard)).collect();
    if missing.is_empty() { Ok(first) } else { Err(MergeError::Missing(missing)) }
}

/// Why a shard has no file, or a file is not that of a shard.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    #[error("not a shard: {0}")]
    Foreign(String),
    #[error("{field} is {found}, this Ferry reads {reads}")]
    Format { field: &'static str, found: u32, reads: u32 },
    /// A setting that no evaluation or recovery map has.
    #[error("{0}")]
    Setting(String),
    #[error("the program could not be read: {0}")]
    Build(#[from] std::io::Error),
    #[error(transparent)]
    Trial(#[from] TrialError),
}

impl From<serde_json::Error> for PartError {
    fn from(error: serde_json::Error) -> Self {
        Self::Foreign(error.to_string())
    }
}

/// Largest real number in the file of a shard, in SI units: figures are drawn of what is read.
const REAL_MOST: f64 = 1e6;

/// Reads the file of a shard, if each number in it is one that a trial can give.
///
/// # Errors
/// [`PartError::Foreign`], [`PartError::Setting`].
pub fn read_part<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, PartError> {
    let value: Value = serde_json::from_slice(bytes)?;
    if let Some((path, number)) = too_large(&value, "") {
        return Err(PartError::Setting(format!("{path} is {number:e}, it must be within ±{REAL_MOST:e}")));
    }
    drop(value);
    // From the text, so that an error has its line.
    Ok(serde_json::from_slice(bytes)?)
}

/// The path of the first real number that is too large.
fn too_large(value: &Value, path: &str) -> Option<(String, f64)> {
    match value {
        Value::Object(fields) => fields.iter().find_map(|(name, value)| too_large(value, &format!("{path}.{name}"))),
        Value::Array(values) => {
            values.iter().enumerate().find_map(|(index, value)| too_large(value, &format!("{path}[{index}]")))
        }
        Value::Number(number) if number.is_f64() => {
            let number = number.as_f64().filter(|number| number.abs() > REAL_MOST)?;
            Some((path.trim_start_matches('.').to_owned(), number))
        }
        _ => None,
    }
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
        let mut all: Vec<(usize, u32)> = shards.iter().flat_map(|shard| shard.of([4, 3].into_iter())).collect();
        all.sort_unstable();
        assert_eq!(all, [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2)]);
        assert_eq!([0, 1, 2, 3, 7].map(|all| shards[1].share(all)), [0, 0, 1, 1, 2]);
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
