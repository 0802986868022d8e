//! Data of the page's layers: camera, ERRT's plan, values, attractor flow.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::session::View;
use ferry_core::control::transport::attractor::Attractor;
use ferry_core::control::transport::attractor::Flow;
use ferry_core::control::transport::errt::Errt;
use ferry_core::control::transport::rl::{Decision, Rl};
use ferry_core::geometry::{Point2, Rect};
use ferry_core::perception::{CellState, ObstacleMap, PixelRect};
use ferry_core::policy::{Judgement, Policy};
use ferry_core::scenario::RlPolicy;
use ferry_core::schema::{Lists4, Numbers2, Numbers4, Rows3, Wholes4};
use ferry_core::session::Scenery;
use ferry_core::trial::{Arena, Motion, Sight};

/// An obstacle as sensed for the attractor: a superellipse of exponent 4.
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

/// See `ServerMessage::Overlay`.
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
    /// Homography from (x, y, 1) on the table, in metres, to (column, row, 1) times a factor in the camera's image.
    #[schema(value_type = Rows3)]
    pub picture_from_table: [[f64; 3]; 3],
    /// Blocks of the image.
    pub blocks: BlocksLayer,
    /// ERRT's plan, while it is sub-controller 2.
    pub plan: Option<PlanLayer>,
    /// The policy's quantiles, while it is sub-controller 2.
    pub judgement: Option<JudgementLayer>,
}

/// ERRT's last search and the path that is followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct PlanLayer {
    /// Both ends of every edge, x, y, x, y in metres; 4000 at most.
    #[schema(value_type = Vec<Numbers4>)]
    pub tree: Vec<[f64; 4]>,
    /// Corners of the path, including start and goal; empty without a path.
    #[schema(value_type = Vec<Numbers2>)]
    pub way: Vec<[f64; 2]>,
    /// Distance of the path from walls, except near its ends.
    pub clearance_m: Option<f64>,
    /// Paths planned since the start of the trial.
    pub plans: u32,
    /// Edges tried in the last search.
    pub attempts: u32,
    /// Weight of the cost from the root in the choice of the nearest node.
    pub beta: f64,
    /// Obstacles for planning, as the fewest rectangles.
    pub obstacles: Vec<Rect>,
}

/// Column, row, width and height in pixels of a square image of the table, rows counted from the top.
pub type PixelBlock = [u32; 4];

/// The camera's image as used by the planner, from straight above.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct BlocksLayer {
    /// Upper left corner on the table.
    #[schema(value_type = Numbers2)]
    pub origin_m: [f64; 2],
    /// Side of a pixel on the table.
    pub pixel_m: f64,
    /// Dark blocks of the quadtree.
    #[schema(value_type = Vec<Wholes4>)]
    pub dark: Vec<PixelBlock>,
    /// Free blocks of the quadtree.
    #[schema(value_type = Vec<Wholes4>)]
    pub free: Vec<PixelBlock>,
    /// The dark blocks merged into as few rectangles as possible.
    #[schema(value_type = Vec<Wholes4>)]
    pub rectangles: Vec<PixelBlock>,
}

/// The obstacle map observed since the start of the trial.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct SeenMessage {
    /// Number of the message, increasing within the session.
    #[ts(type = "number")]
    pub number: u64,
    /// The area of the grid.
    pub workspace: Rect,
    /// Cells along x.
    pub columns: u32,
    /// Cells along y.
    pub rows: u32,
    /// Runs of equal cells with their length, row by row from the minimum x and y; a run may continue in the next row:
    /// 0 for unknown, 1 for free, 2 for an obstacle.
    pub runs: Vec<(u8, u32)>,
}

/// The policy's evaluation of the last image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct JudgementLayer {
    /// The policy that acts: `colon`, `general` or `explorer`, or `own` for one from a file.
    pub policy: String,
    /// Quantiles of the return for +x, −x, +y and −y, at the fractions (k + ½) / K.
    #[schema(value_type = Lists4)]
    pub quantiles: [Vec<f32>; 4],
    /// Mean return of each action.
    #[schema(value_type = Numbers4)]
    pub values: [f32; 4],
    /// Index of the action that was taken; the best one, unless the shield chose the next best.
    pub taken: u8,
    /// Whether the tool goes straight over several cells of the route that begins with the action.
    pub is_shortcut: bool,
    /// Maps that the policy was trained on.
    pub trained_on: Vec<String>,
    /// Whether the policy remembers what the camera has seen, so that it needs no training on the map.
    pub has_memory: bool,
}

/// Body of `POST /api/sessions/{id}/values`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({"goal_m": [0.12, -0.33]}))]
pub struct ValueQuery {
    #[schema(value_type = Numbers2)]
    pub goal_m: [f64; 2],
    /// Number of the page's last `seen` message. The server ignores it; it makes the request a new one
    /// when more was observed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional, type = "number")]
    pub seen: Option<u64>,
}

/// Values of the session's policy for every place of the map and one goal. Without a memory they come from images of the
/// default camera, with places a centimetre apart, farther where there would be more than 4000. A policy with a memory
/// judges all places where it may be, by what the session's camera has seen so far.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct ValueMap {
    /// Side of a cell.
    pub spacing_m: f64,
    /// Cells with at least the policy's clearance from walls; with a memory, from walls that were seen.
    pub cells: Vec<ValueCell>,
    /// Maps that the policy was trained on.
    pub trained_on: Vec<String>,
    /// Whether the values are those of what the session's camera has seen so far.
    pub has_memory: bool,
}

