//! Length of the tool's path during transport, compared with the shortest path.

use ferry_core::control::switching::Mode;
use ferry_core::geometry::Point2;
use ferry_core::map::FreeSpace;
use ferry_core::trial::{Moment, Phase};

/// With less progress than this, the ratio is meaningless.
const LEAST_PROGRESS_M: f64 = 0.05;

/// Sums over the transport legs of one trial.
#[derive(Clone, Debug, Default)]
pub(super) struct Course {
    way_m: f64,
    /// Start and end of each leg.
    legs: Vec<[Point2<f64>; 2]>,
    carrying: bool,
}

impl Course {
    pub(super) fn add(&mut self, moment: &Moment) {
        let carries = moment.switching.mode == Mode::Transport && moment.phase == Phase::Transporting;
        let here = moment.tool_m.xy();
        match self.legs.last_mut() {
            Some([_, end]) if self.carrying => {
                self.way_m += (here - *end).norm();
                *end = here;
            }
            _ if carries => self.legs.push([here, here]),
            _ => {}
        }
        self.carrying = carries;
    }

    /// The tool's path length divided by the shortest path with the same progress toward the goal, summed over legs.
    /// `None` with almost no progress. `space` is the free space of the bead.
    pub(super) fn ratio(&self, space: &FreeSpace, goal: Point2<f64>) -> Option<f64> {
        let left_m = |from: Point2<f64>| space.shortest_m(from, goal);
        let mut progress_m = 0.0;
        for &[start, end] in &self.legs {
            progress_m += left_m(start)? - left_m(end)?;
        }
        (progress_m >= LEAST_PROGRESS_M).then(|| self.way_m / progress_m)
    }
}
