//! The thread of a session.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::{Duration, Instant};

use tokio::sync::{broadcast, watch};

use super::program_link::ProgramLink;
use super::robot_link::RobotLink;
use super::stepper::Stepper;
use super::{BranchPoint, CommandError, EndFact, Request, View};
use ferry_core::image::ImageSource;
use ferry_core::panics;
use ferry_core::session::{Command, Message, Session};
use ferry_core::trial::{Event, TrialError};

/// Watchers get a view every second tick at real time, a few more than a display shows, and one after each command.
const PUBLISH_EVERY: Duration = Duration::from_millis(16);
/// Maximum waiting time of commands while ticks are always due.
const DRAIN_EVERY: Duration = Duration::from_millis(4);
/// How often a session that waits for a program's answer looks for it.
const ANSWER_EVERY: Duration = Duration::from_millis(1);
/// How often a paused session looks at its recording and at the robot's clients.
const LOOK_EVERY: Duration = Duration::from_millis(300);

pub struct SessionThread<E> {
    pub(super) session: Session<E>,
    /// Name of the session.
    name: String,
    /// Time 0 of the session's clock.
    start: Instant,
    events: broadcast::Sender<Event>,
    view: watch::Sender<Arc<View>>,
    program: ProgramLink,
    pub(super) robots: RobotLink,
    stepper: Stepper,
    /// The session ends; no further work is started.
    interrupted: Arc<AtomicBool>,
}

impl<E: ImageSource> SessionThread<E> {
    /// The thread's state, and the views that it will publish.
    pub fn new(
        name: &str,
        session: Session<E>,
        start: Instant,
        events: broadcast::Sender<Event>,
        interrupted: Arc<AtomicBool>,
    ) -> (Self, watch::Receiver<Arc<View>>) {
        let first = View { number: 0, session: session.view(), program: None, robot: None, twin: None, ended: None };
        let (view, watched) = watch::channel(Arc::new(first));
        let thread = Self {
            session,
            name: name.to_owned(),
            start,
            events,
            view,
            program: ProgramLink::default(),
            robots: RobotLink::default(),
            stepper: Stepper::default(),
            interrupted,
        };
        (thread, watched)
    }

    fn is_interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    pub(super) fn publish(&self) {
        let number = self.view.borrow().number + 1;
        self.view.send_replace(Arc::new(View {
            number,
            session: self.session.view(),
            program: self.program.selected().cloned(),
            robot: self.robots.robot_standing(),
            twin: self.robots.twin_standing(),
            ended: None,
        }));
    }

    /// Runs until every sender of commands is dropped. A panic or a lost camera ends only this session, with a
    /// message.
    pub fn run(mut self, inbox: &Receiver<Request>) {
        let outcome = catch_unwind(AssertUnwindSafe(|| self.serve(inbox)));
        self.program.end(&self.name);
        let reason = match outcome {
            Ok(Ok(())) => return,
            Ok(Err(error)) => EndFact::TrialFailed { detail: error.to_string() },
            Err(panic) => EndFact::Crashed { detail: panics::message(&*panic) },
        };
        tracing::error!(%reason, "session ended");
        let mut last = View::clone(&self.view.borrow());
        last.number += 1;
        last.session.running = false;
        last.ended = Some(reason);
        self.view.send_replace(Arc::new(last));
    }

    fn serve(&mut self, inbox: &Receiver<Request>) -> Result<(), TrialError> {
        // Events of its start.
        self.deliver();
        let mut publish_at = Instant::now();
        loop {
            self.give_arm()?;
            self.run_for_twin()?;
            let asks = self.program.look(&mut self.session);
            let wait = match self.stepper.is_waiting() && !self.session.is_stepping() {
                true => Duration::ZERO,
                false => self.session.wait(self.start.elapsed()).unwrap_or(LOOK_EVERY),
            };
            let wait = if asks { wait.min(ANSWER_EVERY) } else { wait };
            if wait > Duration::ZERO {
                match inbox.recv_timeout(wait) {
                    Ok(request) => self.answer(request)?,
                    Err(RecvTimeoutError::Timeout) if wait == LOOK_EVERY => self.look_around(),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return Ok(()),
                }
                continue;
            }
            let (burst, was_running) = (Instant::now(), self.session.is_running());
            while burst.elapsed() < DRAIN_EVERY && self.tick()? {}
            self.go_on_after_step()?;
            while !self.stepper.is_full() {
                match inbox.try_recv() {
                    Ok(request) => self.answer(request)?,
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => return Ok(()),
                }
            }
            let now = Instant::now();
            // The end of an attempt pauses the session: its last state is not followed by others.
            if now >= publish_at || (was_running && !self.session.is_running()) {
                self.publish();
                // Ticks come every 8 ms; a view that is due between two of them must not wait for the third.
                publish_at = (publish_at + PUBLISH_EVERY).max(now - PUBLISH_EVERY / 2);
            }
        }
    }

    /// Makes the next tick if it is due; the robots take part in it.
    fn tick(&mut self) -> Result<bool, TrialError> {
        let now = self.start.elapsed();
        if self.session.wait(now) != Some(Duration::ZERO) {
            return Ok(false);
        }
        if self.session.is_stepping() && self.is_interrupted() {
            // The session ends: the step is not done, and dropping the answers says so.
            self.stepper = Stepper::default();
            return Ok(false);
        }
        self.robots.before_tick(&mut self.session);
        #[cfg(test)]
        crate::faults::strike();
        let has_ticked = self.session.advance(now)?;
        self.deliver();
        if has_ticked {
            self.robots.after_tick(&self.session);
        }
        Ok(has_ticked)
    }

