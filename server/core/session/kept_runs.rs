//! Kept runs: what a rewind, a reset or another scenario would end. The operator can return to each.

use std::collections::VecDeque;
use std::sync::Arc;

use super::opened_case::OpenedCase;
use super::timeline::Timeline;
use crate::scenario::{ControllerName, Scenario};
use crate::trial::{Arena, Event, TrialState};

/// Limits of all kept runs together; the oldest runs are dropped.
const MOST: usize = 8;
/// Twenty minutes.
const MOST_MOMENTS: usize = 4800;
const MOST_INPUTS: usize = 100_000;

/// A trial with its past, at its last tick.
#[derive(Debug)]
pub struct KeptRun {
    pub scenario: Scenario,
    pub arena: Arc<Arena>,
    pub state: TrialState,
    pub timeline: Timeline,
    pub journal: Arc<Vec<Event>>,
    pub case: Option<Arc<OpenedCase>>,
}

/// What a browser shows of a kept run.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptRunSummary {
    /// From 1, never used again while the session is open.
    pub number: u32,
    pub map: String,
    pub seed: u64,
    pub controller: ControllerName,
    /// Its last tick.
    pub tick: u64,
    pub deliveries: u32,
}

#[derive(Debug, Default)]
pub struct KeptRuns {
    /// Oldest first, with their numbers.
    kept: VecDeque<(u32, KeptRun)>,
    last: u32,
}

impl KeptRuns {
    /// Keeps a run, unless nothing has happened in it.
    pub fn keep(&mut self, run: KeptRun) {
        if run.state.world.tick == 0 {
            return;
        }
        self.last += 1;
        self.kept.push_back((self.last, run));
        while self.kept.len() > 1 && self.are_too_many() {
            self.kept.pop_front();
        }
    }

    fn are_too_many(&self) -> bool {
        let sizes = self.kept.iter().map(|(_, run)| run.timeline.size());
        let (moments, inputs) = sizes.fold((0, 0), |(a, b), (moments, inputs)| (a + moments, b + inputs));
        self.kept.len() > MOST || moments > MOST_MOMENTS || inputs > MOST_INPUTS
    }

    /// Oldest first.
    pub fn iter(&self) -> impl Iterator<Item = &KeptRun> {
        self.kept.iter().map(|(_, run)| run)
    }

    pub fn find(&self, number: u32) -> Option<&KeptRun> {
        self.kept.iter().find(|(own, _)| *own == number).map(|(_, run)| run)
    }

    pub fn take(&mut self, number: u32) -> Option<KeptRun> {
        let index = self.kept.iter().position(|(own, _)| *own == number)?;
        self.kept.remove(index).map(|(_, run)| run)
    }

    /// Oldest first.
    pub fn summaries(&self) -> Vec<KeptRunSummary> {
        let summary = |(number, run): &(u32, KeptRun)| KeptRunSummary {
            number: *number,
            map: run.scenario.map.clone(),
            seed: run.scenario.seed,
            controller: run.state.controller,
            tick: run.state.world.tick,
            deliveries: run.state.world.counters.deliveries,
        };
        self.kept.iter().map(summary).collect()
    }
}
