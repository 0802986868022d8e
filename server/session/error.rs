//! Why a session refuses a command.

use super::{ANSWER_WITHIN, COMMAND_QUEUE};
use crate::ur::twin::DriveError;
use ferry_core::challenge::ChallengeError;
use ferry_core::map::MapError;
use ferry_core::trial::{CaseError, InputError, TrialError};

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
    /// No program of this name has connected.
    #[error("program is {name:?}, no program of this name has connected")]
    NoProgram { name: String },
    /// No kept run has this number.
    #[error("run is {number}, there is no kept run of this number")]
    NoRun { number: u32 },
    /// No such trial of a recovery map has ended.
    #[error("recovery is {recovery:?}, it has no trial {repeat} of cell {cell} with this controller")]
    NoTry { recovery: String, cell: u32, repeat: u32 },
    /// There is no goal.
    #[error("tick {tick}: no goal was set, so there is nothing to compare")]
    NoGoal { tick: u64 },
    /// A test case would have nothing to expect.
    #[error("tick {tick}: nothing was carried yet, so the case would expect nothing; run the session first")]
    NothingCarried {
        /// The tick of the session.
        tick: u64,
    },
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
