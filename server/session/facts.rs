//! Why a session ended, in the form of the wire (see [`ferry_core::facts`]).

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

/// Why a session ended. `detail` is what the simulator says, in English.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema, thiserror::Error)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum EndFact {
    /// The trial cannot go on, for example without the camera.
    #[error("{detail}")]
    TrialFailed { detail: String },
    /// A fault of Ferry; the server's log has more.
    #[error("{detail}")]
    Crashed { detail: String },
}
