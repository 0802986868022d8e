//! Bodies of requests and of file downloads. An invalid body is refused with problem details.

use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::extract::{FromRequest, Request};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;

use super::problem::Problem;

/// Maximum time until a body is complete.
const BODY_WITHIN: Duration = Duration::from_secs(10);

/// The whole body, within the route's limit.
pub struct WholeBody(pub Bytes);

impl<S: Send + Sync> FromRequest<S> for WholeBody {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        let reading = tokio::time::timeout(BODY_WITHIN, Bytes::from_request(request, state));
        let Ok(read) = reading.await else {
            let detail = format!("the body did not arrive within {} s", BODY_WITHIN.as_secs());
            return Err(Problem::new(StatusCode::REQUEST_TIMEOUT, "too_slow", detail));
        };
        read.map(Self).map_err(|refused| {
            let status = refused.status();
            let code = if status == StatusCode::PAYLOAD_TOO_LARGE { "too_large" } else { "malformed" };
            Problem::new(status, code, refused.body_text())
        })
    }
}

/// Reads a JSON object.
pub fn parse<'a, T: Deserialize<'a>>(body: &'a [u8]) -> Result<T, Problem> {
    let mut reader = serde_json::Deserializer::from_slice(body);
    let malformed = |detail: String| Problem::new(StatusCode::BAD_REQUEST, "malformed", detail);
    // Serde reads the fields of an object from an array, too, without their names.
    if body.trim_ascii_start().first() == Some(&b'[') {
        return Err(malformed("the body is an array, it must be a JSON object".to_owned()));
    }
    let value = serde_path_to_error::deserialize(&mut reader)
        .map_err(|error| malformed(error.to_string()).field(&error.path().to_string()))?;
    reader.end().map_err(|error| malformed(error.to_string()))?;
    Ok(value)
}

pub fn attachment(kind: &'static str, name: &str, body: impl Into<Body>) -> Response {
    let disposition = format!("attachment; filename=\"{name}\"");
    ([(header::CONTENT_TYPE, kind.to_owned()), (header::CONTENT_DISPOSITION, disposition)], body.into()).into_response()
}
