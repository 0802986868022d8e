//! A control step that a program decides: the session asks, and goes on when the answer comes or its time is over.

use std::time::Duration;

use super::branch_point::is_answer;
use super::{Message, Session};
use crate::control::transport::program::Answer;
use crate::image::{ImageSource, Subject};
use crate::scenario::{ControllerName, Parameters};
use crate::trial::{Seen, TrialError};

/// A session waits this long for an answer; then the arm holds for this control step.
pub const PROGRAM_ANSWER_WITHIN: Duration = Duration::from_millis(100);

/// What a session knows of the program that it asks.
#[derive(Default)]
pub struct ProgramQueries {
    /// The program that was selected last.
    name: Option<String>,
    /// Number of questions so far.
    asked: u64,
    waiting: Option<Waiting>,
}

/// A question that waits for its answer, and what the camera saw when it was asked.
struct Waiting {
    seen: Box<Seen>,
    since: Duration,
    answer: Option<Answer>,
    circumstances: Circumstances,
}

/// If one of these changes, the question is asked again.
#[derive(PartialEq)]
struct Circumstances {
    subject: Subject,
    controller: ControllerName,
    parameters: Parameters,
    program: Option<String>,
}

/// What the next tick decides from.
pub enum Sees {
    Now(Box<Seen>),
    /// The camera, now.
    Camera,
    /// Nothing yet: the program has not answered.
    Waits,
}

impl ProgramQueries {
    /// The next question goes to this program.
    pub fn select(&mut self, name: String) {
        self.name = Some(name);
    }

    /// Time until the answer is no longer waited for; zero if none is waited for.
    pub fn wait(&self, now: Duration) -> Duration {
        let open = self.waiting.as_ref().filter(|waiting| waiting.answer.is_none());
        open.map_or(Duration::ZERO, |waiting| (waiting.since + PROGRAM_ANSWER_WITHIN).saturating_sub(now))
    }

    /// The answer to the question is no longer waited for.
    pub fn forget(&mut self) {
        self.waiting = None;
    }
}

impl<E: ImageSource> Session<E> {
    /// Whether a control step waits for an answer, or for the tick that carries it out.
    pub fn asks(&self) -> bool {
        self.program.waiting.is_some()
    }

    /// Whether the answer to this question is waited for.
    pub fn awaits(&self, number: u64) -> bool {
        number == self.program.asked && self.program.waiting.as_ref().is_some_and(|waiting| waiting.answer.is_none())
    }

    /// Takes the answer to a question; the next tick carries it out. One that is no longer waited for is dropped.
    pub fn answer(&mut self, number: u64, answer: Answer) {
        if self.awaits(number)
            && let Some(waiting) = &mut self.program.waiting
        {
            waiting.answer = Some(answer);
        }
    }

    /// Forgets a question whose answer would no longer fit.
    pub(super) fn check_question(&mut self) {
        if self.program.waiting.as_ref().is_some_and(|waiting| waiting.circumstances != self.circumstances()) {
            self.program.forget();
        }
    }

    fn circumstances(&self) -> Circumstances {
        Circumstances {
            subject: self.trial.subject(),
            controller: self.trial.state().controller,
            parameters: self.trial.state().world.parameters.clone(),
            program: self.program.name.clone(),
        }
    }

    /// Asks the program if this control step needs an answer, and applies the answer.
    pub(super) fn see(&mut self, now: Duration) -> Result<Sees, TrialError> {
        if !self.trial.step_is_due() || self.trial.state().controller != ControllerName::Program {
            self.program.forget();
            return Ok(Sees::Camera);
        }
        // A test case has the answers among its inputs.
        if self.trial.waiting_inputs().iter().any(is_answer) {
            return Ok(Sees::Camera);
        }
        if let Some(waiting) = self.program.waiting.take() {
            let Some(answer) = self.answer_of(&waiting, now) else {
                self.program.waiting = Some(waiting);
                return Ok(Sees::Waits);
            };
            self.trial.apply_answer(answer)?;
            return Ok(Sees::Now(waiting.seen));
        }
        let seen = Box::new(self.trial.see(&mut self.camera)?);
        let Some(query) = self.trial.control_query(&seen, self.scenery.trial) else {
            return Ok(Sees::Now(seen));
        };
        if self.program.name.is_none() {
            self.trial.apply_answer(Answer::Hold { reason: "none is selected".to_owned() })?;
            return Ok(Sees::Now(seen));
        }
        let circumstances = self.circumstances();
        self.program.asked += 1;
        self.program.waiting = Some(Waiting { seen, since: now, answer: None, circumstances });
        self.messages.push(Message::Ask { number: self.program.asked, query: Box::new(query) });
        Ok(Sees::Waits)
    }

    /// The answer that has come, or after [`PROGRAM_ANSWER_WITHIN`] a hold that says that it is missing.
    fn answer_of(&mut self, waiting: &Waiting, now: Duration) -> Option<Answer> {
        if waiting.answer.is_some() || now.saturating_sub(waiting.since) < PROGRAM_ANSWER_WITHIN {
            return waiting.answer.clone();
        }
        self.messages.push(Message::Unanswered { number: self.program.asked });
        let name = self.program.name.as_deref().unwrap_or_default();
        let reason = format!("{name} gave no answer within {} ms", PROGRAM_ANSWER_WITHIN.as_millis());
        Some(Answer::Hold { reason })
    }
}
