//! Moments for rewinding: a snapshot before each control step of the last ten minutes, and the inputs since then. The course
//! reaches back to the start.

use std::collections::VecDeque;
use std::sync::Arc;

use super::course::Course;
use crate::trial::{Input, Moment, TrialState};

/// Four snapshots per second for ten minutes, a few kilobytes each.
const MOST: usize = 2400;
/// More than a hand sends in ten minutes at sixty inputs per second; a few hundred bytes each.
const MOST_INPUTS: usize = 50_000;

/// Snapshots in order of tick. Copies share them.
#[derive(Clone, Debug, Default)]
pub struct Timeline {
    moments: VecDeque<Arc<TrialState>>,
    /// Inputs with the tick before which they were applied.
    inputs: VecDeque<(u64, Input)>,
    /// Whether inputs before the first moment are not known.
    is_cut: bool,
    course: Course,
}

impl Timeline {
    /// Only this state is known of the past.
    pub fn from_state(state: TrialState) -> Self {
        Self { moments: VecDeque::from([Arc::new(state)]), is_cut: true, ..Self::default() }
    }

    /// Keeps a state and drops later ones.
    pub fn keep(&mut self, state: TrialState) {
        self.forget_after(state.world.tick);
        if self.moments.back().is_some_and(|last| last.world.tick == state.world.tick) {
            self.moments.pop_back();
        }
        self.moments.push_back(Arc::new(state));
        if self.moments.len() > MOST {
            self.drop_oldest();
        }
    }

    /// Adds a moment to the course.
    pub fn follow(&mut self, moment: &Moment) {
        self.course.follow(moment);
    }

    pub fn course(&self) -> &Course {
        &self.course
    }

    /// Notes inputs that were applied before a tick.
    pub fn note(&mut self, tick: u64, inputs: &[Input]) {
        self.inputs.extend(inputs.iter().map(|input| (tick, input.clone())));
        while self.inputs.len() > MOST_INPUTS && self.moments.len() > 1 {
            self.drop_oldest();
        }
    }

    /// A moment with the inputs after it.
    fn drop_oldest(&mut self) {
        self.moments.pop_front();
        let oldest = self.moments.front().map_or(0, |state| state.world.tick);
        while self.inputs.front().is_some_and(|&(tick, _)| tick < oldest) {
            self.inputs.pop_front();
        }
    }

    /// Inputs that a state of this tick does not contain yet.
    pub fn inputs_after(&self, tick: u64) -> Vec<(u64, Input)> {
        let after = self.inputs.partition_point(|&(at, _)| at <= tick);
        self.inputs.range(after..).cloned().collect()
    }

    /// All inputs since the start of the trial; `None` if the start is no longer kept.
    pub fn inputs_from_start(&self) -> Option<Vec<(u64, Input)>> {
        let (first, _) = self.range()?;
        (first == 0 && !self.is_cut).then(|| self.inputs.iter().cloned().collect())
    }

    /// Whether there are moments after a tick.
    pub fn reaches_past(&self, tick: u64) -> bool {
        self.moments.back().is_some_and(|last| last.world.tick > tick)
            || self.inputs.back().is_some_and(|&(at, _)| at > tick)
    }

    /// Drops the moments after a tick.
    pub fn forget_after(&mut self, tick: u64) {
        while self.moments.back().is_some_and(|last| last.world.tick > tick) {
            self.moments.pop_back();
        }
        while self.inputs.back().is_some_and(|&(at, _)| at > tick) {
            self.inputs.pop_back();
        }
        self.course.forget_after(tick);
    }

    /// The last state at or before a tick.
    pub fn at(&self, tick: u64) -> Option<&TrialState> {
        let after = self.moments.partition_point(|state| state.world.tick <= tick);
        after.checked_sub(1).map(|index| &*self.moments[index])
    }

    /// Number of moments, and of inputs.
    pub fn size(&self) -> (usize, usize) {
        (self.moments.len(), self.inputs.len())
    }

    /// First and last tick kept.
    pub fn range(&self) -> Option<(u64, u64)> {
        Some((self.moments.front()?.world.tick, self.moments.back()?.world.tick))
    }
}
