//! Jobs in the background: one after the other, at low priority, on threads and a graphics device of their own.

mod life;
mod shelf;
#[cfg(test)]
mod tests;
mod workshop;

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

use ferry_camera::Gpu;
use ferry_core::panics;

pub use life::{Life, Stage};
pub use shelf::{Shelf, Shelved};
pub use workshop::{Workshop, WorkshopError, gentle_pool};

/// Maximum number of waiting jobs.
const WAITING_LIMIT: usize = 4;

/// Why a job is rejected.
#[derive(Debug, thiserror::Error)]
pub enum QueueError {
    /// The queue is full.
    #[error("the queue is full: {WAITING_LIMIT} jobs are waiting; cancel one or try again later")]
    Full,
    /// The server is stopping.
    #[error("the server is stopping")]
    Closing,
}

/// Work for the queue.
pub trait Job: Send + Sync {
    /// Whether it still waits; it may have been cancelled.
    fn is_waiting(&self) -> bool;

    /// Starts it. Returns false if it no longer waits.
    fn begin(&self) -> bool;

    /// Runs until it has ended or was interrupted.
    fn run(&self, workshop: &Workshop);

    /// Ends it with an error.
    fn fail(&self, reason: String);

    /// The server stops: a running job returns soon.
    fn interrupt(&self);
}

/// The queue of a server. Dropping it interrupts the running job.
pub struct Queue {
    shared: Arc<Shared>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

#[derive(Default)]
struct Shared {
    line: Mutex<Line>,
    /// Signals a new job or the end.
    news: Condvar,
}

#[derive(Default)]
struct Line {
    waiting: VecDeque<Arc<dyn Job>>,
    running: Option<Arc<dyn Job>>,
    closing: bool,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Line> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next waiting job, begun; `None` when the queue is closing.
    fn next(&self) -> Option<Arc<dyn Job>> {
        let mut line = self.lock();
        loop {
            line.running = None;
            if line.closing {
                return None;
            }
            while let Some(job) = line.waiting.pop_front() {
                if job.begin() {
                    line.running = Some(job.clone());
                    return Some(job);
                }
            }
            line = self.news.wait(line).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn serve(&self, gpu: &Gpu) {
        workshop::lower_priority();
        // Made on first use: most servers never run a job.
        let mut workshop = None;
        while let Some(job) = self.next() {
            match workshop.take().map_or_else(|| Workshop::new(gpu), Ok) {
                Ok(made) => run(&*job, workshop.insert(made)),
                Err(error) => job.fail(error.to_string()),
            }
        }
    }
}

/// A panic ends only its own job.
fn run(job: &dyn Job, workshop: &Workshop) {
    if let Err(panic) = catch_unwind(AssertUnwindSafe(|| job.run(workshop))) {
        job.fail(format!("the job panicked: {}", panics::message(&*panic)));
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
        let thread = std::thread::Builder::new().name("jobs".into()).spawn(move || served.serve(&gpu))?;
        Ok(Self { shared, thread: Mutex::new(Some(thread)) })
    }

    /// Adds a job to the end.
    ///
    /// # Errors
    /// [`QueueError`].
    pub fn submit(&self, job: Arc<dyn Job>) -> Result<(), QueueError> {
        let mut line = self.shared.lock();
        if line.closing {
            return Err(QueueError::Closing);
        }
        line.waiting.retain(|job| job.is_waiting());
        if line.waiting.len() >= WAITING_LIMIT {
            return Err(QueueError::Full);
        }
        line.waiting.push_back(job);
        self.shared.news.notify_one();
        Ok(())
    }

    /// Closes the queue and interrupts the running job, without waiting for it. No waiting job begins any more.
    pub fn stop(&self) {
        let mut line = self.shared.lock();
        if std::mem::replace(&mut line.closing, true) {
            return;
        }
        for job in line.waiting.iter().chain(&line.running) {
            job.interrupt();
        }
        self.shared.news.notify_all();
    }

    /// Closes the queue and waits until it has stopped.
    pub fn close(&self) {
        self.stop();
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(thread) = thread {
            // Panics of jobs are caught.
            let _ = thread.join();
        }
    }
}

impl Drop for Queue {
    fn drop(&mut self) {
        self.close();
    }
}
