//! The stage of a job, what it has found so far, and its cancellation.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use crate::changes::Changes;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Another job is running.
    Waiting,
    Running,
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
        !matches!(self, Self::Waiting | Self::Running)
    }
}

/// Stage, findings and cancellation. The job updates them; all others only read, or cancel.
#[derive(Debug)]
pub struct Life<T> {
    /// Checked by the job from time to time.
    stop: AtomicBool,
    state: Mutex<(Stage, T)>,
    /// Those of the list that has it.
    changes: OnceLock<Changes>,
}

impl<T> Life<T> {
    /// A waiting job.
    pub fn new(found: T) -> Self {
        Self { stop: AtomicBool::default(), state: Mutex::new((Stage::Waiting, found)), changes: OnceLock::new() }
    }

    /// It is in a list, whose changes its own are.
    pub fn report_to(&self, changes: &Changes) {
        let _ = self.changes.set(changes.clone());
    }

    pub fn stage(&self) -> Stage {
        self.lock().0.clone()
    }

    /// Reads stage and findings together.
    pub fn read<R>(&self, read: impl FnOnce(&Stage, &T) -> R) -> R {
        let state = self.lock();
        read(&state.0, &state.1)
    }

    /// Updates the findings.
    pub fn update(&self, update: impl FnOnce(&mut T)) {
        self.change(|state| update(&mut state.1));
    }

    /// Starts the job. Returns false if it no longer waits.
    pub fn begin(&self) -> bool {
        self.change(|state| {
            let waits = state.0 == Stage::Waiting;
            if waits {
                state.0 = Stage::Running;
            }
            waits
        })
    }

    /// Cancels the job; a running one stops soon. Returns false if it had already ended.
    pub fn cancel(&self) -> bool {
        self.change(|state| {
            if state.0 == Stage::Waiting {
                state.0 = Stage::Cancelled;
                return true;
            }
            let runs = state.0 == Stage::Running;
            if runs {
                self.stop.store(true, Ordering::Relaxed);
            }
            runs
        })
    }

    /// True when the job should stop.
    pub fn stop(&self) -> &AtomicBool {
        &self.stop
    }

    pub fn end(&self, stage: Stage) {
        self.change(|state| state.0 = stage);
    }

    fn change<R>(&self, change: impl FnOnce(&mut (Stage, T)) -> R) -> R {
        let result = change(&mut self.lock());
        if let Some(changes) = self.changes.get() {
            changes.note();
        }
        result
    }

    /// Ignores lock poisoning: no job holds the lock while it computes, and the findings would still be consistent.
    fn lock(&self) -> MutexGuard<'_, (Stage, T)> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
