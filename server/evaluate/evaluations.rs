//! The evaluations of a server.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{Evaluation, EvaluationQuery, QueryError};
use crate::jobs::{Queue, QueueError};
use crate::program::Program;
use crate::trial::Catalog;

/// Number of ended evaluations that are kept.
const KEPT: usize = 16;

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
pub struct Evaluations {
    queue: Arc<Queue>,
    kept: Mutex<Kept>,
}

#[derive(Default)]
struct Kept {
    /// In the order of submission.
    evaluations: VecDeque<Arc<Evaluation>>,
    /// Number of evaluations created so far, for their names.
    made: u64,
}

impl Kept {
    /// Removes the oldest ended evaluations.
    fn prune(&mut self) {
        let ended = self.evaluations.iter().filter(|evaluation| evaluation.stage().is_final()).count();
        for _ in KEPT..ended {
            if let Some(oldest) = self.evaluations.iter().position(|evaluation| evaluation.stage().is_final()) {
                self.evaluations.remove(oldest);
            }
        }
    }
}

impl Evaluations {
    /// Evaluations that run in a queue.
    pub fn new(queue: Arc<Queue>) -> Self {
        Self { queue, kept: Mutex::default() }
    }

    /// Adds an evaluation on maps and with a policy of a catalog, and with the program that has the query's name.
    ///
    /// # Errors
    /// [`SubmitError`].
    pub fn submit(
        &self,
        mut query: EvaluationQuery,
        catalog: &Catalog,
        program: Option<Arc<Program>>,
    ) -> Result<Arc<Evaluation>, SubmitError> {
        let cells = query.cells()?;
        if query.program.is_some() && !program.as_ref().is_some_and(|program| program.standing().is_connected) {
            return Err(QueryError::Program { name: query.program, why: "which is not connected" }.into());
        }
        // Reads the maps without holding the lock.
        let maps = query.maps(&catalog.maps)?;
        query.rl_policy = catalog.policies.resolve(&query.rl_policy).map_err(QueryError::from)?;
        let mut kept = self.lock();
        let id = format!("evaluation-{}", kept.made + 1);
        let evaluation = Evaluation::new(id, query, cells, maps, catalog.policies.clone(), program);
        self.queue.submit(evaluation.clone())?;
        kept.made += 1;
        kept.evaluations.push_back(evaluation.clone());
        kept.prune();
        Ok(evaluation)
    }

    pub fn find(&self, id: &str) -> Option<Arc<Evaluation>> {
        self.lock().evaluations.iter().find(|evaluation| evaluation.id == id).cloned()
    }

    /// All kept evaluations, in the order of submission.
    pub fn all(&self) -> Vec<Arc<Evaluation>> {
        let mut kept = self.lock();
        kept.prune();
        kept.evaluations.iter().cloned().collect()
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
