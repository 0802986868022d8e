//! The list of recordings and their files.

use std::sync::Arc;

use axum::Json;
use axum::body::Body;
use axum::extract::State;
use axum::http::header;
use axum::response::Response;
use tokio::io::AsyncReadExt;
use tokio_util::io::ReaderStream;

use crate::http::Server;
use crate::http::body::attachment;
use crate::http::path::{Path, RecordingPath};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, Unavailable};
use crate::protocol::{RecordingFile, RecordingList};
use crate::recording::Listed;

/// Chunk size for reading recordings.
const CHUNK_BYTES: usize = 64 << 10;

/// The recordings.
#[utoipa::path(get, path = "/api/recordings", tag = "recordings",
    responses((status = 200, body = RecordingList, links(("the newest" = (operation_id = "recording",
        parameters(("file" = "{$response.body#/recordings/0/id}.rrd")))))), Unavailable))]
pub async fn recordings(State(server): State<Arc<Server>>) -> Result<Json<RecordingList>, Problem> {
    let listed = server.work(|server| server.recordings.list()).await?.map_err(Problem::internal)?;
    Ok(Json(RecordingList { recordings: listed.into_iter().map(RecordingFile::from).collect() }))
}

impl From<Listed> for RecordingFile {
    fn from(listed: Listed) -> Self {
        let Listed { id, session, started, bytes, log_bytes, live } = listed;
        Self { id, session, started: started.map(|started| started.to_string()), bytes, log_bytes, live }
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
    let found = server.work(move |server| server.recordings.file(&asked)).await?;
    let path = found.map_err(Problem::internal)?;
    let path = path.ok_or_else(|| Problem::not_found("recording", &name))?;
    let opened = tokio::fs::File::open(path).await.map_err(Problem::internal)?;
    // Bytes written during the transfer are omitted, so that the announced length is correct.
    let bytes = opened.metadata().await.map_err(Problem::internal)?.len();
    let body = Body::from_stream(ReaderStream::with_capacity(opened.take(bytes), CHUNK_BYTES));
    let mut response = attachment("application/octet-stream", &name, body);
    response.headers_mut().insert(header::CONTENT_LENGTH, bytes.into());
    Ok(response)
}
