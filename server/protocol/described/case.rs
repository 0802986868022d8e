//! Test cases: trials with the operator's inputs.

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

/// A trial that can be run again with the present controllers.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Case")]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Description.
    pub about: String,
    pub scenario: Scenario,
    /// Its map, if the map does not ship with Ferry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<trial::LoggedMap>,
    /// The inputs, in order of ticks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<trial::Timed>,
    /// The expected result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expect: Option<trial::Expectation>,
}

/// An input with its tick.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Timed")]
#[serde(deny_unknown_fields)]
pub struct Timed {
    /// The input is applied after this tick and before the next one.
    pub tick: u64,
    pub input: trial::Input,
}

/// Expected number of deliveries up to a tick.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Expectation")]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Deliveries since the start.
    pub deliveries: u32,
    /// The last tick that counts.
    pub by_tick: u64,
}

/// A map with its drawing, because shipped maps may change.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::LoggedMap")]
pub struct LoggedMap {
    /// Name, for people.
    pub name: String,
    /// The drawing.
    pub svg: String,
    /// Version of the reader that made walls of it; 1 if it is not given.
    #[serde(default = "crate::map::first_reader")]
    pub reader: u32,
}

/// An input of a trial; it is logged with the tick that follows it.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(remote = "crate::trial::Input")]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Input {
    /// Places the goal.
    SetGoal { x_m: f64, y_m: f64 },
    /// Removes the goal.
    ClearGoal,
    /// The hand takes the bead or moves it.
    Drag {
        /// Pointer, x.
        x_m: f64,
        /// Pointer, y.
        y_m: f64,
        /// Whether the bead is lifted over walls.
        lift: bool,
    },
    /// While paused, the hand places the bead at once.
    Place { x_m: f64, y_m: f64 },
    /// The hand releases the bead.
    Release,
    /// Selects sub-controller 2.
    SelectController(ControllerName),
    /// Replaces the parameters.
    Configure(Box<Parameters>),
    /// Applies a disturbance now.
    Disturb(Disturbance),
    /// Points the tool of the controller `you` to a place; it goes there, within its limits.
    Steer {
        x_m: f64,
        y_m: f64,
        /// Whether the hand also steers while sub-controller 1 is active.
        approach: bool,
    },
    /// All random numbers from now on are those of another seed, as if the trial had its luck again.
    Reseed {
        /// Replaces the scenario's seed.
        seed: u64,
    },
    /// The answer of a program for the next control step: the tool goes there, as far as a step reaches.
    Go { x_m: f64, y_m: f64 },
    /// The answer of a program for the next control step: the arm holds.
    Hold {
        /// At most 200 bytes.
        reason: String,
    },
    /// Joint angles at the next tick, from a program for a UR5.
    Servo { joints_rad: [f64; 6] },
    /// At the next tick the arm is where a robot outside of Ferry is. A tick without this moves the simulated arm.
    Mirror {
        joints_rad: [f64; 6],
        /// Whether the robot follows Ferry's controllers. If not, something else moves it.
        is_driven: bool,
    },
}
