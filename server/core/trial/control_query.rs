//! What a program outside of Ferry is asked before a control step in which it decides, and its answer.

use super::{Input, Question, REASON_BYTES_MOST, Seen, Trial, TrialError};
use crate::control::transport::program::Answer;
use crate::geometry::Rect;
use crate::perception::Percept;
use crate::scenario::Parameters;

/// A control step that a program decides.
#[derive(Clone, Debug)]
pub struct ControlQuery {
    pub question: Question,
    /// The camera's image.
    pub percept: Percept,
    /// Dark blocks of the image on the table.
    pub obstacles: Vec<Rect>,
    pub leg: Leg,
}

/// The part of a trial between two fetches or goals.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Counts the trials of a session.
    pub trial: u64,
    /// Counts switches within a trial.
    pub switches: u32,
    pub map: String,
    pub workspace: Rect,
    pub parameters: Parameters,
}

impl Trial {
    /// What the program has to answer before the next tick; `None` if that needs no answer. `number` counts the trials
    /// of a session.
    pub fn control_query(&self, seen: &Seen, number: u64) -> Option<ControlQuery> {
        let question = self.question(seen)?;
        let world = &self.state().world;
        let leg = Leg {
            trial: number,
            switches: world.counters.switches,
            map: self.scenario().map.clone(),
            workspace: *self.arena().map.workspace(),
            parameters: world.parameters.clone(),
        };
        Some(ControlQuery { question, percept: seen.percept.clone(), obstacles: self.blocks_m(seen), leg })
    }

    /// Takes an answer for the next tick. One that the trial refuses is a hold that says so.
    ///
    /// # Errors
    /// [`TrialError::Input`], if the hold is refused, too.
    pub fn apply_answer(&mut self, answer: Answer) -> Result<(), TrialError> {
        let input = match answer {
            Answer::Go { target_m } => Input::Go { x_m: target_m.x, y_m: target_m.y },
            Answer::Hold { reason } => Input::Hold { reason },
        };
        if let Err(error) = self.apply(input) {
            let mut reason = error.to_string();
            reason.truncate(reason.floor_char_boundary(REASON_BYTES_MOST));
            self.apply(Input::Hold { reason })?;
        }
        Ok(())
    }
}
