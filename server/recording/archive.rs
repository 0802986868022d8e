//! The folder of the sessions' recordings: names, list, titles and deletion.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use jiff::civil::DateTime;
use jiff::tz::TimeZone;
use jiff::{Timestamp, Zoned};

use super::RecordingError;
use super::about::{About, Content, title};

mod quota;

pub use quota::Retention;

/// Format of a name's beginning: local time, to the millisecond.
const BEGINNING: &str = "%Y%m%d-%H%M%S-%3f";
const BEGINNING_LENGTH: usize = "20250130-235959-999".len();

/// File extensions of a recording that can be downloaded.
const ENDINGS: [&str; 2] = ["rrd", "ferry"];
/// What it contains, and its title.
const ABOUT: &str = "about.json";
/// All files of a recording. The one that makes it appear in the list is the last to be deleted; the first exists only
/// while [`ABOUT`] is written.
const ALL_ENDINGS: [&str; 4] = ["about.part", ABOUT, ENDINGS[1], ENDINGS[0]];

/// Name of a part of a session's recording. Names sort by time.
fn name(started: &Zoned, session: &str) -> String {
    format!("{}-{session}", started.strftime(BEGINNING))
}

/// A finished or running recording on disk.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listed {
    /// File name without extension.
    pub id: String,
    /// Session name; `None` for files with other names.
    pub session: Option<String>,
    /// Time of the beginning; `None` for files with other names.
    pub started: Option<Timestamp>,
    /// Size of Rerun's file.
    pub bytes: u64,
    /// Size of the input log, if it exists.
    pub log_bytes: Option<u64>,
    /// Whether it is being written.
    pub live: bool,
    /// Given by a user.
    pub title: Option<String>,
    /// Unknown in recordings of older versions and of others.
    pub content: Option<Content>,
    about_bytes: u64,
}

impl Listed {
    fn new(id: &str, bytes: u64, zone: &TimeZone) -> Self {
        let (started, session) = started_and_session(id, zone).unzip();
        Self { id: id.to_owned(), session, started, bytes, ..Self::default() }
    }

    fn all_bytes(&self) -> u64 {
        self.bytes + self.log_bytes.unwrap_or_default() + self.about_bytes
    }
}

fn started_and_session(id: &str, zone: &TimeZone) -> Option<(Timestamp, String)> {
    let (beginning, rest) = id.split_at_checked(BEGINNING_LENGTH)?;
    let clock = DateTime::strptime(BEGINNING, beginning).ok()?;
    let session = rest.strip_prefix('-').filter(|session| !session.is_empty())?;
    Some((zone.to_timestamp(clock).ok()?, session.to_owned()))
}

/// A folder of recordings. Some may be in progress.
#[derive(Debug)]
pub struct Archive {
    folder: PathBuf,
    retention: Retention,
    /// Names of recordings in progress.
    live: Mutex<BTreeSet<String>>,
    /// Held while a title or content is written and while files are deleted.
    changing: Mutex<()>,
}

