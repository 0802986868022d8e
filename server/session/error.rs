//! Why a session refuses a command.

use serde_json::Value;

use super::{ANSWER_WITHIN, COMMAND_QUEUE};
use ferry_core::facts::RefusalCode;
use ferry_core::session::CommandError as SessionError;
use ferry_ur::twin::DriveError;

/// Why a command was refused; the session is unchanged.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// The session refused it.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// No program of this name has connected.
    #[error("program is {name:?}, no program of this name has connected")]
    NoProgram { name: String },
    /// No such trial of a recovery map has ended.
    #[error("recovery is {recovery:?}, it has no trial {repeat} of cell {cell} with this controller")]
    NoTry { recovery: String, cell: u32, repeat: u32 },
    /// There is no goal.
    #[error("tick {tick}: no goal was set, so there is nothing to compare")]
    NoGoal { tick: u64 },
    /// No robot is connected with this session.
    #[error("this session drives no robot; `ferry drive --robot ADDRESS --enable-motion` does, in the session main")]
    NoRobot,
    /// The robot does not follow.
    #[error("robot: {0}")]
    Drive(#[from] DriveError),
    /// The command queue is full.
    #[error("the session is busy: more than {COMMAND_QUEUE} commands wait")]
    Busy,
    /// The session did not answer.
    #[error("the session has not answered for {} s; the command may still be carried out", ANSWER_WITHIN.as_secs())]
    Unanswered,
    /// The session has ended.
    #[error("the session has ended")]
    Ended,
}

impl CommandError {
    /// One word for programs.
    pub fn code(&self) -> RefusalCode {
        match self {
            Self::Session(error) => error.code(),
            Self::NoProgram { .. } => RefusalCode::NoProgram,
            Self::NoTry { .. } => RefusalCode::NoTry,
            Self::NoGoal { .. } => RefusalCode::NoGoal,
            Self::NoRobot => RefusalCode::NoRobot,
            Self::Drive(_) => RefusalCode::RobotRefused,
            Self::Busy => RefusalCode::Busy,
            Self::Unanswered => RefusalCode::Unanswered,
            Self::Ended => RefusalCode::Ended,
        }
    }

    /// The field of the command that it is about.
    pub fn field(&self) -> Option<&str> {
        match self {
            Self::Session(error) => error.field(),
            Self::NoProgram { .. } => Some("program"),
            Self::NoTry { .. } => Some("recovery"),
            Self::NoGoal { .. } => Some("tick"),
            _ => None,
        }
    }

    /// What was refused, by name, for programs.
    pub fn values(&self) -> Vec<(&'static str, Value)> {
        match self {
            Self::Session(error) => error.values(),
            Self::NoProgram { name } => vec![("program", name.as_str().into())],
            Self::NoTry { recovery, cell, repeat } => {
                vec![("recovery", recovery.as_str().into()), ("cell", (*cell).into()), ("repeat", (*repeat).into())]
            }
            Self::NoGoal { tick } => vec![("tick", (*tick).into())],
            Self::NoRobot | Self::Drive(_) | Self::Busy | Self::Unanswered | Self::Ended => Vec::new(),
        }
    }
}
