//! Trainings: policies that learn a map, as jobs in the background.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::schema::Numbers2;
use ferry_lab::evaluate::wilson95;
use ferry_lab::learn::sweep::STEP_M;
use ferry_lab::learn::{self, Ending, Frame, Marks, Point, Status, Trail, Training, TrainingQuery};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum TrainingStage {
    /// Another job is running.
    Waiting,
    /// The camera takes an image above each cell of the map.
    Images,
    Learning,
    /// The last examination.
    Examination,
    Paused,
    /// Its policy can be used.
    Done,
    Cancelled,
    Failed,
}

/// Episodes without exploration, with random starts and goals; on a map of at most 63 cells, with all of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Examination {
    pub episodes: u32,
    /// Within 2 cm of the goal.
    pub reached: u32,
    /// Into a wall.
    pub collided: u32,
    /// Out of steps.
    pub timed_out: u32,
    /// Wilson 95 % interval of `reached / episodes`.
    #[schema(value_type = Numbers2)]
    pub reached_wilson95: [f64; 2],
    /// Whether the episodes are all pairs of a start and a goal, each once: then there is nothing left to estimate.
    pub all_pairs: bool,
}

/// A hundred updates of a training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct TrainingPoint {
    /// Updates at the end of the point.
    #[ts(type = "number")]
    pub update: u64,
    /// Steps of all episodes so far.
    #[ts(type = "number")]
    pub steps: u64,
    /// Finished episodes so far.
    #[ts(type = "number")]
    pub episodes: u64,
    /// Mean total reward of the episodes that ended in this point; `null` without any.
    pub reward_mean: Option<f64>,
    /// Standard deviation of these rewards.
    pub reward_deviation: Option<f64>,
    pub loss_mean: Option<f64>,
    /// Episodes that ended in this point, with exploration.
    pub ended: u32,
    /// Number of these that reached their goal.
    pub reached: u32,
    /// A small examination, on some points.
    pub examined: Option<Examination>,
}

/// A training without its curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct TrainingSummary {
    pub id: String,
    pub query: TrainingQuery,
    pub stage: TrainingStage,
    /// Why it failed, if it did.
    pub message: Option<String>,
    #[ts(type = "number")]
    pub updates: u64,
    /// Updates at its end.
    #[ts(type = "number")]
    pub updates_total: u64,
    #[ts(type = "number")]
    pub steps: u64,
    #[ts(type = "number")]
    pub episodes: u64,
    /// Time spent on it, without pauses.
    pub elapsed_s: f64,
    /// Estimated time until its end, while it learns.
    pub left_s: Option<f64>,
    /// The last examination, of 1000 episodes or all pairs; before the end, the newest small one.
    pub examined: Option<Examination>,
    /// Rank correlation between values and distances to the goal of the value maps, of the newest one.
    pub rank_correlation: Option<f64>,
    /// Number of value maps.
    pub frames: u32,
    /// Smallest and greatest value of all value maps so far.
    #[schema(value_type = Option<Numbers2>)]
    pub value_range: Option<[f32; 2]>,
    /// Its policy, as `rl_policy` takes it, once it is done.
    pub policy: Option<String>,
}

/// Answer of `GET /api/trainings/{id}`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct TrainingReport {
    #[serde(flatten)]
    pub summary: TrainingSummary,
    pub curve: Vec<TrainingPoint>,
}

/// Answer of `GET /api/trainings`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Trainings {
    /// In the order of submission.
    pub trainings: Vec<TrainingSummary>,
}

/// The cells of a training's map: all lists of its value maps have this order.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct TrainingCells {
    /// Distance between two cells.
    pub spacing_m: f64,
    /// Goal of the value maps.
    #[schema(value_type = Numbers2)]
    pub goal_m: [f64; 2],
    #[schema(value_type = Vec<Numbers2>)]
    pub centers_m: Vec<[f64; 2]>,
    /// Steps of the shortest path to the goal; `null` without a path.
    pub steps: Vec<Option<u16>>,
}

/// A value map of a training: what its network thinks after a number of updates.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct TrainingFrame {
    #[ts(type = "number")]
    pub update: u64,
    /// Value of the best action, one entry per cell.
    pub values: Vec<f32>,
    /// Index of the best action: +x, −x, +y, −y.
    pub actions: Vec<u8>,
    /// Quantiles .05, .25, .5, .75 and .95 of the return of the best action.
    #[schema(value_type = Vec<Vec<f32>>)]
    pub quantiles: Vec<[f32; 5]>,
    /// How an episode without exploration ends that begins at the cell.
    pub endings: Vec<Ending>,
    /// Spearman’s rank correlation of the values with the distances, over all cells outside the goal; `null` if all values are equal.
    pub rank_correlation: Option<f64>,
    /// Episodes to the goal without exploration.
    pub greedy: Vec<Trail>,
    /// Episodes to the goal with exploration, from the same starts.
    pub exploring: Vec<Trail>,
}

