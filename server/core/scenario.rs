//! The set-up of a trial: one serde type for links, files, comparisons and lessons.

mod disturbance;
mod link;
mod parameters;
mod random;
mod shipped;
mod streams;

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;
use crate::plant::PositionerKind;
#[cfg(feature = "schema")]
use crate::schema::Numbers2;

pub use disturbance::{
    Disturbance, DisturbanceError, MOST_DRIFT_N, MOST_IMPULSE_N_S, MOST_SECONDS, MOST_STEPS, SCRIPT_LIMIT, Scripted,
    When,
};
pub use parameters::Hashed;
pub use parameters::descriptor;
pub use parameters::{
    AddedPolicy, AttractorLaw, Bound, Group, Kind, Number, Parameter, ParameterError, Parameters, Preset, PresetKind,
    RlPolicy, SetError, SwitchingLaw, Unit,
};
pub use random::{CLEARANCE_M, Ground, LEAST_DISTANCE_M, RandomTrialError, start_point};
pub use shipped::{Shipped, ShippedError};
pub use streams::Stream;

/// Sub-controller 2, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum ControllerName {
    /// A trained Rainbow-IQN policy (paper, §IV-A).
    Rl,
    /// Execution-extended rapidly exploring random trees (paper, §IV-C).
    Errt,
    /// Attractor dynamics (paper, §IV-B).
    Attractor,
    /// The shortest path over what the camera has observed: a reference for evaluations, not from the paper.
    Replanner,
    /// A person: the tool goes where the hand at the page points.
    You,
    /// A program outside of Ferry, which is asked before each control step.
    Program,
    /// A program for a UR5, which commands the joints; nothing else moves the arm.
    Robot,
}

impl ControllerName {
    pub const ALL: [Self; 7] =
        [Self::Rl, Self::Errt, Self::Attractor, Self::Replanner, Self::You, Self::Program, Self::Robot];
    /// Those that need no person and no program.
    pub const AUTOMATIC: [Self; 4] = [Self::Rl, Self::Errt, Self::Attractor, Self::Replanner];
    /// Those of the paper.
    pub const OFFERED: [Self; 3] = [Self::Rl, Self::Errt, Self::Attractor];
    /// Those that the page offers for a session.
    pub const SELECTABLE: [Self; 4] = [Self::Rl, Self::Errt, Self::Attractor, Self::You];

    /// The name in files and commands.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Rl => "rl",
            Self::Errt => "errt",
            Self::Attractor => "attractor",
            Self::Replanner => "replanner",
            Self::You => "you",
            Self::Program => "program",
            Self::Robot => "robot",
        }
    }

    /// The name in sentences, also on the page.
    pub fn label(self) -> &'static str {
        match self {
            Self::Rl => "RL",
            Self::Errt => "ERRT",
            Self::Attractor => "Attractor",
            Self::Replanner => "Replanner",
            Self::You => "You",
            Self::Program => "Program",
            Self::Robot => "Robot client",
        }
    }
}

impl std::str::FromStr for ControllerName {
    type Err = UnknownController;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let found = Self::ALL.into_iter().find(|known| known.as_str() == name);
        found.ok_or_else(|| UnknownController { name: name.to_owned() })
    }
}

/// No controller has this name.
#[derive(Debug, thiserror::Error)]
#[error("controller: there is no controller named {name:?}; there are {}", ControllerName::ALL.map(ControllerName::as_str).join(", "))]
pub struct UnknownController {
    /// The unknown name.
    pub name: String,
}

/// A trial before its first tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Name of the map, or path of an SVG.
    pub map: String,
    /// Sub-controller 2.
    pub controller: ControllerName,
    /// The positioner; if omitted, the one that the map is made for.
    #[serde(default)]
    pub positioner: Option<PositionerKind>,
    /// Seed of everything random in the trial.
    #[cfg_attr(feature = "schema", ts(type = "number"))]
    pub seed: u64,
    /// Parameters at the start.
    #[serde(default)]
    pub parameters: Parameters,
    /// Bead at the start, with the tool above it; if omitted, a random free point.
    #[serde(default)]
    #[cfg_attr(feature = "schema", ts(type = "[number, number] | null"))]
    #[cfg_attr(feature = "schema", schema(value_type = Option<Numbers2>))]
    pub start_m: Option<Point2<f64>>,
    /// Goal at the start; if omitted, the arm holds.
    #[serde(default)]
    #[cfg_attr(feature = "schema", ts(type = "[number, number] | null"))]
    #[cfg_attr(feature = "schema", schema(value_type = Option<Numbers2>))]
    pub goal_m: Option<Point2<f64>>,
    /// Number of random displacements of the bead during transport.
    #[serde(default)]
    pub disturbances: u32,
    /// Scripted disturbances, at most [`SCRIPT_LIMIT`].
    #[serde(default)]
    pub script: Vec<Scripted>,
}

impl Scenario {
    /// The scenario of a new session: a map without a goal.
    pub fn idle(map: &str, seed: u64) -> Self {
        Self {
            map: map.to_owned(),
            controller: ControllerName::Attractor,
            positioner: None,
            seed,
            parameters: Parameters::default(),
            start_m: None,
            goal_m: None,
            disturbances: 0,
            script: Vec::new(),
        }
    }
}
