//! Why an attempt does not count, in the form of the wire (see [`crate::facts`]).

use serde::{Deserialize, Serialize};

use super::Void;

/// Why an attempt at a challenge does not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum VoidFact {
    Paused,
    /// Another speed was chosen.
    Speed,
    Rewound,
    /// Something else than the magnet was moved or set.
    OtherInput,
}

impl From<&Void> for VoidFact {
    fn from(void: &Void) -> Self {
        match void {
            Void::Paused => Self::Paused,
            Void::Speed => Self::Speed,
            Void::Rewound => Self::Rewound,
            Void::OtherInput => Self::OtherInput,
        }
    }
}
