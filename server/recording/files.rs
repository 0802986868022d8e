//! What recordings are called, and which there are.

use std::path::Path;

use jiff::civil::DateTime;
use jiff::tz::TimeZone;
use jiff::{Timestamp, Zoned};

use super::RecordingError;

/// How a name begins: the local clock, to the millisecond.
const BEGINNING: &str = "%Y%m%d-%H%M%S-%3f";
/// Characters of that.
const BEGINNING_LENGTH: usize = "20250130-235959-999".len();

/// Name of the recording of a session: it sorts by time.
pub fn name(started: &Zoned, session: &str) -> String {
    format!("{}-{session}", started.strftime(BEGINNING))
}

/// A finished or running recording on disk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Its id: the name of the file without its ending.
    pub id: String,
    /// The session that it is of, if [`name`] named it.
    pub session: Option<String>,
    /// When it began, if [`name`] named it.
    pub started: Option<Timestamp>,
    /// Size of the file.
    pub bytes: u64,
}

impl Listed {
    fn new(id: &str, bytes: u64, zone: &TimeZone) -> Self {
        let (started, session) = started_and_session(id, zone).unzip();
        Self { id: id.to_owned(), session, started, bytes }
    }
}

fn started_and_session(id: &str, zone: &TimeZone) -> Option<(Timestamp, String)> {
    let (beginning, rest) = id.split_at_checked(BEGINNING_LENGTH)?;
    let clock = DateTime::strptime(BEGINNING, beginning).ok()?;
    let session = rest.strip_prefix('-').filter(|session| !session.is_empty())?;
    Some((zone.to_timestamp(clock).ok()?, session.to_owned()))
}

/// The recordings in a folder, newest name first; an absent folder holds none.
pub fn list(folder: &Path) -> Result<Vec<Listed>, RecordingError> {
    let failed = |error| RecordingError::Io { path: folder.into(), error };
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(failed(error)),
    };
    let zone = TimeZone::system();
    let mut found = Vec::new();
    for entry in entries {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name();
        if let Some(id) = name.to_str().and_then(|name| name.strip_suffix(".rrd")) {
            found.push(Listed::new(id, entry.metadata().map_err(failed)?.len(), &zone));
        }
    }
    found.sort_by(|a, b| b.id.cmp(&a.id));
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_tells_when_and_whose() {
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
}
