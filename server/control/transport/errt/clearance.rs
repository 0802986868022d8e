//! The clearance that a way keeps from obstacles.
//!
//! The bead trails the tool and cuts corners, so an edge must stay `asked_m` away from every rectangle and from the
//! workspace's border. Ends may lie nearer to a wall: after a fetch the tool stands wherever the bead was, even over a
//! wall, and cells of the map make walls thicker. Around such an end the clearance asked for begins with the end's own
//! and, from 6 mm on, grows by a quarter of the distance from the end, so that a way leaves a wall and does not follow
//! it. A tool over a wall first gets off it: its way begins at the nearest place with the least clearance. All that, like
//! the clearance itself, is ours and not the publication's, which plans for a point.

use serde::{Deserialize, Serialize};

use super::segment::Segment;
use crate::geometry::Point2;

/// Around an end it does not grow yet: walls of cells have steps, and beside one the distance does not grow evenly.
const GRACE_M: f64 = 0.006;
/// How fast the clearance asked for grows farther from an end that has less.
pub(super) const GROWTH: f64 = 0.25;
/// Around such an end, edges are judged in pieces of this length; each keeps what its nearer end asks for.
pub(super) const PIECE_M: f64 = 0.0005;
/// More than distances and positions can be off by.
pub(super) const ROUNDING_M: f64 = 1e-9;

/// How far a way stays from walls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// Away from its ends, or everywhere if they lie far enough from walls.
    pub asked_m: f64,
    /// Start and goal.
    pub ends: [End; 2],
}

/// Where a way begins or ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// In `base`.
    pub point: Point2<f64>,
    /// [`super::Obstacles::distance_m`] there; more than 0.
    pub distance_m: f64,
}

impl End {
    /// What is asked for so far away from it, on its account.
    fn required_m(&self, away_m: f64) -> f64 {
        self.distance_m + GROWTH * (away_m - GRACE_M).max(0.0)
    }
}

impl Clearance {
    /// What is asked for at a point. Edges near an end are judged in pieces of half a millimetre, so that up to an
    /// eighth of a millimetre less may be kept there.
    pub fn required_m(&self, point: Point2<f64>) -> f64 {
        let [start_m, goal_m] = self.ends.map(|end| end.required_m((point - end.point).norm()));
        self.asked_m.min(start_m).min(goal_m)
    }

    /// The same, all of it less by so much, but nowhere less than to touch no wall.
    pub(super) fn less(&self, by_m: f64) -> Self {
        let less_m = |m: f64| (m - by_m).max(ROUNDING_M);
        let ends = self.ends.map(|end| End { distance_m: less_m(end.distance_m), ..end });
        Self { asked_m: less_m(self.asked_m), ends }
    }

    /// Bounds for what is asked for anywhere on a straight line; equal when all of it asks for the same.
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
