//! What is asked of a training.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::learn::LibraryError;
use crate::learn::error::TrainingError;
use crate::learn::recipe::{Recipe, RecipeError, RecipeName};
use crate::learn::settings::Settings;
use crate::learn::terrain::TerrainError;
use ferry_core::geometry::Point2;
use ferry_core::map::{Map, MapError};
use ferry_core::policy::{Architecture, Fusion, Manifest, PolicyError};
use ferry_core::schema::Numbers2;

/// Largest number of cells of a map; an image of each is kept in memory.
const MOST_CELLS: usize = 6000;

/// Reads the fields of an object only: serde reads them from an array, too, without their names.
fn from_object<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<T, D::Error> {
    struct Object<T>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>> Visitor<'de> for Object<T> {
        type Value = T;

        fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
            to.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, fields: A) -> Result<T, A::Error> {
            T::deserialize(MapAccessDeserializer::new(fields))
        }
    }
    deserializer.deserialize_map(Object(PhantomData))
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
    #[serde(default, deserialize_with = "from_object")]
    pub settings: Settings,
    /// Policy whose weights it starts from; `null`: random weights.
    #[serde(default)]
    pub start_from: Option<String>,
    /// Goal of the value maps; `null`: a place far from the others.
    #[serde(default)]
    #[ts(type = "[number, number] | null")]
    #[schema(value_type = Option<Numbers2>)]
    pub goal_m: Option<Point2<f64>>,
}

