//! Why a training stops.

use super::checkpoint::CheckpointError;
use super::recipe::RecipeError;
use super::sweep::SweepError;
use ferry_core::policy::PolicyError;

/// Why a run cannot start or continue.
#[derive(Debug, thiserror::Error)]
pub enum TrainingError {
    /// A number of the recipe is out of range.
    #[error("recipe: {0}")]
    Recipe(#[from] RecipeError),
    /// A map has no goals to train, or none that is held out.
    #[error("recipe: held_out_goals is {held_out}; map {map:?} then has no goals to train, or none that is held out")]
    NoGoals { map: String, held_out: f64 },
    /// The network failed.
    #[error("training: {0}")]
    Network(#[from] candle_core::Error),
    /// The policy could not be written.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// A checkpoint could not be read or written.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// The images of a map could not be taken.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// The loss or the gradient is not finite.
    #[error("training: at update {update} the loss is {loss} and the gradient {gradient}")]
    Diverged {
        update: u64,
        loss: f64,
        /// Norm of the gradient.
        gradient: f64,
    },
}
