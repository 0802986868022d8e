//! Inputs of the trial, also after a rewind.

use std::sync::Arc;

use super::playing::Void;
use super::{CommandError, Session};
use crate::image::ImageSource;
use crate::trial::{Input, InputError};

impl<E: ImageSource> Session<E> {
    pub(super) fn input(&mut self, mut input: Input) -> Result<(), CommandError> {
        let configures = matches!(input, Input::Configure(_));
        let steers = matches!(input, Input::Steer { .. });
        if let Input::Configure(parameters) = &mut input {
            self.scenery.catalog.resolve(parameters)?;
        }
        let tick = self.trial.state().world.tick;
        // Hashes cost more than most inputs and are needed only after a rewind.
        let before = self.history.timeline().reaches_past(tick).then(|| self.trial.state().hashes());
        let as_it_was = self.hand_is_stale.then(|| self.trial.snapshot());
        if !matches!(input, Input::Release) {
            self.drop_stale_hand()?;
        }
        let done = self.operate(input);
        if let (Err(_), Some(state)) = (&done, as_it_was) {
            self.trial.restore(state);
            self.hand_is_stale = true;
        }
        done?;
        if !steers {
            self.spoil(Void::OtherInput);
        }
        if before.is_some_and(|before| before != self.trial.state().hashes()) {
            self.forget_after(tick);
        }
        if configures {
            self.scenery = Arc::new(self.next_scenery(0));
        }
        // The tool follows the hand at the next control step: until then the camera sees the same.
        if !self.running && !steers {
            self.observe();
        }
        Ok(())
    }

    fn operate(&mut self, input: Input) -> Result<(), InputError> {
        let releases_stale_hand = self.hand_is_stale && matches!(input, Input::Release);
        if releases_stale_hand { Ok(()) } else { self.trial.operate(input, !self.running) }
    }

    /// The hand of a rewound state releases the bead as soon as the session continues.
    pub(super) fn drop_stale_hand(&mut self) -> Result<(), InputError> {
        if std::mem::take(&mut self.hand_is_stale) {
            self.trial.apply(Input::Release)?;
        }
        Ok(())
    }

    /// Drops everything after a tick. What a rewind has left behind becomes a run.
    pub(super) fn forget_after(&mut self, tick: u64) {
        if self.history.forget_after(tick, &self.trial, self.scenery.case.as_ref()) {
            self.scenery = Arc::new(self.next_scenery(0));
        }
    }
}
