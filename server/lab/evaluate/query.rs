//! The query of an evaluation, checked before anything runs.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;
use utoipa::openapi::schema::{Array, ArrayBuilder, ObjectBuilder, Type};

use super::variation::applied;
use super::{Setting, Variation, VariationError};
use ferry_core::map::{Library, Map, MapError};
use ferry_core::policy::PolicyError;
use ferry_core::scenario::descriptor::{FormField, Outside, PLAIN, whole};
use ferry_core::scenario::{ControllerName, Parameters, RlPolicy};

/// Maximum number of cells per evaluation: three controllers over 8 × 8 values of two parameters have 192.
pub const CELL_LIMIT: usize = 240;
/// Maximum number of trials per evaluation.
const TRIAL_LIMIT: u64 = 24_000;
/// Scripted disturbances per trial. With more, few trials end within their steps.
pub const DISTURBANCES: std::ops::RangeInclusive<u32> = 0..=10;

/// Body of `POST /api/evaluations`: every controller on every map with every number of disturbances, each on the
/// same starts, goals and seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct EvaluationQuery {
    /// Sub-controllers 2.
    #[schema(value_type = std::collections::BTreeSet<ControllerName>, min_items = 1)]
    pub controllers: Vec<ControllerName>,
    /// Names of maps, shipped or added.
    #[schema(value_type = std::collections::BTreeSet<String>, min_items = 1, example = json!(["posts"]))]
    pub maps: Vec<String>,
    /// Scripted disturbances per trial, 0 to 10.
    #[schema(schema_with = disturbances)]
    pub disturbances: Vec<u32>,
    /// Trials per cell, 1 to 1000.
    #[schema(minimum = 1, maximum = 1000)]
    pub episodes: u32,
    /// Seed of the trials.
    #[ts(type = "number")]
    pub seed: u64,
    /// Policy of the controller `rl`, as the parameter `rl_policy`.
    #[serde(default)]
    #[ts(type = "string")]
    #[schema(value_type = String, example = "auto")]
    pub rl_policy: RlPolicy,
    /// Name of a connected program, with the controller `program`.
    #[serde(default)]
    pub program: Option<String>,
    /// Parameters that take several values, at most two. Each combination has its cells.
    #[serde(default)]
    #[schema(max_items = 2)]
    pub vary: Vec<Variation>,
}

/// The derive has no limits for the items of a list.
fn disturbances() -> Array {
    let count = ObjectBuilder::new()
        .schema_type(Type::Integer)
        .minimum(Some(*DISTURBANCES.start()))
        .maximum(Some(*DISTURBANCES.end()));
    let about = "Scripted disturbances per trial, 0 to 10.";
    ArrayBuilder::new().items(count).unique_items(true).min_items(Some(1)).description(Some(about)).build()
}

/// The subject of one row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Sub-controller 2.
    pub controller: ControllerName,
    pub map: String,
    /// Scripted disturbances per trial.
    pub disturbances: u32,
    /// Name of the program, with the controller `program`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub program: Option<String>,
    /// What varied parameters are in this row.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub varied: Vec<Setting>,
}

impl Cell {
    /// The name of the controller or of the program.
    pub fn controller(&self) -> &str {
        self.program.as_deref().unwrap_or(self.controller.as_str())
    }
}

impl std::fmt::Display for Cell {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { map, disturbances, varied, .. } = self;
        write!(f, "{} on {map}, {disturbances} disturbances", self.controller())?;
        varied.iter().try_for_each(|setting| write!(f, ", {setting}"))
    }
}

