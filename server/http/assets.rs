//! The page, embedded in the binary.

use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};

use super::problem::Problem;
use super::viewer;

#[derive(rust_embed::RustEmbed)]
#[folder = "$OUT_DIR/web"]
struct Page;

pub async fn page(method: Method, uri: Uri, headers: HeaderMap) -> Response {
    let path = uri.path();
    if path.starts_with("/api/") {
        return Problem::not_found("route", path).into_response();
    }
    if method != Method::GET && method != Method::HEAD {
        return Problem::new(StatusCode::METHOD_NOT_ALLOWED, "method_not_allowed", format!("{path} is read only"))
            .into_response();
    }
    let name = match path {
        "/" => "index.html",
        "/viewer/" => "viewer/index.html",
        path => path.trim_start_matches('/'),
    };
    let Some(file) = Page::get(name) else { return Problem::not_found("page", path).into_response() };
    let tag = format!(
        "\"{}\"",
        file.metadata.sha256_hash().iter().take(8).map(|byte| format!("{byte:02x}")).collect::<String>()
    );
    if headers.get(header::IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes()) {
        return StatusCode::NOT_MODIFIED.into_response();
    }
    // The bundler puts a hash into every name under assets/.
    let keep = if name.starts_with("assets/") { "public, max-age=31536000, immutable" } else { "no-cache" };
    let head = [
        (header::CONTENT_TYPE, file.metadata.mimetype().to_owned()),
        (header::CACHE_CONTROL, keep.to_owned()),
        (header::ETAG, tag),
    ];
    let mut response = (head, file.data).into_response();
    if name.starts_with("viewer/") {
        response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(viewer::POLICY));
    }
    response
}
