//! Which site's page caused a request.

use axum::http::{HeaderMap, HeaderName};

const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

/// Whether a browser says that another site's page caused the request.
pub fn comes_from_another_site(headers: &HeaderMap) -> bool {
    matches!(headers.get(&FETCH_SITE).and_then(|value| value.to_str().ok()), Some("cross-site" | "same-site"))
}
