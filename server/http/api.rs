//! Sessions, maps and recordings over plain HTTP.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use axum::Json;
use axum::body::Body;
use axum::extract::{Path, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use tokio::io::AsyncReadExt;
use tokio_util::io::ReaderStream;

use super::body::WholeBody;
use super::problem::Problem;
use super::{MAIN_SESSION, SESSION_CAP, Server};
use crate::map::{Map, MapError};
use crate::protocol::{FlowField, FlowQuery, RecordingFile, RecordingList, StateMessage};
use crate::recording::Listed;
use crate::scenario::{ControllerName, Scenario};
use crate::session::View;

#[derive(Serialize)]
pub struct Maps {
    maps: Vec<String>,
}

pub async fn maps() -> Json<Maps> {
    Json(Maps { maps: Map::shipped_names() })
}

pub async fn map(Path(name): Path<String>) -> Result<Response, Problem> {
    let map = Map::shipped(&name).map_err(|error| match error {
        MapError::Unknown { .. } => Problem::new(StatusCode::NOT_FOUND, "not_found", error.to_string()).field("name"),
        error => Problem::internal(error),
    })?;
    Ok(attachment("image/svg+xml", &format!("{name}.svg"), map.svg().to_owned()))
}

/// A recording is read in pieces of this size.
const CHUNK_BYTES: usize = 64 << 10;
/// Spacing of a flow field.
const SPACING_M: std::ops::RangeInclusive<f64> = 0.005..=0.05;

/// `POST /api/sessions/{id}/flow`: where attractor dynamics would lead.
pub async fn flow(
    State(server): State<Arc<Server>>,
    Path(id): Path<String>,
    WholeBody(body): WholeBody,
) -> Result<Json<FlowField>, Problem> {
    let FlowQuery { spacing_m, .. } = parse(&body)?;
    if !SPACING_M.contains(&spacing_m) {
        let message = format!("spacing_m is {spacing_m}, it must be {} to {}", SPACING_M.start(), SPACING_M.end());
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", message).field("spacing_m"));
    }
    let view = view(&server, &id)?;
    let field = tokio::task::spawn_blocking(move || FlowField::of(&view, spacing_m)).await;
    Ok(Json(field.map_err(Problem::internal)?))
}

#[derive(Serialize)]
pub struct SessionSummary {
    id: String,
    map: String,
    controller: ControllerName,
    tick: u64,
    running: bool,
    recording: String,
}

impl SessionSummary {
    fn of(id: &str, view: &View) -> Self {
        Self {
            id: id.to_owned(),
            map: view.scenery.arena.map.name().to_owned(),
            controller: view.moment.controller,
            tick: view.moment.tick,
            running: view.running,
            recording: view.recording.clone(),
        }
    }
}

#[derive(Serialize)]
pub struct Sessions {
    sessions: Vec<SessionSummary>,
}

pub async fn sessions(State(server): State<Arc<Server>>) -> Json<Sessions> {
    let hubs = server.sessions.read().expect("no holder panics");
    let sessions = hubs.iter().map(|(id, hub)| SessionSummary::of(id, &hub.session.watch().borrow())).collect();
    Json(Sessions { sessions })
}

/// Body of `POST /api/sessions`; everything may be left out.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct NewSession {
    map: String,
    controller: ControllerName,
    seed: u64,
}

impl Default for NewSession {
    fn default() -> Self {
        Self { map: "posts".into(), controller: ControllerName::Attractor, seed: 1 }
    }
}

pub async fn create_session(
    State(server): State<Arc<Server>>,
    WholeBody(body): WholeBody,
) -> Result<Response, Problem> {
    let asked: NewSession = if body.is_empty() { NewSession::default() } else { parse(&body)? };
    // Files are for the command line: no client path touches the file system.
    Map::shipped(&asked.map).map_err(|error| {
        Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "map_refused", error.to_string()).field("map")
    })?;
    let scenario = Scenario { controller: asked.controller, ..Scenario::idle(&asked.map, asked.seed) };
    let place = server.places.clone().try_acquire_owned().map_err(|_| {
        let detail = format!("there are {SESSION_CAP} sessions already; delete one first");
        Problem::new(StatusCode::TOO_MANY_REQUESTS, "too_many_sessions", detail)
    })?;
    let id = format!("session-{}", server.made.fetch_add(1, Ordering::Relaxed) + 1);
    let location = format!("/api/sessions/{id}");
    let opening = tokio::task::spawn_blocking(move || server.open(&id, scenario, place));
    let hub = opening.await.map_err(Problem::internal)?.map_err(Problem::internal)?;
    let summary = SessionSummary::of(&hub.id, &hub.session.watch().borrow());
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], Json(summary)).into_response())
}

