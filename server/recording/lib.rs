//! Recordings: a session or an evaluated episode as two files per part, written by a separate thread. Rerun's file
//! (`.rrd`) is for viewing, the input log (`.ferry`) for replay. Beside the parts of sessions, a small file says what a
//! part contains (`.about.json`).
//!
//! A long session is split into parts, because Rerun keeps the index of an open file in memory, and so that old parts
//! can be deleted. Each part can be opened and replayed separately.

mod about;
mod archive;
mod blueprint;
mod drawing;
mod entities;
mod part;
mod samples;
mod stream;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use ferry_core::geometry::Point2;
use ferry_core::scenario::Scenario;
use ferry_core::trial::{
    Arena, Beginning, Event, LogError, LoggedBeginning, LoggedTick, Moment, RecordingFact, Sight, Sink, TickRecord,
    Trial,
};

pub use about::Content;
pub use archive::{Archive, Listed, Retention};
use part::{Keeper, Naming};

/// Length of the queue to the disk: half a minute of a session in real time, a few seconds when it runs fast.
const QUEUE: usize = 4096;
/// Largest number of queued sights: each contains a camera frame of one megabyte.
const SIGHTS: usize = 16;
/// Moments are logged at 25 Hz of simulated time; events and control steps always.
const TICKS_A_SAMPLE: u64 = 5;
/// Smallest interval at which messages are taken from the queue.
const GATHER: Duration = Duration::from_millis(20);
/// After a lost tick, this many more are dropped between two requests for a new beginning.
const LOST_TICKS_AN_OFFER: u64 = 64;

/// Why a recording could not begin or continue.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// A file or folder cannot be created, read or written.
    #[error("recording: {path}: {error}", path = path.display())]
    Io { path: PathBuf, error: std::io::Error },
    /// The disk is nearly full.
    #[error("recording: the disk has {left_mb} MB left, the minimum is {min_mb}")]
    Full {
        /// Remaining space.
        left_mb: u64,
        /// Required space.
        min_mb: u64,
    },
    /// There are as many recordings in progress as may be kept.
    #[error("recording: {in_progress} recordings are in progress, and the limit is {max} (--keep)")]
    Parts { in_progress: usize, max: usize },
    /// The recordings in progress alone are larger than all may be.
    #[error("recording: the recordings in progress have {mb} MB, and the limit is {max_mb} MB (--keep-mb)")]
    Quota { mb: u64, max_mb: u64 },
    /// A file that is being written is not in its folder any more.
    #[error("recording: {path} was removed", path = path.display())]
    Gone { path: PathBuf },
    /// Error of the input log.
    #[error("recording: {0}")]
    Log(#[from] LogError),
    /// Error of Rerun.
    #[error("recording: {0}")]
    Rerun(String),
    /// The folder has no such recording.
    #[error("there is no recording {id:?}")]
    Unknown { id: String },
    /// Only a finished recording can be deleted.
    #[error("the recording {id:?} is still being written")]
    Live { id: String },
    #[error("the title has {chars} characters, the limit is {max}")]
    LongTitle { chars: usize, max: usize },
    #[error("the title contains the control character {found:?}")]
    ControlInTitle { found: char },
}

/// An error of Rerun or of an encoder.
fn trouble(error: impl std::fmt::Display) -> RecordingError {
    RecordingError::Rerun(error.to_string())
}

/// Settings of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Whether the trial waits for a slow disk. Otherwise ticks are lost; they are counted and shown.
    pub waits: bool,
    /// Length of a part. It ends sooner if the archive is small.
    pub part: Duration,
    /// Smallest interval between images.
    pub image_every: Duration,
    /// Recording stops if the disk has less free space.
    pub min_free_bytes: u64,
}

impl Options {
    /// For a session: it never waits, and can run for hours and many times faster than real time.
    pub const LIVE: Self = Self {
        waits: false,
        part: Duration::from_secs(600),
        image_every: Duration::from_millis(100),
        min_free_bytes: 64 << 20,
    };
    /// For an episode: it is recorded completely.
    pub const EPISODE: Self = Self { waits: true, part: Duration::MAX, image_every: Duration::ZERO, ..Self::LIVE };
}

/// A message to the recording's thread.
enum Message {
    Begin(Box<Opening>),
    Tick(Box<TickMessage>),
    Note(Event),
}

/// A trial that begins or continues.
struct Opening {
    arena: Arc<Arena>,
    scenario: Scenario,
    logged: LoggedBeginning,
    /// Whether another trial was recorded before.
    is_new: bool,
    tick: u64,
    goal_m: Option<Point2<f64>>,
}

/// A tick of the trial.
struct TickMessage {
    logged: LoggedTick,
    sample: Option<Sample>,
}

/// A moment for the viewer.
struct Sample {
    moment: Moment,
    events: Vec<Event>,
    /// Only for control steps.
    sight: Option<Sight>,
}

/// State shared by both threads.
#[derive(Default)]
struct Shared {
    /// Why recording has stopped; set once.
    stopped: OnceLock<RecordingFact>,
    /// Why nothing is recorded at present.
    interrupted: Mutex<Option<RecordingFact>>,
    /// The part is old enough: the next one should begin.
    part_is_over: AtomicBool,
    /// Number of sights in the queue.
    sights: AtomicUsize,
}

