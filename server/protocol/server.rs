//! What the server sends.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::lumen::wave_m;
use super::{
    AttemptStanding, CatalogMessage, ComparisonMessage, DoneMessage, EventMessage, OverlayMessage, ProgramStanding,
    RefusedMessage, SeenMessage, SessionError, TrainingPointsMessage,
};
use crate::session::{EndFact, View};
use ferry_core::control::facts::{RefusalFact, TroubleFact};
use ferry_core::control::switching::Reason;
use ferry_core::facts::Told;
use ferry_core::geometry::{Point2, Polygon, Rect};
use ferry_core::plant::{BEAD_RADIUS_M, PositionerKind};
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::{ControllerName, Parameters, Scenario};
use ferry_core::schema::{Numbers2, Numbers3, Numbers6};
use ferry_core::session::{KeptRunSummary, OpenedCase, Scenery};
use ferry_core::trial::{PhaseFact, RecordingFact};
use ferry_ur::{Standing as RobotStanding, TwinStanding};

/// Directions in which the scene gives the capture distances.
const CAPTURE_DIRECTIONS: u32 = 72;

/// Longest description of a test case that is sent, in characters.
const ABOUT_CHARACTERS: usize = 200;

/// Role of a browser.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// May send commands.
    Operator,
    /// Receives all messages and may not send commands.
    Viewer,
}

/// What the server sends as text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ServerMessage {
    /// First message of a connection; sent again when the role changes.
    Hello(Hello),
    /// The static part of a session: sent at the start and after each change.
    Scene(Box<SceneMessage>),
    /// The moving part: at most 60 messages per second.
    State(Box<StateMessage>),
    Event(EventMessage),
    /// The controller's layers for the last camera frame.
    Overlay(Box<OverlayMessage>),
    /// The obstacle map, when it changed.
    Seen(SeenMessage),
    /// Progress of a comparison.
    Comparison(Box<ComparisonMessage>),
    /// A list of the server: each once after `hello` and `scene`, and again when it has changed.
    Catalog(CatalogMessage),
    /// Points of the training that `watch_training` names: all so far, then the new ones.
    TrainingPoints(TrainingPointsMessage),
    /// A message with an `id` was carried out. The state, the scene and the events that show it were sent before; the answer
    /// to `step` comes at its end, those to `fork` and `take_control` when they are accepted.
    Done(DoneMessage),
    /// A message with an `id` was refused; nothing changed.
    Refused(RefusedMessage),
    /// A message without an `id` was refused; nothing changed.
    Error(SessionError),
}

/// See `ServerMessage::Hello`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Hello {
    /// `PROTOCOL_VERSION`.
    pub protocol: u32,
    /// Largest message that this browser may send.
    pub message_bytes: u32,
    /// Name of the session.
    pub session: String,
    /// Key of this browser's seat, which no other browser gets. An attempt at a challenge can be put on the board with the
    /// key of the seat that began it. Connect again with `?seat=`.
    pub seat: String,
    /// Ferry's version.
    pub version: String,
    /// This browser's role.
    pub role: Role,
    /// Number of the operator's lease; it increases when another browser becomes the operator. A command may carry it
    /// as `epoch`, and is refused if it is not the current one.
    #[ts(type = "number")]
    pub epoch: u64,
    /// Whether the session has an operator, or one whose page may be loading again.
    pub operator_present: bool,
    /// Whether this browser is the operator and another one requests control.
    pub asked: bool,
    /// Whether this browser requests control.
    pub asks: bool,
    /// Requests of other browsers that are answered before that of this one.
    pub ahead: u32,
    /// During a request: seconds until the operator loses control if it does nothing. Each of its commands begins them again.
    pub answer_within_s: Option<f64>,
    /// Graphics adapter that renders the camera.
    pub adapter: String,
    /// When this server opened the session. It changes when the server was restarted or the session opened again.
    pub opened: String,
    /// Time of the trial at which the session went on from what was saved; `null` if it began with its scenario.
    pub resumed_s: Option<f64>,
}

/// See `ServerMessage::Scene`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct SceneMessage {
    /// Name of the map.
    pub map: String,
    /// The trial's scenario; controller, goal and parameters may have changed since.
    pub scenario: Scenario,
    /// The positioner of this trial.
    pub positioner: PositionerKind,
    /// Controllers that `select_controller` accepts.
    pub controllers: Vec<ControllerName>,
    pub workspace: Rect,
    /// Walls inside the workspace, 5 mm high.
    pub walls: Vec<Polygon>,
    #[ts(type = "number")]
    pub seed: u64,
    pub parameters: Parameters,
    pub defaults: Parameters,
    pub bead_radius_m: f64,
    /// Corners of the part of the table that the camera sees, relative to the tool.
    #[schema(value_type = Vec<Numbers2>)]
    pub camera_sees_m: Vec<[f64; 2]>,
    /// Kept runs, oldest first: what rewinds, resets and other scenarios have left behind.
    #[serde(default)]
    pub kept_runs: Vec<KeptRun>,
    /// The test case that was opened for this trial.
    #[serde(default)]
    pub case: Option<CaseSummary>,
    /// Name of the challenge that is being played.
    #[serde(default)]
    pub challenge: Option<String>,
    /// Number of the trial; each new trial has another one.
    #[ts(type = "number")]
    pub trial: u64,
    /// Distances from the tool at which the magnet's pull beats friction, nearest and farthest, for the
    /// current parameters, in 72 directions from +x counter-clockwise; `null` if it never does, and no
    /// farthest distance if it always does.
    pub capture_m: Vec<Option<(f64, Option<f64>)>>,
    /// Seconds per tick.
    pub tick_s: f64,
}

