//! Evaluations: many random trials, as in the paper's experiment, summarised with confidence intervals.

mod comparison;
mod course;
mod engine;
mod evaluation;
mod experiment;
mod figure;
mod manner;
mod paper;
mod query;
mod queue;
mod report;
mod statistics;
mod summary;

pub use comparison::{Comparison, PairedMean};
pub(crate) use engine::gentle_pool;
pub use evaluation::{CellProgress, CellResult, Evaluation, Progress, Stage};
pub use experiment::{
    Episode, EvaluateError, Experiment, Recorders, Venue, Watch, episode, episode_in, run, run_one, unrecorded,
};
pub use figure::{FigureError, Trace};
pub use manner::Manner;
pub use paper::PaperRow;
pub use query::{CELL_LIMIT, Cell, DISTURBANCES, EvaluationQuery, QueryError};
pub use queue::{Queue, SubmitError};
pub use report::{Report, ReportError};
pub use statistics::wilson95;
pub use summary::{Failure, Row};
