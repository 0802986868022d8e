//! What of a session survives a restart of the server: its trial and its kept runs, each at its end. A saved session is
//! an input log without ticks.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use super::kept_runs::KeptRun;
use super::timeline::Timeline;
use super::{Opening, Resumed, Session};
use crate::image::ImageSource;
use crate::map::{Library, Map};
use crate::panics;
use crate::scenario::Scenario;
use crate::trial::{
    Arena, Beginning, Entry, Event, Happening, InputLog, LogError, LogWriter, LoggedBeginning, LoggedMap, Resumption,
    Trial, TrialError, TrialState,
};

/// Why a saved trial was left out.
#[derive(Debug, thiserror::Error)]
enum RestoreError {
    #[error(transparent)]
    Log(#[from] LogError),
    #[error(transparent)]
    Trial(#[from] TrialError),
    #[error("it could not be restored: {0}")]
    Panic(String),
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

    /// The saved session of a log.
    pub fn of(log: InputLog) -> Self {
        let runs = log.entries.into_iter().filter_map(|entry| match entry {
            Entry::Begin(run) => Some(*run),
            Entry::Tick(_) => None,
        });
        Self(runs.collect())
    }
}

/// What of a saved session can be used.
#[derive(Default)]
struct Restored {
    /// Oldest first.
    runs: Vec<KeptRun>,
    /// The trial, if it is usable.
    present: Option<KeptRun>,
    errors: Vec<RestoreError>,
}

impl<E: ImageSource> Session<E> {
    /// What a later server needs to go on.
    pub fn saved(&self) -> Saved {
        let logged = |scenario: &Scenario, arena: &Arena, state: &TrialState| LoggedBeginning {
            scenario: scenario.clone(),
            map: Some(LoggedMap::from(&arena.map)),
            policy_hash: None,
            state: Some(Box::new(state.clone())),
        };
        let runs = self.history.kept_runs().iter().map(|run| logged(&run.scenario, &run.arena, &run.state));
        let own = |state| logged(self.trial.scenario(), self.trial.arena(), state);
        let present = self.trial.state();
        // After a rewind the end is not yet a kept run.
        let end = Some(self.history.newest(&self.trial)).filter(|end| end.world.tick > present.world.tick);
        Saved(runs.chain(end.map(own)).chain([own(present)]).collect())
    }

    /// Goes on from what was saved, or keeps it as runs beside the chosen opening. What cannot be restored is reported
    /// and left out; without its trial the session starts over.
    pub(super) fn begin(&mut self, opening: Opening) -> Resumed {
        let (restored, goes_on) = match opening {
            Opening::Fresh => {
                self.sink.begin(&self.trial, Beginning::SetUp);
                return Resumed::default();
            }
            Opening::Saved(saved) => (self.restore(saved), true),
            Opening::Beside(saved) => (self.restore(saved), false),
            Opening::Unreadable(error) => (Restored { errors: vec![error.into()], ..Restored::default() }, true),
        };
        let Restored { mut runs, present, mut errors } = restored;
        let mut tick = None;
        match present {
            Some(run) if goes_on => match caught(|| self.prepare(&run)) {
                Ok(prepared) => {
                    self.keep(std::mem::take(&mut runs));
                    tick = Some(run.state.world.tick);
                    self.take_up(run, prepared);
                }
                Err(error) => errors.push(error),
            },
            run => runs.extend(run),
        }
        if tick.is_none() {
            self.sink.begin(&self.trial, Beginning::SetUp);
            self.keep(runs);
        }
        let how = match tick.is_some() {
            true => Resumption::GoesOn,
            false if goes_on => Resumption::StartedOver,
            false => Resumption::StartedOverWithRuns,
        };
        let lost = errors.first().map(|first| {
            let count = match errors.len() {
                1 => "a saved trial".to_owned(),
                count => format!("{count} saved trials"),
            };
            format!("{count} could not be read: {first}")
        });
        self.note(Event::new(self.trial.state().world.tick, Happening::Resumed { how, lost }));
        Resumed { tick, has_left_out: !errors.is_empty() }
    }

    fn keep(&mut self, runs: Vec<KeptRun>) {
        runs.into_iter().for_each(|run| self.history.keep_run(run));
        self.scenery = self.next_scenery(0).into();
    }

    /// Runs with their maps, after a check of every state.
    fn restore(&self, Saved(logged): Saved) -> Restored {
        let last = logged.len().checked_sub(1);
        let mut restored = Restored::default();
        let mut map: Option<LoggedMap> = None;
        let mut arena: Option<Arc<Arena>> = None;
        for (index, run) in logged.into_iter().enumerate() {
            if run.map.is_some() {
                (map, arena) = (run.map, None);
            }
            let (Some(map), Some(state)) = (&map, run.state) else { continue };
            let read = caught(|| {
                let arena = match &arena {
                    Some(arena) => arena.clone(),
                    None => self.scenery.catalog.arena_of(known(&self.scenery.catalog.maps, map)?),
                };
                let mut trial = Trial::new(run.scenario.clone(), arena.clone())?;
                trial.resume(*state)?;
                let state = trial.snapshot();
                let timeline = Timeline::from_state(state.clone());
                Ok(KeptRun { scenario: run.scenario, arena, state, timeline, journal: Arc::default(), case: None })
            });
            match read {
                Ok(run) => {
                    arena = Some(run.arena.clone());
                    if Some(index) == last {
                        restored.present = Some(run);
                    } else {
                        restored.runs.push(run);
                    }
                }
                Err(error) => restored.errors.push(error),
            }
        }
        restored
    }
}

/// A state of another version may be one that the code does not expect.
fn caught<T>(work: impl FnOnce() -> Result<T, TrialError>) -> Result<T, RestoreError> {
    catch_unwind(AssertUnwindSafe(work))
        .map_err(|panic| RestoreError::Panic(panics::message(&*panic)))?
        .map_err(RestoreError::from)
}

/// The library's map if it is the same drawing; it may have been deleted or changed since.
fn known(library: &Library, logged: &LoggedMap) -> Result<Map, TrialError> {
    match library.find(&logged.name) {
        Ok(map) if map.svg() == logged.svg => Ok(map.as_read_by(logged.reader)?),
        _ => {
            // No other drawing gets the name from now on.
            library.reserve(&logged.name);
            Ok(logged.map()?)
        }
    }
}
