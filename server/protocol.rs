//! Every message of the WebSocket, once, and its translation to and from `session`'s types; and what else
//! the page asks for.
//!
//! Text frames are JSON objects tagged by `type`. Binary frames carry pictures: one byte
//! [`BINARY_CAMERA_JPEG`] or [`BINARY_OBSERVATION`], three bytes of zero, the tick as u32
//! little-endian, then the payload.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::geometry::schema::{Numbers2, Numbers3, Numbers6, Rows3};
use crate::geometry::{Polygon, Rect};
use crate::plant::PositionerKind;
use crate::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted};
use crate::trial::EventKind;

mod convert;
mod evaluations;
mod layers;
mod parameters;
mod parse;
mod past;
mod recordings;
mod seed;
#[cfg(test)]
mod typescript;
mod workspace;

pub use evaluations::{
    EvaluationCell, EvaluationFailure, EvaluationReport, EvaluationStage, EvaluationSummary, Evaluations,
};
pub use layers::{
    BlocksLayer, FLOW_SPACING_M, FlowField, FlowQuery, JudgementLayer, PixelBlock, PlanLayer, SeenMessage, ValueCell,
    ValueMap, ValueQuery,
};
pub use past::{Branch, ComparisonMessage, MomentMessage};
pub use recordings::{RecordingFile, RecordingList};
pub use workspace::{WorkspaceMap, WorkspaceQuery};

/// Raised when an old page could misread the server.
pub const PROTOCOL_VERSION: u32 = 6;
/// Binary frame: the camera image, a JPEG file of 480×480.
pub const BINARY_CAMERA_JPEG: u8 = 1;
/// Binary frame: the observation, 2×84×84 bytes, row-major, channel 0 first.
pub const BINARY_OBSERVATION: u8 = 2;

/// What a browser may send. Fields are named and measured as everywhere: metres in `base`.
#[allow(missing_docs)]
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
    Fork {
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

/// Who this browser is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// May send commands.
    Operator,
    /// Watches.
    Viewer,
}

/// What the server sends as text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ServerMessage {
    /// First message of a connection; sent again when the role changes.
    Hello(Hello),
    /// What stands still: sent at the start and after each change.
    Scene(Box<SceneMessage>),
    /// What moves: at most 60 a second.
    State(Box<StateMessage>),
    /// Something happened once.
    Event(EventMessage),
    /// What the controller made of the last camera frame.
    Overlay(Box<OverlayMessage>),
    /// What the camera has shown up to now, when that changed.
    Seen(SeenMessage),
    /// How a fork goes on.
    Comparison(Box<ComparisonMessage>),
    /// A message was refused; nothing changed.
    Error(ErrorMessage),
}

/// See [`ServerMessage::Hello`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Hello {
    /// [`PROTOCOL_VERSION`].
    pub protocol: u32,
    /// Name of the session.
    pub session: String,
    /// Ferry's version.
    pub version: String,
    /// This browser's role.
    pub role: Role,
    /// Number of the operator's lease; it rises when control passes on. A command may carry it as `epoch`, and is
    /// refused when it is no longer that.
    #[ts(type = "number")]
    pub epoch: u64,
    /// Whether anybody is the operator.
    pub operator_present: bool,
    /// Whether this browser is the operator and another one asks it to make way.
    pub asked: bool,
    /// Graphics adapter that renders the camera.
    pub adapter: String,
}

/// See [`ServerMessage::Scene`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct SceneMessage {
    /// Name of the map.
    pub map: String,
    /// Maps that `load_scenario` knows.
    pub maps: Vec<String>,
    /// How the trial was set up; controller, goal and parameters may have changed since.
    pub scenario: Scenario,
    /// What carries the magnet in this trial.
    pub positioner: PositionerKind,
    /// Controllers that `select_controller` knows.
    pub controllers: Vec<ControllerName>,
    /// The workspace.
    pub workspace: Rect,
    /// Walls inside the workspace, 5 mm high.
    pub walls: Vec<Polygon>,
    /// Seed in force.
    #[ts(type = "number")]
    pub seed: u64,
    /// Parameters in force.
    pub parameters: Parameters,
    /// Their defaults.
    pub defaults: Parameters,
    /// Radius of the bead.
    pub bead_radius_m: f64,
    /// Corners of the part of the table that the camera sees, from the tool.
    #[schema(value_type = Vec<Numbers2>)]
    pub camera_sees_m: Vec<[f64; 2]>,
    /// Number of the trial: another one when a trial was set up anew.
    #[ts(type = "number")]
    pub trial: u64,
    /// Distances from the tool at which the magnet's pull beats friction, nearest and farthest, for the
    /// parameters in force, in 72 directions from +x counter-clockwise; none where it never does, and no
    /// farthest where it always does.
    pub capture_m: Vec<Option<(f64, Option<f64>)>>,
    /// Seconds a tick.
    pub tick_s: f64,
}

