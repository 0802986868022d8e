//! One evaluation: its query, progress and results.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, MutexGuard, PoisonError};
use std::time::Instant;

use super::{Cell, Episode, EvaluationQuery, Experiment, Failure, Manner, Row, Venue};
use crate::map::Map;
use crate::policy;
use crate::program::Program;
use crate::scenario::Parameters;

/// An evaluation. Its job updates it; all others only read.
#[derive(Debug)]
pub struct Evaluation {
    pub id: String,
    pub query: EvaluationQuery,
    /// The cells of the query, in the order in which they run.
    pub cells: Vec<Cell>,
    /// The maps of the query.
    maps: Vec<Map>,
    pub(super) policies: Arc<policy::Library>,
    /// The program of the query.
    program: Option<Arc<Program>>,
    /// Cancellation flag, checked at every tick of every trial.
    stop: AtomicBool,
    progress: Mutex<Progress>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Another job is running.
    Waiting,
    Running,
    /// All cells are complete.
    Done,
    /// It was cancelled; completed rows are kept.
    Cancelled,
    /// A trial failed with an error; completed rows are kept.
    Failed(String),
}

impl Stage {
    /// Whether the evaluation has ended.
    pub fn is_final(&self) -> bool {
        !matches!(self, Self::Waiting | Self::Running)
    }
}

#[derive(Clone, Debug)]
pub struct Progress {
    pub stage: Stage,
    /// One entry per cell.
    pub cells: Vec<CellProgress>,
    /// Results of the completed cells, in order. An interrupted cell has no result: its trials that ended first are
    /// the short ones, and not a fair sample.
    pub results: Vec<Arc<CellResult>>,
}

#[derive(Clone, Debug, Default)]
pub struct CellProgress {
    /// Number of trials that ended.
    pub done: u32,
    /// Number of these that delivered.
    pub delivered: u32,
    /// Time until the last trial ended.
    pub elapsed_s: f64,
}

#[derive(Clone, Debug)]
pub struct CellResult {
    pub row: Row,
    /// Trials that did not deliver.
    pub failures: Vec<Failure>,
    /// All its trials, in order.
    pub episodes: Vec<Episode>,
}

impl CellResult {
    /// Summarises a cell's episodes.
    pub(super) fn of(cell: &Cell, episodes: Vec<Episode>) -> Self {
        let failures = episodes.iter().filter_map(|episode| Failure::of(cell, episode)).collect();
        Self { row: Row::of(cell, &episodes), failures, episodes }
    }
}

impl Progress {
    /// The completed cells with their trials.
    pub fn done<'a>(&'a self, cells: &'a [Cell]) -> Vec<(&'a Cell, &'a [Episode])> {
        cells.iter().zip(&self.results).map(|(cell, result)| (cell, result.episodes.as_slice())).collect()
    }
}

impl Evaluation {
    /// A waiting evaluation; `cells` and `maps` belong to the query.
    pub(super) fn new(
        id: String,
        query: EvaluationQuery,
        cells: Vec<Cell>,
        maps: Vec<Map>,
        policies: Arc<policy::Library>,
        program: Option<Arc<Program>>,
    ) -> Arc<Self> {
        let progress =
            Progress { stage: Stage::Waiting, cells: vec![CellProgress::default(); cells.len()], results: Vec::new() };
        Arc::new(Self {
            id,
            query,
            cells,
            maps,
            policies,
            program,
            stop: AtomicBool::new(false),
            progress: Mutex::new(progress),
        })
    }

    /// The venue of a cell's trials.
    pub(super) fn map(&self, cell: &Cell) -> Option<&Map> {
        self.maps.iter().find(|map| map.name() == cell.map)
    }

    pub fn progress(&self) -> Progress {
        self.lock().clone()
    }

    pub fn stage(&self) -> Stage {
        self.lock().stage.clone()
    }

    /// Cancels the evaluation: running trials stop at their next tick. Returns false if it had already ended.
    pub fn cancel(&self) -> bool {
        let mut progress = self.lock();
        if progress.stage == Stage::Waiting {
            progress.stage = Stage::Cancelled;
            return true;
        }
        let runs = progress.stage == Stage::Running;
        if runs {
            self.stop.store(true, Ordering::Relaxed);
        }
        runs
    }

    pub(super) fn stop(&self) -> &AtomicBool {
        &self.stop
    }

    /// Starts the evaluation. Returns false if it was cancelled.
    pub(super) fn start(&self) -> bool {
        let mut progress = self.lock();
        let waits = progress.stage == Stage::Waiting;
        if waits {
            progress.stage = Stage::Running;
        }
        waits
    }

    pub(super) fn note(&self, cell: usize, began: Instant, episode: &Episode) {
        let mut progress = self.lock();
        let cell = &mut progress.cells[cell];
        cell.done += 1;
        cell.delivered += u32::from(episode.delivered);
        cell.elapsed_s = began.elapsed().as_secs_f64();
    }

    pub(super) fn add(&self, result: CellResult) {
        self.lock().results.push(Arc::new(result));
    }

    pub(super) fn end(&self, stage: Stage) {
        self.lock().stage = stage;
    }

    /// The experiment of a cell.
    pub(super) fn experiment(&self, cell: &Cell, venue: &Arc<Venue>) -> Experiment {
        Experiment {
            cell: cell.clone(),
            venue: venue.clone(),
            map: cell.map.clone(),
            episodes: self.query.episodes,
            seed: self.query.seed,
            parameters: Parameters { rl_policy: self.query.rl_policy.clone(), ..Parameters::default() },
            manner: Manner::default(),
            program: self.program.clone().filter(|_| cell.program.is_some()),
        }
    }

    /// Ignores lock poisoning: a panicking trial holds no lock here, and the numbers would still be consistent.
    fn lock(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
