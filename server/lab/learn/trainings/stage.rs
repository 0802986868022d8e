//! How far a training is.

use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum TrainingStage {
    /// Another job is running.
    Waiting,
    /// The camera takes an image above each cell.
    Images,
    Learning,
    /// The last examination.
    Examination,
    Paused,
    Done,
    Cancelled,
    Failed(String),
}

impl TrainingStage {
    pub fn is_running(&self) -> bool {
        matches!(self, Self::Images | Self::Learning | Self::Examination)
    }

    /// Whether it cannot go on.
    pub fn is_final(&self) -> bool {
        matches!(self, Self::Done | Self::Cancelled | Self::Failed(_))
    }
}