/// See [`ServerMessage::State`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct StateMessage {
    /// Ticks since the start of the trial.
    #[ts(type = "number")]
    pub tick: u64,
    /// `tick` in seconds.
    pub sim_time_s: f64,
    /// Earliest tick that `rewind` reaches.
    #[ts(type = "number")]
    pub oldest_tick: u64,
    /// Latest tick that `rewind` reaches.
    #[ts(type = "number")]
    pub newest_tick: u64,
    /// Whether time runs.
    pub running: bool,
    /// Asked simulated seconds a second.
    pub speed_target: f64,
    /// Achieved simulated seconds a second.
    pub speed_achieved: f64,
    /// How late the latest tick of the last half second came, in milliseconds of the clock.
    pub lateness_ms: f64,
    /// How often the session fell so far behind that lost time was let go, since it began.
    #[ts(type = "number")]
    pub missed_deadlines: u64,
    /// Tool point: the middle of the block's lower face.
    #[schema(value_type = Numbers3)]
    pub tool_m: [f64; 3],
    /// Centre of the bead, the truth.
    #[schema(value_type = Numbers3)]
    pub bead_m: [f64; 3],
    /// The bead as the optical tracker gives it.
    #[schema(value_type = Numbers2)]
    pub bead_tracked_m: [f64; 2],
    /// Goal, if one is set.
    #[schema(value_type = Option<Numbers3>)]
    pub goal_m: Option<[f64; 3]>,
    /// Where the hand wants the bead, while it holds it.
    #[schema(value_type = Option<Numbers2>)]
    pub hand_m: Option<[f64; 2]>,
    /// Force of the hand's spring on the bead (0 when not held).
    pub hand_force_n: f64,
    /// Joint angles; none on the planar stage, which has no arm.
    #[schema(value_type = Option<Numbers6>)]
    pub joints_rad: Option<[f64; 6]>,
    /// Active sub-controller, 1 or 2.
    pub mode: u8,
    /// Why it is active, one plain sentence.
    pub reason: String,
    /// Why the arm holds, if a step was refused.
    pub refusal: Option<String>,
    /// Sub-controller 2 in use.
    pub controller: ControllerName,
    /// What the arm does in words: `holding`, `approaching`, `transporting`, `settling`, `delivered`, `lifted off`, `stopped`.
    pub phase: String,
    /// Tool minus bead, x.
    pub tracking_error_x_m: f64,
    /// Tool minus bead, y.
    pub tracking_error_y_m: f64,
    /// Its norm: the `e` of the switching law.
    pub tracking_error_m: f64,
    /// Distance from the tool to the goal.
    pub goal_distance_m: Option<f64>,
    /// Horizontal pull of the magnet on the bead.
    pub pull_n: f64,
    /// Vertical pull in units of the bead's weight; 1 is lift-off.
    pub lift_ratio: f64,
    /// Control steps of the current transport leg.
    pub leg_steps: u32,
    /// Control steps of the trial.
    pub steps: u32,
    /// Switches of the trial.
    pub switches: u32,
    /// Goals delivered since the reset.
    pub deliveries: u32,
    /// Disturbances by hand or script since the reset.
    pub disturbances: u32,
    /// Hash of the plant's state, in hex.
    pub world_hash: String,
    /// `recording`, or why this session is not recorded.
    pub recording: String,
    /// Why the session ended, if it has.
    pub ended: Option<String>,
}

/// See [`ServerMessage::Event`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct EventMessage {
    /// When.
    #[ts(type = "number")]
    pub tick: u64,
    /// When, in seconds.
    pub sim_time_s: f64,
    /// What.
    pub kind: EventKind,
    /// One plain sentence.
    pub text: String,
}

/// An obstacle as the attractor sees it: a superellipse of exponent 4.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct SensedObstacle {
    /// Centre.
    #[schema(value_type = Numbers2)]
    pub center_m: [f64; 2],
    /// Half sides of the fitted rectangle.
    #[schema(value_type = Numbers2)]
    pub half_size_m: [f64; 2],
    /// Half sides of the superellipse with its safety margin.
    #[schema(value_type = Numbers2)]
    pub boundary_m: [f64; 2],
}

/// See [`ServerMessage::Overlay`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct OverlayMessage {
    /// When the camera frame was taken.
    #[ts(type = "number")]
    pub tick: u64,
    /// Obstacles sensed in it.
    pub obstacles: Vec<SensedObstacle>,
    /// Mean of the 15×15 pixels around the tool, 0 to 255.
    pub center_mean: f64,
    /// Those pixels, on the table.
    pub patch: Rect,
    /// Obstacle test: `center_mean` < 150.
    pub obstacle: bool,
    /// Next tool target.
    #[schema(value_type = Option<Numbers2>)]
    pub target_m: Option<[f64; 2]>,
    /// Takes (x, y, 1) on the table, in metres, to (column, row, 1) times a factor in the camera's picture.
    #[schema(value_type = Rows3)]
    pub picture_from_table: [[f64; 3]; 3],
    /// What the image is made of.
    pub blocks: BlocksLayer,
    /// What ERRT plans, while it is sub-controller 2.
    pub plan: Option<PlanLayer>,
    /// What the policy thinks, while it is sub-controller 2.
    pub judgement: Option<JudgementLayer>,
}

/// See [`ServerMessage::Error`]; the same fields stand in an HTTP problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct ErrorMessage {
    /// For programs, such as `in_wall`.
    pub code: String,
    /// For people: names the field and the value.
    pub message: String,
    /// The field at fault.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub field: Option<String>,
}
