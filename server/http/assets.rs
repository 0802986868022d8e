//! The page and Rerun's viewer, as the program embeds them.

use std::collections::BTreeMap;
use std::io::Read;
use std::sync::{Arc, OnceLock};

use axum::body::{Body, Bytes};
use axum::extract::{Path, State};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, Uri, header};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;
use serde::de::{IntoDeserializer, value::Error as ValueError};
use xxhash_rust::xxh3::xxh3_64;

use super::Server;
use super::base::BasePath;
use super::problem::Problem;
use super::sessions::{DEMO, MAIN};
use super::site::comes_from_another_site;
use crate::protocol::View;

/// Content security policy of the viewer's page: it may compile WebAssembly, and our own page may frame it.
const VIEWER_POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' blob: data:; \
                          frame-ancestors 'self'; base-uri 'none'; form-action 'none'";

/// Encodings of a file, the one that is preferred first.
const ENCODINGS: [(&str, usize); 2] = [("br", 2), ("gzip", 1)];

/// A file of the page: its name, and its content as it is, as gzip and as brotli, where they exist.
pub type EmbeddedFile = (&'static str, [Option<&'static [u8]>; 3]);

/// What browsers load: the page and Rerun's viewer. Files are compressed when Ferry is built, not when they are sent.
#[derive(Clone, Default)]
pub struct Page(Arc<BTreeMap<&'static str, File>>);

#[derive(Clone)]
struct File {
    contents: [Option<&'static [u8]>; 3],
    /// Weak, because all encodings share it.
    tag: String,
    /// The content as it is, unpacked for the first client without gzip, if the program embeds only gzip.
    unpacked: OnceLock<Bytes>,
}

impl File {
    fn new(contents: [Option<&'static [u8]>; 3]) -> Self {
        let first = contents.iter().flatten().next().copied().unwrap_or_default();
        Self { contents, tag: format!("W/\"{:016x}\"", xxh3_64(first)), unpacked: OnceLock::new() }
    }

    fn plain(&self) -> Bytes {
        let unpack = || {
            let mut plain = Vec::new();
            let packed = self.contents[1].expect("a file is embedded as it is or as gzip");
            flate2::read::GzDecoder::new(packed).read_to_end(&mut plain).expect("the build has packed it");
            plain.into()
        };
        self.contents[0].map_or_else(|| self.unpacked.get_or_init(unpack).clone(), Bytes::from_static)
    }
}

impl Page {
    /// A page of these files.
    pub fn new(files: &[EmbeddedFile]) -> Self {
        Self(Arc::new(files.iter().map(|&(name, contents)| (name, File::new(contents))).collect()))
    }

    /// The page with the addresses that it has below a path.
    pub(super) fn below(self, base: &BasePath) -> Self {
        if *base == BasePath::default() {
            return self;
        }
        let corrected = |file: &File| {
            let text = base.correct(&String::from_utf8_lossy(&file.plain()));
            let tag = format!("W/\"{:016x}\"", xxh3_64(text.as_bytes()));
            File { contents: [None; 3], tag, unpacked: OnceLock::from(Bytes::from(text)) }
        };
        let files = self.0.iter().map(|(&name, file)| {
            let file = if name.ends_with(".html") { corrected(file) } else { file.clone() };
            (name, file)
        });
        Self(Arc::new(files.collect()))
    }

    /// A file, in the best encoding that the client accepts.
    pub(super) fn send(&self, name: &str, headers: &HeaderMap) -> Response {
        let Some(file) = self.0.get(name) else { return Problem::not_found("page", name).into_response() };
        // The bundler puts a hash into every name under assets/.
        let keep = if name.starts_with("assets/") { "public, max-age=31536000, immutable" } else { "no-cache" };
        let kind = mime_guess::from_path(name).first_or_octet_stream();
        let head = [
            (header::CONTENT_TYPE, kind.essence_str()),
            (header::CACHE_CONTROL, keep),
            (header::ETAG, file.tag.as_str()),
            (header::VARY, "accept-encoding"),
        ];
        if headers.get(header::IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == file.tag.as_bytes()) {
            return (StatusCode::NOT_MODIFIED, head).into_response();
        }
        let packed = ENCODINGS.into_iter().filter(|(coding, _)| accepts(headers, coding));
        let packed = packed.filter_map(|(coding, index)| Some((coding, file.contents[index]?))).next();
        let mut response = match packed {
            Some((coding, packed)) => (head, [(header::CONTENT_ENCODING, coding)], packed).into_response(),
            None => (head, file.plain()).into_response(),
        };
        if name.starts_with("viewer/") {
            response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(VIEWER_POLICY));
        }
        response
    }

    /// The login page with a status.
    pub(super) fn login(&self, status: StatusCode) -> Response {
        let mut response = self.send("login/index.html", &HeaderMap::new());
        *response.status_mut() = status;
        response.headers_mut().insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
        response
    }

    /// Replaces the body of a refusal by a page that shows the reason.
    pub(super) fn show_refusal(&self, response: &mut Response, problem: &Problem) {
        let Some(file) = self.0.get("refused/index.html") else { return };
        let page = file.plain();
        // The reason may contain text from the client, so it is escaped.
        let reason = maud::html! { (problem.detail()) }.into_string();
        *response.body_mut() = Body::from(String::from_utf8_lossy(&page).replace("{{reason}}", &reason));
        let headers = response.headers_mut();
        headers.remove(header::CONTENT_LENGTH);
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("text/html"));
        headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    }
}

/// Whether `accept-encoding` names the coding, or everything, and not with the weight 0.
fn accepts(headers: &HeaderMap, coding: &str) -> bool {
    let weight = |coding: &str| {
        let values = headers.get_all(header::ACCEPT_ENCODING).iter().filter_map(|value| value.to_str().ok());
        let found = values.flat_map(|value| value.split(',')).find_map(|one| {
            let (name, parameter) = one.split_once(';').unwrap_or((one, "q=1"));
            name.trim().eq_ignore_ascii_case(coding).then_some(parameter)
        });
        found.map(|q| q.trim().trim_start_matches(['q', 'Q', '=']).parse::<f32>().unwrap_or(0.0))
    };
    weight(coding).or_else(|| weight("*")).is_some_and(|weight| weight > 0.0)
}

/// `GET /`: the page with the session `main`, if the visitor can operate it. If another one does, it leads to the visitor's
/// own session, if there is one. The session `main` is restarted if a fault has ended it.
pub async fn main_session(State(server): State<Arc<Server>>, headers: HeaderMap) -> Result<Response, Problem> {
    let main = server.sessions.open(MAIN).await?;
    let visitor = server.visitors.meet(&headers).map_err(Problem::internal)?;
    let own = visitor.own.as_deref().filter(|own| server.sessions.is_own(own, &visitor.id));
    let mut response = match own {
        Some(own) if !server.shows_main && !main.is_open_to(&visitor.id) => {
            Redirect::to(&format!("{}/s/{own}", server.base)).into_response()
        }
        _ => server.page.send("index.html", &headers),
    };
    server.remember(&visitor, &headers, &mut response);
    Ok(response)
}

/// The address of a session's page.
#[derive(Deserialize)]
pub struct Address {
    name: String,
    /// A [`View`]; the laboratory if missing.
    view: Option<String>,
}

/// `GET /s/{name}`, `/s/{name}/{view}` and `/s/{name}/learn/{lesson}`: the page with the session of that name. The session
/// is created if it does not exist. The page knows the lessons.
pub async fn named_session(
    State(server): State<Arc<Server>>,
    Path(Address { name, view }): Path<Address>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    if let Some(view) = view {
        let known: Result<View, ValueError> = View::deserialize(view.as_str().into_deserializer());
        known.map_err(|_| Problem::not_found("view", &view))?;
    }
    if server.sessions.find(&name).is_none() && comes_from_another_site(&headers) {
        let detail = format!(
            "session {name:?} is not open, and a link from another site does not open one: enter this address yourself"
        );
        return Err(Problem::new(StatusCode::FORBIDDEN, "foreign_site", detail).field("Sec-Fetch-Site"));
    }
    let visitor = server.visitors.meet(&headers).map_err(Problem::internal)?;
    let owner = Some(visitor.id.clone()).filter(|_| visitor.own.as_deref() == Some(&name));
    server.sessions.open_for(&name, owner).await?;
    let mut response = server.page.send("index.html", &headers);
    server.remember(&visitor, &headers, &mut response);
    Ok(response)
}

/// `GET /demo`: the demonstration, with the session `demo`.
pub async fn demo(State(server): State<Arc<Server>>, headers: HeaderMap) -> Result<Response, Problem> {
    server.sessions.open(DEMO).await?;
    Ok(server.page.send("index.html", &headers))
}

/// `GET /board`: the board of a challenge, for a projector. It needs no session.
pub async fn board(State(server): State<Arc<Server>>, headers: HeaderMap) -> Response {
    server.page.send("index.html", &headers)
}

pub async fn page(State(server): State<Arc<Server>>, method: Method, uri: Uri, headers: HeaderMap) -> Response {
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
        // A shared experiment. The page leads to a session of its reader's own.
        "/copy/" => "copy/index.html",
        path => path.trim_start_matches('/'),
    };
    server.page.send(name, &headers)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(page: &Page, accepted: &str) -> (Option<String>, Bytes) {
        let mut headers = HeaderMap::new();
        headers.insert(header::ACCEPT_ENCODING, accepted.parse().unwrap());
        let sent = page.send("a.js", &headers);
        let coding = sent.headers().get(header::CONTENT_ENCODING).map(|coding| coding.to_str().unwrap().to_owned());
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        (coding, runtime.block_on(axum::body::to_bytes(sent.into_body(), 100)).unwrap())
    }

    #[test]
    fn a_client_gets_the_smallest_encoding_that_it_accepts() {
        let page = Page::new(&[("a.js", [Some(b"plain"), Some(b"gzip"), Some(b"brotli")])]);
        for (accepted, coding, content) in [
            ("gzip, deflate, br, zstd", Some("br"), "brotli"),
            ("gzip, br;q=0", Some("gzip"), "gzip"),
            ("identity", None, "plain"),
            ("", None, "plain"),
        ] {
            assert_eq!(body(&page, accepted), (coding.map(str::to_owned), Bytes::from(content)), "{accepted}");
        }
    }

    #[test]
    fn gzip_is_sent_to_clients_that_accept_it() {
        let accepts = |value: &str| {
            let mut headers = HeaderMap::new();
            headers.insert(header::ACCEPT_ENCODING, value.parse().unwrap());
            super::accepts(&headers, "gzip")
        };
        for yes in ["gzip", "br, GZIP;q=0.5", "gzip, deflate, br, zstd", "*", "gzip;q=1, *;q=0", "identity, *; q=0.1"] {
            assert!(accepts(yes), "{yes}");
        }
        for no in ["", "identity", "br", "gzip;q=0", "gzip;q=0, *", "*;q=0", "xgzip"] {
            assert!(!accepts(no), "{no}");
        }
        assert!(!super::accepts(&HeaderMap::new(), "gzip"));
    }
}
