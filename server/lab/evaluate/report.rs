//! The report of an evaluation, for people and programs.

mod curves;
mod html;

pub use html::html_document;

use serde::Serialize;
use utoipa::ToSchema;

use super::{Cell, Comparison, Episode, Failure, PaperRow, Row};

/// The report of an evaluation.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
pub struct Report {
    /// Version of Ferry.
    pub ferry: String,
    /// Graphics adapter.
    pub adapter: String,
    /// Seed of the trials.
    pub seed: u64,
    /// Rows in the order of the cells.
    pub rows: Vec<Row>,
    /// Every pair of controllers on the same map with the same disturbances.
    pub comparisons: Vec<Comparison>,
    /// Trials that did not deliver.
    pub failures: Vec<Failure>,
    /// The paper's numbers, one entry per row.
    #[serde(skip)]
    paper: Vec<Option<PaperRow>>,
    /// The first trial of each row as a figure.
    #[serde(skip)]
    figures: Vec<Option<String>>,
}

/// A file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// Error of the CSV writer.
    #[error("report: {0}")]
    Csv(#[from] csv::Error),
    /// Error of the CSV writer's buffer.
    #[error("report: {0}")]
    Buffer(String),
}

impl Report {
    /// Summarises cells and their episodes.
    pub fn of(adapter: &str, seed: u64, done: &[(&Cell, &[Episode])]) -> Self {
        let figure = |episodes: &[Episode]| episodes.iter().find_map(|e| e.trace.as_ref())?.to_svg().ok();
        let failures =
            done.iter().flat_map(|(cell, episodes)| episodes.iter().filter_map(|episode| Failure::of(cell, episode)));
        Self {
            ferry: env!("CARGO_PKG_VERSION").to_owned(),
            adapter: adapter.to_owned(),
            seed,
            rows: done.iter().map(|(cell, episodes)| Row::of(cell, episodes)).collect(),
            comparisons: Comparison::all(done),
            failures: failures.collect(),
            paper: done.iter().map(|(cell, _)| PaperRow::of(cell)).collect(),
            figures: done.iter().map(|(_, episodes)| figure(episodes)).collect(),
        }
    }

    /// Parameters of all rows that differ from the default, each as `NAME=VALUE`; without varied ones.
    pub fn changes(&self) -> Vec<&str> {
        let Some(row) = self.rows.first() else { return Vec::new() };
        let is_varied = |change: &str| {
            let name = change.split('=').next();
            row.varied.iter().any(|setting| Some(setting.name.as_str()) == name)
        };
        row.changes.iter().map(String::as_str).filter(|change| !is_varied(change)).collect()
    }

    /// The rows as CSV (RFC 4180), with a head.
    pub fn to_csv(&self) -> Result<String, ReportError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in &self.rows {
            writer.serialize(CsvRow::from(row))?;
        }
        let bytes = writer.into_inner().map_err(|error| ReportError::Buffer(error.to_string()))?;
        String::from_utf8(bytes).map_err(|error| ReportError::Buffer(error.to_string()))
    }

    /// One HTML file that needs no other; `page` is the address of a laboratory's page, for the links.
    pub fn to_html(&self, page: &str) -> String {
        html::document(self, page)
    }
}

/// A row without lists, because CSV has no lists.
#[derive(Serialize)]
struct CsvRow<'a> {
    controller: &'a str,
    map: &'a str,
    disturbances: u32,
    varied_1: Option<&'a str>,
    value_1: Option<f64>,
    varied_2: Option<&'a str>,
    value_2: Option<f64>,
    episodes: u32,
    successes: u32,
    successes_wilson95_low: f64,
    successes_wilson95_high: f64,
    delivered: u32,
    delivered_wilson95_low: f64,
    delivered_wilson95_high: f64,
    tracking_error_mean_m: f64,
    tracking_error_mean95_low_m: Option<f64>,
    tracking_error_mean95_high_m: Option<f64>,
    tracking_error_mean_x_m: f64,
    tracking_error_mean_y_m: f64,
    tracking_error_max_x_m: f64,
    tracking_error_max_y_m: f64,
    path_ratio_mean: Option<f64>,
    steps_mean: f64,
    switches_mean: f64,
    disturbances_struck: u32,
    changes: String,
    trained_on_map: Option<bool>,
    beyond_steps: u32,
    by_hand: bool,
    tool_apart: bool,
    decision_ms_p50: f64,
    decision_ms_p99: f64,
}

impl<'a> From<&'a Row> for CsvRow<'a> {
    fn from(row: &'a Row) -> Self {
        let name = |index: usize| row.varied.get(index).map(|setting| setting.name.as_str());
        let value = |index: usize| row.varied.get(index).map(|setting| setting.value);
        Self {
            controller: &row.controller,
            map: &row.map,
            disturbances: row.disturbances,
            varied_1: name(0),
            value_1: value(0),
            varied_2: name(1),
            value_2: value(1),
            episodes: row.episodes,
            successes: row.successes,
            successes_wilson95_low: row.successes_wilson95[0],
            successes_wilson95_high: row.successes_wilson95[1],
            delivered: row.delivered,
            delivered_wilson95_low: row.wilson95[0],
            delivered_wilson95_high: row.wilson95[1],
            tracking_error_mean_m: row.tracking_error_mean_m,
            tracking_error_mean95_low_m: row.tracking_error_mean95_m.map(|[low, _]| low),
            tracking_error_mean95_high_m: row.tracking_error_mean95_m.map(|[_, high]| high),
            tracking_error_mean_x_m: row.tracking_error_mean_x_m,
            tracking_error_mean_y_m: row.tracking_error_mean_y_m,
            tracking_error_max_x_m: row.tracking_error_max_x_m,
            tracking_error_max_y_m: row.tracking_error_max_y_m,
            path_ratio_mean: row.path_ratio_mean,
            steps_mean: row.steps_mean,
            switches_mean: row.switches_mean,
            disturbances_struck: row.disturbances_struck,
            changes: row.changes.join(" "),
            trained_on_map: row.trained_on_map,
            beyond_steps: row.beyond_steps,
            by_hand: row.by_hand,
            tool_apart: row.tool_apart,
            decision_ms_p50: row.decision_ms_p50,
            decision_ms_p99: row.decision_ms_p99,
        }
    }
}
