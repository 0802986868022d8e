//! Sessions, maps and recordings over plain HTTP.

use std::sync::Arc;

use axum::Json;
use axum::body::Body;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use tokio::io::AsyncReadExt;
use tokio_util::io::ReaderStream;
use utoipa::ToSchema;

use super::Server;
use super::body::WholeBody;
use super::hub::Hub;
use super::path::{Path, RecordingPath, SessionPath};
use super::problem::Problem;
use super::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use super::sessions::MAIN;
use crate::protocol::{FLOW_SPACING_M, FlowField, FlowQuery, RecordingFile, RecordingList, StateMessage};
use crate::recording::Listed;
use crate::scenario::{ControllerName, Scenario};
use crate::session::View;

/// Whether the server answers, and means to go on.
#[utoipa::path(get, path = "/healthz", tag = "server",
    responses((status = 200, description = "It does.", content_type = "text/plain", body = String), Unavailable))]
pub async fn health(State(server): State<Arc<Server>>) -> Result<&'static str, Problem> {
    if *server.stopping.borrow() {
        return Err(Problem::new(StatusCode::SERVICE_UNAVAILABLE, "stopping", "the server is stopping"));
    }
    Ok("ok\n")
}

/// A recording is read in pieces of this size.
const CHUNK_BYTES: usize = 64 << 10;

/// Where attractor dynamics would lead.
#[utoipa::path(post, path = "/api/sessions/{id}/flow", tag = "sessions", params(SessionPath), request_body = FlowQuery,
    responses((status = 200, body = FlowField), NotFound, OutOfRange))]
pub async fn flow(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
    WholeBody(body): WholeBody,
) -> Result<Json<FlowField>, Problem> {
    let FlowQuery { spacing_m, .. } = parse(&body)?;
    if !FLOW_SPACING_M.contains(&spacing_m) {
        let (least, most) = (FLOW_SPACING_M.start(), FLOW_SPACING_M.end());
        let message = format!("spacing_m is {spacing_m}, it must be {least} to {most}");
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", message).field("spacing_m"));
    }
    let view = view(&server, &id)?;
    Ok(Json(server.work(move |_| FlowField::of(&view, spacing_m)).await?))
}

/// A session in short.
#[derive(Serialize, ToSchema)]
pub struct SessionSummary {
    /// Its name.
    id: String,
    /// Its map.
    map: String,
    /// Sub-controller 2 in use.
    controller: ControllerName,
    /// Ticks since the start of the trial.
    tick: u64,
    /// Whether time runs.
    running: bool,
    /// `recording`, or why it is not recorded.
    recording: String,
    /// Browsers that look at it.
    viewers: usize,
    /// Nobody looked for long: its time stands.
    parked: bool,
    /// Why it ended, if it has.
    ended: Option<String>,
}

impl SessionSummary {
    fn of(hub: &Hub, view: &View) -> Self {
        Self {
            id: hub.id.clone(),
            map: view.scenery.arena.map.name().to_owned(),
            controller: view.moment.controller,
            tick: view.moment.tick,
            running: view.running,
            recording: view.recording.clone(),
            viewers: hub.viewers(),
            parked: hub.is_parked(),
            ended: view.ended.clone(),
        }
    }
}

/// The sessions.
#[derive(Serialize, ToSchema)]
pub struct Sessions {
    /// By name.
    sessions: Vec<SessionSummary>,
}

/// The sessions.
#[utoipa::path(get, path = "/api/sessions", tag = "sessions", responses((status = 200, body = Sessions)))]
pub async fn sessions(State(server): State<Arc<Server>>) -> Json<Sessions> {
    let hubs = server.sessions.all();
    let sessions = hubs.iter().map(|hub| SessionSummary::of(hub, &hub.session.watch().borrow())).collect();
    Json(Sessions { sessions })
}

/// Body of `POST /api/sessions`; everything may be left out.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
struct NewSession {
    /// Name of a map.
    #[schema(example = "posts")]
    map: String,
    /// Sub-controller 2.
    controller: ControllerName,
    /// Seed of everything random in its trial.
    seed: u64,
}

impl Default for NewSession {
    fn default() -> Self {
        Self { map: "posts".into(), controller: ControllerName::Attractor, seed: 1 }
    }
}

