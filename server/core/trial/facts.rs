//! Phases and recordings in the form of the wire (see [`crate::facts`]).

use serde::{Deserialize, Serialize};

use super::{Phase, StopReason};

/// What the trial does now.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum PhaseFact {
    /// The arm holds: there is no goal.
    Holding,
    /// Sub-controller 1 fetches the bead.
    Approaching,
    /// Sub-controller 2 carries it.
    Transporting,
    /// The tool is at the goal, the bead follows.
    Settling,
    /// The bead is within 2 cm of the goal.
    Delivered,
    /// The bead jumped to the magnet.
    LiftedOff,
    /// A limit was reached; the arm holds until the goal moves.
    Stopped {
        by: StopCode,
        /// The limit, where it is one of steps.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", ts(optional))]
        steps: Option<u32>,
    },
}

/// The limit that stopped a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum StopCode {
    /// The steps of a leg; each fetch begins a new leg.
    LegSteps,
    /// The steps of a goal.
    GoalSteps,
    TrackerLost,
    /// The tool reached the goal, and the bead did not follow within 5 s.
    Settle,
    WalledOff,
}

impl From<&Phase> for PhaseFact {
    fn from(phase: &Phase) -> Self {
        let stopped = |by, steps| Self::Stopped { by, steps };
        match *phase {
            Phase::Holding => Self::Holding,
            Phase::Approaching => Self::Approaching,
            Phase::Transporting => Self::Transporting,
            Phase::Settling { .. } => Self::Settling,
            Phase::Delivered => Self::Delivered,
            Phase::LiftedOff => Self::LiftedOff,
            Phase::Stopped(StopReason::LegSteps { limit }) => stopped(StopCode::LegSteps, Some(limit)),
            Phase::Stopped(StopReason::GoalSteps { limit }) => stopped(StopCode::GoalSteps, Some(limit)),
            Phase::Stopped(StopReason::TrackerLost) => stopped(StopCode::TrackerLost, None),
            Phase::Stopped(StopReason::Settle) => stopped(StopCode::Settle, None),
            Phase::Stopped(StopReason::WalledOff) => stopped(StopCode::WalledOff, None),
        }
    }
}

/// Whether a trial is recorded. `detail` is what the system says, in English.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum RecordingFact {
    #[error("recording")]
    On,
    /// The disk is too slow: the recording has gaps.
    #[error("recording, {lost_ticks} ticks lost: the disk is too slow")]
    Slow {
        #[cfg_attr(feature = "schema", ts(type = "number"))]
        lost_ticks: u64,
    },
    /// It goes on when its folder is back.
    #[error("interrupted: {detail}; waiting for its folder")]
    Interrupted { detail: String },
    #[error("stopped: {detail}")]
    Stopped { detail: String },
    /// It could not begin.
    #[error("not recording: {detail}")]
    Refused { detail: String },
    /// It was not asked for.
    #[error("not recording")]
    Off,
}
