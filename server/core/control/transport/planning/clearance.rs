//! Known obstacles as rectangles, and the clearance that a path keeps from them.
//!
//! The bead trails the tool and cuts corners. Therefore an edge must stay `asked_m` away from every rectangle and from
//! the workspace's border. Start and goal may be closer to a wall: after a fetch the tool is where the bead was,
//! possibly over a wall, and the map's cells make walls thicker. Near such an end the required clearance starts at the
//! end's own distance and grows, beyond 6 mm, by a quarter of the distance from the end. So a path moves away from a
//! wall and does not follow it. If the tool is over a wall, its path begins at the nearest point with the minimum
//! clearance. None of this is from the publication, which plans for a point.

use serde::{Deserialize, Serialize};

use super::segment::Segment;
use crate::geometry::Point2;

/// The clearance does not grow within this distance of an end: walls of cells have steps, so the distance to them does
/// not grow evenly.
const GRACE_M: f64 = 0.006;
/// Growth of the required clearance per distance from an end that has less.
pub(super) const GROWTH: f64 = 0.25;
/// Near such an end, edges are checked in pieces of this length; each must keep what its nearer end requires.
pub(super) const PIECE_M: f64 = 0.0005;
/// Distance that a path keeps in the narrowest places. None of the publications has it.
pub const LEAST_CLEARANCE_M: f64 = 0.006;
/// Larger than the rounding errors of distances and positions.
pub(super) const ROUNDING_M: f64 = 1e-9;

/// Number of clearance levels, including the largest and the smallest.
const LEVELS: usize = 5;

/// The clearances that are tried one after another, from the largest to the smallest.
pub(super) fn levels_m([most_m, least_m]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..LEVELS).map(move |level| most_m + (least_m - most_m) * level as f64 / (LEVELS - 1) as f64)
}

/// The distance that a path keeps from walls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// Required distance away from the ends; everywhere if both ends are far enough from walls.
    pub asked_m: f64,
    /// Start and goal.
    pub ends: [End; 2],
}

/// Start or goal of a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// In `base`.
    pub point: Point2<f64>,
    /// `Obstacles::distance_m` at the point; more than 0.
    pub distance_m: f64,
}

impl End {
    /// Clearance that this end requires at a distance of `away_m` from it.
    fn required_m(&self, away_m: f64) -> f64 {
        self.distance_m + GROWTH * (away_m - GRACE_M).max(0.0)
    }
}

impl Clearance {
    /// Required distance at a point. Near an end, edges are checked in pieces of .5 mm, so up to .125 mm less may be
    /// kept there.
    pub fn required_m(&self, point: Point2<f64>) -> f64 {
        let [start_m, goal_m] = self.ends.map(|end| end.required_m((point - end.point).norm()));
        self.asked_m.min(start_m).min(goal_m)
    }

    /// The same clearance reduced by `by_m`, but still without touching walls.
    pub(super) fn less(&self, by_m: f64) -> Self {
        let less_m = |m: f64| (m - by_m).max(ROUNDING_M);
        let ends = self.ends.map(|end| End { distance_m: less_m(end.distance_m), ..end });
        Self { asked_m: less_m(self.asked_m), ends }
    }

    /// Lower and upper bound of the requirement on a straight line; equal if it is the same everywhere on the line.
    pub(super) fn required_along_m(&self, from: Point2<f64>, to: Point2<f64>) -> [f64; 2] {
        if self.ends.iter().all(|end| end.distance_m >= self.asked_m) {
            return [self.asked_m; 2];
        }
        let along = Segment::new(from, to);
        let near = self.ends.map(|end| end.required_m(along.distance_m(end.point)));
        let far = self.ends.map(|end| end.required_m((from - end.point).norm().max((to - end.point).norm())));
        [near, far].map(|[start_m, goal_m]| self.asked_m.min(start_m).min(goal_m))
    }
}
