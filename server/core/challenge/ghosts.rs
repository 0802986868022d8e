//! How the controllers do in a challenge.

use serde::{Deserialize, Serialize};

use super::{Challenge, Referee, Score, TICKS_MOST, Trace};
use crate::image::ImageSource;
use crate::scenario::{ControllerName, Scenario};
use crate::trial::{Source, Trial, TrialError};

/// A run of a controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ghost {
    pub controller: ControllerName,
    /// `None` if it has not delivered in time.
    pub score: Option<Score>,
    pub trace: Trace,
}

impl Challenge {
    /// Runs a controller on the trial until its delivery or the time limit.
    ///
    /// # Errors
    /// [`TrialError`].
    pub fn ghost(&self, controller: ControllerName, camera: &mut dyn ImageSource) -> Result<Ghost, TrialError> {
        let scenario = Scenario { controller, ..self.scenario.clone() };
        let mut trial = Trial::new(scenario, self.arena.clone())?;
        let mut referee = Referee::default();
        let mut score = None;
        while score.is_none() && trial.state().world.tick < TICKS_MOST {
            score = referee.watch(&trial.tick(Source::Camera(camera))?);
        }
        Ok(Ghost { controller, score, trace: referee.into_trace() })
    }
}
