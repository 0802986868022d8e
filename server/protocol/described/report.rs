//! The report of an evaluation, as `ferry evaluate --json` writes it.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::evaluate;
use crate::geometry::Point2;
use crate::protocol::numbers::Numbers2;

describe! {
    evaluate::Row as Row;
    evaluate::Comparison as Comparison;
    evaluate::PairedMean as PairedMean;
    evaluate::Setting as Setting;
    evaluate::Variation as Variation;
}

describe_schema! {
    evaluate::Report as Report;
    evaluate::Failure as Failure;
}

/// A parameter with evenly spaced values, ends included.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::evaluate::Variation")]
pub struct Variation {
    /// Name of a parameter that is a number.
    #[schema(example = "friction")]
    pub name: String,
    /// First value, in the unit of the name.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values, 2 to 20.
    #[schema(minimum = 2, maximum = 20)]
    pub count: u32,
}

/// A varied parameter's value in one row.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::evaluate::Setting")]
pub struct Setting {
    pub name: String,
    pub value: f64,
}

/// One row of the table.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::evaluate::Row")]
pub struct Row {
    /// Sub-controller 2.
    pub controller: String,
    pub map: String,
    /// Scripted disturbances per trial.
    pub disturbances: u32,
    /// What varied parameters are in this row.
    #[serde(default)]
    pub varied: Vec<evaluate::Setting>,
    pub episodes: u32,
    /// Trials whose tool reached the goal (paper's test).
    pub successes: u32,
    /// Wilson 95 % interval of `successes / episodes`.
    #[schema(value_type = Numbers2)]
    pub successes_wilson95: [f64; 2],
    /// Trials whose bead reached the goal.
    pub delivered: u32,
    /// Wilson 95 % interval of `delivered / episodes`.
    #[schema(value_type = Numbers2)]
    pub wilson95: [f64; 2],
    /// Mean over trials of the mean distance of tool and bead during transport.
    pub tracking_error_mean_m: f64,
    /// Its 95 % interval (Student's t); missing for fewer than two trials.
    #[serde(default)]
    #[schema(value_type = Option<Numbers2>)]
    pub tracking_error_mean95_m: Option<[f64; 2]>,
    /// Mean over trials of the mean absolute difference in x during transport.
    pub tracking_error_mean_x_m: f64,
    /// The same in y.
    pub tracking_error_mean_y_m: f64,
    /// Mean over trials of the maximum difference in x during transport.
    pub tracking_error_max_x_m: f64,
    /// The same in y.
    pub tracking_error_max_y_m: f64,
    /// Mean over delivered trials of the tool's path divided by the shortest path; missing without a delivery.
    pub path_ratio_mean: Option<f64>,
    /// Mean control steps.
    pub steps_mean: f64,
    pub switches_mean: f64,
    /// Disturbances applied in all trials together.
    pub disturbances_struck: u32,
    /// Parameters that differ from the default, each as `NAME=VALUE`: shield, visit penalty, camera and all others.
    #[serde(default)]
    pub changes: Vec<String>,
    /// Whether the policy was trained on this map; `null` for controllers without a policy.
    #[serde(default)]
    pub trained_on_map: Option<bool>,
    /// Trials whose goal no transport of `step_limit` steps can reach.
    #[serde(default)]
    pub beyond_steps: u32,
    /// Whether a hand draws the bead away through free space; otherwise it is lifted.
    #[serde(default)]
    pub by_hand: bool,
    /// Whether the tool starts at least 15 cm from the bead; otherwise above it.
    #[serde(default)]
    pub tool_apart: bool,
    /// Median duration of a control step in milliseconds, including the camera.
    pub decision_ms_p50: f64,
    pub decision_ms_p99: f64,
}

