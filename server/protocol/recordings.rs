//! The list of recordings.

use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

/// Answer of `GET /api/recordings`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecordingList {
    /// The newest first.
    pub recordings: Vec<RecordingFile>,
}

/// A part of a session's recording on disk; `GET /api/recordings/{id}.rrd` is Rerun's file, `{id}.ferry` its input
/// log.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecordingFile {
    /// Name of the files without their endings.
    pub id: String,
    /// The session that it is of; none where the file was not named by Ferry.
    pub session: Option<String>,
    /// When it began, RFC 3339; none where the file was not named by Ferry.
    pub started: Option<String>,
    /// Size of Rerun's file up to now.
    #[ts(type = "number")]
    pub bytes: u64,
    /// Size of its input log, if it has one.
    #[ts(type = "number | null")]
    pub log_bytes: Option<u64>,
    /// Whether it is being written: it grows, and has no footer yet.
    pub live: bool,
}
