//! A recording's files, one pair a part.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::entities::{Course, Writer};
use super::{Archive, Message, Opening, Options, RecordingError};
use crate::trial::{Entry, LogWriter};

/// A crash loses no more than this of an input log.
const FLUSH_EVERY: Duration = Duration::from_millis(200);
/// Entries of one frame: at full speed, they are many in that time.
const FRAME_ENTRIES: usize = 512;
/// Looks at the room left are this far apart: at full speed, far less than the room is written between.
const CHECK_EVERY: Duration = Duration::from_secs(1);

/// Where parts are, and what they are called.
pub(super) enum Naming {
    /// Among the parts of other sessions, called after their time.
    Archive { archive: Arc<Archive>, session: String },
    /// Two files of this name.
    Alone { folder: PathBuf, name: String },
}

impl Naming {
    fn folder(&self) -> &Path {
        match self {
            Self::Archive { archive, .. } => archive.folder(),
            Self::Alone { folder, .. } => folder,
        }
    }

    /// Whose recording it is.
    pub(super) fn subject(&self) -> &str {
        match self {
            Self::Archive { session, .. } => session,
            Self::Alone { name, .. } => name,
        }
    }

    /// The next part's name.
    fn claim(&self) -> Result<Claim, RecordingError> {
        match self {
            Self::Archive { archive, session } => {
                Ok(Claim { id: archive.claim(session)?, archive: Some(archive.clone()) })
            }
            Self::Alone { folder, name } => {
                std::fs::create_dir_all(folder).map_err(|error| RecordingError::Io { path: folder.clone(), error })?;
                Ok(Claim { id: name.clone(), archive: None })
            }
        }
    }
}

/// The name of a part that is being written; whatever becomes of that, it is given back.
struct Claim {
    id: String,
    archive: Option<Arc<Archive>>,
}

impl Drop for Claim {
    fn drop(&mut self) {
        if let Some(archive) = &self.archive {
            archive.release(&self.id);
        }
    }
}

/// Two open files.
struct Part {
    writer: Writer,
    log: LogWriter<File>,
    since: Instant,
    /// Whether it was said that it is over.
    said_over: bool,
    /// Given back when the files are closed.
    claim: Claim,
}

impl Part {
    fn create(naming: &Naming, recording: Option<&str>, options: &Options) -> Result<Self, RecordingError> {
        check_room(naming.folder(), options)?;
        let (folder, claim) = (naming.folder(), naming.claim()?);
        let id = &claim.id;
        let path = folder.join(format!("{id}.ferry"));
        let file = File::create(&path).map_err(|error| RecordingError::Io { path, error })?;
        let path = folder.join(format!("{id}.rrd"));
        let writer = Writer::create(&path, recording.unwrap_or(id), id, options.image_every)?;
        Ok(Self { writer, log: LogWriter::new(file)?, since: Instant::now(), said_over: false, claim })
    }
}

/// Keeps a recording: what is told goes to the files of the present part.
pub(super) struct Keeper {
    naming: Naming,
    options: Options,
    part: Part,
    /// The first part's name: Rerun takes parts with the same for one recording.
    recording: String,
    course: Course,
    /// Entries not written yet, and since when the first waits.
    waiting: Vec<Entry>,
    waiting_since: Instant,
    checked: Instant,
}

impl Keeper {
    pub(super) fn start(naming: Naming, options: Options) -> Result<Self, RecordingError> {
        let part = Part::create(&naming, None, &options)?;
        let now = Instant::now();
        Ok(Self {
            recording: part.claim.id.clone(),
            naming,
            options,
            part,
            course: Course::default(),
            waiting: Vec::new(),
            waiting_since: now,
            checked: now,
        })
    }

    /// How long nothing needs to be done if nothing is told.
    pub(super) fn wait(&self) -> Duration {
        if self.waiting.is_empty() {
            return Duration::from_secs(3600);
        }
        FLUSH_EVERY.saturating_sub(self.waiting_since.elapsed())
    }

    fn is_over(&self) -> bool {
        self.part.since.elapsed() >= self.options.part
    }

    /// True once a part: it is old enough, and the next begins when the trial's state is told.
    pub(super) fn wants_next(&mut self) -> bool {
        self.is_over() && !std::mem::replace(&mut self.part.said_over, true)
    }

    pub(super) fn write(&mut self, message: Message) -> Result<(), RecordingError> {
        match message {
            Message::Begin(opening) => self.begin(*opening)?,
            Message::Tick(told) => {
                if let Some(sample) = &told.sample {
                    self.part.writer.sample(sample, &mut self.course)?;
                }
                self.push(Entry::Tick(told.logged));
            }
            Message::Note(event) => self.part.writer.event(&event)?,
        }
        if self.waiting.len() >= FRAME_ENTRIES || self.waiting_since.elapsed() >= FLUSH_EVERY {
            self.flush()?;
        }
        Ok(())
    }

    fn begin(&mut self, opening: Opening) -> Result<(), RecordingError> {
        if self.is_over() {
            self.flush()?;
            let next = Part::create(&self.naming, Some(&self.recording), &self.options)?;
            let over = std::mem::replace(&mut self.part, next);
            over.writer.close()?;
        }
        self.part.writer.begin(&opening, &mut self.course)?;
        self.push(Entry::Begin(Box::new(opening.logged)));
        Ok(())
    }

    fn push(&mut self, entry: Entry) {
        if self.waiting.is_empty() {
            self.waiting_since = Instant::now();
        }
        self.waiting.push(entry);
    }

    /// Writes what waits; Rerun does so by itself with what it was handed. The room left is looked after before it is gone.
    pub(super) fn flush(&mut self) -> Result<(), RecordingError> {
        if self.checked.elapsed() >= CHECK_EVERY {
            self.checked = Instant::now();
            check_room(self.naming.folder(), &self.options)?;
            self.part.writer.check()?;
        }
        self.part.writer.flush()?;
        if !self.waiting.is_empty() {
            self.part.log.append(std::mem::take(&mut self.waiting))?;
        }
        Ok(())
    }

    pub(super) fn close(mut self) -> Result<(), RecordingError> {
        let flushed = self.flush();
        flushed.and(self.part.writer.close())
    }
}

/// Where the system cannot tell what is left, there is room.
fn check_room(folder: &Path, options: &Options) -> Result<(), RecordingError> {
    #[cfg(unix)]
    if let Ok(disk) = rustix::fs::statvfs(folder) {
        let left_bytes = disk.f_bavail.saturating_mul(disk.f_frsize);
        if left_bytes < options.least_room_bytes {
            return Err(RecordingError::Full { left_mb: left_bytes >> 20, least_mb: options.least_room_bytes >> 20 });
        }
    }
    let _ = (folder, options);
    Ok(())
}
