//! One evaluation: its query, progress and results.

use std::sync::{Arc, Mutex, PoisonError};

use super::variation::applied;
use super::{Cell, Episode, EvaluationQuery, Experiment, Failure, Manner, Row, Venue};
use crate::jobs::{Life, Paces, Ticket};
use crate::program::Program;
use ferry_core::map::Map;
use ferry_core::policy::Policies;
use ferry_core::scenario::{ControllerName, Parameters, SetError};

/// The kind of work of a controller's trials, for their pace.
pub(super) fn work_of(controller: ControllerName) -> String {
    format!("evaluation_{}", controller.as_str())
}

#[derive(Debug)]
pub struct Evaluation {
    pub id: String,
    pub query: EvaluationQuery,
    /// The cells of the query, in the order in which they run.
    pub cells: Vec<Cell>,
    /// The maps of the query.
    maps: Vec<Map>,
    pub(super) policies: Arc<dyn Policies>,
    /// The program of the query.
    program: Option<Arc<Program>>,
    pub ticket: Ticket,
    pub life: Life<Progress>,
    /// The trials of the present cell that have ended, in any order.
    pub(super) ended: Mutex<Vec<Episode>>,
}

/// What an evaluation has found so far.
#[derive(Clone, Debug)]
pub struct Progress {
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
    /// Time until the last trial ended, without pauses.
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
        policies: Arc<dyn Policies>,
        program: Option<Arc<Program>>,
        ticket: Ticket,
    ) -> Arc<Self> {
        let progress = Progress { cells: vec![CellProgress::default(); cells.len()], results: Vec::new() };
        let (life, ended) = (Life::new(progress), Mutex::default());
        Arc::new(Self { id, query, cells, maps, policies, program, ticket, life, ended })
    }

    /// The venue of a cell's trials.
    pub(super) fn map(&self, cell: &Cell) -> Option<&Map> {
        self.maps.iter().find(|map| map.name() == cell.map)
    }

    /// A trial has ended, so many seconds after the cell began, without pauses.
    pub(super) fn note(&self, cell: usize, elapsed_s: f64, episode: &Episode) {
        self.ended.lock().unwrap_or_else(PoisonError::into_inner).push(episode.clone());
        self.life.update(|progress| {
            let cell = &mut progress.cells[cell];
            cell.done += 1;
            cell.delivered += u32::from(episode.delivered);
            cell.elapsed_s = elapsed_s;
        });
    }

    /// Number of trials that have ended, and of all.
    pub fn trials(&self) -> [u32; 2] {
        let done = self.life.read(|_, progress| progress.cells.iter().map(|cell| cell.done).sum());
        [done, self.query.episodes * self.cells.len() as u32]
    }

    /// Estimated time that it still runs: cells as quick as they were so far, others as all are on this machine.
    pub fn left_s(&self, paces: &Paces) -> f64 {
        self.life.read(|_, progress| {
            let left_s = |(cell, at): (&Cell, &CellProgress)| {
                let each_s = match at.done {
                    0 => paces.each_s(&work_of(cell.controller)),
                    done => at.elapsed_s / f64::from(done),
                };
                f64::from(self.query.episodes - at.done) * each_s
            };
            self.cells.iter().zip(&progress.cells).map(left_s).sum()
        })
    }

    /// The experiment of a cell.
    pub(super) fn experiment(&self, cell: &Cell, venue: &Arc<Venue>) -> Result<Experiment, SetError> {
        let parameters = Parameters { rl_policy: self.query.rl_policy.clone(), ..Parameters::default() };
        let parameters = applied(&parameters, &cell.varied)?;
        Ok(Experiment {
            cell: cell.clone(),
            venue: venue.clone(),
            map: cell.map.clone(),
            episodes: self.query.episodes,
            seed: self.query.seed,
            parameters,
            manner: Manner::default(),
            program: self.program.clone().filter(|_| cell.program.is_some()),
        })
    }
}
