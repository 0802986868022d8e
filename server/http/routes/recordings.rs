//! The list of recordings, their files and titles.

use std::sync::Arc;

use axum::Json;
use axum::body::Body;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::Response;
use tokio::io::AsyncReadExt;
use tokio_util::io::ReaderStream;

use crate::http::Server;
use crate::http::body::{WholeBody, attachment, parse};
use crate::http::path::{Path, RecordingPath};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, Unavailable};
use crate::protocol::{RecordingContent, RecordingFile, RecordingList, RecordingTitle};
use ferry_recording::{Content, Listed, RecordingError};

/// Chunk size for reading recordings.
const CHUNK_BYTES: usize = 64 << 10;

/// The recordings.
#[utoipa::path(get, path = "/api/recordings", tag = "recordings",
    responses((status = 200, body = RecordingList, links(("the newest" = (operation_id = "recording",
        parameters(("file" = "{$response.body#/recordings/0/id}.rrd")))))), Unavailable))]
pub async fn recordings(State(server): State<Arc<Server>>) -> Result<Json<RecordingList>, Problem> {
    let listed = server.work(|server| server.recordings.list()).await??;
    Ok(Json(RecordingList { recordings: listed.into_iter().map(RecordingFile::from).collect() }))
}

impl From<Listed> for RecordingFile {
    fn from(listed: Listed) -> Self {
        let Listed { id, session, started, bytes, log_bytes, live, title, content, .. } = listed;
        let started = started.map(|started| started.to_string());
        Self { id, session, started, bytes, log_bytes, live, title, content: content.map(RecordingContent::from) }
    }
}

impl From<Content> for RecordingContent {
    fn from(content: Content) -> Self {
        let duration_s = content.duration_s();
        let Content { maps, controllers, delivered, not_delivered, .. } = content;
        Self { maps, controllers, delivered, not_delivered, duration_s }
    }
}

impl From<RecordingError> for Problem {
    fn from(error: RecordingError) -> Self {
        let refusal = |status, code| Self::new(status, code, error.to_string());
        match &error {
            RecordingError::Unknown { .. } => refusal(StatusCode::NOT_FOUND, "not_found"),
            RecordingError::Live { .. } => refusal(StatusCode::CONFLICT, "being_written"),
            RecordingError::LongTitle { .. } | RecordingError::ControlInTitle { .. } => {
                refusal(StatusCode::UNPROCESSABLE_ENTITY, "title_refused").field("title")
            }
            _ => Self::internal(error),
        }
    }
}

/// A recording: Rerun's file or the input log.
#[utoipa::path(get, path = "/api/recordings/{file}", tag = "recordings", params(RecordingPath),
    responses((status = 200, description = "The file as far as it is written.", content(("application/octet-stream"))), NotFound, Unavailable))]
pub async fn recording(
    State(server): State<Arc<Server>>,
    Path(RecordingPath { file: name }): Path<RecordingPath>,
) -> Result<Response, Problem> {
    // Only listed names are opened, so that no path from a client touches the file system.
    let asked = name.clone();
    let path = server.work(move |server| server.recordings.file(&asked)).await??;
    let path = path.ok_or_else(|| Problem::not_found("recording", &name))?;
    let opened = tokio::fs::File::open(path).await.map_err(Problem::internal)?;
    // Bytes written during the transfer are omitted, so that the announced length is correct.
    let bytes = opened.metadata().await.map_err(Problem::internal)?.len();
    let body = Body::from_stream(ReaderStream::with_capacity(opened.take(bytes), CHUNK_BYTES));
    let mut response = attachment("application/octet-stream", &name, body);
    response.headers_mut().insert(header::CONTENT_LENGTH, bytes.into());
    Ok(response)
}

/// Gives a recording a title, or removes it.
#[utoipa::path(patch, path = "/api/recordings/{file}", tag = "recordings", operation_id = "rename_recording",
    params(RecordingPath), request_body = RecordingTitle,
    responses((status = 200, body = RecordingFile), NotFound, OutOfRange, Unavailable))]
pub async fn rename(
    State(server): State<Arc<Server>>,
    Path(RecordingPath { file: id }): Path<RecordingPath>,
    WholeBody(body): WholeBody,
) -> Result<Json<RecordingFile>, Problem> {
    let RecordingTitle { title } = parse(&body)?;
    let renamed = server.work(move |server| server.recordings.rename(&id, title.as_deref())).await??;
    Ok(Json(renamed.into()))
}

/// Deletes all files of a finished recording.
#[utoipa::path(delete, path = "/api/recordings/{file}", tag = "recordings", operation_id = "delete_recording",
    params(RecordingPath),
    responses((status = 204, description = "The recording is deleted."), NotFound, Conflict, Unavailable))]
pub async fn delete(
    State(server): State<Arc<Server>>,
    Path(RecordingPath { file: id }): Path<RecordingPath>,
) -> Result<StatusCode, Problem> {
    server.work(move |server| server.recordings.delete(&id)).await??;
    Ok(StatusCode::NO_CONTENT)
}
