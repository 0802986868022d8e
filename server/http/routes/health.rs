//! `GET /healthz`.

use std::sync::Arc;

use axum::extract::State;
use axum::http::StatusCode;

use crate::http::Server;
use crate::http::problem::Problem;
use crate::http::refusals::Unavailable;

/// Whether the server is running and not stopping.
#[utoipa::path(get, path = "/healthz", tag = "server",
    responses((status = 200, description = "It does.", content_type = "text/plain", body = String), Unavailable))]
pub async fn health(State(server): State<Arc<Server>>) -> Result<&'static str, Problem> {
    if *server.stopping.borrow() {
        return Err(Problem::new(StatusCode::SERVICE_UNAVAILABLE, "stopping", "the server is stopping"));
    }
    Ok("ok\n")
}
