//! Evaluations.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;
use utoipa::openapi::schema::{Array, ArrayBuilder, ObjectBuilder, Type};

use super::jobs::JobStage;
use ferry_core::scenario::{ControllerName, RlPolicy};
use ferry_core::schema::Numbers2;
use ferry_lab::evaluate::{self, Comparison, DISTURBANCES, Evaluation, Failure, Progress, Row, Setting, Variation};
use ferry_lab::jobs::Stage;

/// Body of `POST /api/evaluations`: every controller on every map with every number of disturbances, each on the
/// same starts, goals and seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct EvaluationQuery {
    /// Sub-controllers 2.
    #[schema(value_type = std::collections::BTreeSet<ControllerName>, min_items = 1)]
    pub controllers: Vec<ControllerName>,
    /// Names of maps, shipped or added.
    #[schema(value_type = std::collections::BTreeSet<String>, min_items = 1, example = json!(["posts"]))]
    pub maps: Vec<String>,
    /// Scripted disturbances per trial, 0 to 10.
    #[schema(schema_with = disturbances)]
    pub disturbances: Vec<u32>,
    /// Trials per cell, 1 to 1000.
    #[schema(minimum = 1, maximum = 1000)]
    pub episodes: u32,
    /// Seed of the trials.
    #[ts(type = "number")]
    pub seed: u64,
    /// Policy of the controller `rl`, as the parameter `rl_policy`.
    #[serde(default)]
    #[ts(type = "string")]
    #[schema(value_type = String, example = "auto")]
    pub rl_policy: RlPolicy,
    /// Name of a connected program, with the controller `program`.
    #[serde(default)]
    pub program: Option<String>,
    /// Parameters that take several values, at most two. Each combination has its cells.
    #[serde(default)]
    #[schema(max_items = 2)]
    pub vary: Vec<Variation>,
}

/// The derive has no limits for the items of a list.
fn disturbances() -> Array {
    let count = ObjectBuilder::new()
        .schema_type(Type::Integer)
        .minimum(Some(*DISTURBANCES.start()))
        .maximum(Some(*DISTURBANCES.end()));
    let about = "Scripted disturbances per trial, 0 to 10.";
    ArrayBuilder::new().items(count).unique_items(true).min_items(Some(1)).description(Some(about)).build()
}

/// The subject of one row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Cell {
    /// Sub-controller 2.
    pub controller: ControllerName,
    pub map: String,
    /// Scripted disturbances per trial.
    pub disturbances: u32,
    /// Name of the program, with the controller `program`.
    pub program: Option<String>,
    /// What varied parameters are in this cell.
    pub varied: Vec<Setting>,
}

/// The paper's numbers for a row.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
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

/// A cell of an evaluation with its progress.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct EvaluationCell {
    /// Controller, map and disturbances.
    #[serde(flatten)]
    pub cell: Cell,
    /// Number of trials that ended.
    pub done: u32,
    /// Number of these that delivered.
    pub delivered: u32,
    /// Time until the last trial ended.
    pub elapsed_s: f64,
    /// The paper's numbers for it, if it has any.
    pub paper: Option<PaperRow>,
}

/// An evaluation without its rows.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct EvaluationSummary {
    pub id: String,
    pub query: EvaluationQuery,
    pub stage: JobStage,
    /// Why it failed, if it did.
    pub message: Option<String>,
    /// Its cells, in the order in which they run.
    pub cells: Vec<EvaluationCell>,
    /// Number of complete cells.
    pub rows_done: u32,
}

/// A trial that did not deliver. Its seed, start and goal, with map, controller and disturbances of its cell, set it
/// up again.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct EvaluationFailure {
    /// Its cell, from 0.
    pub cell: u32,
    /// Index of the trial.
    pub index: u32,
    /// Seed of the trial itself, as text.
    pub seed: String,
    /// Bead and tool at the start.
    #[schema(value_type = Option<Numbers2>)]
    pub start_m: Option<[f64; 2]>,
    #[schema(value_type = Option<Numbers2>)]
    pub goal_m: Option<[f64; 2]>,
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
    pub disturbances: u32,
}

