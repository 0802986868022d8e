//! What is asked of a training.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::policy::Fusion;
use ferry_core::schema::Numbers2;
use ferry_lab::learn;

/// Recipe from which the settings start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum RecipeName {
    /// Learns one map in minutes.
    #[default]
    Quick,
    /// That of the shipped policies.
    Full,
    /// The paper's reward, fusion and returns.
    Paper,
}

/// How image, tool and goal come together in the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum FusionName {
    /// As a second channel of the image, as in the paper.
    Early,
    /// After the image's features.
    Late,
}

/// Settings that differ from the recipe, named as in `ferry train --set`. A missing one is the recipe's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TrainingSettings {
    /// Updates of the network.
    #[ts(type = "number | null")]
    #[schema(minimum = 1, maximum = 20000)]
    pub updates: Option<u64>,
    /// Learning rate of Adam in the first half.
    #[schema(minimum = 0, maximum = 0.1)]
    pub learning_rate: Option<f64>,
    /// Discount per step.
    #[schema(minimum = 0, maximum = 1)]
    pub discount: Option<f64>,
    /// Share of random actions.
    #[schema(minimum = 0, maximum = 1)]
    pub exploration: Option<f64>,
    /// Whether the network's noisy layers explore.
    pub noisy: Option<bool>,
    /// Reward per step of true distance gained.
    #[schema(minimum = 0, maximum = 1)]
    pub progress_reward: Option<f64>,
    /// Subtracted at each step.
    #[schema(minimum = 0, maximum = 1)]
    pub step_penalty: Option<f64>,
    /// Steps of a return.
    #[schema(minimum = 1, maximum = 20)]
    pub n_step: Option<u32>,
    pub fusion: Option<FusionName>,
}

/// Body of `POST /api/trainings`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct TrainingQuery {
    /// Name of a map, shipped or added.
    #[schema(example = "posts")]
    pub map: String,
    /// Name of the policy that it becomes: up to 40 of a to z, 0 to 9, - and _.
    #[schema(example = "my-policy", pattern = "^[a-z0-9][a-z0-9_-]{0,39}$")]
    pub name: String,
    #[ts(type = "number")]
    pub seed: u64,
    #[serde(default)]
    pub recipe: RecipeName,
    #[serde(default)]
    pub settings: TrainingSettings,
    /// Policy whose weights it starts from; `null`: random weights.
    #[serde(default)]
    pub start_from: Option<String>,
    /// Goal of the value maps; `null`: a place far from the others.
    #[serde(default)]
    #[schema(value_type = Option<Numbers2>)]
    pub goal_m: Option<[f64; 2]>,
}

impl From<RecipeName> for learn::RecipeName {
    fn from(name: RecipeName) -> Self {
        match name {
            RecipeName::Quick => Self::Quick,
            RecipeName::Full => Self::Full,
            RecipeName::Paper => Self::Paper,
        }
    }
}

impl From<learn::RecipeName> for RecipeName {
    fn from(name: learn::RecipeName) -> Self {
        match name {
            learn::RecipeName::Quick => Self::Quick,
            learn::RecipeName::Full => Self::Full,
            learn::RecipeName::Paper => Self::Paper,
        }
    }
}

impl From<FusionName> for Fusion {
    fn from(name: FusionName) -> Self {
        match name {
            FusionName::Early => Self::Early,
            FusionName::Late => Self::Late,
        }
    }
}

impl From<TrainingSettings> for learn::Settings {
    fn from(value: TrainingSettings) -> Self {
        let TrainingSettings {
            updates,
            learning_rate,
            discount,
            exploration,
            noisy,
            progress_reward,
            step_penalty,
            n_step,
            fusion,
        } = value;
        Self {
            updates,
            learning_rate,
            discount,
            exploration,
            noisy,
            progress_reward,
            step_penalty,
            n_step,
            fusion: fusion.map(Into::into),
        }
    }
}

impl From<learn::Settings> for TrainingSettings {
    fn from(value: learn::Settings) -> Self {
        let learn::Settings {
            updates,
            learning_rate,
            discount,
            exploration,
            noisy,
            progress_reward,
            step_penalty,
            n_step,
            fusion,
        } = value;
        let fusion = fusion.and_then(|fusion| match fusion {
            Fusion::Early => Some(FusionName::Early),
            Fusion::Late => Some(FusionName::Late),
            Fusion::Survey => None,
        });
        Self { updates, learning_rate, discount, exploration, noisy, progress_reward, step_penalty, n_step, fusion }
    }
}

impl From<TrainingQuery> for learn::TrainingQuery {
    fn from(value: TrainingQuery) -> Self {
        let TrainingQuery { map, name, seed, recipe, settings, start_from, goal_m } = value;
        let goal_m = goal_m.map(Into::into);
        Self { map, name, seed, recipe: recipe.into(), settings: settings.into(), start_from, goal_m }
    }
}

impl From<learn::TrainingQuery> for TrainingQuery {
    fn from(value: learn::TrainingQuery) -> Self {
        let learn::TrainingQuery { map, name, seed, recipe, settings, start_from, goal_m } = value;
        let goal_m = goal_m.map(|goal_m| goal_m.coords.into());
        Self { map, name, seed, recipe: recipe.into(), settings: settings.into(), start_from, goal_m }
    }
}
