//! Why a command was refused, in one word.

use serde::{Deserialize, Serialize};

/// Why a command was refused, for programs. `values` has what it is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum RefusalCode {
    // The message.
    Malformed,
    NotOperator,
    StaleEpoch,
    OutOfRange,
    NotFinite,
    LongReason,
    // The table.
    OutsideWorkspace,
    InWall,
    OutOfReach,
    ParameterOutOfRange,
    DisturbanceOutOfRange,
    // Who acts.
    NotYou,
    NotRobot,
    NotProgram,
    JointsRefused,
    HandSilent,
    TooManyWait,
    // Trials.
    MapRefused,
    UnknownPolicy,
    BadScript,
    TrialFailed,
    BadCase,
    OtherDrawing,
    NoChallenge,
    NoRun,
    NothingCarried,
    Forgotten,
    // The server around the session.
    NoProgram,
    NoTry,
    NoTraining,
    NoGoal,
    NoRobot,
    RobotRefused,
    Busy,
    Unanswered,
    Ended,
}

impl std::fmt::Display for RefusalCode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.serialize(f)
    }
}
