//! The phase of the task: from holding to delivered, or stopped by a limit.

use serde::{Deserialize, Serialize};

/// The bead may take this long to follow after the tool has reached the goal.
pub const SETTLE_S: f64 = 5.0;
/// A goal may take this many times the steps of a leg. The same limit holds for the steps without the tracker.
pub const LEGS_PER_GOAL: u32 = 4;

/// Progress of the task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// No goal: the arm holds.
    Holding,
    /// Sub-controller 1 fetches the bead.
    Approaching,
    /// Sub-controller 2 carries it.
    Transporting,
    /// The tool is at the goal, the bead follows.
    Settling {
        /// Tick at which the tool reached the goal.
        since_tick: u64,
    },
    /// The bead is within 2 cm of the goal.
    Delivered,
    /// The bead jumped to the magnet.
    LiftedOff,
    /// A limit was reached; the arm holds until the goal moves.
    Stopped(StopReason),
}

/// The limit that stopped a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StopReason {
    /// The parameter `step_limit`, per leg; each fetch begins a new leg.
    LegSteps { limit: u32 },
    /// [`LEGS_PER_GOAL`] times `step_limit`, per goal.
    GoalSteps { limit: u32 },
    /// The tracker was lost for too long.
    TrackerLost,
    /// [`SETTLE_S`]: reached, but not delivered.
    Settle,
    /// No path leads to the goal.
    WalledOff,
}

impl std::fmt::Display for Phase {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = match self {
            Self::Holding => "holding",
            Self::Approaching => "approaching",
            Self::Transporting => "transporting",
            Self::Settling { .. } => "settling",
            Self::Delivered => "delivered",
            Self::LiftedOff => "lifted off",
            Self::Stopped(StopReason::LegSteps { limit }) => {
                return write!(f, "stopped: {limit} steps without reaching the goal");
            }
            Self::Stopped(StopReason::GoalSteps { limit }) => {
                return write!(f, "stopped: {limit} steps without delivering");
            }
            Self::Stopped(StopReason::TrackerLost) => "stopped: the tracker was lost for too long",
            Self::Stopped(StopReason::Settle) => "stopped: reached, but the bead did not follow within 5 s",
            Self::Stopped(StopReason::WalledOff) => "stopped: the goal is walled off",
        };
        f.write_str(text)
    }
}

impl Phase {
    /// Whether a limit or a jump to the magnet has ended the task.
    pub fn has_failed(self) -> bool {
        matches!(self, Self::LiftedOff | Self::Stopped(_))
    }

    /// Whether an evaluated episode ends here.
    pub fn is_final(self) -> bool {
        self == Self::Delivered || self.has_failed()
    }
}
