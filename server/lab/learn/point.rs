//! One point of a learning curve.

use serde::{Deserialize, Serialize};

use super::examine::Marks;

/// Updates per point of the curve.
pub const WINDOW: u64 = 100;

/// Mean and standard deviation of a series of values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    count: u32,
    sum: f64,
    squares: f64,
}

impl Spread {
    pub(super) fn add(&mut self, value: f64) {
        self.count += 1;
        self.sum += value;
        self.squares += value * value;
    }

    /// Number of values.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// `None` without values.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / f64::from(self.count))
    }

    /// Standard deviation; `None` without values.
    pub fn deviation(&self) -> Option<f64> {
        let mean = self.mean()?;
        Some((self.squares / f64::from(self.count) - mean * mean).max(0.0).sqrt())
    }
}

/// [`WINDOW`] updates of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Updates at the end of the point.
    pub update: u64,
    /// Steps of the environment at the end of the point.
    pub steps: u64,
    /// Episodes finished at the end of the point.
    pub episodes: u64,
    /// Total rewards of the episodes that ended in this point, undiscounted, including shaping.
    pub reward: Spread,
    /// Losses of the updates.
    pub loss: Spread,
    /// Gradient norms before clipping.
    pub gradient: Spread,
    /// Number of the episodes of this point (with exploration) that reached their goal.
    pub reached: u32,
    /// Number of these that ended in a wall.
    pub collided: u32,
    /// A small examination of the averaged weights, on some points.
    pub examined: Option<Marks>,
}
