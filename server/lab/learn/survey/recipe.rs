//! All settings of a training run with surveys. The defaults are those of the shipped policy.

use serde::{Deserialize, Serialize};

use crate::learn::recipe::RecipeError;
use ferry_core::policy::{Architecture, Fusion};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SurveyRecipe {
    pub architecture: Architecture,
    /// Whether the policy knows what was observed earlier; otherwise only what the present image shows, for comparison.
    pub memory: bool,
    /// Generated mazes, of the families for training in turn, with seeds from 1 on.
    pub mazes: usize,
    /// Steps of an episode.
    pub step_limit: u32,
    /// Wall distance of the cells where the tool may be.
    pub clearance_m: f64,
    /// Share of the episodes that begin with what the last one had observed.
    pub keep_survey: f64,
    /// Discount per step.
    pub discount: f64,
    /// Reward per step of true distance gained.
    pub progress_reward: f64,
    /// Subtracted from an action's value for each visit of the cell ahead, as live.
    pub visit_penalty: f64,
    /// Updates that imitate the teacher, before those on the task.
    pub imitation_updates: u64,
    /// Weight of the imitation's loss beside that of the task.
    pub imitation_weight: f64,
    /// Share of random actions.
    pub exploration: f64,
    /// Decay of the averaged weights, which are examined and shipped.
    pub averaging: f64,
    /// Quantile fractions N and N' of the loss.
    pub fractions: usize,
    /// Learning rate of Adam in the first half.
    pub learning_rate: f64,
    /// Learning rate at the end; it falls in the second half.
    pub learning_rate_end: f64,
    /// Largest norm of a gradient.
    pub gradient_most: f64,
    /// Updates between copies to the target network.
    pub target_period: u64,
    /// Surveys per update.
    pub batch: usize,
    /// Episodes in parallel.
    pub lanes: usize,
    /// Size of the replay, in steps.
    pub capacity: usize,
    /// Steps in the replay before the first update.
    pub warm_up: usize,
    /// Total number of updates.
    pub updates: u64,
}

impl Default for SurveyRecipe {
    fn default() -> Self {
        Self {
            architecture: Architecture { fusion: Fusion::Survey, ..Architecture::default() },
            memory: true,
            mazes: 3000,
            step_limit: 400,
            clearance_m: 0.008,
            keep_survey: 0.3,
            discount: 0.9,
            progress_reward: 0.1,
            visit_penalty: 0.1,
            imitation_updates: 2500,
            imitation_weight: 0.1,
            exploration: 0.05,
            averaging: 0.998,
            fractions: 8,
            learning_rate: 1e-3,
            learning_rate_end: 1e-4,
            gradient_most: 10.0,
            target_period: 200,
            batch: 64,
            lanes: 64,
            capacity: 40_000,
            warm_up: 4000,
            updates: 8000,
        }
    }
}

impl SurveyRecipe {
    /// Checks every range; the error names the first wrong field.
    ///
    /// # Errors
    /// [`RecipeError`].
    pub fn check(&self) -> Result<(), RecipeError> {
        let ranges = [
            ("mazes", self.mazes as f64, 1.0, 1e5),
            ("step_limit", f64::from(self.step_limit), 10.0, 5000.0),
            ("clearance_m", self.clearance_m, 0.0, 0.02),
            ("keep_survey", self.keep_survey, 0.0, 1.0),
            ("discount", self.discount, 0.0, 1.0),
            ("progress_reward", self.progress_reward, 0.0, 1.0),
            ("visit_penalty", self.visit_penalty, 0.0, 1.0),
            ("imitation_updates", self.imitation_updates as f64, 0.0, 1e8),
            ("imitation_weight", self.imitation_weight, 0.0, 10.0),
            ("exploration", self.exploration, 0.0, 1.0),
            ("averaging", self.averaging, 0.0, 0.999_99),
            ("fractions", self.fractions as f64, 1.0, 64.0),
            ("learning_rate", self.learning_rate, 0.0, 0.1),
            ("learning_rate_end", self.learning_rate_end, 0.0, 0.1),
            ("gradient_most", self.gradient_most, 1e-3, 1e6),
            ("target_period", self.target_period as f64, 1.0, 1e6),
            ("batch", self.batch as f64, 1.0, 1024.0),
            ("lanes", self.lanes as f64, 1.0, 1024.0),
            ("capacity", self.capacity as f64, self.warm_up as f64, 1e6),
            ("warm_up", self.warm_up as f64, 2.0 * self.lanes as f64, 1e6),
            ("updates", self.updates as f64, 1.0, 1e8),
        ];
        RecipeError::check_ranges(&ranges)?;
        if self.architecture.fusion != Fusion::Survey || !self.architecture.quantiles {
            let (value, allowed) = ("changed".to_owned(), "a survey with quantiles, with --map generated".to_owned());
            return Err(RecipeError { field: "architecture", value, allowed });
        }
        Ok(())
    }
}
