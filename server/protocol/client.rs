//! What a browser sends.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::numbers::Numbers2;
use super::seed;
use crate::geometry::Point2;
use crate::plant::PositionerKind;
use crate::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted};
use crate::session::{Command, Kept};
use crate::trial::Input;

/// What a browser may send. Fields are named and measured as everywhere: metres in `base`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[ts(tag = "type", rename_all = "snake_case")]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ClientMessage {
    /// Places the goal. Refused outside the workspace, in a wall or out of the arm's reach.
    SetGoal { x_m: f64, y_m: f64 },
    /// Removes the goal: the arm holds.
    ClearGoal {},
    /// The hand holds the bead and wants it here. `lift` carries it over walls.
    Drag {
        x_m: f64,
        y_m: f64,
        #[serde(default)]
        #[ts(optional, as = "Option<bool>")]
        lift: bool,
    },
    /// The hand lets go.
    Release {},
    /// Chooses sub-controller 2.
    SelectController { controller: ControllerName },
    /// Replaces the parameters; what is outside its range is refused, all or nothing.
    Configure { parameters: Parameters },
    /// Lets time run.
    Run {},
    /// Stops time.
    Pause {},
    /// Advances by so many ticks of 8 ms while paused.
    Step { ticks: u32 },
    /// Simulated seconds a second, 0.125 to 64.
    SetSpeed { factor: f64 },
    /// Back to the start, with this seed or the same one.
    Reset {
        #[serde(default)]
        #[ts(optional, type = "number")]
        seed: Option<u64>,
    },
    /// Another map. Controller, seed and parameters stay as they are where they are left out; the positioner is
    /// then what the map is made for, the start is random, and there is neither goal nor disturbance. A seed may be
    /// text, since a number of JavaScript does not hold every one.
    LoadScenario {
        map: String,
        #[serde(default)]
        #[ts(optional)]
        controller: Option<ControllerName>,
        #[serde(default)]
        #[ts(optional)]
        positioner: Option<PositionerKind>,
        #[serde(default, deserialize_with = "seed::number_or_text")]
        #[ts(optional, type = "number | string")]
        #[schema(value_type = Option<Value>)]
        seed: Option<u64>,
        #[serde(default)]
        #[ts(optional)]
        #[schema(value_type = Option<Numbers2>)]
        start_m: Option<[f64; 2]>,
        #[serde(default)]
        #[ts(optional)]
        #[schema(value_type = Option<Numbers2>)]
        goal_m: Option<[f64; 2]>,
        #[serde(default)]
        #[ts(optional)]
        parameters: Option<Parameters>,
        #[serde(default)]
        #[ts(optional, as = "Option<u32>")]
        disturbances: u32,
        #[serde(default)]
        #[ts(optional, as = "Option<Vec<Scripted>>")]
        script: Vec<Scripted>,
    },
    /// Disturbs the bead, or what is known of it, now.
    Disturb { disturbance: Disturbance },
    /// Back to an earlier tick that is still held (see `state.oldest_tick`); pauses.
    Rewind {
        #[ts(type = "number")]
        tick: u64,
    },
    /// Runs the control step at or before a tick that is still held on under these controllers, all of them when
    /// left out, beside the session; the answer is a `comparison`. A new one takes an older one's place.
    #[serde(rename = "fork")]
    #[ts(rename = "fork")]
    Compare {
        #[ts(type = "number")]
        tick: u64,
        #[serde(default)]
        #[ts(optional, as = "Option<Vec<ControllerName>>")]
        controllers: Vec<ControllerName>,
    },
    /// Asks to be the operator.
    TakeControl {},
    /// Stops being the operator.
    ReleaseControl {},
}

impl ClientMessage {
    /// The command for the session; `None` for what concerns the connection, or runs beside the session.
    pub fn command(self) -> Option<Command> {
        let point = |[x, y]: [f64; 2]| Point2::new(x, y);
        Some(match self {
            Self::SetGoal { x_m, y_m } => Command::Input(Input::SetGoal { x_m, y_m }),
            Self::ClearGoal {} => Command::Input(Input::ClearGoal),
            Self::Drag { x_m, y_m, lift } => Command::Input(Input::Drag { x_m, y_m, lift }),
            Self::Release {} => Command::Input(Input::Release),
            Self::SelectController { controller } => Command::Input(Input::SelectController(controller)),
            Self::Configure { parameters } => Command::Input(Input::Configure(Box::new(parameters))),
            Self::Run {} => Command::Run,
            Self::Pause {} => Command::Pause,
            Self::Step { ticks } => Command::Step(ticks),
            Self::SetSpeed { factor } => Command::SetSpeed(factor),
            Self::Reset { seed } => Command::Reset(seed),
            Self::LoadScenario {
                map,
                controller,
                positioner,
                seed,
                start_m,
                goal_m,
                parameters,
                disturbances,
                script,
            } => {
                let kept =
                    Kept { controller: controller.is_none(), seed: seed.is_none(), parameters: parameters.is_none() };
                let idle = Scenario::idle(&map, seed.unwrap_or_default());
                let scenario = Scenario {
                    controller: controller.unwrap_or(idle.controller),
                    positioner,
                    parameters: parameters.unwrap_or_default(),
                    start_m: start_m.map(point),
                    goal_m: goal_m.map(point),
                    disturbances,
                    script,
                    ..idle
                };
                Command::Load { scenario: Box::new(scenario), kept }
            }
            Self::Disturb { disturbance } => Command::Input(Input::Disturb(disturbance)),
            Self::Rewind { tick } => Command::Rewind(tick),
            Self::Compare { .. } | Self::TakeControl {} | Self::ReleaseControl {} => return None,
        })
    }
}
