//! Who may ask: Host and Origin are checked on every route, so that no other site's page, and no name
//! that resolves to this machine, can reach the laboratory.

use axum::extract::Request;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header, uri::Authority};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::problem::Problem;

const POLICY: &str =
    "default-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

/// Refuses foreign hosts and origins, and sets the headers that keep the page to itself.
pub async fn guard(request: Request, next: Next) -> Response {
    let mut response = match check(request.headers()) {
        Ok(()) => next.run(request).await,
        Err(problem) => problem.into_response(),
    };
    let headers = response.headers_mut();
    // The viewer's page has a policy of its own.
    headers.entry(header::CONTENT_SECURITY_POLICY).or_insert(HeaderValue::from_static(POLICY));
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(header::REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    response
}

fn check(headers: &HeaderMap) -> Result<(), Problem> {
    let host = headers.get(header::HOST).and_then(|value| value.to_str().ok()).unwrap_or_default();
    if !names_loopback(host) {
        let detail = format!("host {host:?} is not this machine's loopback address");
        return Err(Problem::new(StatusCode::MISDIRECTED_REQUEST, "foreign_host", detail).field("Host"));
    }
    let Some(origin) = headers.get(header::ORIGIN) else { return Ok(()) };
    let origin = origin.to_str().unwrap_or_default();
    if origin.strip_prefix("http://") == Some(host) {
        return Ok(());
    }
    let detail = format!("origin {origin:?} is not this page's");
    Err(Problem::new(StatusCode::FORBIDDEN, "foreign_origin", detail).field("Origin"))
}

fn names_loopback(host: &str) -> bool {
    let Ok(authority) = host.parse::<Authority>() else { return false };
    let name = authority.host().trim_start_matches('[').trim_end_matches(']');
    !host.contains('@')
        && (name.eq_ignore_ascii_case("localhost") || name.parse::<std::net::IpAddr>().is_ok_and(|ip| ip.is_loopback()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_loopback_names_pass() {
        for good in ["localhost", "localhost:8080", "127.0.0.1:1", "[::1]:8080", "LOCALHOST"] {
            assert!(names_loopback(good), "{good}");
        }
        for bad in ["", "example.org", "127.0.0.1.example.org", "10.0.0.1:8080", "user@localhost", "localhost.evil"] {
            assert!(!names_loopback(bad), "{bad}");
        }
    }

    #[test]
    fn an_origin_must_be_the_host_itself() {
        let headers = |host: &str, origin: Option<&str>| {
            let mut headers = HeaderMap::new();
            headers.insert(header::HOST, host.parse().unwrap());
            if let Some(origin) = origin {
                headers.insert(header::ORIGIN, origin.parse().unwrap());
            }
            headers
        };
        assert!(check(&headers("localhost:8080", None)).is_ok());
        assert!(check(&headers("localhost:8080", Some("http://localhost:8080"))).is_ok());
        for origin in ["http://localhost:9090", "https://example.org", "null", ""] {
            assert!(check(&headers("localhost:8080", Some(origin))).is_err(), "{origin}");
        }
        assert!(check(&HeaderMap::new()).is_err());
    }
}
