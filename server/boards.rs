//! The boards of challenges: one folder per challenge, one file per person.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use icu_properties::props::{DefaultIgnorableCodePoint, GeneralCategory};
use icu_properties::{CodePointMapData, CodePointSetData};
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use ferry_core::challenge::{Attempt, ChallengeName, Run, Score, Trace};
use ferry_files::{read_at_most, replace};
use ferry_lab::changes::Changes;

/// Entries of a board; a better one takes the place of the last.
const ENTRIES_MOST: usize = 100;
/// Challenges with a board.
const BOARDS_MOST: usize = 2000;
/// Characters of the name of a person or a class.
const NAME_MOST: usize = 24;
/// Largest file of an entry.
const BYTES_MOST: u64 = 4 << 20;

/// Who made an attempt, and when.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Signature {
    /// 1 to 24 characters.
    pub player: String,
    /// Name of a class, 1 to 24 characters.
    pub class: Option<String>,
    /// UTC, RFC 3339.
    pub at: String,
}

/// An attempt on a board, as its file has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    pub signature: Signature,
    pub attempt: Attempt,
    pub trace: Trace,
}

/// A line of a board.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub signature: Signature,
    pub score: Score,
    /// Empty except for the best entry, which is drawn as a ghost. No other one can become the best.
    pub trace: Arc<Trace>,
    /// Of the inputs.
    hash: u64,
}

/// Why an attempt is not kept.
#[derive(Debug, thiserror::Error)]
pub enum BoardError {
    #[error(
        "{field} is {value:?}: it must have 1 to {NAME_MOST} characters, none of which is a control character, hidden, or turns the others"
    )]
    Name { field: &'static str, value: String },
    #[error("attempt.log: this log is on the board already")]
    Again,
    #[error("there are {BOARDS_MOST} boards; delete old folders in data/challenges")]
    Full,
    #[error("the attempt could not be kept: {0}")]
    Io(#[from] std::io::Error),
}

/// The boards of a server.
pub struct Boards {
    folder: PathBuf,
    /// Boards that were read, best entry first.
    read: Mutex<HashMap<ChallengeName, Vec<Entry>>>,
    pub changes: Changes,
}

impl Boards {
    /// The boards in a folder, which may not exist yet.
    pub fn in_folder(folder: PathBuf) -> Self {
        Self { folder, read: Mutex::default(), changes: Changes::default() }
    }

    /// All entries of a challenge, best first. Unreadable files are left out.
    pub fn of(&self, name: &ChallengeName) -> Vec<Entry> {
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(entries) = read.get(name) {
            return entries.clone();
        }
        let entries = entries_in(&self.folder.join(name.to_string()));
        // A request may have any name: only boards with entries are kept.
        if !entries.is_empty() {
            read.insert(name.clone(), entries.clone());
        }
        entries
    }

    /// Challenges with a board, by name.
    pub fn names(&self) -> Vec<ChallengeName> {
        let Ok(folders) = std::fs::read_dir(&self.folder) else { return Vec::new() };
        let names = folders.flatten().filter_map(|folder| folder.file_name().to_str()?.parse().ok());
        let mut names: Vec<ChallengeName> = names.collect();
        names.sort_by_key(ToString::to_string);
        names
    }

    /// Adds an attempt that was judged. Of each person in each class, the board keeps the best; returns whether this one
    /// is.
    ///
    /// # Errors
    /// [`BoardError`]; the board is unchanged.
    pub fn add(
        &self,
        name: &ChallengeName,
        signature: Signature,
        attempt: &Attempt,
        run: Run,
    ) -> Result<bool, BoardError> {
        signature.check()?;
        // Also reads the board.
        self.of(name);
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        let entries = read.entry(name.clone()).or_default();
        let new = Entry { signature, score: run.score, trace: Arc::new(run.trace), hash: hash_of(attempt) };
        if entries.iter().any(|entry| entry.hash == new.hash) {
            return Err(BoardError::Again);
        }
        if entries.iter().any(|entry| entry.is_of(&new.signature) && entry.total_ms() <= new.total_ms()) {
            return Ok(false);
        }
        let folder = self.folder.join(name.to_string());
        if entries.is_empty() && !folder.exists() && self.names().len() >= BOARDS_MOST {
            return Err(BoardError::Full);
        }
        let mut after: Vec<Entry> = entries.iter().filter(|entry| !entry.is_of(&new.signature)).cloned().collect();
        let place = after.partition_point(|entry| entry.total_ms() <= new.total_ms());
        if place >= ENTRIES_MOST {
            return Ok(false);
        }
        after.insert(place, new.clone());
        after.truncate(ENTRIES_MOST);
        std::fs::create_dir_all(&folder)?;
        let kept = Kept { signature: new.signature.clone(), attempt: attempt.clone(), trace: Trace::clone(&new.trace) };
        replace(&new.file(&folder), &serde_json::to_vec(&kept).map_err(std::io::Error::other)?)?;
        // The new file is there; one that is too many does no harm.
        for gone in entries.iter().filter(|entry| after.iter().all(|kept| kept.hash != entry.hash)) {
            if let Err(error) = std::fs::remove_file(gone.file(&folder)) {
                tracing::warn!(%error, "an old attempt could not be removed");
            }
        }
        forget_traces(&mut after);
        *entries = after;
        drop(read);
        self.changes.note();
        Ok(true)
    }

    /// The attempts of a challenge's folder with everything that their files have, best first.
    pub fn kept(folder: &Path) -> Vec<Kept> {
        let files = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|file| file.path());
        let files = files.filter(|path| path.extension().is_some_and(|ending| ending == "json"));
        let mut kept: Vec<Kept> = files.filter_map(|path| read_kept(&path)).collect();
        kept.sort_by(|a, b| {
            a.attempt
                .score
                .total_s()
                .total_cmp(&b.attempt.score.total_s())
                .then_with(|| a.signature.at.cmp(&b.signature.at))
        });
        kept
    }
}

