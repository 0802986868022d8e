//! A question to a program, until its answer.

use std::sync::Arc;
use std::time::Instant;

use tokio::sync::oneshot;

use crate::camera::Subject;
use crate::program::{LIVE_WITHIN, Program};
use ferry_core::control::transport::program::Answer;
use ferry_core::scenario::{ControllerName, Parameters};
use ferry_core::trial::Seen;

/// A question, and what the camera saw when it was asked.
pub(super) struct Asking {
    pub(super) seen: Box<Seen>,
    pub(super) waiting: Waiting,
    pub(super) program: Arc<Program>,
    pub(super) circumstances: Circumstances,
}

/// If one of these changes, the question is asked again.
#[derive(PartialEq)]
pub(super) struct Circumstances {
    pub(super) subject: Subject,
    pub(super) controller: ControllerName,
    pub(super) parameters: Parameters,
    pub(super) program: Option<String>,
}

/// What the next tick decides from.
pub(super) enum Sees {
    Now(Box<Seen>),
    /// The camera, now.
    Camera,
    /// Nothing yet: the program has not answered.
    Waits,
}

/// A question that waits for its answer.
pub(super) struct Waiting {
    answer: oneshot::Receiver<Answer>,
    got: Option<Answer>,
    since: Instant,
}

impl Waiting {
    pub(super) fn new(answer: oneshot::Receiver<Answer>) -> Self {
        Self { answer, got: None, since: Instant::now() }
    }

    /// Whether an answer may still come.
    pub(super) fn is_open(&mut self) -> bool {
        if self.got.is_some() || self.since.elapsed() >= LIVE_WITHIN {
            return false;
        }
        match self.answer.try_recv() {
            Ok(answer) => self.got = Some(answer),
            Err(oneshot::error::TryRecvError::Empty) => return true,
            Err(oneshot::error::TryRecvError::Closed) => {}
        }
        false
    }

    /// The answer, or a hold that says why it is missing. Notes it.
    pub(super) fn end(mut self, program: &Program) -> Answer {
        let latency = self.since.elapsed();
        let is_late = self.is_open() || latency >= LIVE_WITHIN;
        program.note(self.got.is_some().then_some(latency));
        self.got.unwrap_or_else(|| program.no_answer(is_late.then_some(LIVE_WITHIN)))
    }
}