/// A run that `return_to` accepts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct KeptRun {
    pub number: u32,
    /// Name of its map.
    pub map: String,
    #[ts(type = "number")]
    pub seed: u64,
    /// Sub-controller 2 at its end.
    pub controller: ControllerName,
    /// Time at its end.
    pub sim_time_s: f64,
    pub deliveries: u32,
}

impl From<&KeptRunSummary> for KeptRun {
    fn from(summary: &KeptRunSummary) -> Self {
        Self {
            number: summary.number,
            map: summary.map.clone(),
            seed: summary.seed,
            controller: summary.controller,
            sim_time_s: summary.tick as f64 * SERVO_PERIOD_S,
            deliveries: summary.deliveries,
        }
    }
}

/// An opened test case: its inputs come at their ticks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct CaseSummary {
    /// Description, possibly shortened.
    pub about: String,
    /// Number of inputs.
    pub inputs: usize,
    /// Tick of the last input; 0 without inputs.
    #[ts(type = "number")]
    pub last_tick: u64,
    /// Expected deliveries since the start, up to `by_tick`; omitted if the case expects nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub deliveries: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional, type = "number")]
    pub by_tick: Option<u64>,
}

impl From<&OpenedCase> for CaseSummary {
    fn from(case: &OpenedCase) -> Self {
        Self {
            about: case.about.chars().take(ABOUT_CHARACTERS).collect(),
            inputs: case.inputs().len(),
            last_tick: case.inputs().last().map_or(0, |timed| timed.tick),
            deliveries: case.expect.map(|expect| expect.deliveries),
            by_tick: case.expect.map(|expect| expect.by_tick),
        }
    }
}

/// See `ServerMessage::State`.
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
    /// Whether the session is running.
    pub running: bool,
    /// Requested speed, simulated seconds per second.
    pub speed_target: f64,
    /// Achieved speed, simulated seconds per second.
    pub speed_achieved: f64,
    /// Maximum delay of a tick in the last half second, wall-clock milliseconds.
    pub lateness_ms: f64,
    /// How often the session fell behind so far that it skipped the lost time.
    #[ts(type = "number")]
    pub missed_deadlines: u64,
    /// Tool point: the middle of the block's lower face.
    #[schema(value_type = Numbers3)]
    pub tool_m: [f64; 3],
    /// True centre of the bead.
    #[schema(value_type = Numbers3)]
    pub bead_m: [f64; 3],
    /// Position of the bead from the tracker.
    #[schema(value_type = Numbers2)]
    pub bead_tracked_m: [f64; 2],
    /// Goal, if one is set.
    #[schema(value_type = Option<Numbers3>)]
    pub goal_m: Option<[f64; 3]>,
    /// Target of the hand, while it holds the bead.
    #[schema(value_type = Option<Numbers2>)]
    pub hand_m: Option<[f64; 2]>,
    /// Force of the hand's spring on the bead; 0 if not held.
    pub hand_force_n: f64,
    /// Where a person points the tool, with the controller `you`.
    #[schema(value_type = Option<Numbers2>)]
    pub steer_m: Option<[f64; 2]>,
    /// Joint angles; `null` for the planar stage.
    #[schema(value_type = Option<Numbers6>)]
    pub joints_rad: Option<[f64; 6]>,
    /// Active sub-controller, 1 or 2.
    pub mode: u8,
    /// Why it is active.
    pub reason: Told<Reason>,
    /// Why the arm holds, if a step was refused.
    pub refusal: Option<Told<RefusalFact>>,
    /// Why sub-controller 2 makes no progress, if it makes none.
    #[serde(default)]
    pub trouble: Option<Told<TroubleFact>>,
    /// Sub-controller 2 in use.
    pub controller: ControllerName,
    /// What the trial does now.
    pub phase: Told<PhaseFact>,
    /// Tool minus bead, x.
    pub tracking_error_x_m: f64,
    /// Tool minus bead, y.
    pub tracking_error_y_m: f64,
    /// Norm of the tracking error: the true distance between tool and bead in the plane.
    pub tracking_error_m: f64,
    /// Distance between the tool and the tracked bead in the plane: e of the switching law, as it would be now.
    #[serde(default)]
    pub tracked_error_m: f64,
    /// Distance from the tool to the goal.
    pub goal_distance_m: Option<f64>,
    /// Horizontal pull of the magnet on the bead.
    pub pull_n: f64,
    /// Vertical pull in units of the bead's weight; the bead lifts off at 1.
    pub lift_ratio: f64,
    /// How far walls close in along the lumen, one number per knot of `Lumen`; omitted while they are at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub wave_m: Option<Vec<f64>>,
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
    /// The attempt at the challenge that is being played.
    #[serde(default)]
    pub attempt: Option<AttemptStanding>,
    /// The program that was selected last.
    pub program: Option<ProgramStanding>,
    /// The clients of the robot server; `null` if this session has none.
    pub robot: Option<RobotStanding>,
    /// The robot outside of Ferry that the arm mirrors; `null` without one.
    #[serde(default)]
    pub twin: Option<TwinStanding>,
    /// Hash of the plant's state, in hex.
    pub world_hash: String,
    /// Whether everything is recorded, or why not.
    pub recording: Told<RecordingFact>,
    /// Why the session ended, if it has.
    pub ended: Option<Told<EndFact>>,
}

