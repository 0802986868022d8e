//! A trial on a real clock, in a separate thread: commands in, views and records out.
//!
//! Only this thread accesses the trial. Holders of a [`Session`] send commands through a
//! bounded queue (a full queue refuses) and watch views. A slow watcher sees only the newest view.

mod asking;
mod branch_point;
#[cfg(test)]
mod command_tests;
mod contest;
mod error;
mod events;
mod idle;
mod inputs;
mod kept_runs;
mod opened_case;
mod pacing;
mod playing;
mod question;
mod recall;
mod robot;
mod saved;
mod stepping;
mod timeline;
mod trials;
mod twin;
mod worker;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use tokio::sync::{broadcast, oneshot, watch};

use crate::camera::{Camera, Gpu};
use crate::program::Program;
use crate::ur::{Robot, Standing as RobotStanding, Twin, TwinStanding};
use ferry_core::challenge::{Challenge, ChallengeName};
use ferry_core::plant::PositionerKind;
use ferry_core::scenario::{Parameters, Scenario};
use ferry_core::trial::{
    Arena, Case, Catalog, Event, Input, LogError, Moment, Origin, Sight, Sink, Timed, Trial, TrialError,
};

pub use branch_point::{BranchPoint, Progress};
pub use error::CommandError;
pub use kept_runs::KeptRunSummary;
pub use opened_case::OpenedCase;
pub use pacing::{SPEED_MAX, SPEED_MIN};

pub use playing::{Ended, Played, Standing, Void};
pub use saved::Saved;

/// Maximum number of waiting commands.
const COMMAND_QUEUE: usize = 256;
/// Number of events that a slow watcher may lag behind before it loses the oldest.
const EVENT_QUEUE: usize = 256;
/// Number of past events that a new browser receives.
pub const JOURNAL: usize = 500;
/// Maximum ticks of one `Step`.
const STEP_MAX: u32 = 12_500;
/// Longer than the maximum number of steps takes on a slow machine; a session that hangs must not block its callers.
const ANSWER_WITHIN: Duration = Duration::from_secs(30);

/// A command to a session.
#[derive(Clone, Debug)]
pub enum Command {
    /// An input of the trial.
    Input(Input),
    Run,
    Pause,
    /// Advances this many ticks, then pauses.
    Step(u32),
    /// Selects a program as sub-controller 2.
    Attach(Arc<Program>),
    /// Sets the speed, in simulated seconds per second.
    SetSpeed(f64),
    /// Back to the start, with a new seed or the same one.
    Reset(Option<u64>),
    /// A new trial of this scenario, except for the kept parts.
    Load {
        scenario: Box<Scenario>,
        kept: Kept,
    },
    /// A new trial of this challenge, paused, at real speed; a reset without a seed begins it again.
    Play(ChallengeName),
    /// A new trial of this case; its inputs are applied at their ticks.
    Open(Box<Case>),
    /// Back to the last control step at or before this tick; pauses. What lies after it is kept as a run when the trial
    /// goes on.
    Rewind(u64),
    /// Back to the end of the kept run of this number; pauses. The present is kept.
    Return(u32),
    /// Another moment takes the place of the present, with inputs that are applied at their ticks; pauses. The present is
    /// kept.
    TakeUp {
        moment: Box<Origin>,
        about: String,
        inputs: Vec<Timed>,
    },
}

/// What a session keeps when another scenario is loaded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    pub controller: bool,
    pub seed: bool,
    pub parameters: bool,
}

/// The static part of a view, constant between two loads.
#[derive(Clone, Debug)]
pub struct Scenery {
    /// Incremented at each change.
    pub version: u64,
    /// Incremented for each new trial.
    pub trial: u64,
    /// Incremented when the session returns to a kept run, whose events are then sent again.
    pub past_version: u64,
    /// Kept runs, oldest first.
    pub kept_runs: Vec<KeptRunSummary>,
    /// The test case that was opened for this trial.
    pub case: Option<Arc<OpenedCase>>,
    /// The challenge that is being played.
    pub challenge: Option<Arc<Challenge>>,
    /// Maps and policies that can be chosen.
    pub catalog: Catalog,
    /// Map and free space.
    pub arena: Arc<Arena>,
    /// The trial's scenario.
    pub scenario: Scenario,
    pub positioner: PositionerKind,
    pub parameters: Parameters,
}

