//! The events of a session: to its subscribers, and into its journal.

use std::sync::Arc;

use super::JOURNAL;
use super::worker::Worker;
use crate::camera::ImageSource;
use ferry_core::trial::Event;

impl<E: ImageSource> Worker<E> {
    /// Sends events of inputs at once if no tick will carry them.
    pub(super) fn announce(&mut self) {
        if self.running {
            return;
        }
        for event in self.trial.take_events() {
            self.sink.note(&event);
            self.report(event);
        }
    }

    /// Sends an event to all subscribers and stores it in the journal.
    pub(super) fn report(&mut self, event: Event) {
        // Only once: after a rewind a control step happens again at its tick.
        if !self.journal.contains(&event) {
            let journal = Arc::make_mut(&mut self.journal);
            if journal.len() == JOURNAL {
                journal.remove(0);
            }
            journal.push(event.clone());
        }
        let _ = self.events.send(event);
    }
}
