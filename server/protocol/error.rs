//! Refusals.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::session::CommandError;

/// See `ServerMessage::Error`; an HTTP problem has the same fields.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct ErrorMessage {
    /// For programs, such as `in_wall`.
    pub code: String,
    /// For people: names the field and the value.
    pub message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub field: Option<String>,
}

impl From<&CommandError> for ErrorMessage {
    fn from(error: &CommandError) -> Self {
        let (code, field) = match error {
            CommandError::Session(error) => (error.code(), error.field()),
            CommandError::NoProgram { .. } => ("no_program", Some("program")),
            CommandError::NoTry { .. } => ("no_try", Some("recovery")),
            CommandError::NoGoal { .. } => ("no_goal", Some("tick")),
            CommandError::NoRobot => ("no_robot", None),
            CommandError::Drive(_) => ("robot_refused", None),
            CommandError::Busy => ("busy", None),
            CommandError::Unanswered => ("unanswered", None),
            CommandError::Ended => ("ended", None),
        };
        Self { code: code.to_owned(), message: error.to_string(), field: field.map(str::to_owned) }
    }
}
