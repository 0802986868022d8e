//! A moment taken out of a session, to explain it or to continue from it under other controllers. Both run the same
//! trial as the session, beside it, and do not change the session.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::image::ImageSource;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{ControllerName, Parameters};
use crate::trial::{Arena, Counters, Input, InputError, Moment, Origin, Source, Tally, TickRecord, Trial, TrialError};

/// Maximum duration of a branch.
const HORIZON_S: f64 = 60.0;

/// A snapshot of a session, and the inputs after it.
#[derive(Clone, Debug)]
pub struct BranchPoint {
    pub origin: Origin,
    /// Inputs since the trial's start, if they are all known.
    pub told: Option<Vec<(u64, Input)>>,
    /// Inputs after the snapshot, with the tick before which they were applied.
    pub(super) inputs: Vec<(u64, Input)>,
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
    pub fn tick(&self) -> u64 {
        self.origin.tick()
    }

    /// Tick at which branches end at the latest.
    pub fn until_tick(&self) -> u64 {
        self.tick() + (HORIZON_S / SERVO_PERIOD_S) as u64
    }

    /// Counters at the moment.
    pub fn counters(&self) -> Counters {
        self.origin.state.world.counters
    }

    /// Sub-controller 2 at that moment.
    pub fn controller(&self) -> ControllerName {
        self.origin.state.controller
    }

    pub fn arena(&self) -> &Arc<Arena> {
        &self.origin.arena
    }

    /// Parameters at the moment.
    pub fn parameters(&self) -> &Parameters {
        &self.origin.state.world.parameters
    }

    /// Whether a goal is set at the moment or before [`Self::until_tick`].
    pub fn has_goal(&self) -> bool {
        let comes =
            |&(tick, ref input): &(u64, Input)| tick < self.until_tick() && matches!(input, Input::SetGoal { .. });
        self.origin.state.world.goal_m.is_some() || self.inputs.iter().any(comes)
    }

    /// The moment with the observation and decision of its control step.
    pub fn relive(&self, camera: &mut dyn ImageSource) -> Result<(Moment, TickRecord), TrialError> {
        let mut trial = self.origin.trial()?;
        let before = trial.moment();
        let at = |&&(tick, ref input): &&(u64, Input)| tick == self.tick() && is_answer(input);
        for (_, answer) in self.inputs.iter().filter(at) {
            trial.apply(answer.clone())?;
        }
        Ok((before, trial.tick(Source::Camera(camera))?))
    }

    /// Continues from here under a controller, with all steps of a leg and a goal, and with the goals and disturbances of
    /// hand and script at their ticks, until the first delivery or until [`Self::until_tick`]. `advance` makes each tick;
    /// `watch` is called after it and may stop the branch. Inputs that select controllers, and answers of a program, are
    /// omitted; inputs that are impossible in the branch are skipped.
    ///
    /// # Errors
    /// Those of `advance`, and [`TrialError`].
    pub fn branch<Error: From<TrialError>>(
        &self,
        controller: ControllerName,
        advance: &mut dyn FnMut(&mut Trial) -> Result<TickRecord, Error>,
        watch: &mut dyn FnMut(Progress<'_>) -> ControlFlow<()>,
    ) -> Result<(), Error> {
        let mut trial = self.origin.trial()?;
        trial.renew_steps();
        if controller != self.controller() {
            trial.apply(Input::SelectController(controller)).map_err(TrialError::from)?;
        }
        let is_taken = |(_, input): &&(u64, Input)| !matches!(input, Input::SelectController(_)) && !is_answer(input);
        let mut inputs = self.inputs.iter().filter(is_taken).peekable();
        let mut tally = Tally::default();
        let mut delivered_tick = None;
        let deliveries = self.counters().deliveries;
        loop {
            let tick = trial.state().world.tick;
            while let Some((_, input)) = inputs.next_if(|(at, _)| *at <= tick) {
                // For example, the bead may not fit where the hand put it in the session.
                let _: Result<(), InputError> = trial.apply(input.clone());
            }
            let record = advance(&mut trial)?;
            tally.add(&record.moment);
            if delivered_tick.is_none() && record.moment.counters.deliveries > deliveries {
                delivered_tick = Some(record.tick);
            }
            let rests = record.moment.phase.is_final() && record.moment.hand.is_none();
            // What comes after the delivery belongs to another goal.
            let is_over = delivered_tick.is_some() || inputs.peek().is_none();
            let done = record.tick >= self.until_tick() || (rests && is_over);
            let progress = Progress { record: &record, tally: &tally, delivered_tick, done };
            if watch(progress).is_break() || done {
                return Ok(());
            }
        }
    }
}

/// Whether a program has answered so.
pub(super) fn is_answer(input: &Input) -> bool {
    matches!(input, Input::Go { .. } | Input::Hold { .. })
}
