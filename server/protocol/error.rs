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
        let field = error.field().map(str::to_owned);
        Self { code: error.code().to_string(), message: error.to_string(), field }
    }
}
