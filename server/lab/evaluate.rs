//! Evaluations: many random trials, as in the paper's experiment, summarised with confidence intervals.

mod comparison;
mod course;
mod evaluation;
mod evaluations;
mod experiment;
mod figure;
mod job;
mod manner;
mod paper;
mod part;
mod plan;
mod query;
mod regression;
mod report;
mod shard;
mod statistics;
mod summary;
pub mod tracking;
mod variation;

pub use comparison::{Comparison, PairedMean};
pub use evaluation::{CellProgress, CellResult, Evaluation, Progress};
pub use evaluations::{Evaluations, SubmitError};
pub use experiment::{
    EPISODES, Episode, EvaluateError, Experiment, Recorders, Venue, Watch, episode, episode_in, run, run_one,
    run_trials, unrecorded,
};
pub use figure::{FigureError, Trace};
pub use manner::Manner;
pub use paper::PaperRow;
pub use part::{Merged, Part, merge};
pub use plan::{Contender, Plan, PlanError};
pub use query::{CELL_LIMIT, Cell, DISTURBANCES, EvaluationQuery, QueryError};
pub use regression::{Baseline, BaselineError, Change, ERROR_RATE, Trials};
pub use report::{Report, ReportError, html_document};
pub use shard::{Machine, MergeError, PartError, Piece, Shard, ShardError, check_all, read_part};
pub use statistics::{LEVEL, PairedCounts, corrected_level, wilson, wilson95};
pub use summary::{Failure, Row};
pub use variation::{Setting, VARIED_MOST, Variation, VariationError};