/// Answer of `GET /api/evaluations/{id}`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct EvaluationReport {
    /// Its stage.
    #[serde(flatten)]
    pub summary: EvaluationSummary,
    /// Rows of the complete cells, in their order, as in `ferry evaluate --json`.
    pub rows: Vec<Row>,
    /// Every pair of controllers on the same map with the same disturbances.
    pub comparisons: Vec<Comparison>,
    /// Trials that did not deliver.
    pub failures: Vec<EvaluationFailure>,
}

/// Answer of `GET /api/evaluations`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Evaluations {
    /// In the order of submission.
    pub evaluations: Vec<EvaluationSummary>,
}

impl From<&Evaluation> for EvaluationSummary {
    fn from(evaluation: &Evaluation) -> Self {
        evaluation.life.read(|stage, progress| Self::at(evaluation, stage, progress))
    }
}

impl EvaluationSummary {
    fn at(evaluation: &Evaluation, stage: &Stage, progress: &Progress) -> Self {
        let (stage, message) = JobStage::of(stage);
        let cells = evaluation.cells.iter().cloned().zip(&progress.cells);
        Self {
            id: evaluation.id.clone(),
            query: evaluation.query.clone().into(),
            stage,
            message,
            cells: cells
                .map(|(cell, at)| EvaluationCell {
                    paper: evaluate::PaperRow::of(&cell).map(Into::into),
                    cell: cell.into(),
                    done: at.done,
                    delivered: at.delivered,
                    elapsed_s: at.elapsed_s,
                })
                .collect(),
            rows_done: progress.results.len() as u32,
        }
    }
}

impl From<&Evaluation> for EvaluationReport {
    fn from(evaluation: &Evaluation) -> Self {
        let (summary, progress) = evaluation
            .life
            .read(|stage, progress| (EvaluationSummary::at(evaluation, stage, progress), progress.clone()));
        let results = &progress.results;
        let failures = results
            .iter()
            .zip(0..)
            .flat_map(|(result, cell)| result.failures.iter().map(move |failure| EvaluationFailure::of(cell, failure)));
        Self {
            failures: failures.collect(),
            comparisons: Comparison::all(&progress.done(&evaluation.cells)),
            rows: results.iter().map(|result| result.row.clone()).collect(),
            summary,
        }
    }
}

impl EvaluationFailure {
    fn of(cell: u32, failure: &Failure) -> Self {
        Self {
            cell,
            index: failure.index,
            seed: failure.seed.to_string(),
            start_m: failure.start_m.map(|start| [start.x, start.y]),
            goal_m: failure.goal_m.map(|goal| [goal.x, goal.y]),
            reached: failure.reached,
            outcome: failure.outcome.clone(),
            trouble: failure.trouble.clone(),
            refusal: failure.refusal.clone(),
            steps: failure.steps,
            disturbances: failure.disturbances_struck,
        }
    }
}

impl From<EvaluationQuery> for evaluate::EvaluationQuery {
    fn from(value: EvaluationQuery) -> Self {
        let EvaluationQuery { controllers, maps, disturbances, episodes, seed, rl_policy, program, vary } = value;
        Self { controllers, maps, disturbances, episodes, seed, rl_policy, program, vary }
    }
}

impl From<evaluate::EvaluationQuery> for EvaluationQuery {
    fn from(value: evaluate::EvaluationQuery) -> Self {
        let evaluate::EvaluationQuery { controllers, maps, disturbances, episodes, seed, rl_policy, program, vary } =
            value;
        Self { controllers, maps, disturbances, episodes, seed, rl_policy, program, vary }
    }
}

impl From<evaluate::Cell> for Cell {
    fn from(value: evaluate::Cell) -> Self {
        let evaluate::Cell { controller, map, disturbances, program, varied } = value;
        Self { controller, map, disturbances, program, varied }
    }
}

impl From<evaluate::PaperRow> for PaperRow {
    fn from(value: evaluate::PaperRow) -> Self {
        let evaluate::PaperRow {
            section,
            episodes,
            successes,
            successes_wilson95,
            printed,
            tracking_error_mean_m,
            tracking_error_max_x_m,
            tracking_error_max_y_m,
        } = value;
        Self {
            section,
            episodes,
            successes,
            successes_wilson95,
            printed,
            tracking_error_mean_m,
            tracking_error_max_x_m,
            tracking_error_max_y_m,
        }
    }
}
