//! The threads and the graphics device of jobs, with lower priority than live sessions.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::JoinHandle;

use rayon::{ThreadPool, ThreadPoolBuilder};
use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

use super::{Lane, Paces};
use ferry_camera::Gpu;
use ferry_core::image::CameraError;
use ferry_core::panics;

/// Why the workshop could not open.
#[derive(Debug, thiserror::Error)]
pub enum WorkshopError {
    #[error(transparent)]
    Camera(#[from] CameraError),
    #[error("the threads for jobs could not start: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// The threads and the graphics device of a lane's jobs.
pub struct Workshop {
    pub pool: ThreadPool,
    pub gpu: Arc<Gpu>,
    /// Of the queue.
    pub paces: Arc<Paces>,
}

/// Lowers the priority of this thread and of the threads that it starts.
fn lower_priority(lane: Lane) {
    let lowered = ThreadPriorityValue::try_from(lane.priority()).and_then(|value| {
        set_current_thread_priority(ThreadPriority::Crossplatform(value)).map_err(|error| error.to_string())
    });
    if let Err(error) = lowered {
        tracing::warn!(%error, "background work runs at normal priority");
    }
}

/// A thread with the low priority of a lane.
///
/// # Errors
/// It could not start.
pub fn gentle_thread<T: Send + 'static>(
    lane: Lane,
    name: String,
    work: impl FnOnce() -> T + Send + 'static,
) -> std::io::Result<JoinHandle<T>> {
    std::thread::Builder::new().name(name).spawn(move || {
        lower_priority(lane);
        work()
    })
}

/// A pool with all cores, at low priority: a live session takes a core from it at once.
///
/// # Errors
/// The threads could not start.
pub fn gentle_pool(lane: Lane, name: &'static str) -> Result<ThreadPool, rayon::ThreadPoolBuildError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    ThreadPoolBuilder::new()
        .num_threads(cores)
        .thread_name(move |index| format!("{name} {index}"))
        .start_handler(move |_| lower_priority(lane))
        .build()
}

/// A device like `gpu`. Call it on a thread with low priority: a software graphics driver starts its threads here, and they
/// inherit the priority.
///
/// # Errors
/// [`CameraError`], also after a panic in the driver, which must not end what waits.
pub fn gentle_device(gpu: &Gpu) -> Result<Arc<Gpu>, CameraError> {
    catch_unwind(AssertUnwindSafe(|| gpu.another())).unwrap_or_else(|panic| {
        let (adapter, reason) = (gpu.adapter_name().to_owned(), panics::message(&*panic));
        Err(CameraError::DeviceRefused { adapter, reason })
    })
}

impl Workshop {
    /// A pool with all cores, and a device like `gpu`. Call it on a thread with the priority of the lane.
    ///
    /// # Errors
    /// [`WorkshopError`].
    pub fn new(lane: Lane, gpu: &Gpu, paces: Arc<Paces>) -> Result<Self, WorkshopError> {
        Ok(Self { pool: gentle_pool(lane, "job")?, gpu: gentle_device(gpu)?, paces })
    }
}
