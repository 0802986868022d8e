//! The files of a recording, one pair per part.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::about::Notes;
use super::entities::{TimelinePosition, Writer};
use super::{Archive, Message, Opening, Options, RecordingError};
use ferry_core::trial::{Entry, LogWriter};

/// A crash loses at most this much of an input log.
const FLUSH_EVERY: Duration = Duration::from_millis(200);
/// Entries per frame; at full speed many arrive within the flush interval.
const FRAME_ENTRIES: usize = 512;
/// Interval of the checks of the disk and of the archive; even at full speed, far less than the required free space is written in between.
const CHECK_EVERY: Duration = Duration::from_millis(300);

/// Folder and names of the parts.
pub(super) enum Naming {
    /// Among the parts of other sessions, named by time.
    Archive { archive: Arc<Archive>, session: String },
    /// Two files with this name.
    Alone { folder: PathBuf, name: String },
}

impl Naming {
    fn folder(&self) -> &Path {
        match self {
            Self::Archive { archive, .. } => archive.folder(),
            Self::Alone { folder, .. } => folder,
        }
    }

    /// The session or episode of the recording.
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

/// The name of a part in progress; released on drop.
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

/// Two open files, and what they contain.
struct Part {
    writer: Writer,
    log: LogWriter<File>,
    notes: Notes,
    /// Whether a failure to write `notes` was reported.
    reported_failure: bool,
    since: Instant,
    /// Whether the next part should begin.
    is_over: bool,
    /// Whether that was already reported.
    reported_over: bool,
    /// The two files.
    paths: [PathBuf; 2],
    /// Released after the files are closed.
    claim: Claim,
}

impl Part {
    fn create(naming: &Naming, recording: Option<&str>, options: &Options) -> Result<Self, RecordingError> {
        check_room(naming.folder(), options)?;
        let (folder, claim) = (naming.folder(), naming.claim()?);
        let id = &claim.id;
        let paths = ["ferry", "rrd"].map(|ending| folder.join(format!("{id}.{ending}")));
        let [log, view] = &paths;
        let file = File::create(log).map_err(|error| RecordingError::Io { path: log.clone(), error })?;
        let writer = Writer::create(view, recording.unwrap_or(id), id, options.image_every)?;
        Ok(Self {
            writer,
            log: LogWriter::new(file)?,
            notes: Notes::default(),
            reported_failure: false,
            since: Instant::now(),
            is_over: false,
            reported_over: false,
            paths,
            claim,
        })
    }

    /// Fails if a user has removed a file, or its folder: what is written then would be lost.
    fn check(&self) -> Result<(), RecordingError> {
        let gone = self.paths.iter().find(|path| !path.is_file());
        gone.map_or(Ok(()), |path| Err(RecordingError::Gone { path: path.clone() }))
    }

    /// Deletes old recordings if this part has grown too much.
    fn keep_quota(&self) -> Result<(), RecordingError> {
        self.claim.archive.as_ref().map_or(Ok(()), |archive| archive.keep_quota())
    }

    /// Whether the part is old enough, or too large for the archive. It stays so when there is more room.
    fn is_over(&mut self, options: &Options) -> bool {
        let is_large = |archive: &Arc<Archive>| {
            let sizes = self.paths.iter().filter_map(|path| path.metadata().ok());
            sizes.map(|data| data.len()).sum::<u64>() >= archive.part_bytes()
        };
        self.is_over =
            self.is_over || self.since.elapsed() >= options.part || self.claim.archive.as_ref().is_some_and(is_large);
        self.is_over
    }

    /// Writes what the part contains, if that has changed. A failure does not stop the recording, which is complete
    /// without it.
    fn describe(&mut self) {
        let Some(content) = self.notes.take() else { return };
        let Some(archive) = &self.claim.archive else { return };
        if let Err(error) = archive.describe(&self.claim.id, content)
            && !std::mem::replace(&mut self.reported_failure, true)
        {
            tracing::warn!(%error, "the list of recordings is not up to date");
        }
    }

