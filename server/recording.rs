//! Recordings: every session is logged by Rerun to one `.rrd` file, off the session's thread.

mod log;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::thread::JoinHandle;

use crate::session::{Scenery, Sink};
use crate::trial::{Event, EventKind, Moment, TickRecord};

/// Samples that may wait for the disk; about ten seconds of them.
const QUEUE: usize = 512;
/// Moments are logged at 25 Hz of simulated time; events and camera frames always.
const TICKS_A_SAMPLE: u64 = 5;

/// Why a recording could not begin.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The folder cannot be made or read.
    #[error("recording: {path}: {source}", path = path.display())]
    Io {
        /// The path.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
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
    lost: AtomicU64,
    failed: Arc<AtomicBool>,
}

impl Recorder {
    /// Starts a file in `folder`; `id` becomes its name.
    pub fn create(folder: &Path, id: &str) -> Result<Self, RecordingError> {
        std::fs::create_dir_all(folder).map_err(|source| RecordingError::Io { path: folder.into(), source })?;
        let path = folder.join(format!("{id}.rrd"));
        let stream = rerun::RecordingStreamBuilder::new("ferry")
            .recording_id(id)
            .save(&path)
            .map_err(|error| RecordingError::Rerun(format!("{}: {error}", path.display())))?;
        let (queue, inbox) = sync_channel(QUEUE);
        let failed = Arc::new(AtomicBool::new(false));
        let failure = failed.clone();
        let thread = std::thread::Builder::new()
            .name(format!("recording {id}"))
            .spawn(move || {
                let mut writer = log::Writer::new(stream);
                for message in inbox {
                    if let Err(error) = writer.write(message)
                        && !failure.swap(true, Ordering::Relaxed)
                    {
                        tracing::error!(%error, "recording stopped");
                    }
                }
                if let Err(error) = writer.close() {
                    tracing::error!(%error, "recording could not be closed");
                }
            })
            .map_err(|error| RecordingError::Rerun(error.to_string()))?;
        Ok(Self { queue: Some(queue), thread: Some(thread), lost: AtomicU64::new(0), failed })
    }

    fn push(&self, message: Message) {
        let Some(queue) = &self.queue else { return };
        match queue.try_send(message) {
            Ok(()) => {}
            // The simulation never waits for the disk; what is lost is counted and shown.
            Err(TrySendError::Full(_)) => {
                self.lost.fetch_add(1, Ordering::Relaxed);
            }
            Err(TrySendError::Disconnected(_)) => self.failed.store(true, Ordering::Relaxed),
        }
    }
}

impl Sink for Recorder {
    fn begin(&mut self, scenery: &Scenery, tick: u64) {
        self.push(Message::Begin { scenery: Box::new(scenery.clone()), tick });
    }

    fn record(&mut self, record: &TickRecord) {
        let frame = record.sight.as_ref().map(|sight| sight.frame.clone());
        if record.tick.is_multiple_of(TICKS_A_SAMPLE) || frame.is_some() || !record.events.is_empty() {
            let sample = Sample { moment: record.moment.clone(), events: record.events.clone(), frame };
            self.push(Message::Sample(Box::new(sample)));
        }
    }

    fn note(&mut self, event: &Event) {
        self.push(Message::Note(event.clone()));
    }

    fn status(&self) -> String {
        if self.failed.load(Ordering::Relaxed) {
            return "stopped: the file cannot be written".to_owned();
        }
        match self.lost.load(Ordering::Relaxed) {
            0 => "recording".to_owned(),
            lost => format!("recording, {lost} samples lost: the disk is slow"),
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

/// A finished or running recording on disk.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Listed {
    /// Its id: the name of the file without its ending.
    pub id: String,
    /// Size of the file.
    pub bytes: u64,
}

/// The recordings in a folder, newest name first; an absent folder holds none.
pub fn list(folder: &Path) -> Result<Vec<Listed>, RecordingError> {
    let failed = |source| RecordingError::Io { path: folder.into(), source };
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(failed(error)),
    };
    let mut found = Vec::new();
    for entry in entries {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name();
        if let Some(id) = name.to_str().and_then(|name| name.strip_suffix(".rrd")) {
            found.push(Listed { id: id.to_owned(), bytes: entry.metadata().map_err(failed)?.len() });
        }
    }
    found.sort_by(|a, b| b.id.cmp(&a.id));
    Ok(found)
}

/// Severity of an event in Rerun's text log.
fn level(kind: EventKind) -> &'static str {
    match kind {
        EventKind::LiftOff | EventKind::Stopped => "ERROR",
        EventKind::Disturbance | EventKind::Refused => "WARN",
        _ => "INFO",
    }
}
