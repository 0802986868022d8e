//! The wire types that have a shape of their own, with the conversions from and to the types of the lower modules. Other
//! types travel as they are.
//!
//! Text frames are JSON objects tagged by `type`. Binary frames carry pictures: one byte
//! [`BINARY_CAMERA_JPEG`] or [`BINARY_OBSERVATION`], three bytes of zero, the tick as u32
//! little-endian, then the payload. [`BINARY_COURSE`] has the same head.

mod answer;
mod catalog;
mod challenges;
mod client;
mod comparison;
mod conversation;
mod error;
mod evaluations;
mod event;
mod jobs;
mod layers;
mod lumen;
mod maps;
mod page;
mod parse;
mod policies;
mod programs;
mod recordings;
mod recoveries;
mod seed;
mod server;
mod tracker;
mod trainings;
#[cfg(test)]
mod typescript;
mod workspace;

pub use answer::{DoneMessage, Refusal, RefusedMessage, SessionError};
pub use catalog::{CatalogMessage, TrainingPointsMessage};
pub use challenges::{
    AttemptAnswer, AttemptQuery, AttemptReport, AttemptStanding, BoardEntry, ChallengeReport, ChallengeSummary,
    Challenges, GhostMessage, Ghosts, MishapMessage, Period, TraceMessage,
};
pub use client::ClientMessage;
pub use comparison::{Branch, ComparisonMessage, MomentMessage};
pub use conversation::{Conversation, Outgoing};
pub use error::ErrorMessage;
pub use evaluations::{Cell, EvaluationCell, EvaluationFailure, EvaluationReport, EvaluationSummary, Evaluations};
pub use event::EventMessage;
pub use ferry_core::schema::{Numbers3, Numbers6, Rows3};
pub use jobs::{JobKind, JobLane, JobPace, JobStage, JobSummary, Jobs};
pub use layers::{
    BlocksLayer, FLOW_SPACING_M, FlowField, FlowQuery, JudgementLayer, OverlayMessage, PixelBlock, PlanLayer,
    SeenMessage, SensedObstacle, ValueCell, ValueMap, ValueQuery,
};
pub use lumen::{Lumen, WallRing};
pub use maps::{MapCheck, MapFacts, MapReport, NarrowPlace};
pub use page::View;
pub use parse::Envelope;
pub use policies::{Policies, PolicyName, PolicyOrigin, PolicySummary};
pub use programs::{ImageFacts, PROGRAM_PROTOCOL_VERSION, ProgramAnswer, ProgramMessage, ProgramStanding, Programs};
pub use recordings::{RecordingContent, RecordingFile, RecordingList, RecordingTitle};
pub use recoveries::{Recoveries, RecoveryQuery, RecoveryReport, RecoverySummary, RecoveryTrial, RecoveryTrials};
pub use server::{CaseSummary, Hello, KeptRun, Role, SceneMessage, ServerMessage, StateMessage};
pub use tracker::{GoalPlace, TrackerEstimate};
pub use trainings::{
    Examination, TrainingCells, TrainingFrame, TrainingPoint, TrainingReport, TrainingStage, TrainingSummary, Trainings,
};
pub use workspace::{WorkspaceMap, WorkspaceQuery};

/// Protocol version. Increase it when an old page could misread the server.
pub const PROTOCOL_VERSION: u32 = 7;
/// Largest message from a browser. A test case of a few minutes of dragging fits.
pub const MAX_MESSAGE_BYTES: usize = 2 << 20;
/// Binary frame: the camera image, a JPEG file of 480×480.
pub const BINARY_CAMERA_JPEG: u8 = 1;
/// Binary frame: the observation, 2×84×84 bytes, row-major, channel 0 first.
pub const BINARY_OBSERVATION: u8 = 2;
/// Binary frame: a part of the trial's course.
pub const BINARY_COURSE: u8 = 3;
