//! Trials in bulk: trainings, evaluations and recovery maps, with the queue of background jobs and the programs outside of
//! Ferry that may carry the bead. A module imports only from floors below it.
//!
//! - floor 0: [`program`], [`jobs`]: questions to a program; the queue of background jobs.
//! - floor 1: [`learn`], [`evaluate`]: training; trials of an experiment.
//! - floor 2: [`recovery`]: disturbances from one moment.

pub mod evaluate;
pub mod jobs;
pub mod learn;
pub mod program;
pub mod recovery;
