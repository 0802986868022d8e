//! To and from `session`'s types.

use super::{
    BlocksLayer, ClientMessage, ErrorMessage, EventMessage, FlowField, JudgementLayer, OverlayMessage, PlanLayer,
    SceneMessage, SeenMessage, SensedObstacle, StateMessage, ValueCell, ValueMap,
};
use crate::control::transport::Carrier;
use crate::control::transport::attractor::Attractor;
use crate::control::transport::errt::{Errt, Tree};
use crate::control::transport::rl::Rl;
use crate::geometry::{Point2, Vector2};
use crate::image::CameraFrame;
use crate::learn::{Atlas, AtlasError};
use crate::magnetics::force;
use crate::perception::{CellState, ObstacleMap, PixelRect};
use crate::plant::BEAD_RADIUS_M;
use crate::policy::Judgement;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{ControllerName, Parameters, RlPolicy};
use crate::session::{Command, CommandError, Scenery, View};
use crate::trial::{Arena, Event, Input, InputError, Motion, Phase, Sight, TrialError};
use rayon::prelude::*;

/// Instead of the switching law's reason, which no longer matters.
const LIFTED_OFF: &str = "lift-off: the bead hangs on the magnet; take it off by hand, or reset";
/// Edges of a tree that are shown at most; more could not be told apart.
pub const MOST_EDGES: usize = 4000;
/// Directions in which the scene gives the capture distances.
const CAPTURE_DIRECTIONS: u32 = 72;

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
            } => Command::Load {
                map,
                controller,
                positioner,
                seed,
                start_m: start_m.map(point),
                goal_m: goal_m.map(point),
                parameters: parameters.map(Box::new),
                disturbances,
                script,
            },
            Self::Disturb { disturbance } => Command::Input(Input::Disturb(disturbance)),
            Self::Rewind { tick } => Command::Rewind(tick),
            Self::Fork { .. } | Self::TakeControl {} | Self::ReleaseControl {} => return None,
        })
    }
}

impl From<&CommandError> for ErrorMessage {
    fn from(error: &CommandError) -> Self {
        let (code, field) = match error {
            CommandError::Input(error) | CommandError::Trial(TrialError::Input(error)) => of_input(error),
            CommandError::Map(_) | CommandError::Trial(TrialError::Map(_) | TrialError::Random(_)) => {
                ("map_refused", Some("map"))
            }
            CommandError::Trial(TrialError::Parameter(error)) => ("parameter_out_of_range", Some(error.field)),
            CommandError::Trial(TrialError::Script { .. } | TrialError::LongScript { .. }) => {
                ("bad_script", Some("script"))
            }
            CommandError::Trial(_) => ("trial_failed", None),
            CommandError::Range { field, .. } => ("out_of_range", Some(*field)),
            CommandError::NoGoal { .. } => ("no_goal", Some("tick")),
            CommandError::NothingCarried { .. } => ("nothing_carried", Some("tick")),
            CommandError::Forgotten => ("forgotten", None),
            CommandError::Busy => ("busy", None),
            CommandError::Unanswered => ("unanswered", None),
            CommandError::Ended => ("ended", None),
        };
        Self { code: code.to_owned(), message: error.to_string(), field: field.map(str::to_owned) }
    }
}

fn of_input(error: &InputError) -> (&'static str, Option<&'static str>) {
    (error.code(), Some(error.field()))
}

impl From<&Event> for EventMessage {
    fn from(event: &Event) -> Self {
        Self {
            tick: event.tick,
            sim_time_s: event.tick as f64 * SERVO_PERIOD_S,
            kind: event.kind,
            text: event.text.clone(),
        }
    }
}

impl From<&Scenery> for SceneMessage {
    fn from(scenery: &Scenery) -> Self {
        let map = &scenery.arena.map;
        let p = &scenery.parameters;
        Self {
            map: map.name().to_owned(),
            maps: scenery.known_maps.names(),
            scenario: scenery.scenario.clone(),
            positioner: scenery.positioner,
            controllers: ControllerName::ALL.to_vec(),
            workspace: *map.workspace(),
            walls: map.walls().to_vec(),
            seed: scenery.scenario.seed,
            parameters: p.clone(),
            defaults: Parameters::default(),
            bead_radius_m: BEAD_RADIUS_M,
            camera_sees_m: camera_sees_m(p),
            trial: scenery.trial,
            capture_m: capture_m(p),
            tick_s: SERVO_PERIOD_S,
        }
    }
}

