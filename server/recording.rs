//! Recordings: a session, or an evaluated episode, as two files a part, written off the thread that runs it. Rerun's
//! (`.rrd`) is to be looked at, the input log (`.ferry`) to be run again.
//!
//! A session that goes on for long is kept in parts: Rerun holds the index of an open file in memory, and old parts
//! can be let go. Each part can be opened, and replayed, alone.

mod archive;
mod blueprint;
mod drawing;
mod entities;
mod part;
mod samples;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::geometry::Point2;
use crate::scenario::Scenario;
use crate::trial::{
    Arena, Beginning, Event, LogError, LoggedBeginning, LoggedTick, Moment, Sight, Sink, TickRecord, Trial,
};

pub use archive::{Archive, Listed, Retention};
use part::{Keeper, Naming};

/// Messages that may wait for the disk: half a minute of a session, some seconds where it runs fast.
const QUEUE: usize = 4096;
/// Sights that may wait: each holds a camera frame of a megabyte.
const SIGHTS: usize = 16;
/// Moments are logged at 25 Hz of simulated time; events and control steps always.
const TICKS_A_SAMPLE: u64 = 5;
/// Messages are taken from the queue this often at most.
const GATHER: Duration = Duration::from_millis(20);
/// After a tick was lost, so many more are let go between two offers to begin again.
const LOST_TICKS_AN_OFFER: u64 = 64;

/// Why a recording could not begin or go on.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// A file or folder cannot be made, read or written.
    #[error("recording: {path}: {error}", path = path.display())]
    Io {
        /// The path.
        path: PathBuf,
        /// What the system said.
        error: std::io::Error,
    },
    /// The disk is nearly full.
    #[error("recording: the disk has {left_mb} MB left, less than {least_mb}")]
    Full {
        /// What is left.
        left_mb: u64,
        /// What is asked for.
        least_mb: u64,
    },
    /// The input log.
    #[error("recording: {0}")]
    Log(#[from] LogError),
    /// Rerun refused.
    #[error("recording: {0}")]
    Rerun(String),
}

impl From<re_sdk::RecordingStreamError> for RecordingError {
    fn from(error: re_sdk::RecordingStreamError) -> Self {
        trouble(error)
    }
}

/// Rerun's, or an encoder's, in its own words.
fn trouble(error: impl std::fmt::Display) -> RecordingError {
    RecordingError::Rerun(error.to_string())
}

/// How a recording is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Whether whoever runs the trial waits for a slow disk; otherwise ticks are lost, counted, and shown.
    pub waits: bool,
    /// A part that is this old is followed by the next.
    pub part: Duration,
    /// Images come no closer together than this.
    pub image_every: Duration,
    /// Recording stops when the disk has less room than this.
    pub least_room_bytes: u64,
}

impl Options {
    /// For a session: it never waits, and runs for hours, perhaps many times as fast as time.
    pub const LIVE: Self = Self {
        waits: false,
        part: Duration::from_secs(600),
        image_every: Duration::from_millis(100),
        least_room_bytes: 64 << 20,
    };
    /// For an episode: it is kept whole.
    pub const EPISODE: Self = Self { waits: true, part: Duration::MAX, image_every: Duration::ZERO, ..Self::LIVE };
}

/// What the recording's thread is told.
enum Message {
    Begin(Box<Opening>),
    Tick(Box<Told>),
    Note(Event),
}

/// A trial that begins, or goes on.
struct Opening {
    arena: Arc<Arena>,
    scenario: Scenario,
    logged: LoggedBeginning,
    tick: u64,
    goal_m: Option<Point2<f64>>,
}

/// A tick.
struct Told {
    logged: LoggedTick,
    sample: Option<Sample>,
}

/// A moment to be looked at.
struct Sample {
    moment: Moment,
    events: Vec<Event>,
    /// Of a control step.
    sight: Option<Sight>,
}

/// What both threads see.
#[derive(Default)]
struct Shared {
    /// Why nothing more is written; set once.
    stopped: OnceLock<String>,
    /// The part is old enough: the next wants to begin.
    part_is_over: AtomicBool,
    /// Sights that wait in the queue.
    sights: AtomicUsize,
}

/// Writes one session or episode. Dropping it closes the files.
pub struct Recorder {
    queue: Option<SyncSender<Message>>,
    thread: Option<JoinHandle<()>>,
    shared: Arc<Shared>,
    waits: bool,
    /// A tick was lost: those that follow make no sense in an input log until it is told where the trial stands.
    gap: bool,
    lost_ticks: u64,
}

impl Recorder {
    /// Records a session among others.
    pub fn in_archive(archive: &Arc<Archive>, session: &str, options: Options) -> Result<Self, RecordingError> {
        Self::start(Naming::Archive { archive: archive.clone(), session: session.to_owned() }, options)
    }

    /// Records one episode as `NAME.rrd` and `NAME.ferry`.
    pub fn to_folder(folder: &Path, name: &str) -> Result<Self, RecordingError> {
        Self::start(Naming::Alone { folder: folder.to_owned(), name: name.to_owned() }, Options::EPISODE)
    }

