//! Detects a tool that makes no progress.

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;

/// Within `STILL_M` for `STILL_STEPS` control steps, the tool counts as still; within `AROUND_M` for `AROUND_STEPS`,
/// as circling.
const STILL_M: f64 = 0.003;
const STILL_STEPS: u32 = 8;
const AROUND_M: f64 = 0.03;
const AROUND_STEPS: u32 = 40;

/// How the tool fails to progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standstill {
    /// It does not move.
    Still,
    /// It moves, but stays near one place.
    Around,
}

/// For each radius: the last place where the tool made progress, and the control steps since then.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    still: Option<(Point2<f64>, u32)>,
    around: Option<(Point2<f64>, u32)>,
}

impl Progress {
    /// Records the tool's position at a control step.
    pub fn note(&mut self, tool_m: Point2<f64>) {
        for (since, radius_m) in [(&mut self.still, STILL_M), (&mut self.around, AROUND_M)] {
            *since = match *since {
                Some((at, steps)) if (tool_m - at).norm() <= radius_m => Some((at, steps + 1)),
                _ => Some((tool_m, 0)),
            };
        }
    }

    /// The present kind of standstill; `None` while the tool makes progress.
    pub fn standstill(&self) -> Option<Standstill> {
        let lasts = |since: Option<(Point2<f64>, u32)>, steps| since.is_some_and(|(_, count)| count >= steps);
        if lasts(self.still, STILL_STEPS) {
            Some(Standstill::Still)
        } else {
            lasts(self.around, AROUND_STEPS).then_some(Standstill::Around)
        }
    }
}
