//! Parameters by `NAME=VALUE`.

use serde_json::Value;

use super::descriptor::Kind;
use super::presets::{Preset, text};
use super::{Parameter, ParameterError, Parameters, RlPolicy};

/// Names at least this similar to an unknown one are suggested, from 0 to 1.
const SIMILAR: f64 = 0.85;
/// Maximum number of suggestions.
const SUGGESTIONS: usize = 3;

/// A `NAME=VALUE` that cannot be set.
#[derive(Debug, thiserror::Error)]
pub enum SetError {
    /// The text has no `=`.
    #[error("{0:?} must be NAME=VALUE")]
    Form(String),
    /// No parameter has this name.
    #[error("there is no parameter {name:?}; {}", suggestion(name))]
    Unknown { name: String },
    /// Not a value of the parameter's kind.
    #[error("{field} is {text:?}, it must be {allowed}")]
    Value {
        /// The parameter.
        field: &'static str,
        text: String,
        allowed: String,
    },
    /// No preset has this name.
    #[error("there is no preset {name:?}; there are {}", Preset::ALL.iter().map(|preset| preset.name).collect::<Vec<_>>().join(", "))]
    Preset { name: String },
    /// Outside its range.
    #[error(transparent)]
    Range(#[from] ParameterError),
    /// Serde could not write or read the parameters.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

impl Parameters {
    /// These parameters with changes, each as `NAME=VALUE` or `preset=NAME`. A later change replaces an earlier one.
    pub fn with(&self, changes: &[String]) -> Result<Self, SetError> {
        let mut values = serde_json::to_value(self)?;
        for change in changes {
            let (name, text) = split(change)?;
            if name == "preset" {
                let preset = Preset::named(text).ok_or_else(|| SetError::Preset { name: text.to_owned() })?;
                for change in preset.changes() {
                    set(&mut values, &change)?;
                }
            } else {
                set(&mut values, change)?;
            }
        }
        let parameters: Self = serde_json::from_value(values)?;
        parameters.check()?;
        Ok(parameters)
    }
}

impl Parameters {
    /// What differs from the defaults, each as `NAME=VALUE`; [`Self::with`] makes these parameters from them.
    pub fn changes(&self) -> Vec<String> {
        // Plain data always serialises.
        let [own, defaults] = [self, &Self::default()].map(|one| serde_json::to_value(one).unwrap_or_default());
        let names = Self::ALL.iter().map(|parameter| parameter.name);
        names.filter(|name| own[*name] != defaults[*name]).map(|name| format!("{name}={}", text(&own[name]))).collect()
    }
}

impl Parameter {
    /// # Errors
    /// [`SetError::Unknown`].
    pub fn named(name: &str) -> Result<&'static Self, SetError> {
        let found = Parameters::ALL.iter().find(|parameter| parameter.name == name);
        found.ok_or_else(|| SetError::Unknown { name: name.to_owned() })
    }
}

fn split(change: &str) -> Result<(&str, &str), SetError> {
    change.split_once('=').ok_or_else(|| SetError::Form(change.to_owned()))
}

fn set(values: &mut Value, change: &str) -> Result<(), SetError> {
    let (name, text) = split(change)?;
    let (field, value) = parsed(name, text)?;
    values[field] = value;
    Ok(())
}

fn parsed(name: &str, text: &str) -> Result<(&'static str, Value), SetError> {
    let parameter = Parameter::named(name)?;
    let field = parameter.name;
    let before = match parameter.kind {
        Kind::Number(number) if number.whole => "a whole number, ",
        Kind::Number(_) => "a number, ",
        Kind::Choice(_) | Kind::Policy => "one of ",
        Kind::Flag => "",
    };
    let refused = || SetError::Value { field, text: text.to_owned(), allowed: format!("{before}{}", parameter.kind) };
    let value = match parameter.kind {
        Kind::Number(number) => {
            let value: f64 = text.parse().map_err(|_| refused())?;
            // Checked here, because the type of the field would refuse it without naming the range.
            parameter.check_range(value, number.range[1])?;
            match number.whole {
                true if value.fract() != 0.0 => return Err(refused()),
                true => (value as u64).into(),
                false => value.into(),
            }
        }
        Kind::Flag => text.parse::<bool>().map_err(|_| refused())?.into(),
        Kind::Choice(options) if options.iter().any(|(option, _)| *option == text) => text.into(),
        Kind::Choice(_) => return Err(refused()),
        Kind::Policy => text.parse::<RlPolicy>().map_err(|_| refused())?.to_string().into(),
    };
    Ok((field, value))
}

/// The most similar names, or all of them.
fn suggestion(name: &str) -> String {
    let names = || Parameters::ALL.iter().map(|parameter| parameter.name);
    let mut similar: Vec<_> = names().map(|known| (strsim::jaro_winkler(known, name), known)).collect();
    similar.retain(|(similarity, _)| *similarity >= SIMILAR);
    similar.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let nearest: Vec<_> = similar.into_iter().take(SUGGESTIONS).map(|(_, known)| known).collect();
    match nearest.as_slice() {
        [] => format!("there are {}", names().collect::<Vec<_>>().join(", ")),
        nearest => format!("did you mean {}?", nearest.join(" or ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(change: &str) -> String {
        Parameters::default().with(&[change.to_owned()]).unwrap_err().to_string()
    }

    #[test]
    fn values_are_set_by_name() {
        let changes = ["friction=.3", "errt_ways=4", "rl_shield=false", "attractor_law=literal", "friction=0.4"];
        let found = Parameters::default().with(&changes.map(str::to_owned)).unwrap();
        let expected = Parameters {
            friction: 0.4,
            errt_ways: 4,
            rl_shield: false,
            attractor_law: crate::scenario::AttractorLaw::Literal,
            ..Parameters::default()
        };
        assert_eq!(found, expected);
        // Both limits apply together, in any order.
        let together = ["fetch_radius_m=0.15", "threshold_m=0.2"].map(str::to_owned);
        assert_eq!(Parameters::default().with(&together).unwrap().fetch_radius_m, 0.15);
    }

    #[test]
    fn refusals_name_field_value_and_range() {
        assert_eq!(refusal("friction"), "\"friction\" must be NAME=VALUE");
        assert_eq!(refusal("frictoin=1"), "there is no parameter \"frictoin\"; did you mean friction?");
        assert!(refusal("q=1").starts_with("there is no parameter \"q\"; there are block_orientation, "));
        assert_eq!(refusal("tool_height_m=0.3"), "tool_height_m is 0.3, it must be 0.09 to 0.2 m");
        assert_eq!(refusal("tool_height_m=high"), "tool_height_m is \"high\", it must be a number, 0.09 to 0.2 m");
        assert_eq!(refusal("friction=nan"), "friction is NaN, it must be 0 to 1");
        assert_eq!(refusal("obstacle_level=300"), "obstacle_level is 300, it must be 50 to 199");
        assert_eq!(refusal("errt_ways=2.5"), "errt_ways is \"2.5\", it must be a whole number, 1 to 20");
        assert_eq!(refusal("rl_shield=1"), "rl_shield is \"1\", it must be true or false");
        assert_eq!(
            refusal("rl_policy=best@1"),
            "rl_policy is \"best@1\", it must be one of auto, colon, general, explorer, or NAME or NAME@HASH of an added \
             policy"
        );
        assert_eq!(
            refusal("fetch_radius_m=0.15"),
            "fetch_radius_m is 0.15, it must be 0.002 to 0.1 m (at most threshold_m)"
        );
    }
}
