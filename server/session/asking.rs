//! A control step that a program decides: the session asks, and goes on when the answer comes or its time is over.

use tokio::sync::oneshot;

use super::programs::{Asked, Leg};
use super::question::{Asking, Circumstances, Sees, Waiting};
use super::worker::Worker;
use crate::camera::ImageSource;
use crate::control::transport::program::Answer;
use crate::scenario::ControllerName;
use crate::trial::{Input, REASON_BYTES_MOST, TrialError};

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
        let is_answer = |input: &Input| matches!(input, Input::Go { .. } | Input::Hold { .. });
        if self.trial.waiting_inputs().iter().any(is_answer) {
            return Ok(Sees::Camera);
        }
        if self.awaits_answer() {
            return Ok(Sees::Waits);
        }
        if let Some(asking) = self.asking.take() {
            self.take(asking.waiting.end(&asking.program))?;
            return Ok(Sees::Now(asking.seen));
        }
        let seen = self.trial.see(&mut self.camera)?;
        let Some(question) = self.trial.question(&seen) else { return Ok(Sees::Now(Box::new(seen))) };
        let Some(program) = self.program.clone() else {
            self.take(Answer::Hold { reason: "none is selected".to_owned() })?;
            return Ok(Sees::Now(Box::new(seen)));
        };
        let state = self.trial.state();
        let leg = Leg {
            trial: self.scenery.trial,
            switches: state.world.counters.switches,
            map: self.trial.scenario().map.clone(),
            workspace: *self.trial.arena().map.workspace(),
            parameters: state.world.parameters.clone(),
        };
        let (answer, answered) = oneshot::channel();
        let (percept, obstacles) = (seen.percept.clone(), self.trial.blocks_m(&seen));
        let asked = Asked { trial: self.name.clone(), question, percept, obstacles, leg, answer };
        if let Err(error) = program.ask(asked) {
            program.note(None);
            self.take(Answer::Hold { reason: format!("{} {error}", program.name) })?;
            return Ok(Sees::Now(Box::new(seen)));
        }
        let circumstances = self.circumstances();
        self.asking = Some(Asking { seen: Box::new(seen), waiting: Waiting::new(answered), program, circumstances });
        Ok(Sees::Waits)
    }

    /// Applies an answer; one that the trial refuses is a hold that says so.
    fn take(&mut self, answer: Answer) -> Result<(), TrialError> {
        let input = match answer {
            Answer::Go { target_m } => Input::Go { x_m: target_m.x, y_m: target_m.y },
            Answer::Hold { reason } => Input::Hold { reason },
        };
        if let Err(error) = self.trial.apply(input) {
            let mut reason = error.to_string();
            reason.truncate(reason.floor_char_boundary(REASON_BYTES_MOST));
            self.trial.apply(Input::Hold { reason })?;
        }
        Ok(())
    }
}
