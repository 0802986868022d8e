//! The query for the arm's manipulability over the workspace, and its answer.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::geometry::Rect;
use ferry_core::plant::ToolOrientation;
use ferry_core::robot::workspace::ManipulabilityMap;

/// Body of `POST /api/kinematics/workspace`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({
    "area": {"x_min_m": -0.3, "x_max_m": 0.3, "y_min_m": -0.6, "y_max_m": -0.2},
    "cell_m": 0.05, "tool_height_m": 0.1, "tool_orientation": "vertical",
}))]
pub struct WorkspaceQuery {
    /// Area for the tool point.
    pub area: Rect,
    /// Side of a cell.
    #[schema(exclusive_minimum = 0)]
    pub cell_m: f64,
    /// Lower face of the block above the table.
    pub tool_height_m: f64,
    /// How the arm holds its flange.
    pub tool_orientation: ToolOrientation,
}

/// Answer of `POST /api/kinematics/workspace`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct WorkspaceMap {
    /// Manipulability with the tool point over each cell.
    #[serde(flatten)]
    pub map: ManipulabilityMap,
    /// Poses with less are refused as singular.
    pub least_m3: f64,
}
