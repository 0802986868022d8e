//! Scenarios that come with Ferry: the paper's examples.

use serde::Deserialize;

use super::Scenario;

#[derive(rust_embed::RustEmbed)]
#[folder = "assets/scenarios/"]
#[include = "*.json"]
struct Files;

/// A scenario with a name and a sentence.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shipped {
    /// What it shows.
    pub about: String,
    /// The trial.
    pub scenario: Scenario,
}

/// No such scenario.
#[derive(Debug, thiserror::Error)]
pub enum ShippedError {
    /// Neither shipped nor a file.
    #[error("scenario: there is none named {name:?}; there are {}", Shipped::names().join(", "))]
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// A file that cannot be read.
    #[error("scenario: {path}: {reason}")]
    Unreadable {
        /// The file.
        path: String,
        /// Why.
        reason: String,
    },
}

impl Shipped {
    /// Names of all.
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
    fn all_are_read_and_others_are_named() {
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
