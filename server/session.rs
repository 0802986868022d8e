//! A session on a real clock, in a thread of its own: commands in, views and records out.
//!
//! Only this thread holds the [`Session`], which is a state machine. Holders of a
//! [`SessionHandle`] send commands through a bounded queue (a full queue refuses) and watch views. A slow watcher sees only
//! the newest view.

mod branch_point;
mod error;
mod facts;
mod program_link;
mod robot_link;
mod stepper;
mod thread;

use std::ops::Deref;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use tokio::sync::{broadcast, oneshot, watch};

use ferry_camera::{Camera, Gpu};
use ferry_core::scenario::Scenario;
use ferry_core::session::{Command, Opening, Played, Recalled, Resumed, Saved, Session, Surroundings};
use ferry_core::trial::{Arena, Case, Catalog, Event, Sink, TrialError};
use ferry_lab::program::Program;
use ferry_ur::{Robot, Standing as RobotStanding, Twin, TwinStanding};

pub use branch_point::BranchPoint;
pub use error::CommandError;
pub use facts::EndFact;

/// Maximum number of waiting commands.
const COMMAND_QUEUE: usize = 256;
/// Number of events that a slow watcher may lag behind before it loses the oldest.
const EVENT_QUEUE: usize = 256;
/// Longer than the maximum number of steps takes on a slow machine; a session that hangs must not block its callers.
const ANSWER_WITHIN: Duration = Duration::from_secs(30);

/// The newest state of a session and of what is connected with it, for watchers.
#[derive(Clone, Debug)]
pub struct View {
    /// Counts the views of the session.
    pub number: u64,
    pub session: ferry_core::session::View,
    /// The program that was selected last.
    pub program: Option<Arc<Program>>,
    /// The clients of the robot server, if this session moves its arm.
    pub robot: Option<RobotStanding>,
    /// The robot outside of Ferry that the arm mirrors.
    pub twin: Option<TwinStanding>,
    /// Why the session ended, if it has.
    pub ended: Option<EndFact>,
}

impl Deref for View {
    type Target = ferry_core::session::View;

    fn deref(&self) -> &Self::Target {
        &self.session
    }
}

/// A running session. Dropping it closes the sink and ends the thread.
pub struct SessionHandle {
    /// `None` after closing.
    commands: Mutex<Option<SyncSender<Request>>>,
    view: watch::Receiver<Arc<View>>,
    events: broadcast::Sender<Event>,
    thread: Mutex<Option<JoinHandle<()>>>,
    resumed: Resumed,
    /// Shared with the thread, which checks it before each tick of a `Step`.
    interrupted: Arc<AtomicBool>,
}

type Answer<T> = oneshot::Sender<Result<T, CommandError>>;

/// A request to the thread, with the channel for its answer.
enum Request {
    Execute { command: Command, answer: Answer<()> },
    Attach { program: Arc<Program>, answer: Answer<()> },
    Recall { tick: u64, moment: Recalled, answer: Answer<BranchPoint> },
    Case { answer: Answer<Case> },
    Played { answer: Answer<Played> },
    Save { answer: Answer<Saved> },
    Robot(Arc<Robot>),
    Twin(Arc<Twin>),
}

impl SessionHandle {
    /// Starts a session, paused; it may use any map and policy of the catalog.
    pub fn start(
        name: &str,
        scenario: Scenario,
        opening: Opening,
        catalog: Catalog,
        gpu: Arc<Gpu>,
        sink: Box<dyn Sink>,
    ) -> Result<Self, TrialError> {
        let make_camera = Box::new(move |arena: &Arena| Camera::of(&gpu, arena.static_scene()));
        let (commands, inbox) = sync_channel(COMMAND_QUEUE);
        let (events, _) = broadcast::channel(EVENT_QUEUE);
        let start = Instant::now();
        let surroundings = Surroundings { catalog, make_camera, sink };
        let (session, resumed) = Session::start(scenario, opening, surroundings, start.elapsed())?;
        if resumed.has_left_out {
            tracing::warn!(name, "saved trials were left out");
        }
        let interrupted = Arc::new(AtomicBool::new(false));
        let (thread, view) = thread::SessionThread::new(name, session, start, events.clone(), interrupted.clone());
        let thread = std::thread::Builder::new()
            .name(format!("session {name}"))
            .spawn(move || thread.run(&inbox))
            .map_err(|error| TrialError::Thread(error.to_string()))?;
        let (commands, thread) = (Mutex::new(Some(commands)), Mutex::new(Some(thread)));
        Ok(Self { commands, view, events, thread, resumed, interrupted })
    }

    /// Sends a command and waits for its answer. Needs a tokio runtime with time.
    pub async fn send(&self, command: Command) -> Result<(), CommandError> {
        answer_of(self.begin(command)?).await
    }

    /// Sends a command; the answer comes later. That of a `Step` comes when its ticks are done.
    pub fn begin(&self, command: Command) -> Result<oneshot::Receiver<Result<(), CommandError>>, CommandError> {
        self.request(|answer| Request::Execute { command, answer })
    }

    /// Selects a program as sub-controller 2.
    pub async fn attach(&self, program: Arc<Program>) -> Result<(), CommandError> {
        answer_of(self.request(|answer| Request::Attach { program, answer })?).await
    }

    /// A kept moment. The session does not change.
    pub async fn recall(&self, tick: u64, moment: Recalled) -> Result<BranchPoint, CommandError> {
        answer_of(self.request(|answer| Request::Recall { tick, moment, answer })?).await
    }

    /// The trial with all its inputs as a test case. The session does not change.
    pub async fn case(&self) -> Result<Case, CommandError> {
        answer_of(self.request(|answer| Request::Case { answer })?).await
    }

    /// The attempt at the challenge that is being played. The session does not change.
    pub async fn played(&self) -> Result<Played, CommandError> {
        answer_of(self.request(|answer| Request::Played { answer })?).await
    }

    /// What a later server needs to go on. The session does not change.
    pub async fn saved(&self) -> Result<Saved, CommandError> {
        answer_of(self.request(|answer| Request::Save { answer })?).await
    }

    /// What became of a session that was saved before.
    pub fn resumed(&self) -> Resumed {
        self.resumed
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

    fn request<T>(
        &self,
        request: impl FnOnce(Answer<T>) -> Request,
    ) -> Result<oneshot::Receiver<Result<T, CommandError>>, CommandError> {
        let (answer, answered) = oneshot::channel();
        self.enqueue(request(answer))?;
        Ok(answered)
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
            // The thread catches its own panics.
            let _ = thread.join();
        }
    }
}

async fn answer_of<T>(answered: oneshot::Receiver<Result<T, CommandError>>) -> Result<T, CommandError> {
    let answer = tokio::time::timeout(ANSWER_WITHIN, answered).await.map_err(|_| CommandError::Unanswered)?;
    answer.unwrap_or(Err(CommandError::Ended))
}

impl Drop for SessionHandle {
    fn drop(&mut self) {
        self.close();
    }
}
