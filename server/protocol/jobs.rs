//! Jobs in the background.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_lab::jobs::Stage;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobStage {
    /// Another job is running.
    Waiting,
    Running,
    /// Everything is complete.
    Done,
    Cancelled,
    /// It ended with an error.
    Failed,
}

impl JobStage {
    /// The stage, and why the job failed, if it did.
    pub fn of(stage: &Stage) -> (Self, Option<String>) {
        match stage {
            Stage::Waiting => (Self::Waiting, None),
            Stage::Running => (Self::Running, None),
            Stage::Done => (Self::Done, None),
            Stage::Cancelled => (Self::Cancelled, None),
            Stage::Failed(message) => (Self::Failed, Some(message.clone())),
        }
    }
}