/// Corners of the table seen, from the tool.
fn camera_sees_m(p: &Parameters) -> Vec<[f64; 2]> {
    let corners = p.camera_mount().over(Point2::origin()).table_corners_m();
    corners.into_iter().flatten().map(|corner| corner.coords.into()).collect()
}

fn capture_m(p: &Parameters) -> Vec<Option<(f64, Option<f64>)>> {
    let breakaway = p.plant().breakaway();
    (0..CAPTURE_DIRECTIONS)
        .map(|k| {
            let direction_rad = f64::from(k) * std::f64::consts::TAU / f64::from(CAPTURE_DIRECTIONS);
            force::capture_interval_m(p.block_orientation, p.tool_height_m, breakaway, direction_rad)
                .map(|(near_m, far_m)| (near_m, (far_m < force::FARTHEST_M).then_some(far_m)))
        })
        .collect()
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
            joints_rad: m.positioner.joints_rad(),
            mode: m.switching.mode.index(),
            reason: if m.phase == Phase::LiftedOff { LIFTED_OFF.to_owned() } else { m.switching.reason() },
            refusal: m.refusal.clone(),
            controller: m.controller,
            phase: m.phase.to_string(),
            tracking_error_x_m: error.x,
            tracking_error_y_m: error.y,
            tracking_error_m: error.norm(),
            goal_distance_m: m.goal_m.map(|goal| (m.tool_m.xy() - goal).norm()),
            pull_n: m.load.lateral_n.norm(),
            lift_ratio: m.load.lift_ratio(),
            leg_steps: m.counters.leg_steps,
            steps: m.counters.steps,
            switches: m.counters.switches,
            deliveries: m.counters.deliveries,
            disturbances: m.counters.disturbances,
            world_hash: format!("{:016x}", view.world_hash),
            recording: view.recording.clone(),
            ended: view.ended.clone(),
        }
    }
}

impl From<&View> for OverlayMessage {
    fn from(view: &View) -> Self {
        let (tick, sight) = &*view.sight;
        let Scenery { arena, parameters, .. } = &*view.scenery;
        Self::of(*tick, sight, view.moment.motion, arena, parameters.rl_policy)
    }
}

impl OverlayMessage {
    /// Of what was seen at a tick, and what the arm then did.
    pub fn of(tick: u64, sight: &Sight, motion: Motion, arena: &Arena, policy: RlPolicy) -> Self {
        let sensed = match &sight.carrier {
            Carrier::Attractor(attractor) => attractor.sensed(),
            Carrier::Rl(_) | Carrier::Errt(_) => &[],
        };
        let obstacles = sensed.iter().map(|o| SensedObstacle {
            center_m: o.center_m.coords.into(),
            half_size_m: o.half_size_m.into(),
            boundary_m: o.half_axes_m.into(),
        });
        Self {
            tick,
            obstacles: obstacles.collect(),
            center_mean: sight.percept.center_mean,
            patch: sight.percept.patch(sight.tool_m),
            obstacle: sight.percept.obstacle(),
            target_m: match motion {
                Motion::Segment(step) => Some(step.target_m.coords.into()),
                Motion::Hold | Motion::Track => None,
            },
            picture_from_table: picture_from_table(&sight.frame),
            blocks: BlocksLayer::from(sight),
            plan: match &sight.carrier {
                Carrier::Errt(errt) => Some(PlanLayer::of(errt, &sight.known)),
                Carrier::Rl(_) | Carrier::Attractor(_) => None,
            },
            judgement: match &sight.carrier {
                Carrier::Rl(rl) => JudgementLayer::of(rl, arena, policy),
                Carrier::Errt(_) | Carrier::Attractor(_) => None,
            },
        }
    }
}

/// The homography of a pinhole: what [`crate::image::Pinhole::image_from_point`] does to points of the table.
fn picture_from_table(frame: &CameraFrame) -> [[f64; 3]; 3] {
    let [right, up, forward] = frame.pinhole.axes();
    let half_px = 0.5 * f64::from(frame.picture.width_px);
    let scale_px = half_px / frame.pinhole.tangent();
    let center = frame.pinhole.center_m().coords;
    let rows = [forward * half_px + right * scale_px, forward * half_px - up * scale_px, forward];
    rows.map(|axis| [axis.x, axis.y, -axis.dot(&center)])
}

