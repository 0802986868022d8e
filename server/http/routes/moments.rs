//! Kept moments of a session: observation and decision of a control step.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::sessions::find;
use crate::http::Server;
use crate::http::body::attachment;
use crate::http::path::{MomentPath, Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, OutOfRange, Unavailable};
use crate::protocol::MomentMessage;
use crate::session::CommandError;
use ferry_camera::Camera;
use ferry_core::image::EncodeError;
use ferry_core::session::{self, BranchPoint, Recalled};
use ferry_core::trial::{Case, Moment, TickRecord, TrialError};

/// Repeats the moment beside the session.
async fn relive(server: &Arc<Server>, id: &str, tick: u64) -> Result<(BranchPoint, Moment, TickRecord), Problem> {
    let point = find(server, id)?.session.recall(tick, Recalled::Step).await.map_err(|error| problem(&error))?.point;
    let relived = server.work(move |server| {
        let mut camera = Camera::of(&server.gpu, point.arena().static_scene())?;
        let (before, record) = point.relive(&mut camera)?;
        Ok::<_, TrialError>((point, before, record))
    });
    relived.await?.map_err(Problem::internal)
}

/// A moment that is no longer kept is not found; other errors are those of commands.
fn problem(error: &CommandError) -> Problem {
    match error {
        CommandError::Session(session::CommandError::Range { field, .. }) => {
            Problem::new(StatusCode::NOT_FOUND, "not_held", error.to_string()).field(field)
        }
        error => Problem::from(error),
    }
}

fn no_step(tick: u64) -> Problem {
    Problem::new(StatusCode::NOT_FOUND, "no_control_step", format!("no control step starts at tick {tick}"))
        .field("tick")
}

/// A repeated control step: observation, switching and decision.
#[utoipa::path(get, path = "/api/sessions/{id}/moments/{tick}", tag = "sessions", params(MomentPath),
    responses((status = 200, body = MomentMessage), NotFound, Unavailable))]
pub async fn moment(
    State(server): State<Arc<Server>>,
    Path(MomentPath { id, tick }): Path<MomentPath>,
) -> Result<Json<MomentMessage>, Problem> {
    let (point, before, record) = relive(&server, &id, tick).await?;
    MomentMessage::of(&point, &before, &record).map(Json).ok_or_else(|| no_step(tick))
}

/// The camera's image at a control step.
#[utoipa::path(get, path = "/api/sessions/{id}/moments/{tick}/camera.png", tag = "sessions", params(MomentPath),
    operation_id = "moment_camera",
    responses((status = 200, description = "480 × 480 pixels.", content(("image/png"))), NotFound,
        Unavailable))]
pub async fn camera(
    State(server): State<Arc<Server>>,
    Path(MomentPath { id, tick }): Path<MomentPath>,
) -> Result<Response, Problem> {
    let (_, _, record) = relive(&server, &id, tick).await?;
    let sight = record.sight.ok_or_else(|| no_step(tick))?;
    png(server.work(move |_| sight.frame.picture.to_png()).await?)
}

/// The policy's observation at a control step.
#[utoipa::path(get, path = "/api/sessions/{id}/moments/{tick}/observation.png", tag = "sessions", params(MomentPath),
    operation_id = "moment_observation",
    responses((status = 200, description = "Both channels, 84 × 84 pixels each, side by side.", content(("image/png"))), NotFound, Unavailable))]
pub async fn observation(
    State(server): State<Arc<Server>>,
    Path(MomentPath { id, tick }): Path<MomentPath>,
) -> Result<Response, Problem> {
    let (_, _, record) = relive(&server, &id, tick).await?;
    let sight = record.sight.ok_or_else(|| no_step(tick))?;
    png(server.work(move |_| sight.observation().side_by_side().to_png()).await?)
}

/// The trial with all its inputs as a test case for `tests/cases`.
#[utoipa::path(get, path = "/api/sessions/{id}/case.json", tag = "sessions", params(SessionPath),
    responses((status = 200, body = Case), NotFound, OutOfRange, Unavailable))]
pub async fn case(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Response, Problem> {
    let case = find(&server, &id)?.session.case().await.map_err(|error| Problem::from(&error))?;
    let name = format!("{}-{}-seed-{}.json", case.scenario.map, case.scenario.controller.as_str(), case.scenario.seed);
    let text = serde_json::to_string_pretty(&case).map_err(Problem::internal)? + "\n";
    Ok(attachment("application/json", &name, text))
}

fn png(encoded: Result<Vec<u8>, EncodeError>) -> Result<Response, Problem> {
    Ok(([(header::CONTENT_TYPE, "image/png")], encoded.map_err(Problem::internal)?).into_response())
}