/// Number of digits after the point: a value map of a thousand cells is sent as text.
fn rounded(value: f32) -> f32 {
    (value * 1e4).round() / 1e4
}

impl From<&Marks> for Examination {
    fn from(&Marks { episodes, reached, collided, timed_out, all_pairs, .. }: &Marks) -> Self {
        Self { episodes, reached, collided, timed_out, reached_wilson95: wilson95(reached, episodes), all_pairs }
    }
}

impl From<&Point> for TrainingPoint {
    fn from(point: &Point) -> Self {
        Self {
            update: point.update,
            steps: point.steps,
            episodes: point.episodes,
            reward_mean: point.reward.mean(),
            reward_deviation: point.reward.deviation(),
            loss_mean: point.loss.mean(),
            ended: point.reward.count(),
            reached: point.reached,
            examined: point.examined.as_ref().map(Examination::from),
        }
    }
}

impl From<&Training> for TrainingSummary {
    fn from(training: &Training) -> Self {
        Self::at(training, &training.status())
    }
}

impl TrainingSummary {
    fn at(training: &Training, status: &Status) -> Self {
        let (stage, message) = match &status.stage {
            learn::TrainingStage::Waiting => (TrainingStage::Waiting, None),
            learn::TrainingStage::Images => (TrainingStage::Images, None),
            learn::TrainingStage::Learning => (TrainingStage::Learning, None),
            learn::TrainingStage::Examination => (TrainingStage::Examination, None),
            learn::TrainingStage::Paused => (TrainingStage::Paused, None),
            learn::TrainingStage::Done => (TrainingStage::Done, None),
            learn::TrainingStage::Cancelled => (TrainingStage::Cancelled, None),
            learn::TrainingStage::Failed(message) => (TrainingStage::Failed, Some(message.clone())),
        };
        let last = status.points.last();
        let newest = || status.points.iter().rev().find_map(|point| point.examined);
        Self {
            id: training.id.clone(),
            query: training.query.clone(),
            stage,
            message,
            updates: last.map_or(0, |point| point.update),
            updates_total: training.updates_total,
            steps: last.map_or(0, |point| point.steps),
            episodes: last.map_or(0, |point| point.episodes),
            elapsed_s: status.elapsed_s,
            left_s: status.left_s.filter(|_| stage == TrainingStage::Learning),
            examined: status.examined.or_else(newest).as_ref().map(Examination::from),
            rank_correlation: status.frames.last().and_then(|frame| frame.rank_correlation),
            frames: status.frames.len() as u32,
            value_range: value_range(&status.frames),
            policy: status.policy.clone(),
        }
    }
}

fn value_range(frames: &[Arc<Frame>]) -> Option<[f32; 2]> {
    let values = || frames.iter().flat_map(|frame| frame.values.iter().copied());
    Some([values().reduce(f32::min)?, values().reduce(f32::max)?])
}

impl From<&Training> for TrainingReport {
    fn from(training: &Training) -> Self {
        let status = training.status();
        Self {
            summary: TrainingSummary::at(training, &status),
            curve: status.points.iter().map(TrainingPoint::from).collect(),
        }
    }
}

impl From<&learn::Cells> for TrainingCells {
    fn from(cells: &learn::Cells) -> Self {
        Self {
            spacing_m: STEP_M,
            goal_m: cells.goal_m.coords.into(),
            centers_m: cells.centers_m.iter().map(|center_m| center_m.coords.into()).collect(),
            steps: cells.steps.clone(),
        }
    }
}

impl From<&learn::Frame> for TrainingFrame {
    fn from(frame: &learn::Frame) -> Self {
        Self {
            update: frame.update,
            values: frame.values.iter().copied().map(rounded).collect(),
            actions: frame.actions.clone(),
            quantiles: frame.quantiles.iter().map(|row| row.map(rounded)).collect(),
            endings: frame.endings.clone(),
            rank_correlation: frame.rank_correlation,
            greedy: frame.greedy.clone(),
            exploring: frame.exploring.clone(),
        }
    }
}