impl From<&Scenery> for SceneMessage {
    fn from(scenery: &Scenery) -> Self {
        let map = &scenery.arena.map;
        let p = &scenery.parameters;
        Self {
            map: map.name().to_owned(),
            scenario: scenery.scenario.clone(),
            positioner: scenery.positioner,
            controllers: ControllerName::SELECTABLE.to_vec(),
            workspace: *map.workspace(),
            walls: map.walls().to_vec(),
            seed: scenery.scenario.seed,
            parameters: p.clone(),
            defaults: Parameters::default(),
            bead_radius_m: BEAD_RADIUS_M,
            camera_sees_m: camera_sees_m(p),
            kept_runs: scenery.kept_runs.iter().map(KeptRun::from).collect(),
            case: scenery.case.as_deref().map(CaseSummary::from),
            challenge: scenery.challenge.as_ref().map(|challenge| challenge.name.to_string()),
            trial: scenery.trial,
            capture_m: p.plant().capture_m(p.tool_height_m, CAPTURE_DIRECTIONS),
            tick_s: SERVO_PERIOD_S,
        }
    }
}

/// Corners of the visible part of the table, relative to the tool.
fn camera_sees_m(p: &Parameters) -> Vec<[f64; 2]> {
    let corners = p.camera_mount().over(Point2::origin(), 0.0).table_corners_m();
    corners.into_iter().flatten().map(|corner| corner.coords.into()).collect()
}

impl From<&View> for StateMessage {
    fn from(view: &View) -> Self {
        let m = &view.moment;
        let error = m.tracking_error_m();
        Self {
            tick: m.tick,
            sim_time_s: m.sim_time_s(),
            oldest_tick: view.rewind_ticks.0,
            newest_tick: view.rewind_ticks.1,
            running: view.running,
            speed_target: view.speed_target,
            speed_achieved: view.speed_achieved,
            lateness_ms: view.lateness.as_secs_f64() * 1e3,
            missed_deadlines: view.missed_deadlines,
            tool_m: m.tool_m.coords.into(),
            bead_m: m.bead_m.coords.into(),
            bead_tracked_m: m.tracked_m.coords.into(),
            goal_m: m.goal_m.map(|goal| [goal.x, goal.y, 0.0]),
            hand_m: m.hand.map(|hand| hand.target_m.coords.into()),
            hand_force_n: m.hand_force_n,
            steer_m: m.steering.map(|steering| steering.target_m.coords.into()),
            joints_rad: m.positioner.joints_rad(),
            mode: m.switching.mode.index(),
            reason: m.reason(),
            refusal: m.refusal.as_ref().map(Told::of),
            trouble: m.trouble.as_ref().map(Told::of),
            controller: m.controller,
            phase: Told::of(&m.phase),
            tracking_error_x_m: error.x,
            tracking_error_y_m: error.y,
            tracking_error_m: error.norm(),
            tracked_error_m: (m.tool_m.xy() - m.tracked_m).norm(),
            goal_distance_m: m.goal_m.map(|goal| (m.tool_m.xy() - goal).norm()),
            pull_n: m.load.lateral_n.norm(),
            lift_ratio: m.load.lift_ratio(),
            wave_m: wave_m(&view.scenery.arena, m),
            leg_steps: m.counters.leg_steps,
            steps: m.counters.steps,
            switches: m.counters.switches,
            deliveries: m.counters.deliveries,
            disturbances: m.counters.disturbances,
            attempt: view.attempt.as_ref().map(AttemptStanding::from),
            program: view.program.as_deref().map(ProgramStanding::from),
            robot: view.robot.clone(),
            twin: view.twin.clone(),
            world_hash: format!("{:016x}", view.world_hash),
            recording: view.recording.clone().into(),
            ended: view.ended.clone().map(Told::from),
        }
    }
}
