//! Commands that move the arm, with URScript's names and units: joints in rad, poses of the tool in m and rad (a rotation
//! vector), speeds per second.

use super::arm::Spatial;
use ferry_core::robot::{Joints, ur5::JOINT_SPEED_LIMIT_RAD_S};

/// Where a move ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    Joints(Joints),
    /// In `base`.
    Pose(Spatial),
}

/// One motion of the arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// All joints begin and end together; the leading joint has this speed and acceleration, rad.
    MoveJ { to: Target, speed: f64, acceleration: f64 },
    /// The tool goes straight, m.
    MoveL { to: Target, speed: f64, acceleration: f64 },
    /// The tool keeps a velocity until the next command, or for `time_s` if that is positive.
    SpeedL { velocity: Spatial, acceleration: f64, time_s: f64 },
    /// The joints keep a velocity.
    SpeedJ { velocity: Joints, acceleration: f64, time_s: f64 },
    /// The joints follow a target that changes again and again, smoothed over `lookahead_s`.
    ServoJ { to: Joints, lookahead_s: f64 },
    /// The arm comes to rest; the tool slows down by this, m/s².
    StopL { deceleration: f64 },
    /// The same for the leading joint, rad/s².
    StopJ { deceleration: f64 },
}

/// Why a command was refused before it began.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}, it must be {allowed}")]
pub struct CommandError {
    pub field: &'static str,
    pub value: f64,
    pub allowed: &'static str,
}

/// Bounds of `ur_rtde` and URScript's manual.
const SPEED_MOST: f64 = JOINT_SPEED_LIMIT_RAD_S;
const ACCELERATION_MOST: f64 = 150.0;
const LOOKAHEAD_S: [f64; 2] = [0.03, 0.2];
/// Far beyond the arm.
const PLACE_MOST: f64 = 10.0;

impl Command {
    /// URScript's name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::MoveJ { .. } => "movej",
            Self::MoveL { .. } => "movel",
            Self::SpeedL { .. } => "speedl",
            Self::SpeedJ { .. } => "speedj",
            Self::ServoJ { .. } => "servoj",
            Self::StopL { .. } => "stopl",
            Self::StopJ { .. } => "stopj",
        }
    }

    /// Checks its numbers; where it leads is checked on the way.
    ///
    /// # Errors
    /// [`CommandError`] names the argument.
    pub fn check(&self) -> Result<(), CommandError> {
        let refuse = |field, value, allowed| Err(CommandError { field, value, allowed });
        let vector =
            |field, values: &[f64; 6]| match values.iter().find(|value| !value.is_finite() || value.abs() > PLACE_MOST)
            {
                Some(&value) => refuse(field, value, "finite, at most 10"),
                None => Ok(()),
            };
        let positive = |field, value: f64, most: f64, allowed| match value > 0.0 && value <= most {
            true => Ok(()),
            false => refuse(field, value, allowed),
        };
        let acceleration = |value| positive("a", value, ACCELERATION_MOST, "above 0, at most 150");
        match self {
            Self::MoveJ { to, speed, acceleration: a } | Self::MoveL { to, speed, acceleration: a } => {
                let (Target::Joints(values) | Target::Pose(values)) = to;
                vector("target", values)?;
                positive("v", *speed, SPEED_MOST, "above 0, at most π")?;
                acceleration(*a)
            }
            Self::SpeedL { velocity, acceleration: a, time_s } | Self::SpeedJ { velocity, acceleration: a, time_s } => {
                vector("velocity", velocity)?;
                acceleration(*a)?;
                if time_s.is_finite() { Ok(()) } else { refuse("t", *time_s, "finite") }
            }
            Self::ServoJ { to, lookahead_s } => {
                vector("q", to)?;
                if (LOOKAHEAD_S[0]..=LOOKAHEAD_S[1]).contains(lookahead_s) {
                    return Ok(());
                }
                refuse("lookahead_time", *lookahead_s, ".03 to .2")
            }
            Self::StopL { deceleration } | Self::StopJ { deceleration } => acceleration(*deceleration),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_out_of_range_are_named() {
        let good = Command::MoveL { to: Target::Pose([0.1; 6]), speed: 0.25, acceleration: 1.2 };
        assert_eq!(good.check(), Ok(()));
        let bad = |command: Command| command.check().unwrap_err().to_string();
        let nan = Command::MoveJ { to: Target::Joints([f64::NAN; 6]), speed: 1.0, acceleration: 1.0 };
        assert_eq!(bad(nan), "target is NaN, it must be finite, at most 10");
        let still = Command::MoveL { to: Target::Pose([0.1; 6]), speed: 0.0, acceleration: 1.2 };
        assert_eq!(bad(still), "v is 0, it must be above 0, at most π");
        let endless = Command::SpeedL { velocity: [0.0; 6], acceleration: 0.5, time_s: f64::INFINITY };
        assert_eq!(bad(endless), "t is inf, it must be finite");
        let late = Command::ServoJ { to: [0.0; 6], lookahead_s: 1.0 };
        assert_eq!(bad(late), "lookahead_time is 1, it must be .03 to .2");
        assert!(bad(Command::StopL { deceleration: -1.0 }).starts_with("a is -1"));
    }
}