    /// Passes on what the session says.
    fn deliver(&mut self) {
        for message in self.session.take_messages() {
            match message {
                Message::Event(event) => {
                    let _ = self.events.send(event);
                }
                Message::Ask { number, query } => self.program.ask(&self.name, number, query, &mut self.session),
                Message::Unanswered { number } => self.program.missed(number),
            }
        }
    }

    /// What waited for a `Step`, when it is done.
    fn go_on_after_step(&mut self) -> Result<(), TrialError> {
        while !self.session.is_stepping() {
            if let Some(answer) = self.stepper.end() {
                self.publish();
                let _ = answer.send(Ok(()));
            }
            let Some(request) = self.stepper.next() else { break };
            self.answer(request)?;
        }
        Ok(())
    }

    /// Carries out a request and sends its answer; the answer is dropped when the caller no longer waits. During a
    /// `Step`, a command waits for its end, so that commands that follow each other are carried out in order; `Pause`
    /// ends it.
    fn answer(&mut self, request: Request) -> Result<(), TrialError> {
        match request {
            Request::Execute { command, answer }
                if self.session.is_stepping() && !matches!(command, Command::Pause) =>
            {
                self.stepper.defer(Request::Execute { command, answer });
            }
            Request::Attach { program, answer } if self.session.is_stepping() => {
                self.stepper.defer(Request::Attach { program, answer });
            }
            Request::Execute { command, answer } => {
                let result = self.apply(command);
                self.conclude(result, answer)?;
            }
            Request::Attach { program, answer } => {
                let command = Command::Attach(program.name.clone());
                self.program.select(program, &self.name);
                let result = self.apply(command);
                self.conclude(result, answer)?;
            }
            Request::Recall { tick, moment, answer } => {
                let point = self.session.recall(tick, moment);
                let program = self.program.selected().cloned();
                let point = point.map(|point| BranchPoint::new(point, &self.name, program));
                let _ = answer.send(point.map_err(CommandError::from));
            }
            Request::Case { answer } => {
                let _ = answer.send(self.session.case().map_err(CommandError::from));
            }
            Request::Played { answer } => {
                let _ = answer.send(self.session.played().map_err(CommandError::from));
            }
            Request::Save { answer } => {
                let _ = answer.send(Ok(self.session.saved()));
            }
            Request::Robot(robot) => self.robots.connect_robot(robot),
            Request::Twin(twin) => self.robots.connect_twin(twin),
        }
        // A reset moves the arm without a tick.
        self.robots.report_arm(&self.session);
        Ok(())
    }

    /// Publishes the effect of a command, then answers it. A `Step` has begun only.
    fn conclude(&mut self, result: Result<(), CommandError>, answer: super::Answer<()>) -> Result<(), TrialError> {
        if let Some(fault) = self.session.take_fault() {
            let _ = answer.send(Err(CommandError::Ended));
            return Err(fault);
        }
        if result.is_ok() && self.session.is_stepping() {
            self.stepper.begin(answer);
            return Ok(());
        }
        self.publish();
        let _ = answer.send(result);
        Ok(())
    }

    pub(super) fn apply(&mut self, command: Command) -> Result<(), CommandError> {
        if self.is_interrupted() && !matches!(command, Command::Pause) {
            return Err(CommandError::Ended);
        }
        self.robots.before_command(&command);
        let done = self.session.apply(command, self.start.elapsed());
        self.deliver();
        Ok(done?)
    }

    /// What a paused session does: it looks at its recording, which may be interrupted meanwhile, and at the robot's
    /// clients. It publishes a change.
    fn look_around(&mut self) {
        self.robots.report_news(&mut self.session);
        self.deliver();
        let has_changed = {
            let last = self.view.borrow();
            self.session.recording() != last.recording
                || self.robots.robot_standing() != last.robot
                || self.robots.twin_standing() != last.twin
        };
        if has_changed {
            self.publish();
        }
    }

    /// Gives the arm to a program that a client has sent to the robot: the session runs, at real speed.
    fn give_arm(&mut self) -> Result<(), TrialError> {
        let Some(robot) = self.robots.robot_that_wants_the_arm() else { return Ok(()) };
        robot.controller().give_arm();
        for command in RobotLink::commands_of_robot() {
            if let Err(error) = self.apply(command) {
                robot.controller().refuse("a program", &error.to_string());
                break;
            }
        }
        self.publish();
        self.session.take_fault().map_or(Ok(()), Err)
    }

    /// Runs at real speed when the robot is connected, and while it is to follow.
    fn run_for_twin(&mut self) -> Result<(), TrialError> {
        let Some(twin) = self.robots.twin_that_wants_to_run() else { return Ok(()) };
        if self.session.is_running() && self.session.speed_target() == 1.0 {
            return Ok(());
        }
        for command in RobotLink::commands_of_twin() {
            if self.apply(command).is_err() {
                twin.let_go();
            }
        }
        self.publish();
        self.session.take_fault().map_or(Ok(()), Err)
    }
}
