//! The session's thread.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use tokio::sync::{broadcast, oneshot, watch};

use super::kept_runs::KeptRuns;
use super::pacing::{LOOK_EVERY, Pace, SPEED_MAX, SPEED_MIN};
use super::playing::{Playing, Void};
use super::question::{Asking, Sees};
use super::timeline::Timeline;
use super::{COMMAND_QUEUE, Command, CommandError, Request, STEP_MAX, Scenery, View};
use crate::camera::{CameraError, ImageSource};
use crate::faults;
use crate::program::Program;
use crate::ur::{Robot, Twin};
use ferry_core::control::step_is_due;
use ferry_core::scenario::{ControllerName, Scenario};
use ferry_core::trial::{Arena, Beginning, Catalog, Event, Input, Sight, Sink, Source, Trial, TrialError, TrialState};

/// Watchers get a view every second tick at real time, a few more than a display shows, and one after each command.
const PUBLISH_EVERY: Duration = Duration::from_millis(16);
/// Maximum waiting time of commands while ticks are always due.
pub(super) const DRAIN_EVERY: Duration = Duration::from_millis(4);

/// How often a session that waits for a program's answer looks for it.
const ANSWER_EVERY: Duration = Duration::from_millis(1);

/// Creates a camera for an arena.
pub(super) type MakeCamera<E> = Box<dyn Fn(&Arena) -> Result<E, CameraError> + Send>;

/// A state, and the inputs that wait for its next tick.
pub(super) struct End {
    pub(super) state: TrialState,
    pub(super) waiting: Vec<Input>,
}

pub(super) struct Worker<E> {
    pub(super) trial: Trial,
    pub(super) make_camera: MakeCamera<E>,
    pub(super) camera: E,
    pub(super) sink: Box<dyn Sink>,
    pub(super) events: broadcast::Sender<Event>,
    pub(super) timeline: Timeline,
    /// The end before the first of several rewinds, until the trial goes on.
    pub(super) end: Option<End>,
    pub(super) kept_runs: KeptRuns,
    /// Tick at which the trial went on from what was saved.
    pub(super) resumed_tick: Option<u64>,
    /// Something that was saved could not be restored.
    pub(super) has_left_out: bool,
    pub(super) scenery: Arc<Scenery>,
    pub(super) sight: Arc<(u64, Sight)>,
    pub(super) running: bool,
    /// Whether the trial's hand comes from a rewind and no longer belongs to a pointer.
    pub(super) hand_is_stale: bool,
    pub(super) pace: Pace,
    pub(super) playing: Option<Playing>,
    /// Name of the session.
    pub(super) name: String,
    /// The program that was selected last.
    pub(super) program: Option<Arc<Program>>,
    /// The question that it has not answered yet.
    pub(super) asking: Option<Asking>,
    pub(super) journal: Arc<Vec<Event>>,
    /// Where the arm is reported, and whose clients may command it.
    pub(super) robot: Option<Arc<Robot>>,
    /// The robot outside of Ferry that the arm mirrors.
    pub(super) twin: Option<Arc<Twin>>,
    /// Ticks that are left of a `Step`. They run in slices, between which requests are answered.
    pub(super) stepping: u32,
    /// Who waits for the end of the `Step`.
    pub(super) stepped: Option<oneshot::Sender<Result<(), CommandError>>>,
    /// Commands that came during a `Step` and wait for its end.
    pub(super) deferred: VecDeque<Request>,
    /// The session ends while a command is carried out.
    pub(super) broken: Option<TrialError>,
    /// The session ends; no further work is started.
    pub(super) interrupted: Arc<AtomicBool>,
}

impl<E: ImageSource> Worker<E> {
    pub(super) fn new(
        name: &str,
        scenario: Scenario,
        arena: Arc<Arena>,
        catalog: Catalog,
        make_camera: MakeCamera<E>,
        sink: Box<dyn Sink>,
        events: broadcast::Sender<Event>,
    ) -> Result<Self, TrialError> {
        let mut camera = make_camera(&arena)?;
        let trial = Trial::new(scenario, arena)?;
        let scenery = Arc::new(Scenery::of(&trial, catalog, 0, 0));
        let sight = Arc::new((0, trial.observe(&mut camera)?));
        let mut timeline = Timeline::default();
        timeline.keep(trial.snapshot());
        let pace = Pace::new(1.0, Instant::now());
        Ok(Self {
            trial,
            make_camera,
            camera,
            sink,
            events,
            timeline,
            end: None,
            kept_runs: KeptRuns::default(),
            resumed_tick: None,
            has_left_out: false,
            scenery,
            sight,
            running: false,
            hand_is_stale: false,
            pace,
            playing: None,
            name: name.to_owned(),
            program: None,
            asking: None,
            journal: Arc::default(),
            robot: None,
            twin: None,
            stepping: 0,
            stepped: None,
            deferred: VecDeque::new(),
            broken: None,
            interrupted: Arc::default(),
        })
    }