/// Two controllers compared trial by trial, with the same starts, goals, seeds and disturbances.
#[derive(Serialize, TS, ToSchema)]
#[serde(remote = "crate::evaluate::Comparison")]
pub struct Comparison {
    pub map: String,
    /// Scripted disturbances per trial.
    pub disturbances: u32,
    /// What varied parameters are in both rows.
    pub varied: Vec<evaluate::Setting>,
    /// Controller that is compared.
    pub controller: String,
    /// Controller that it is compared with.
    pub against: String,
    pub episodes: u32,
    /// Trials delivered by both.
    pub both: u32,
    /// Trials delivered by the first only.
    pub first_only: u32,
    /// Trials delivered by the second only.
    pub second_only: u32,
    /// Trials delivered by neither.
    pub neither: u32,
    /// Share delivered by the first minus that by the second.
    pub delivered_difference: f64,
    /// Its 95 % interval (Newcombe 1998, method 10).
    #[schema(value_type = Numbers2)]
    pub delivered_difference95: [f64; 2],
    /// The interval at the level that is corrected for the number of comparisons in the report (Bonferroni).
    #[schema(value_type = Numbers2)]
    pub delivered_difference_corrected: [f64; 2],
    /// Control steps of the first minus those of the second, where both delivered.
    pub steps: Option<evaluate::PairedMean>,
    /// The same for the mean distance of tool and bead during transport.
    pub tracking_error_mean_m: Option<evaluate::PairedMean>,
    /// The same for path ÷ shortest path.
    pub path_ratio: Option<evaluate::PairedMean>,
    /// Control steps over all trials. One that was not delivered counts with all steps that its legs may take.
    pub steps_of_all: Option<evaluate::PairedMean>,
    /// Path ÷ shortest path over all trials. One that was not delivered counts with the path of all these steps.
    pub path_ratio_of_all: Option<evaluate::PairedMean>,
}

/// A mean difference.
#[derive(Serialize, TS, ToSchema)]
#[serde(remote = "crate::evaluate::PairedMean")]
pub struct PairedMean {
    pub mean: f64,
    /// Its 95 % interval (Student's t).
    #[schema(value_type = Numbers2)]
    pub interval95: [f64; 2],
    /// The interval at the level that is corrected for the number of comparisons in the report (Bonferroni).
    #[schema(value_type = Numbers2)]
    pub interval_corrected: [f64; 2],
}

/// A trial that did not deliver, with everything needed to repeat it.
#[derive(Serialize, ToSchema)]
#[serde(remote = "crate::evaluate::Failure")]
pub struct Failure {
    /// Sub-controller 2.
    pub controller: String,
    pub map: String,
    /// Scripted disturbances.
    pub disturbances: u32,
    /// What varied parameters are in its row.
    pub varied: Vec<evaluate::Setting>,
    /// Index of the trial.
    pub index: u32,
    /// Seed of the trial itself.
    pub seed: u64,
    /// Bead and tool at the start.
    #[schema(value_type = Option<Numbers2>)]
    pub start_m: Option<Point2<f64>>,
    #[schema(value_type = Option<Numbers2>)]
    pub goal_m: Option<Point2<f64>>,
    /// Whether the tool came to the goal.
    pub reached: bool,
    /// How it ended.
    pub outcome: String,
    /// What kept sub-controller 2 from the goal, if anything.
    pub trouble: Option<String>,
    /// Why the arm held at the end, if it did.
    pub refusal: Option<String>,
    /// Control steps.
    pub steps: u32,
    /// Disturbances applied.
    pub disturbances_struck: u32,
    /// The trial as an experiment link, from `#` on; missing if the page does not have the map.
    pub link: Option<String>,
}

/// The report of an evaluation.
#[derive(Serialize, ToSchema)]
#[serde(remote = "crate::evaluate::Report")]
pub struct Report {
    /// Version of Ferry.
    pub ferry: String,
    /// Graphics adapter.
    pub adapter: String,
    /// Seed of the trials.
    pub seed: u64,
    /// Rows in the order of the cells.
    pub rows: Vec<evaluate::Row>,
    /// Every pair of controllers on the same map with the same disturbances.
    pub comparisons: Vec<evaluate::Comparison>,
    /// Trials that did not deliver.
    pub failures: Vec<evaluate::Failure>,
}