impl Signature {
    fn check(&self) -> Result<(), BoardError> {
        let names = [("player", Some(&self.player)), ("class", self.class.as_ref())];
        for (field, name) in names.into_iter().filter_map(|(field, name)| Some((field, name?))) {
            let count = name.chars().count();
            if !(1..=NAME_MOST).contains(&count) || name.trim() != name || name.chars().any(is_hidden) {
                return Err(BoardError::Name { field, value: name.chars().take(2 * NAME_MOST).collect() });
            }
        }
        Ok(())
    }
}

/// Whether a letter is not drawn, or turns the writing, so that a name looks like another one. Joiners stay: some writings
/// and emoji need them, and the page shows them where they are not needed.
fn is_hidden(letter: char) -> bool {
    use GeneralCategory::{Control, Format, LineSeparator, ParagraphSeparator, PrivateUse};
    let category = CodePointMapData::<GeneralCategory>::new().get(letter);
    let is_joiner = matches!(letter, '\u{200c}' | '\u{200d}' | '\u{fe0f}');
    !is_joiner
        && (matches!(category, Control | Format | LineSeparator | ParagraphSeparator | PrivateUse)
            || CodePointSetData::new::<DefaultIgnorableCodePoint>().contains(letter)
            || letter == '\u{2800}')
}

impl Entry {
    fn is_of(&self, other: &Signature) -> bool {
        self.signature.player == other.player && self.signature.class == other.class
    }

    /// Score without rounding errors.
    fn total_ms(&self) -> u64 {
        (self.score.total_s() * 1e3).round() as u64
    }

    fn file(&self, folder: &Path) -> PathBuf {
        folder.join(format!("{:016x}.json", self.hash))
    }
}

/// The same inputs with another score or name are the same attempt.
fn hash_of(attempt: &Attempt) -> u64 {
    xxh3_64(&serde_json::to_vec(&attempt.log.inputs).expect("inputs are JSON"))
}

fn read_kept(path: &Path) -> Option<Kept> {
    let read = read_at_most(path, BYTES_MOST).map_err(|error| error.to_string());
    let kept = read.and_then(|bytes| serde_json::from_slice(&bytes).map_err(|error| error.to_string()));
    kept.inspect_err(|error| tracing::warn!(?path, error, "an attempt could not be read")).ok()
}

fn entries_in(folder: &Path) -> Vec<Entry> {
    let entry = |kept: Kept| Entry {
        hash: hash_of(&kept.attempt),
        score: kept.attempt.score,
        signature: kept.signature,
        trace: Arc::new(kept.trace),
    };
    let mut entries: Vec<Entry> = Boards::kept(folder).into_iter().map(entry).collect();
    forget_traces(&mut entries);
    entries
}

/// Ten thousand traces would fill the memory.
fn forget_traces(entries: &mut [Entry]) {
    for entry in entries.iter_mut().skip(1) {
        entry.trace = Arc::default();
    }
}

#[cfg(test)]
mod tests;
