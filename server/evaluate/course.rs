//! How far the tool went while it carried, and how far it had to.

use crate::control::switching::Mode;
use crate::geometry::Point2;
use crate::map::FreeSpace;
use crate::trial::{Moment, Phase};

/// Less progress than this says nothing about detours.
const LEAST_PROGRESS_M: f64 = 0.05;

/// The legs of transport of one trial, added up.
#[derive(Clone, Debug, Default)]
pub(super) struct Course {
    way_m: f64,
    /// Where each leg began and ended.
    legs: Vec<[Point2<f64>; 2]>,
    carrying: bool,
}

impl Course {
    /// Takes a tick in.
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

    /// The way that the tool went over the shortest that would have brought it as much nearer to the goal, leg by
    /// leg; `None` if it hardly came nearer. `space` is what the bead has room in.
    pub(super) fn ratio(&self, space: &FreeSpace, goal: Point2<f64>) -> Option<f64> {
        let left_m = |from: Point2<f64>| {
            let way = space.taut_path(from, goal)?;
            Some(way.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>())
        };
        let mut progress_m = 0.0;
        for &[start, end] in &self.legs {
            progress_m += left_m(start)? - left_m(end)?;
        }
        (progress_m >= LEAST_PROGRESS_M).then(|| self.way_m / progress_m)
    }
}
