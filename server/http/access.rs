//! Access control. Host and Origin are checked on every route, so that neither another site's page nor a foreign name
//! that resolves to this machine can reach the laboratory. If the server has a token, every client must send it.

pub mod login;
mod origins;
mod rates;
pub mod signed;
mod token;

use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::time::Instant;

use axum::extract::{ConnectInfo, Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::Server;
use super::problem::Problem;
use super::site::comes_from_another_site;

use origins::Origins;
pub use origins::{Origin, OriginError};
pub use rates::Client;
use rates::{Rates, TooOften};
pub use token::{Token, TokenError};

const POLICY: &str = "default-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'; base-uri 'none'; \
                      form-action 'none'; object-src 'none'";
const FETCH_MODE: HeaderName = HeaderName::from_static("sec-fetch-mode");
const FETCH_DEST: HeaderName = HeaderName::from_static("sec-fetch-dest");

/// Why the settings are inconsistent.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AccessError {
    /// Other machines could connect without a token.
    #[error(
        "--bind {address} allows access from other machines, which requires a token: use --token-file or FERRY_TOKEN \
         (`ferry token` makes a token)"
    )]
    NoToken { address: SocketAddr },
    /// A proxy would let other machines connect without a token.
    #[error(
        "--origin {origin} allows access from other machines, which requires a token: use --token-file or FERRY_TOKEN \
         (`ferry token` makes a token)"
    )]
    NoTokenForOrigin { origin: String },
    /// The address that browsers use is unknown.
    #[error(
        "--bind {address} does not determine the page's address: give it with --origin, as in --origin \
         http://lab.local:8080"
    )]
    NoOrigin { address: SocketAddr },
}

/// Access rules and rate limits. Shared by all connections.
pub struct Access {
    token: Option<Token>,
    cookie_key: Option<cookie::Key>,
    origins: Origins,
    rates: Rates,
    logged_out: login::LoggedOut,
}

impl Access {
    /// The page's address for a client that used `host`.
    pub fn address_of(&self, host: &str) -> String {
        self.origins.address_of(host)
    }

    /// The rules for a listener at `address` that browsers also reach under `origins`.
    ///
    /// # Errors
    /// Other machines could connect without a token, or no origin is allowed.
    pub fn new(address: SocketAddr, token: Option<Token>, origins: &[Origin]) -> Result<Self, AccessError> {
        if !address.ip().is_loopback() && token.is_none() {
            return Err(AccessError::NoToken { address });
        }
        if let (None, Some(origin)) = (&token, origins.iter().find(|origin| !origin.is_loopback())) {
            return Err(AccessError::NoTokenForOrigin { origin: origin.to_string() });
        }
        if address.ip().is_unspecified() && origins.is_empty() {
            return Err(AccessError::NoOrigin { address });
        }
        let own: Vec<SocketAddr> = match address.ip() {
            ip if ip.is_unspecified() => Vec::new(),
            ip if ip.is_loopback() => loopback(address.port()).to_vec(),
            _ => vec![address],
        };
        let mut all: Vec<Origin> = own.into_iter().map(Origin::of).chain(origins.iter().cloned()).collect();
        if address.ip().is_loopback() {
            all.extend(format!("http://localhost:{}", address.port()).parse::<Origin>());
        }
        let cookie_key = token.as_ref().map(Token::cookie_key);
        Ok(Self {
            token,
            cookie_key,
            origins: Origins::new(&all, address.ip().is_loopback()),
            rates: Rates::default(),
            logged_out: login::LoggedOut::default(),
        })
    }

    /// Forgets clients without recent requests.
    pub fn forget(&self) {
        self.rates.forget();
    }

