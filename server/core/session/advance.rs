//! Ticks.

use std::sync::Arc;
use std::time::Duration;

use super::Session;
use super::asking::Sees;
use crate::control::step_is_due;
use crate::image::ImageSource;
use crate::trial::{Beginning, Input, InputError, Source, TrialError};

impl<E: ImageSource> Session<E> {
    /// Time until the next tick, or until a program must have answered; zero when the tick is due, `None` while paused.
    pub fn wait(&self, now: Duration) -> Option<Duration> {
        let answer = self.program.wait(now);
        match (self.stepping > 0, self.running) {
            (true, _) => Some(answer),
            (false, true) => Some(self.pace.wait(now).max(answer)),
            (false, false) => None,
        }
    }

    /// Makes the next tick if it is due. Returns false if it was not, or waits for an answer of a program.
    ///
    /// # Errors
    /// [`TrialError`]; the session cannot go on.
    pub fn advance(&mut self, now: Duration) -> Result<bool, TrialError> {
        let steps = self.stepping > 0;
        if self.wait(now) != Some(Duration::ZERO) || !self.tick(now)? {
            return Ok(false);
        }
        if !steps {
            self.pace.ticked(now);
            return Ok(true);
        }
        // The end of an attempt at a challenge ends the `Step`, too.
        self.stepping = self.stepping.saturating_sub(1);
        if self.stepping == 0 {
            self.announce();
        }
        Ok(true)
    }

    /// An input of the next tick that comes from a robot, not from an operator.
    ///
    /// # Errors
    /// [`InputError`]; nothing has changed.
    pub fn follow(&mut self, input: Input) -> Result<(), InputError> {
        self.drop_stale_hand()?;
        self.trial.apply(input)
    }

    fn tick(&mut self, now: Duration) -> Result<bool, TrialError> {
        self.drop_stale_hand()?;
        let tick = self.trial.state().world.tick;
        if step_is_due(tick) && !self.asks() {
            self.forget_after(tick);
            self.history.keep_state(self.trial.snapshot());
        }
        let source = match self.see(now)? {
            Sees::Waits => return Ok(false),
            Sees::Now(seen) => Source::Seen(seen),
            Sees::Camera => Source::Camera(&mut self.camera),
        };
        let mut record = self.trial.tick(source)?;
        self.sink.record(&record);
        if self.sink.wants_beginning() {
            self.sink.begin(&self.trial, Beginning::Resumed);
        }
        self.history.note(&record);
        self.referee(&record);
        for event in record.events.drain(..) {
            self.report(event);
        }
        if let Some(sight) = record.sight {
            self.sight = Arc::new((record.tick, sight));
        }
        self.apply_case();
        Ok(true)
    }
}