/// Why a training is rejected or failed.
#[derive(Debug, thiserror::Error)]
pub enum QueryError {
    #[error("map: {0}")]
    Map(#[from] MapError),
    /// Too few free cells, or no path.
    #[error(transparent)]
    Terrain(#[from] TerrainError),
    #[error(
        "map {map:?} has {cells} places 1 cm apart, the limit for a training is {MOST_CELLS}; use a smaller map, or a policy \
         that needs no training, the explorer"
    )]
    TooLarge { map: String, cells: usize },
    #[error("settings: {0}")]
    Recipe(#[from] RecipeError),
    #[error("name: {0}")]
    Name(#[from] LibraryError),
    #[error("name: a training that has not ended has the name {name:?} already")]
    Taken { name: String },
    #[error("start_from: {0}")]
    Start(#[from] PolicyError),
    #[error(
        "start_from is {name:?}, a policy with a memory: it is trained on thousands of mazes (ferry train --map generated)"
    )]
    Memory { name: String },
    #[error("goal_m is ({}, {}), which is outside the workspace", goal_m.x, goal_m.y)]
    Goal { goal_m: Point2<f64> },
    #[error("{0}")]
    Training(#[from] TrainingError),
}

impl QueryError {
    /// The field of the query that is wrong.
    pub fn field(&self) -> String {
        match self {
            Self::Map(_) | Self::Terrain(_) | Self::TooLarge { .. } => "map".into(),
            Self::Recipe(error) => format!("settings.{}", error.field.trim_start_matches("architecture.")),
            Self::Name(_) | Self::Taken { .. } => "name".into(),
            Self::Start(_) | Self::Memory { .. } => "start_from".into(),
            Self::Goal { .. } => "goal_m".into(),
            Self::Training(_) => String::new(),
        }
    }
}

impl TrainingQuery {
    /// The recipe with the settings. A policy that it starts from decides about its network.
    ///
    /// # Errors
    /// [`QueryError::Recipe`], [`QueryError::Memory`].
    pub fn recipe(&self, start: Option<&Manifest>) -> Result<Recipe, QueryError> {
        self.settings.check().map_err(RecipeError::from)?;
        let mut recipe = Recipe::named(self.recipe);
        let Settings {
            updates,
            learning_rate,
            discount,
            exploration,
            noisy,
            progress_reward,
            step_penalty,
            n_step,
            fusion,
        } = self.settings;
        let fusion = fusion.map(Fusion::from);
        recipe.updates = updates.map_or(recipe.updates, u64::from);
        recipe.discount = discount.unwrap_or(recipe.discount);
        recipe.exploration = exploration.unwrap_or(recipe.exploration);
        recipe.progress_reward = progress_reward.unwrap_or(recipe.progress_reward);
        recipe.step_penalty = step_penalty.unwrap_or(recipe.step_penalty);
        recipe.n_step = n_step.map_or(recipe.n_step, |steps| steps as usize);
        if let Some(rate) = learning_rate {
            // The rate falls by the same factor.
            recipe.learning_rate_end *= rate / recipe.learning_rate;
            recipe.learning_rate = rate;
        }
        if let Some(manifest) = start {
            if manifest.architecture.fusion == Fusion::Survey {
                let name = self.start_from.clone().unwrap_or_default();
                return Err(QueryError::Memory { name });
            }
            if fusion.is_some_and(|fusion| fusion != manifest.architecture.fusion) {
                let allowed = "that of the policy it starts from".to_owned();
                return Err(RecipeError { field: "architecture.fusion", value: "another".to_owned(), allowed }.into());
            }
            recipe.architecture = Architecture { noisy: recipe.architecture.noisy, ..manifest.architecture };
        }
        recipe.architecture.noisy = noisy.unwrap_or(recipe.architecture.noisy);
        recipe.architecture.fusion = fusion.unwrap_or(recipe.architecture.fusion);
        if recipe.architecture.fusion == Fusion::Early {
            // Early fusion computes features for one goal.
            recipe.goals = 1;
        }
        recipe.check()?;
        Ok(recipe)
    }

    /// Refuses a map that is too large, and a goal outside it.
    ///
    /// # Errors
    /// [`QueryError::TooLarge`], [`QueryError::Goal`].
    pub fn check_map(&self, map: &Map, cells: usize) -> Result<(), QueryError> {
        if cells > MOST_CELLS {
            return Err(QueryError::TooLarge { map: map.name().to_owned(), cells });
        }
        match self.goal_m {
            Some(goal_m) if !map.workspace().contains(goal_m) => Err(QueryError::Goal { goal_m }),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::settings::FusionName;
    use ferry_core::policy::Policy;

    fn query() -> TrainingQuery {
        TrainingQuery {
            map: "open".into(),
            name: "mine".into(),
            seed: 1,
            recipe: RecipeName::Quick,
            settings: Settings::default(),
            start_from: None,
            goal_m: None,
        }
    }

    #[test]
    fn settings_change_the_recipe_and_a_wrong_one_is_named() {
        let settings = Settings { discount: Some(0.5), learning_rate: Some(2e-3), ..Settings::default() };
        let recipe = TrainingQuery { settings, ..query() }.recipe(None).unwrap();
        let rates = (recipe.learning_rate, recipe.learning_rate_end);
        assert_eq!((recipe.discount, rates), (0.5, (2e-3, 2.0 * Recipe::quick().learning_rate_end)));
        let early = Settings { fusion: Some(FusionName::Early), ..Settings::default() };
        assert_eq!(TrainingQuery { settings: early, ..query() }.recipe(None).unwrap().goals, 1);
        for (settings, field) in [
            (Settings { discount: Some(1.5), ..Settings::default() }, "settings.discount"),
            (Settings { updates: Some(0), ..Settings::default() }, "settings.updates"),
            (Settings { updates: Some(20_001), ..Settings::default() }, "settings.updates"),
            (Settings { learning_rate: Some(f64::NAN), ..Settings::default() }, "settings.learning_rate"),
        ] {
            assert_eq!(TrainingQuery { settings, ..query() }.recipe(None).unwrap_err().field(), field);
        }
    }

    #[test]
    fn settings_are_an_object() {
        let read = |settings: &str| {
            let text = format!(r#"{{"map": "posts", "name": "a", "seed": 1, "settings": {settings}}}"#);
            serde_json::from_str::<TrainingQuery>(&text)
        };
        assert_eq!(read(r#"{"updates": 7}"#).unwrap().settings.updates, Some(7));
        assert!(read("[7]").unwrap_err().to_string().contains("an object"));
    }

    #[test]
    fn a_policy_to_start_from_decides_about_the_network() {
        let [colon, explorer] = ["colon", "explorer"].map(|name| Policy::shipped(name).unwrap());
        let asked = TrainingQuery { start_from: Some("explorer".into()), ..query() };
        assert_eq!(asked.recipe(Some(explorer.manifest())).unwrap_err().field(), "start_from");
        let settings = Settings { fusion: Some(FusionName::Early), ..Settings::default() };
        let asked = TrainingQuery { settings, start_from: Some("colon".into()), ..query() };
        assert_eq!(asked.recipe(Some(colon.manifest())).unwrap_err().field(), "settings.fusion");
        assert!(query().recipe(Some(colon.manifest())).unwrap().architecture.noisy);
    }
}
