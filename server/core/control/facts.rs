//! Refusals and troubles in the form of the wire (see [`crate::facts`]).

use serde::{Deserialize, Serialize};

use super::Refusal;
use super::transport::Trouble;

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
