//! The paper's results, for comparison with ours.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::Cell;
use super::statistics::wilson95;
use ferry_core::scenario::ControllerName;
use ferry_core::schema::Numbers2;

/// The paper's numbers for a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct PaperRow {
    /// Source in the paper.
    pub section: String,
    pub episodes: u32,
    /// Trials whose tool reached the goal.
    pub successes: u32,
    /// Wilson 95 % interval of `successes / episodes`.
    #[schema(value_type = Numbers2)]
    pub successes_wilson95: [f64; 2],
    pub printed: String,
    /// Mean tracking error in both axes.
    pub tracking_error_mean_m: Option<f64>,
    /// Mean over trials of the largest in x.
    pub tracking_error_max_x_m: Option<f64>,
    /// The same in y.
    pub tracking_error_max_y_m: Option<f64>,
}

impl PaperRow {
    /// RL alone was counted, in one maze, after which `colon` is drawn. The paper does not say how many disturbances
    /// an episode had; its figure has three.
    pub fn of(cell: &Cell) -> Option<Self> {
        if !cell.varied.is_empty() {
            return None;
        }
        let (successes, printed, errors_m) = match (cell.controller, cell.map.as_str(), cell.disturbances) {
            (ControllerName::Rl, "colon", 0) => (30, "100\u{a0}%", Some([0.02, 0.08, 0.09])),
            (ControllerName::Rl, "colon", 3) => (29, "96.6\u{a0}%", None),
            _ => return None,
        };
        Some(Self {
            section: "§V-A".to_owned(),
            episodes: 30,
            successes,
            successes_wilson95: wilson95(successes, 30),
            printed: printed.to_owned(),
            tracking_error_mean_m: errors_m.map(|errors| errors[0]),
            tracking_error_max_x_m: errors_m.map(|errors| errors[1]),
            tracking_error_max_y_m: errors_m.map(|errors| errors[2]),
        })
    }
}
