//! Recovery maps: from one moment, many disturbances are tried under each controller. They show where the bead can be put,
//! or how hard it can be pushed, and still be delivered.

mod attempt;
mod basin;
mod findings;
mod grid;
mod job;
mod part;
mod plan;
mod query;
mod report;
mod spot;
mod subject;
mod survey;

pub use attempt::{Outcome, Tried};
pub use basin::{Basin, BasinDifference};
pub use findings::{Cell, Findings};
pub use job::{Recoveries, RecoveryJob, SubmitRecoveryError};
pub use part::{MergedRecovery, RecoveryPart, merge_recovery};
pub use plan::{RecoveryPlan, RecoveryPlanError};
pub use query::{Kind, RecoveryError, RecoveryQuery, UnknownKind};
pub use report::{CellRow, Report};
pub use spot::Spot;
pub use subject::Subject;
pub use survey::{Recorders, Recovery, Start, unrecorded};
