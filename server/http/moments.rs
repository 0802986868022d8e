//! Moments of a session that are still held: what was seen and decided at a control step.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Path, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::Server;
use super::api::attachment;
use super::problem::Problem;
use crate::image::EncodeError;
use crate::protocol::MomentMessage;
use crate::session::{CommandError, Past};
use crate::trial::{Moment, TickRecord, TrialError};

/// The moment, lived through again beside the session.
async fn relive(server: &Arc<Server>, id: &str, tick: u64) -> Result<(Past, Moment, TickRecord), Problem> {
    let hub = server.find(id).ok_or_else(|| Problem::not_found("session", id))?;
    let past = hub.session.recall(tick).await.map_err(|error| problem(&error))?;
    let gpu = server.gpu.clone();
    let relived = tokio::task::spawn_blocking(move || {
        let mut camera = past.camera(&gpu)?;
        let (before, record) = past.relive(&mut camera)?;
        Ok::<_, TrialError>((past, before, record))
    });
    relived.await.map_err(Problem::internal)?.map_err(Problem::internal)
}

/// A moment that is not held is not there; the rest is as for a command.
fn problem(error: &CommandError) -> Problem {
    match error {
        CommandError::Range { field, .. } => {
            Problem::new(StatusCode::NOT_FOUND, "not_held", error.to_string()).field(field)
        }
        error => Problem::from(error),
    }
}

fn no_step(tick: u64) -> Problem {
    Problem::new(StatusCode::NOT_FOUND, "no_control_step", format!("no control step starts at tick {tick}"))
        .field("tick")
}

/// `GET /api/sessions/{id}/moments/{tick}`.
pub async fn moment(
    State(server): State<Arc<Server>>,
    Path((id, tick)): Path<(String, u64)>,
) -> Result<Json<MomentMessage>, Problem> {
    let (past, before, record) = relive(&server, &id, tick).await?;
    MomentMessage::of(&past, &before, &record).map(Json).ok_or_else(|| no_step(tick))
}

/// `GET /api/sessions/{id}/moments/{tick}/camera.png`.
pub async fn camera(
    State(server): State<Arc<Server>>,
    Path((id, tick)): Path<(String, u64)>,
) -> Result<Response, Problem> {
    let (_, _, record) = relive(&server, &id, tick).await?;
    let sight = record.sight.ok_or_else(|| no_step(tick))?;
    png(sight.frame.picture.to_png())
}

/// `GET /api/sessions/{id}/moments/{tick}/observation.png`.
pub async fn observation(
    State(server): State<Arc<Server>>,
    Path((id, tick)): Path<(String, u64)>,
) -> Result<Response, Problem> {
    let (_, _, record) = relive(&server, &id, tick).await?;
    let sight = record.sight.ok_or_else(|| no_step(tick))?;
    png(sight.observation().side_by_side().to_png())
}

/// `GET /api/sessions/{id}/case.json`: the trial with all that it was told, to be kept among `tests/cases`.
pub async fn case(State(server): State<Arc<Server>>, Path(id): Path<String>) -> Result<Response, Problem> {
    let hub = server.find(&id).ok_or_else(|| Problem::not_found("session", &id))?;
    let case = hub.session.case().await.map_err(|error| Problem::from(&error))?;
    let name = format!("{}-{}-seed-{}.json", case.scenario.map, case.scenario.controller.as_str(), case.scenario.seed);
    let text = serde_json::to_string_pretty(&case).map_err(Problem::internal)? + "\n";
    Ok(attachment("application/json", &name, text))
}

fn png(encoded: Result<Vec<u8>, EncodeError>) -> Result<Response, Problem> {
    Ok(([(header::CONTENT_TYPE, "image/png")], encoded.map_err(Problem::internal)?).into_response())
}
