//! `GET /api/openapi.json`.

use std::sync::LazyLock;

use axum::http::header;
use axum::response::IntoResponse;

use crate::http::openapi::text;

pub static DOCUMENT: LazyLock<String> = LazyLock::new(|| text(super::described().into_openapi()));

/// This description.
#[utoipa::path(get, path = "/api/openapi.json", tag = "server", operation_id = "openapi",
    responses((status = 200, description = "OpenAPI 3.1", content_type = "application/json", body = Object)))]
pub async fn openapi() -> impl IntoResponse {
    ([(header::CONTENT_TYPE, "application/json")], DOCUMENT.as_str())
}
