//! A trial on a real clock, in a thread of its own: commands in, views and records out.
//!
//! The thread is the only one that touches the trial. Holders of a [`Session`] may send commands
//! (bounded; a full queue refuses) and watch. A slow watcher sees the newest view and no other.

mod branch_point;
#[cfg(test)]
mod command_tests;
mod pacing;
mod recall;
mod timeline;
mod worker;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use tokio::sync::{broadcast, oneshot, watch};

use crate::camera::Gpu;
use crate::map::{Library, MapError};
use crate::plant::PositionerKind;
use crate::scenario::{Parameters, Scenario};
use crate::trial::{Arena, Case, Event, Input, InputError, Moment, Sight, Sink, Trial, TrialError};

pub use branch_point::{BranchPoint, Progress};
pub use pacing::{SPEED_MAX, SPEED_MIN};

/// Commands that may wait.
const COMMAND_QUEUE: usize = 256;
/// Events that a watcher may lag behind before it loses the oldest.
const EVENT_QUEUE: usize = 256;
/// Events that a browser that comes later is told of.
pub const JOURNAL: usize = 500;
/// Most ticks of one `Step`.
const STEP_MAX: u32 = 12_500;
/// Longer than the maximum number of steps takes on a slow machine; a session that hangs must not block its callers.
const ANSWER_WITHIN: Duration = Duration::from_secs(30);

/// What a session can be told.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Something that the trial can be told.
    Input(Input),
    /// Lets time run.
    Run,
    /// Stops time.
    Pause,
    /// Advances so many ticks, then stops.
    Step(u32),
    /// Simulated seconds a second.
    SetSpeed(f64),
    /// Back to the start; with another seed, or the same.
    Reset(Option<u64>),
    /// Another trial: this scenario, but for what is kept.
    Load { scenario: Box<Scenario>, kept: Kept },
    /// Back to the last control step at or before this tick; stops time.
    Rewind(u64),
}

/// What of a session stays as it is when another scenario is loaded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    pub controller: bool,
    pub seed: bool,
    pub parameters: bool,
}

/// Why a command was refused; the session is as it was.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// The trial refused it.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The map was refused.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The trial could not be set up.
    #[error(transparent)]
    Trial(#[from] TrialError),
    /// Out of range.
    #[error("{field} is {value}, it must be {allowed}")]
    Range {
        /// The field at fault.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: String,
    },
    /// The trial began longer ago than is kept.
    #[error("the trial's beginning is kept no more; reset, and keep a case within ten minutes")]
    Forgotten,
    /// No goal, nothing to carry the bead to.
    #[error("tick {tick}: there is no goal at that moment, so there is nothing to compare")]
    NoGoal {
        /// The tick asked for.
        tick: u64,
    },
    /// Nothing to expect of a case.
    #[error("tick {tick}: nothing was carried up to then, so a case would expect nothing; let time run first")]
    NothingCarried {
        /// The tick of the session.
        tick: u64,
    },
    /// More commands than the session can take.
    #[error("the session is busy: more than {COMMAND_QUEUE} commands wait")]
    Busy,
    /// Nothing came back.
    #[error("the session has not answered for {} s; what was asked may still happen", ANSWER_WITHIN.as_secs())]
    Unanswered,
    /// The session has ended.
    #[error("the session has ended")]
    Ended,
}

/// What stands still between two loads.
#[derive(Clone, Debug)]
pub struct Scenery {
    /// Raised at each change.
    pub version: u64,
    /// Raised when a trial is set up anew.
    pub trial: u64,
    /// Maps that can be loaded.
    pub known_maps: Arc<Library>,
    /// Map and free space.
    pub arena: Arc<Arena>,
    /// How the trial was set up.
    pub scenario: Scenario,
    /// What carries the magnet.
    pub positioner: PositionerKind,
    /// Parameters in force.
    pub parameters: Parameters,
}

impl Scenery {
    fn of(trial: &Trial, known_maps: Arc<Library>, version: u64, number: u64) -> Self {
        Self {
            version,
            trial: number,
            known_maps,
            arena: trial.arena().clone(),
            scenario: trial.scenario().clone(),
            positioner: trial.state().world.plant.positioner.kind(),
            parameters: trial.state().world.parameters.clone(),
        }
    }
}

