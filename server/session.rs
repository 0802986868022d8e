//! A trial on a real clock, in a thread of its own: commands in, views and records out.
//!
//! The thread is the only one that touches the trial. Whoever holds a [`Session`] may send commands
//! (bounded; a full queue refuses) and watch. A slow watcher sees the newest view and no other.

mod pacing;
mod past;
mod timeline;
mod worker;

use std::sync::Arc;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::thread::JoinHandle;

use tokio::sync::{broadcast, oneshot, watch};

use crate::camera::Gpu;
use crate::geometry::Point2;
use crate::map::MapError;
use crate::plant::PositionerKind;
use crate::scenario::{ControllerName, Parameters, Scenario, Scripted};
use crate::trial::{Arena, Case, Event, Input, InputError, Moment, Sight, Sink, TrialError};

pub use pacing::{SPEED_MAX, SPEED_MIN};
pub use past::{Past, Progress};

/// Commands that may wait.
const COMMAND_QUEUE: usize = 256;
/// Events that a watcher may lag behind before it loses the oldest.
const EVENT_QUEUE: usize = 256;
/// Events that a browser that comes later is told of.
pub const JOURNAL: usize = 500;
/// Most ticks of one `Step`.
const STEP_MAX: u32 = 12_500;

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
    /// Another trial.
    Load {
        /// Name of a shipped map.
        map: String,
        /// Sub-controller 2, or the present one.
        controller: Option<ControllerName>,
        /// What carries the magnet, or what the map is made for.
        positioner: Option<PositionerKind>,
        /// Seed, or the present one.
        seed: Option<u64>,
        /// Bead and tool at the start.
        start_m: Option<Point2<f64>>,
        /// Goal at the start.
        goal_m: Option<Point2<f64>>,
        /// Parameters, or the present ones.
        parameters: Option<Box<Parameters>>,
        /// Disturbances at random.
        disturbances: u32,
        /// Disturbances at set times.
        script: Vec<Scripted>,
    },
    /// Back to the last control step at or before this tick; stops time.
    Rewind(u64),
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
    #[error("tick {tick}: there is no goal at that moment, so there is nothing to compare or to expect")]
    NoGoal {
        /// The tick asked for.
        tick: u64,
    },
    /// More commands than the session can take.
    #[error("the session is busy: more than {COMMAND_QUEUE} commands wait")]
    Busy,
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
    /// Map and free space.
    pub arena: Arc<Arena>,
    /// How the trial was set up.
    pub scenario: Scenario,
    /// What carries the magnet.
    pub positioner: PositionerKind,
    /// Parameters in force.
    pub parameters: Parameters,
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
    commands: Option<SyncSender<Request>>,
    view: watch::Receiver<Arc<View>>,
    events: broadcast::Sender<Event>,
    thread: Option<JoinHandle<()>>,
}

/// What is asked of the thread, and where the answer goes.
enum Request {
    Obey { command: Command, answer: oneshot::Sender<Result<(), CommandError>> },
    Recall { tick: u64, answer: oneshot::Sender<Result<Past, CommandError>> },
    Case { answer: oneshot::Sender<Result<Case, CommandError>> },
}

impl Session {
    /// Starts a session, paused.
    pub fn start(name: &str, scenario: Scenario, gpu: Arc<Gpu>, sink: Box<dyn Sink>) -> Result<Self, TrialError> {
        let arena = Arena::open(&scenario.map)?;
        let camera = arena.camera(&gpu)?;
        let (commands, inbox) = sync_channel(COMMAND_QUEUE);
        let (events, _) = broadcast::channel(EVENT_QUEUE);
        let worker = worker::Worker::new(scenario, arena, gpu, camera, sink, events.clone())?;
        let (publish, view) = watch::channel(Arc::new(worker.view()));
        let thread = std::thread::Builder::new()
            .name(format!("session {name}"))
            .spawn(move || worker.run(&inbox, &publish))
            .map_err(|error| TrialError::Thread(error.to_string()))?;
        Ok(Self { commands: Some(commands), view, events, thread: Some(thread) })
    }

    /// Sends a command and waits for its answer.
    pub async fn send(&self, command: Command) -> Result<(), CommandError> {
        let (answer, answered) = oneshot::channel();
        self.ask(Request::Obey { command, answer })?;
        answered.await.unwrap_or(Err(CommandError::Ended))
    }

    /// The last moment kept at or before a tick; changes nothing.
    pub async fn recall(&self, tick: u64) -> Result<Past, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.ask(Request::Recall { tick, answer })?;
        answered.await.unwrap_or(Err(CommandError::Ended))
    }

    /// The trial and all that it was told, as a case; changes nothing.
    pub async fn case(&self) -> Result<Case, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.ask(Request::Case { answer })?;
        answered.await.unwrap_or(Err(CommandError::Ended))
    }

    fn ask(&self, request: Request) -> Result<(), CommandError> {
        let commands = self.commands.as_ref().ok_or(CommandError::Ended)?;
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

impl Drop for Session {
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            // The worker catches its own panics.
            let _ = thread.join();
        }
    }
}
