//! Cases: trials with what an operator did in them.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::scenario::{ControllerName, Disturbance, Parameters, Scenario};
use crate::trial;

describe_schema! {
    trial::Case as Case;
    trial::Timed as Timed;
    trial::Expectation as Expectation;
    trial::LoggedMap as LoggedMap;
    trial::Input as Input;
}

/// A trial that can be run again with whatever the controllers have become.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Case")]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// What it shows.
    pub about: String,
    /// How the trial is set up.
    pub scenario: Scenario,
    /// Its map, where that does not come with Ferry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<trial::LoggedMap>,
    /// What is done in it, in order of ticks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<trial::Timed>,
    /// What must come of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expect: Option<trial::Expectation>,
}

/// An input and its time.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Timed")]
#[serde(deny_unknown_fields)]
pub struct Timed {
    /// It comes before the tick after this one.
    pub tick: u64,
    /// What.
    pub input: trial::Input,
}

/// So many deliveries by then.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Expectation")]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Deliveries since the start.
    pub deliveries: u32,
    /// The last tick that counts.
    pub by_tick: u64,
}

/// A map as it was drawn: those that ship with Ferry may change.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::LoggedMap")]
pub struct LoggedMap {
    /// Name, for people.
    pub name: String,
    /// The drawing.
    pub svg: String,
}

/// One action; stands in the log at the tick that follows it.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Input")]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Input {
    /// Places the goal.
    SetGoal {
        /// x.
        x_m: f64,
        /// y.
        y_m: f64,
    },
    /// Removes the goal.
    ClearGoal,
    /// The hand takes the bead, or moves on with it.
    Drag {
        /// Pointer, x.
        x_m: f64,
        /// Pointer, y.
        y_m: f64,
        /// Whether it carries the bead over walls.
        lift: bool,
    },
    /// While paused, the hand places the bead at once.
    Place {
        /// x.
        x_m: f64,
        /// y.
        y_m: f64,
    },
    /// The hand lets go.
    Release,
    /// Another sub-controller 2.
    SelectController(ControllerName),
    /// Other parameters.
    Configure(Box<Parameters>),
    /// A disturbance, now.
    Disturb(Disturbance),
}
