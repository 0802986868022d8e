//! `/api/trainings`: policies that learn a map, in the background.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::lists;
use crate::http::path::{FramePath, OwnerQuery, Path, Query, TrainingPath};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use crate::protocol::{TrainingCells, TrainingFrame, TrainingReport, TrainingSummary, Trainings};
use ferry_lab::learn::{LibraryError, QueryError, SubmitTrainingError, Training, TrainingQuery};

/// The trainings: running, waiting, paused, and the last ended ones.
#[utoipa::path(get, path = "/api/trainings", tag = "trainings", operation_id = "trainings",
    responses((status = 200, body = Trainings)))]
pub async fn list(State(server): State<Arc<Server>>) -> Json<Trainings> {
    Json(Trainings { trainings: lists::trainings(&server) })
}

/// Starts a training or queues it.
#[utoipa::path(post, path = "/api/trainings", tag = "trainings", operation_id = "create_training",
    params(OwnerQuery), request_body = TrainingQuery,
    responses((status = 201, body = TrainingSummary, headers(("Location" = String, description = "Its path."))),
        Conflict, OutOfRange, TooMany, Unavailable))]
pub async fn create(
    State(server): State<Arc<Server>>,
    Query(owner): Query<OwnerQuery>,
    WholeBody(body): WholeBody,
) -> Result<Response, Problem> {
    let owner = owner.owner()?;
    let query: TrainingQuery = parse(&body)?;
    let training = server.work(move |server| server.trainings.submit(owner, query)).await??;
    let location = format!("/api/trainings/{}", training.id);
    let summary = Json(TrainingSummary::from(&*training));
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], summary).into_response())
}

/// A training with its curve.
#[utoipa::path(get, path = "/api/trainings/{id}", tag = "trainings", params(TrainingPath), operation_id = "training",
    responses((status = 200, body = TrainingReport), NotFound))]
pub async fn report(
    State(server): State<Arc<Server>>,
    Path(TrainingPath { id }): Path<TrainingPath>,
) -> Result<Json<TrainingReport>, Problem> {
    Ok(Json(TrainingReport::from(&*find(&server, &id)?)))
}

/// Cancels a training and deletes what it has learned, or removes one that has ended from the list; its policy stays.
#[utoipa::path(delete, path = "/api/trainings/{id}", tag = "trainings", params(TrainingPath),
    operation_id = "delete_training", responses((status = 202, body = TrainingSummary),
        (status = 204, description = "The training is removed from the list."), NotFound, Unavailable))]
pub async fn delete(
    State(server): State<Arc<Server>>,
    Path(TrainingPath { id }): Path<TrainingPath>,
) -> Result<Response, Problem> {
    let training = find(&server, &id)?;
    let cancelled = server.work(move |server| {
        let cancelled = training.cancel();
        if !cancelled {
            server.trainings.remove(&training);
        }
        cancelled.then(|| TrainingSummary::from(&*training))
    });
    Ok(match cancelled.await? {
        Some(summary) => (StatusCode::ACCEPTED, Json(summary)).into_response(),
        None => StatusCode::NO_CONTENT.into_response(),
    })
}

/// Pauses a training at the end of its present hundred updates; another job may run then.
#[utoipa::path(post, path = "/api/trainings/{id}/pause", tag = "trainings", params(TrainingPath),
    operation_id = "pause_training",
    responses((status = 202, body = TrainingSummary), NotFound, Conflict, Unavailable))]
pub async fn pause(
    State(server): State<Arc<Server>>,
    Path(TrainingPath { id }): Path<TrainingPath>,
) -> Result<Response, Problem> {
    let training = find(&server, &id)?;
    let pausing = training.clone();
    if !server.work(move |_| pausing.pause()).await? {
        let detail = format!("training {id:?} neither waits nor learns");
        return Err(Problem::new(StatusCode::CONFLICT, "not_running", detail));
    }
    Ok(accepted(&training))
}

