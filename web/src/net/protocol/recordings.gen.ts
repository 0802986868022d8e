// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { ControllerName } from './experiment.gen';

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
live: boolean, 
/**
 * Title given by a user.
 */
title: string | null, 
/**
 * What it shows; `null` for recordings of older versions and files with other names.
 */
content: RecordingContent | null, };

/**
 * What a part of a recording shows.
 */
export type RecordingContent = { 
/**
 * Maps on which time passed, in order of appearance.
 */
maps: Array<string>, 
/**
 * Controllers that had a goal, in order of appearance.
 */
controllers: Array<ControllerName>, 
/**
 * Number of deliveries.
 */
delivered: number, 
/**
 * Number of goals that were given up, by a limit or a lift-off.
 */
not_delivered: number, 
/**
 * Simulated time; the time in which the session was paused does not count.
 */
duration_s: number, };

/**
 * Answer of `GET /api/recordings`.
 */
export type RecordingList = { 
/**
 * Newest first.
 */
recordings: Array<RecordingFile>, };

/**
 * Body of `PATCH /api/recordings/{id}`.
 */
export type RecordingTitle = { 
/**
 * At most 80 characters, none of them a control character. Spaces at the ends are removed. An empty text or `null`
 * removes the title.
 */
title: string | null, };
