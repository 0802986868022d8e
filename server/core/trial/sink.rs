//! Destination of a trial's ticks: a recording, or none.

use super::{Event, RecordingFact, TickRecord, Trial};

/// Why a trial begins for a sink.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beginning {
    /// It was just created from its scenario.
    SetUp,
    /// It continues from a state, after a rewind or because the sink requested it.
    Resumed,
    /// It takes the place of another trial, and continues from a state.
    Returned,
}

/// Receives every tick in order. It is called on the trial's thread, so it must not block for long.
pub trait Sink: Send {
    /// A trial begins or continues; no input is waiting for its next tick.
    fn begin(&mut self, trial: &Trial, how: Beginning);
    fn record(&mut self, record: &TickRecord);
    /// An event while the trial is paused.
    fn note(&mut self, event: &Event);
    /// Whether the sink needs the trial's current state before more ticks; called after every tick.
    fn wants_beginning(&mut self) -> bool;
    /// Whether everything is recorded, or why not.
    fn status(&self) -> RecordingFact;
    /// Writes everything that is pending and closes the sink.
    ///
    /// # Errors
    /// Why not everything was kept.
    fn finish(self: Box<Self>) -> Result<(), String>;
}

/// A sink that discards everything.
#[derive(Clone, Debug, Default)]
pub struct Nowhere {
    /// Why nothing is recorded, shown to viewers; empty if no recording was requested.
    pub reason: String,
}

impl Sink for Nowhere {
    fn begin(&mut self, _: &Trial, _: Beginning) {}
    fn record(&mut self, _: &TickRecord) {}
    fn note(&mut self, _: &Event) {}

    fn wants_beginning(&mut self) -> bool {
        false
    }

    fn status(&self) -> RecordingFact {
        match self.reason.as_str() {
            "" => RecordingFact::Off,
            detail => RecordingFact::Refused { detail: detail.to_owned() },
        }
    }

    fn finish(self: Box<Self>) -> Result<(), String> {
        Ok(())
    }
}