/// One cell of a [`ValueMap`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct ValueCell {
    /// Centre of the cell.
    #[schema(value_type = Numbers2)]
    pub center_m: [f64; 2],
    /// Value of the best action.
    pub value: f32,
    /// Index of the best action: +x, −x, +y, −y.
    pub action: u8,
}

/// Allowed spacing of a [`FlowQuery`].
pub const FLOW_SPACING_M: std::ops::RangeInclusive<f64> = 0.005..=0.05;

/// Body of `POST /api/sessions/{id}/flow`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct FlowQuery {
    /// Distance between two places, .005 to .05 m.
    #[schema(minimum = 0.005, maximum = 0.05)]
    pub spacing_m: f64,
    /// Number of the page's last `seen` message. The server ignores it; it makes the request a new one
    /// when more was observed.
    #[ts(type = "number")]
    pub seen: u64,
}

/// The attractor's flow for goal, parameters and obstacle map.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct FlowField {
    /// Places across.
    pub columns: u32,
    /// Places away from the user.
    pub rows: u32,
    /// The place with minimum x and y.
    #[schema(value_type = Numbers2)]
    pub origin_m: [f64; 2],
    /// Distance between two places.
    pub spacing_m: f64,
    /// Velocities row by row from the minimum x and y; `null` over a known obstacle. Empty without a
    /// goal.
    #[schema(value_type = Vec<Option<Numbers2>>)]
    pub velocity_m_s: Vec<Option<[f64; 2]>>,
}

impl From<&View> for OverlayMessage {
    fn from(view: &View) -> Self {
        let (tick, sight) = &*view.sight;
        let Scenery { arena, parameters, .. } = &*view.scenery;
        Self::of(*tick, sight, view.moment.motion, arena, &parameters.rl_policy)
    }
}

impl OverlayMessage {
    /// Converts percept and decision of `tick`; `motion` is the motion of the arm that followed.
    pub fn of(tick: u64, sight: &Sight, motion: Motion, arena: &Arena, policy: &RlPolicy) -> Self {
        let sensed = sight.carrier.attractor().map(Attractor::sensed);
        let obstacles = sensed.unwrap_or_default().iter().map(|o| SensedObstacle {
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
                Motion::Hold | Motion::Track | Motion::Joints(_) => None,
            },
            picture_from_table: sight.frame.pinhole.picture_from_table(sight.frame.picture.width_px),
            blocks: BlocksLayer::from(sight),
            plan: sight.carrier.errt().map(|errt| PlanLayer::of(errt, &sight.known)),
            judgement: sight.carrier.rl().and_then(|rl| JudgementLayer::of(rl, arena, policy)),
        }
    }
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

impl From<Flow> for FlowField {
    fn from(flow: Flow) -> Self {
        Self {
            columns: flow.columns as u32,
            rows: flow.rows as u32,
            origin_m: flow.origin_m.coords.into(),
            spacing_m: flow.spacing_m,
            velocity_m_s: flow.velocity_m_s.into_iter().map(|velocity| velocity.map(Into::into)).collect(),
        }
    }
}

impl JudgementLayer {
    /// Layer of a policy; `None` before its first decision.
    pub fn of(rl: &Rl, arena: &Arena, policy: &RlPolicy) -> Option<Self> {
        let Decision { judgement, action, shortcut_m, .. } = rl.decision()?;
        let name = arena.policy_name(policy);
        let policy = arena.policy(policy).ok()?;
        Some(Self {
            policy: name,
            quantiles: judgement.quantiles.clone(),
            values: judgement.values(),
            taken: action.index() as u8,
            is_shortcut: shortcut_m.is_some(),
            trained_on: policy.manifest().maps.clone(),
            has_memory: policy.has_memory(),
        })
    }
}

impl ValueMap {
    /// Converts a policy's values for places `spacing_m` apart.
    pub fn of(policy: &Policy, spacing_m: f64, judged: Vec<(Point2<f64>, Judgement)>) -> Self {
        let cell = |(center_m, judgement): (Point2<f64>, Judgement)| {
            let best = judgement.ranking()[0].index();
            ValueCell { center_m: center_m.coords.into(), value: judgement.values()[best], action: best as u8 }
        };
        Self {
            spacing_m,
            cells: judged.into_iter().map(cell).collect(),
            trained_on: policy.manifest().maps.clone(),
            has_memory: policy.has_memory(),
        }
    }
}

impl PlanLayer {
    /// Converts the planner's tree and path, and the obstacles that it plans around.
    pub fn of(errt: &Errt, known: &ObstacleMap) -> Self {
        let (planner, path) = (errt.planner(), errt.path());
        Self {
            tree: errt.shown_edges().map(|[from, to]| [from.x, from.y, to.x, to.y]).collect(),
            way: path.map(|path| path.points.iter().map(|point| point.coords.into()).collect()).unwrap_or_default(),
            clearance_m: path.map(|path| path.clearance.asked_m),
            plans: errt.plans(),
            attempts: planner.attempts() as u32,
            beta: planner.beta(),
            obstacles: known.rectangles(),
        }
    }
}

impl SeenMessage {
    /// Converts the obstacle map. `number` counts the messages of a session.
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
