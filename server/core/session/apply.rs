//! Commands.

use std::sync::Arc;
use std::time::Duration;

use super::playing::Void;
use super::{Command, CommandError, SPEED_MAX, SPEED_MIN, STEP_MAX, Session};
use crate::image::ImageSource;
use crate::scenario::{ControllerName, Scenario};
use crate::trial::{Beginning, Input};

impl<E: ImageSource> Session<E> {
    /// Carries out a command; that of a `Step` begins. The caller then asks for messages and for a fault.
    ///
    /// # Errors
    /// [`CommandError`]; nothing has changed.
    pub fn apply(&mut self, command: Command, now: Duration) -> Result<(), CommandError> {
        let done = self.execute(command, now);
        self.check_question();
        self.announce();
        done
    }

    fn execute(&mut self, command: Command, now: Duration) -> Result<(), CommandError> {
        match command {
            Command::Input(input) => self.input(input)?,
            Command::Run => {
                self.running = true;
                self.pace.restart(now);
            }
            Command::Pause => {
                if self.trial.state().world.tick > 0 {
                    self.spoil(Void::Paused);
                }
                self.running = false;
                self.stepping = 0;
                self.program.forget();
            }
            Command::Attach(program) => {
                self.program.select(program);
                self.input(Input::SelectController(ControllerName::Program))?;
            }
            Command::Step(ticks) => {
                if !(1..=STEP_MAX).contains(&ticks) {
                    let allowed = format!("1 to {STEP_MAX}");
                    return Err(CommandError::Range { field: "ticks", value: f64::from(ticks), allowed });
                }
                self.spoil(Void::Paused);
                self.running = false;
                self.stepping = ticks;
            }
            Command::SetSpeed(factor) => {
                if !(SPEED_MIN..=SPEED_MAX).contains(&factor) {
                    let allowed = format!("{SPEED_MIN} to {SPEED_MAX}");
                    return Err(CommandError::Range { field: "factor", value: factor, allowed });
                }
                if factor != 1.0 {
                    self.spoil(Void::Speed);
                }
                self.pace.set_factor(factor, now);
            }
            Command::Reset(seed) => {
                if let Some(name) = self.challenge_name().filter(|_| seed.is_none()) {
                    return self.play(name, now);
                }
                let old = self.trial.scenario();
                let scenario = Scenario {
                    seed: seed.unwrap_or(old.seed),
                    controller: self.trial.state().controller,
                    parameters: self.trial.state().world.parameters.clone(),
                    ..old.clone()
                };
                self.set_up(scenario, self.trial.arena().clone(), self.scenery.case.clone())?;
            }
            Command::Play(name) => self.play(name, now)?,
            Command::Load { scenario, kept } => self.load(*scenario, kept)?,
            Command::Open(case) => self.open(*case)?,
            Command::Rewind(tick) => self.rewind(tick)?,
            Command::Return(number) => self.return_to(number)?,
            Command::TakeUp { moment, about, inputs } => self.take_up_moment(*moment, about, inputs)?,
        }
        Ok(())
    }

    fn rewind(&mut self, tick: u64) -> Result<(), CommandError> {
        let state = self.moment(tick)?.clone();
        self.running = false;
        if state.world.tick == self.trial.state().world.tick && state.hashes() == self.trial.state().hashes() {
            // Restoring it would drop the inputs that wait.
            return Ok(());
        }
        self.history.before_rewind(&self.trial);
        self.spoil(Void::Rewound);
        self.trial.restore(state);
        self.hand_is_stale = self.trial.state().world.plant.hand.is_some() && !self.case_holds();
        self.scenery = Arc::new(self.next_scenery(0));
        self.sink.begin(&self.trial, Beginning::Resumed);
        self.observe();
        Ok(())
    }

    /// Takes the current camera image, without a control step.
    pub(super) fn observe(&mut self) {
        match self.trial.observe(&mut self.camera) {
            Ok(sight) => self.sight = Arc::new((self.trial.state().world.tick, sight)),
            Err(error) => self.fault = Some(error.into()),
        }
    }

    /// Sends events of inputs at once if no tick will carry them.
    pub(super) fn announce(&mut self) {
        if self.running {
            return;
        }
        for event in self.trial.take_events() {
            self.note(event);
        }
    }
}
