//! The script of a trial's disturbances: what is still to come, and what lasts.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use crate::geometry::Point2;
use crate::scenario::Scripted;

/// Disturbances still to come, and those that last.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Script {
    /// How many random displacements.
    pub remaining: u32,
    /// How many of them have struck.
    pub struck: u32,
    /// At which step of the present leg the next one strikes; drawn when the leg begins.
    pub at_leg_step: Option<u32>,
    /// The scenario's own that have not struck yet.
    pub pending: Vec<Scripted>,
    /// Where the bead was before the last tick.
    pub bead_before_m: Option<Point2<f64>>,
    /// Tick at which a drift ends.
    pub drift_until: u64,
    /// Tick at which the tracker sees again.
    pub dropout_until: u64,
}

/// What is drawn for a random displacement.
#[derive(Clone, Copy, Debug)]
pub(super) enum Draw {
    Step,
    Place,
}

impl Script {
    /// The next displacement's generator: its own, so that every controller meets the same, whatever else was drawn.
    pub(super) fn draws(&self, seed: u64, draw: Draw) -> ChaCha8Rng {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        // The trial's own generator has stream 0.
        rng.set_stream(1 + 2 * u64::from(self.struck) + draw as u64);
        rng
    }

    /// Draws the step of a leg of `least_steps` at which the next displacement strikes.
    pub(super) fn draw_step(&mut self, seed: u64, least_steps: u32) {
        let share: f64 = self.draws(seed, Draw::Step).random();
        self.at_leg_step = Some(1 + (share * f64::from(least_steps)) as u32);
    }
}
