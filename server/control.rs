//! Controllers: percepts and tracker in, next tool target out. They know nothing of the map's truth.

pub mod approach;
pub mod limits;
pub mod switching;
pub mod transport;

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;
use crate::robot::ur5::SERVO_PERIOD_S;

/// Seconds between control steps (specification §1).
pub const CONTROL_PERIOD_S: f64 = 0.25;

/// Whether a control step is due at this tick: the first tick at or after each quarter of a second,
/// so that steps are 31 or 32 ticks apart and never drift.
pub fn step_is_due(tick: u64) -> bool {
    let step_before = |t: u64| (t as f64 * SERVO_PERIOD_S / CONTROL_PERIOD_S + 1e-9).floor();
    tick == 0 || step_before(tick) > step_before(tick - 1)
}

/// Where the tool goes until the next control step: a straight segment at constant speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TargetStep {
    /// End of the segment.
    pub target_m: Point2<f64>,
    /// Speed along it.
    pub speed_m_s: f64,
}

/// Why no step is taken; the arm holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
pub enum Refusal {
    /// A number is not finite.
    #[error("the target ({x_m}, {y_m}) is not finite")]
    NotFinite {
        /// Target, x.
        x_m: f64,
        /// Target, y.
        y_m: f64,
    },
    /// Outside the workspace.
    #[error("the target ({x_m:.3}, {y_m:.3}) m is outside the workspace")]
    OutsideWorkspace {
        /// Target, x.
        x_m: f64,
        /// Target, y.
        y_m: f64,
    },
    /// Outside the arm's annulus.
    #[error("the target is {distance_m:.3} m from the base; the arm reaches {min_m:.3} to {max_m:.3} m at this height")]
    OutOfReach {
        /// Horizontal distance of the target from the base.
        distance_m: f64,
        /// Least distance.
        min_m: f64,
        /// Greatest distance.
        max_m: f64,
    },
    /// Too near to a singular pose.
    #[error("the manipulability at the target is {manipulability_m3:.2e} m³, less than {least_m3:.0e}")]
    Singular {
        /// |det J| there.
        manipulability_m3: f64,
        /// The limit.
        least_m3: f64,
    },
    /// No joint angles.
    #[error("no joint angles reach the target: {0}")]
    NoInverse(String),
    /// Faster than allowed.
    #[error("the step asks for {speed_m_s:.3} m/s, the limit is {limit_m_s:.3}")]
    TooFast {
        /// Speed asked.
        speed_m_s: f64,
        /// The limit.
        limit_m_s: f64,
    },
    /// The policy gives no answer.
    #[error("no policy: {0}")]
    Policy(String),
    /// The planner searches; it goes on at the next control step.
    #[error("the planner searches: {attempts} edges tried")]
    Searching {
        /// Edges tried so far.
        attempts: u64,
    },
    /// No way leads to the goal, whatever is still unseen.
    #[error("the goal is walled off: no way leads there, whatever is still unseen")]
    WalledOff,
    /// The camera does not see where the step goes, as when it is mounted far aside.
    #[error("the step to ({x_m:.3}, {y_m:.3}) m leaves the camera's view")]
    OutOfView {
        /// Target, x.
        x_m: f64,
        /// Target, y.
        y_m: f64,
    },
    /// The obstacle test is true somewhere on the step.
    #[error("the camera sees an obstacle on the step, at ({x_m:.3}, {y_m:.3}) m")]
    Obstacle {
        /// First place that fails, x.
        x_m: f64,
        /// First place that fails, y.
        y_m: f64,
    },
}

#[cfg(test)]
mod tests {
    #[test]
    fn control_steps_keep_four_a_second() {
        let due: Vec<u64> = (0..=1250).filter(|&t| super::step_is_due(t)).collect();
        assert_eq!(due.len(), 41);
        assert_eq!(due[..6], [0, 32, 63, 94, 125, 157]);
    }
}
