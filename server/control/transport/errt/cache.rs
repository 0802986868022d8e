//! Waypoints: places that ways went through, which a later search tries again.

use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

use crate::geometry::Point2;

/// A fixed number of slots.
///
/// The publication fills them with random states at first. Ours are empty, and a search that draws one goes anywhere
/// instead: random states too, but not the same few again and again, from which a first search would suffer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Cache {
    slots: Vec<Option<Point2<f64>>>,
}

impl Cache {
    /// Adds empty slots, or drops the last ones, until there are `count`.
    pub fn resize(&mut self, count: usize) {
        self.slots.resize(count, None);
    }

    /// What a random slot holds.
    pub fn draw(&self, rng: &mut impl Rng) -> Option<Point2<f64>> {
        if self.slots.is_empty() { None } else { self.slots[rng.random_range(0..self.slots.len())] }
    }

    /// Remembers a way: each of its points takes a random slot.
    pub fn remember(&mut self, path: &[Point2<f64>], rng: &mut impl Rng) {
        let count = self.slots.len();
        if count > 0 {
            path.iter().for_each(|&point| self.slots[rng.random_range(0..count)] = Some(point));
        }
    }
}
