//! Kept moments and test cases.

use super::{BranchPoint, CommandError, Recalled, Session};
use crate::control::step_is_due;
use crate::image::ImageSource;
use crate::trial::{Case, Input, Origin, Timed, TrialState};

impl<E: ImageSource> Session<E> {
    /// The trial as a test case, with all its inputs.
    ///
    /// # Errors
    /// [`CommandError::Forgotten`] and [`CommandError::NothingCarried`].
    pub fn case(&self) -> Result<Case, CommandError> {
        let tick = self.trial.state().world.tick;
        let told = self.told(tick).ok_or(CommandError::Forgotten)?;
        let inputs = told.into_iter().map(|(tick, input)| Timed { tick, input }).collect();
        Case::of(&self.trial, inputs).ok_or(CommandError::NothingCarried { tick })
    }

    /// All inputs up to a tick.
    fn told(&self, tick: u64) -> Option<Vec<(u64, Input)>> {
        let now = self.trial.state().world.tick;
        let waiting = self.trial.waiting_inputs().iter().filter(|_| tick == now).map(|input| (now, input.clone()));
        let told = self.history.timeline().inputs_from_start()?;
        Some(told.into_iter().filter(|&(at, _)| at <= tick).chain(waiting).collect())
    }

    /// A kept moment.
    ///
    /// # Errors
    /// [`CommandError::Range`].
    pub fn recall(&self, tick: u64, which: Recalled) -> Result<BranchPoint, CommandError> {
        let is_present = tick == self.trial.state().world.tick;
        let state = match which {
            Recalled::Present if is_present => self.trial.snapshot(),
            // It starts now, with all inputs received while paused.
            Recalled::Step if is_present && step_is_due(tick) => self.trial.snapshot(),
            _ => self.moment(tick)?.clone(),
        };
        let mut inputs = self.history.timeline().inputs_after(state.world.tick);
        inputs.extend(self.case_inputs_after(state.world.tick));
        let told = self.told(state.world.tick);
        let origin = Origin::at(&self.trial, state);
        Ok(BranchPoint { origin, told, inputs })
    }

    /// The last kept state at or before a tick; `None` for a tick after the newest state.
    pub(super) fn moment(&self, tick: u64) -> Result<&TrialState, CommandError> {
        let (first, last) = self.history.range();
        let last = last.max(self.trial.state().world.tick);
        self.history.timeline().at(tick).filter(|_| tick <= last).ok_or_else(|| {
            let allowed = format!("{first} to {last}");
            CommandError::Range { field: "tick", value: tick as f64, allowed }
        })
    }
}
