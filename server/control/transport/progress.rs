//! Whether a tool gets anywhere.

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;

/// A tool that stays within the first of these for so many control steps stands still, one within the second
/// gets nowhere.
const STILL_M: f64 = 0.003;
const STILL_STEPS: u32 = 8;
const AROUND_M: f64 = 0.03;
const AROUND_STEPS: u32 = 40;

/// In which way a tool gets nowhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standstill {
    /// It stands.
    Still,
    /// It moves, but around one place.
    Around,
}

/// Where the tool was when it last got anywhere, and how many control steps ago.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    still: Option<(Point2<f64>, u32)>,
    around: Option<(Point2<f64>, u32)>,
}

impl Progress {
    /// Takes note of a step.
    pub fn note(&mut self, tool_m: Point2<f64>) {
        for (since, radius_m) in [(&mut self.still, STILL_M), (&mut self.around, AROUND_M)] {
            *since = match *since {
                Some((at, steps)) if (tool_m - at).norm() <= radius_m => Some((at, steps + 1)),
                _ => Some((tool_m, 0)),
            };
        }
    }

    /// What keeps it, if anything does.
    pub fn standstill(&self) -> Option<Standstill> {
        let lasts = |since: Option<(Point2<f64>, u32)>, steps| since.is_some_and(|(_, count)| count >= steps);
        if lasts(self.still, STILL_STEPS) {
            Some(Standstill::Still)
        } else {
            lasts(self.around, AROUND_STEPS).then_some(Standstill::Around)
        }
    }
}
