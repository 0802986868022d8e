//! The recovery maps of a server, in its queue of background jobs.

use std::sync::Arc;

use super::{Cell, Findings, Recovery, RecoveryError, RecoveryQuery, Start, unrecorded};
use crate::changes::Changes;
use crate::evaluate::EvaluateError;
use crate::jobs::{Life, Queue, QueueError, Shelf, Shelved, Stage, Workshop};
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{Case, Origin, Timed};

/// A recovery map in the background.
pub struct RecoveryJob {
    pub id: String,
    /// The session of its moment, and the number of its trial there.
    pub session: Option<(String, u64)>,
    pub recovery: Recovery,
    pub life: Life<Findings>,
}

impl RecoveryJob {
    /// A trial that has ended, to be set up in a session: the moment, what it is, and the inputs after it.
    pub fn set_up(&self, cell: u32, controller: ControllerName, repeat: u32) -> Option<(Origin, String, Vec<Timed>)> {
        let recovery = &self.recovery;
        self.find(cell, controller, repeat, |cell, controller, repeat| {
            let about = format!("{}, {}", self.id, recovery.trial_name(cell, controller, repeat));
            (recovery.start.origin.clone(), about, recovery.inputs_of(cell, controller, repeat))
        })
    }

    /// A trial that has ended as a test case. `None` inside if the inputs before the moment are not known.
    pub fn case(&self, cell: u32, controller: ControllerName, repeat: u32) -> Option<Option<Case>> {
        self.find(cell, controller, repeat, |cell, controller, repeat| self.recovery.case(cell, controller, repeat))
    }

    fn find<T>(
        &self,
        cell: u32,
        controller: ControllerName,
        repeat: u32,
        read: impl FnOnce(&Cell, usize, usize) -> T,
    ) -> Option<T> {
        let controller = self.recovery.query.controllers.iter().position(|&name| name == controller)?;
        self.life.read(|_, findings| {
            let cell = findings.cells.get(cell as usize)?;
            cell.tries[controller].get(repeat as usize)?.as_ref()?;
            Some(read(cell, controller, repeat as usize))
        })
    }
}

impl Shelved for RecoveryJob {
    type Found = Findings;

    fn id(&self) -> &str {
        &self.id
    }

    fn life(&self) -> &Life<Findings> {
        &self.life
    }

    fn work(&self, workshop: &Workshop) -> Stage {
        let run = || self.recovery.run(None, &workshop.gpu, &self.life, &unrecorded, &|_| ());
        EvaluateError::stage_after(workshop.pool.install(run))
    }
}

/// Why a recovery map is rejected.
#[derive(Debug, thiserror::Error)]
pub enum SubmitRecoveryError {
    #[error(transparent)]
    Query(#[from] RecoveryError),
    #[error(transparent)]
    Queue(#[from] QueueError),
}

/// Recovery maps by id: waiting, running, and the last ones that ended.
pub struct Recoveries(Shelf<RecoveryJob>);

impl Recoveries {
    /// Recovery maps that run in a queue.
    pub fn new(queue: Arc<Queue>) -> Self {
        Self(Shelf::new(queue, "recovery"))
    }

    /// # Errors
    /// [`SubmitRecoveryError`]; then nothing has changed.
    pub fn submit(
        &self,
        session: Option<(String, u64)>,
        query: RecoveryQuery,
        start: Start,
    ) -> Result<Arc<RecoveryJob>, SubmitRecoveryError> {
        let recovery = Recovery::new(query, start)?;
        let make = |id| Arc::new(RecoveryJob { id, session, recovery, life: Life::new(Findings::default()) });
        Ok(self.0.submit(make)?)
    }

    pub fn find(&self, id: &str) -> Option<Arc<RecoveryJob>> {
        self.0.find(id)
    }

    pub fn all(&self) -> Vec<Arc<RecoveryJob>> {
        self.0.all()
    }

    /// Those of the list.
    pub fn changes(&self) -> &Changes {
        self.0.changes()
    }
}
