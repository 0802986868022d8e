//! The disturbances of a trial: those that are pending, and those that last.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use crate::geometry::Point2;
use crate::scenario::{Scripted, Stream};

/// Disturbances that are pending, and those that last.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Script {
    /// Number of random displacements that remain.
    pub remaining: u32,
    /// Number of random displacements so far.
    pub struck: u32,
    /// Step of the present leg at which the next one is applied; drawn when the leg begins.
    pub at_leg_step: Option<u32>,
    /// The scenario's disturbances that were not applied yet.
    pub pending: Vec<Scripted>,
    /// Where the bead was before the last tick.
    pub bead_before_m: Option<Point2<f64>>,
    /// Tick at which a push ends.
    pub drift_until: u64,
    /// Tick at which the tracker reports again.
    pub dropout_until: u64,
    /// What replaces the scenario's seed since [`Input::Reseed`](super::Input::Reseed).
    // Left out of hashes while it is missing, so that older logs keep theirs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

/// Random numbers of one displacement.
#[derive(Clone, Copy, Debug)]
pub(super) enum Draw {
    Step,
    Place,
}

impl Script {
    /// The seed of the random numbers to come, for a scenario's seed.
    pub(super) fn seed(&self, of_scenario: u64) -> u64 {
        self.seed.unwrap_or(of_scenario)
    }

    /// A generator for each displacement, so that every controller gets the same ones, whatever else was drawn.
    pub(super) fn draws(&self, seed: u64, draw: Draw) -> ChaCha8Rng {
        let stream = match draw {
            Draw::Step => Stream::DisturbanceStep(self.struck),
            Draw::Place => Stream::DisturbancePlace(self.struck),
        };
        stream.rng(self.seed(seed))
    }

    /// Draws the step at which the next displacement is applied, for a leg of at least `least_steps` steps.
    pub(super) fn draw_step(&mut self, seed: u64, least_steps: u32) {
        let share: f64 = self.draws(seed, Draw::Step).random();
        self.at_leg_step = Some(1 + (share * f64::from(least_steps)) as u32);
    }
}
