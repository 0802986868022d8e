//! Scenarios that come with Ferry: the paper's examples.

use serde::Deserialize;

use super::Scenario;

#[derive(rust_embed::RustEmbed)]
#[folder = "../../assets/scenarios/"]
#[include = "*.json"]
struct Files;

/// A scenario with its description.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shipped {
    /// Description.
    pub about: String,
    pub scenario: Scenario,
}

/// The scenario could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum ShippedError {
    /// No shipped scenario has this name.
    #[error("scenario: {name:?} does not exist; the shipped ones are {}", Shipped::names().join(", "))]
    Unknown { name: String },
    /// A file could not be read.
    #[error("scenario: {path}: {reason}")]
    Unreadable {
        /// The file.
        path: String,
        reason: String,
    },
}

impl Shipped {
    /// Names of all shipped scenarios.
    pub fn names() -> Vec<String> {
        let mut names: Vec<String> =
            Files::iter().filter_map(|file| file.strip_suffix(".json").map(str::to_owned)).collect();
        names.sort();
        names
    }

    /// A shipped scenario by name.
    pub fn open(name: &str) -> Result<Self, ShippedError> {
        let file = Files::get(&format!("{name}.json"));
        let bytes = file.ok_or_else(|| ShippedError::Unknown { name: name.to_owned() })?.data;
        let mut reader = serde_json::Deserializer::from_slice(&bytes);
        let read = serde_path_to_error::deserialize(&mut reader);
        read.map_err(|error| ShippedError::Unreadable { path: name.to_owned(), reason: error.to_string() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_all_shipped_scenarios_and_rejects_unknown_names() {
        assert!(Shipped::names().len() >= 6);
        for name in Shipped::names() {
            let Shipped { about, scenario } = Shipped::open(&name).unwrap();
            assert!(!about.is_empty());
            scenario.parameters.check().unwrap();
            scenario.script.iter().for_each(|scripted| scripted.check().unwrap());
        }
        let error = Shipped::open("example-9").unwrap_err().to_string();
        assert!(error.contains("\"example-9\"") && error.contains("example-3"), "{error}");
    }
}
