//! Test cases: a scenario, the operator's inputs, and the expected result. The page saves a trial as a case.

use std::iter::Peekable;
use std::ops::ControlFlow;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Arena, Counters, Input, InputError, LoggedMap, Source, TickRecord, Trial, TrialError};
use crate::image::ImageSource;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::Scenario;

/// Time for a delivery that is still pending when the case is saved.
const TIME_TO_DELIVER_S: f64 = 60.0;
/// Extra time for a delivery that has happened: another graphics adapter gives slightly different images and so
/// different decisions.
const SLACK_S: f64 = 10.0;
/// Without an expectation, a case that does not come to rest ends this long after the last input.
const REST_S: f64 = 600.0;
/// Maximum tick in a case: one day.
const TICKS_MOST: u64 = 24 * 3600 * 125;

/// A trial that can be run again with the present controllers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Description.
    pub about: String,
    pub scenario: Scenario,
    /// Its map, if the map does not ship with Ferry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<LoggedMap>,
    /// The inputs, in order of ticks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<Timed>,
    /// The expected result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expect: Option<Expectation>,
}

/// An input with its tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Timed {
    /// The input is applied after this tick and before the next one.
    pub tick: u64,
    pub input: Input,
}

/// Expected number of deliveries up to a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Deliveries since the start.
    pub deliveries: u32,
    /// The last tick that counts.
    pub by_tick: u64,
}

/// Why a text is not a case.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CaseError {
    /// Not JSON, or a field is missing, unknown or invalid.
    #[error("{reason}")]
    Malformed {
        /// Empty if the text is not JSON.
        field: String,
        reason: String,
    },
    /// A trial does not last that long.
    #[error("{field} is {tick}, it must be at most {TICKS_MOST} (one day)")]
    TooLate { field: &'static str, tick: u64 },
}

impl CaseError {
    fn of(error: &serde_path_to_error::Error<serde_json::Error>) -> Self {
        let (path, reason) = (error.path().to_string(), error.to_string());
        // `?` is an unreadable name, `.` the whole file. There only serde's message names the field, in backquotes.
        let field = match path.trim_end_matches(['.', '?']) {
            "" => reason.split('`').nth(1).unwrap_or_default(),
            field => field,
        };
        Self::Malformed { field: field.to_owned(), reason }
    }

    /// The field at fault, such as `scenario.seed`; empty if it is not known.
    pub fn field(&self) -> &str {
        match self {
            Self::Malformed { field, .. } => field,
            Self::TooLate { field, .. } => field,
        }
    }
}

/// Result of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseOutcome {
    /// Its last tick.
    pub tick: u64,
    /// Phase at that tick.
    pub phase: String,
    /// Counters at that tick.
    pub counters: Counters,
    /// Inputs that were impossible because the trial took another course, and were skipped.
    pub refused: Vec<(u64, InputError)>,
}

impl CaseOutcome {
    /// Whether the expectation is met; always true without an expectation.
    pub fn meets(&self, case: &Case) -> bool {
        case.expect.is_none_or(|expect| self.counters.deliveries >= expect.deliveries && self.tick <= expect.by_tick)
    }
}

impl Case {
    /// Reads a case.
    pub fn from_json(bytes: &[u8]) -> Result<Self, CaseError> {
        let mut reader = serde_json::Deserializer::from_slice(bytes);
        let case: Self = serde_path_to_error::deserialize(&mut reader).map_err(|error| CaseError::of(&error))?;
        let after = |error: serde_json::Error| CaseError::Malformed { field: String::new(), reason: error.to_string() };
        reader.end().map_err(after)?;
        let last = case.inputs.iter().map(|timed| ("inputs: tick", timed.tick)).max_by_key(|&(_, tick)| tick);
        let by = case.expect.map(|expect| ("expect.by_tick", expect.by_tick));
        match last.into_iter().chain(by).find(|&(_, tick)| tick > TICKS_MOST) {
            Some((field, tick)) => Err(CaseError::TooLate { field, tick }),
            None => Ok(case),
        }
    }

    /// Makes a case of a trial and its inputs. It expects a pending goal to be delivered. `None` if there is nothing
    /// to expect.
    pub fn of(trial: &Trial, inputs: Vec<Timed>) -> Option<Self> {
        let world = &trial.state().world;
        let under_way = world.goal_m.is_some() && world.counters.goal_steps > 0;
        let deliveries = world.counters.deliveries + u32::from(under_way);
        let time_s = if under_way { TIME_TO_DELIVER_S } else { SLACK_S };
        let scenario = trial.scenario().clone();
        let about = format!("{} on {}, with disturbances by hand.", scenario.controller.as_str(), scenario.map);
        let expect = Expectation { deliveries, by_tick: world.tick + ticks(time_s) };
        let map = LoggedMap::unless_shipped(&trial.arena().map);
        (deliveries > 0).then_some(Self { about, scenario, map, inputs, expect: Some(expect) })
    }

