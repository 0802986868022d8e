//! The evaluations of a server.

use std::sync::Arc;

use super::{Evaluation, EvaluationQuery, QueryError};
use crate::changes::Changes;
use crate::jobs::{Queue, QueueError, Shelf};
use crate::program::Program;
use ferry_core::trial::Catalog;

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
        Self(Shelf::new(queue, "evaluation"))
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
        let maps = query.maps(&catalog.maps)?;
        query.rl_policy = catalog.policies.resolve(&query.rl_policy).map_err(QueryError::from)?;
        let make = |id| Evaluation::new(id, query, cells, maps, catalog.policies.clone(), program);
        Ok(self.0.submit(make)?)
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
