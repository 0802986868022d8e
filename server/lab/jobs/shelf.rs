//! The jobs of one kind: waiting, running, and the last ones that ended.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{Job, Lane, Life, Paces, Queue, QueueError, Stage, Ticket, Workshop};
use crate::changes::Changes;

/// Number of ended jobs that are kept.
const KEPT: usize = 16;
/// Maximum number of paused jobs.
const PAUSED_LIMIT: usize = 16;

/// A job that is found by its id.
pub trait Shelved: Send + Sync + 'static {
    type Found: Send;

    fn id(&self) -> &str;

    fn life(&self) -> &Life<Self::Found>;

    fn ticket(&self) -> &Ticket;

    /// Runs until it has ended or was cancelled, and returns the stage in which it ends.
    fn work(&self, workshop: &Workshop) -> Stage;
}

impl<J: Shelved> Job for J {
    fn id(&self) -> &str {
        Shelved::id(self)
    }

    fn lane(&self) -> Lane {
        self.ticket().lane
    }

    fn is_waiting(&self) -> bool {
        self.life().stage() == Stage::Waiting
    }

    fn begin(&self) -> bool {
        self.life().begin()
    }

    fn run(&self, workshop: &Workshop) {
        let id = Shelved::id(self);
        tracing::info!(id, "job begins");
        let stage = self.work(workshop);
        tracing::info!(id, ?stage, "job ends");
        self.life().end(stage);
    }

    fn fail(&self, reason: String) {
        self.life().end(Stage::Failed(reason));
    }

    fn interrupt(&self) {
        self.life().cancel();
    }
}

/// Jobs by id.
pub struct Shelf<J> {
    queue: Arc<Queue>,
    /// Before the number of each id.
    name: &'static str,
    kept: Mutex<Kept<J>>,
    changes: Changes,
}

struct Kept<J> {
    /// In the order of submission.
    jobs: VecDeque<Arc<J>>,
    /// Number of jobs so far, for their ids.
    made: u64,
}

impl<J: Shelved> Kept<J> {
    /// Removes the oldest ended jobs.
    fn prune(&mut self) {
        let ended = self.jobs.iter().filter(|job| job.life().stage().is_final()).count();
        for _ in KEPT..ended {
            if let Some(oldest) = self.jobs.iter().position(|job| job.life().stage().is_final()) {
                self.jobs.remove(oldest);
            }
        }
    }
}

impl<J: Shelved> Shelf<J> {
    /// Jobs that run in a queue; their ids are the name with a number.
    pub fn new(queue: Arc<Queue>, name: &'static str) -> Self {
        let kept = Mutex::new(Kept { jobs: VecDeque::new(), made: 0 });
        let changes = Changes::part_of(&queue.changes);
        Self { queue, name, kept, changes }
    }

    /// Makes a job for its id, and queues it.
    ///
    /// # Errors
    /// [`QueueError`]; then nothing has changed.
    pub fn submit(&self, make: impl FnOnce(String) -> Arc<J>) -> Result<Arc<J>, QueueError> {
        let mut kept = self.lock();
        let job = make(format!("{}-{}", self.name, kept.made + 1));
        job.life().report_to(&self.changes);
        self.queue.submit(job.clone())?;
        kept.made += 1;
        kept.jobs.push_back(job.clone());
        kept.prune();
        drop(kept);
        self.changes.note();
        Ok(job)
    }

    pub fn find(&self, id: &str) -> Option<Arc<J>> {
        self.lock().jobs.iter().find(|job| Shelved::id(&***job) == id).cloned()
    }

    /// All kept jobs, in the order of submission.
    pub fn all(&self) -> Vec<Arc<J>> {
        let mut kept = self.lock();
        kept.prune();
        kept.jobs.iter().cloned().collect()
    }

    /// Pauses a job. Returns false if it neither waits nor runs.
    ///
    /// # Errors
    /// [`QueueError::Paused`].
    pub fn pause(&self, job: &J) -> Result<bool, QueueError> {
        let paused = self.lock().jobs.iter().filter(|job| job.life().stage() == Stage::Paused).count();
        if paused >= PAUSED_LIMIT {
            return Err(QueueError::Paused { limit: PAUSED_LIMIT });
        }
        Ok(job.life().pause())
    }

    /// Lets a paused job wait in its lane again. Returns false if it is not paused.
    ///
    /// # Errors
    /// [`QueueError`]; then it stays paused.
    pub fn resume(&self, job: &Arc<J>) -> Result<bool, QueueError> {
        if !job.life().resume() {
            return Ok(false);
        }
        if let Err(error) = self.queue.submit(job.clone()) {
            job.life().pause();
            return Err(error);
        }
        Ok(true)
    }

    /// Those of the queue.
    pub fn paces(&self) -> &Paces {
        &self.queue.paces
    }

    pub fn changes(&self) -> &Changes {
        &self.changes
    }

    fn lock(&self) -> MutexGuard<'_, Kept<J>> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
