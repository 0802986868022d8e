//! A program for a UR5 instead of sub-controller 2. It commands the joints, tick by tick, so it is never asked for a step.

use serde::{Deserialize, Serialize};

use super::{Transport, TransportInput, Trouble};
use crate::control::{Refusal, TargetStep};

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Robot;

impl Transport for Robot {
    fn start_leg(&mut self) {}

    fn next_step(&mut self, _: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        Err(Refusal::Program("it commands the joints".to_owned()))
    }

    fn trouble(&self) -> Option<Trouble> {
        None
    }
}
