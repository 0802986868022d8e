//! The recovery maps of a server, in its queue of background jobs.

use std::sync::Arc;

use super::{Cell, Findings, Recovery, RecoveryError, RecoveryQuery, Start, unrecorded};
use crate::changes::Changes;
use crate::evaluate::EvaluateError;
use crate::jobs::{Lane, Life, Queue, QueueError, Shelf, Shelved, Stage, Ticket, Workshop};
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{Case, Origin, Timed};

/// The kind of work of a trial, for its pace, and the first guess of it: with a software graphics driver on two cores.
const WORK: &str = "recovery";
const GUESS_S: f64 = 0.3;

/// A recovery map in the background.
pub struct RecoveryJob {
    pub id: String,
    /// The session of its moment, and the number of its trial there.
    pub session: Option<(String, u64)>,
    pub recovery: Recovery,
    pub ticket: Ticket,
    pub life: Life<Findings>,
}

impl RecoveryJob {
    /// Estimated time that it still runs.
    pub fn left_s(&self) -> f64 {
        let (done, planned) = self.life.read(|_, findings| (findings.done, findings.planned));
        match done {
            0 => self.ticket.estimate_s,
            _ => self.life.spent_s() / done as f64 * (planned - done) as f64,
        }
    }

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

    fn ticket(&self) -> &Ticket {
        &self.ticket
    }

    fn work(&self, workshop: &Workshop) -> Stage {
        let done = || (self.life.read(|_, findings| findings.done), self.life.spent_s());
        let before = done();
        let run = || self.recovery.run(None, &workshop.gpu, &self.life, &unrecorded, &|_| ());
        let ran = workshop.pool.install(run);
        let after = done();
        workshop.paces.measure(WORK, after.0.saturating_sub(before.0) as f64, after.1 - before.1);
        EvaluateError::stage_after(ran)
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
        queue.paces.guess(WORK, GUESS_S);
        Self(Shelf::new(queue, "recovery"))
    }

    /// `owner` is the session that starts it.
    ///
    /// # Errors
    /// [`SubmitRecoveryError`]; then nothing has changed.
    pub fn submit(
        &self,
        owner: Option<String>,
        session: Option<(String, u64)>,
        query: RecoveryQuery,
        start: Start,
    ) -> Result<Arc<RecoveryJob>, SubmitRecoveryError> {
        let recovery = Recovery::new(query, start)?;
        let estimate_s = recovery.trials() as f64 * self.0.paces().each_s(WORK);
        let ticket = Ticket { owner, lane: Lane::of(estimate_s), estimate_s };
        let make = |id| Arc::new(RecoveryJob { id, session, recovery, ticket, life: Life::new(Findings::default()) });
        Ok(self.0.submit(make)?)
    }

    /// Pauses a recovery map; the trials that run begin again when it goes on. Returns false if it neither waits nor runs.
    ///
    /// # Errors
    /// [`QueueError`].
    pub fn pause(&self, job: &RecoveryJob) -> Result<bool, QueueError> {
        self.0.pause(job)
    }

    /// Lets a paused one wait again. Returns false if it is not paused.
    ///
    /// # Errors
    /// [`QueueError`].
    pub fn resume(&self, job: &Arc<RecoveryJob>) -> Result<bool, QueueError> {
        self.0.resume(job)
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