    /// Admits a request, or returns the reason for its refusal.
    fn admit(&self, request: &Request, address: IpAddr) -> Result<Client, Problem> {
        let headers = request.headers();
        let host = self.check_host(request)?;
        let origin = self.check_origin(headers, host)?;
        check_site(headers, request.method())?;
        let by_address = Client::at(address);
        let (client, is_authenticated) = match (&self.token, bearer(headers)) {
            (None, _) => (by_address, true),
            (Some(token), Some(presented)) if token.matches(presented) => (by_address, true),
            (Some(_), Some(_)) => return Err(self.wrong_token(&by_address)),
            (Some(_), None) => match self.login(headers) {
                // A browser adds the cookie to every request, whatever site made it. The origin names that site.
                Some(_) if origin.is_none() && changes_something(request) => {
                    let detail = "a request with the cookie needs the header Origin; programs send the token instead, \
                                  as Authorization: Bearer";
                    return Err(Problem::new(StatusCode::FORBIDDEN, "no_origin", detail).field("Origin"));
                }
                Some(login) => (Client::Login(login), true),
                None => (by_address, false),
            },
        };
        self.rates.request(&client).map_err(|wait| too_often("this client sends too many requests", wait))?;
        if is_authenticated || is_public(request.uri().path()) {
            return Ok(client);
        }
        let detail = "the token is missing: log in at /login, or send the token as Authorization: Bearer";
        Err(Problem::new(StatusCode::UNAUTHORIZED, "no_token", detail).field("Authorization"))
    }

    /// The number of the request's login, if it has a valid one.
    fn login(&self, headers: &HeaderMap) -> Option<String> {
        let login = login::valid_login(headers, self.cookie_key.as_ref()?)?;
        (!self.logged_out.contains(&login)).then_some(login)
    }

    /// A request must have exactly one Host, and it must be allowed. The host in the request line must be allowed, too.
    fn check_host<'a>(&self, request: &'a Request) -> Result<&'a str, Problem> {
        let mut hosts = request.headers().get_all(header::HOST).iter();
        let host = hosts.next().and_then(|value| value.to_str().ok()).unwrap_or_default();
        let named = request.uri().authority().map_or(host, |authority| authority.as_str());
        if hosts.next().is_none() && self.origins.has_host(host) && self.origins.has_host(named) {
            return Ok(host);
        }
        let detail =
            format!("host {named:?} is not an allowed host of this server; start it with --origin http://{named}");
        Err(Problem::new(StatusCode::MISDIRECTED_REQUEST, "foreign_host", detail).field("Host"))
    }

    fn check_origin<'a>(&self, headers: &'a HeaderMap, host: &str) -> Result<Option<&'a str>, Problem> {
        let mut origins = headers.get_all(header::ORIGIN).iter();
        let Some(origin) = origins.next() else { return Ok(None) };
        let origin = origin.to_str().unwrap_or_default();
        if origins.next().is_none() && self.origins.has_origin(origin, host) {
            return Ok(Some(origin));
        }
        let detail = format!("origin {origin:?} is not an allowed origin of this server");
        Err(Problem::new(StatusCode::FORBIDDEN, "foreign_origin", detail).field("Origin"))
    }

    fn wrong_token(&self, client: &Client) -> Problem {
        match self.rates.wrong_token(client) {
            Ok(()) => Problem::new(StatusCode::UNAUTHORIZED, "wrong_token", "the token is wrong").field("token"),
            Err(wait) => too_often("too many wrong tokens", wait),
        }
    }
}

/// `127.0.0.1` and `[::1]`.
fn loopback(port: u16) -> [SocketAddr; 2] {
    [([127, 0, 0, 1], port).into(), (std::net::Ipv6Addr::LOCALHOST, port).into()]
}

fn too_often(what: &str, TooOften(wait): TooOften) -> Problem {
    let wait_s = wait.as_secs() as u32 + 1;
    Problem::new(StatusCode::TOO_MANY_REQUESTS, "too_often", format!("{what}; try again in {wait_s} s"))
        .retry_after(wait_s)
}

fn bearer(headers: &HeaderMap) -> Option<&str> {
    let (scheme, token) = headers.get(header::AUTHORIZATION)?.to_str().ok()?.split_once(' ')?;
    scheme.eq_ignore_ascii_case("bearer").then(|| token.trim())
}

/// Whether the request can change something, as a WebSocket can.
fn changes_something(request: &Request) -> bool {
    !matches!(*request.method(), Method::GET | Method::HEAD | Method::OPTIONS)
        || request.headers().contains_key(header::UPGRADE)
}

/// Whether a path is public without the token: health, and the login page with its files.
fn is_public(path: &str) -> bool {
    matches!(path, "/healthz" | "/login") || path.starts_with("/assets/")
}

