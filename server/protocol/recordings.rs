//! The list of recordings.

use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

/// Answer of `GET /api/recordings`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecordingList {
    /// Newest first.
    pub recordings: Vec<RecordingFile>,
}

/// A part of a session's recording on disk; `GET /api/recordings/{id}.rrd` is Rerun's file, `{id}.ferry` its input
/// log.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecordingFile {
    /// Name of the files without their endings.
    pub id: String,
    /// Name of the session; `null` for files with other names.
    pub session: Option<String>,
    /// Time of the beginning, RFC 3339; `null` for files with other names.
    pub started: Option<String>,
    /// Size of Rerun's file so far.
    #[ts(type = "number")]
    pub bytes: u64,
    /// Size of its input log, if it has one.
    #[ts(type = "number | null")]
    pub log_bytes: Option<u64>,
    /// Whether it is still being written. Then it grows, and has no footer yet.
    pub live: bool,
}
