//! Where a trial's ticks go: to a recording, or nowhere.

use super::{Event, TickRecord, Trial};

/// How a sink comes to hear of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beginning {
    /// It was just set up from its scenario.
    SetUp,
    /// It goes on from a state: of a moment gone back to, or because the sink asked.
    Resumed,
}

/// Takes every tick, in order; called where trials run, so it must not wait longer than it was told to.
pub trait Sink: Send {
    /// A trial begins, or goes on from where it stands; no input waits for its next tick.
    fn begin(&mut self, trial: &Trial, how: Beginning);
    /// A tick, with its events.
    fn record(&mut self, record: &TickRecord);
    /// An event while time stands.
    fn note(&mut self, event: &Event);
    /// Whether it wants to hear where the trial stands before it hears of more ticks; asked after every tick.
    fn wants_beginning(&mut self) -> bool;
    /// `recording`, or why not.
    fn status(&self) -> String;
    /// Nothing more comes: writes what waits and says why not all of it is kept, if so.
    ///
    /// # Errors
    /// The reason.
    fn finish(self: Box<Self>) -> Result<(), String>;
}

/// Keeps nothing.
#[derive(Clone, Debug, Default)]
pub struct Nowhere {
    /// Why, shown to viewers; empty where nobody asked for a recording.
    pub reason: String,
}

impl Sink for Nowhere {
    fn begin(&mut self, _: &Trial, _: Beginning) {}
    fn record(&mut self, _: &TickRecord) {}
    fn note(&mut self, _: &Event) {}

    fn wants_beginning(&mut self) -> bool {
        false
    }

    fn status(&self) -> String {
        let colon = if self.reason.is_empty() { "" } else { ": " };
        format!("not recording{colon}{}", self.reason)
    }

    fn finish(self: Box<Self>) -> Result<(), String> {
        Ok(())
    }
}
