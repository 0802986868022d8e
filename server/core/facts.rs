//! Facts for programs and pages: a code with values, and one English sentence.
//!
//! These types have the form of the wire. The states of a trial keep their own: saved sessions and logs contain them.

use std::fmt::Display;

use serde::{Deserialize, Serialize};

use crate::control::Refusal;
use crate::control::transport::Trouble;
use crate::session::Void;
use crate::trial::{Phase, StopReason};

/// A fact with its sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
pub struct Told<T> {
    #[serde(flatten)]
    pub fact: T,
    /// One sentence in English.
    pub text: String,
}

impl<T> Told<T> {
    /// The fact of a domain type, with its sentence.
    pub fn of<D: Display + ?Sized>(domain: &D) -> Self
    where
        T: for<'a> From<&'a D>,
    {
        Self { fact: T::from(domain), text: domain.to_string() }
    }
}

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

/// Why sub-controller 2 makes no progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum TroubleFact {
    /// The flow ends at a place that is not the goal.
    Saddle,
    /// The tool goes to and fro without getting nearer.
    Circling,
    InsideObstacle,
    /// Each step is refused.
    Refused,
    /// No path was found yet.
    Searching,
    WalledOff,
    /// Moving walls have closed all paths.
    Closed,
}

impl From<&Trouble> for TroubleFact {
    fn from(trouble: &Trouble) -> Self {
        match trouble {
            Trouble::Saddle => Self::Saddle,
            Trouble::Circling => Self::Circling,
            Trouble::InsideObstacle => Self::InsideObstacle,
            Trouble::Refused => Self::Refused,
            Trouble::Searching => Self::Searching,
            Trouble::WalledOff => Self::WalledOff,
            Trouble::Closed => Self::Closed,
        }
    }
}

/// Why an attempt at a challenge does not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum VoidFact {
    Paused,
    /// Another speed was chosen.
    Speed,
    Rewound,
    /// Something else than the magnet was moved or set.
    OtherInput,
}

impl From<&Void> for VoidFact {
    fn from(void: &Void) -> Self {
        match void {
            Void::Paused => Self::Paused,
            Void::Speed => Self::Speed,
            Void::Rewound => Self::Rewound,
            Void::OtherInput => Self::OtherInput,
        }
    }
}

/// Why the arm holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum RefusalFact {
    NotFinite,
    OutsideWorkspace {
        x_m: f64,
        y_m: f64,
    },
    OutOfReach {
        distance_m: f64,
        min_m: f64,
        max_m: f64,
    },
    Singular {
        manipulability_m3: f64,
        least_m3: f64,
    },
    NoInverse,
    TooFast {
        speed_m_s: f64,
        limit_m_s: f64,
    },
    TrackerLost {
        is_searching: bool,
    },
    /// No policy is loaded, or its network failed.
    Policy {
        detail: String,
    },
    /// The program has asked for a hold, or gave no answer that can be used.
    Program {
        detail: String,
    },
    /// The planner is still searching.
    Searching {
        #[cfg_attr(feature = "schema", ts(type = "number"))]
        attempts: u64,
    },
    WalledOff,
    Closed,
    OutOfView {
        x_m: f64,
        y_m: f64,
    },
    Hidden {
        x_m: f64,
        y_m: f64,
    },
    Obstacle {
        x_m: f64,
        y_m: f64,
    },
}

impl From<&Refusal> for RefusalFact {
    fn from(refusal: &Refusal) -> Self {
        match *refusal {
            Refusal::NotFinite { .. } => Self::NotFinite,
            Refusal::OutsideWorkspace { x_m, y_m } => Self::OutsideWorkspace { x_m, y_m },
            Refusal::OutOfReach { distance_m, min_m, max_m } => Self::OutOfReach { distance_m, min_m, max_m },
            Refusal::Singular { manipulability_m3, least_m3 } => Self::Singular { manipulability_m3, least_m3 },
            Refusal::NoInverse(_) => Self::NoInverse,
            Refusal::TooFast { speed_m_s, limit_m_s } => Self::TooFast { speed_m_s, limit_m_s },
            Refusal::TrackerLost { is_searching } => Self::TrackerLost { is_searching },
            Refusal::Policy(ref detail) => Self::Policy { detail: detail.clone() },
            Refusal::Program(ref detail) => Self::Program { detail: detail.clone() },
            Refusal::Searching { attempts } => Self::Searching { attempts },
            Refusal::WalledOff => Self::WalledOff,
            Refusal::Closed => Self::Closed,
            Refusal::OutOfView { x_m, y_m } => Self::OutOfView { x_m, y_m },
            Refusal::Hidden { x_m, y_m } => Self::Hidden { x_m, y_m },
            Refusal::Obstacle { x_m, y_m } => Self::Obstacle { x_m, y_m },
        }
    }
}
