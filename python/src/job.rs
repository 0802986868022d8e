//! Evaluations and recovery maps: Ferry's own trials, with Python's controllers among the contenders.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use ferry::protocol::{Conversation, Outgoing};
use ferry_camera::Gpu;
use ferry_core::scenario::{ControllerName, Parameters};
use ferry_files::open;
use ferry_lab::changes::Changes;
use ferry_lab::evaluate::{
    self, Contender, EvaluateError, Experiment, Manner, Part, PartError, Plan, Report, Shard, Watch, run_trials,
    unrecorded,
};
use ferry_lab::jobs::Life;
use ferry_lab::program::{Connection, Program};
use ferry_lab::recovery::{self, Findings, Recovery, RecoveryPart, RecoveryPlan, RecoveryQuery};
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::{bad, failed, locked, open_gpu, threads};

/// A controller written in Python.
struct Own {
    program: Arc<Program>,
    conversation: Mutex<Conversation>,
    /// What it gets, and messages of it that were not fetched yet.
    inbox: Mutex<(Connection, VecDeque<Outgoing>)>,
}

/// What a job tries.
enum Work {
    Evaluation { experiments: Vec<Experiment>, stop: AtomicBool, done: AtomicU64 },
    Recovery { recovery: Box<Recovery>, life: Life<Findings> },
}

/// An evaluation or a recovery map, ready to run.
#[pyclass(frozen)]
pub struct Job {
    work: Work,
    gpu: Arc<Gpu>,
    own: Vec<Own>,
}

impl Drop for Job {
    fn drop(&mut self) {
        if threads::are_lost() {
            std::mem::forget(self.gpu.clone());
        }
    }
}

/// Controllers with their names, and Python's own among them in their order.
fn contenders(controllers: &[(String, bool)]) -> PyResult<(Vec<Contender>, Vec<Own>)> {
    let mut own = Vec::new();
    let contender = |(name, is_own): &(String, bool)| {
        if !is_own {
            return name.parse().map(Contender::Own).map_err(bad);
        }
        let program = Arc::new(Program::new(name, Changes::default()));
        let connection = program.connect().expect("it is new");
        let inbox = Mutex::new((connection, VecDeque::new()));
        own.push(Own { program: program.clone(), conversation: Mutex::new(Conversation::new(name)), inbox });
        Ok(Contender::Program(program))
    };
    let contenders = controllers.iter().map(contender).collect::<PyResult<_>>()?;
    Ok((contenders, own))
}

