//! Events: what a session reports once, with its tick.

use serde::{Deserialize, Serialize};

use super::PhaseFact;
use crate::control::facts::RefusalFact;
use crate::control::switching::Reason;
use crate::facts::Told;
use crate::scenario::ControllerName;

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

/// What has happened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum Happening {
    #[error("sub-controller {sub_controller} takes over: {}", reason.text)]
    TookOver { sub_controller: u8, reason: Told<Reason> },
    #[error("disturbed: bead taken by hand")]
    Taken,
    #[error("disturbed: bead moved {:.0} cm by hand", distance_m * 100.0)]
    Placed { distance_m: f64 },
    #[error("bead released")]
    Released,
    #[error("disturbed: the bead was lifted {:.0} cm away", distance_m * 100.0)]
    Displaced { distance_m: f64 },
    #[error("disturbed: a kick of {:.2} mN·s", impulse_n_s * 1e3)]
    Kicked { impulse_n_s: f64 },
    #[error("disturbed: a push of {:.1} mN for {for_s} s", force_n * 1e3)]
    Pushed { force_n: f64, for_s: f64 },
    #[error("disturbed: the tracker is blind for {for_s} s")]
    Blinded { for_s: f64 },
    #[error("no disturbance: no free place is far enough from the bead")]
    NotDisturbed,
    #[error("goal placed at ({x_m:.3}, {y_m:.3}) m")]
    GoalPlaced { x_m: f64, y_m: f64 },
    #[error("goal removed")]
    GoalRemoved,
    #[error("reached: the tool is within 2 cm of the goal")]
    Reached,
    #[error("delivered: bead within {:.0} mm of the goal", distance_m * 1e3)]
    Delivered { distance_m: f64 },
    #[error("lift-off: the bead jumped to the magnet")]
    LiftedOff,
    #[error("{}{}", if *is_holding { "the arm holds: " } else { "" }, refusal.text)]
    StepRefused {
        refusal: Told<RefusalFact>,
        /// Whether the arm holds; it does not while it looks for the bead.
        is_holding: bool,
    },
    #[error("the tracker reports the bead again")]
    TrackerBack,
    #[error("{}", phase.text)]
    Stopped { phase: Told<PhaseFact> },
    #[error("controller: {}", controller.label())]
    ControllerSelected { controller: ControllerName },
    #[error("set up: map {map}, seed {seed}{}", inputs.map_or(String::new(), |count| format!(", test case with {count} inputs")))]
    SetUp {
        map: String,
        #[cfg_attr(feature = "schema", ts(type = "number"))]
        seed: u64,
        /// Inputs of the test case, if one was opened.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", ts(optional))]
        inputs: Option<u32>,
    },
    /// A moment of another run.
    #[error("set up: {about}")]
    TookUp { about: String },
    #[error("returned to run {run}")]
    Returned { run: u32 },
    #[error("test case: {count} inputs at this tick were left out; the last one because {detail}")]
    InputsLeftOut { count: u32, detail: String },
    /// The session was opened again.
    #[error("{}{}", how.words(), lost.as_ref().map_or(String::new(), |lost| format!("; {lost}")))]
    Resumed {
        how: Resumption,
        /// What could not be read.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", ts(optional))]
        lost: Option<String>,
    },
    /// From a robot or from a program for one, in its own words.
    #[error("{}: {detail}", if *is_client { "robot client" } else { "robot" })]
    Robot { is_client: bool, is_refused: bool, detail: String },
}

/// How an interrupted session goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Resumption {
    /// From its last saved state.
    GoesOn,
    StartedOver,
    /// It started over; what was saved is kept as runs.
    StartedOverWithRuns,
}

impl Resumption {
    fn words(self) -> &'static str {
        match self {
            Self::GoesOn => "the session goes on from its last saved state",
            Self::StartedOver => "the session started over",
            Self::StartedOverWithRuns => "the session started over; what was saved is kept as runs",
        }
    }
}

impl Happening {
    pub fn kind(&self) -> EventKind {
        match self {
            Self::TookOver { .. } => EventKind::Switch,
            Self::Taken
            | Self::Placed { .. }
            | Self::Released
            | Self::Displaced { .. }
            | Self::Kicked { .. }
            | Self::Pushed { .. }
            | Self::Blinded { .. } => EventKind::Disturbance,
            Self::GoalPlaced { .. } | Self::GoalRemoved => EventKind::Goal,
            Self::Reached => EventKind::Reached,
            Self::Delivered { .. } => EventKind::Delivered,
            Self::LiftedOff => EventKind::LiftOff,
            Self::StepRefused { .. } | Self::Robot { is_refused: true, .. } => EventKind::Refused,
            Self::Stopped { .. } => EventKind::Stopped,
            Self::NotDisturbed
            | Self::TrackerBack
            | Self::ControllerSelected { .. }
            | Self::SetUp { .. }
            | Self::TookUp { .. }
            | Self::Returned { .. }
            | Self::InputsLeftOut { .. }
            | Self::Resumed { .. }
            | Self::Robot { .. } => EventKind::Session,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    pub tick: u64,
    pub what: Happening,
}

impl Event {
    pub fn new(tick: u64, what: Happening) -> Self {
        Self { tick, what }
    }

    pub fn kind(&self) -> EventKind {
        self.what.kind()
    }

    /// One sentence.
    pub fn text(&self) -> String {
        self.what.to_string()
    }
}
