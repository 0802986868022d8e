//! The entries of an input log: the beginning of a trial, and each of its ticks.

use std::sync::Arc;

use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::{Arena, Beginning, Decision, Input, TickRecord, Trial, TrialState};
use crate::map::{Map, MapError, READER, first_reader};
use crate::scenario::{Parameters, Scenario};

/// An entry of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Entry {
    /// The following entries belong to this trial.
    Begin(Box<LoggedBeginning>),
    /// A tick of the trial.
    Tick(LoggedTick),
}

/// The beginning of a trial, or of a later part of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoggedBeginning {
    pub scenario: Scenario,
    /// The map; omitted if it is the map of the previous beginning.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<LoggedMap>,
    /// Hash of the policy file, if a policy other than the shipped ones was used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub policy_hash: Option<u64>,
    /// The state from which it continues; omitted at its start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<Box<TrialState>>,
}

impl LoggedBeginning {
    /// The beginning for a trial without waiting inputs.
    pub fn of(trial: &Trial, how: Beginning) -> Self {
        Self {
            scenario: trial.scenario().clone(),
            map: Some(LoggedMap::from(&trial.arena().map)),
            policy_hash: trial.arena().policy.as_ref().map(|policy| policy.hash()),
            state: (how != Beginning::SetUp).then(|| Box::new(trial.snapshot())),
        }
    }
}

/// A map with its drawing, because shipped maps may change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct LoggedMap {
    /// Name, for people.
    pub name: String,
    /// The drawing.
    pub svg: String,
    /// Version of the reader that made walls of it; 1 if it is not given.
    #[serde(default = "first_reader")]
    pub reader: u32,
}

impl From<&Map> for LoggedMap {
    fn from(map: &Map) -> Self {
        Self { name: map.name().to_owned(), svg: map.svg().to_owned(), reader: READER }
    }
}

impl LoggedMap {
    /// `None` for a map that ships with Ferry.
    pub fn unless_shipped(map: &Map) -> Option<Self> {
        let is_shipped = Map::shipped(map.name()).is_ok_and(|shipped| shipped.svg() == map.svg());
        (!is_shipped).then(|| Self::from(map))
    }

    /// The map.
    ///
    /// # Errors
    /// The drawing is not a map.
    pub fn map(&self) -> Result<Map, MapError> {
        Map::from_svg(&self.name, &self.svg)?.as_read_by(self.reader)
    }

    /// The map, prepared for trials.
    ///
    /// # Errors
    /// The drawing is not a map.
    pub fn arena(&self) -> Result<Arc<Arena>, MapError> {
        Ok(Arena::of(self.map()?))
    }
}

/// One tick of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoggedTick {
    /// Ticks since the start, this one included.
    pub tick: u64,
    /// Inputs applied before the tick.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "few_inputs")]
    pub inputs: Vec<Input>,
    /// Decision of the control step, if one was due.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decision: Option<Decision>,
    /// World hash after the tick.
    pub world_hash: u64,
    /// The lowest 16 bits of the hash of each of [`super::World::FIELDS`], little-endian.
    #[serde(with = "serde_bytes")]
    pub fields: Vec<u8>,
    /// Controller hash after the tick.
    #[serde(rename = "mind_hash")]
    pub controller_hash: u64,
}

/// Largest number of inputs of one tick; a session takes fewer.
const INPUTS_MOST: usize = 100_000;

/// Reads inputs, and stops when there are too many.
fn few_inputs<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Input>, D::Error> {
    struct Few;
    impl<'de> Visitor<'de> for Few {
        type Value = Vec<Input>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(f, "at most {INPUTS_MOST} inputs")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut all: A) -> Result<Vec<Input>, A::Error> {
            let mut inputs = Vec::new();
            while let Some(input) = all.next_element()? {
                if inputs.len() == INPUTS_MOST {
                    return Err(serde::de::Error::invalid_length(INPUTS_MOST + 1, &self));
                }
                inputs.push(input);
            }
            Ok(inputs)
        }
    }
    deserializer.deserialize_seq(Few)
}

impl Entry {
    /// Memory that it needs, about.
    pub(super) fn bytes(&self) -> u64 {
        let of_input = |input: &Input| match input {
            Input::Configure(_) => size_of::<Input>() + size_of::<Parameters>(),
            _ => size_of::<Input>(),
        };
        let inside = match self {
            Self::Begin(beginning) => beginning.map.as_ref().map_or(0, |map| map.svg.len()),
            Self::Tick(tick) => tick.fields.len() + tick.inputs.iter().map(of_input).sum::<usize>(),
        };
        (size_of::<Self>() + inside) as u64
    }
}

impl From<&TickRecord> for LoggedTick {
    fn from(record: &TickRecord) -> Self {
        Self {
            tick: record.tick,
            inputs: record.inputs.clone(),
            decision: record.decision.clone(),
            world_hash: record.world.total(),
            fields: record.world.fields.iter().flat_map(|hash| (*hash as u16).to_le_bytes()).collect(),
            controller_hash: record.controller_hash,
        }
    }
}
