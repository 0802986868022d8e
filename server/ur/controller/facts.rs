//! Why the arm is in a protective stop, in the form of the wire (see [`ferry_core::facts`]).

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

/// Why the arm is in a protective stop.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema, thiserror::Error)]
#[serde(tag = "code", rename_all = "snake_case")]
#[schema(as = ProtectiveStop)]
#[ts(rename = "ProtectiveStop")]
pub enum Stop {
    /// A program has called `protective_stop()`.
    #[error("a program has asked for it")]
    Requested,
    /// The motion was refused; `detail` is an English sentence.
    #[error("{detail}")]
    Refused { detail: String },
}

impl Stop {
    pub fn refused(why: impl ToString) -> Self {
        Self::Refused { detail: why.to_string() }
    }
}
