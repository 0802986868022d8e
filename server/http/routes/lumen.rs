//! The lumen of a session's map.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;

use super::sessions::view;
use crate::http::Server;
use crate::http::path::{Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::NotFound;
use crate::protocol::Lumen;

/// The walls' outline with the coordinate along the lumen.
#[utoipa::path(get, path = "/api/sessions/{id}/lumen", tag = "sessions", params(SessionPath),
    responses((status = 200, body = Lumen), NotFound))]
pub async fn lumen(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Json<Lumen>, Problem> {
    let arena = view(&server, &id)?.scenery.arena.clone();
    let lumen = server.work(move |_| Lumen::of(arena.map.name(), arena.lumen()));
    Ok(Json(lumen.await?))
}
