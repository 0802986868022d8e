//! `/api/evaluations`: the paper's experiment in the background.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::Server;
use super::api::{attachment, parse};
use super::body::WholeBody;
use super::problem::Problem;
use crate::evaluate::{Evaluation, EvaluationQuery, QueryError, Report, SubmitError};
use crate::protocol::{EvaluationReport, EvaluationSummary, Evaluations};

/// `GET /api/evaluations`: what runs, waits, and ended last.
pub async fn list(State(server): State<Arc<Server>>) -> Json<Evaluations> {
    let all = server.evaluations.all();
    Json(Evaluations { evaluations: all.iter().map(|evaluation| EvaluationSummary::from(&**evaluation)).collect() })
}

/// `POST /api/evaluations`: begins one, or lets it wait.
pub async fn create(State(server): State<Arc<Server>>, WholeBody(body): WholeBody) -> Result<Response, Problem> {
    let query: EvaluationQuery = parse(&body)?;
    // Reading the maps that it names blocks.
    let submitting = tokio::task::spawn_blocking(move || server.evaluations.submit(query));
    let evaluation = submitting.await.map_err(Problem::internal)??;
    let location = format!("/api/evaluations/{}", evaluation.id);
    let summary = Json(EvaluationSummary::from(&*evaluation));
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], summary).into_response())
}

/// `GET /api/evaluations/{id}`: its rows and failures up to now.
pub async fn report(
    State(server): State<Arc<Server>>,
    Path(id): Path<String>,
) -> Result<Json<EvaluationReport>, Problem> {
    Ok(Json(EvaluationReport::from(&*find(&server, &id)?)))
}

/// `GET /api/evaluations/{id}/report.html`, `.csv` and `.json`: the same as files, as `ferry evaluate` writes them.
pub async fn file(
    State(server): State<Arc<Server>>,
    Path((id, name)): Path<(String, String)>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let evaluation = find(&server, &id)?;
    let progress = evaluation.progress();
    let report = Report::of(server.gpu.adapter_name(), evaluation.query.seed, &progress.done(&evaluation.cells));
    // Whoever reads it came by this address.
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    let (kind, text) = match name.as_str() {
        "report.html" => ("text/html; charset=utf-8", report.to_html(&format!("http://{host}"))),
        "report.csv" => ("text/csv; charset=utf-8", report.to_csv().map_err(Problem::internal)?),
        "report.json" => ("application/json", serde_json::to_string(&report).map_err(Problem::internal)?),
        _ => return Err(Problem::not_found("report", &name)),
    };
    Ok(attachment(kind, &format!("{id}-{name}"), text))
}

/// `DELETE /api/evaluations/{id}`: breaks it off; what it came to stays.
pub async fn cancel(State(server): State<Arc<Server>>, Path(id): Path<String>) -> Result<Response, Problem> {
    let evaluation = find(&server, &id)?;
    if !evaluation.cancel() {
        let detail = format!("evaluation {id:?} has ended already");
        return Err(Problem::new(StatusCode::CONFLICT, "already_ended", detail));
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
                    QueryError::TooManyCells { .. } => "too_many",
                    QueryError::Empty { .. } | QueryError::Twice { .. } | QueryError::Range { .. } => "out_of_range",
                };
                Self::new(StatusCode::UNPROCESSABLE_ENTITY, code, detail).field(&query.field())
            }
            SubmitError::Full => Self::new(StatusCode::TOO_MANY_REQUESTS, "too_many_evaluations", detail),
            SubmitError::Closing => Self::new(StatusCode::SERVICE_UNAVAILABLE, "stopping", detail),
        }
    }
}
