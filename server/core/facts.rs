//! Facts for programs and pages: a code with values, and one English sentence.
//!
//! These types have the form of the wire. The states of a trial keep their own: saved sessions and logs contain them.

use std::fmt::Display;

use serde::{Deserialize, Serialize};

/// A fact with its sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
pub struct Told<T> {
    #[serde(flatten)]
    pub fact: T,
    /// One sentence in English.
    pub text: String,
}

impl<T: Display> From<T> for Told<T> {
    /// The fact's own sentence.
    fn from(fact: T) -> Self {
        Self { text: fact.to_string(), fact }
    }
}

impl<T> Told<T> {
    /// The fact of a domain type, with its sentence.
    pub fn of<D: Display + ?Sized>(domain: &D) -> Self
    where
        T: for<'a> From<&'a D>,
    {
        Self { fact: T::from(domain), text: domain.to_string() }
    }
}

/// Why a command was refused, for programs. `values` has what it is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum RefusalCode {
    // The message.
    Malformed,
    NotOperator,
    Kept,
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
