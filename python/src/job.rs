//! Evaluations: Ferry's own trials, with Python's controllers among the contenders.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ferry::camera::Gpu;
use ferry::evaluate::{self, Contender, Experiment, Manner, Part, Plan, Report, Shard, Watch, run_trials, unrecorded};
use ferry::policy::Policy;
use ferry::program::{Connection, Program};
use ferry::protocol::{Conversation, Outgoing};
use ferry::scenario::Parameters;
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::{bad, failed, open_gpu};

/// A controller written in Python.
struct Own {
    program: Arc<Program>,
    conversation: Mutex<Conversation>,
    /// What it gets, and messages of it that were not fetched yet.
    inbox: Mutex<(Connection, VecDeque<Outgoing>)>,
}

/// All rows of an evaluation, ready to run.
#[pyclass(frozen)]
pub struct Evaluation {
    experiments: Vec<Experiment>,
    gpu: Arc<Gpu>,
    own: Vec<Own>,
    stop: AtomicBool,
    done: AtomicU64,
}

fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[pymethods]
impl Evaluation {
    /// `controllers`: names, and whether the controller is Python's. Those are answered through [`Self::receive`] and
    /// [`Self::send`], numbered in their order. `changes`: parameters as `NAME=VALUE`.
    #[new]
    #[pyo3(signature = (*, controllers, maps, disturbances, episodes, seed, changes, by_hand, tool_apart, policy))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn new(
        py: Python<'_>,
        controllers: Vec<(String, bool)>,
        maps: Vec<String>,
        disturbances: Vec<u32>,
        episodes: u32,
        seed: u64,
        changes: Vec<String>,
        by_hand: bool,
        tool_apart: bool,
        policy: Option<PathBuf>,
    ) -> PyResult<Self> {
        py.detach(|| {
            let mut own = Vec::new();
            let contender = |(name, is_own): &(String, bool)| {
                if !is_own {
                    return name.parse().map(Contender::Own).map_err(bad);
                }
                let program = Arc::new(Program::new(name));
                let connection = program.connect().expect("it is new");
                let inbox = Mutex::new((connection, VecDeque::new()));
                own.push(Own { program: program.clone(), conversation: Mutex::new(Conversation::new(name)), inbox });
                Ok(Contender::Program(program))
            };
            let plan = Plan {
                contenders: controllers.iter().map(contender).collect::<PyResult<_>>()?,
                maps,
                disturbances,
                episodes,
                seed,
                parameters: Parameters::default().with(&changes).map_err(bad)?,
                manner: Manner { by_hand, tool_apart },
                policy: policy.as_deref().map(Policy::open).transpose().map_err(bad)?,
            };
            let experiments = plan.experiments().map_err(bad)?;
            let gpu = open_gpu()?;
            Ok(Self { experiments, gpu, own, stop: AtomicBool::new(false), done: AtomicU64::new(0) })
        })
    }

    /// Number of trials that have ended.
    fn done(&self) -> u64 {
        self.done.load(Ordering::Relaxed)
    }

    /// Cancels [`Self::run`].
    fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Runs a shard on some threads, 0 for one per core, and returns its file. Questions to Python's controllers must be
    /// answered by other threads meanwhile; they end with this.
    fn run<'py>(&self, py: Python<'py>, number: u32, count: u32, threads: usize) -> PyResult<Bound<'py, PyBytes>> {
        let shard = shard(number, count)?;
        let part = py.detach(|| {
            let ran = self.run_shard(shard, threads);
            self.own.iter().for_each(|own| own.program.disconnect());
            ran
        });
        Ok(PyBytes::new(py, &part?))
    }

    /// The next message to one of Python's controllers, as text or as the bytes of an image; `None` at the end.
    fn receive<'py>(&self, py: Python<'py>, own: usize) -> PyResult<Option<Bound<'py, PyAny>>> {
        let own = self.find(own)?;
        let message = py.detach(|| {
            let mut inbox = locked(&own.inbox);
            let (connection, waiting) = &mut *inbox;
            while waiting.is_empty() {
                waiting.extend(locked(&own.conversation).tell(connection.wait()?));
            }
            waiting.pop_front()
        });
        message
            .map(|message| match message {
                Outgoing::Text(text) => text.into_pyobject(py).map(Bound::into_any).map_err(PyErr::from),
                Outgoing::Image(pixels) => Ok(PyBytes::new(py, &pixels).into_any()),
            })
            .transpose()
    }

    /// One of Python's controllers will not answer any more.
    fn give_up(&self, own: usize) -> PyResult<()> {
        let own = self.find(own)?;
        own.program.disconnect();
        // The question that waits is dropped.
        *locked(&own.conversation) = Conversation::new(&own.program.name);
        locked(&own.inbox).0.close();
        Ok(())
    }

    /// An answer of one of Python's controllers.
    fn send(&self, own: usize, text: &str) -> PyResult<()> {
        // One that comes after the end is not needed.
        let _ = locked(&self.find(own)?.conversation).take(text);
        Ok(())
    }
}

impl Evaluation {
    fn find(&self, own: usize) -> PyResult<&Own> {
        self.own.get(own).ok_or_else(|| PyIndexError::new_err(own))
    }

    fn run_shard(&self, shard: Shard, threads: usize) -> PyResult<Vec<u8>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(failed)?;
        let progress = |_: usize, _: &evaluate::Episode| {
            self.done.fetch_add(1, Ordering::Relaxed);
        };
        let watch = Watch { stop: &self.stop, progress: &progress, recorders: &unrecorded };
        let trials = shard.trials(&self.experiments);
        let episodes = pool.install(|| run_trials(&self.experiments, trials, &self.gpu, &watch));
        let episodes = episodes.map_err(|error| match error {
            evaluate::EvaluateError::Stopped => PyKeyboardInterrupt::new_err(()),
            evaluate::EvaluateError::Episodes(_) => bad(error),
            error => failed(error),
        })?;
        let part = Part::of(&self.experiments, shard, self.gpu.adapter_name(), episodes).map_err(failed)?;
        serde_json::to_vec(&part).map_err(failed)
    }
}

fn shard(number: u32, count: u32) -> PyResult<Shard> {
    format!("{number}/{count}").parse().map_err(bad)
}

/// The report of an evaluation as JSON, from the files of all its shards.
#[pyfunction]
pub fn merge(py: Python<'_>, parts: Vec<Vec<u8>>) -> PyResult<String> {
    py.detach(|| {
        let read = |(number, bytes): (usize, &Vec<u8>)| {
            Part::read(bytes).map(|part| (format!("shard {}", number + 1), part)).map_err(bad)
        };
        let parts = parts.iter().enumerate().map(read).collect::<PyResult<Vec<_>>>()?;
        let merged = evaluate::merge(parts).map_err(bad)?;
        serde_json::to_string(&Report::of(&merged.adapter, merged.seed, &merged.done())).map_err(failed)
    })
}
