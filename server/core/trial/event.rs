//! Events: what a session reports once, with its tick.

use serde::{Deserialize, Serialize};

/// Kinds of event, for the timeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// The switching law changed the active sub-controller.
    Switch,
    /// The bead was taken, moved or released.
    Disturbance,
    /// The goal was placed or removed.
    Goal,
    /// The tool came within 2 cm of the goal.
    Reached,
    /// The bead came within 2 cm of the goal, too.
    Delivered,
    /// The bead jumped to the magnet.
    LiftOff,
    /// A controller or a limit refused a step.
    Refused,
    /// A limit of steps or time was exceeded.
    Stopped,
    /// Something about the session itself.
    Session,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    pub tick: u64,
    pub kind: EventKind,
    /// One sentence.
    pub text: String,
}

impl Event {
    /// An event.
    pub fn new(tick: u64, kind: EventKind, text: impl Into<String>) -> Self {
        Self { tick, kind, text: text.into() }
    }
}