    pub(super) fn view(&self) -> View {
        View {
            moment: self.trial.moment(),
            world_hash: self.trial.state().world_hash(),
            running: self.running,
            speed_target: self.pace.factor(),
            speed_achieved: if self.running { self.pace.achieved() } else { 0.0 },
            lateness: if self.running { self.pace.lateness() } else { Duration::ZERO },
            missed_deadlines: self.pace.missed(),
            rewind_ticks: self.timeline.range().unwrap_or_default(),
            scenery: self.scenery.clone(),
            sight: self.sight.clone(),
            journal: self.journal.clone(),
            attempt: self.playing.as_ref().map(|playing| playing.standing(self.trial.state().world.tick)),
            program: self.program.clone(),
            robot: self.robot.as_ref().map(|robot| robot.standing()),
            twin: self.twin.as_ref().map(|twin| twin.standing()),
            recording: self.sink.status(),
            ended: None,
        }
    }

    /// Runs until every sender of commands is dropped. A panic or a lost camera ends only this session, with a
    /// message.
    pub(super) fn run(mut self, inbox: &Receiver<Request>, publish: &watch::Sender<Arc<View>>) {
        let outcome = catch_unwind(AssertUnwindSafe(|| self.serve(inbox, publish)));
        if let Some(program) = &self.program {
            program.end(&self.name);
        }
        let reason = match outcome {
            Ok(Ok(())) => return,
            Ok(Err(error)) => error.to_string(),
            Err(panic) => faults::words(&*panic),
        };
        tracing::error!(reason, "session ended");
        let mut last = View::clone(&publish.borrow());
        last.running = false;
        last.ended = Some(reason);
        publish.send_replace(Arc::new(last));
    }

    fn serve(&mut self, inbox: &Receiver<Request>, publish: &watch::Sender<Arc<View>>) -> Result<(), TrialError> {
        let mut publish_at = Instant::now();
        loop {
            self.give_arm(publish);
            self.run_for_twin(publish);
            let now = Instant::now();
            let steps = self.stepping > 0 || self.stepped.is_some() || !self.deferred.is_empty();
            let wait = match (steps, self.running) {
                (true, _) => Duration::ZERO,
                (false, true) => self.pace.wait(now),
                (false, false) => LOOK_EVERY,
            };
            let wait = if self.awaits_answer() { wait.max(ANSWER_EVERY) } else { wait };
            if wait > Duration::ZERO {
                match inbox.recv_timeout(wait) {
                    Ok(request) => self.answer(request, publish)?,
                    Err(RecvTimeoutError::Timeout) if wait == LOOK_EVERY => self.look_around(publish),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return Ok(()),
                }
                continue;
            }
            let (burst, was_running) = (Instant::now(), self.running);
            while self.running && burst.elapsed() < DRAIN_EVERY && self.pace.wait(Instant::now()).is_zero() {
                if !self.tick()? {
                    break;
                }
                self.pace.ticked(Instant::now());
            }
            self.step_on(burst, publish)?;
            while self.deferred.len() < COMMAND_QUEUE {
                match inbox.try_recv() {
                    Ok(request) => self.answer(request, publish)?,
                    Err(std::sync::mpsc::TryRecvError::Empty) => break,
                    Err(std::sync::mpsc::TryRecvError::Disconnected) => return Ok(()),
                }
            }
            let now = Instant::now();
            // The end of an attempt pauses the session: its last state is not followed by others.
            if now >= publish_at || (was_running && !self.running) {
                publish.send_replace(Arc::new(self.view()));
                // Ticks come every 8 ms; a view that is due between two of them must not wait for the third.
                publish_at = (publish_at + PUBLISH_EVERY).max(now - PUBLISH_EVERY / 2);
            }
        }
    }