impl From<&Sight> for BlocksLayer {
    fn from(sight: &Sight) -> Self {
        let tree = sight.blocks();
        let calibration = &sight.percept.calibration;
        let block = |rect: &PixelRect| [rect.column_px, rect.row_px, rect.width_px, rect.height_px].map(|px| px as u32);
        Self {
            origin_m: calibration.table_from_image(0.0, 0.0).coords.into(),
            pixel_m: calibration.m_per_px,
            dark: tree.dark.iter().map(block).collect(),
            free: tree.free.iter().map(block).collect(),
            rectangles: tree.partition().rectangles.iter().map(|cells| block(&tree.pixels(cells))).collect(),
        }
    }
}

impl FlowField {
    /// Of a session's newest view.
    pub fn of(view: &View, spacing_m: f64) -> Self {
        let known = &view.sight.1.known;
        let area = known.workspace();
        let size = area.size_m();
        let [columns, rows] = [size.x, size.y].map(|side_m| (side_m / spacing_m).floor() as usize + 1);
        // In the middle of what is left over.
        let margin = (size - Vector2::new((columns - 1) as f64, (rows - 1) as f64) * spacing_m) * 0.5;
        let origin = Point2::new(area.x_min_m, area.y_min_m) + margin;
        let goal = view.moment.goal_m;
        let parameters = &view.scenery.parameters;
        let velocity = |index: usize| {
            let place = origin + Vector2::new((index % columns) as f64, (index / columns) as f64) * spacing_m;
            Attractor::flow_at(place, goal?, known, parameters).map(Into::into)
        };
        let places = if goal.is_some() { 0..columns * rows } else { 0..0 };
        Self {
            columns: columns as u32,
            rows: rows as u32,
            origin_m: origin.coords.into(),
            spacing_m,
            velocity_m_s: places.into_par_iter().map(velocity).collect(),
        }
    }
}

impl JudgementLayer {
    /// Of a policy in a session; `None` before the first image that it judged.
    pub fn of(rl: &Rl, arena: &Arena, policy: RlPolicy) -> Option<Self> {
        let (judgement, taken) = rl.judged()?;
        let policy = arena.policy(policy).ok()?;
        Some(Self {
            quantiles: judgement.quantiles.clone(),
            values: judgement.values(),
            taken: taken.index() as u8,
            trained_on: policy.manifest().maps.clone(),
        })
    }
}

impl ValueMap {
    /// On the way to a goal.
    pub fn of(atlas: &Atlas, goal_m: Point2<f64>) -> Result<Self, AtlasError> {
        let cell = |(center_m, judgement): (Point2<f64>, Judgement)| {
            let best = judgement.ranking()[0].index();
            ValueCell { center_m: center_m.coords.into(), value: judgement.values()[best], action: best as u8 }
        };
        Ok(Self {
            spacing_m: atlas.spacing_m(),
            cells: atlas.judge(goal_m)?.into_iter().map(cell).collect(),
            trained_on: atlas.policy().manifest().maps.clone(),
        })
    }
}

impl PlanLayer {
    /// Of a planner around what is known.
    pub fn of(errt: &Errt, known: &ObstacleMap) -> Self {
        let (planner, way) = (errt.planner(), errt.way());
        let edges = planner.tree().into_iter().flat_map(Tree::edges).take(MOST_EDGES);
        Self {
            tree: edges.map(|[from, to]| [from.x, from.y, to.x, to.y]).collect(),
            way: way.map(|way| way.points.iter().map(|point| point.coords.into()).collect()).unwrap_or_default(),
            clearance_m: way.map(|way| way.clearance.asked_m),
            plans: errt.plans(),
            attempts: planner.attempts() as u32,
            beta: planner.beta(),
            obstacles: known.rectangles(),
        }
    }
}

impl SeenMessage {
    /// What is known, as message `number`.
    pub fn of(known: &ObstacleMap, number: u64) -> Self {
        let (columns, rows) = known.shape();
        let state = |state| match state {
            CellState::Unknown => 0,
            CellState::Free => 1,
            CellState::Obstacle => 2,
        };
        Self {
            number,
            workspace: *known.workspace(),
            columns: columns as u32,
            rows: rows as u32,
            runs: known.runs().into_iter().map(|(cell, count)| (state(cell), count)).collect(),
        }
    }
}
