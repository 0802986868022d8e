//! Evaluations.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::jobs::JobStage;
use ferry_core::scenario::ControllerName;
use ferry_core::schema::Numbers2;
use ferry_lab::evaluate::{self, Comparison, Evaluation, EvaluationQuery, Failure, PaperRow, Progress, Row, Setting};
use ferry_lab::jobs::Stage;

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

/// A cell of an evaluation with its progress.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
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
            query: evaluation.query.clone(),
            stage,
            message,
            cells: cells
                .map(|(cell, at)| EvaluationCell {
                    paper: PaperRow::of(&cell),
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

impl From<evaluate::Cell> for Cell {
    fn from(value: evaluate::Cell) -> Self {
        let evaluate::Cell { controller, map, disturbances, program, varied } = value;
        Self { controller, map, disturbances, program, varied }
    }
}
