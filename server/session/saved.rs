//! What of a session survives a restart of the server: its trial and its kept runs, each at its end. A saved session is
//! an input log without ticks.

use std::path::Path;

use super::Opening;
use super::kept_runs::KeptRun;
use super::timeline::Timeline;
use super::worker::Worker;
use crate::camera::ImageSource;
use crate::files::read_at_most;
use crate::map::Library;
use crate::trial::{
    Arena, Beginning, Entry, Event, EventKind, InputLog, LogError, LogWriter, LoggedBeginning, LoggedMap, Trial,
    TrialError,
};

/// Nine runs, each with a map of at most a few megabytes.
const BYTES_MOST: u64 = 64 << 20;

/// Why a session started over.
#[derive(Debug, thiserror::Error)]
enum RestoreError {
    #[error(transparent)]
    Log(#[from] LogError),
    #[error(transparent)]
    Trial(#[from] TrialError),
}

/// Oldest run first; the last one is the trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Saved(Vec<LoggedBeginning>);

impl Saved {
    /// # Errors
    /// A state cannot be encoded.
    pub fn to_bytes(&self) -> Result<Vec<u8>, LogError> {
        let mut bytes = Vec::new();
        let entries = self.0.iter().map(|run| Entry::Begin(Box::new(run.clone())));
        LogWriter::new(&mut bytes)?.append(entries.collect())?;
        Ok(bytes)
    }

    /// # Errors
    /// The file cannot be read, or it is not a saved session of this version.
    pub fn open(path: &Path) -> Result<Self, LogError> {
        let entries = InputLog::read(&read_at_most(path, BYTES_MOST)?)?.entries;
        let runs = entries.into_iter().filter_map(|entry| match entry {
            Entry::Begin(run) => Some(*run),
            Entry::Tick(_) => None,
        });
        Ok(Self(runs.collect()))
    }
}

impl<E: ImageSource> Worker<E> {
    pub(super) fn saved(&self) -> Saved {
        let runs = self.kept_runs.iter().map(|run| LoggedBeginning {
            scenario: run.scenario.clone(),
            map: Some(LoggedMap::from(&run.arena.map)),
            policy_hash: None,
            state: Some(Box::new(run.state.clone())),
        });
        Saved(runs.chain([LoggedBeginning::of(&self.trial, Beginning::Resumed)]).collect())
    }

    /// Goes on from what was saved, or keeps it as runs beside the chosen opening. A saved session that cannot be read
    /// is reported, and the session starts over.
    pub(super) fn begin(&mut self, opening: Opening) {
        let restored = match opening {
            Opening::Fresh => return,
            Opening::Saved(saved) => self.runs_of(saved).and_then(|runs| self.go_on(runs)),
            Opening::Beside(saved) => self.runs_of(saved).map(|runs| self.keep(runs)),
            Opening::Unreadable(error) => Err(error.into()),
        };
        let text = restored.unwrap_or_else(|error| {
            tracing::warn!(%error, "saved session not restored");
            format!("the session started over: {error}")
        });
        let event = Event::new(self.trial.state().world.tick, EventKind::Session, text);
        self.sink.note(&event);
        self.report(event);
    }

    fn keep(&mut self, runs: Vec<KeptRun>) -> String {
        runs.into_iter().for_each(|run| self.kept_runs.keep(run));
        self.scenery = self.next_scenery(0).into();
        "the server was restarted; the trial before is a kept run".to_owned()
    }

    fn go_on(&mut self, mut runs: Vec<KeptRun>) -> Result<String, RestoreError> {
        let last = runs.pop().ok_or(LogError::Empty)?;
        let prepared = self.prepare(&last)?;
        runs.into_iter().for_each(|run| self.kept_runs.keep(run));
        self.resumed_tick = Some(last.state.world.tick);
        self.take_up(last, prepared);
        Ok("the server was restarted; the trial goes on from its last saved state".to_owned())
    }

    /// The runs with their maps, after a check of every state.
    fn runs_of(&self, saved: Saved) -> Result<Vec<KeptRun>, RestoreError> {
        let mut map: Option<LoggedMap> = None;
        let mut runs = Vec::new();
        for run in saved.0 {
            map = run.map.or(map);
            let (Some(map), Some(state)) = (&map, run.state) else { continue };
            let arena = Arena::of(known(&self.scenery.known_maps, map)?);
            let mut trial = Trial::new(run.scenario.clone(), arena.clone())?;
            trial.resume(*state)?;
            let state = trial.snapshot();
            let mut timeline = Timeline::default();
            timeline.keep(state.clone());
            runs.push(KeptRun {
                scenario: run.scenario,
                arena,
                state,
                timeline,
                journal: Default::default(),
                case: None,
            });
        }
        Ok(runs)
    }
}

/// The library's map if it is the same drawing; it may have been deleted or changed since.
fn known(library: &Library, logged: &LoggedMap) -> Result<crate::map::Map, TrialError> {
    match library.find(&logged.name) {
        Ok(map) if map.svg() == logged.svg => Ok(map),
        _ => Ok(crate::map::Map::from_svg(&logged.name, &logged.svg)?),
    }
}
