//! Tracking errors of a trial, summed while sub-controller 2 transports, as in the paper (§V).

use serde::{Deserialize, Serialize};

use super::{Moment, Phase};
use crate::control::switching::Mode;

/// Sums over the ticks of transport.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    sum_m: f64,
    sum_x_m: f64,
    sum_y_m: f64,
    ticks: u32,
    max_x_m: f64,
    max_y_m: f64,
}

impl Tally {
    /// Adds a tick if it belongs to transport.
    pub fn add(&mut self, moment: &Moment) {
        if moment.switching.mode != Mode::Transport || moment.phase != Phase::Transporting {
            return;
        }
        let error = moment.tracking_error_m();
        self.sum_m += error.norm();
        self.sum_x_m += error.x.abs();
        self.sum_y_m += error.y.abs();
        self.ticks += 1;
        self.max_x_m = self.max_x_m.max(error.x.abs());
        self.max_y_m = self.max_y_m.max(error.y.abs());
    }

    /// Mean distance between tool and bead; 0 before the first tick of transport.
    pub fn mean_m(&self) -> f64 {
        self.sum_m / f64::from(self.ticks.max(1))
    }

    /// Mean absolute difference in x and in y.
    pub fn mean_axes_m(&self) -> [f64; 2] {
        [self.sum_x_m, self.sum_y_m].map(|sum_m| sum_m / f64::from(self.ticks.max(1)))
    }

    /// Maximum absolute difference in x and in y.
    pub fn max_m(&self) -> [f64; 2] {
        [self.max_x_m, self.max_y_m]
    }
}