/// Why a query is refused.
#[derive(Debug, thiserror::Error)]
pub enum QueryError {
    /// A list is empty, so there is nothing to run.
    #[error("{field} is empty, it must name at least one")]
    Empty { field: &'static str },
    #[error("{field}[{index}] is {value:?}, which is in the list already")]
    Twice { field: &'static str, index: usize, value: String },
    /// No such map.
    #[error("maps[{index}]: {error}")]
    Map {
        index: usize,
        /// Why the map was refused.
        error: MapError,
    },
    #[error("controllers[{index}] is {:?}: an evaluation asks no person and no robot client", .name.as_str())]
    Person { index: usize, name: ControllerName },
    /// It must be given with the controller `program`, and only then, and be connected.
    #[error("program is {}, {why}", .name.as_ref().map_or("missing".to_owned(), |name| format!("{name:?}")))]
    Program { name: Option<String>, why: &'static str },
    #[error("rl_policy: {0}")]
    Policy(#[from] PolicyError),
    /// Out of range.
    #[error("{field} is {value}, it must be {} to {}", .allowed.start(), .allowed.end())]
    Range { field: String, value: u32, allowed: std::ops::RangeInclusive<u32> },
    #[error(transparent)]
    Number(#[from] Outside),
    #[error("vary: {0}")]
    Vary(#[from] VariationError),
    /// More cells than one evaluation may have.
    #[error("controllers × maps × disturbances × values are {cells} cells, the limit is {CELL_LIMIT}")]
    TooManyCells { cells: usize },
    #[error("episodes is {episodes}, which makes {trials} trials in {cells} cells; the limit is {TRIAL_LIMIT}")]
    TooManyTrials { episodes: u32, cells: usize, trials: u64 },
}

impl QueryError {
    pub fn field(&self) -> String {
        match self {
            Self::Empty { field } => (*field).to_owned(),
            Self::Twice { field, index, .. } => format!("{field}[{index}]"),
            Self::Map { index, .. } => format!("maps[{index}]"),
            Self::Person { index, .. } => format!("controllers[{index}]"),
            Self::Program { .. } => "program".to_owned(),
            Self::Policy(_) => "rl_policy".to_owned(),
            Self::Range { field, .. } => field.clone(),
            Self::Number(outside) => outside.field.to_owned(),
            Self::Vary(_) => "vary".to_owned(),
            Self::TooManyCells { .. } => "maps".to_owned(),
            Self::TooManyTrials { .. } => "episodes".to_owned(),
        }
    }
}

impl EvaluationQuery {
    /// Its number with a range: the range check and the page's form come from here.
    pub const FIELDS: [FormField; 1] = [FormField {
        name: "episodes",
        label: "Episodes per cell",
        help: "Trials of each controller on each map: more of them narrow the intervals.",
        kind: whole(PLAIN, [1.0, 1000.0], 10.0),
    }];

    /// The cells of the query, with the controllers of a map next to each other.
    pub fn cells(&self) -> Result<Vec<Cell>, QueryError> {
        distinct("controllers", &self.controllers, |controller| controller.as_str().to_owned())?;
        let person = |(_, name): &(usize, &ControllerName)| matches!(name, ControllerName::You | ControllerName::Robot);
        if let Some((index, &name)) = self.controllers.iter().enumerate().find(person) {
            return Err(QueryError::Person { index, name });
        }
        let refused = |why| QueryError::Program { name: self.program.clone(), why };
        match (self.controllers.contains(&ControllerName::Program), &self.program) {
            (true, None) => return Err(refused("the controller \"program\" needs it")),
            (false, Some(_)) => return Err(refused("but \"program\" is not among the controllers")),
            _ => {}
        }
        distinct("maps", &self.maps, Clone::clone)?;
        distinct("disturbances", &self.disturbances, u32::to_string)?;
        let combinations = Variation::combinations(&self.vary)?;
        for varied in &combinations {
            applied(&Parameters::default(), varied).map_err(VariationError::from)?;
        }
        let cells = self.controllers.len() * self.maps.len() * self.disturbances.len() * combinations.len();
        if cells > CELL_LIMIT {
            return Err(QueryError::TooManyCells { cells });
        }
        for (index, &value) in self.disturbances.iter().enumerate() {
            if !DISTURBANCES.contains(&value) {
                return Err(QueryError::Range {
                    field: format!("disturbances[{index}]"),
                    value,
                    allowed: DISTURBANCES,
                });
            }
        }
        FormField::check(&Self::FIELDS, &[Some(self.episodes.into())])?;
        let trials = u64::from(self.episodes) * cells as u64;
        if trials > TRIAL_LIMIT {
            return Err(QueryError::TooManyTrials { episodes: self.episodes, cells, trials });
        }
        let mut made = Vec::with_capacity(cells);
        for map in &self.maps {
            for &disturbances in &self.disturbances {
                for varied in &combinations {
                    made.extend(self.controllers.iter().map(|&controller| Cell {
                        controller,
                        map: map.clone(),
                        disturbances,
                        program: self.program.clone().filter(|_| controller == ControllerName::Program),
                        varied: varied.clone(),
                    }));
                }
            }
        }
        Ok(made)
    }

    /// Its maps. The evaluation keeps them even if one is removed from the library later.
    ///
    /// # Errors
    /// [`QueryError::Map`].
    pub fn maps(&self, library: &Library) -> Result<Vec<Map>, QueryError> {
        // Names only: no client path touches the file system.
        let find =
            |(index, name): (usize, &String)| library.find(name).map_err(|error| QueryError::Map { index, error });
        self.maps.iter().enumerate().map(find).collect()
    }
}

/// Refuses a list that is empty or has an item twice.
fn distinct<T: PartialEq>(field: &'static str, list: &[T], text: impl Fn(&T) -> String) -> Result<(), QueryError> {
    if list.is_empty() {
        return Err(QueryError::Empty { field });
    }
    // No valid list is longer, so a long one is not compared item by item.
    let within = &list[..list.len().min(CELL_LIMIT + 1)];
    for (index, item) in within.iter().enumerate() {
        if within[..index].contains(item) {
            return Err(QueryError::Twice { field, index, value: text(item) });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn query() -> EvaluationQuery {
        EvaluationQuery {
            controllers: vec![ControllerName::Errt, ControllerName::Attractor],
            maps: vec!["posts".into(), "open".into()],
            disturbances: vec![0, 3],
            episodes: 30,
            seed: 1,
            rl_policy: RlPolicy::Auto,
            program: None,
            vary: Vec::new(),
        }
    }

    fn variation(text: &str) -> Variation {
        text.parse().unwrap()
    }

    #[test]
    fn each_value_has_the_controllers_side_by_side() {
        let varied = EvaluationQuery { vary: vec![variation("friction=0.1:0.3:3")], ..query() };
        let cells = varied.cells().unwrap();
        assert_eq!(cells.len(), 8 * 3);
        let names: Vec<String> =
            cells.iter().take(4).map(|cell| format!("{} {}", cell.varied[0], cell.controller())).collect();
        let expected = ["friction=0.1 errt", "friction=0.1 attractor", "friction=0.2 errt", "friction=0.2 attractor"];
        assert_eq!(names, expected);
    }

    #[test]
    fn controllers_of_a_map_are_side_by_side() {
        let cells = query().cells().unwrap();
        let names: Vec<_> = cells
            .iter()
            .map(|cell| format!("{} {} {}", cell.map, cell.disturbances, cell.controller.as_str()))
            .collect();
        let expected = [
            "posts 0 errt",
            "posts 0 attractor",
            "posts 3 errt",
            "posts 3 attractor",
            "open 0 errt",
            "open 0 attractor",
            "open 3 errt",
            "open 3 attractor",
        ];
        assert_eq!(names, expected);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_value() {
        let all = Map::shipped_names();
        for (bad, field, parts) in [
            (EvaluationQuery { controllers: vec![], ..query() }, "controllers", &["controllers is empty"][..]),
            (EvaluationQuery { controllers: vec![ControllerName::You], ..query() }, "controllers[0]", &["\"you\""]),
            (
                EvaluationQuery { controllers: vec![ControllerName::Program], ..query() },
                "program",
                &["program is missing"],
            ),
            (EvaluationQuery { program: Some("mine".into()), ..query() }, "program", &["\"mine\""]),
            (EvaluationQuery { maps: vec![], ..query() }, "maps", &["maps is empty"]),
            (EvaluationQuery { maps: vec!["posts".into(), "posts".into()], ..query() }, "maps[1]", &["\"posts\""]),
            (EvaluationQuery { maps: vec!["nowhere".into()], ..query() }, "maps[0]", &["nowhere", "colon", "posts"]),
            (EvaluationQuery { maps: vec!["../Cargo.toml".into()], ..query() }, "maps[0]", &["../Cargo.toml"]),
            (EvaluationQuery { disturbances: vec![0, 11], ..query() }, "disturbances[1]", &["is 11", "0 to 10"]),
            (EvaluationQuery { disturbances: vec![3, 3], ..query() }, "disturbances[1]", &["\"3\""]),
            (EvaluationQuery { episodes: 0, ..query() }, "episodes", &["episodes is 0", "1 to 1000"]),
            (EvaluationQuery { episodes: 1001, ..query() }, "episodes", &["1001"]),
            (
                EvaluationQuery { maps: all, vary: vec![variation("friction=0:1:20")], ..query() },
                "maps",
                &["720 cells", "240"],
            ),
            (EvaluationQuery { vary: vec![variation("friction=0:2:3")], ..query() }, "vary", &["friction is 2"]),
            (
                EvaluationQuery { episodes: 1000, vary: vec![variation("friction=0:1:5")], ..query() },
                "episodes",
                &["episodes is 1000", "40000 trials", "40 cells", "24000"],
            ),
        ] {
            let error = bad.cells().and_then(|_| bad.maps(&Library::default())).unwrap_err();
            assert_eq!(error.field(), field, "{error}");
            assert!(parts.iter().all(|part| error.to_string().contains(part)), "{error}");
        }
    }
}
