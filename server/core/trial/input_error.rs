//! Why an input was refused.

use serde_json::Value;

use crate::control::Refusal;
use crate::control::limits::JointRefusal;
use crate::facts::RefusalCode;
use crate::scenario::{ControllerName, DisturbanceError, ParameterError};

/// Maximum number of inputs before one tick: a quarter of an hour of dragging while paused. All are logged.
pub(super) const WAITING_MOST: usize = 50_000;
/// Largest length of a program's reason.
pub const REASON_BYTES_MOST: usize = 200;

/// Why an input was refused. The trial did not change.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InputError {
    /// Not a number.
    #[error("{field} is {value}, it must be finite")]
    NotFinite { field: &'static str, value: f64 },
    /// Not on the table.
    #[error("{field} ({x_m:.3}, {y_m:.3}) m is outside the workspace")]
    OutsideWorkspace { field: &'static str, x_m: f64, y_m: f64 },
    /// In a wall, or nearer to one than the bead's radius.
    #[error("{field} ({x_m:.3}, {y_m:.3}) m is in a wall or nearer to one than the bead's radius of 2.5 mm")]
    InWall { field: &'static str, x_m: f64, y_m: f64 },
    /// The arm cannot go there.
    #[error("{field}: {refusal}")]
    Reach { field: &'static str, refusal: Refusal },
    /// A parameter out of range.
    #[error("parameters: {0}")]
    Parameter(#[from] ParameterError),
    /// A disturbance is invalid.
    #[error("disturbance: {0}")]
    Disturbance(#[from] DisturbanceError),
    /// Only a person is steered.
    #[error("steer: the controller is {}, only You can be steered", .0.label())]
    NotYou(ControllerName),
    /// Only a program for a UR5 commands the joints.
    #[error("joints_rad: the controller is {}, only a robot client commands the joints", .0.label())]
    NotRobot(ControllerName),
    #[error("joints_rad: {0}")]
    Joints(#[from] JointRefusal),
    /// Only a program gives answers.
    #[error("answer: the controller is {}, only a program is asked", .0.label())]
    NotProgram(ControllerName),
    #[error("reason has {bytes} bytes, it must have {REASON_BYTES_MOST} at most")]
    LongReason { bytes: usize },
    /// Too many inputs are waiting for the next tick of a paused session.
    #[error("the session is paused and {WAITING_MOST} inputs wait for its next tick; run it first")]
    TooManyWait,
}

impl InputError {
    /// For programs.
    pub fn code(&self) -> RefusalCode {
        match self {
            Self::NotFinite { .. } => RefusalCode::NotFinite,
            Self::OutsideWorkspace { .. } => RefusalCode::OutsideWorkspace,
            Self::InWall { .. } => RefusalCode::InWall,
            Self::Reach { .. } => RefusalCode::OutOfReach,
            Self::Parameter(_) => RefusalCode::ParameterOutOfRange,
            Self::Disturbance(_) => RefusalCode::DisturbanceOutOfRange,
            Self::NotYou(_) => RefusalCode::NotYou,
            Self::NotRobot(_) => RefusalCode::NotRobot,
            Self::Joints(_) => RefusalCode::JointsRefused,
            Self::NotProgram(_) => RefusalCode::NotProgram,
            Self::LongReason { .. } => RefusalCode::LongReason,
            Self::TooManyWait => RefusalCode::TooManyWait,
        }
    }

    /// What was refused, by name, for programs.
    pub fn values(&self) -> Vec<(&'static str, Value)> {
        match *self {
            Self::NotFinite { value, .. } => vec![("value", value.into())],
            Self::OutsideWorkspace { x_m, y_m, .. } | Self::InWall { x_m, y_m, .. } => {
                vec![("x_m", x_m.into()), ("y_m", y_m.into())]
            }
            Self::Parameter(ParameterError { value, ref allowed, .. })
            | Self::Disturbance(DisturbanceError { value, ref allowed, .. }) => {
                vec![("value", value.into()), ("allowed", allowed.as_str().into())]
            }
            Self::NotYou(controller) | Self::NotRobot(controller) | Self::NotProgram(controller) => {
                vec![("controller", controller.as_str().into())]
            }
            Self::LongReason { bytes } => vec![("bytes", bytes.into())],
            Self::Reach { .. } | Self::Joints(_) | Self::TooManyWait => Vec::new(),
        }
    }

    pub fn field(&self) -> &'static str {
        match self {
            Self::NotFinite { field, .. }
            | Self::OutsideWorkspace { field, .. }
            | Self::InWall { field, .. }
            | Self::Reach { field, .. } => field,
            Self::Parameter(error) => error.field,
            Self::Disturbance(error) => error.field,
            Self::LongReason { .. } => "reason",
            Self::Joints(_) | Self::NotRobot(_) => "joints_rad",
            Self::NotYou(_) | Self::NotProgram(_) | Self::TooManyWait => "type",
        }
    }
}
