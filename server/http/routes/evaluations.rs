//! `/api/evaluations`: evaluations in the background.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::http::Server;
use crate::http::body::{WholeBody, attachment, parse};
use crate::http::lists;
use crate::http::path::{EvaluationPath, OwnerQuery, Path, Query, ReportPath};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use crate::protocol::{EvaluationReport, EvaluationSummary, Evaluations};
use ferry_lab::evaluate::{Evaluation, EvaluationQuery, QueryError, Report, SubmitError};
use ferry_lab::jobs::QueueError;

/// The evaluations: running, waiting, and the last ended ones.
#[utoipa::path(get, path = "/api/evaluations", tag = "evaluations", operation_id = "evaluations",
    responses((status = 200, body = Evaluations)))]
pub async fn list(State(server): State<Arc<Server>>) -> Json<Evaluations> {
    Json(Evaluations { evaluations: lists::evaluations(&server) })
}

/// Starts an evaluation or queues it.
#[utoipa::path(post, path = "/api/evaluations", tag = "evaluations", operation_id = "create_evaluation",
    params(OwnerQuery), request_body = EvaluationQuery,
    responses((status = 201, body = EvaluationSummary, headers(("Location" = String, description = "Its path."))),
        OutOfRange, TooMany, Unavailable))]
pub async fn create(
    State(server): State<Arc<Server>>,
    Query(owner): Query<OwnerQuery>,
    WholeBody(body): WholeBody,
) -> Result<Response, Problem> {
    let owner = owner.owner()?;
    let query: EvaluationQuery = parse(&body)?;
    let program = query.program.as_deref().and_then(|name| server.programs.find(name));
    // Reading the maps blocks.
    let submit = move |server: &Arc<Server>| server.evaluations.submit(owner, query, &server.catalog, program);
    let evaluation = server.work(submit).await??;
    let location = format!("/api/evaluations/{}", evaluation.id);
    let summary = Json(EvaluationSummary::from(&*evaluation));
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], summary).into_response())
}

/// An evaluation with its rows and failures so far.
#[utoipa::path(get, path = "/api/evaluations/{id}", tag = "evaluations", params(EvaluationPath), operation_id = "evaluation",
    responses((status = 200, body = EvaluationReport), NotFound))]
pub async fn report(
    State(server): State<Arc<Server>>,
    Path(EvaluationPath { id }): Path<EvaluationPath>,
) -> Result<Json<EvaluationReport>, Problem> {
    Ok(Json(EvaluationReport::from(&*find(&server, &id)?)))
}

/// The report as a file, as `ferry evaluate` writes it.
#[utoipa::path(get, path = "/api/evaluations/{id}/{file}", tag = "evaluations", params(ReportPath),
    operation_id = "evaluation_file",
    responses((status = 200, description = "The report.", content((String = "text/html"), (String = "text/csv"),
        (Report = "application/json"))), NotFound, Unavailable))]
pub async fn file(
    State(server): State<Arc<Server>>,
    Path(ReportPath { id, file: name }): Path<ReportPath>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let evaluation = find(&server, &id)?;
    // The link uses the address of this request.
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    let address = server.access.address_of(host);
    let file_name = format!("{id}-{name}");
    let (kind, text) = server.work(move |server| written(server, &evaluation, &name, &address)).await??;
    Ok(attachment(kind, &file_name, text))
}

/// A report in one of its formats, with figures and experiment links.
fn written(
    server: &Server,
    evaluation: &Evaluation,
    name: &str,
    address: &str,
) -> Result<(&'static str, String), Problem> {
    let progress = evaluation.life.read(|_, progress| progress.clone());
    let report = Report::of(server.gpu.adapter_name(), evaluation.query.seed, &progress.done(&evaluation.cells));
    Ok(match name {
        "report.html" => ("text/html; charset=utf-8", report.to_html(address)),
        "report.csv" => ("text/csv; charset=utf-8", report.to_csv().map_err(Problem::internal)?),
        "report.json" => ("application/json", serde_json::to_string(&report).map_err(Problem::internal)?),
        _ => return Err(Problem::not_found("report", name)),
    })
}

/// Cancels an evaluation; its results so far are kept.
#[utoipa::path(delete, path = "/api/evaluations/{id}", tag = "evaluations", params(EvaluationPath),
    operation_id = "cancel_evaluation", responses((status = 202, body = EvaluationSummary), NotFound, Conflict))]
pub async fn cancel(
    State(server): State<Arc<Server>>,
    Path(EvaluationPath { id }): Path<EvaluationPath>,
) -> Result<Response, Problem> {
    let evaluation = find(&server, &id)?;
    if !evaluation.life.cancel() {
        return Err(Problem::already_ended("evaluation", &id));
    }
    // Its trials stop at their next tick.
    Ok((StatusCode::ACCEPTED, Json(EvaluationSummary::from(&*evaluation))).into_response())
}

fn find(server: &Server, id: &str) -> Result<Arc<Evaluation>, Problem> {
    server.evaluations.find(id).ok_or_else(|| Problem::not_found("evaluation", id))
}

impl From<SubmitError> for Problem {
    fn from(error: SubmitError) -> Self {
        let detail = error.to_string();
        match error {
            SubmitError::Query(query) => {
                let code = match query {
                    QueryError::Map { .. } => "map_refused",
                    QueryError::Policy(_) => "unknown_policy",
                    QueryError::TooManyCells { .. } | QueryError::TooManyTrials { .. } => "too_many",
                    QueryError::Program { .. } => "no_program",
                    QueryError::Person { .. }
                    | QueryError::Empty { .. }
                    | QueryError::Twice { .. }
                    | QueryError::Vary(_)
                    | QueryError::Range { .. }
                    | QueryError::Number(_) => "out_of_range",
                };
                Self::new(StatusCode::UNPROCESSABLE_ENTITY, code, detail).field(&query.field())
            }
            SubmitError::Queue(error) => error.into(),
        }
    }
}

impl From<QueueError> for Problem {
    fn from(error: QueueError) -> Self {
        let detail = error.to_string();
        match error {
            QueueError::Full { .. } | QueueError::Paused { .. } => {
                Self::new(StatusCode::TOO_MANY_REQUESTS, "too_many_jobs", detail)
            }
            QueueError::Closing => Self::new(StatusCode::SERVICE_UNAVAILABLE, "stopping", detail),
        }
    }
}
