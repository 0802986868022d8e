//! A parameter that takes several values in one evaluation.

use std::ops::RangeInclusive;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::scenario::{Kind, Parameter, Parameters, SetError};

/// Number of values of one parameter.
const COUNTS: RangeInclusive<u32> = 2..=20;
/// Largest number of parameters that vary together: more have no plot.
pub const VARIED_MOST: usize = 2;

/// A parameter with evenly spaced values, ends included.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Variation {
    /// Name of a parameter that is a number.
    #[schema(example = "friction")]
    pub name: String,
    /// First value, in the unit of the name.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values, 2 to 20.
    #[schema(minimum = 2, maximum = 20)]
    pub count: u32,
}

/// A varied parameter's value in one row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Setting {
    pub name: String,
    pub value: f64,
}

impl std::fmt::Display for Setting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}={}", self.name, self.value)
    }
}

/// Why variations are refused.
#[derive(Debug, thiserror::Error)]
pub enum VariationError {
    #[error("{0:?} must be NAME=FROM:TO:COUNT, for example friction=0.1:0.4:4")]
    Form(String),
    #[error("{name} is not a number, so it has no values in between")]
    NotANumber { name: String },
    #[error("{name}: the number of values is {count}, it must be {} to {}", COUNTS.start(), COUNTS.end())]
    Count { name: String, count: u32 },
    #[error("{name}: {value} comes twice; use fewer values or a wider range")]
    Twice { name: String, value: f64 },
    #[error("{name} varies twice")]
    Again { name: String },
    #[error("{0} parameters vary, at most {VARIED_MOST} can")]
    TooMany(usize),
    #[error(transparent)]
    Set(#[from] SetError),
}

impl Setting {
    /// All settings of a row in one line, empty without any.
    pub fn line(settings: &[Self]) -> String {
        settings.iter().map(Self::to_string).collect::<Vec<_>>().join(" ")
    }
}

impl FromStr for Variation {
    type Err = VariationError;

    fn from_str(text: &str) -> Result<Self, VariationError> {
        let parse = || {
            let (name, range) = text.split_once('=')?;
            let mut parts = range.split(':');
            let mut part = || parts.next();
            let (from, to, count) = (part()?.parse().ok()?, part()?.parse().ok()?, part()?.parse().ok()?);
            parts.next().is_none().then(|| Self { name: name.to_owned(), from, to, count })
        };
        parse().ok_or_else(|| VariationError::Form(text.to_owned()))
    }
}

impl Variation {
    /// Its values. Those of a whole number are rounded.
    fn settings(&self) -> Result<Vec<Setting>, VariationError> {
        let Self { name, from, to, count } = self;
        let parameter = Parameter::named(name)?;
        let Kind::Number(number) = parameter.kind else {
            return Err(VariationError::NotANumber { name: name.clone() });
        };
        if !COUNTS.contains(count) {
            return Err(VariationError::Count { name: name.clone(), count: *count });
        }
        let last = f64::from(count - 1);
        let value = |index: u32| {
            let value = from + (to - from) * f64::from(index) / last;
            // Twelve digits: a sum of binary fractions has more, and they would be in all tables.
            let rounded = format!("{value:.11e}").parse().unwrap_or(value);
            if number.whole { rounded.round() } else { rounded }
        };
        let values: Vec<f64> = (0..*count).map(value).collect();
        if let Some(twice) = values.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(VariationError::Twice { name: name.clone(), value: twice[0] });
        }
        Ok(values.into_iter().map(|value| Setting { name: name.clone(), value }).collect())
    }

    /// Every combination of the values, the last parameter changing first; one empty combination without parameters.
    ///
    /// # Errors
    /// [`VariationError`]. Whether a value is allowed is checked when it is set.
    pub fn combinations(variations: &[Self]) -> Result<Vec<Vec<Setting>>, VariationError> {
        if variations.len() > VARIED_MOST {
            return Err(VariationError::TooMany(variations.len()));
        }
        let mut all = vec![Vec::new()];
        for (index, variation) in variations.iter().enumerate() {
            if variations[..index].iter().any(|other| other.name == variation.name) {
                return Err(VariationError::Again { name: variation.name.clone() });
            }
            let settings = variation.settings()?;
            let with = |before: &Vec<Setting>| -> Vec<Vec<Setting>> {
                settings.iter().map(|setting| before.iter().chain([setting]).cloned().collect()).collect()
            };
            all = all.iter().flat_map(with).collect();
        }
        Ok(all)
    }
}

/// Parameters with the settings of a row.
///
/// # Errors
/// A value is outside its range.
pub fn applied(parameters: &Parameters, settings: &[Setting]) -> Result<Parameters, SetError> {
    parameters.with(&settings.iter().map(Setting::to_string).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(variations: &[&str]) -> Result<Vec<String>, VariationError> {
        let variations: Vec<Variation> = variations.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
        let combinations = Variation::combinations(&variations)?;
        combinations
            .iter()
            .map(|settings| Ok(applied(&Parameters::default(), settings).map(|_| Setting::line(settings))?))
            .collect()
    }

    #[test]
    fn values_are_even_and_readable() {
        assert_eq!(texts(&[]).unwrap(), [""]);
        let expected = ["friction=0.1", "friction=0.2", "friction=0.3", "friction=0.4"];
        assert_eq!(texts(&["friction=0.1:0.4:4"]).unwrap(), expected);
        assert_eq!(texts(&["errt_ways=1:4:3"]).unwrap(), ["errt_ways=1", "errt_ways=3", "errt_ways=4"]);
        let two = texts(&["friction=0.4:0.2:2", "tool_height_m=0.1:0.12:2"]).unwrap();
        let expected = [
            "friction=0.4 tool_height_m=0.1",
            "friction=0.4 tool_height_m=0.12",
            "friction=0.2 tool_height_m=0.1",
            "friction=0.2 tool_height_m=0.12",
        ];
        assert_eq!(two, expected);
    }

    #[test]
    fn refusals_name_the_parameter_and_the_value() {
        for (bad, parts) in [
            (&["friction"][..], &["\"friction\"", "NAME=FROM:TO:COUNT"][..]),
            (&["friction=0.1:0.2"], &["NAME=FROM:TO:COUNT"]),
            (&["friction=0.1:0.2:3:4"], &["NAME=FROM:TO:COUNT"]),
            (&["frictoin=0.1:0.2:3"], &["did you mean friction?"]),
            (&["rl_shield=0:1:2"], &["rl_shield is not a number"]),
            (&["friction=0.1:0.2:1"], &["friction", "1", "2 to 20"]),
            (&["friction=0.1:0.2:21"], &["21", "2 to 20"]),
            (&["errt_ways=1:2:4"], &["errt_ways: 1 comes twice"]),
            (&["friction=0.2:0.2:2"], &["friction: 0.2 comes twice"]),
            (&["friction=0.5:1.5:3"], &["friction is 1.5, it must be 0 to 1"]),
            (&["friction=nan:1:3"], &["friction is NaN"]),
            (&["friction=0:1:2", "friction=0:1:2"], &["friction varies twice"]),
            (&["friction=0:1:2", "errt_ways=1:2:2", "drag_n_s_m=0:1:2"], &["3 parameters vary, at most 2"]),
        ] {
            let error = texts(bad).unwrap_err().to_string();
            assert!(parts.iter().all(|part| error.contains(part)), "{error}");
        }
    }
}