    /// The trial after this many ticks, with the inputs up to then. Impossible ones are left out.
    pub fn after(&self, ticks: u64, arena: &Arc<Arena>, camera: &mut dyn ImageSource) -> Result<Trial, TrialError> {
        let mut trial = Trial::new(self.scenario.clone(), arena.clone())?;
        let mut inputs = self.inputs.iter().peekable();
        loop {
            apply_due(&mut trial, &mut inputs, &mut Vec::new());
            if trial.state().world.tick >= ticks {
                return Ok(trial);
            }
            trial.tick(Source::Camera(camera))?;
        }
    }

    /// Runs the case until its expectation is met or its time is over; without an expectation, until it rests.
    /// `watch` is called after every tick and may stop the run.
    pub fn run(
        &self,
        arena: &Arc<Arena>,
        camera: &mut dyn ImageSource,
        watch: &mut dyn FnMut(&TickRecord) -> ControlFlow<()>,
    ) -> Result<CaseOutcome, TrialError> {
        let mut trial = Trial::new(self.scenario.clone(), arena.clone())?;
        let last_tick = self.inputs.last().map_or(0, |last| last.tick);
        let mut inputs = self.inputs.iter().peekable();
        let mut refused = Vec::new();
        loop {
            apply_due(&mut trial, &mut inputs, &mut refused);
            let record = trial.tick(Source::Camera(camera))?;
            let stopped = watch(&record).is_break();
            let moment = &record.moment;
            let rests = moment.phase.is_final() && moment.hand.is_none();
            let over = match self.expect {
                Some(Expectation { deliveries, by_tick }) => {
                    moment.counters.deliveries >= deliveries || record.tick >= by_tick
                }
                // Without a goal it does not come to rest.
                None => rests || record.tick >= last_tick + ticks(REST_S),
            };
            if stopped || (over && inputs.peek().is_none()) {
                let (phase, counters) = (moment.phase.to_string(), moment.counters);
                return Ok(CaseOutcome { tick: record.tick, phase, counters, refused });
            }
        }
    }
}

/// Applies the inputs that are due, and notes those that are refused.
fn apply_due(
    trial: &mut Trial,
    inputs: &mut Peekable<std::slice::Iter<'_, Timed>>,
    refused: &mut Vec<(u64, InputError)>,
) {
    let now = trial.state().world.tick;
    while let Some(Timed { tick, input }) = inputs.next_if(|timed| timed.tick <= now) {
        if let Err(error) = trial.apply(input.clone()) {
            refused.push((*tick, error));
        }
    }
}

fn ticks(time_s: f64) -> u64 {
    (time_s / SERVO_PERIOD_S) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rejects_a_case_that_would_never_end() {
        let scenario = serde_json::to_string(&Scenario::idle("open", 1)).unwrap();
        let case = |rest: &str| Case::from_json(format!(r#"{{"about":"","scenario":{scenario}{rest}}}"#).as_bytes());
        assert!(case("").is_ok(), "without an expectation `run` ends it");
        assert!(case(r#","inputs":[{"tick":10800000,"input":"release"}]"#).is_ok());
        let error = case(r#","inputs":[{"tick":10800001,"input":"release"}]"#).unwrap_err();
        assert_eq!(error.to_string(), "inputs: tick is 10800001, it must be at most 10800000 (one day)");
        let error = case(r#","expect":{"deliveries":1,"by_tick":18446744073709551615}"#).unwrap_err().to_string();
        assert!(error.starts_with("expect.by_tick is 18446744073709551615, it must be at most"), "{error}");
        let error = case(r#","inputs":[{"tick":1,"input":"fly"}]"#).unwrap_err();
        assert!(error.to_string().starts_with("inputs[0].input: unknown variant `fly`"), "{error}");
    }

    #[test]
    fn an_error_names_the_field() {
        let scenario = serde_json::to_string(&Scenario::idle("open", 1)).unwrap();
        let field = |text: &str| Case::from_json(text.as_bytes()).unwrap_err().field().to_owned();
        assert_eq!(field("{"), "");
        assert_eq!(field(&format!(r#"{{"about":"","scenario":{scenario}}} more"#)), "");
        assert_eq!(field(r#"{"about":""}"#), "scenario");
        assert_eq!(field(&format!(r#"{{"about":"","scenario":{scenario},"when":1}}"#)), "when");
        let wrong = scenario.replace(r#""seed":1"#, r#""seed":-1"#);
        assert_eq!(field(&format!(r#"{{"about":"","scenario":{wrong}}}"#)), "scenario.seed");
    }
}
