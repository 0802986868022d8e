//! The input log (`.ferry`): what a trial was told and what it decided, enough to run it again.
//!
//! A file is a sequence of CBOR items (RFC 8949): a header, then an item a tick.

use std::io::{Read, Write};

use serde::{Deserialize, Serialize};

use super::{Decision, Input, TickRecord};
use crate::scenario::Scenario;

/// Raised when an old reader would misunderstand a file.
const VERSION: u32 = 4;
const FORMAT: &str = "ferry input log";

/// Why a log could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// Not a log, or torn in its header.
    #[error("log: not a Ferry input log: {0}")]
    Foreign(String),
    /// Written by another version.
    #[error("log: version {found}, this Ferry reads version {VERSION}")]
    Version {
        /// The version found.
        found: u32,
    },
    /// The disk or the pipe.
    #[error("log: {0}")]
    Write(String),
}

#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    version: u32,
    scenario: Scenario,
}

/// One tick of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoggedTick {
    /// Inputs applied before the tick.
    #[serde(rename = "i", default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<Input>,
    /// Decision of the control step, if one was due.
    #[serde(rename = "d", default, skip_serializing_if = "Option::is_none")]
    pub decision: Option<Decision>,
    /// World hash after the tick.
    #[serde(rename = "w")]
    pub world_hash: u64,
    /// Mind hash after the tick.
    #[serde(rename = "m")]
    pub mind_hash: u64,
}

impl From<&TickRecord> for LoggedTick {
    fn from(record: &TickRecord) -> Self {
        Self {
            inputs: record.inputs.clone(),
            decision: record.decision.clone(),
            world_hash: record.world_hash,
            mind_hash: record.mind_hash,
        }
    }
}

/// A whole log.
#[derive(Clone, Debug, PartialEq)]
pub struct InputLog {
    /// How the trial was set up.
    pub scenario: Scenario,
    /// Its ticks, from the first.
    pub ticks: Vec<LoggedTick>,
}

impl InputLog {
    /// Writes the header.
    pub fn begin(scenario: &Scenario, out: impl Write) -> Result<(), LogError> {
        let header = Header { format: FORMAT.into(), version: VERSION, scenario: scenario.clone() };
        ciborium::into_writer(&header, out).map_err(|e| LogError::Write(e.to_string()))
    }

    /// Writes one tick.
    pub fn append(tick: &LoggedTick, out: impl Write) -> Result<(), LogError> {
        ciborium::into_writer(tick, out).map_err(|e| LogError::Write(e.to_string()))
    }

    /// Reads a log up to its end, or up to its last whole tick if it is torn.
    pub fn read(mut input: impl Read) -> Result<Self, LogError> {
        let header: Header = ciborium::from_reader(&mut input).map_err(|e| LogError::Foreign(e.to_string()))?;
        if header.format != FORMAT {
            return Err(LogError::Foreign(format!("its format is {:?}", header.format)));
        }
        if header.version != VERSION {
            return Err(LogError::Version { found: header.version });
        }
        let ticks = std::iter::from_fn(|| ciborium::from_reader(&mut input).ok()).collect();
        Ok(Self { scenario: header.scenario, ticks })
    }
}
