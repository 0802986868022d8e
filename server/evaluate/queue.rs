//! A queue that runs evaluations one after the other in the background.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

use super::engine::{Engine, lower_priority};
use super::{Evaluation, EvaluationQuery, QueryError, Stage};
use crate::camera::Gpu;
use crate::map::Library;

/// Maximum number of waiting evaluations.
const WAITING_LIMIT: usize = 4;
/// Number of ended evaluations that are kept.
const KEPT: usize = 16;

/// Why an evaluation is rejected.
#[derive(Debug, thiserror::Error)]
pub enum SubmitError {
    /// The query is invalid.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// The queue is full.
    #[error("the queue is full: {WAITING_LIMIT} evaluations are waiting; cancel one or try again later")]
    Full,
    /// The server is stopping.
    #[error("the server is stopping")]
    Closing,
}

/// The evaluations of a server. Dropping it cancels the running one.
pub struct Queue {
    shared: Arc<Shared>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

#[derive(Default)]
struct Shared {
    line: Mutex<Line>,
    /// Signals a new evaluation or the end.
    news: Condvar,
}

#[derive(Default)]
struct Line {
    /// In the order of submission.
    evaluations: VecDeque<Arc<Evaluation>>,
    /// Number of evaluations created so far, for their names.
    made: u64,
    closing: bool,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Line> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next waiting evaluation; `None` when the queue is closing.
    fn next(&self) -> Option<Arc<Evaluation>> {
        let mut line = self.lock();
        loop {
            if line.closing {
                return None;
            }
            if let Some(next) = line.evaluations.iter().find(|evaluation| evaluation.begin()) {
                return Some(next.clone());
            }
            line = self.news.wait(line).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn serve(&self, gpu: &Gpu) {
        lower_priority();
        let mut engine = None;
        while let Some(evaluation) = self.next() {
            tracing::info!(id = evaluation.id, "evaluation begins");
            // Created on first use: most servers never run an evaluation.
            let stage = match engine.take().map_or_else(|| Engine::new(gpu), Ok) {
                Ok(made) => engine.insert(made).run(&evaluation),
                Err(error) => Stage::Failed(error.to_string()),
            };
            tracing::info!(id = evaluation.id, ?stage, "evaluation ends");
            evaluation.end(stage);
            self.lock().prune();
        }
    }
}

impl Line {
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

impl Queue {
    /// An empty queue whose device will be like `gpu`.
    ///
    /// # Errors
    /// The thread could not start.
    pub fn start(gpu: Arc<Gpu>) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let served = shared.clone();
        let thread = std::thread::Builder::new().name("evaluate".into()).spawn(move || served.serve(&gpu))?;
        Ok(Self { shared, thread: Mutex::new(Some(thread)) })
    }

    /// Adds an evaluation on maps of a library.
    pub fn submit(&self, query: EvaluationQuery, library: &Library) -> Result<Arc<Evaluation>, SubmitError> {
        let cells = query.cells()?;
        // Reads the maps without holding the lock.
        let maps = query.maps(library)?;
        let mut line = self.shared.lock();
        if line.closing {
            return Err(SubmitError::Closing);
        }
        let waiting = line.evaluations.iter().filter(|other| other.stage() == Stage::Waiting).count();
        if waiting >= WAITING_LIMIT {
            return Err(SubmitError::Full);
        }
        line.made += 1;
        line.prune();
        let evaluation = Evaluation::new(format!("evaluation-{}", line.made), query, cells, maps);
        line.evaluations.push_back(evaluation.clone());
        self.shared.news.notify_one();
        Ok(evaluation)
    }

    pub fn find(&self, id: &str) -> Option<Arc<Evaluation>> {
        self.shared.lock().evaluations.iter().find(|evaluation| evaluation.id == id).cloned()
    }

    /// All kept evaluations, in the order of submission.
    pub fn all(&self) -> Vec<Arc<Evaluation>> {
        self.shared.lock().evaluations.iter().cloned().collect()
    }

    /// Closes the queue and cancels running and waiting evaluations, without waiting for them.
    pub fn stop(&self) {
        let mut line = self.shared.lock();
        line.closing = true;
        for evaluation in &line.evaluations {
            evaluation.cancel();
        }
        self.shared.news.notify_all();
    }

    /// Closes the queue and waits until it has stopped: for a tick of a trial, or for a map being read.
    pub fn close(&self) {
        self.stop();
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(thread) = thread {
            // The engine catches panics of trials.
            let _ = thread.join();
        }
    }
}

impl Drop for Queue {
    fn drop(&mut self) {
        self.close();
    }
}