/// The newest state, for watchers.
#[derive(Clone, Debug)]
pub struct View {
    /// The trial.
    pub moment: Moment,
    /// World hash.
    pub world_hash: u64,
    /// Whether time runs.
    pub running: bool,
    /// Asked simulated seconds a second.
    pub speed_target: f64,
    /// Achieved ones, over the last half second; 0 while paused.
    pub speed_achieved: f64,
    /// How late the latest tick of the last half second came; zero while paused.
    pub lateness: Duration,
    /// How often the session fell so far behind that lost time was let go, since it began.
    pub missed_deadlines: u64,
    /// Ticks that a rewind reaches, first and last.
    pub rewind_ticks: (u64, u64),
    /// What stands still.
    pub scenery: Arc<Scenery>,
    /// What was last seen, and when.
    pub sight: Arc<(u64, Sight)>,
    /// What happened in the trial, oldest first, [`JOURNAL`] events at most; without what a rewind undid.
    pub journal: Arc<Vec<Event>>,
    /// `recording`, or why not.
    pub recording: String,
    /// Why the session ended, if it has.
    pub ended: Option<String>,
}

/// A running session. Dropping it ends the thread, after the sink.
pub struct Session {
    /// None once it was closed.
    commands: Mutex<Option<SyncSender<Request>>>,
    view: watch::Receiver<Arc<View>>,
    events: broadcast::Sender<Event>,
    thread: Mutex<Option<JoinHandle<()>>>,
    /// Shared with the thread, which looks at it before each step that a command asks for.
    interrupted: Arc<AtomicBool>,
}

/// Which moment is meant by a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recalled {
    /// The start of the last control step at or before it.
    Step,
    /// The same, or the present if it is that.
    Present,
}

/// What is asked of the thread, and where the answer goes.
enum Request {
    Obey { command: Command, answer: oneshot::Sender<Result<(), CommandError>> },
    Recall { tick: u64, moment: Recalled, answer: oneshot::Sender<Result<BranchPoint, CommandError>> },
    Case { answer: oneshot::Sender<Result<Case, CommandError>> },
}

impl Session {
    /// Starts a session, paused; it may load any map of the library.
    pub fn start(
        name: &str,
        scenario: Scenario,
        library: Arc<Library>,
        gpu: Arc<Gpu>,
        sink: Box<dyn Sink>,
    ) -> Result<Self, TrialError> {
        let arena = Arena::of(library.find(&scenario.map)?);
        let make_eye = Box::new(move |arena: &Arena| arena.camera(&gpu));
        let (commands, inbox) = sync_channel(COMMAND_QUEUE);
        let (events, _) = broadcast::channel(EVENT_QUEUE);
        let worker = worker::Worker::new(scenario, arena, library, make_eye, sink, events.clone())?;
        let (publish, view) = watch::channel(Arc::new(worker.view()));
        let interrupted = worker.interrupted.clone();
        let thread = std::thread::Builder::new()
            .name(format!("session {name}"))
            .spawn(move || worker.run(&inbox, &publish))
            .map_err(|error| TrialError::Thread(error.to_string()))?;
        Ok(Self { commands: Mutex::new(Some(commands)), view, events, thread: Mutex::new(Some(thread)), interrupted })
    }

    /// Sends a command and waits for its answer, on a runtime with a clock.
    pub async fn send(&self, command: Command) -> Result<(), CommandError> {
        let (answer, answered) = oneshot::channel();
        self.ask(Request::Obey { command, answer })?;
        answer_of(answered).await
    }

    /// A moment that is kept; changes nothing.
    pub async fn recall(&self, tick: u64, moment: Recalled) -> Result<BranchPoint, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.ask(Request::Recall { tick, moment, answer })?;
        answer_of(answered).await
    }

    /// The trial and all that it was told, as a case; changes nothing.
    pub async fn case(&self) -> Result<Case, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.ask(Request::Case { answer })?;
        answer_of(answered).await
    }

    fn ask(&self, request: Request) -> Result<(), CommandError> {
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
    /// Breaks off steps asked for: the session is to end.
    pub fn interrupt(&self) {
        self.interrupted.store(true, Ordering::Relaxed);
    }

    /// Ends the thread after the tick that it computes at the moment, and closes the sink. Blocks; does nothing the
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