/// Records one session or episode. Dropping it closes the files.
pub struct Recorder {
    queue: Option<SyncSender<Message>>,
    thread: Option<JoinHandle<()>>,
    shared: Arc<Shared>,
    waits: bool,
    /// A tick was lost. Later ticks are useless in an input log until it contains a new state of the trial.
    gap: bool,
    lost_ticks: u64,
}

impl Recorder {
    /// Records a session in the shared archive.
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
                // A panic here stops the recording, visibly, but not the trial.
                if catch_unwind(AssertUnwindSafe(|| write_all(keeper, &inbox, &seen))).is_err() {
                    seen.stop(&trouble("the recording thread failed; see the server's log"));
                }
            })
            .map_err(|error| RecordingError::Rerun(error.to_string()))?;
        Ok(Self { queue: Some(queue), thread: Some(thread), shared, waits: options.waits, gap: false, lost_ticks: 0 })
    }

    /// False only if the queue is full. A message to a stopped recording counts as sent.
    fn push(&self, message: Message) -> bool {
        let Some(queue) = &self.queue else { return true };
        if self.waits {
            return queue.send(message).is_ok();
        }
        !matches!(queue.try_send(message), Err(TrySendError::Full(_)))
    }

    /// A copy of the sight, unless too many are queued.
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
            is_new: how != Beginning::Resumed,
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
        self.gap = !self.push(Message::Tick(Box::new(TickMessage { logged: LoggedTick::from(record), sample })));
        if self.gap {
            self.lost_ticks += 1;
            self.shared.sights.fetch_sub(usize::from(holds_sight), Ordering::Relaxed);
        }
    }

    fn note(&mut self, event: &Event) {
        // Viewers see the event in any case; only a line of text may be lost.
        let _ = self.push(Message::Note(event.clone()));
    }

    fn wants_beginning(&mut self) -> bool {
        if self.shared.stopped.get().is_some() {
            return false;
        }
        let offers = self.gap && self.lost_ticks.is_multiple_of(LOST_TICKS_AN_OFFER);
        offers || self.shared.part_is_over.swap(false, Ordering::Relaxed)
    }

    fn status(&self) -> RecordingFact {
        if let Some(reason) = self.shared.interruption() {
            return reason;
        }
        match (self.shared.stopped.get(), self.lost_ticks) {
            (Some(reason), _) => reason.clone(),
            (None, 0) => RecordingFact::On,
            (None, lost_ticks) => RecordingFact::Slow { lost_ticks },
        }
    }

    fn finish(mut self: Box<Self>) -> Result<(), String> {
        self.close();
        match (self.shared.stopped.get(), self.lost_ticks) {
            (None, 0) => Ok(()),
            _ => Err(self.status().to_string()),
        }
    }
}

impl Recorder {
    /// Waits until everything is written.
    fn close(&mut self) {
        self.queue = None;
        if let Some(thread) = self.thread.take() {
            // The thread catches its own panics.
            let _ = thread.join();
        }
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        self.close();
    }
}

/// Writes until the sender is dropped or an error occurs. Messages that arrive shortly after each other are handled
/// together: waking for every tick would cost a fast trial more than the writing.
fn write_all(mut keeper: Keeper, inbox: &Receiver<Message>, shared: &Shared) {
    loop {
        match inbox.recv_timeout(keeper.wait()) {
            Ok(message) => write(&mut keeper, message, shared),
            Err(RecvTimeoutError::Timeout) => attempt(&mut keeper, shared, Keeper::flush),
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
    if let Err(error) = keeper.close() {
        shared.stop(&error);
    }
}

fn write(keeper: &mut Keeper, message: Message, shared: &Shared) {
    if let Message::Tick(tick) = &message
        && tick.sample.as_ref().is_some_and(|sample| sample.sight.is_some())
    {
        shared.sights.fetch_sub(1, Ordering::Relaxed);
    }
    #[cfg(test)]
    if std::thread::current().name() == Some("recording breaks") {
        panic!("injected panic");
    }
    attempt(keeper, shared, |keeper| keeper.write(message));
}

/// Writes. Nothing more is written after a failure, except that a session's recording goes on when its folder is back.
fn attempt(keeper: &mut Keeper, shared: &Shared, act: impl FnOnce(&mut Keeper) -> Result<(), RecordingError>) {
    if shared.stopped.get().is_some() {
        return;
    }
    match act(keeper) {
        Ok(()) if keeper.is_interrupted() => {}
        Ok(()) => shared.interrupt(None),
        Err(error @ RecordingError::Gone { .. }) if keeper.waits_for_folder() => {
            tracing::warn!(%error, "recording interrupted");
            keeper.interrupt();
            shared.interrupt(Some(RecordingFact::Interrupted { detail: error.to_string() }));
        }
        Err(error) => shared.stop(&error),
    }
}

impl Shared {
    /// Records the first failure.
    fn stop(&self, error: &RecordingError) {
        tracing::error!(%error, "recording stopped");
        self.interrupt(None);
        // Set once.
        let _ = self.stopped.set(RecordingFact::Stopped { detail: error.to_string() });
    }

    fn interrupt(&self, reason: Option<RecordingFact>) {
        *self.interrupted.lock().unwrap_or_else(PoisonError::into_inner) = reason;
    }

    fn interruption(&self) -> Option<RecordingFact> {
        self.interrupted.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}
