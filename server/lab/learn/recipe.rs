//! All settings of a training run. The defaults are those of the shipped policies. Each part of Rainbow-IQN and each
//! deviation from the paper can be switched.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::goals::GoalSet;
use super::settings::{FusionName, Settings};
use ferry_core::policy::{Architecture, Fusion};
use ferry_core::scenario::Parameters;
use ferry_core::scenario::descriptor::Outside;

/// Steps of an episode (paper, §IV-A).
pub const EPISODE_STEPS: u32 = 150;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Recipe {
    /// Parts of the network.
    pub architecture: Architecture,
    /// Double Q-learning (van Hasselt et al. 2016): the trained network chooses, the target network evaluates.
    pub double: bool,
    /// Prioritised replay (Schaul et al. 2016); 0 is uniform.
    pub priority_exponent: f64,
    /// Initial exponent β of the importance weights; it rises to 1.
    pub importance_start: f64,
    /// Steps of a return, 1 to 20; Rainbow has 3.
    pub n_step: usize,
    /// Discount per step.
    pub discount: f64,
    /// Reward per step of geodesic distance gained; the paper has none.
    pub progress_reward: f64,
    /// Subtracted at each step.
    pub step_penalty: f64,
    /// Whether a timeout counts as a failure for the learner (as in the paper), or the return continues beyond it.
    pub timeout_fails: bool,
    /// Wall distance in the image below which an episode ends; 0 as in the paper.
    pub clearance_m: f64,
    /// How far walls close in, in metres. Above 0, each map is learned at rest and at moments of a contraction
    /// ([`wall_waves_m`](super::terrain::wall_waves_m)).
    pub wall_amplitude_m: f64,
    /// Images per update.
    pub images: usize,
    /// Goals for which each image is learned.
    pub goals: usize,
    /// Share of these goals that are drawn anywhere.
    pub uniform_goals: f64,
    /// Share of these goals that the episode reached later (Andrychowicz et al. 2017).
    pub future_goals: f64,
    /// Share of the map, in squares of 4 cm, in which no goal is trained. The last examination has goals there, too.
    pub held_out_goals: f64,
    /// Share of random actions, in addition to the noisy layers.
    pub exploration: f64,
    /// Decay of the averaged weights, which are evaluated and shipped; 0 disables averaging.
    pub averaging: f64,
    /// Quantile fractions N and N' of the loss.
    pub fractions: usize,
    /// Quantile fractions K for choosing actions in training.
    pub choosing_fractions: usize,
    /// Learning rate of Adam (Kingma & Ba 2015) in the first half.
    pub learning_rate: f64,
    /// Learning rate at the end; it falls in the second half.
    pub learning_rate_end: f64,
    /// Largest norm of a gradient; longer ones are clipped.
    pub gradient_most: f64,
    /// Updates between copies to the target network.
    pub target_period: u64,
    /// Episodes in parallel.
    pub lanes: usize,
    /// Updates per step of all lanes.
    pub updates_per_step: usize,
    /// Size of the replay, in transitions.
    pub capacity: usize,
    /// Transitions before the first update.
    pub warm_up: usize,
    /// Total number of updates.
    pub updates: u64,
}

/// Recipe from which the settings start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[ts(rename_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum RecipeName {
    /// Learns one map in minutes.
    #[default]
    Quick,
    /// That of the shipped policies.
    Full,
    /// The paper's reward, fusion and returns.
    Paper,
    /// Learns a map of at most 60 cells, such as `toy`, in seconds.
    Toy,
}

impl RecipeName {
    /// All, each with its label on the page and what it is.
    pub const ALL: [(Self, &str, &str); 4] = [
        (Self::Quick, "Quick", "Learns one map in minutes."),
        (Self::Full, "Full", "That of the shipped policies. It takes half as long again."),
        (Self::Paper, "Paper", "Rewards, fusion and returns of the paper: slower to learn."),
        (Self::Toy, "Toy", "Learns the map toy in 15 seconds. Larger maps need another recipe."),
    ];
}

