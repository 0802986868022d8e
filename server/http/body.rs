//! Request bodies, with refusals that are problem details as all others.

use std::time::Duration;

use axum::body::Bytes;
use axum::extract::{FromRequest, Request};
use axum::http::StatusCode;

use super::problem::Problem;

/// A body is whole in this time, or it is not waited for.
const BODY_WITHIN: Duration = Duration::from_secs(10);

/// The whole body, within the route's limit.
pub struct WholeBody(pub Bytes);

impl<S: Send + Sync> FromRequest<S> for WholeBody {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        let reading = tokio::time::timeout(BODY_WITHIN, Bytes::from_request(request, state));
        let Ok(read) = reading.await else {
            let detail = format!("the body did not come within {} s", BODY_WITHIN.as_secs());
            return Err(Problem::new(StatusCode::REQUEST_TIMEOUT, "too_slow", detail));
        };
        read.map(Self).map_err(|refused| {
            let status = refused.status();
            let code = if status == StatusCode::PAYLOAD_TOO_LARGE { "too_large" } else { "malformed" };
            Problem::new(status, code, refused.body_text())
        })
    }
}
