//! The list of recordings.

use serde::Serialize;
use ts_rs::TS;

/// Answer of `GET /api/recordings`.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RecordingList {
    /// The newest first.
    pub recordings: Vec<RecordingFile>,
}

/// A recording on disk; `GET /api/recordings/{id}.rrd` is its file.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RecordingFile {
    /// Name of the file without its ending.
    pub id: String,
    /// The session that it is of; none where the file was not named by Ferry.
    pub session: Option<String>,
    /// When it began, RFC 3339; none where the file was not named by Ferry.
    pub started: Option<String>,
    /// Size of the file up to now.
    #[ts(type = "number")]
    pub bytes: u64,
    /// Whether its session still runs: the file may grow, and has no footer yet.
    pub live: bool,
}