/// Browsers report the source of a request in `Sec-Fetch-Site`, even without Origin. Another site may only link here.
fn check_site(headers: &HeaderMap, method: &Method) -> Result<(), Problem> {
    let value_of = |name: &HeaderName| headers.get(name).and_then(|value| value.to_str().ok());
    // A frame also navigates, and would open a session.
    let is_link = value_of(&FETCH_MODE) == Some("navigate") && value_of(&FETCH_DEST) == Some("document");
    if !comes_from_another_site(headers) || is_link && *method == Method::GET {
        return Ok(());
    }
    let detail = "the request comes from another site's page; another site may only link here";
    Err(Problem::new(StatusCode::FORBIDDEN, "foreign_site", detail).field("Sec-Fetch-Site"))
}

/// Admits requests and sets the security headers.
pub async fn guard(
    State(server): State<Arc<Server>>,
    ConnectInfo(address): ConnectInfo<SocketAddr>,
    mut request: Request,
    next: Next,
) -> Response {
    let began = Instant::now();
    let (method, path) = (request.method().clone(), request.uri().path().to_owned());
    let wants_page = wants_page(&request);
    let mut response = match server.access.admit(&request, address.ip()) {
        Ok(client) => {
            request.extensions_mut().insert(client);
            next.run(request).await
        }
        Err(problem) => {
            server.counters.refuse(problem.code());
            // A request for the page without a login gets the login page.
            if problem.code() == "no_token" && method == Method::GET && is_page(&path) {
                server.page.login(StatusCode::UNAUTHORIZED)
            } else {
                problem.into_response()
            }
        }
    };
    if wants_page && let Some(problem) = response.extensions_mut().remove::<Problem>() {
        server.page.show_refusal(&mut response, &problem);
    }
    server.counters.answer(response.status());
    tracing::debug!(%method, path, status = response.status().as_u16(), %address, took = ?began.elapsed(), "request");
    let headers = response.headers_mut();
    // The viewer's page has its own policy.
    headers.entry(header::CONTENT_SECURITY_POLICY).or_insert(HeaderValue::from_static(POLICY));
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(header::REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    headers.insert("cross-origin-resource-policy", HeaderValue::from_static("same-origin"));
    response
}

/// Whether a browser requests a document to show.
fn wants_page(request: &Request) -> bool {
    let accepts = request.headers().get(header::ACCEPT).and_then(|value| value.to_str().ok());
    *request.method() == Method::GET
        && !request.uri().path().starts_with("/api/")
        && accepts.is_some_and(|kinds| kinds.contains("text/html"))
}

fn is_page(path: &str) -> bool {
    path == "/" || path == "/demo" || path == "/board" || path.starts_with("/s/") || path == "/viewer/"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn access(address: &str, token: bool, origins: &[&str]) -> Result<Access, AccessError> {
        let token = token.then(|| Token::generate().unwrap().parse().unwrap());
        let origins: Vec<Origin> = origins.iter().map(|text| text.parse().unwrap()).collect();
        Access::new(address.parse().unwrap(), token, &origins)
    }

    #[test]
    fn other_machines_need_a_token_and_an_allowed_name() {
        assert!(access("127.0.0.1:8080", false, &[]).is_ok());
        assert!(access("[::1]:8080", true, &["https://lab.example.org"]).is_ok());
        assert!(access("10.0.0.7:8080", true, &[]).is_ok());
        assert!(access("0.0.0.0:8080", true, &["http://lab.local:8080"]).is_ok());
        assert!(matches!(access("10.0.0.7:8080", false, &[]), Err(AccessError::NoToken { .. })));
        assert!(matches!(access("0.0.0.0:8080", false, &[]), Err(AccessError::NoToken { .. })));
        assert!(matches!(access("0.0.0.0:8080", true, &[]), Err(AccessError::NoOrigin { .. })));
        let error = access("127.0.0.1:8080", false, &["https://lab.example.org"]).err().unwrap();
        assert_eq!(error, AccessError::NoTokenForOrigin { origin: "https://lab.example.org".into() });
    }

    #[test]
    fn loopback_has_three_names_with_any_port() {
        let access = access("127.0.0.1:8080", false, &[]).unwrap();
        for host in ["127.0.0.1:8080", "localhost:8080", "[::1]:8080"] {
            assert!(
                access.origins.has_host(host) && access.origins.has_origin(&format!("http://{host}"), host),
                "{host}"
            );
        }
        // As forwarded ports.
        assert!(access.origins.has_host("localhost:8081") && access.origins.has_host("localhost"));
        assert!(!access.origins.has_origin("http://localhost:8081", "localhost:8080"));
    }
}
