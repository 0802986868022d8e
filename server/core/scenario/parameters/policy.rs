//! The parameter `rl_policy`.

use std::fmt::{Display, Formatter};
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::names::is_name;

/// Which trained policy runs. As text: `auto`, the name of a shipped policy, or that of an added one, `NAME` or
/// `NAME@HASH`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum RlPolicy {
    /// The policy trained on the map, otherwise the explorer.
    #[default]
    Auto,
    /// Trained on the map `colon` only.
    Colon,
    /// Trained on several maps.
    General,
    /// Trained on generated mazes; it remembers what the camera has seen.
    Explorer,
    /// One that a user trained or uploaded.
    Added(AddedPolicy),
}

/// A policy that a user trained or uploaded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AddedPolicy {
    /// Name, for people: it may change.
    pub name: String,
    /// Hash of the file. A session adds it when it is missing, so that links and logs never mean another policy.
    pub hash: Option<u64>,
}

impl RlPolicy {
    /// All but the added ones, with their labels on the page.
    pub const OPTIONS: [(&'static str, &'static str); 4] =
        [("auto", "Auto: by map"), ("colon", "Colon"), ("general", "General"), ("explorer", "Explorer")];
}

impl Display for RlPolicy {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Colon => f.write_str("colon"),
            Self::General => f.write_str("general"),
            Self::Explorer => f.write_str("explorer"),
            Self::Added(added) => added.fmt(f),
        }
    }
}

impl Display for AddedPolicy {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self.hash {
            Some(hash) => write!(f, "{}@{hash:016x}", self.name),
            None => f.write_str(&self.name),
        }
    }
}

/// A text that is not the name of a policy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} is not a policy: must be one of `auto`, `colon`, `general`, `explorer`, or NAME or NAME@HASH of an added one"
)]
pub struct NotAPolicy {
    text: String,
}

impl FromStr for RlPolicy {
    type Err = NotAPolicy;

    fn from_str(text: &str) -> Result<Self, NotAPolicy> {
        let refused = || NotAPolicy { text: text.to_owned() };
        let (name, hash) = match text.split_once('@') {
            None => (text, None),
            Some((name, hash)) if hash.len() == 16 && hash.bytes().all(|byte| byte.is_ascii_hexdigit()) => {
                (name, Some(u64::from_str_radix(hash, 16).map_err(|_| refused())?))
            }
            Some(_) => return Err(refused()),
        };
        match (name, hash) {
            ("auto", None) => Ok(Self::Auto),
            ("colon", None) => Ok(Self::Colon),
            ("general", None) => Ok(Self::General),
            ("explorer", None) => Ok(Self::Explorer),
            (name, hash) if is_name(name) && name != "auto" => {
                Ok(Self::Added(AddedPolicy { name: name.to_owned(), hash }))
            }
            _ => Err(refused()),
        }
    }
}

/// In logs and hashes, which began before there were added policies.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Stored {
    Auto,
    Colon,
    General,
    Explorer,
    Added(String),
}

impl Serialize for RlPolicy {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            return serializer.collect_str(self);
        }
        let stored = match self {
            Self::Auto => Stored::Auto,
            Self::Colon => Stored::Colon,
            Self::General => Stored::General,
            Self::Explorer => Stored::Explorer,
            Self::Added(added) => Stored::Added(added.to_string()),
        };
        stored.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for RlPolicy {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = if deserializer.is_human_readable() {
            String::deserialize(deserializer)?
        } else {
            match Stored::deserialize(deserializer)? {
                Stored::Auto => return Ok(Self::Auto),
                Stored::Colon => return Ok(Self::Colon),
                Stored::General => return Ok(Self::General),
                Stored::Explorer => return Ok(Self::Explorer),
                Stored::Added(text) => text,
            }
        };
        text.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_text_is_read_back_and_other_texts_are_refused() {
        for text in
            ["auto", "colon", "general", "explorer", "mine", "my-maze@00ff00ff00ff00ff", "colon@0000000000000001"]
        {
            assert_eq!(text.parse::<RlPolicy>().unwrap().to_string(), text);
        }
        for text in ["", "@", "a@", "auto@0000000000000001", "a@12", "A", "a b", "a@+0ff00ff00ff00ff", "a@0@0"] {
            assert!(text.parse::<RlPolicy>().is_err(), "{text:?}");
        }
    }

    #[test]
    fn logs_and_hashes_are_those_of_an_enumeration() {
        let added: RlPolicy = "mine@00ff00ff00ff00ff".parse().unwrap();
        for (policy, stored) in [(RlPolicy::Auto, vec![0]), (RlPolicy::Explorer, vec![3])] {
            assert_eq!(postcard::to_stdvec(&policy).unwrap(), stored);
            let mut log = Vec::new();
            ciborium::into_writer(&policy, &mut log).unwrap();
            assert_eq!(ciborium::from_reader::<String, _>(log.as_slice()).unwrap(), policy.to_string());
        }
        let mut log = Vec::new();
        ciborium::into_writer(&added, &mut log).unwrap();
        assert_eq!(ciborium::from_reader::<RlPolicy, _>(log.as_slice()).unwrap(), added);
        assert_eq!(postcard::from_bytes::<RlPolicy>(&postcard::to_stdvec(&added).unwrap()).unwrap(), added);
        assert_eq!(serde_json::to_string(&added).unwrap(), "\"mine@00ff00ff00ff00ff\"");
    }
}
