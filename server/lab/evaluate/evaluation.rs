//! One evaluation: its query, progress and results.

use std::sync::Arc;
use std::time::Instant;

use super::variation::applied;
use super::{Cell, Episode, EvaluationQuery, Experiment, Failure, Manner, Row, Venue};
use crate::jobs::Life;
use crate::program::Program;
use ferry_core::map::Map;
use ferry_core::policy::Policies;
use ferry_core::scenario::{Parameters, SetError};

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
    pub life: Life<Progress>,
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
        policies: Arc<dyn Policies>,
        program: Option<Arc<Program>>,
    ) -> Arc<Self> {
        let progress = Progress { cells: vec![CellProgress::default(); cells.len()], results: Vec::new() };
        Arc::new(Self { id, query, cells, maps, policies, program, life: Life::new(progress) })
    }

    /// The venue of a cell's trials.
    pub(super) fn map(&self, cell: &Cell) -> Option<&Map> {
        self.maps.iter().find(|map| map.name() == cell.map)
    }

    pub(super) fn note(&self, cell: usize, began: Instant, episode: &Episode) {
        self.life.update(|progress| {
            let cell = &mut progress.cells[cell];
            cell.done += 1;
            cell.delivered += u32::from(episode.delivered);
            cell.elapsed_s = began.elapsed().as_secs_f64();
        });
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
