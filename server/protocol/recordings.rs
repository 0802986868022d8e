//! The list of recordings.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::scenario::ControllerName;

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
    /// Title given by a user.
    pub title: Option<String>,
    /// What it shows; `null` for recordings of older versions and files with other names.
    pub content: Option<RecordingContent>,
}

/// What a part of a recording shows.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecordingContent {
    /// Maps on which time passed, in order of appearance.
    pub maps: Vec<String>,
    /// Controllers that had a goal, in order of appearance.
    pub controllers: Vec<ControllerName>,
    /// Number of deliveries.
    pub delivered: u32,
    /// Number of goals that were given up, by a limit or a lift-off.
    pub not_delivered: u32,
    /// Simulated time; the time in which the session was paused does not count.
    pub duration_s: f64,
}

/// Body of `PATCH /api/recordings/{id}`.
#[derive(Clone, Debug, PartialEq, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordingTitle {
    /// At most 80 characters, none of them a control character. Spaces at the ends are removed. An empty text or `null`
    /// removes the title.
    #[serde(deserialize_with = "Option::deserialize")]
    #[schema(required, max_length = 80, example = "Colon, second try")]
    pub title: Option<String>,
}