    /// Runs a request and sends its answer; the answer is dropped when the caller no longer waits. During a `Step`, a
    /// command waits for its end, so that commands that follow each other are carried out in order; `Pause` ends it.
    pub(super) fn answer(&mut self, request: Request, publish: &watch::Sender<Arc<View>>) -> Result<(), TrialError> {
        match request {
            Request::Execute { command, answer } if self.stepping > 0 && !matches!(command, Command::Pause) => {
                self.deferred.push_back(Request::Execute { command, answer });
            }
            Request::Execute { command, answer } => {
                let result = self.obey(command);
                self.check_question();
                if let Some(fault) = self.broken.take() {
                    let _ = answer.send(Err(CommandError::Ended));
                    return Err(fault);
                }
                self.announce();
                if result.is_ok() && self.stepping > 0 {
                    self.stepped = Some(answer);
                    return Ok(());
                }
                publish.send_replace(Arc::new(self.view()));
                let _ = answer.send(result);
            }
            Request::Recall { tick, moment, answer } => {
                let _ = answer.send(self.recall(tick, moment));
            }
            Request::Case { answer } => {
                let _ = answer.send(self.case());
            }
            Request::Played { answer } => {
                let _ = answer.send(self.played());
            }
            Request::Save { answer } => {
                let _ = answer.send(self.saved());
            }
            Request::Robot(robot) => self.robot = Some(robot),
            Request::Twin(twin) => self.twin = Some(twin),
        }
        // A reset moves the arm without a tick.
        self.report_arm();
        Ok(())
    }

    pub(super) fn obey(&mut self, command: Command) -> Result<(), CommandError> {
        if self.interrupted.load(Ordering::Relaxed) && !matches!(command, Command::Pause) {
            return Err(CommandError::Ended);
        }
        self.let_go_for(&command);
        match command {
            Command::Input(input) => self.input(input)?,
            Command::Run => {
                self.running = true;
                self.pace.restart(Instant::now());
            }
            Command::Pause => {
                if self.trial.state().world.tick > 0 {
                    self.spoil(Void::Paused);
                }
                self.running = false;
                self.stepping = 0;
                self.asking = None;
            }
            Command::Attach(program) => {
                if let Some(last) = self.program.replace(program) {
                    last.end(&self.name);
                }
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
                self.pace.set_factor(factor, Instant::now());
            }
            Command::Reset(seed) => {
                if let Some(name) = self.challenge_name().filter(|_| seed.is_none()) {
                    return self.play(name);
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
            Command::Play(name) => self.play(name)?,
            Command::Load { scenario, kept } => self.load(*scenario, kept)?,
            Command::Open(case) => self.open(*case)?,
            Command::Rewind(tick) => {
                let state = self.moment(tick)?.clone();
                self.running = false;
                if state.world.tick == self.trial.state().world.tick && state.hashes() == self.trial.state().hashes() {
                    // Restoring it would drop the inputs that wait.
                    return Ok(());
                }
                if self.end.is_none() {
                    self.end = Some(self.present());
                }
                self.spoil(Void::Rewound);
                self.trial.restore(state);
                self.hand_is_stale = self.trial.state().world.plant.hand.is_some() && !self.case_holds();
                self.scenery = Arc::new(self.next_scenery(0));
                self.sink.begin(&self.trial, Beginning::Resumed);
                self.observe();
            }
            Command::Return(number) => self.return_to(number)?,
            Command::TakeUp { moment, about, inputs } => self.take_up_moment(*moment, about, inputs)?,
        }
        Ok(())
    }

    /// Publishes the current camera image, without a control step.
    pub(super) fn observe(&mut self) {
        match self.trial.observe(&mut self.camera) {
            Ok(sight) => self.sight = Arc::new((self.trial.state().world.tick, sight)),
            Err(error) => self.broken = Some(error.into()),
        }
    }

    /// Runs a tick. Returns false if it did not, because a program has not answered yet.
    pub(super) fn tick(&mut self) -> Result<bool, TrialError> {
        self.drop_stale_hand()?;
        let tick = self.trial.state().world.tick;
        if step_is_due(tick) && self.asking.is_none() {
            self.forget_after(tick);
            self.timeline.keep(self.trial.snapshot());
        }
        self.ask_robot();
        self.mirror_robot();
        let source = match self.see()? {
            Sees::Waits => return Ok(false),
            Sees::Now(seen) => Source::Seen(seen),
            Sees::Camera => Source::Camera(&mut self.camera),
        };
        fault_point!("step");
        let mut record = self.trial.tick(source)?;
        self.sink.record(&record);
        if self.sink.wants_beginning() {
            self.sink.begin(&self.trial, Beginning::Resumed);
        }
        self.timeline.note(record.tick - 1, &record.inputs);
        self.referee(&record);
        for event in record.events.drain(..) {
            self.report(event);
        }
        if let Some(sight) = record.sight {
            self.sight = Arc::new((record.tick, sight));
        }
        self.lead_twin();
        self.apply_case();
        self.report_arm();
        Ok(true)
    }
}
