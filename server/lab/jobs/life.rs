//! The stage of a job, what it has found so far, and its cancellation.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use crate::changes::Changes;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Another job is running.
    Waiting,
    Running,
    /// It waits until it may go on; what it has found is kept.
    Paused,
    /// Everything is complete.
    Done,
    /// It was cancelled; what it has found is kept.
    Cancelled,
    /// It ended with an error; what it has found is kept.
    Failed(String),
}

impl Stage {
    /// Whether the job has ended.
    pub fn is_final(&self) -> bool {
        !matches!(self, Self::Waiting | Self::Running | Self::Paused)
    }
}

/// Stage, findings and cancellation. The job updates them; all others only read, pause or cancel.
#[derive(Debug)]
pub struct Life<T> {
    /// Checked by the job from time to time.
    stop: AtomicBool,
    state: Mutex<State<T>>,
    /// Those of the list that has it.
    changes: OnceLock<Changes>,
}

#[derive(Debug)]
struct State<T> {
    stage: Stage,
    found: T,
    /// It was stopped to go on later.
    pauses: bool,
    /// Time for which it has run, before the present run.
    spent: Duration,
    /// Begin of the present run.
    since: Option<Instant>,
    ended: Option<Instant>,
}

impl<T> Life<T> {
    /// A waiting job.
    pub fn new(found: T) -> Self {
        let state =
            State { stage: Stage::Waiting, found, pauses: false, spent: Duration::ZERO, since: None, ended: None };
        Self { stop: AtomicBool::default(), state: Mutex::new(state), changes: OnceLock::new() }
    }

    /// It is in a list, whose changes its own are.
    pub fn report_to(&self, changes: &Changes) {
        let _ = self.changes.set(changes.clone());
    }

    pub fn stage(&self) -> Stage {
        self.lock().stage.clone()
    }

    /// Reads stage and findings together.
    pub fn read<R>(&self, read: impl FnOnce(&Stage, &T) -> R) -> R {
        let state = self.lock();
        read(&state.stage, &state.found)
    }

    /// Updates the findings.
    pub fn update(&self, update: impl FnOnce(&mut T)) {
        self.change(|state| update(&mut state.found));
    }

    /// For how long it has run.
    pub fn spent_s(&self) -> f64 {
        let state = self.lock();
        (state.spent + state.since.map_or(Duration::ZERO, |since| since.elapsed())).as_secs_f64()
    }

    /// When it ended, if it has.
    pub fn ended(&self) -> Option<Instant> {
        self.lock().ended
    }

    /// Starts the job. Returns false if it no longer waits.
    pub fn begin(&self) -> bool {
        self.change(|state| {
            let waits = state.stage == Stage::Waiting;
            if waits {
                (state.stage, state.since) = (Stage::Running, Some(Instant::now()));
            }
            waits
        })
    }

    /// Pauses the job; a running one stops soon. Returns false if it neither waits nor runs.
    pub fn pause(&self) -> bool {
        self.change(|state| match state.stage {
            Stage::Waiting => {
                state.stage = Stage::Paused;
                true
            }
            // Not one that is being cancelled.
            Stage::Running if !self.stop.load(Ordering::Relaxed) => {
                state.pauses = true;
                self.stop.store(true, Ordering::Relaxed);
                true
            }
            _ => state.pauses,
        })
    }

    /// Lets a paused job wait again. Returns false if it is not paused.
    pub fn resume(&self) -> bool {
        self.change(|state| {
            let resumes = state.stage == Stage::Paused;
            if resumes {
                state.stage = Stage::Waiting;
                self.stop.store(false, Ordering::Relaxed);
            }
            resumes
        })
    }

    /// Cancels the job; a running one stops soon. Returns false if it had already ended.
    pub fn cancel(&self) -> bool {
        self.change(|state| {
            state.pauses = false;
            match state.stage {
                Stage::Waiting | Stage::Paused => {
                    (state.stage, state.ended) = (Stage::Cancelled, Some(Instant::now()));
                }
                Stage::Running => self.stop.store(true, Ordering::Relaxed),
                _ => return false,
            }
            true
        })
    }

    /// True when the job should stop.
    pub fn stop(&self) -> &AtomicBool {
        &self.stop
    }

    /// Ends the job; one that was stopped to go on later is paused.
    pub fn end(&self, stage: Stage) {
        self.change(|state| {
            let pauses = std::mem::take(&mut state.pauses) && stage == Stage::Cancelled;
            state.stage = if pauses { Stage::Paused } else { stage };
            state.spent += state.since.take().map_or(Duration::ZERO, |since| since.elapsed());
            state.ended = (!pauses).then(Instant::now);
        });
    }

    fn change<R>(&self, change: impl FnOnce(&mut State<T>) -> R) -> R {
        let result = change(&mut self.lock());
        if let Some(changes) = self.changes.get() {
            changes.note();
        }
        result
    }

    /// Ignores lock poisoning: no job holds the lock while it computes, and the findings would still be consistent.
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
