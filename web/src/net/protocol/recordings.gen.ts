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
 * The session that it is of; none where the file was not named by Ferry.
 */
session: string | null, 
/**
 * When it began, RFC 3339; none where the file was not named by Ferry.
 */
started: string | null, 
/**
 * Size of Rerun's file up to now.
 */
bytes: number, 
/**
 * Size of its input log, if it has one.
 */
log_bytes: number | null, 
/**
 * Whether it is being written: it grows, and has no footer yet.
 */
live: boolean, };

/**
 * Answer of `GET /api/recordings`.
 */
export type RecordingList = { 
/**
 * The newest first.
 */
recordings: Array<RecordingFile>, };
