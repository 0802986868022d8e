//! The engine of evaluations: separate threads and a separate graphics device, with lower priority than live
//! sessions.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::Instant;

use rayon::{ThreadPool, ThreadPoolBuilder};
use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

use super::{CellResult, EvaluateError, Evaluation, Stage, Venue, Watch, run, unrecorded};
use crate::camera::{CameraError, Gpu};
use crate::faults;
use crate::map::MapError;
use crate::trial::Arena;

/// Why the engine could not start.
#[derive(Debug, thiserror::Error)]
pub(super) enum EngineError {
    #[error(transparent)]
    Camera(#[from] CameraError),
    #[error("the threads of the evaluation could not start: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

pub(super) struct Engine {
    pool: ThreadPool,
    gpu: Arc<Gpu>,
}

/// Priority, 0 to 99; on Linux it becomes a niceness of 10, the default of the command `nice`. With the lowest
/// priority an evaluation would make no progress while anything else runs.
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

/// A pool with all cores except one, at low priority.
pub(crate) fn gentle_pool(name: &'static str) -> Result<ThreadPool, rayon::ThreadPoolBuildError> {
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    ThreadPoolBuilder::new()
        .num_threads(cores.saturating_sub(1).max(1))
        .thread_name(move |index| format!("{name} {index}"))
        .start_handler(|_| lower_priority())
        .build()
}

impl Engine {
    /// A pool with all cores except one, and a device like `gpu`. Call it on a thread with low priority: a software
    /// graphics driver starts its threads here, and they inherit the priority.
    pub(super) fn new(gpu: &Gpu) -> Result<Self, EngineError> {
        // A panic in the driver ends one evaluation, not the waiting ones.
        let another = catch_unwind(AssertUnwindSafe(|| gpu.another()));
        let gpu = another.unwrap_or_else(|panic| {
            let (adapter, reason) = (gpu.adapter_name().to_owned(), faults::words(&*panic));
            Err(CameraError::DeviceRefused { adapter, reason })
        })?;
        Ok(Self { pool: gentle_pool("evaluate")?, gpu })
    }

    /// Runs an evaluation until it is done, failed or cancelled.
    pub(super) fn run(&self, evaluation: &Evaluation) -> Stage {
        ending(|| self.run_cells(evaluation))
    }

    fn run_cells(&self, evaluation: &Evaluation) -> Result<(), EvaluateError> {
        for (index, cell) in evaluation.cells.iter().enumerate() {
            let began = Instant::now();
            let map = evaluation.map(cell).ok_or_else(|| MapError::Unknown { name: cell.map.clone() })?;
            let venue = Venue::of(Arena::of(map.clone()));
            let experiment = evaluation.experiment(cell, &venue);
            let watch = Watch {
                stop: evaluation.stop(),
                progress: &|_, episode| evaluation.note(index, began, episode),
                recorders: &unrecorded,
            };
            let one = std::slice::from_ref(&experiment);
            let episodes = self.pool.install(|| run(one, &self.gpu, &watch))?;
            evaluation.add(CellResult::of(cell, episodes.into_iter().flatten().collect()));
        }
        Ok(())
    }
}

/// Converts the result of the work. A panic in a trial only ends its evaluation, with a message.
fn ending(work: impl FnOnce() -> Result<(), EvaluateError>) -> Stage {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => Stage::Done,
        Ok(Err(EvaluateError::Stopped)) => Stage::Cancelled,
        Ok(Err(error)) => Stage::Failed(error.to_string()),
        Err(panic) => Stage::Failed(format!("a trial panicked: {}", faults::words(&*panic))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::AdapterChoice;
    use crate::evaluate::{Cell, EvaluationQuery};
    use crate::map::Map;
    use crate::scenario::ControllerName;

    fn engine() -> Engine {
        Engine::new(&Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter")).unwrap()
    }

    fn evaluation(map: &str) -> Arc<Evaluation> {
        let cell = Cell { controller: ControllerName::Attractor, map: map.into(), disturbances: 0 };
        let query = EvaluationQuery {
            controllers: vec![cell.controller],
            maps: vec![cell.map.clone()],
            disturbances: vec![0],
            episodes: 2,
            seed: 1,
        };
        let maps = Map::shipped(map).into_iter().collect();
        Evaluation::new("a test".into(), query, vec![cell], maps)
    }

    #[test]
    fn a_panic_or_an_error_only_ends_its_own_evaluation() {
        let engine = engine();
        let stage = ending(|| engine.pool.install(|| panic!("seven wings")));
        assert_eq!(stage, Stage::Failed("a trial panicked: seven wings".into()));
        let Stage::Failed(message) = engine.run(&evaluation("nowhere")) else { panic!("there is no such map") };
        assert!(message.contains("nowhere"), "{message}");
        let good = evaluation("open");
        assert_eq!((engine.run(&good), good.progress().results.len()), (Stage::Done, 1));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn its_threads_have_low_priority() {
        let niceness = || {
            let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap();
            // The name, in brackets, may contain anything; nice is the 17th field after it.
            stat.rsplit_once(')').unwrap().1.split_whitespace().nth(16).unwrap().parse::<i32>().unwrap()
        };
        assert_eq!(engine().pool.install(niceness), 10);
    }
}
