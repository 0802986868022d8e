//! `/api/recoveries`: recovery maps in the background.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::sessions::find as find_session;
use crate::http::Server;
use crate::http::body::{WholeBody, attachment, parse};
use crate::http::lists;
use crate::http::path::{CellPath, Path, RecoveryFilePath, RecoveryPath, TryPath};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use crate::http::sessions::MAIN;
use crate::protocol::{Recoveries, RecoveryQuery, RecoveryReport, RecoverySummary, RecoveryTrials};
use ferry_core::scenario::{Scenario, Shipped};
use ferry_core::session::Recalled;
use ferry_core::trial::{Case, Origin, Timed, Trial, TrialError};
use ferry_lab::recovery::{RecoveryJob, Report, Start, SubmitRecoveryError};

/// The recovery maps: running, waiting, and the last ended ones.
#[utoipa::path(get, path = "/api/recoveries", tag = "recoveries", operation_id = "recoveries",
    responses((status = 200, body = Recoveries)))]
pub async fn list(State(server): State<Arc<Server>>) -> Json<Recoveries> {
    Json(Recoveries { recoveries: lists::recoveries(&server) })
}

/// Starts a recovery map or queues it.
#[utoipa::path(post, path = "/api/recoveries", tag = "recoveries", operation_id = "create_recovery",
    request_body = RecoveryQuery,
    responses((status = 202, body = RecoverySummary, headers(("Location" = String, description = "Its path."))),
        NotFound, OutOfRange, TooMany, Unavailable))]
pub async fn create(State(server): State<Arc<Server>>, WholeBody(body): WholeBody) -> Result<Response, Problem> {
    let query: RecoveryQuery = parse(&body)?;
    let (session, start) = start(&server, &query).await?;
    // Making the grid blocks.
    let owner = query.session.clone();
    let job = server.work(move |server| server.recoveries.submit(owner, session, query.into(), start)).await??;
    let location = format!("/api/recoveries/{}", job.id);
    Ok((StatusCode::ACCEPTED, [(header::LOCATION, location)], Json(RecoverySummary::from(&*job))).into_response())
}

/// The moment of a query, and the session and trial to which it belongs.
async fn start(server: &Arc<Server>, query: &RecoveryQuery) -> Result<(Option<(String, u64)>, Start), Problem> {
    let sources =
        [("session", query.session.is_some()), ("scenario", query.scenario.is_some()), ("map", query.map.is_some())];
    let given: Vec<&str> = sources.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name).collect();
    if let [first, second, ..] = given[..] {
        let detail = format!("{second} is given, but {first} too: the moment is one of them");
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", detail).field(second));
    }
    let scenario = match (&query.scenario, &query.map) {
        (Some(name), _) => Some(Shipped::open(name).map_err(|error| unknown("scenario", &error))?.scenario),
        (None, Some(name)) => {
            let arena = server.catalog.arena(name).map_err(|error| unknown("map", &error))?;
            let first = query.controllers.first().copied().unwrap_or(Scenario::idle(name, 0).controller);
            let random = arena.random(name, first, 0, query.seed, 0);
            Some(random.map_err(|error| unknown("map", &error))?)
        }
        (None, None) => None,
    };
    if let Some(scenario) = scenario {
        if query.tick.is_some() {
            let detail = "tick is given, but no session";
            return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", detail).field("tick"));
        }
        let set_up = move |server: &Arc<Server>| -> Result<Origin, TrialError> {
            let arena = server.catalog.arena(&scenario.map)?;
            Ok(Origin::of(&Trial::new(scenario, arena)?))
        };
        let origin = server.work(set_up).await?.map_err(|error| unknown("scenario", &error))?;
        return Ok((None, Start { origin, told: Some(Vec::new()), program: None }));
    }
    let id = query.session.as_deref().unwrap_or(MAIN);
    let hub = find_session(server, id)?;
    let (now, trial) = {
        let view = hub.session.watch().borrow().clone();
        (view.moment.tick, view.scenery.trial)
    };
    let point = hub.session.recall(query.tick.unwrap_or(now), Recalled::Present).await;
    let point = point.map_err(|error| Problem::from(&error))?;
    let timed = |(tick, input)| Timed { tick, input };
    let start = Start {
        program: point.program().cloned(),
        told: point.point.told.map(|told| told.into_iter().map(timed).collect()),
        origin: point.point.origin,
    };
    Ok((Some((id.to_owned(), trial)), start))
}

fn unknown(field: &str, error: &dyn std::error::Error) -> Problem {
    Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "map_refused", error.to_string()).field(field)
}

/// A recovery map with its cells so far.
#[utoipa::path(get, path = "/api/recoveries/{id}", tag = "recoveries", params(RecoveryPath), operation_id = "recovery",
    responses((status = 200, body = RecoveryReport), NotFound))]
