//! One evaluation: what was asked, how far it is, what came of it.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, MutexGuard, PoisonError};
use std::time::Instant;

use super::{Cell, Episode, EvaluationQuery, Experiment, Failure, Row, Venue};
use crate::map::Map;
use crate::scenario::Parameters;

/// An evaluation. Whoever runs it writes, all others look.
#[derive(Debug)]
pub struct Evaluation {
    /// Its name.
    pub id: String,
    /// What was asked.
    pub query: EvaluationQuery,
    /// What that comes to, in the order in which it runs.
    pub cells: Vec<Cell>,
    /// The maps that these name.
    maps: Vec<Map>,
    /// Every tick of every trial looks at it.
    stop: AtomicBool,
    progress: Mutex<Progress>,
}

/// How an evaluation stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Another one runs.
    Waiting,
    /// It runs.
    Running,
    /// Every cell has its row.
    Done,
    /// Somebody wanted no more of it; the rows up to then are kept.
    Cancelled,
    /// A trial could not go on; the rows up to then are kept.
    Failed(String),
}

impl Stage {
    /// Whether nothing more comes.
    pub fn is_final(&self) -> bool {
        !matches!(self, Self::Waiting | Self::Running)
    }
}

/// How far an evaluation is.
#[derive(Clone, Debug)]
pub struct Progress {
    /// How it stands.
    pub stage: Stage,
    /// One a cell.
    pub cells: Vec<CellProgress>,
    /// The cells that are through, from the first. A cell that was broken off has none: what ends early is not a
    /// fair sample of it.
    pub results: Vec<Arc<CellResult>>,
}

/// How far a cell is.
#[derive(Clone, Debug, Default)]
pub struct CellProgress {
    /// Trials that ended.
    pub done: u32,
    /// Of these, trials whose bead arrived.
    pub delivered: u32,
    /// How long it ran, to the last trial that ended.
    pub elapsed_s: f64,
}

/// What came of a cell.
#[derive(Clone, Debug)]
pub struct CellResult {
    /// Its row of the table.
    pub row: Row,
    /// Trials whose bead did not arrive.
    pub failures: Vec<Failure>,
    /// All its trials, in their order.
    pub episodes: Vec<Episode>,
}

impl CellResult {
    /// Adds a cell's episodes up.
    pub(super) fn of(cell: &Cell, episodes: Vec<Episode>) -> Self {
        let failures = episodes.iter().filter_map(|episode| Failure::of(cell, episode)).collect();
        Self { row: Row::of(cell, &episodes), failures, episodes }
    }
}

impl Progress {
    /// The cells that are through, with their trials.
    pub fn done<'a>(&'a self, cells: &'a [Cell]) -> Vec<(&'a Cell, &'a [Episode])> {
        cells.iter().zip(&self.results).map(|(cell, result)| (cell, result.episodes.as_slice())).collect()
    }
}

impl Evaluation {
    /// One that waits; `cells` and `maps` are the query's.
    pub(super) fn new(id: String, query: EvaluationQuery, cells: Vec<Cell>, maps: Vec<Map>) -> Arc<Self> {
        let progress =
            Progress { stage: Stage::Waiting, cells: vec![CellProgress::default(); cells.len()], results: Vec::new() };
        Arc::new(Self { id, query, cells, maps, stop: AtomicBool::new(false), progress: Mutex::new(progress) })
    }

    /// Where a cell's trials take place.
    pub(super) fn map(&self, cell: &Cell) -> Option<&Map> {
        self.maps.iter().find(|map| map.name() == cell.map)
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.lock().clone()
    }

    /// How it stands.
    pub fn stage(&self) -> Stage {
        self.lock().stage.clone()
    }

    /// Wants no more of it: trials that run stop at their next tick. False when it had ended already.
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

    /// Its turn. False when nobody wants it any more.
    pub(super) fn begin(&self) -> bool {
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

    /// What the table's row of a cell comes from.
    pub(super) fn experiment(&self, cell: &Cell, venue: &Arc<Venue>) -> Experiment {
        Experiment {
            cell: cell.clone(),
            venue: venue.clone(),
            map: cell.map.clone(),
            episodes: self.query.episodes,
            seed: self.query.seed,
            parameters: Parameters::default(),
        }
    }

    /// A trial that panics holds no lock of ours; should one ever, its numbers are still whole.
    fn lock(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