impl Scenery {
    fn of(trial: &Trial, catalog: Catalog, version: u64, number: u64) -> Self {
        Self {
            version,
            trial: number,
            past_version: 0,
            kept_runs: Vec::new(),
            case: None,
            challenge: None,
            catalog,
            arena: trial.arena().clone(),
            scenario: trial.scenario().clone(),
            positioner: trial.state().world.plant.positioner.kind(),
            parameters: trial.state().world.parameters.clone(),
        }
    }
}

/// The newest state of a session, for watchers.
#[derive(Clone, Debug)]
pub struct View {
    /// The trial.
    pub moment: Moment,
    pub world_hash: u64,
    /// Whether the session is running.
    pub running: bool,
    /// Requested speed, simulated seconds per second.
    pub speed_target: f64,
    /// Achieved speed over the last half second; 0 while paused.
    pub speed_achieved: f64,
    /// Delay of the latest tick of the last half second; zero while paused.
    pub lateness: Duration,
    /// How often the session fell behind so far that it skipped the lost time.
    pub missed_deadlines: u64,
    /// First and last tick that a rewind reaches.
    pub rewind_ticks: (u64, u64),
    /// The static part.
    pub scenery: Arc<Scenery>,
    /// The last observation with its tick.
    pub sight: Arc<(u64, Sight)>,
    /// Events of the trial, oldest first, at most [`JOURNAL`]; without those that a rewind undid.
    pub journal: Arc<Vec<Event>>,
    /// The attempt at the challenge that is being played.
    pub attempt: Option<Standing>,
    /// The program that was selected last.
    pub program: Option<Arc<Program>>,
    /// The clients of the robot server, if this session moves its arm.
    pub robot: Option<RobotStanding>,
    /// The robot outside of Ferry that the arm mirrors.
    pub twin: Option<TwinStanding>,
    /// `recording`, or why nothing is recorded.
    pub recording: String,
    /// Why the session ended, if it has.
    pub ended: Option<String>,
}

/// A running session. Dropping it closes the sink and ends the thread.
pub struct Session {
    /// `None` after closing.
    commands: Mutex<Option<SyncSender<Request>>>,
    view: watch::Receiver<Arc<View>>,
    events: broadcast::Sender<Event>,
    thread: Mutex<Option<JoinHandle<()>>>,
    resumed_tick: Option<u64>,
    has_left_out: bool,
    /// Shared with the thread, which checks it before each tick of a `Step`.
    interrupted: Arc<AtomicBool>,
}

/// How a tick selects a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recalled {
    /// The start of the last control step at or before it.
    Step,
    /// The same, or the present state if it belongs to that tick.
    Present,
}

/// A request to the thread, with the channel for its answer.
enum Request {
    Execute { command: Command, answer: oneshot::Sender<Result<(), CommandError>> },
    Recall { tick: u64, moment: Recalled, answer: oneshot::Sender<Result<BranchPoint, CommandError>> },
    Case { answer: oneshot::Sender<Result<Case, CommandError>> },
    Played { answer: oneshot::Sender<Result<Played, CommandError>> },
    Save { answer: oneshot::Sender<Saved> },
    Robot(Arc<Robot>),
    Twin(Arc<Twin>),
}

/// What a session begins with, besides its scenario.
#[derive(Debug)]
pub enum Opening {
    Fresh,
    /// It goes on from here, paused.
    Saved(Saved),
    /// It begins with its scenario; what was saved is kept as runs.
    Beside(Saved),
    /// It starts over and says why.
    Unreadable(LogError),
}

impl Session {
    /// Starts a session, paused; it may use any map and policy of the catalog.
    pub fn start(
        name: &str,
        mut scenario: Scenario,
        opening: Opening,
        catalog: Catalog,
        gpu: Arc<Gpu>,
        sink: Box<dyn Sink>,
    ) -> Result<Self, TrialError> {
        catalog.resolve(&mut scenario.parameters)?;
        let arena = catalog.arena(&scenario.map)?;
        let make_camera = Box::new(move |arena: &Arena| Camera::of(&gpu, arena.static_scene()));
        let (commands, inbox) = sync_channel(COMMAND_QUEUE);
        let (events, _) = broadcast::channel(EVENT_QUEUE);
        let mut worker = worker::Worker::new(name, scenario, arena, catalog, make_camera, sink, events.clone())?;
        worker.begin(opening);
        let (publish, view) = watch::channel(Arc::new(worker.view()));
        let (interrupted, resumed_tick, has_left_out) =
            (worker.interrupted.clone(), worker.resumed_tick, worker.has_left_out);
        let thread = std::thread::Builder::new()
            .name(format!("session {name}"))
            .spawn(move || worker.run(&inbox, &publish))
            .map_err(|error| TrialError::Thread(error.to_string()))?;
        let (commands, thread) = (Mutex::new(Some(commands)), Mutex::new(Some(thread)));
        Ok(Self { commands, view, events, thread, resumed_tick, has_left_out, interrupted })
    }

