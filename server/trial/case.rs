//! Cases: a scenario, what an operator did in it, and what is expected of it. A drag on the page becomes one.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Arena, Counters, Input, InputError, LoggedMap, Source, TickRecord, Trial, TrialError};
use crate::camera::Eye;
use crate::files::read_at_most;
use crate::map::{Map, MapError};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{Scenario, Shipped, ShippedError};

/// What is not delivered yet has so long to be.
const TIME_TO_DELIVER_S: f64 = 60.0;
/// What is delivered already may come so much later: with another adapter images differ, and decisions with them.
const SLACK_S: f64 = 10.0;
/// Without an expectation it ends so long after the last input, should it never rest: without a goal nothing does.
const REST_S: f64 = 600.0;
/// A larger file is no case: an hour of dragging comes to a tenth of it.
const BYTES_MOST: u64 = 64 << 20;
/// A day of ticks: whoever waits for a later one waits for ever.
const TICKS_MOST: u64 = 24 * 3600 * 125;

/// A trial that can be run again with whatever the controllers have become.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// What it shows.
    pub about: String,
    /// How the trial is set up.
    pub scenario: Scenario,
    /// Its map, where that does not come with Ferry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<LoggedMap>,
    /// What is done in it, in order of ticks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<Timed>,
    /// What must come of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expect: Option<Expectation>,
}

/// An input and its time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timed {
    /// It comes before the tick after this one.
    pub tick: u64,
    /// What.
    pub input: Input,
}

/// So many deliveries by then.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Deliveries since the start.
    pub deliveries: u32,
    /// The last tick that counts.
    pub by_tick: u64,
}

/// What a case came to.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseOutcome {
    /// Its last tick.
    pub tick: u64,
    /// How it stood then.
    pub phase: String,
    /// Counters then.
    pub counters: Counters,
    /// Inputs that the trial's course made impossible.
    pub refused: Vec<(u64, InputError)>,
}

impl CaseOutcome {
    /// Whether it is what was expected; without an expectation, always.
    pub fn meets(&self, case: &Case) -> bool {
        case.expect.is_none_or(|expect| self.counters.deliveries >= expect.deliveries && self.tick <= expect.by_tick)
    }
}

impl Case {
    /// A shipped scenario by name, or a file when `name_or_path` ends in `.json`.
    pub fn open(name_or_path: &str) -> Result<Self, ShippedError> {
        if !name_or_path.ends_with(".json") {
            let Shipped { about, scenario } = Shipped::open(name_or_path)?;
            return Ok(Self { about, scenario, map: None, inputs: Vec::new(), expect: None });
        }
        let unreadable = |reason: String| ShippedError::Unreadable { path: name_or_path.to_owned(), reason };
        let bytes = read_at_most(Path::new(name_or_path), BYTES_MOST).map_err(|error| unreadable(error.to_string()))?;
        Self::from_json(&bytes).map_err(unreadable)
    }

    /// Reads a case.
    ///
    /// # Errors
    /// What is wrong with it, the field named.
    pub fn from_json(bytes: &[u8]) -> Result<Self, String> {
        let mut reader = serde_json::Deserializer::from_slice(bytes);
        let case: Self = serde_path_to_error::deserialize(&mut reader).map_err(|error| error.to_string())?;
        reader.end().map_err(|error| error.to_string())?;
        let last = case.inputs.iter().map(|timed| ("inputs: tick", timed.tick)).max_by_key(|&(_, tick)| tick);
        let by = case.expect.map(|expect| ("expect.by_tick", expect.by_tick));
        match last.into_iter().chain(by).find(|&(_, tick)| tick > TICKS_MOST) {
            Some((field, tick)) => Err(format!("{field} is {tick}, it must be at most {TICKS_MOST}, a day")),
            None => Ok(case),
        }
    }

