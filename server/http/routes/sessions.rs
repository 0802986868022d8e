//! Sessions and their current state.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::live::Hub;
use crate::http::path::{Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use crate::http::sessions::MAIN;
use crate::http::visitors::Visitor;
use crate::protocol::StateMessage;
use crate::session::{EndFact, View};
use ferry_core::facts::Told;
use ferry_core::scenario::{ControllerName, Scenario};
use ferry_core::trial::RecordingFact;

/// Summary of a session.
#[derive(Serialize, ToSchema)]
pub struct SessionSummary {
    id: String,
    map: String,
    /// Sub-controller 2 in use.
    controller: ControllerName,
    /// Ticks since the start of the trial.
    tick: u64,
    /// Whether the session is running.
    running: bool,
    /// Whether everything is recorded, or why not.
    recording: Told<RecordingFact>,
    /// Number of connected browsers.
    viewers: usize,
    /// Paused because it had no viewers for long.
    parked: bool,
    /// Why it ended, if it has.
    ended: Option<Told<EndFact>>,
}

impl SessionSummary {
    fn of(hub: &Hub, view: &View) -> Self {
        Self {
            id: hub.id.clone(),
            map: view.scenery.arena.map.name().to_owned(),
            controller: view.moment.controller,
            tick: view.moment.tick,
            running: view.running,
            recording: view.recording.clone().into(),
            viewers: hub.viewers(),
            parked: hub.is_parked(),
            ended: view.ended.clone().map(Told::from),
        }
    }
}

#[derive(Serialize, ToSchema)]
pub struct Sessions {
    sessions: Vec<SessionSummary>,
}

/// The sessions.
#[utoipa::path(get, path = "/api/sessions", tag = "sessions", responses((status = 200, body = Sessions)))]
pub async fn sessions(State(server): State<Arc<Server>>) -> Json<Sessions> {
    let hubs = server.sessions.all();
    let sessions = hubs.iter().map(|hub| SessionSummary::of(hub, &hub.session.watch().borrow())).collect();
    Json(Sessions { sessions })
}

/// Body of `POST /api/sessions`; all fields are optional.
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

/// Creates a session.
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

/// Opens a session of the visitor's own, which ends two minutes after its last operator has left. What was done in it is
/// saved: the session goes on when it is opened again. The cookie remembers it.
#[utoipa::path(post, path = "/api/own-sessions", tag = "sessions",
    responses((status = 201, body = SessionSummary, headers(("Location" = String, description = "The path of its page."))), TooMany))]
pub async fn open_own(State(server): State<Arc<Server>>, headers: HeaderMap) -> Result<Response, Problem> {
    let visitor = server.visitors.meet(&headers).map_err(Problem::internal)?;
    let hub = server.sessions.open_own(visitor.id.clone()).await?;
    let location = format!("{}/s/{}", server.base, hub.id);
    let summary = SessionSummary::of(&hub, &hub.session.watch().borrow());
    let mut response = (StatusCode::CREATED, [(header::LOCATION, location)], Json(summary)).into_response();
    server.remember(&Visitor { own: Some(hub.id.clone()), ..visitor }, &headers, &mut response);
    Ok(response)
}

/// Summary of a session.
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

/// Ends a session and its recording, and deletes what was saved of it. The recording stays.
#[utoipa::path(delete, path = "/api/sessions/{id}", tag = "sessions", params(SessionPath),
    responses((status = 204, description = "It has ended."), NotFound, Conflict))]
pub async fn delete_session(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<StatusCode, Problem> {
    if id == MAIN {
        return Err(Problem::new(StatusCode::CONFLICT, "main_session", "the session main cannot be closed"));
    }
    match server.sessions.discard(&id).await {
        true => Ok(StatusCode::NO_CONTENT),
        false => Err(Problem::not_found("session", &id)),
    }
}

/// The current state of a session.
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

/// The policy's current observation.
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

pub fn view(server: &Server, id: &str) -> Result<Arc<View>, Problem> {
    Ok(find(server, id)?.session.watch().borrow().clone())
}

/// A requested session; the request keeps it from being parked.
pub fn find(server: &Server, id: &str) -> Result<Arc<Hub>, Problem> {
    let hub = server.sessions.find(id).ok_or_else(|| Problem::not_found("session", id))?;
    hub.touch();
    Ok(hub)
}