    /// Sends a command and waits for its answer. Needs a tokio runtime with time.
    pub async fn send(&self, command: Command) -> Result<(), CommandError> {
        answer_of(self.begin(command)?).await
    }

    /// Sends a command; the answer comes later. That of a `Step` comes when its ticks are done.
    pub fn begin(&self, command: Command) -> Result<oneshot::Receiver<Result<(), CommandError>>, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.enqueue(Request::Execute { command, answer })?;
        Ok(answered)
    }

    /// A kept moment. The session does not change.
    pub async fn recall(&self, tick: u64, moment: Recalled) -> Result<BranchPoint, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.enqueue(Request::Recall { tick, moment, answer })?;
        answer_of(answered).await
    }

    /// The trial with all its inputs as a test case. The session does not change.
    pub async fn case(&self) -> Result<Case, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.enqueue(Request::Case { answer })?;
        answer_of(answered).await
    }

    /// The attempt at the challenge that is being played. The session does not change.
    pub async fn played(&self) -> Result<Played, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.enqueue(Request::Played { answer })?;
        answer_of(answered).await
    }

    /// What a later server needs to go on. The session does not change.
    pub async fn saved(&self) -> Result<Saved, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.enqueue(Request::Save { answer })?;
        let answer = tokio::time::timeout(ANSWER_WITHIN, answered).await.map_err(|_| CommandError::Unanswered)?;
        answer.map_err(|_| CommandError::Ended)
    }

    /// Tick from which it went on, if it was saved before.
    pub fn resumed_tick(&self) -> Option<u64> {
        self.resumed_tick
    }

    /// Whether something that was saved could not be restored.
    pub fn has_left_out(&self) -> bool {
        self.has_left_out
    }

    /// Its arm is a robot's from now on.
    ///
    /// # Errors
    /// [`CommandError::Busy`] and [`CommandError::Ended`].
    pub fn connect_robot(&self, robot: Arc<Robot>) -> Result<(), CommandError> {
        self.enqueue(Request::Robot(robot))
    }

    /// Its arm is the twin of a robot outside of Ferry from now on.
    ///
    /// # Errors
    /// [`CommandError::Busy`] and [`CommandError::Ended`].
    pub fn connect_twin(&self, twin: Arc<Twin>) -> Result<(), CommandError> {
        self.enqueue(Request::Twin(twin))
    }

    fn enqueue(&self, request: Request) -> Result<(), CommandError> {
        let commands = self.commands.lock().unwrap_or_else(PoisonError::into_inner);
        let commands = commands.as_ref().ok_or(CommandError::Ended)?;
        commands.try_send(request).map_err(|error| match error {
            TrySendError::Full(_) => CommandError::Busy,
            TrySendError::Disconnected(_) => CommandError::Ended,
        })
    }

    /// The newest view, and a signal at each newer one.
    pub fn watch(&self) -> watch::Receiver<Arc<View>> {
        self.view.clone()
    }

    /// Events from now on.
    pub fn events(&self) -> broadcast::Receiver<Event> {
        self.events.subscribe()
    }
}

impl Session {
    /// Interrupts a running `Step`, because the session ends.
    pub fn interrupt(&self) {
        self.interrupted.store(true, Ordering::Relaxed);
    }

    /// Ends the thread after the current tick and closes the sink. Blocks; does nothing when called the
    /// second time.
    pub fn close(&self) {
        self.interrupt();
        drop(self.commands.lock().unwrap_or_else(PoisonError::into_inner).take());
        if let Some(thread) = self.thread.lock().unwrap_or_else(PoisonError::into_inner).take() {
            // The worker catches its own panics.
            let _ = thread.join();
        }
    }
}

async fn answer_of<T>(answered: oneshot::Receiver<Result<T, CommandError>>) -> Result<T, CommandError> {
    let answer = tokio::time::timeout(ANSWER_WITHIN, answered).await.map_err(|_| CommandError::Unanswered)?;
    answer.unwrap_or(Err(CommandError::Ended))
}

impl Drop for Session {
    fn drop(&mut self) {
        self.close();
    }
}
