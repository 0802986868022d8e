//! The evaluations of a server.

use std::sync::Arc;

use super::evaluation::work_of;
use super::{Cell, Evaluation, EvaluationQuery, QueryError};
use crate::changes::Changes;
use crate::jobs::{Lane, Queue, QueueError, Shelf, Ticket};
use crate::program::Program;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::Catalog;

/// An evaluation with at most so many trials is short, also on a slow machine.
const SHORT_TRIALS: u32 = 30;
/// First guess of the time of a trial: with a software graphics driver on two cores.
const GUESS_S: f64 = 1.0;

/// Why an evaluation is rejected.
#[derive(Debug, thiserror::Error)]
pub enum SubmitError {
    /// The query is invalid.
    #[error(transparent)]
    Query(#[from] QueryError),
    #[error(transparent)]
    Queue(#[from] QueueError),
}

/// Evaluations by id, waiting, running and ended.
pub struct Evaluations(Shelf<Evaluation>);

impl Evaluations {
    /// Evaluations that run in a queue.
    pub fn new(queue: Arc<Queue>) -> Self {
        // A person and a robot client carry in no evaluation.
        let is_evaluated = |name: &ControllerName| !matches!(name, ControllerName::You | ControllerName::Robot);
        for controller in ControllerName::ALL.into_iter().filter(is_evaluated) {
            queue.paces.guess(&work_of(controller), GUESS_S);
        }
        Self(Shelf::new(queue, "evaluation"))
    }

    /// Adds an evaluation on maps and with a policy of a catalog, and with the program that has the query's name. `owner` is
    /// the session that starts it.
    ///
    /// # Errors
    /// [`SubmitError`].
    pub fn submit(
        &self,
        owner: Option<String>,
        mut query: EvaluationQuery,
        catalog: &Catalog,
        program: Option<Arc<Program>>,
    ) -> Result<Arc<Evaluation>, SubmitError> {
        let cells = query.cells()?;
        if query.program.is_some() && !program.as_ref().is_some_and(|program| program.standing().is_connected) {
            return Err(QueryError::Program { name: query.program, why: "which is not connected" }.into());
        }
        let maps = query.maps(&catalog.maps)?;
        query.rl_policy = catalog.policies.resolve(&query.rl_policy).map_err(QueryError::from)?;
        let episodes = query.episodes;
        let each_s = |cell: &Cell| self.0.paces().each_s(&work_of(cell.controller));
        let estimate_s = f64::from(episodes) * cells.iter().map(each_s).sum::<f64>();
        let is_short = episodes.saturating_mul(cells.len() as u32) <= SHORT_TRIALS;
        let lane = if is_short { Lane::Short } else { Lane::of(estimate_s) };
        let ticket = Ticket { owner, lane, estimate_s };
        let make = |id| Evaluation::new(id, query, cells, maps, catalog.policies.clone(), program, ticket);
        Ok(self.0.submit(make)?)
    }

    /// Pauses an evaluation; the trials that run begin again when it goes on. Returns false if it neither waits nor runs.
    ///
    /// # Errors
    /// [`QueueError`].
    pub fn pause(&self, evaluation: &Evaluation) -> Result<bool, QueueError> {
        self.0.pause(evaluation)
    }

    /// Lets a paused one wait again. Returns false if it is not paused.
    ///
    /// # Errors
    /// [`QueueError`].
    pub fn resume(&self, evaluation: &Arc<Evaluation>) -> Result<bool, QueueError> {
        self.0.resume(evaluation)
    }

    pub fn find(&self, id: &str) -> Option<Arc<Evaluation>> {
        self.0.find(id)
    }

    /// All kept evaluations, in the order of submission.
    pub fn all(&self) -> Vec<Arc<Evaluation>> {
        self.0.all()
    }

    /// Those of the list.
    pub fn changes(&self) -> &Changes {
        self.0.changes()
    }
}
