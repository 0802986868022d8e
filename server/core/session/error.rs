//! Why a session refuses a command.

use serde_json::Value;

use crate::challenge::ChallengeError;
use crate::facts::RefusalCode;
use crate::map::MapError;
use crate::scenario::ParameterError;
use crate::trial::{CaseError, InputError, TrialError};

/// Why a command was refused; the session is unchanged.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// The trial refused the input.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The map is invalid or unknown.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The text is not a test case.
    #[error("test case: {0}")]
    Case(#[from] CaseError),
    /// The drawing in a test case is not that of the map.
    #[error(
        "map.name is {name:?}: this server has another drawing of that name; give the map in the file another name"
    )]
    OtherDrawing { name: String },
    /// The trial could not be created.
    #[error(transparent)]
    Trial(#[from] TrialError),
    /// Out of range.
    #[error("{field} is {value}, it must be {allowed}")]
    Range {
        field: &'static str,
        value: f64,
        /// The allowed range.
        allowed: String,
    },
    /// The start of the trial is no longer kept.
    #[error("the start of the trial is no longer kept; reset, and save a case within ten minutes")]
    Forgotten,
    /// The challenge could not be drawn.
    #[error(transparent)]
    Challenge(#[from] ChallengeError),
    /// No challenge is being played.
    #[error("no challenge is being played in this session")]
    NoChallenge,
    /// No kept run has this number.
    #[error("run is {number}, there is no kept run of this number")]
    NoRun { number: u32 },
    /// A test case would have nothing to expect.
    #[error("tick {tick}: nothing was carried yet, so the case would expect nothing; run the session first")]
    NothingCarried {
        /// The tick of the session.
        tick: u64,
    },
}

impl CommandError {
    /// One word for programs.
    pub fn code(&self) -> RefusalCode {
        match self {
            Self::Input(error) | Self::Trial(TrialError::Input(error)) => error.code(),
            Self::Map(_) | Self::Challenge(_) | Self::Trial(TrialError::Map(_) | TrialError::Random(_)) => {
                RefusalCode::MapRefused
            }
            Self::Trial(TrialError::Policy(_)) => RefusalCode::UnknownPolicy,
            Self::Trial(TrialError::Parameter(_)) => RefusalCode::ParameterOutOfRange,
            Self::Trial(TrialError::Script { .. } | TrialError::LongScript { .. }) => RefusalCode::BadScript,
            Self::Trial(_) => RefusalCode::TrialFailed,
            Self::Case(_) => RefusalCode::BadCase,
            Self::OtherDrawing { .. } => RefusalCode::OtherDrawing,
            Self::Range { .. } => RefusalCode::OutOfRange,
            Self::NoChallenge => RefusalCode::NoChallenge,
            Self::NoRun { .. } => RefusalCode::NoRun,
            Self::NothingCarried { .. } => RefusalCode::NothingCarried,
            Self::Forgotten => RefusalCode::Forgotten,
        }
    }

    /// The field of the command that it is about.
    pub fn field(&self) -> Option<&str> {
        match self {
            Self::Input(error) | Self::Trial(TrialError::Input(error)) => Some(error.field()),
            Self::Map(_) | Self::Trial(TrialError::Map(_) | TrialError::Random(_)) => Some("map"),
            Self::Challenge(_) => Some("challenge"),
            Self::Trial(TrialError::Policy(_)) => Some("rl_policy"),
            Self::Trial(TrialError::Parameter(error)) => Some(error.field),
            Self::Trial(TrialError::Script { .. } | TrialError::LongScript { .. }) => Some("script"),
            Self::Case(error) => Some(error.field()).filter(|field| !field.is_empty()),
            Self::OtherDrawing { .. } => Some("map.name"),
            Self::Range { field, .. } => Some(field),
            Self::NoRun { .. } => Some("run"),
            Self::NothingCarried { .. } => Some("tick"),
            Self::Trial(_) | Self::NoChallenge | Self::Forgotten => None,
        }
    }

    /// What was refused, by name, for programs.
    pub fn values(&self) -> Vec<(&'static str, Value)> {
        match self {
            Self::Input(error) | Self::Trial(TrialError::Input(error)) => error.values(),
            Self::Trial(TrialError::Parameter(ParameterError { value, allowed, .. }))
            | Self::Range { value, allowed, .. } => {
                vec![("value", (*value).into()), ("allowed", allowed.as_str().into())]
            }
            Self::OtherDrawing { name } => vec![("name", name.as_str().into())],
            Self::NoRun { number } => vec![("run", (*number).into())],
            Self::NothingCarried { tick } => vec![("tick", (*tick).into())],
            _ => Vec::new(),
        }
    }
}
