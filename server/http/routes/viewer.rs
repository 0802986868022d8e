//! Rerun's viewer, of the same version as the recorder: two files. The page that starts it is ours (`web/viewer`), because
//! Rerun's own page loads fonts from other servers.

use std::sync::Arc;

use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::Response;

use crate::http::Server;
use crate::http::path::{Path, ViewerPath};
use crate::http::problem::Problem;
use crate::http::refusals::NotFound;

const FILES: [&str; 2] = ["re_viewer.js", "re_viewer_bg.wasm"];

/// A file of Rerun's viewer.
#[utoipa::path(get, path = "/rerun/{file}", tag = "page", params(ViewerPath), operation_id = "viewer_file",
    responses((status = 200, description = "The file, compressed with gzip if the client accepts it.",
            content((String = "text/javascript"), ("application/wasm"))),
        (status = 304, description = "The file is the one that the browser has."), NotFound))]
pub async fn file(
    State(server): State<Arc<Server>>,
    Path(ViewerPath { file }): Path<ViewerPath>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    if !FILES.contains(&file.as_str()) {
        return Err(Problem::not_found("file of the viewer", &file));
    }
    // Forty megabytes may have to be unpacked.
    let sent = tokio::task::spawn_blocking(move || server.page.send(&format!("rerun/{file}"), &headers));
    sent.await.map_err(Problem::internal)
}
