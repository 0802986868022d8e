// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

/**
 * A part of a session's recording on disk; `GET /api/recordings/{id}.rrd` is Rerun's file, `{id}.ferry` its input
 * log.
 */
export type RecordingFile = { 
/**
 * Name of the files without their endings.
 */
id: string, 
/**
 * Name of the session; `null` for files with other names.
 */
session: string | null, 
/**
 * Time of the beginning, RFC 3339; `null` for files with other names.
 */
started: string | null, 
/**
 * Size of Rerun's file so far.
 */
bytes: number, 
/**
 * Size of its input log, if it has one.
 */
log_bytes: number | null, 
/**
 * Whether it is still being written. Then it grows, and has no footer yet.
 */
live: boolean, };

/**
 * Answer of `GET /api/recordings`.
 */
export type RecordingList = { 
/**
 * Newest first.
 */
recordings: Array<RecordingFile>, };
