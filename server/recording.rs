//! Recordings: every session is logged by Rerun to one `.rrd` file, off the session's thread.

mod files;
mod log;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;

use rerun::RecordingStream;

use crate::session::{Scenery, Sink};
use crate::trial::{Event, EventKind, Moment, TickRecord};

pub use files::{Listed, list, name};

/// Samples that may wait for the disk: seventeen simulated seconds of them.
const QUEUE: usize = 512;
/// Recording stops when the disk has less room than this.
const ROOM_BYTES: u64 = 64 << 20;
/// Messages between two looks at the room left: some seconds, and far less than the room.
const ROOM_EVERY: usize = 64;
/// Moments are logged at 25 Hz of simulated time; events and camera frames always.
const TICKS_A_SAMPLE: u64 = 5;

/// Why a recording could not begin.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The folder cannot be made or read.
    #[error("recording: {path}: {error}", path = path.display())]
    Io {
        /// The path.
        path: PathBuf,
        /// What the system said.
        error: std::io::Error,
    },
    /// Rerun refused.
    #[error("recording: {0}")]
    Rerun(String),
}

/// What the recording's thread is told.
enum Message {
    Begin { scenery: Box<Scenery>, tick: u64 },
    Sample(Box<Sample>),
    Note(Event),
}

/// One moment to be logged.
struct Sample {
    moment: Moment,
    events: Vec<Event>,
    /// The camera frame of a control step.
    frame: Option<Arc<crate::image::CameraFrame>>,
}

/// Writes one session to one file. Dropping it closes the file, footer and all.
pub struct Recorder {
    queue: Option<SyncSender<Message>>,
    thread: Option<JoinHandle<()>>,
    /// A beginning that found the queue full; samples wait for it, since they would be misread without.
    owed: Option<Message>,
    lost: u64,
    /// Why the thread writes no more; set by it, shown to viewers.
    stopped: Arc<OnceLock<String>>,
}

impl Recorder {
    /// Starts a file in `folder`; `id` becomes its name.
    pub fn create(folder: &Path, id: &str) -> Result<Self, RecordingError> {
        std::fs::create_dir_all(folder).map_err(|error| RecordingError::Io { path: folder.into(), error })?;
        let path = folder.join(format!("{id}.rrd"));
        let stream = rerun::RecordingStreamBuilder::new("ferry")
            .recording_id(id)
            .save(&path)
            .and_then(|stream| {
                // Without a name the viewer calls it unknown; the builder's own is lost on the way to a file.
                stream.send_recording_name(id)?;
                Ok(stream)
            })
            .map_err(|error| RecordingError::Rerun(format!("{}: {error}", path.display())))?;
        let (queue, inbox) = sync_channel(QUEUE);
        let stopped = Arc::new(OnceLock::new());
        let (reason, folder) = (stopped.clone(), folder.to_owned());
        let thread = std::thread::Builder::new()
            .name(format!("recording {id}"))
            .spawn(move || write_all(stream, &inbox, &folder, &reason))
            .map_err(|error| RecordingError::Rerun(error.to_string()))?;
        Ok(Self { queue: Some(queue), thread: Some(thread), owed: None, lost: 0, stopped })
    }

    /// Whether the message went; the simulation never waits for the disk, what is lost is counted and shown.
    fn push(&mut self, message: Message) -> Result<(), Message> {
        let Some(queue) = &self.queue else { return Ok(()) };
        match queue.try_send(message) {
            Ok(()) | Err(TrySendError::Disconnected(_)) => Ok(()),
            Err(TrySendError::Full(message)) => {
                self.lost += 1;
                Err(message)
            }
        }
    }

    fn push_after_beginning(&mut self, message: Message) {
        if let Some(owed) = self.owed.take() {
            self.owed = self.push(owed).err();
        }
        if self.owed.is_none() {
            // Counted in `push`; a sample that is lost is not sent later.
            let _ = self.push(message);
        }
    }
}

/// Writes until the queue's other end is gone, or the disk is nearly full: Rerun only logs what it could
/// not write, so room is looked after before it is gone.
fn write_all(stream: RecordingStream, inbox: &Receiver<Message>, folder: &Path, stopped: &OnceLock<String>) {
    let mut writer = log::Writer::new(stream);
    for (count, message) in inbox.iter().enumerate() {
        if stopped.get().is_some() {
            continue;
        }
        let written = match count % ROOM_EVERY {
            0 => room(folder).and_then(|()| writer.write(message).map_err(|error| error.to_string())),
            _ => writer.write(message).map_err(|error| error.to_string()),
        };
        if let Err(reason) = written {
            tracing::error!(reason, "recording stopped");
            // Set once: nothing is written after it.
            let _ = stopped.set(format!("stopped: {reason}"));
        }
    }
    if let Err(error) = writer.close() {
        tracing::error!(%error, "recording could not be closed");
    }
}

/// Whether the disk has room for more; where the system cannot tell, yes.
fn room(folder: &Path) -> Result<(), String> {
    #[cfg(unix)]
    if let Ok(disk) = rustix::fs::statvfs(folder) {
        let left_bytes = disk.f_bavail.saturating_mul(disk.f_frsize);
        if left_bytes < ROOM_BYTES {
            return Err(format!("the disk has {} MB left, less than {}", left_bytes >> 20, ROOM_BYTES >> 20));
        }
    }
    let _ = folder;
    Ok(())
}

impl Sink for Recorder {
    fn begin(&mut self, scenery: &Scenery, tick: u64) {
        let beginning = Message::Begin { scenery: Box::new(scenery.clone()), tick };
        self.owed = self.push(beginning).err();
    }

    fn record(&mut self, record: &TickRecord) {
        let frame = record.sight.as_ref().map(|sight| sight.frame.clone());
        if record.tick.is_multiple_of(TICKS_A_SAMPLE) || frame.is_some() || !record.events.is_empty() {
            let sample = Sample { moment: record.moment.clone(), events: record.events.clone(), frame };
            self.push_after_beginning(Message::Sample(Box::new(sample)));
        }
    }

    fn note(&mut self, event: &Event) {
        self.push_after_beginning(Message::Note(event.clone()));
    }

    fn status(&self) -> String {
        match (self.stopped.get(), self.lost) {
            (Some(reason), _) => reason.clone(),
            (None, 0) => "recording".to_owned(),
            (None, lost) => format!("recording, {lost} samples lost: the disk is slow"),
        }
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        self.queue = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Takes a session's ticks and keeps nothing: the recording could not begin.
pub struct Unrecorded {
    /// Why, shown to viewers.
    pub reason: String,
}

impl Sink for Unrecorded {
    fn begin(&mut self, _: &Scenery, _: u64) {}
    fn record(&mut self, _: &TickRecord) {}
    fn note(&mut self, _: &Event) {}

    fn status(&self) -> String {
        format!("not recording: {}", self.reason)
    }
}

/// Severity of an event in Rerun's text log.
fn level(kind: EventKind) -> &'static str {
    match kind {
        EventKind::LiftOff | EventKind::Stopped => "ERROR",
        EventKind::Disturbance | EventKind::Refused => "WARN",
        _ => "INFO",
    }
}
