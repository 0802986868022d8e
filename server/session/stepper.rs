//! What waits for the end of a `Step`.

use std::collections::VecDeque;

use super::{Answer, COMMAND_QUEUE, Request};

#[derive(Default)]
pub struct Stepper {
    /// Who has requested the `Step`.
    answer: Option<Answer<()>>,
    /// Commands that came during it.
    deferred: VecDeque<Request>,
}

impl Stepper {
    pub fn begin(&mut self, answer: Answer<()>) {
        self.answer = Some(answer);
    }

    pub fn defer(&mut self, request: Request) {
        self.deferred.push_back(request);
    }

    pub fn is_waiting(&self) -> bool {
        self.answer.is_some() || !self.deferred.is_empty()
    }

    pub fn is_full(&self) -> bool {
        self.deferred.len() >= COMMAND_QUEUE
    }

    /// The `Step` has ended.
    pub fn end(&mut self) -> Option<Answer<()>> {
        self.answer.take()
    }

    /// The oldest command that waits.
    pub fn next(&mut self) -> Option<Request> {
        self.deferred.pop_front()
    }
}
