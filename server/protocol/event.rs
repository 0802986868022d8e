//! Events of a session.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::facts::Told;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::trial::{Event, EventKind, Happening};

/// See `ServerMessage::Event`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct EventMessage {
    #[ts(type = "number")]
    pub tick: u64,
    pub sim_time_s: f64,
    pub kind: EventKind,
    pub what: Told<Happening>,
    /// Part of the past of a run that the session has returned to; omitted otherwise.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[ts(optional, as = "Option<bool>")]
    pub again: bool,
}

impl From<&Event> for EventMessage {
    fn from(event: &Event) -> Self {
        Self {
            tick: event.tick,
            sim_time_s: event.tick as f64 * SERVO_PERIOD_S,
            kind: event.kind(),
            what: Told { fact: event.what.clone(), text: event.text() },
            again: false,
        }
    }
}
