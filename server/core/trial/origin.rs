//! A moment from which trials go on.

use std::sync::Arc;

use super::{Arena, Trial, TrialError, TrialState};
use crate::scenario::Scenario;

/// A state that a trial has come to, and what belongs to it. Any number of trials can go on from it.
#[derive(Clone, Debug)]
pub struct Origin {
    pub scenario: Scenario,
    pub arena: Arc<Arena>,
    pub state: TrialState,
}

impl Origin {
    /// The present moment of a trial.
    pub fn of(trial: &Trial) -> Self {
        Self::at(trial, trial.snapshot())
    }

    /// Another moment of a trial.
    pub fn at(trial: &Trial, state: TrialState) -> Self {
        Self { scenario: trial.scenario().clone(), arena: trial.arena().clone(), state }
    }

    pub fn tick(&self) -> u64 {
        self.state.world.tick
    }

    /// A trial at this moment.
    ///
    /// # Errors
    /// The scenario is impossible.
    pub fn trial(&self) -> Result<Trial, TrialError> {
        let mut trial = Trial::new(self.scenario.clone(), self.arena.clone())?;
        trial.take_events();
        trial.restore(self.state.clone());
        Ok(trial)
    }
}