    fn close(mut self) -> Result<(), RecordingError> {
        self.describe();
        self.writer.close()
    }
}

/// Writes a recording into the files of the current part.
pub(super) struct Keeper {
    naming: Naming,
    options: Options,
    /// `None` while the folder is gone.
    part: Option<Part>,
    /// The first part's name: Rerun treats parts with the same name as one recording.
    recording: String,
    timeline: TimelinePosition,
    /// Entries that are not yet written, and the age of the first one.
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
            part: Some(part),
            timeline: TimelinePosition::default(),
            waiting: Vec::new(),
            waiting_since: now,
            checked: now,
        })
    }

    /// Time until the next flush, if no message arrives. The files are checked meanwhile, too.
    pub(super) fn wait(&self) -> Duration {
        let entries = match self.waiting.is_empty() {
            true => CHECK_EVERY,
            false => FLUSH_EVERY.saturating_sub(self.waiting_since.elapsed()),
        };
        self.part.as_ref().map_or(CHECK_EVERY, |part| entries.min(part.notes.wait()))
    }

    fn is_over(&mut self) -> bool {
        let Self { part, options, .. } = self;
        part.as_mut().is_none_or(|part| part.is_over(options))
    }

    /// True once per part, when it is old enough, and while the folder of a lost part is back. The next part begins with
    /// the trial's next beginning.
    pub(super) fn wants_next(&mut self) -> bool {
        let is_over = self.is_over();
        match &mut self.part {
            Some(part) => is_over && !std::mem::replace(&mut part.reported_over, true),
            None => self.naming.folder().is_dir(),
        }
    }

    /// Whether a recording whose files are gone goes on later. That of an episode would be incomplete.
    pub(super) fn waits_for_folder(&self) -> bool {
        matches!(self.naming, Naming::Archive { .. })
    }

    pub(super) fn is_interrupted(&self) -> bool {
        self.part.is_none()
    }

    /// Gives up the part, whose files are gone.
    pub(super) fn interrupt(&mut self) {
        self.part = None;
        self.waiting.clear();
    }

    pub(super) fn write(&mut self, message: Message) -> Result<(), RecordingError> {
        match (message, &mut self.part) {
            (Message::Begin(opening), _) => self.begin(*opening)?,
            (_, None) => return Ok(()),
            (Message::Tick(tick), Some(part)) => {
                self.timeline.advance();
                part.notes.tick(tick.sample.as_ref());
                if let Some(sample) = &tick.sample {
                    part.writer.sample(sample, &mut self.timeline)?;
                }
                self.push(Entry::Tick(tick.logged));
            }
            (Message::Note(event), Some(part)) => part.writer.event(&event),
        }
        if self.waiting.len() >= FRAME_ENTRIES || self.waiting_since.elapsed() >= FLUSH_EVERY {
            self.flush()?;
        }
        Ok(())
    }

    fn begin(&mut self, opening: Opening) -> Result<(), RecordingError> {
        if self.is_over() {
            self.flush()?;
            // Closed first: it can be deleted to make room for the next one.
            if let Some(over) = self.part.take() {
                over.close()?;
            }
            self.part = Some(Part::create(&self.naming, Some(&self.recording), &self.options)?);
        }
        let Some(part) = &mut self.part else { return Ok(()) };
        part.notes.begin(&opening);
        part.writer.begin(&opening, &mut self.timeline)?;
        self.push(Entry::Begin(Box::new(opening.logged)));
        Ok(())
    }

    fn push(&mut self, entry: Entry) {
        if self.waiting.is_empty() {
            self.waiting_since = Instant::now();
        }
        self.waiting.push(entry);
    }

    /// Writes waiting entries, Rerun's data and what the part contains. Checks the files and the free
    /// space of the disk.
    pub(super) fn flush(&mut self) -> Result<(), RecordingError> {
        let Some(part) = &mut self.part else { return Ok(()) };
        if self.checked.elapsed() >= CHECK_EVERY {
            self.checked = Instant::now();
            part.check()?;
            check_room(self.naming.folder(), &self.options)?;
            part.writer.check()?;
            part.keep_quota()?;
        }
        part.writer.flush()?;
        if !self.waiting.is_empty() {
            part.log.append(std::mem::take(&mut self.waiting))?;
        }
        if part.notes.wait().is_zero() {
            part.describe();
        }
        Ok(())
    }

    pub(super) fn close(mut self) -> Result<(), RecordingError> {
        let flushed = self.flush();
        flushed.and(self.part.map_or(Ok(()), Part::close))
    }
}

/// Accepts the disk if the system does not report its free space.
fn check_room(folder: &Path, options: &Options) -> Result<(), RecordingError> {
    #[cfg(unix)]
    if let Ok(disk) = rustix::fs::statvfs(folder) {
        let left_bytes = disk.f_bavail.saturating_mul(disk.f_frsize);
        if left_bytes < options.min_free_bytes {
            return Err(RecordingError::Full { left_mb: left_bytes >> 20, min_mb: options.min_free_bytes >> 20 });
        }
    }
    let _ = (folder, options);
    Ok(())
}
