//! Another trial in the same session: a reset, another scenario, a test case, or a kept run.

use std::sync::Arc;

use super::kept_runs::KeptRun;
use super::opened_case::OpenedCase;
use super::timeline::Timeline;
use super::{CommandError, Kept, Scenery, Session};
use crate::image::ImageSource;
use crate::map::is_added;
use crate::scenario::Scenario;
use crate::trial::{
    Arena, Beginning, Case, Event, Happening, Input, InputError, Origin, Sight, Timed, Trial, TrialError,
};

impl<E: ImageSource> Session<E> {
    pub(super) fn load(&mut self, mut scenario: Scenario, kept: Kept) -> Result<(), CommandError> {
        // Only a name: no path from a client touches the file system.
        let arena = self.scenery.catalog.arena(&scenario.map)?;
        let present = self.trial.state();
        if kept.controller {
            scenario.controller = present.controller;
        }
        if kept.seed {
            scenario.seed = self.trial.scenario().seed;
        }
        if kept.parameters {
            scenario.parameters = present.world.parameters.clone();
        } else {
            self.scenery.catalog.resolve(&mut scenario.parameters)?;
        }
        self.replace(scenario, arena, None)
    }

    /// A new trial, possibly in another arena.
    pub(super) fn replace(
        &mut self,
        scenario: Scenario,
        arena: Arc<Arena>,
        case: Option<Arc<OpenedCase>>,
    ) -> Result<(), CommandError> {
        let camera = (self.make_camera)(&arena).map_err(TrialError::from)?;
        let before = std::mem::replace(&mut self.camera, camera);
        let done = self.set_up(scenario, arena, case);
        if done.is_err() {
            self.camera = before;
        }
        done
    }

    pub(super) fn set_up(
        &mut self,
        scenario: Scenario,
        arena: Arc<Arena>,
        case: Option<Arc<OpenedCase>>,
    ) -> Result<(), CommandError> {
        let trial = Trial::new(scenario, arena)?;
        let sight = trial.observe(&mut self.camera).map_err(TrialError::from)?;
        self.history.leave(&self.trial, self.scenery.case.as_ref());
        self.playing = None;
        self.trial = trial;
        self.running = false;
        self.hand_is_stale = false;
        self.scenery = Arc::new(Scenery { case, ..self.next_scenery(1) });
        self.sink.begin(&self.trial, Beginning::SetUp);
        self.sight = Arc::new((0, sight));
        self.history.keep_state(self.trial.snapshot());
        let scenario = self.trial.scenario();
        let inputs = self.scenery.case.as_ref().map(|case| case.inputs().len() as u32);
        let what = Happening::SetUp { map: scenario.map.clone(), seed: scenario.seed, inputs };
        self.note(Event::new(0, what));
        self.apply_case();
        if !self.trial.waiting_inputs().is_empty() {
            self.history.keep_state(self.trial.snapshot());
            self.observe();
        }
        Ok(())
    }

    pub(super) fn return_to(&mut self, number: u32) -> Result<(), CommandError> {
        let run = self.history.kept_runs().find(number).ok_or(CommandError::NoRun { number })?;
        let prepared = self.prepare(run)?;
        let Some(run) = self.history.take_run(number) else { return Err(CommandError::NoRun { number }) };
        self.take_up(run, prepared);
        self.note(Event::new(self.trial.state().world.tick, Happening::Returned { run: number }));
        Ok(())
    }

    pub(super) fn take_up_moment(
        &mut self,
        Origin { scenario, arena, state }: Origin,
        about: String,
        inputs: Vec<Timed>,
    ) -> Result<(), CommandError> {
        let timeline = Timeline::from_state(state.clone());
        let what = Happening::TookUp { about: about.clone() };
        let case = Some(Arc::new(OpenedCase::new(about, inputs, None)));
        let run = KeptRun { scenario, arena, state, timeline, journal: Arc::default(), case };
        let prepared = self.prepare(&run)?;
        self.take_up(run, prepared);
        self.note(Event::new(self.trial.state().world.tick, what));
        self.apply_case();
        self.observe();
        Ok(())
    }

