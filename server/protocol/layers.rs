//! What the page can lay over its pictures: what the camera tells, what ERRT plans, where the attractor leads.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::geometry::Rect;
use crate::geometry::schema::{Lists4, Numbers2, Numbers4, Wholes4};

/// ERRT's last search, and the way that is followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct PlanLayer {
    /// Both ends of every edge, x, y, x, y in metres; 4000 at most.
    #[schema(value_type = Vec<Numbers4>)]
    pub tree: Vec<[f64; 4]>,
    /// Corners of the way, start and goal included; empty while there is none.
    #[schema(value_type = Vec<Numbers2>)]
    pub way: Vec<[f64; 2]>,
    /// Distance that the way keeps from walls away from its ends.
    pub clearance_m: Option<f64>,
    /// Ways planned since the trial began.
    pub plans: u32,
    /// Edges tried in the last search.
    pub attempts: u32,
    /// Weight of the cost from the root in the choice of the nearest node.
    pub beta: f64,
    /// Obstacles that it plans around, as few rectangles as possible.
    pub obstacles: Vec<Rect>,
}

/// Column, row, width and height in pixels of a square image of the table, rows counted from the top.
pub type PixelBlock = [u32; 4];

/// The camera's image as the planner takes it, seen from straight above.
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

/// What the camera has shown of the workspace since the trial began.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct SeenMessage {
    /// Raised with each of the session's.
    #[ts(type = "number")]
    pub number: u64,
    /// What the grid covers.
    pub workspace: Rect,
    /// Cells along x.
    pub columns: u32,
    /// Cells along y.
    pub rows: u32,
    /// Equal cells in succession, from the least x and y row by row, which may go on in the next row: 0 for
    /// unknown, 1 for free, 2 for an obstacle; and how many.
    pub runs: Vec<(u8, u32)>,
}

/// What the policy made of the last image that it judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct JudgementLayer {
    /// Quantiles of the return for +x, −x, +y and −y, at the fractions (k + ½) / K.
    #[schema(value_type = Lists4)]
    pub quantiles: [Vec<f32>; 4],
    /// Their means.
    #[schema(value_type = Numbers4)]
    pub values: [f32; 4],
    /// Index of the action that was taken; the best one, unless the shield chose the next best.
    pub taken: u8,
    /// Maps that the policy was trained on.
    pub trained_on: Vec<String>,
}

/// Body of `POST /api/sessions/{id}/values`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({"goal_m": [0.12, -0.33]}))]
pub struct ValueQuery {
    /// The goal to judge for.
    #[schema(value_type = Numbers2)]
    pub goal_m: [f64; 2],
}

/// What the session's policy thinks of every place of the map on the way to a goal, by the default camera's images.
/// Places are a centimetre apart, farther where there would be more than 4000.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct ValueMap {
    /// Side of a cell.
    pub spacing_m: f64,
    /// Cells that keep the policy's distance from the walls.
    pub cells: Vec<ValueCell>,
    /// Maps that the policy was trained on.
    pub trained_on: Vec<String>,
}

/// One cell of a [`ValueMap`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct ValueCell {
    /// Its middle.
    #[schema(value_type = Numbers2)]
    pub center_m: [f64; 2],
    /// Value of the best action.
    pub value: f32,
    /// Index of the best action: +x, −x, +y, −y.
    pub action: u8,
}

/// Spacing that a [`FlowQuery`] may ask for.
pub const FLOW_SPACING_M: std::ops::RangeInclusive<f64> = 0.005..=0.05;

/// Body of `POST /api/sessions/{id}/flow`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct FlowQuery {
    /// Distance between two places, .005 to .05 m.
    #[schema(minimum = 0.005, maximum = 0.05)]
    pub spacing_m: f64,
    /// Of the session's `seen` messages the one that the page has. Not looked at: it makes the question a new one
    /// when more was seen.
    #[ts(type = "number")]
    pub seen: u64,
}

/// Where attractor dynamics lead from each place of the workspace, for goal, parameters and what was seen up to now.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct FlowField {
    /// Places across.
    pub columns: u32,
    /// Places away from the user.
    pub rows: u32,
    /// The place of least x and y.
    #[schema(value_type = Numbers2)]
    pub origin_m: [f64; 2],
    /// Distance between two places.
    pub spacing_m: f64,
    /// Velocities row by row from the least y, each row from the least x; none over a known obstacle. Empty without a
    /// goal.
    #[schema(value_type = Vec<Option<Numbers2>>)]
    pub velocity_m_s: Vec<Option<[f64; 2]>>,
}