    /// Of a trial and all that it was told: what is under way is expected to be delivered. `None` if there is nothing
    /// to expect.
    pub fn of(trial: &Trial, inputs: Vec<Timed>) -> Option<Self> {
        let world = &trial.state().world;
        let under_way = world.goal_m.is_some() && world.counters.goal_steps > 0;
        let deliveries = world.counters.deliveries + u32::from(under_way);
        let time_s = if under_way { TIME_TO_DELIVER_S } else { SLACK_S };
        let scenario = trial.scenario().clone();
        let about = format!("{} on {}, with what a hand did.", scenario.controller.as_str(), scenario.map);
        let expect = Expectation { deliveries, by_tick: world.tick + ticks(time_s) };
        let own = &trial.arena().map;
        let is_shipped = Map::shipped(own.name()).is_ok_and(|map| map.svg() == own.svg());
        let map = (!is_shipped).then(|| LoggedMap::from(own));
        (deliveries > 0).then_some(Self { about, scenario, map, inputs, expect: Some(expect) })
    }

    /// Where it takes place.
    ///
    /// # Errors
    /// When its map is none, or not to be had.
    pub fn arena(&self) -> Result<Arc<Arena>, MapError> {
        self.map.as_ref().map_or_else(|| Arena::open(&self.scenario.map), LoggedMap::arena)
    }

    /// Runs it in an arena made of its map, until what is expected has come, or its time is over; without an
    /// expectation, until it rests. `watch` sees every tick and may stop it.
    pub fn run(
        &self,
        arena: &Arc<Arena>,
        eye: &mut dyn Eye,
        watch: &mut dyn FnMut(&TickRecord) -> ControlFlow<()>,
    ) -> Result<CaseOutcome, TrialError> {
        let mut trial = Trial::new(self.scenario.clone(), arena.clone())?;
        let last_tick = self.inputs.last().map_or(0, |last| last.tick);
        let mut inputs = self.inputs.iter().peekable();
        let mut refused = Vec::new();
        loop {
            let tick = trial.state().world.tick;
            while let Some(Timed { tick, input }) = inputs.next_if(|timed| timed.tick <= tick) {
                if let Err(error) = trial.apply(input.clone()) {
                    refused.push((*tick, error));
                }
            }
            let record = trial.tick(Source::Eye(eye))?;
            let stopped = watch(&record).is_break();
            let moment = &record.moment;
            let rests = moment.phase.is_final() && moment.hand.is_none();
            let over = match self.expect {
                Some(Expectation { deliveries, by_tick }) => {
                    moment.counters.deliveries >= deliveries || record.tick >= by_tick
                }
                // Without a goal it never rests.
                None => rests || record.tick >= last_tick + ticks(REST_S),
            };
            if stopped || (over && inputs.peek().is_none()) {
                let (phase, counters) = (moment.phase.to_string(), moment.counters);
                return Ok(CaseOutcome { tick: record.tick, phase, counters, refused });
            }
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
    fn a_case_that_would_never_end_is_refused() {
        let scenario = serde_json::to_string(&Scenario::idle("open", 1)).unwrap();
        let case = |rest: &str| Case::from_json(format!(r#"{{"about":"","scenario":{scenario}{rest}}}"#).as_bytes());
        assert!(case("").is_ok(), "without an expectation `run` ends it");
        assert!(case(r#","inputs":[{"tick":10800000,"input":"release"}]"#).is_ok());
        let error = case(r#","inputs":[{"tick":10800001,"input":"release"}]"#).unwrap_err();
        assert_eq!(error, "inputs: tick is 10800001, it must be at most 10800000, a day");
        let error = case(r#","expect":{"deliveries":1,"by_tick":18446744073709551615}"#).unwrap_err();
        assert!(error.starts_with("expect.by_tick is 18446744073709551615, it must be at most"), "{error}");
        let error = case(r#","inputs":[{"tick":1,"input":"fly"}]"#).unwrap_err();
        assert!(error.starts_with("inputs[0].input: unknown variant `fly`"), "{error}");
    }
}