impl Archive {
    /// The folder is created at the first write.
    pub fn new(folder: PathBuf, retention: Retention) -> Arc<Self> {
        Arc::new(Self { folder, retention, live: Mutex::default(), changing: Mutex::default() })
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// A file of a listed recording; other names are never opened.
    pub fn file(&self, name: &str) -> Result<Option<PathBuf>, RecordingError> {
        let Some((id, ending)) = name.rsplit_once('.').filter(|(_, ending)| ENDINGS.contains(ending)) else {
            return Ok(None);
        };
        let listed = self.list()?.into_iter().find(|listed| listed.id == id);
        let known = listed.filter(|listed| ending == ENDINGS[0] || listed.log_bytes.is_some());
        Ok(known.map(|listed| self.path(&listed.id, ending)))
    }

    fn path(&self, id: &str, ending: &str) -> PathBuf {
        self.folder.join(format!("{id}.{ending}"))
    }

    /// A listed recording; other names never become a path.
    fn find(&self, id: &str) -> Result<Listed, RecordingError> {
        let found = self.list()?.into_iter().find(|listed| listed.id == id);
        found.ok_or_else(|| RecordingError::Unknown { id: id.to_owned() })
    }

    /// The recordings, newest name first. A missing folder has none.
    pub fn list(&self) -> Result<Vec<Listed>, RecordingError> {
        let mut found = self.scan()?;
        for listed in &mut found {
            let About { title, content } = About::read(&self.path(&listed.id, ABOUT));
            (listed.title, listed.content) = (title, content);
        }
        Ok(found)
    }

    /// The same without titles and contents, which are in files.
    fn scan(&self) -> Result<Vec<Listed>, RecordingError> {
        let failed = |error| RecordingError::Io { path: self.folder.clone(), error };
        let entries = match std::fs::read_dir(&self.folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(failed(error)),
        };
        let zone = TimeZone::system();
        let live = lock(&self.live).clone();
        let mut found = Vec::new();
        for entry in entries {
            let name = entry.map_err(failed)?.file_name();
            let Some(id) = name.to_str().and_then(|name| name.strip_suffix(".rrd")) else { continue };
            // The recording may have been deleted meanwhile.
            let Some(bytes) = self.size(id, ENDINGS[0]) else { continue };
            found.push(Listed {
                log_bytes: self.size(id, ENDINGS[1]),
                live: live.contains(id),
                about_bytes: self.size(id, ABOUT).unwrap_or_default(),
                ..Listed::new(id, bytes, &zone)
            });
        }
        found.sort_by(|a, b| b.id.cmp(&a.id));
        Ok(found)
    }

    fn size(&self, id: &str, ending: &str) -> Option<u64> {
        // What a link points to is no recording.
        std::fs::symlink_metadata(self.path(id, ending)).ok().filter(|data| data.is_file()).map(|data| data.len())
    }

    /// Gives a recording a title, or removes it.
    ///
    /// # Errors
    /// The title is not allowed, or the recording is unknown.
    pub fn rename(&self, id: &str, wished: Option<&str>) -> Result<Listed, RecordingError> {
        let title = title(wished.unwrap_or_default())?;
        let _changing = lock(&self.changing);
        let listed = self.find(id)?;
        self.update(id, |about| about.title.clone_from(&title))?;
        Ok(Listed { title, ..listed })
    }

    /// Deletes the files of a finished recording.
    ///
    /// # Errors
    /// The recording is unknown or being written.
    pub fn delete(&self, id: &str) -> Result<(), RecordingError> {
        let _changing = lock(&self.changing);
        match self.find(id)? {
            Listed { live: true, id, .. } => Err(RecordingError::Live { id }),
            listed => self.remove(&listed.id),
        }
    }

    fn remove(&self, id: &str) -> Result<(), RecordingError> {
        ALL_ENDINGS.iter().try_for_each(|ending| {
            let path = self.path(id, ending);
            match std::fs::remove_file(&path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(RecordingError::Io { path, error }),
                _ => Ok(()),
            }
        })
    }

    /// Sets the content of a recording in progress.
    pub(super) fn describe(&self, id: &str, content: &Content) -> Result<(), RecordingError> {
        let _changing = lock(&self.changing);
        self.update(id, |about| about.content = Some(content.clone()))
    }

    /// The caller holds `changing`.
    fn update(&self, id: &str, change: impl FnOnce(&mut About)) -> Result<(), RecordingError> {
        let path = self.path(id, ABOUT);
        let mut about = About::read(&path);
        change(&mut about);
        about.write(&path).map_err(|error| RecordingError::Io { path, error })
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    #[test]
    fn a_name_contains_time_and_session() {
        let zone = TimeZone::fixed(jiff::tz::offset(2));
        let started: Timestamp = "2026-03-01T21:04:09.045Z".parse().unwrap();
        let id = name(&started.to_zoned(zone.clone()), "session-2");
        assert_eq!(id, "20260301-230409-045-session-2");
        let listed = Listed::new(&id, 5, &zone);
        assert_eq!((listed.started, listed.session.as_deref()), (Some(started), Some("session-2")));
        for other in [
            "",
            "mine",
            "20260301-230409-045",
            "20260301-230409-045-",
            "20261301-230409-045-main",
            "ä".repeat(12).as_str(),
        ] {
            let listed = Listed::new(other, 5, &zone);
            assert_eq!((listed.started, listed.session), (None, None), "{other}");
        }
    }

    pub(super) fn put(folder: &Path, id: &str, bytes: usize) {
        for ending in ENDINGS {
            std::fs::write(folder.join(format!("{id}.{ending}")), vec![0; bytes]).unwrap();
        }
    }

    pub(super) fn ids(archive: &Archive) -> Vec<String> {
        archive.list().unwrap().into_iter().map(|listed| listed.id).collect()
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_no_recording() {
        let folder = tempfile::tempdir().unwrap();
        put(folder.path(), "mine", 10);
        std::os::unix::fs::symlink("/etc/hostname", folder.path().join("link.rrd")).unwrap();
        let archive = Archive::new(folder.path().to_owned(), Retention::default());
        assert_eq!((ids(&archive), archive.file("link.rrd").unwrap()), (vec!["mine".to_owned()], None));
    }

    fn archive_in(folder: &Path) -> Arc<Archive> {
        Archive::new(folder.to_owned(), Retention::default())
    }

    #[test]
    fn a_title_and_the_content_are_kept_beside_each_other() {
        let folder = tempfile::tempdir().unwrap();
        let archive = archive_in(folder.path());
        let id = archive.claim("main").unwrap();
        put(folder.path(), &id, 10);
        let content = Content { maps: vec!["posts".to_owned()], delivered: 2, ..Content::default() };
        assert_eq!(
            archive.rename(&id, Some(" first ")).unwrap().title.as_deref(),
            Some("first"),
            "while it is written"
        );
        archive.describe(&id, &content).unwrap();
        let listed = archive.list().unwrap().remove(0);
        assert_eq!((listed.title.as_deref(), &listed.content), (Some("first"), &Some(content.clone())));
        for nothing in [None, Some(""), Some("  ")] {
            archive.rename(&id, Some("second")).unwrap();
            assert_eq!(archive.rename(&id, nothing).unwrap().title, None);
            let listed = archive.list().unwrap().remove(0);
            assert_eq!((&listed.title, &listed.content), (&None, &Some(content.clone())), "{nothing:?}");
        }
        assert!(matches!(archive.rename(&id, Some("a\nb")), Err(RecordingError::ControlInTitle { found: '\n' })));
        assert!(matches!(archive.rename("missing", Some("a")), Err(RecordingError::Unknown { .. })));
    }

    #[test]
    fn deletes_all_files_of_a_finished_recording_and_no_others() {
        let folder = tempfile::tempdir().unwrap();
        let archive = archive_in(folder.path());
        let id = archive.claim("main").unwrap();
        for id in [id.as_str(), "mine", "mine.too"] {
            put(folder.path(), id, 10);
            archive.rename(id, Some("title")).unwrap();
        }
        std::fs::write(archive.path("mine", "about.part"), "{").unwrap();
        std::fs::write(archive.path("mine", "txt"), "other").unwrap();
        assert!(matches!(archive.delete(&id), Err(RecordingError::Live { .. })));
        archive.release(&id);
        archive.delete(&id).unwrap();
        archive.delete("mine").unwrap();
        for missing in ["mine", id.as_str(), "../mine", "mine.rrd", ""] {
            assert!(matches!(archive.delete(missing), Err(RecordingError::Unknown { .. })), "{missing}");
        }
        let mut left: Vec<_> =
            std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        left.sort();
        assert_eq!(left, ["mine.too.about.json", "mine.too.ferry", "mine.too.rrd", "mine.txt"]);
    }
}
