//! The past of a session: the moments to rewind to, the runs that were kept, and the events so far.

use std::sync::Arc;

use super::JOURNAL;
use super::kept_runs::{KeptRun, KeptRunSummary, KeptRuns};
use super::opened_case::OpenedCase;
use super::timeline::Timeline;
use crate::trial::{Event, Input, TickRecord, Trial, TrialState};

/// A state, and the inputs that wait for its next tick.
struct End {
    state: TrialState,
    waiting: Vec<Input>,
}

impl End {
    fn of(trial: &Trial) -> Self {
        Self { state: trial.snapshot(), waiting: trial.waiting_inputs().to_vec() }
    }
}

pub struct History {
    timeline: Timeline,
    /// The end before the first of several rewinds, until the trial goes on.
    end: Option<End>,
    kept_runs: KeptRuns,
    journal: Arc<Vec<Event>>,
}

impl History {
    /// It begins with this state.
    pub fn from_state(state: TrialState) -> Self {
        let mut timeline = Timeline::default();
        timeline.keep(state);
        Self { timeline, end: None, kept_runs: KeptRuns::default(), journal: Arc::default() }
    }

    pub fn timeline(&self) -> &Timeline {
        &self.timeline
    }

    /// First and last tick that a rewind reaches.
    pub fn range(&self) -> (u64, u64) {
        self.timeline.range().unwrap_or_default()
    }

    pub fn keep_state(&mut self, state: TrialState) {
        self.timeline.keep(state);
    }

    /// Notes a tick and the inputs that were applied before it.
    pub fn note(&mut self, record: &TickRecord) {
        self.timeline.note(record.tick - 1, &record.inputs);
        self.timeline.follow(&record.moment);
    }

    /// A rewind follows.
    pub fn before_rewind(&mut self, trial: &Trial) {
        self.end.get_or_insert_with(|| End::of(trial));
    }

    /// The newest state, also after a rewind.
    pub fn newest<'a>(&'a self, trial: &'a Trial) -> &'a TrialState {
        self.end.as_ref().map_or(trial.state(), |end| &end.state)
    }

    /// Drops everything after a tick. What a rewind has left behind becomes a run: then the answer is true.
    pub fn forget_after(&mut self, tick: u64, trial: &Trial, case: Option<&Arc<OpenedCase>>) -> bool {
        let end = self.end.take().filter(|_| self.timeline.reaches_past(tick));
        let has_kept = end.is_some();
        if let Some(end) = end {
            self.keep_end(end, trial, case);
        }
        self.timeline.forget_after(tick);
        if self.journal.iter().any(|told| told.tick > tick) {
            Arc::make_mut(&mut self.journal).retain(|told| told.tick <= tick);
        }
        has_kept
    }

    /// Keeps the trial with its past, before another one follows.
    pub fn leave(&mut self, trial: &Trial, case: Option<&Arc<OpenedCase>>) {
        let end = self.end.take().unwrap_or_else(|| End::of(trial));
        self.keep_end(end, trial, case);
        (self.timeline, self.journal) = Default::default();
    }

    fn keep_end(&mut self, End { state, waiting }: End, trial: &Trial, case: Option<&Arc<OpenedCase>>) {
        let mut timeline = self.timeline.clone();
        // The state contains what these inputs did, but no tick has noted them.
        timeline.note(state.world.tick, &waiting);
        self.kept_runs.keep(KeptRun {
            scenario: trial.scenario().clone(),
            arena: trial.arena().clone(),
            state,
            timeline,
            journal: self.journal.clone(),
            case: case.cloned(),
        });
    }

    /// The past is this one from now on; the one before was left.
    pub fn take_up(&mut self, timeline: Timeline, journal: Arc<Vec<Event>>) {
        (self.timeline, self.journal) = (timeline, journal);
    }

    pub fn kept_runs(&self) -> &KeptRuns {
        &self.kept_runs
    }

    pub fn summaries(&self) -> Vec<KeptRunSummary> {
        self.kept_runs.summaries()
    }

    pub fn keep_run(&mut self, run: KeptRun) {
        self.kept_runs.keep(run);
    }

    pub fn take_run(&mut self, number: u32) -> Option<KeptRun> {
        self.kept_runs.take(number)
    }

    pub fn journal(&self) -> &Arc<Vec<Event>> {
        &self.journal
    }

    /// Stores an event in the journal.
    pub fn report(&mut self, event: &Event) {
        // Only once: after a rewind a control step happens again at its tick.
        if !self.journal.contains(event) {
            let journal = Arc::make_mut(&mut self.journal);
            if journal.len() == JOURNAL {
                journal.remove(0);
            }
            journal.push(event.clone());
        }
    }
}
