//! Refusals.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::session::CommandError;
use ferry_core::trial::{InputError, TrialError};

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
            CommandError::Input(error) | CommandError::Trial(TrialError::Input(error)) => of_input(error),
            CommandError::Map(_) | CommandError::Trial(TrialError::Map(_) | TrialError::Random(_)) => {
                ("map_refused", Some("map"))
            }
            CommandError::Trial(TrialError::Policy(_)) => ("unknown_policy", Some("rl_policy")),
            CommandError::Case(error) => ("bad_case", Some(error.field()).filter(|field| !field.is_empty())),
            CommandError::OtherDrawing { .. } => ("other_drawing", Some("map.name")),
            CommandError::Trial(TrialError::Parameter(error)) => ("parameter_out_of_range", Some(error.field)),
            CommandError::Trial(TrialError::Script { .. } | TrialError::LongScript { .. }) => {
                ("bad_script", Some("script"))
            }
            CommandError::Trial(_) => ("trial_failed", None),
            CommandError::Range { field, .. } => ("out_of_range", Some(*field)),
            CommandError::Challenge(_) => ("map_refused", Some("challenge")),
            CommandError::NoChallenge => ("no_challenge", None),
            CommandError::NoProgram { .. } => ("no_program", Some("program")),
            CommandError::NoRun { .. } => ("no_run", Some("run")),
            CommandError::NoTry { .. } => ("no_try", Some("recovery")),
            CommandError::NoGoal { .. } => ("no_goal", Some("tick")),
            CommandError::NothingCarried { .. } => ("nothing_carried", Some("tick")),
            CommandError::Forgotten => ("forgotten", None),
            CommandError::NoRobot => ("no_robot", None),
            CommandError::Drive(_) => ("robot_refused", None),
            CommandError::Busy => ("busy", None),
            CommandError::Unanswered => ("unanswered", None),
            CommandError::Ended => ("ended", None),
        };
        Self { code: code.to_owned(), message: error.to_string(), field: field.map(str::to_owned) }
    }
}

fn of_input(error: &InputError) -> (&'static str, Option<&'static str>) {
    (error.code(), Some(error.field()))
}