pub async fn report(
    State(server): State<Arc<Server>>,
    Path(RecoveryPath { id }): Path<RecoveryPath>,
) -> Result<Json<RecoveryReport>, Problem> {
    Ok(Json(RecoveryReport::from(&*find(&server, &id)?)))
}

/// The map as a file, as `ferry recovery` writes it.
#[utoipa::path(get, path = "/api/recoveries/{id}/{file}", tag = "recoveries", params(RecoveryFilePath),
    operation_id = "recovery_file",
    responses((status = 200, description = "The map.", content((String = "text/html"), (String = "text/csv"))),
        NotFound, Unavailable))]
pub async fn file(
    State(server): State<Arc<Server>>,
    Path(RecoveryFilePath { id, file: name }): Path<RecoveryFilePath>,
) -> Result<Response, Problem> {
    let job = find(&server, &id)?;
    let file_name = format!("{id}-{name}");
    let (kind, text) = server.work(move |server| written(server, &job, &name)).await??;
    Ok(attachment(kind, &file_name, text))
}

fn written(server: &Server, job: &RecoveryJob, name: &str) -> Result<(&'static str, String), Problem> {
    let adapter = server.gpu.adapter_name();
    let subject = job.recovery.subject().map_err(Problem::internal)?;
    let report = job.life.read(|_, findings| Report::of(&subject, adapter, findings));
    match name {
        "map.html" => Ok(("text/html; charset=utf-8", report.to_html(&job.recovery.start.origin.arena.map))),
        "map.csv" => Ok(("text/csv; charset=utf-8", report.to_csv().map_err(Problem::internal)?)),
        _ => Err(Problem::not_found("file", name)),
    }
}

/// The trials of a cell.
#[utoipa::path(get, path = "/api/recoveries/{id}/cells/{cell}", tag = "recoveries", params(CellPath),
    operation_id = "recovery_trials", responses((status = 200, body = RecoveryTrials), NotFound))]
pub async fn tries(
    State(server): State<Arc<Server>>,
    Path(CellPath { id, cell }): Path<CellPath>,
) -> Result<Json<RecoveryTrials>, Problem> {
    let trials = RecoveryTrials::of(&*find(&server, &id)?, cell);
    trials.map(Json).ok_or_else(|| Problem::not_found("cell", &cell.to_string()))
}

/// A trial as a test case for `tests/cases`, which expects a delivery in time.
#[utoipa::path(get, path = "/api/recoveries/{id}/cells/{cell}/{controller}/{repeat}/case.json", tag = "recoveries",
    params(TryPath), operation_id = "recovery_case", responses((status = 200, body = Case), NotFound, Conflict))]
pub async fn case(
    State(server): State<Arc<Server>>,
    Path(TryPath { id, cell, controller, repeat }): Path<TryPath>,
) -> Result<Response, Problem> {
    let name = format!("{id}-cell-{cell}-{}-{repeat}.json", controller.as_str());
    let case = find(&server, &id)?.case(cell, controller, repeat).ok_or_else(|| Problem::not_found("trial", &name))?;
    let forgotten = "the start of the session's trial was no longer kept at the moment, so a case cannot lead to it";
    let case = case.ok_or_else(|| Problem::new(StatusCode::CONFLICT, "forgotten", forgotten))?;
    let text = serde_json::to_string_pretty(&case).map_err(Problem::internal)? + "\n";
    Ok(attachment("application/json", &name, text))
}

/// Cancels a recovery map; its cells so far are kept.
#[utoipa::path(delete, path = "/api/recoveries/{id}", tag = "recoveries", params(RecoveryPath),
    operation_id = "cancel_recovery", responses((status = 202, body = RecoverySummary), NotFound, Conflict))]
pub async fn cancel(
    State(server): State<Arc<Server>>,
    Path(RecoveryPath { id }): Path<RecoveryPath>,
) -> Result<Response, Problem> {
    let job = find(&server, &id)?;
    if !job.life.cancel() {
        return Err(Problem::already_ended("recovery map", &id));
    }
    // Its trials stop at their next tick.
    Ok((StatusCode::ACCEPTED, Json(RecoverySummary::from(&*job))).into_response())
}

fn find(server: &Server, id: &str) -> Result<Arc<RecoveryJob>, Problem> {
    server.recoveries.find(id).ok_or_else(|| Problem::not_found("recovery map", id))
}

impl From<SubmitRecoveryError> for Problem {
    fn from(error: SubmitRecoveryError) -> Self {
        match error {
            SubmitRecoveryError::Query(query) => {
                let detail = query.to_string();
                Self::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", detail).field(&query.field())
            }
            SubmitRecoveryError::Queue(error) => error.into(),
        }
    }
}