/// Lets a paused or failed training go on, after the jobs that wait.
#[utoipa::path(post, path = "/api/trainings/{id}/resume", tag = "trainings", params(TrainingPath),
    operation_id = "resume_training",
    responses((status = 202, body = TrainingSummary), NotFound, Conflict, TooMany, Unavailable))]
pub async fn resume(
    State(server): State<Arc<Server>>,
    Path(TrainingPath { id }): Path<TrainingPath>,
) -> Result<Response, Problem> {
    let training = find(&server, &id)?;
    let resuming = training.clone();
    if !server.work(move |server| server.trainings.resume(&resuming)).await?? {
        let detail = format!("training {id:?} is not paused");
        return Err(Problem::new(StatusCode::CONFLICT, "not_paused", detail));
    }
    Ok(accepted(&training))
}

/// The cells of a training's map, in the order of its value maps.
#[utoipa::path(get, path = "/api/trainings/{id}/cells", tag = "trainings", params(TrainingPath),
    operation_id = "training_cells", responses((status = 200, body = TrainingCells), NotFound))]
pub async fn cells(
    State(server): State<Arc<Server>>,
    Path(TrainingPath { id }): Path<TrainingPath>,
) -> Result<Json<TrainingCells>, Problem> {
    let cells = find(&server, &id)?.status().cells.ok_or_else(|| {
        let detail = format!("training {id:?} has no images of its map yet");
        Problem::new(StatusCode::NOT_FOUND, "not_ready", detail)
    })?;
    Ok(Json(TrainingCells::from(&*cells)))
}

/// A value map of a training.
#[utoipa::path(get, path = "/api/trainings/{id}/frames/{index}", tag = "trainings", params(FramePath),
    operation_id = "training_frame", responses((status = 200, body = TrainingFrame), NotFound))]
pub async fn frame(
    State(server): State<Arc<Server>>,
    Path(FramePath { id, index }): Path<FramePath>,
) -> Result<Json<TrainingFrame>, Problem> {
    let status = find(&server, &id)?.status();
    let frame = status.frames.get(index).ok_or_else(|| Problem::not_found("value map", &index.to_string()))?;
    Ok(Json(TrainingFrame::from(&**frame)))
}

fn accepted(training: &Training) -> Response {
    (StatusCode::ACCEPTED, Json(TrainingSummary::from(training))).into_response()
}

fn find(server: &Server, id: &str) -> Result<Arc<Training>, Problem> {
    server.trainings.find(id).ok_or_else(|| Problem::not_found("training", id))
}

impl From<SubmitTrainingError> for Problem {
    fn from(error: SubmitTrainingError) -> Self {
        let detail = error.to_string();
        match error {
            SubmitTrainingError::Query(query) => {
                let (status, code) = match &query {
                    QueryError::Taken { .. } | QueryError::Name(LibraryError::Taken { .. }) => {
                        (StatusCode::CONFLICT, "taken")
                    }
                    QueryError::Name(LibraryError::TooMany) => (StatusCode::TOO_MANY_REQUESTS, "too_many_policies"),
                    QueryError::Map(_) | QueryError::Terrain(_) | QueryError::TooLarge { .. } => {
                        (StatusCode::UNPROCESSABLE_ENTITY, "map_refused")
                    }
                    QueryError::Start(_) | QueryError::Memory { .. } => {
                        (StatusCode::UNPROCESSABLE_ENTITY, "policy_refused")
                    }
                    QueryError::Name(_) | QueryError::Recipe(_) | QueryError::Goal { .. } => {
                        (StatusCode::UNPROCESSABLE_ENTITY, "out_of_range")
                    }
                    QueryError::Training(_) => (StatusCode::INTERNAL_SERVER_ERROR, "internal"),
                };
                Self::new(status, code, detail).field(&query.field())
            }
            SubmitTrainingError::Queue(error) => error.into(),
            SubmitTrainingError::Io(_) => Self::new(StatusCode::INSUFFICIENT_STORAGE, "not_kept", detail),
        }
    }
}
