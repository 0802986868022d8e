//! Jobs in the background, in two lanes: in each one after the other, at low priority, on threads and a graphics device of
//! its own.

mod lane;
mod life;
mod shelf;
#[cfg(test)]
mod tests;
mod workshop;

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

use crate::changes::Changes;
use ferry_camera::Gpu;
use ferry_core::panics;

pub use lane::{Lane, Paces, Ticket};
pub use life::{Life, Stage};
pub use shelf::{Shelf, Shelved};
pub use workshop::{Workshop, WorkshopError, gentle_device, gentle_pool, gentle_thread};

/// Maximum number of waiting jobs in a lane.
const WAITING_LIMIT: usize = 4;

/// Why a job is rejected.
#[derive(Debug, thiserror::Error)]
pub enum QueueError {
    /// Too many wait in its lane.
    #[error("the lane of {} jobs is full: {WAITING_LIMIT} are waiting; cancel one or try again later", lane.as_str())]
    Full { lane: Lane },
    #[error("{limit} jobs of this kind are paused; cancel one, or let one go on")]
    Paused { limit: usize },
    /// The server is stopping.
    #[error("the server is stopping")]
    Closing,
}

/// Work for the queue.
pub trait Job: Send + Sync {
    fn id(&self) -> &str;

    fn lane(&self) -> Lane;

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

/// The jobs of a lane, and the thread that runs them.
struct Runner {
    shared: Arc<Shared>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

/// The queue of a server. Dropping it interrupts the running jobs.
pub struct Queue {
    /// As [`Lane::ALL`].
    lanes: [Runner; 2],
    pub paces: Arc<Paces>,
    /// Those of all jobs.
    pub changes: Changes,
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

    fn serve(&self, lane: Lane, gpu: &Gpu, paces: &Arc<Paces>) {
        // Made on first use: most servers never run a job.
        let mut workshop = None;
        while let Some(job) = self.next() {
            match workshop.take().map_or_else(|| Workshop::new(lane, gpu, paces.clone()), Ok) {
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
    /// An empty queue whose devices will be like `gpu`.
    ///
    /// # Errors
    /// A thread could not start.
    pub fn start(gpu: &Arc<Gpu>) -> std::io::Result<Self> {
        let paces = Arc::new(Paces::default());
        let begin = |lane: Lane| {
            let shared = Arc::new(Shared::default());
            let (served, gpu, paces) = (shared.clone(), gpu.clone(), paces.clone());
            let name = format!("{} jobs", lane.as_str());
            let thread = gentle_thread(lane, name, move || served.serve(lane, &gpu, &paces))?;
            Ok::<_, std::io::Error>(Runner { shared, thread: Mutex::new(Some(thread)) })
        };
        let [short, long] = Lane::ALL.map(begin);
        Ok(Self { lanes: [short?, long?], paces, changes: Changes::default() })
    }

    fn of(&self, lane: Lane) -> &Shared {
        &self.lanes[lane as usize].shared
    }

    /// Adds a job to the end of its lane.
    ///
    /// # Errors
    /// [`QueueError`].
    pub fn submit(&self, job: Arc<dyn Job>) -> Result<(), QueueError> {
        let lane = job.lane();
        let shared = self.of(lane);
        let mut line = shared.lock();
        if line.closing {
            return Err(QueueError::Closing);
        }
        // One that was paused while it waited is still in its old place.
        line.waiting.retain(|other| other.is_waiting() && other.id() != job.id());
        if line.waiting.len() >= WAITING_LIMIT {
            return Err(QueueError::Full { lane });
        }
        line.waiting.push_back(job);
        shared.news.notify_one();
        Ok(())
    }

    /// The ids of a lane's jobs in their order: the one that runs, then those that wait.
    pub fn order(&self, lane: Lane) -> Vec<String> {
        let line = self.of(lane).lock();
        let waiting = line.waiting.iter().filter(|job| job.is_waiting());
        line.running.iter().chain(waiting).map(|job| job.id().to_owned()).collect()
    }

    /// Closes the queue and interrupts the running jobs, without waiting for them. No waiting job begins any more.
    pub fn stop(&self) {
        for Runner { shared, .. } in &self.lanes {
            let mut line = shared.lock();
            if std::mem::replace(&mut line.closing, true) {
                continue;
            }
            for job in line.waiting.iter().chain(&line.running) {
                job.interrupt();
            }
            shared.news.notify_all();
        }
    }

    /// Closes the queue and waits until it has stopped.
    pub fn close(&self) {
        self.stop();
        for Runner { thread, .. } in &self.lanes {
            let thread = thread.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let Some(thread) = thread {
                // Panics of jobs are caught.
                let _ = thread.join();
            }
        }
    }
}

impl Drop for Queue {
    fn drop(&mut self) {
        self.close();
    }
}