    fn start(naming: Naming, options: Options) -> Result<Self, RecordingError> {
        let name = format!("recording {}", naming.subject());
        let keeper = Keeper::start(naming, options)?;
        let (queue, inbox) = sync_channel(QUEUE);
        let shared = Arc::new(Shared::default());
        let seen = shared.clone();
        let thread = std::thread::Builder::new()
            .name(name)
            .spawn(move || {
                // A fault in here stops the recording, visibly, and never what is recorded.
                if catch_unwind(AssertUnwindSafe(|| write_all(keeper, &inbox, &seen))).is_err() {
                    note(Err(trouble("its thread failed; the log has more")), &seen);
                }
            })
            .map_err(|error| RecordingError::Rerun(error.to_string()))?;
        Ok(Self { queue: Some(queue), thread: Some(thread), shared, waits: options.waits, gap: false, lost_ticks: 0 })
    }

    /// Whether the message went, or nobody will ever want it.
    fn push(&self, message: Message) -> bool {
        let Some(queue) = &self.queue else { return true };
        if self.waits {
            return queue.send(message).is_ok();
        }
        !matches!(queue.try_send(message), Err(TrySendError::Full(_)))
    }

    /// A sight, if not too many wait already.
    fn admit(&self, sight: Option<&Sight>) -> Option<Sight> {
        let sight = sight?;
        if !self.waits && self.shared.sights.load(Ordering::Relaxed) >= SIGHTS {
            return None;
        }
        self.shared.sights.fetch_add(1, Ordering::Relaxed);
        Some(sight.clone())
    }
}

impl Sink for Recorder {
    fn begin(&mut self, trial: &Trial, how: Beginning) {
        let opening = Opening {
            arena: trial.arena().clone(),
            scenario: trial.scenario().clone(),
            logged: LoggedBeginning::of(trial, how),
            tick: trial.state().world.tick,
            goal_m: trial.state().world.goal_m,
        };
        self.gap = !self.push(Message::Begin(Box::new(opening)));
    }

    fn record(&mut self, record: &TickRecord) {
        if self.gap {
            self.lost_ticks += 1;
            return;
        }
        let worth = record.tick.is_multiple_of(TICKS_A_SAMPLE) || record.sight.is_some() || !record.events.is_empty();
        let sample = worth.then(|| Sample {
            moment: record.moment.clone(),
            events: record.events.clone(),
            sight: self.admit(record.sight.as_ref()),
        });
        let holds_sight = sample.as_ref().is_some_and(|sample| sample.sight.is_some());
        self.gap = !self.push(Message::Tick(Box::new(Told { logged: LoggedTick::from(record), sample })));
        if self.gap {
            self.lost_ticks += 1;
            self.shared.sights.fetch_sub(usize::from(holds_sight), Ordering::Relaxed);
        }
    }

    fn note(&mut self, event: &Event) {
        // Shown to viewers in any case; what is lost here is a line of text.
        let _ = self.push(Message::Note(event.clone()));
    }

    fn wants_beginning(&mut self) -> bool {
        if self.shared.stopped.get().is_some() {
            return false;
        }
        let offers = self.gap && self.lost_ticks.is_multiple_of(LOST_TICKS_AN_OFFER);
        offers || self.shared.part_is_over.swap(false, Ordering::Relaxed)
    }

    fn status(&self) -> String {
        match (self.shared.stopped.get(), self.lost_ticks) {
            (Some(reason), _) => reason.clone(),
            (None, 0) => "recording".to_owned(),
            (None, lost) => format!("recording, {lost} ticks lost: the disk is slow"),
        }
    }

    fn finish(mut self: Box<Self>) -> Result<(), String> {
        self.close();
        match (self.shared.stopped.get(), self.lost_ticks) {
            (None, 0) => Ok(()),
            _ => Err(self.status()),
        }
    }
}

impl Recorder {
    /// Waits until all is written.
    fn close(&mut self) {
        self.queue = None;
        if let Some(thread) = self.thread.take() {
            // It catches its own panics.
            let _ = thread.join();
        }
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        self.close();
    }
}

/// Writes until the queue's other end is gone, or something cannot be written. What comes soon after a message is
/// taken together: to wake for every tick would cost a fast trial more than the writing.
fn write_all(mut keeper: Keeper, inbox: &Receiver<Message>, shared: &Shared) {
    loop {
        match inbox.recv_timeout(keeper.wait()) {
            Ok(message) => write(&mut keeper, message, shared),
            Err(RecvTimeoutError::Timeout) => note(keeper.flush(), shared),
            Err(RecvTimeoutError::Disconnected) => break,
        }
        std::thread::sleep(GATHER);
        for message in inbox.try_iter() {
            write(&mut keeper, message, shared);
        }
        if keeper.wants_next() {
            shared.part_is_over.store(true, Ordering::Relaxed);
        }
    }
    note(keeper.close(), shared);
}

fn write(keeper: &mut Keeper, message: Message, shared: &Shared) {
    if let Message::Tick(told) = &message
        && told.sample.as_ref().is_some_and(|sample| sample.sight.is_some())
    {
        shared.sights.fetch_sub(1, Ordering::Relaxed);
    }
    fault_point!("write");
    if shared.stopped.get().is_none() {
        note(keeper.write(message), shared);
    }
}

/// After the first failure nothing more is written.
fn note(done: Result<(), RecordingError>, shared: &Shared) {
    if let Err(error) = done {
        tracing::error!(%error, "recording stopped");
        // Set once.
        let _ = shared.stopped.set(format!("stopped: {error}"));
    }
}
