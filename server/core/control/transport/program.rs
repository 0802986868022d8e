//! A program outside of Ferry as sub-controller 2. It is asked before each control step, and its answer comes in as an
//! input, so a log replays without the program.

use serde::{Deserialize, Serialize};

use super::{Transport, TransportInput, Trouble};
use crate::control::{Refusal, TargetStep};
use crate::geometry::Point2;

/// What a program wants in one control step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// Straight to a place, as far as a control step reaches.
    Go { target_m: Point2<f64> },
    /// The arm holds.
    Hold { reason: String },
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Program {
    /// For the next control step only.
    answer: Option<Answer>,
}

impl Program {
    pub fn answer(&mut self, answer: Answer) {
        self.answer = Some(answer);
    }
}

impl Transport for Program {
    /// The answer was given for this control step.
    fn start_leg(&mut self) {}

    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        match self.answer.take() {
            Some(Answer::Go { target_m }) => {
                Ok(TargetStep::toward(input.tool_m, target_m, input.parameters.transport_speed_m_s))
            }
            Some(Answer::Hold { reason }) => Err(Refusal::Program(reason)),
            None => Err(Refusal::Program("it gave no answer".to_owned())),
        }
    }

    fn trouble(&self) -> Option<Trouble> {
        None
    }
}
