//! The lists of a server, and the points of a training, as messages to browsers.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::{
    ChallengeSummary, EvaluationSummary, JobPace, JobSummary, PolicySummary, ProgramStanding, RecoverySummary,
    TrainingPoint, TrainingSummary,
};

/// A list of the server, whole, with the items of its HTTP resource.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(tag = "list", content = "items", rename_all = "snake_case")]
pub enum CatalogMessage {
    /// Names: the shipped maps, then the added ones.
    Maps(Vec<String>),
    /// The shipped ones, then the added ones, oldest first.
    Policies(Vec<PolicySummary>),
    /// In the order of submission, as the next two.
    Trainings(Vec<TrainingSummary>),
    Evaluations(Vec<EvaluationSummary>),
    Recoveries(Vec<RecoverySummary>),
    /// By name; also those that have disconnected.
    Programs(Vec<ProgramStanding>),
    /// Those of the day, those of the week, then the others that have a board.
    Challenges(Vec<ChallengeSummary>),
    /// Of all kinds, in the order of `GET /api/jobs`.
    Jobs(Vec<JobSummary>),
    Paces(Vec<JobPace>),
}

/// Points of the training that this browser watches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct TrainingPointsMessage {
    /// Id of the training.
    pub training: String,
    /// Number of points before these, 0 in the first message. Those that came after them before are replaced: a training
    /// that failed goes on from an earlier point.
    pub first: usize,
    pub points: Vec<TrainingPoint>,
}
