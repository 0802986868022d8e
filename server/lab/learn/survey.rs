//! Training of a policy for mazes it has never seen: episodes on the lattice of generated mazes, imitation of a planner
//! that knows only what the policy knows, then Rainbow-IQN on the task itself.

mod episode;
mod examination;
mod lattice;
mod learner;
mod recipe;
mod replay;
mod run;
mod teacher;
#[cfg(test)]
mod tests;

pub use examination::{examine, examine_teacher};
pub use lattice::MazeLattice;
pub use recipe::SurveyRecipe;
pub use run::SurveyRun;