impl std::str::FromStr for RecipeName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "quick" => Ok(Self::Quick),
            "full" => Ok(Self::Full),
            "paper" => Ok(Self::Paper),
            "toy" => Ok(Self::Toy),
            _ => Err("it must be quick, full, paper or toy".to_owned()),
        }
    }
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            architecture: Architecture::default(),
            double: true,
            priority_exponent: 0.5,
            importance_start: 0.4,
            n_step: 1,
            discount: 0.9,
            progress_reward: 0.1,
            step_penalty: 0.0,
            timeout_fails: false,
            clearance_m: 0.008,
            wall_amplitude_m: 0.0,
            images: 32,
            goals: 16,
            uniform_goals: 0.5,
            future_goals: 0.1,
            held_out_goals: 0.0,
            exploration: 0.05,
            averaging: 0.998,
            fractions: 8,
            choosing_fractions: 8,
            learning_rate: 1e-3,
            learning_rate_end: 1e-4,
            gradient_most: 10.0,
            target_period: 100,
            lanes: 32,
            updates_per_step: 2,
            capacity: 100_000,
            warm_up: 2000,
            updates: 12_000,
        }
    }
}

/// A setting of a recipe that is not allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}, it must be {allowed}")]
pub struct RecipeError {
    /// Name of the wrong field.
    pub field: &'static str,
    pub value: String,
    pub allowed: String,
}

impl From<Outside> for RecipeError {
    fn from(Outside { field, value, range: [least, most] }: Outside) -> Self {
        Self { field, value: value.to_string(), allowed: format!("{least} to {most}") }
    }
}

