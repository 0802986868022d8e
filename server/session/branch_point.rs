//! A moment taken out of a session, to explain it or to continue from it under other controllers. Both run the same
//! trial as the session, beside it, and do not change the session.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::camera::{Camera, Gpu, ImageSource};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{ControllerName, Parameters, Scenario};
use crate::trial::{
    Arena, Counters, Input, InputError, Moment, Source, Tally, TickRecord, Trial, TrialError, TrialState,
};

/// Maximum duration of a branch.
const HORIZON_S: f64 = 60.0;

/// A snapshot of a session, and the inputs after it.
#[derive(Clone, Debug)]
pub struct BranchPoint {
    scenario: Scenario,
    arena: Arc<Arena>,
    state: TrialState,
    /// Inputs after the snapshot, with the tick before which they were applied.
    inputs: Vec<(u64, Input)>,
}

/// Progress of a branch.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Its last tick.
    pub record: &'a TickRecord,
    /// Its tracking errors up to now.
    pub tally: &'a Tally,
    /// Tick of its first delivery.
    pub delivered_tick: Option<u64>,
    /// Whether it has ended.
    pub done: bool,
}

impl BranchPoint {
    pub(super) fn new(trial: &Trial, state: TrialState, inputs: Vec<(u64, Input)>) -> Self {
        Self { scenario: trial.scenario().clone(), arena: trial.arena().clone(), state, inputs }
    }

    pub fn tick(&self) -> u64 {
        self.state.world.tick
    }

    /// Tick at which branches end at the latest.
    pub fn until_tick(&self) -> u64 {
        self.tick() + (HORIZON_S / SERVO_PERIOD_S) as u64
    }

    /// Counters at the moment.
    pub fn counters(&self) -> Counters {
        self.state.world.counters
    }

    /// Sub-controller 2 at that moment.
    pub fn controller(&self) -> ControllerName {
        self.state.controller
    }

    pub fn arena(&self) -> &Arc<Arena> {
        &self.arena
    }

    /// Parameters at the moment.
    pub fn parameters(&self) -> &Parameters {
        &self.state.world.parameters
    }

    /// A separate camera.
    pub fn camera(&self, gpu: &Arc<Gpu>) -> Result<Camera, TrialError> {
        Ok(self.arena.camera(gpu)?)
    }

    /// Whether a goal is set at the moment or before [`Self::until_tick`].
    pub fn has_goal(&self) -> bool {
        let comes =
            |&(tick, ref input): &(u64, Input)| tick < self.until_tick() && matches!(input, Input::SetGoal { .. });
        self.state.world.goal_m.is_some() || self.inputs.iter().any(comes)
    }

    fn trial(&self) -> Result<Trial, TrialError> {
        let mut trial = Trial::new(self.scenario.clone(), self.arena.clone())?;
        trial.take_events();
        trial.restore(self.state.clone());
        Ok(trial)
    }

    /// The moment with the observation and decision of its control step.
    pub fn relive(&self, camera: &mut dyn ImageSource) -> Result<(Moment, TickRecord), TrialError> {
        let mut trial = self.trial()?;
        let before = trial.moment();
        Ok((before, trial.tick(Source::Camera(camera))?))
    }

    /// Continues from here under a controller, with the disturbances of hand and script at their ticks, until all goals
    /// are delivered or until [`Self::until_tick`]. `watch` is called after every tick and may stop it. Inputs that select
    /// controllers are omitted; inputs that are impossible in the branch are skipped.
    pub fn branch(
        &self,
        controller: ControllerName,
        camera: &mut dyn ImageSource,
        watch: &mut dyn FnMut(Progress<'_>) -> ControlFlow<()>,
    ) -> Result<(), TrialError> {
        let mut trial = self.trial()?;
        if controller != self.state.controller {
            trial.apply(Input::SelectController(controller))?;
        }
        let mut inputs =
            self.inputs.iter().filter(|(_, input)| !matches!(input, Input::SelectController(_))).peekable();
        let mut tally = Tally::default();
        let mut delivered_tick = None;
        let deliveries = self.state.world.counters.deliveries;
        loop {
            let tick = trial.state().world.tick;
            while let Some((_, input)) = inputs.next_if(|(at, _)| *at <= tick) {
                // For example, the bead may not fit where the hand put it in the session.
                let _: Result<(), InputError> = trial.apply(input.clone());
            }
            let record = trial.tick(Source::Camera(camera))?;
            tally.add(&record.moment);
            if delivered_tick.is_none() && record.moment.counters.deliveries > deliveries {
                delivered_tick = Some(record.tick);
            }
            let rests = record.moment.phase.is_final() && record.moment.hand.is_none();
            let done = record.tick >= self.until_tick() || (rests && inputs.peek().is_none());
            let progress = Progress { record: &record, tally: &tally, delivered_tick, done };
            if watch(progress).is_break() || done {
                return Ok(());
            }
        }
    }
}
