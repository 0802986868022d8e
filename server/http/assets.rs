//! The page, embedded in the binary.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};

use super::Server;
use super::problem::Problem;
use super::sessions::{DEMO, MAIN};
use super::site::comes_from_another_site;

/// Content security policy of the viewer's page: it may compile WebAssembly, and our own page may frame it.
const VIEWER_POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' blob: data:; \
                          frame-ancestors 'self'; base-uri 'none'; form-action 'none'";

#[derive(rust_embed::RustEmbed)]
#[folder = "$OUT_DIR/web"]
struct Page;

/// `GET /`: the page with the session `main`. The session is restarted if a fault has ended it.
pub async fn main_session(State(server): State<Arc<Server>>, headers: HeaderMap) -> Result<Response, Problem> {
    server.sessions.open(MAIN).await?;
    Ok(send("index.html", &headers))
}

/// `GET /s/{name}`: the page with the session of that name. The session is created if it does not exist.
pub async fn named_session(
    State(server): State<Arc<Server>>,
    Path(name): Path<String>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    if server.sessions.find(&name).is_none() && comes_from_another_site(&headers) {
        let detail = format!(
            "session {name:?} is not open, and a link from another site does not open one: enter this address yourself"
        );
        return Err(Problem::new(StatusCode::FORBIDDEN, "foreign_site", detail).field("Sec-Fetch-Site"));
    }
    server.sessions.open(&name).await?;
    Ok(send("index.html", &headers))
}

/// `GET /demo`: the demonstration, with the session `demo`.
pub async fn demo(State(server): State<Arc<Server>>, headers: HeaderMap) -> Result<Response, Problem> {
    server.sessions.open(DEMO).await?;
    Ok(send("index.html", &headers))
}

/// `GET /board`: the board of a challenge, for a projector. It needs no session.
pub async fn board(headers: HeaderMap) -> Response {
    send("index.html", &headers)
}

/// The login page with a status.
pub fn login_page(status: StatusCode) -> Response {
    let mut response = send("login/index.html", &HeaderMap::new());
    *response.status_mut() = status;
    response.headers_mut().insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    response
}

/// Replaces the body of a refusal by a page that shows the reason.
pub fn turn_into_page(response: &mut Response, problem: &Problem) {
    let file = Page::get("refused/index.html").expect("the page is built in");
    let page = String::from_utf8_lossy(&file.data);
    // The reason may contain text from the client, so it is escaped.
    let reason = maud::html! { (problem.detail()) }.into_string();
    *response.body_mut() = Body::from(page.replace("{{reason}}", &reason));
    let headers = response.headers_mut();
    headers.remove(header::CONTENT_LENGTH);
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("text/html"));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
}

pub async fn page(method: Method, uri: Uri, headers: HeaderMap) -> Response {
    let path = uri.path();
    if path.starts_with("/api/") {
        return Problem::not_found("route", path).into_response();
    }
    if method != Method::GET && method != Method::HEAD {
        return Problem::new(
            StatusCode::METHOD_NOT_ALLOWED,
            "method_not_allowed",
            format!("{path} accepts only GET and HEAD"),
        )
        .into_response();
    }
    let name = match path {
        "/viewer/" => "viewer/index.html",
        path => path.trim_start_matches('/'),
    };
    send(name, &headers)
}

fn send(name: &str, headers: &HeaderMap) -> Response {
    let Some(file) = Page::get(name) else { return Problem::not_found("page", name).into_response() };
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
        response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(VIEWER_POLICY));
    }
    response
}
