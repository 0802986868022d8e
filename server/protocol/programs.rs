//! Messages between the server and a program that decides control steps.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::ErrorMessage;
use ferry_core::control::transport::program::Answer;
use ferry_core::geometry::{Point2, Rect};
use ferry_core::scenario::Parameters;
use ferry_core::session::PROGRAM_ANSWER_WITHIN;
use ferry_core::trial::{ControlQuery, Leg};
use ferry_lab::program::{Asked, Program};

/// Version of these messages. Increase it when an old program could misread the server.
pub const PROGRAM_PROTOCOL_VERSION: u32 = 1;

/// A message to a program, as text. After each `observe`, one binary message has the gray image, row by row from the top.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ProgramMessage {
    /// The first message.
    Hello {
        /// Version of these messages.
        protocol: u32,
        name: String,
        /// A live session waits this long for an answer.
        answer_within_s: f64,
    },
    /// A leg begins: the next `observe` of this trial belongs to it. Forget what belongs to the last one.
    Start {
        /// Name of the session, or of the trial of an evaluation.
        trial: String,
        map: String,
        workspace: Rect,
        #[schema(value_type = Object)]
        parameters: Box<Parameters>,
    },
    /// A control step needs an answer.
    Observe {
        /// Number for the answer.
        request: u64,
        trial: String,
        tick: u64,
        tool_m: [f64; 2],
        /// The bead as the tracker sees it.
        bead_tracked_m: [f64; 2],
        goal_m: [f64; 2],
        /// Dark blocks of the image on the table.
        obstacles: Vec<Rect>,
        image: ImageFacts,
        /// The answer is waited for this long.
        deadline_s: f64,
    },
    /// There are no more questions in this trial.
    End {
        /// As in `start`.
        trial: String,
    },
    /// A message could not be used.
    Error(ErrorMessage),
}

/// Where the image is on the table; +x is right, +y is up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ImageFacts {
    /// Columns and rows.
    pub size_px: usize,
    /// Metres on the table per pixel.
    pub m_per_px: f64,
    /// Table point at the middle.
    pub center_m: [f64; 2],
}

/// An answer of a program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ProgramAnswer {
    /// The tool goes straight to a place, as far as a control step reaches.
    Act { request: u64, target_m: [f64; 2] },
    /// The arm holds.
    Hold {
        request: u64,
        /// At most 160 bytes.
        reason: String,
    },
}

impl ProgramAnswer {
    pub fn request(&self) -> u64 {
        match self {
            Self::Act { request, .. } | Self::Hold { request, .. } => *request,
        }
    }

    /// The answer for the session, in which the program's name belongs to a reason.
    pub fn answer(self, name: &str) -> Answer {
        match self {
            Self::Act { target_m: [x_m, y_m], .. } => Answer::Go { target_m: Point2::new(x_m, y_m) },
            Self::Hold { reason, .. } => Answer::Hold { reason: format!("{name}: {reason}") },
        }
    }
}

impl ProgramMessage {
    pub fn hello(name: &str) -> Self {
        let answer_within_s = PROGRAM_ANSWER_WITHIN.as_secs_f64();
        Self::Hello { protocol: PROGRAM_PROTOCOL_VERSION, name: name.to_owned(), answer_within_s }
    }

    pub fn start(trial: &str, leg: &Leg) -> Self {
        let Leg { map, workspace, parameters, .. } = leg;
        Self::Start {
            trial: trial.to_owned(),
            map: map.clone(),
            workspace: *workspace,
            parameters: Box::new(parameters.clone()),
        }
    }

    pub fn observe(request: u64, asked: &Asked) -> Self {
        let Asked { trial, query, within, .. } = asked;
        let ControlQuery { question, percept, obstacles, .. } = &**query;
        let calibration = &percept.calibration;
        Self::Observe {
            request,
            trial: trial.clone(),
            tick: question.tick,
            tool_m: question.tool_m.into(),
            bead_tracked_m: question.bead_m.into(),
            goal_m: question.goal_m.into(),
            obstacles: obstacles.clone(),
            image: ImageFacts {
                size_px: calibration.size_px,
                m_per_px: calibration.m_per_px,
                center_m: calibration.center_m.into(),
            },
            deadline_s: within.as_secs_f64(),
        }
    }
}

/// Answer of `GET /api/controllers`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Programs {
    /// By name; also those that have disconnected.
    pub programs: Vec<ProgramStanding>,
}

/// A program that decides control steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct ProgramStanding {
    pub name: String,
    pub is_connected: bool,
    /// Answers since it connected.
    #[ts(type = "number")]
    pub answers: u64,
    /// Control steps for which no usable answer came in time, since it connected.
    #[ts(type = "number")]
    pub missed: u64,
    /// Time to the last answer; `null` before the first.
    pub latency_s: Option<f64>,
}

impl From<&Program> for ProgramStanding {
    fn from(program: &Program) -> Self {
        let standing = program.standing();
        Self {
            name: program.name.clone(),
            is_connected: standing.is_connected,
            answers: standing.answers,
            missed: standing.missed,
            latency_s: standing.latency_s,
        }
    }
}
