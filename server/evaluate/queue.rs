//! Evaluations one after the other, in the background.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

use super::engine::{Engine, give_way};
use super::{Evaluation, EvaluationQuery, QueryError, Stage};
use crate::camera::Gpu;
use crate::map::Library;

/// Evaluations that may wait while one runs.
const WAITING_LIMIT: usize = 4;
/// Evaluations that ended and are kept.
const KEPT: usize = 16;

/// Why an evaluation is not taken in.
#[derive(Debug, thiserror::Error)]
pub enum SubmitError {
    /// It asks for what cannot be done.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// Others wait already.
    #[error("{WAITING_LIMIT} evaluations wait already; cancel one, or come back later")]
    Full,
    /// The server stops.
    #[error("the server is stopping")]
    Closing,
}

/// The evaluations of a server. Dropping it breaks off the one that runs.
pub struct Queue {
    shared: Arc<Shared>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

#[derive(Default)]
struct Shared {
    line: Mutex<Line>,
    /// Somebody was added, or it is time to go.
    news: Condvar,
}

#[derive(Default)]
struct Line {
    /// In the order in which they were asked for.
    evaluations: VecDeque<Arc<Evaluation>>,
    /// Made so far, for their names.
    made: u64,
    closing: bool,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Line> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next that waits; none when it is time to go.
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
        give_way();
        let mut engine = None;
        while let Some(evaluation) = self.next() {
            tracing::info!(id = evaluation.id, "evaluation begins");
            // Most servers are never asked, so it is made when one first is.
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
    /// Forgets the oldest that ended.
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
    /// An empty one; its device will be like `gpu`.
    ///
    /// # Errors
    /// When the system gives no thread to run in.
    pub fn start(gpu: Arc<Gpu>) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let served = shared.clone();
        let thread = std::thread::Builder::new().name("evaluate".into()).spawn(move || served.serve(&gpu))?;
        Ok(Self { shared, thread: Mutex::new(Some(thread)) })
    }

    /// Takes an evaluation in, on maps of a library.
    pub fn submit(&self, query: EvaluationQuery, library: &Library) -> Result<Arc<Evaluation>, SubmitError> {
        let cells = query.cells()?;
        // Reads them, so nobody has to wait for it.
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

    /// The one of that name.
    pub fn find(&self, id: &str) -> Option<Arc<Evaluation>> {
        self.shared.lock().evaluations.iter().find(|evaluation| evaluation.id == id).cloned()
    }

    /// All that are kept, in the order in which they were asked for.
    pub fn all(&self) -> Vec<Arc<Evaluation>> {
        self.shared.lock().evaluations.iter().cloned().collect()
    }

    /// Takes nothing more in and breaks off what runs and waits; does not wait for it.
    pub fn stop(&self) {
        let mut line = self.shared.lock();
        line.closing = true;
        for evaluation in &line.evaluations {
            evaluation.cancel();
        }
        self.shared.news.notify_all();
    }

    /// The same, and waits: for a tick of a trial, or for a map being read.
    pub fn close(&self) {
        self.stop();
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(thread) = thread {
            // The engine catches the panics of trials.
            let _ = thread.join();
        }
    }
}

impl Drop for Queue {
    fn drop(&mut self) {
        self.close();
    }
}
