//! The threads and the graphics device of jobs, with lower priority than live sessions.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuilder};
use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

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

/// The threads and the graphics device of jobs.
pub struct Workshop {
    pub pool: ThreadPool,
    pub gpu: Arc<Gpu>,
}

/// Priority, 0 to 99; on Linux it becomes a niceness of 10, the default of the command `nice`. With the lowest
/// priority a job would make no progress while anything else runs.
const PRIORITY: u8 = 22;

/// Lowers the priority of this thread and of the threads that it starts.
pub(super) fn lower_priority() {
    let lowered = ThreadPriorityValue::try_from(PRIORITY).and_then(|value| {
        set_current_thread_priority(ThreadPriority::Crossplatform(value)).map_err(|error| error.to_string())
    });
    if let Err(error) = lowered {
        tracing::warn!(%error, "background work runs at normal priority");
    }
}

/// A pool with all cores, at low priority: a live session takes a core from it at once.
///
/// # Errors
/// The threads could not start.
pub fn gentle_pool(name: &'static str) -> Result<ThreadPool, rayon::ThreadPoolBuildError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    ThreadPoolBuilder::new()
        .num_threads(cores)
        .thread_name(move |index| format!("{name} {index}"))
        .start_handler(|_| lower_priority())
        .build()
}

impl Workshop {
    /// A pool with all cores, and a device like `gpu`. Call it on a thread with low priority: a software
    /// graphics driver starts its threads here, and they inherit the priority.
    ///
    /// # Errors
    /// [`WorkshopError`].
    pub fn new(gpu: &Gpu) -> Result<Self, WorkshopError> {
        // A panic in the driver ends one job, not the waiting ones.
        let another = catch_unwind(AssertUnwindSafe(|| gpu.another()));
        let gpu = another.unwrap_or_else(|panic| {
            let (adapter, reason) = (gpu.adapter_name().to_owned(), panics::message(&*panic));
            Err(CameraError::DeviceRefused { adapter, reason })
        })?;
        Ok(Self { pool: gentle_pool("job")?, gpu })
    }
}