impl RecipeError {
    /// Checks numbers, each with its name and its range; the error names the first that is outside.
    ///
    /// # Errors
    /// [`RecipeError`].
    pub fn check_ranges(ranges: &[(&'static str, f64, f64, f64)]) -> Result<(), Self> {
        match ranges.iter().find(|(_, value, min, max)| !(*min..=*max).contains(value)) {
            Some(&(field, value, min, max)) => Err(Outside { field, value, range: [min, max] }.into()),
            None => Ok(()),
        }
    }
}

impl Recipe {
    /// The recipe of a name.
    pub fn named(name: RecipeName) -> Self {
        match name {
            RecipeName::Quick => Self::quick(),
            RecipeName::Full => Self::default(),
            RecipeName::Paper => Self::paper(),
            RecipeName::Toy => Self::toy(),
        }
    }

    /// A step costs what progress gives: along the shortest path both cancel, and the value of a place falls with its
    /// distance to the goal, over the whole map. With a greater penalty or discount, aimless steps cost more than a wall,
    /// and on a long maze the policy learns to drive into one. With fewer updates the policy arrives, too, but the values far
    /// from the goal are not yet in order.
    pub fn quick() -> Self {
        Self { discount: 0.96, step_penalty: 0.1, updates: 10_000, ..Self::default() }
    }

    /// For a map of at most 60 cells. Its paths are short, so the goal is felt everywhere with a smaller discount, and
    /// progress may count more. Few images for an update, few lanes, a large rate and a target that is copied often use
    /// the seconds best.
    pub fn toy() -> Self {
        Self {
            discount: 0.8,
            progress_reward: 0.3,
            step_penalty: 0.3,
            images: 6,
            exploration: 0.3,
            averaging: 0.98,
            fractions: 4,
            choosing_fractions: 4,
            learning_rate: 3e-3,
            target_period: 25,
            lanes: 8,
            capacity: 5000,
            warm_up: 200,
            updates: 1000,
            ..Self::default()
        }
    }

    /// The paper's reward and fusion: ±1 at the ends and 0 between, both channels into the trunk, three-step returns,
    /// the episodes' own goals, no exploration except the noisy layers, weights without averaging.
    pub fn paper() -> Self {
        let architecture = Architecture { fusion: Fusion::Early, ..Architecture::default() };
        Self {
            architecture,
            n_step: 3,
            discount: 0.99,
            progress_reward: 0.0,
            timeout_fails: true,
            clearance_m: 0.0,
            images: 128,
            goals: 1,
            uniform_goals: 0.0,
            future_goals: 0.0,
            exploration: 0.0,
            averaging: 0.0,
            learning_rate: 1e-4,
            ..Self::default()
        }
    }

    /// The goals that are trained.
    pub fn trained_goals(&self) -> GoalSet {
        if self.held_out_goals > 0.0 { GoalSet::Trained { held_out: self.held_out_goals } } else { GoalSet::All }
    }

    /// Checks every range; the error names the first wrong field.
    ///
    /// # Errors
    /// [`RecipeError`].
    pub fn check(&self) -> Result<(), RecipeError> {
        // Early fusion computes features for one goal.
        let max_goals = if self.architecture.fusion == Fusion::Early { 1.0 } else { 256.0 };
        let most_amplitude_m = 0.25 * Parameters::default().peristalsis_wavelength_m;
        let ranges = [
            ("priority_exponent", self.priority_exponent, 0.0, 1.0),
            ("importance_start", self.importance_start, 0.0, 1.0),
            ("clearance_m", self.clearance_m, 0.0, 0.02),
            ("wall_amplitude_m", self.wall_amplitude_m, 0.0, most_amplitude_m),
            ("images", self.images as f64, 1.0, 1024.0),
            ("goals", self.goals as f64, 1.0, max_goals),
            ("uniform_goals", self.uniform_goals, 0.0, 1.0),
            ("future_goals", self.future_goals, 0.0, 1.0 - self.uniform_goals),
            ("held_out_goals", self.held_out_goals, 0.0, 0.5),
            ("averaging", self.averaging, 0.0, 0.999_99),
            ("fractions", self.fractions as f64, 1.0, 64.0),
            ("choosing_fractions", self.choosing_fractions as f64, 1.0, 64.0),
            ("learning_rate_end", self.learning_rate_end, 0.0, 0.1),
            ("gradient_most", self.gradient_most, 1e-3, 1e6),
            ("target_period", self.target_period as f64, 1.0, 1e6),
            ("lanes", self.lanes as f64, 1.0, 1024.0),
            ("updates_per_step", self.updates_per_step as f64, 1.0, 64.0),
            ("capacity", self.capacity as f64, self.warm_up as f64, 1e7),
            ("warm_up", self.warm_up as f64, self.images as f64, 1e6),
            ("updates", self.updates as f64, 1.0, 1e8),
        ];
        // A run from the command line may be longer than one that a client starts.
        Settings { updates: None, ..Settings::from(self) }.check()?;
        RecipeError::check_ranges(&ranges)?;
        if self.architecture.fusion == Fusion::Survey {
            let (value, allowed) = ("survey".to_owned(), "early or late, except with --map generated".to_owned());
            return Err(RecipeError { field: "architecture.fusion", value, allowed });
        }
        Ok(())
    }
}

impl From<&Recipe> for Settings {
    fn from(recipe: &Recipe) -> Self {
        Self {
            updates: Some(u32::try_from(recipe.updates).unwrap_or(u32::MAX)),
            learning_rate: Some(recipe.learning_rate),
            discount: Some(recipe.discount),
            exploration: Some(recipe.exploration),
            noisy: Some(recipe.architecture.noisy),
            progress_reward: Some(recipe.progress_reward),
            step_penalty: Some(recipe.step_penalty),
            n_step: Some(u32::try_from(recipe.n_step).unwrap_or(u32::MAX)),
            fusion: match recipe.architecture.fusion {
                Fusion::Early => Some(FusionName::Early),
                Fusion::Late => Some(FusionName::Late),
                Fusion::Survey => None,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accepts_all_recipes_and_names_fields_out_of_range() {
        for (name, label, _) in RecipeName::ALL {
            Recipe::named(name).check().unwrap();
            assert_eq!(label.to_lowercase().parse(), Ok(name));
        }
        let bad = Recipe { discount: f64::NAN, ..Recipe::default() };
        assert_eq!(bad.check().unwrap_err().field, "discount");
        let early = Recipe { goals: 16, ..Recipe::paper() };
        assert_eq!(early.check().unwrap_err().to_string(), "goals is 16, it must be 1 to 1");
    }
}
