//! Answers to messages that carry an `id`.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use ts_rs::TS;
use utoipa::ToSchema;

use super::ErrorMessage;
use crate::session::CommandError;

/// See `ServerMessage::Done`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
pub struct DoneMessage {
    /// That of the message.
    #[ts(type = "number")]
    pub id: u64,
    /// The trial that is shown then, as in the scene.
    #[ts(type = "number")]
    pub trial: u64,
}

/// See `ServerMessage::Refused`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct RefusedMessage {
    /// That of the message.
    #[ts(type = "number")]
    pub id: u64,
    /// For programs, such as `in_wall`.
    pub code: String,
    /// The field of the message that it is about.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub field: Option<String>,
    /// What was refused, by name.
    #[ts(type = "Record<string, unknown>")]
    #[schema(value_type = Object)]
    pub values: Map<String, Value>,
    /// One sentence in English.
    pub detail: String,
}

/// Why a message was refused.
#[derive(Clone, Debug)]
pub struct Refusal {
    pub message: ErrorMessage,
    pub values: Map<String, Value>,
}

impl Refusal {
    pub fn new(code: &str, message: &str, field: Option<&str>) -> Self {
        let (code, message, field) = (code.to_owned(), message.to_owned(), field.map(str::to_owned));
        ErrorMessage { code, message, field }.into()
    }

    /// The answer to the message of this id.
    pub fn of(self, id: u64) -> RefusedMessage {
        let Self { message: ErrorMessage { code, message: detail, field }, values } = self;
        RefusedMessage { id, code, field, values, detail }
    }
}

impl From<ErrorMessage> for Refusal {
    fn from(message: ErrorMessage) -> Self {
        Self { message, values: Map::new() }
    }
}

impl From<CommandError> for Refusal {
    fn from(error: CommandError) -> Self {
        let values = error.values().into_iter().map(|(name, value)| (name.to_owned(), value));
        Self { message: ErrorMessage::from(&error), values: values.collect() }
    }
}