    /// Everything of a run's end that can fail.
    pub(super) fn prepare(&self, run: &KeptRun) -> Result<(E, Trial, Sight), TrialError> {
        let mut camera = (self.make_camera)(&run.arena)?;
        let mut trial = Trial::new(run.scenario.clone(), run.arena.clone())?;
        trial.take_events();
        trial.restore(run.state.clone());
        let sight = trial.observe(&mut camera)?;
        Ok((camera, trial, sight))
    }

    /// Puts a run in the place of the present one, which is kept.
    pub(super) fn take_up(&mut self, run: KeptRun, (camera, trial, sight): (E, Trial, Sight)) {
        self.history.leave(&self.trial, self.scenery.case.as_ref());
        self.playing = None;
        self.trial = trial;
        self.camera = camera;
        self.running = false;
        self.history.take_up(run.timeline, run.journal);
        let mut scenery = self.next_scenery(1);
        scenery.past_version += 1;
        scenery.case = run.case;
        self.scenery = Arc::new(scenery);
        self.hand_is_stale = self.trial.state().world.plant.hand.is_some() && !self.case_holds();
        self.sink.begin(&self.trial, Beginning::Returned);
        self.sight = Arc::new((self.trial.state().world.tick, sight));
    }

    pub(super) fn next_scenery(&self, new_trials: u64) -> Scenery {
        let before = &self.scenery;
        Scenery {
            past_version: before.past_version,
            case: before.case.clone(),
            challenge: before.challenge.clone().filter(|_| self.playing.is_some()),
            kept_runs: self.history.summaries(),
            ..Scenery::of(&self.trial, before.catalog.clone(), before.version + 1, before.trial + new_trials)
        }
    }

    pub(super) fn open(&mut self, mut case: Case) -> Result<(), CommandError> {
        let catalog = &self.scenery.catalog;
        catalog.resolve(&mut case.scenario.parameters)?;
        let arena = match &case.map {
            None => catalog.arena(&case.scenario.map)?,
            Some(own) => match catalog.maps.find(&own.name) {
                Ok(map) if map.svg() == own.svg => catalog.arena_of(map.as_read_by(own.reader)?),
                // The experiment's link would open the other drawing.
                Ok(_) => return Err(CommandError::OtherDrawing { name: own.name.clone() }),
                Err(error) if !is_added(&own.name) => return Err(error.into()),
                Err(_) => {
                    let map = own.map()?;
                    catalog.maps.reserve(&own.name);
                    catalog.arena_of(map)
                }
            },
        };
        let scenario = Scenario { map: arena.map.name().to_owned(), ..case.scenario };
        let opened = OpenedCase::new(case.about, case.inputs, case.expect);
        self.replace(scenario, arena, Some(opened.into()))
    }

    /// Applies the inputs that are due now. As in [`Case::run`], an impossible one is left out.
    pub(super) fn apply_case(&mut self) {
        let Some(case) = self.scenery.case.clone() else { return };
        let tick = self.trial.state().world.tick;
        let due = case.inputs_from(tick).iter().take_while(|timed| timed.tick == tick);
        let (mut configures, mut left_out) = (false, None::<(u32, InputError)>);
        for Timed { input, .. } in due {
            match self.trial.apply(input.clone()) {
                Ok(()) => configures |= matches!(input, Input::Configure(_)),
                Err(error) => left_out = Some((left_out.map_or(1, |(count, _)| count + 1), error)),
            }
        }
        if configures {
            self.scenery = self.next_scenery(0).into();
        }
        if let Some((count, error)) = left_out {
            self.note(Event::new(tick, Happening::InputsLeftOut { count, detail: error.to_string() }));
        }
    }

    /// Inputs of the case that a state of this tick does not contain, and that have not been applied in the session.
    pub(super) fn case_inputs_after(&self, tick: u64) -> impl Iterator<Item = (u64, Input)> {
        let newest = self.history.newest(&self.trial).world.tick;
        let from = newest.max(tick + 1);
        let ahead = self.scenery.case.as_ref().map_or(&[][..], |case| case.inputs_from(from));
        ahead.iter().map(|timed| (timed.tick, timed.input.clone()))
    }

    /// Whether the state's hand is that of the case, which goes on holding.
    pub(super) fn case_holds(&self) -> bool {
        self.scenery.case.as_ref().is_some_and(|case| case.holds_at(self.trial.state().world.tick))
    }
}