/// Makes a session.
#[utoipa::path(post, path = "/api/sessions", tag = "sessions", request_body = Option<NewSession>,
    responses((status = 201, body = SessionSummary, headers(("Location" = String, description = "Its path."))),
        OutOfRange, TooMany))]
pub async fn create_session(
    State(server): State<Arc<Server>>,
    WholeBody(body): WholeBody,
) -> Result<Response, Problem> {
    let asked: Option<NewSession> = if body.is_empty() { None } else { parse(&body)? };
    let asked = asked.unwrap_or_default();
    let scenario = Scenario { controller: asked.controller, ..Scenario::idle(&asked.map, asked.seed) };
    let hub = server.sessions.create(scenario).await?;
    let location = format!("/api/sessions/{}", hub.id);
    let summary = SessionSummary::of(&hub, &hub.session.watch().borrow());
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], Json(summary)).into_response())
}

/// A session in short.
#[utoipa::path(get, path = "/api/sessions/{id}", tag = "sessions", params(SessionPath),
    responses((status = 200, body = SessionSummary), NotFound))]
pub async fn session(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Json<SessionSummary>, Problem> {
    let hub = find(&server, &id)?;
    let summary = SessionSummary::of(&hub, &hub.session.watch().borrow());
    Ok(Json(summary))
}

/// Ends a session, and its recording.
#[utoipa::path(delete, path = "/api/sessions/{id}", tag = "sessions", params(SessionPath),
    responses((status = 204, description = "It has ended."), NotFound, Conflict))]
pub async fn delete_session(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<StatusCode, Problem> {
    if id == MAIN {
        return Err(Problem::new(StatusCode::CONFLICT, "main_session", "the session main stays as long as the server"));
    }
    server.sessions.end(find(&server, &id)?).await;
    Ok(StatusCode::NO_CONTENT)
}

/// What moves in a session, now.
#[utoipa::path(get, path = "/api/sessions/{id}/state", tag = "sessions", params(SessionPath),
    responses((status = 200, body = StateMessage), NotFound))]
pub async fn state(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Json<StateMessage>, Problem> {
    let view = view(&server, &id)?;
    Ok(Json(StateMessage::from(&*view)))
}

/// The camera's last image.
#[utoipa::path(get, path = "/api/sessions/{id}/camera.png", tag = "sessions", params(SessionPath),
    responses((status = 200, description = "480 × 480 pixels.", content(("image/png"))), NotFound, Unavailable))]
pub async fn camera(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Response, Problem> {
    let view = view(&server, &id)?;
    let png = server.work(move |_| view.sight.1.frame.picture.to_png()).await?.map_err(Problem::internal)?;
    Ok(([(header::CONTENT_TYPE, "image/png")], png).into_response())
}

/// What the policy is shown of it.
#[utoipa::path(get, path = "/api/sessions/{id}/observation.png", tag = "sessions", params(SessionPath),
    responses((status = 200, description = "Both channels, 84 × 84 pixels each, side by side.", content(("image/png"))), NotFound, Unavailable))]
pub async fn observation(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Response, Problem> {
    let view = view(&server, &id)?;
    let drawn = server.work(move |_| view.sight.1.observation().side_by_side().to_png()).await?;
    let png = drawn.map_err(Problem::internal)?;
    Ok(([(header::CONTENT_TYPE, "image/png")], png).into_response())
}

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

/// A recording: Rerun's file, or the input log.
#[utoipa::path(get, path = "/api/recordings/{file}", tag = "recordings", params(RecordingPath),
    responses((status = 200, description = "What is written up to now.", content(("application/octet-stream"))), NotFound, Unavailable))]
pub async fn recording(
    State(server): State<Arc<Server>>,
    Path(RecordingPath { file: name }): Path<RecordingPath>,
) -> Result<Response, Problem> {
    // Only names that the list holds are opened, so that no client path touches the file system.
    let asked = name.clone();
    let found = server.work(move |server| server.recordings.file(&asked)).await?;
    let path = found.map_err(Problem::internal)?;
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
    Ok(find(server, id)?.session.watch().borrow().clone())
}

/// A session that somebody asks about, so that it is not parked.
pub fn find(server: &Server, id: &str) -> Result<Arc<Hub>, Problem> {
    let hub = server.sessions.find(id).ok_or_else(|| Problem::not_found("session", id))?;
    hub.touch();
    Ok(hub)
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
