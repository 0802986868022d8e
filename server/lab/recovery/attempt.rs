//! One trial of a recovery map.

use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::evaluate::EvaluateError;
use crate::program::{self, Carrier};
use ferry_core::image::ImageSource;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::trial::{Beginning, Origin, Phase, Sink, Timed, TrialError};

/// A trial that neither delivers nor ends is lost after this time.
const MOST_S: f64 = 900.0;

/// How a trial ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[schema(as = RecoveryOutcome)]
#[ts(rename = "RecoveryOutcome", rename_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    Delivered,
    /// Delivered, but after more than `within_s`.
    Late,
    Lost,
}

/// The end of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    pub outcome: Outcome,
    /// From the moment to the delivery, or to the end of the trial.
    pub time_s: f64,
    /// Control steps since the moment.
    pub steps: u32,
    /// Phase at the end.
    pub phase: Phase,
    /// The last tick.
    pub tick: u64,
    /// Deliveries of the trial at the end, with those before the moment.
    pub deliveries: u32,
    /// Hashes after the last tick.
    pub world_hash: u64,
    pub controller_hash: u64,
}

/// What all trials of a recovery map have in common.
pub(super) struct Setting<'a> {
    pub origin: &'a Origin,
    /// What a recording begins with.
    pub beginning: Beginning,
    pub within_s: f64,
}

impl Setting<'_> {
    /// Runs a trial to its end, which comes `over_ticks` after the moment at the earliest.
    pub fn attempt(
        &self,
        inputs: &[Timed],
        over_ticks: u64,
        carrier: Option<Carrier<'_>>,
        camera: &mut dyn ImageSource,
        sink: &mut dyn Sink,
        stop: &AtomicBool,
    ) -> Result<Tried, EvaluateError> {
        let mut trial = self.origin.trial()?;
        let begin = trial.state().world.tick;
        let steps = trial.state().world.counters.steps;
        sink.begin(&trial, self.beginning);
        let over = begin + over_ticks;
        let most = over + (MOST_S / SERVO_PERIOD_S) as u64;
        let mut inputs = inputs.iter().peekable();
        let mut delivered = None;
        loop {
            let now = trial.state().world.tick;
            while let Some(Timed { input, .. }) = inputs.next_if(|timed| timed.tick <= now) {
                trial.apply(input.clone()).map_err(TrialError::from)?;
            }
            let record = program::tick(&mut trial, carrier, camera)?;
            if stop.load(Ordering::Relaxed) {
                return Err(EvaluateError::Stopped);
            }
            sink.record(&record);
            let phase = record.moment.phase;
            delivered =
                delivered.filter(|_| phase == Phase::Delivered).or((phase == Phase::Delivered).then_some(now + 1));
            let rests = phase.is_final() && record.moment.hand.is_none() && inputs.peek().is_none() && now >= over;
            if !rests && now < most {
                continue;
            }
            let time_s = (delivered.unwrap_or(now + 1) - begin) as f64 * SERVO_PERIOD_S;
            let outcome = match delivered {
                Some(_) if time_s <= self.within_s => Outcome::Delivered,
                Some(_) => Outcome::Late,
                None => Outcome::Lost,
            };
            return Ok(Tried {
                outcome,
                time_s,
                steps: record.moment.counters.steps - steps,
                phase,
                tick: now + 1,
                deliveries: trial.state().world.counters.deliveries,
                world_hash: trial.state().world_hash(),
                controller_hash: trial.state().controller_hash(),
            });
        }
    }
}