/// `controllers`: names, and whether the controller is Python's. Those are answered through [`Job::receive`] and
/// [`Job::send`], numbered in their order. `changes`: parameters as `NAME=VALUE`.
#[pymethods]
impl Job {
    /// `vary`: each as `NAME=FROM:TO:COUNT`.
    #[staticmethod]
    #[pyo3(signature = (*, controllers, maps, disturbances, episodes, seed, changes, vary, by_hand, tool_apart, policy))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn evaluation(
        py: Python<'_>,
        controllers: Vec<(String, bool)>,
        maps: Vec<String>,
        disturbances: Vec<u32>,
        episodes: u32,
        seed: u64,
        changes: Vec<String>,
        vary: Vec<String>,
        by_hand: bool,
        tool_apart: bool,
        policy: Option<PathBuf>,
    ) -> PyResult<Self> {
        py.detach(|| {
            let (contenders, own) = contenders(&controllers)?;
            let plan = Plan {
                contenders,
                maps,
                disturbances,
                episodes,
                seed,
                parameters: Parameters::default().with(&changes).map_err(bad)?,
                vary: vary.iter().map(|text| text.parse()).collect::<Result<_, _>>().map_err(bad)?,
                manner: Manner { by_hand, tool_apart },
                policy: policy.as_deref().map(open::policy).transpose().map_err(bad)?,
            };
            let experiments = plan.experiments().map_err(bad)?;
            let work = Work::Evaluation { experiments, stop: AtomicBool::new(false), done: AtomicU64::new(0) };
            Ok(Self { work, gpu: open_gpu()?, own })
        })
    }

    /// At most one controller is Python's.
    #[staticmethod]
    #[pyo3(signature = (*, controllers, map, scenario, at_s, kind, grid, repeats, seed, within_s, full, changes))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn recovery(
        py: Python<'_>,
        controllers: Vec<(String, bool)>,
        map: String,
        scenario: Option<String>,
        at_s: f64,
        kind: &str,
        grid: u32,
        repeats: u32,
        seed: u64,
        within_s: f64,
        full: bool,
        changes: Vec<String>,
    ) -> PyResult<Self> {
        let kind = kind.parse().map_err(bad)?;
        py.detach(|| {
            let (contenders, own) = contenders(&controllers)?;
            if own.len() > 1 {
                return Err(bad("controllers has several of one's own, a recovery map takes one beside Ferry's"));
            }
            let name = |contender: &Contender| match contender {
                Contender::Own(name) => *name,
                Contender::Program(_) => ControllerName::Program,
            };
            let controllers = contenders.iter().map(name).collect();
            let query = RecoveryQuery { kind, controllers, grid, repeats, seed, within_s, is_full: full };
            let program = own.first().map(|own| own.program.clone());
            let gpu = open_gpu()?;
            let plan = RecoveryPlan { map, scenario, at_s, query, changes, program };
            let recovery = Box::new(plan.recovery(&gpu).map_err(bad)?);
            let life = Life::new(Findings::default());
            life.begin();
            Ok(Self { work: Work::Recovery { recovery, life }, gpu, own })
        })
    }

    /// Number of trials that have ended.
    fn done(&self) -> u64 {
        match &self.work {
            Work::Evaluation { done, .. } => done.load(Ordering::Relaxed),
            Work::Recovery { life, .. } => life.read(|_, findings| findings.done as u64),
        }
    }

    /// Number of trials; that of a map whose cells are divided grows.
    fn planned(&self) -> u64 {
        match &self.work {
            Work::Evaluation { experiments, .. } => experiments.iter().map(|one| u64::from(one.episodes)).sum(),
            Work::Recovery { recovery, life } => match life.read(|_, findings| findings.planned) {
                0 => recovery.trials() as u64,
                planned => planned as u64,
            },
        }
    }

    /// Cancels [`Self::run`].
    fn stop(&self) {
        match &self.work {
            Work::Evaluation { stop, .. } => stop.store(true, Ordering::Relaxed),
            Work::Recovery { life, .. } => {
                life.cancel();
            }
        }
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

impl Job {
    fn find(&self, own: usize) -> PyResult<&Own> {
        self.own.get(own).ok_or_else(|| PyIndexError::new_err(own))
    }

    fn run_shard(&self, shard: Shard, threads: usize) -> PyResult<Vec<u8>> {
        threads::claim()?;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(failed)?;
        let adapter = self.gpu.adapter_name();
        match &self.work {
            Work::Evaluation { experiments, stop, done } => {
                let progress = |_: usize, _: &evaluate::Episode| {
                    done.fetch_add(1, Ordering::Relaxed);
                };
                let watch = Watch { stop, progress: &progress, recorders: &unrecorded };
                let trials = shard.trials(experiments);
                let episodes = pool.install(|| run_trials(experiments, trials, &self.gpu, &watch)).map_err(ended)?;
                serde_json::to_vec(&Part::of(experiments, shard, adapter, episodes).map_err(failed)?).map_err(failed)
            }
            Work::Recovery { recovery, life } => {
                // The only shard of a map may divide its cells.
                let among = Some(shard).filter(|shard| shard.count > 1);
                let run = || recovery.run(among, &self.gpu, life, &recovery::unrecorded, &|_| ());
                pool.install(run).map_err(ended)?;
                let findings = life.read(|_, findings| findings.clone());
                let part = RecoveryPart::of(recovery, shard, adapter, &findings).map_err(failed)?;
                serde_json::to_vec(&part).map_err(failed)
            }
        }
    }
}

/// Why a job has no result.
fn ended(error: EvaluateError) -> PyErr {
    match error {
        EvaluateError::Stopped => PyKeyboardInterrupt::new_err(()),
        EvaluateError::Episodes(_) => bad(error),
        error => failed(error),
    }
}

fn shard(number: u32, count: u32) -> PyResult<Shard> {
    format!("{number}/{count}").parse().map_err(bad)
}

/// The report of an evaluation or of a recovery map as JSON, from the files of all its shards.
#[pyfunction]
pub fn merge(py: Python<'_>, parts: Vec<Vec<u8>>) -> PyResult<String> {
    py.detach(|| {
        if parts.iter().any(|bytes| RecoveryPart::is_named_in(bytes)) {
            let merged = recovery::merge_recovery(numbered(&parts, RecoveryPart::read)?).map_err(bad)?;
            let report = recovery::Report::of(&merged.subject, &merged.adapter, &merged.findings);
            return serde_json::to_string(&report).map_err(failed);
        }
        let merged = evaluate::merge(numbered(&parts, Part::read)?).map_err(bad)?;
        serde_json::to_string(&Report::of(&merged.adapter, merged.seed, &merged.done())).map_err(failed)
    })
}

fn numbered<P>(parts: &[Vec<u8>], read: fn(&[u8]) -> Result<P, PartError>) -> PyResult<Vec<(String, P)>> {
    let read = |(number, bytes): (usize, &Vec<u8>)| {
        read(bytes).map(|part| (format!("shard {}", number + 1), part)).map_err(bad)
    };
    parts.iter().enumerate().map(read).collect()
}
