//! A control step that a program decides: the session asks, and goes on when the answer comes or its time is over.

use super::branch_point::is_answer;
use super::question::{Asking, Circumstances, Sees, Waiting};
use super::worker::Worker;
use crate::camera::ImageSource;
use crate::program::{Place, give};
use ferry_core::control::transport::program::Answer;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::TrialError;

impl<E: ImageSource> Worker<E> {
    /// Whether the next tick waits for an answer.
    pub(super) fn awaits_answer(&mut self) -> bool {
        self.asking.as_mut().is_some_and(|asking| asking.waiting.is_open())
    }

    /// Forgets a question whose answer would no longer fit.
    pub(super) fn check_question(&mut self) {
        if self.asking.as_ref().is_some_and(|asking| asking.circumstances != self.circumstances()) {
            self.asking = None;
        }
    }

    fn circumstances(&self) -> Circumstances {
        Circumstances {
            subject: self.trial.subject(),
            controller: self.trial.state().controller,
            parameters: self.trial.state().world.parameters.clone(),
            program: self.program.as_ref().map(|program| program.name.clone()),
        }
    }

    /// Asks the program if this control step needs an answer, and applies the answer.
    pub(super) fn see(&mut self) -> Result<Sees, TrialError> {
        if !self.trial.step_is_due() || self.trial.state().controller != ControllerName::Program {
            self.asking = None;
            return Ok(Sees::Camera);
        }
        // A test case has the answers among its inputs.
        if self.trial.waiting_inputs().iter().any(is_answer) {
            return Ok(Sees::Camera);
        }
        if self.awaits_answer() {
            return Ok(Sees::Waits);
        }
        if let Some(asking) = self.asking.take() {
            give(&mut self.trial, asking.waiting.end(&asking.program))?;
            return Ok(Sees::Now(asking.seen));
        }
        let seen = self.trial.see(&mut self.camera)?;
        let Some(question) = self.trial.question(&seen) else { return Ok(Sees::Now(Box::new(seen))) };
        let Some(program) = self.program.clone() else {
            give(&mut self.trial, Answer::Hold { reason: "none is selected".to_owned() })?;
            return Ok(Sees::Now(Box::new(seen)));
        };
        let place = Place { name: &self.name, number: self.scenery.trial };
        match program.ask(place, &self.trial, &seen, question) {
            Ok(answered) => {
                let circumstances = self.circumstances();
                let waiting = Waiting::new(answered);
                self.asking = Some(Asking { seen: Box::new(seen), waiting, program, circumstances });
                Ok(Sees::Waits)
            }
            Err(error) => {
                program.note(None);
                give(&mut self.trial, Answer::Hold { reason: format!("{} {error}", program.name) })?;
                Ok(Sees::Now(Box::new(seen)))
            }
        }
    }
}
