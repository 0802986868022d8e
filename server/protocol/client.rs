//! Messages from a browser.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::seed;
use ferry_core::challenge::ChallengeName;
use ferry_core::geometry::Point2;
use ferry_core::plant::PositionerKind;
use ferry_core::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted};
use ferry_core::schema::Numbers2;
use ferry_core::session::{Command, Kept};
use ferry_core::trial::Input;

/// A message from a browser. Positions are in metres in `base`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[ts(tag = "type", rename_all = "snake_case")]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ClientMessage {
    /// Places the goal. Refused outside the workspace, in a wall or out of the arm's reach.
    SetGoal {
        x_m: f64,
        y_m: f64,
    },
    /// Removes the goal: the arm holds.
    ClearGoal {},
    /// The hand holds the bead and pulls it here. `lift` carries it over walls.
    Drag {
        x_m: f64,
        y_m: f64,
        #[serde(default)]
        #[ts(optional, as = "Option<bool>")]
        lift: bool,
    },
    /// The hand releases the bead.
    Release {},
    /// Selects sub-controller 2.
    SelectController {
        controller: ControllerName,
        /// Name of a program, with the controller `program`. Omitted: the one that was selected last.
        #[serde(default)]
        #[ts(optional)]
        program: Option<String>,
    },
    /// Replaces all parameters; one invalid value refuses all of them.
    Configure {
        parameters: Parameters,
    },
    /// Points the tool of the controller `you` to a place; it goes there, within the limits of every controller. With
    /// `approach` the hand also steers while sub-controller 1 is active.
    Steer {
        x_m: f64,
        y_m: f64,
        #[serde(default)]
        #[ts(optional, as = "Option<bool>")]
        approach: bool,
    },
    Run {},
    Pause {},
    /// Advances this many ticks of 8 ms while paused.
    Step {
        ticks: u32,
    },
    /// Speed in simulated seconds per second, 0.125 to 64.
    SetSpeed {
        factor: f64,
    },
    /// Back to the start, with this seed or the same one.
    Reset {
        #[serde(default)]
        #[ts(optional, type = "number")]
        seed: Option<u64>,
    },
    /// Loads a map. Omitted controller, seed and parameters keep their values. An omitted positioner is the map's,
    /// an omitted start is random; omitted goal and disturbances mean none. A seed may be
    /// text, because a JavaScript number cannot represent every seed.
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
    /// Begins a challenge, such as `easy-2026-11-26`: a new trial at real speed, paused. `reset` without a seed begins it again.
    PlayChallenge {
        #[ts(type = "string")]
        #[schema(value_type = String, example = "easy-2026-11-26")]
        challenge: ChallengeName,
    },
    /// Opens a test case: a new trial of its scenario, in which its inputs are applied at their ticks. `case` is the
    /// file as text, because a JavaScript number cannot represent every seed.
    OpenCase {
        case: String,
    },
    /// Sets up a trial of a recovery map: the moment, the controller, the noise and the disturbance. The present is kept as
    /// a run.
    OpenTry {
        /// Id of the recovery map.
        recovery: String,
        /// Number of the cell.
        cell: u32,
        controller: ControllerName,
        /// From 0.
        repeat: u32,
    },
    /// Applies a disturbance of the bead or of the tracker now.
    Disturb {
        disturbance: Disturbance,
    },
    /// Rewinds to an earlier tick that is still kept (see `state.oldest_tick`); pauses.
    Rewind {
        #[ts(type = "number")]
        tick: u64,
    },
    /// Returns to the end of a kept run (see `scene.kept_runs`); pauses. The present is kept.
    ReturnTo {
        run: u32,
    },
    /// Compares controllers: continues from the control step at or before a kept tick under each of these controllers (all
    /// if omitted), beside the session. The answer is a `comparison`; a new one replaces an older one.
    #[serde(rename = "fork")]
    #[ts(rename = "fork")]
    Compare {
        #[ts(type = "number")]
        tick: u64,
        #[serde(default)]
        #[ts(optional, as = "Option<Vec<ControllerName>>")]
        controllers: Vec<ControllerName>,
    },
    /// The button that lets a robot outside of Ferry follow its controllers is held (`ferry drive --enable-motion`). Must be
    /// repeated at least every 0.25 s. Without `press` it is released.
    DriveRobot {
        /// Another number for each press: one whose motion has ended moves nothing again.
        #[serde(default)]
        #[ts(optional)]
        press: Option<u32>,
    },
    /// Asks for the points of a training, past and new, in place of those of another one; `null` for no more. Every browser
    /// may.
    WatchTraining {
        /// Its id.
        training: Option<String>,
    },
    /// Requests control.
    TakeControl {},
    /// Ends the request of another browser. It can ask again after a minute.
    KeepControl {},
    ReleaseControl {},
}

impl ClientMessage {
    /// The command for the session; `None` for messages about the connection, the comparison or a robot, and for a test case,
    /// which must be read first.
    pub fn command(self) -> Option<Command> {
        let point = |[x, y]: [f64; 2]| Point2::new(x, y);
        Some(match self {
            Self::SetGoal { x_m, y_m } => Command::Input(Input::SetGoal { x_m, y_m }),
            Self::ClearGoal {} => Command::Input(Input::ClearGoal),
            Self::Drag { x_m, y_m, lift } => Command::Input(Input::Drag { x_m, y_m, lift }),
            Self::Release {} => Command::Input(Input::Release),
            Self::SelectController { controller, .. } => Command::Input(Input::SelectController(controller)),
            Self::Configure { parameters } => Command::Input(Input::Configure(Box::new(parameters))),
            Self::Steer { x_m, y_m, approach } => Command::Input(Input::Steer { x_m, y_m, approach }),
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
            Self::PlayChallenge { challenge } => Command::Play(challenge),
            Self::Disturb { disturbance } => Command::Input(Input::Disturb(disturbance)),
            Self::Rewind { tick } => Command::Rewind(tick),
            Self::ReturnTo { run } => Command::Return(run),
            Self::OpenCase { .. }
            | Self::OpenTry { .. }
            | Self::Compare { .. }
            | Self::DriveRobot { .. }
            | Self::WatchTraining { .. }
            | Self::TakeControl {}
            | Self::KeepControl {}
            | Self::ReleaseControl {} => {
                return None;
            }
        })
    }
}
