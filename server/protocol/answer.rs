//! Answers to messages that carry an `id`.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::session::CommandError;
use ferry_core::facts::RefusalCode;

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
    pub code: RefusalCode,
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

/// See `ServerMessage::Error`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct SessionError {
    pub code: RefusalCode,
    /// For people: names the field and the value.
    pub message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub field: Option<String>,
    /// What was refused, by name.
    #[ts(type = "Record<string, unknown>")]
    #[schema(value_type = Object)]
    pub values: Map<String, Value>,
}

/// Why a message was refused.
#[derive(Clone, Debug)]
pub struct Refusal {
    pub code: RefusalCode,
    pub field: Option<String>,
    pub values: Map<String, Value>,
    pub detail: String,
}

impl Refusal {
    pub fn new(code: RefusalCode, detail: &str, field: Option<&str>) -> Self {
        Self { code, field: field.map(str::to_owned), values: Map::new(), detail: detail.to_owned() }
    }

    pub fn with(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.values.insert(name.to_owned(), value.into());
        self
    }

    /// The answer to the message of this id.
    pub fn of(self, id: u64) -> RefusedMessage {
        let Self { code, field, values, detail } = self;
        RefusedMessage { id, code, field, values, detail }
    }
}

impl From<Refusal> for SessionError {
    fn from(Refusal { code, field, values, detail: message }: Refusal) -> Self {
        Self { code, message, field, values }
    }
}

impl From<CommandError> for Refusal {
    fn from(error: CommandError) -> Self {
        let values = error.values().into_iter().map(|(name, value)| (name.to_owned(), value));
        Self {
            code: error.code(),
            field: error.field().map(str::to_owned),
            values: values.collect(),
            detail: error.to_string(),
        }
    }
}
