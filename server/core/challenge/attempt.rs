//! An attempt: the input log of a person, with the score that it claims. It counts when a run of the log agrees.

use serde::{Deserialize, Serialize};

use super::score::Referee;
use super::{Challenge, Score, TICKS_MOST, TIME_LIMIT_S, Trace};
use crate::image::ImageSource;
use crate::trial::{Case, Input, InputError, Source, TickRecord, Timed, Trial, TrialError};

/// Largest number of inputs: sixty a second until the time limit, and as many again.
pub const INPUTS_MOST: usize = 2 * 60 * TIME_LIMIT_S as usize;

/// An input log with its claim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = AttemptMessage))]
#[cfg_attr(feature = "schema", ts(rename = "AttemptMessage"))]
#[serde(deny_unknown_fields)]
pub struct Attempt {
    // Without a drawing and an expectation.
    #[cfg_attr(feature = "schema", ts(type = "unknown"))]
    pub log: Case,
    pub score: Score,
    /// Hash of the world at the tick of the delivery, 16 hexadecimal digits.
    pub world_hash: String,
}

/// Why an attempt does not count.
#[derive(Debug, thiserror::Error)]
pub enum AttemptError {
    #[error("log.scenario.{field} is not that of the challenge")]
    OtherScenario { field: &'static str },
    #[error("log.{field} must be left out: a challenge has its own")]
    Extra { field: &'static str },
    #[error("log.inputs has {count} entries, an attempt has {INPUTS_MOST} at most")]
    TooMany { count: usize },
    #[error("log.inputs[{index}] is no steer input, and an attempt has no others")]
    NotSteered { index: usize },
    #[error("log.inputs[{index}].tick is {tick}, which is before the input in front of it")]
    Order { index: usize, tick: u64 },
    #[error("log.inputs[{index}].tick is {tick}, the last tick of an attempt is {TICKS_MOST}")]
    TooLate { index: usize, tick: u64 },
    #[error("log.inputs[{index}].tick is {tick}, after the delivery at tick {delivered}")]
    AfterDelivery { index: usize, tick: u64, delivered: u64 },
    #[error("log.inputs[{index}]: {error}")]
    Refused { index: usize, error: InputError },
    #[error("log: run again, it does not deliver within {TIME_LIMIT_S} s")]
    NotDelivered,
    #[error("score.{field} is {claimed}, but run again, the log gives {found}")]
    OtherScore { field: &'static str, claimed: u64, found: u64 },
    #[error("world_hash is {claimed:?}, but run again, the log gives {found:?}")]
    OtherWorld { claimed: String, found: String },
    /// The camera failed, for example; the attempt may be sent again.
    #[error(transparent)]
    Trial(#[from] TrialError),
}

impl AttemptError {
    /// The field at fault; empty if none is.
    pub fn field(&self) -> String {
        match self {
            Self::OtherScenario { field } => format!("log.scenario.{field}"),
            Self::Extra { field } => format!("log.{field}"),
            Self::TooMany { .. } => "log.inputs".into(),
            Self::NotSteered { index } | Self::Refused { index, .. } => format!("log.inputs[{index}]"),
            Self::Order { index, .. } | Self::TooLate { index, .. } | Self::AfterDelivery { index, .. } => {
                format!("log.inputs[{index}].tick")
            }
            Self::NotDelivered => "log".into(),
            Self::OtherScore { field, .. } => format!("score.{field}"),
            Self::OtherWorld { .. } => "world_hash".into(),
            Self::Trial(_) => String::new(),
        }
    }
}

/// The result of running a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    pub score: Score,
    pub world_hash: String,
    pub trace: Trace,
}

impl Challenge {
    /// Runs an attempt's log again, and returns what it really gives.
    ///
    /// # Errors
    /// [`AttemptError`]: the log is not one of this challenge, or its claim is wrong.
    pub fn judge(&self, attempt: &Attempt, camera: &mut dyn ImageSource) -> Result<Run, AttemptError> {
        Ok(self.judge_watched(attempt, camera, &mut |_| ())?.0)
    }

    /// The same as [`Self::judge`]; `watch` gets every tick, and the trial is returned as it is at the delivery.
    ///
    /// # Errors
    /// As [`Self::judge`].
    pub fn judge_watched(
        &self,
        attempt: &Attempt,
        camera: &mut dyn ImageSource,
        watch: &mut dyn FnMut(&TickRecord),
    ) -> Result<(Run, Trial), AttemptError> {
        let Attempt { log, score, world_hash } = attempt;
        self.check(log)?;
        let (run, trial) = self.run_watched(&log.inputs, camera, watch)?;
        for (field, claimed, found) in [
            ("tick", score.tick, run.score.tick),
            ("walls", score.walls.into(), run.score.walls.into()),
            ("lost_beads", score.lost_beads.into(), run.score.lost_beads.into()),
        ] {
            if claimed != found {
                return Err(AttemptError::OtherScore { field, claimed, found });
            }
        }
        if *world_hash != run.world_hash {
            let claimed = world_hash.chars().take(64).collect();
            return Err(AttemptError::OtherWorld { claimed, found: run.world_hash });
        }
        Ok((run, trial))
    }

    /// Runs inputs on the trial until its first delivery.
    ///
    /// # Errors
    /// [`AttemptError::Refused`], [`AttemptError::AfterDelivery`], [`AttemptError::NotDelivered`].
    pub fn run(&self, inputs: &[Timed], camera: &mut dyn ImageSource) -> Result<Run, AttemptError> {
        Ok(self.run_watched(inputs, camera, &mut |_| ())?.0)
    }

    fn run_watched(
        &self,
        inputs: &[Timed],
        camera: &mut dyn ImageSource,
        watch: &mut dyn FnMut(&TickRecord),
    ) -> Result<(Run, Trial), AttemptError> {
        let mut trial = Trial::new(self.scenario.clone(), self.arena.clone())?;
        let mut referee = Referee::default();
        let mut inputs = inputs.iter().enumerate().peekable();
        while trial.state().world.tick < TICKS_MOST {
            let now = trial.state().world.tick;
            while let Some((index, timed)) = inputs.next_if(|(_, timed)| timed.tick <= now) {
                trial.apply(timed.input.clone()).map_err(|error| AttemptError::Refused { index, error })?;
            }
            let record = trial.tick(Source::Camera(camera))?;
            watch(&record);
            let Some(score) = referee.watch(&record) else { continue };
            if let Some((index, timed)) = inputs.next() {
                return Err(AttemptError::AfterDelivery { index, tick: timed.tick, delivered: score.tick });
            }
            let world_hash = format!("{:016x}", record.world.total());
            return Ok((Run { score, world_hash, trace: referee.into_trace() }, trial));
        }
        Err(AttemptError::NotDelivered)
    }

    /// Everything that can be checked without running the log.
    fn check(&self, log: &Case) -> Result<(), AttemptError> {
        let (own, other) = (&self.scenario, &log.scenario);
        let same = [
            ("map", own.map == other.map),
            ("controller", own.controller == other.controller),
            ("positioner", own.positioner == other.positioner),
            ("seed", own.seed == other.seed),
            ("parameters", own.parameters == other.parameters),
            ("start_m", own.start_m == other.start_m),
            ("goal_m", own.goal_m == other.goal_m),
            ("disturbances", own.disturbances == other.disturbances),
            ("script", own.script == other.script),
        ];
        if let Some(&(field, _)) = same.iter().find(|(_, is_same)| !is_same) {
            return Err(AttemptError::OtherScenario { field });
        }
        let extra = [("map", log.map.is_some()), ("expect", log.expect.is_some())];
        if let Some(&(field, _)) = extra.iter().find(|(_, is_there)| *is_there) {
            return Err(AttemptError::Extra { field });
        }
        if log.inputs.len() > INPUTS_MOST {
            return Err(AttemptError::TooMany { count: log.inputs.len() });
        }
        let mut last = 0;
        for (index, Timed { tick, input }) in log.inputs.iter().enumerate() {
            let tick = *tick;
            if !matches!(input, Input::Steer { .. }) {
                return Err(AttemptError::NotSteered { index });
            }
            if tick < last {
                return Err(AttemptError::Order { index, tick });
            }
            if tick >= TICKS_MOST {
                return Err(AttemptError::TooLate { index, tick });
            }
            last = tick;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
