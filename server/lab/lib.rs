//! Trials in bulk: trainings, evaluations and recovery maps, with the queue of background jobs and the programs outside of
//! Ferry that may carry the bead. A module imports only from floors below it.
//!
//! - floor 0: [`changes`]: the changes of a list.
//! - floor 1: [`program`], [`jobs`]: questions to a program; the queue of background jobs.
//! - floor 2: [`learn`], [`evaluate`]: training; trials of an experiment.
//! - floor 3: [`recovery`]: disturbances from one moment.

pub mod changes;
pub mod evaluate;
pub mod jobs;
pub mod learn;
pub mod program;
pub mod recovery;
