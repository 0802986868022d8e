//! Summaries of episodes: the rows of the table.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::statistics::{LEVEL, wilson95};
use super::{Cell, Episode, Manner, Setting};
use ferry_core::geometry::Point2;
use ferry_core::scenario::ControllerName;
use ferry_core::schema::Numbers2;

/// One row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Row {
    /// Sub-controller 2.
    pub controller: String,
    pub map: String,
    /// Scripted disturbances per trial.
    pub disturbances: u32,
    /// What varied parameters are in this row.
    #[serde(default)]
    pub varied: Vec<Setting>,
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

impl Row {
    /// Summarises the episodes of a cell.
    pub fn of(cell: &Cell, episodes: &[Episode]) -> Self {
        let count = episodes.len() as u32;
        let mean = |value: &dyn Fn(&Episode) -> f64| mean(episodes.iter().map(value)).unwrap_or_default();
        let total = |flag: &dyn Fn(&Episode) -> bool| episodes.iter().filter(|e| flag(e)).count() as u32;
        let mut decisions: Vec<f64> = episodes.iter().flat_map(|e| e.decision_s.iter().copied()).collect();
        decisions.sort_by(f64::total_cmp);
        let last = decisions.len().saturating_sub(1) as f64;
        let quantile_ms = |q: f64| decisions.get((last * q).round() as usize).map_or(0.0, |s| s * 1e3);
        let errors_m: Vec<f64> = episodes.iter().map(|e| e.tally.mean_m()).collect();
        let (reached, delivered) = (total(&|e| e.reached), total(&|e| e.delivered));
        Self {
            controller: cell.controller().to_owned(),
            map: cell.map.clone(),
            disturbances: cell.disturbances,
            varied: cell.varied.clone(),
            episodes: count,
            successes: reached,
            successes_wilson95: wilson95(reached, count),
            delivered,
            wilson95: wilson95(delivered, count),
            tracking_error_mean_m: mean(&|e| e.tally.mean_m()),
            tracking_error_mean95_m: super::statistics::mean(&errors_m, LEVEL).map(|(_, interval)| interval),
            tracking_error_mean_x_m: mean(&|e| e.tally.mean_axes_m()[0]),
            tracking_error_mean_y_m: mean(&|e| e.tally.mean_axes_m()[1]),
            tracking_error_max_x_m: mean(&|e| e.tally.max_m()[0]),
            tracking_error_max_y_m: mean(&|e| e.tally.max_m()[1]),
            path_ratio_mean: self::mean(episodes.iter().filter_map(|e| e.path_ratio)),
            steps_mean: mean(&|e| f64::from(e.steps)),
            switches_mean: mean(&|e| f64::from(e.switches)),
            disturbances_struck: episodes.iter().map(|e| e.disturbances).sum(),
            changes: episodes.first().map(|episode| episode.scenario.parameters.changes()).unwrap_or_default(),
            trained_on_map: episodes.first().and_then(|episode| episode.trained_on_map),
            beyond_steps: total(&Episode::is_beyond_steps),
            by_hand: episodes.first().is_some_and(|episode| episode.manner.by_hand),
            tool_apart: episodes.first().is_some_and(|episode| episode.manner.tool_apart),
            decision_ms_p50: quantile_ms(0.5),
            decision_ms_p99: quantile_ms(0.99),
        }
    }
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

/// A trial that did not deliver, with everything needed to repeat it.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
pub struct Failure {
    /// Sub-controller 2.
    pub controller: String,
    pub map: String,
    /// Scripted disturbances.
    pub disturbances: u32,
    /// What varied parameters are in its row.
    pub varied: Vec<Setting>,
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

impl Failure {
    /// Describes a trial that failed; `None` for one that delivered.
    pub fn of(cell: &Cell, episode: &Episode) -> Option<Self> {
        if episode.delivered {
            return None;
        }
        Some(Self {
            controller: cell.controller().to_owned(),
            map: cell.map.clone(),
            disturbances: cell.disturbances,
            varied: cell.varied.clone(),
            index: episode.index,
            seed: episode.scenario.seed,
            start_m: episode.scenario.start_m,
            goal_m: episode.scenario.goal_m,
            reached: episode.reached,
            outcome: episode.outcome.clone(),
            trouble: episode.trouble.clone(),
            refusal: episode.refusal.clone(),
            steps: episode.steps,
            disturbances_struck: episode.disturbances,
            // A link cannot hold what a person or a program does.
            link: episode
                .scenario
                .link()
                .filter(|_| episode.manner == Manner::default() && cell.controller != ControllerName::Program),
        })
    }

    /// Why, in one line.
    pub fn reason(&self) -> String {
        let more = [&self.trouble, &self.refusal].into_iter().flatten().map(|why| format!("; {why}"));
        format!("{}{}", self.outcome, more.collect::<String>())
    }
}
