//! Controllers: from the image and the tracked bead to the next tool target. They do not know the true map.

pub mod approach;
pub mod facts;
pub mod limits;
pub mod search;
pub mod switching;
pub mod transport;

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;
use crate::robot::ur5::SERVO_PERIOD_S;

/// Seconds between control steps (specification §1).
pub const CONTROL_PERIOD_S: f64 = 0.25;

/// Whether a control step is due at this tick: the first tick at or after each multiple of .25 s. Steps are 31 or 32
/// ticks apart and do not drift.
pub fn step_is_due(tick: u64) -> bool {
    let step_before = |t: u64| (t as f64 * SERVO_PERIOD_S / CONTROL_PERIOD_S + 1e-9).floor();
    tick == 0 || step_before(tick) > step_before(tick - 1)
}

/// The tool's motion until the next control step: a straight segment at constant speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TargetStep {
    /// End of the segment.
    pub target_m: Point2<f64>,
    /// Speed along the segment.
    pub speed_m_s: f64,
}

impl TargetStep {
    /// A step straight to a place, or as far toward it as a control period at this speed reaches.
    pub fn toward(tool_m: Point2<f64>, place_m: Point2<f64>, speed_m_s: f64) -> Self {
        Self { target_m: tool_m + (place_m - tool_m).cap_magnitude(speed_m_s * CONTROL_PERIOD_S), speed_m_s }
    }
}

/// Why no step is taken. The arm holds its position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
pub enum Refusal {
    /// A coordinate of the target is not finite.
    #[error("the target ({x_m}, {y_m}) is not finite")]
    NotFinite { x_m: f64, y_m: f64 },
    #[error("the target ({x_m:.3}, {y_m:.3}) m is outside the workspace")]
    OutsideWorkspace { x_m: f64, y_m: f64 },
    /// Outside the annulus that the arm can reach.
    #[error("the target is {distance_m:.3} m from the base; the arm reaches {min_m:.3} to {max_m:.3} m at this height")]
    OutOfReach {
        /// Horizontal distance of the target from the base.
        distance_m: f64,
        /// Smallest distance within reach.
        min_m: f64,
        /// Largest distance within reach.
        max_m: f64,
    },
    /// Too close to a singular pose.
    #[error("the manipulability at the target is {manipulability_m3:.2e} m³, less than {least_m3:.0e}")]
    Singular {
        /// |det J| at the target.
        manipulability_m3: f64,
        least_m3: f64,
    },
    #[error("no joint angles reach the target: {0}")]
    NoInverse(String),
    #[error("the step needs {speed_m_s:.3} m/s, the limit is {limit_m_s:.3}")]
    TooFast { speed_m_s: f64, limit_m_s: f64 },
    /// No sample of the tracker has arrived for `tracker_timeout_s`.
    #[error("tracker lost{}", if *is_searching { "; the camera does not show the bead where it was, the arm looks for it" } else { "" })]
    TrackerLost {
        /// The arm looks for the bead with the camera.
        is_searching: bool,
    },
    /// No policy is loaded, or its network failed.
    #[error("no policy: {0}")]
    Policy(String),
    /// The program that decides has asked for a hold, or gave no answer that can be used.
    #[error("the program: {0}")]
    Program(String),
    /// The planner is still searching; it continues at the next control step.
    #[error("the planner is searching: {attempts} edges tried")]
    Searching { attempts: u64 },
    /// No path to the goal exists, even if all unobserved places are free.
    #[error("the goal is walled off: there is no path, even through places not yet observed")]
    WalledOff,
    /// The same, but walls move: they may open again.
    #[error("a segment on the way to the goal is closed: waiting for it to open")]
    Closed,
    /// The step leaves the camera's view, for example because the camera is mounted far to the side.
    #[error("the step to ({x_m:.3}, {y_m:.3}) m leaves the camera's view")]
    OutOfView { x_m: f64, y_m: f64 },
    /// The image cannot show whether a wall is there.
    #[error("the magnet hides the step to ({x_m:.3}, {y_m:.3}) from the camera")]
    Hidden { x_m: f64, y_m: f64 },
    /// The obstacle test is positive somewhere on the step.
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
    fn control_steps_keep_a_rate_of_four_per_second() {
        let due: Vec<u64> = (0..=1250).filter(|&t| super::step_is_due(t)).collect();
        assert_eq!(due.len(), 41);
        assert_eq!(due[..6], [0, 32, 63, 94, 125, 157]);
    }
}