pub async fn session(
    State(server): State<Arc<Server>>,
    Path(id): Path<String>,
) -> Result<Json<SessionSummary>, Problem> {
    let view = view(&server, &id)?;
    Ok(Json(SessionSummary::of(&id, &view)))
}

pub async fn delete_session(State(server): State<Arc<Server>>, Path(id): Path<String>) -> Result<StatusCode, Problem> {
    if id == MAIN_SESSION {
        return Err(Problem::new(StatusCode::CONFLICT, "main_session", "the session main stays as long as the server"));
    }
    let removed = server.sessions.write().expect("no holder panics").remove(&id);
    let hub = removed.ok_or_else(|| Problem::not_found("session", &id))?;
    hub.close();
    // Joining the session's thread and closing its file blocks.
    tokio::task::spawn_blocking(move || drop(hub)).await.map_err(Problem::internal)?;
    Ok(StatusCode::NO_CONTENT)
}

pub async fn state(State(server): State<Arc<Server>>, Path(id): Path<String>) -> Result<Json<StateMessage>, Problem> {
    let view = view(&server, &id)?;
    Ok(Json(StateMessage::from(&*view)))
}

pub async fn camera(State(server): State<Arc<Server>>, Path(id): Path<String>) -> Result<Response, Problem> {
    let png = view(&server, &id)?.sight.1.frame.picture.to_png().map_err(Problem::internal)?;
    Ok(([(header::CONTENT_TYPE, "image/png")], png).into_response())
}

pub async fn observation(State(server): State<Arc<Server>>, Path(id): Path<String>) -> Result<Response, Problem> {
    let png = view(&server, &id)?.sight.1.observation().side_by_side().to_png().map_err(Problem::internal)?;
    Ok(([(header::CONTENT_TYPE, "image/png")], png).into_response())
}

pub async fn recordings(State(server): State<Arc<Server>>) -> Result<Json<RecordingList>, Problem> {
    let listed = server.recordings.list().map_err(Problem::internal)?;
    Ok(Json(RecordingList { recordings: listed.into_iter().map(RecordingFile::from).collect() }))
}

impl From<Listed> for RecordingFile {
    fn from(listed: Listed) -> Self {
        let Listed { id, session, started, bytes, log_bytes, live } = listed;
        Self { id, session, started: started.map(|started| started.to_string()), bytes, log_bytes, live }
    }
}

/// `GET /api/recordings/{id}.rrd`, and `.ferry`. Only names that the list holds are opened, so that no client path
/// touches the file system.
pub async fn recording(State(server): State<Arc<Server>>, Path(name): Path<String>) -> Result<Response, Problem> {
    let path = server.recordings.file(&name).map_err(Problem::internal)?;
    let path = path.ok_or_else(|| Problem::not_found("recording", &name))?;
    let opened = tokio::fs::File::open(path).await.map_err(Problem::internal)?;
    // What is written while it is sent is left out, so that the length told is the length sent.
    let bytes = opened.metadata().await.map_err(Problem::internal)?.len();
    let body = Body::from_stream(ReaderStream::with_capacity(opened.take(bytes), CHUNK_BYTES));
    let mut response = attachment("application/octet-stream", &name, body);
    response.headers_mut().insert(header::CONTENT_LENGTH, bytes.into());
    Ok(response)
}

pub fn view(server: &Server, id: &str) -> Result<Arc<View>, Problem> {
    let hub = server.find(id).ok_or_else(|| Problem::not_found("session", id))?;
    Ok(hub.session.watch().borrow().clone())
}

pub fn parse<'a, T: Deserialize<'a>>(body: &'a [u8]) -> Result<T, Problem> {
    let mut reader = serde_json::Deserializer::from_slice(body);
    let malformed = |detail: String| Problem::new(StatusCode::BAD_REQUEST, "malformed", detail);
    let value = serde_path_to_error::deserialize(&mut reader)
        .map_err(|error| malformed(error.to_string()).field(&error.path().to_string()))?;
    reader.end().map_err(|error| malformed(error.to_string()))?;
    Ok(value)
}

pub fn attachment(kind: &'static str, name: &str, body: impl Into<Body>) -> Response {
    let disposition = format!("attachment; filename=\"{name}\"");
    ([(header::CONTENT_TYPE, kind.to_owned()), (header::CONTENT_DISPOSITION, disposition)], body.into()).into_response()
}
