//! The query for the arm's manipulability over the workspace, and its answer.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::geometry::Rect;
use ferry_core::plant::ToolOrientation;
use ferry_core::robot::workspace;
use ferry_core::schema::Numbers2;

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

/// Manipulability over a plane, in square cells.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct ManipulabilityMap {
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// Lower left corner of the lower left cell, `[x_m, y_m]`.
    #[schema(value_type = Numbers2)]
    pub origin_m: [f64; 2],
    /// Side of a cell.
    pub cell_m: f64,
    /// |det J| in m³ with the flange over each cell's centre, row by row from the lower left; `None`
    /// where the branch does not reach. `rows × columns` values.
    pub manipulability_m3: Vec<Option<f64>>,
}

impl From<workspace::ManipulabilityMap> for ManipulabilityMap {
    fn from(value: workspace::ManipulabilityMap) -> Self {
        let workspace::ManipulabilityMap { columns, rows, origin_m, cell_m, manipulability_m3 } = value;
        Self { columns, rows, origin_m, cell_m, manipulability_m3 }
    }
}
