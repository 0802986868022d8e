//! The course of a trial: where tool and bead were, and what carried the bead, at a fixed step from its start.

use std::sync::Arc;

use crate::control::switching::Mode;
use crate::scenario::ControllerName;
use crate::trial::Moment;

/// Ticks between two points of a new course: 25 Hz of simulated time.
const FIRST_STEP_TICKS: u64 = 5;
/// A longer course keeps every second point, and goes on with twice the step.
const MOST: usize = 4096;

/// Horizontal positions, with the active sub-controller and what sub-controller 2 is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoursePoint {
    pub tool_m: [f32; 2],
    pub bead_m: [f32; 2],
    pub mode: Mode,
    pub controller: ControllerName,
}

/// Copies share the points.
#[derive(Clone, Debug)]
pub struct Course {
    step_ticks: u64,
    /// Of the first point; a multiple of the step, as that of each point.
    first_tick: u64,
    points: Arc<Vec<CoursePoint>>,
    /// How often points were forgotten.
    cuts: u64,
    /// The tick after which points were forgotten last.
    cut_tick: u64,
}

impl Default for Course {
    fn default() -> Self {
        Self { step_ticks: FIRST_STEP_TICKS, first_tick: 0, points: Arc::default(), cuts: 0, cut_tick: 0 }
    }
}

impl Course {
    /// Adds a moment if it is one of the step.
    pub fn follow(&mut self, moment: &Moment) {
        if !moment.tick.is_multiple_of(self.step_ticks) {
            return;
        }
        if self.points.is_empty() {
            self.first_tick = moment.tick;
        }
        let points = Arc::make_mut(&mut self.points);
        points.push(CoursePoint {
            tool_m: moment.tool_m.xy().cast::<f32>().coords.into(),
            bead_m: moment.bead_m.xy().cast::<f32>().coords.into(),
            mode: moment.switching.mode,
            controller: moment.controller,
        });
        if points.len() > MOST {
            let odd = !self.first_tick.is_multiple_of(2 * self.step_ticks);
            *points = points.iter().skip(usize::from(odd)).step_by(2).copied().collect();
            self.first_tick += if odd { self.step_ticks } else { 0 };
            self.step_ticks *= 2;
        }
    }

    /// Drops the points after a tick.
    pub fn forget_after(&mut self, tick: u64) {
        let kept = self.from(tick + 1).0;
        if kept < self.points.len() {
            Arc::make_mut(&mut self.points).truncate(kept);
            self.cuts += 1;
            self.cut_tick = tick;
        }
    }

    /// The points at or after a tick, with the index of the first.
    fn from(&self, tick: u64) -> (usize, &[CoursePoint]) {
        let before = tick.saturating_sub(self.first_tick).div_ceil(self.step_ticks);
        let index = (before as usize).min(self.points.len());
        (index, &self.points[index..])
    }

    /// The points at or after a tick, with the tick of the first.
    pub fn points_from(&self, tick: u64) -> (u64, &[CoursePoint]) {
        let (index, points) = self.from(tick);
        (self.first_tick + index as u64 * self.step_ticks, points)
    }

    pub fn step_ticks(&self) -> u64 {
        self.step_ticks
    }

    /// Tick of the newest point.
    pub fn newest_tick(&self) -> Option<u64> {
        let steps = self.points.len().checked_sub(1)?;
        Some(self.first_tick + steps as u64 * self.step_ticks)
    }

    /// How often points were forgotten, and the tick after which they were last.
    pub fn cuts(&self) -> (u64, u64) {
        (self.cuts, self.cut_tick)
    }
}
