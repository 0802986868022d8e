//! Bodies of requests and of file downloads. Every body is read here. An invalid one is refused with problem details.

use std::error::Error;
use std::sync::Arc;
use std::time::Duration;

use axum::RequestExt;
use axum::body::{Body, Bytes};
use axum::extract::{FromRequest, Request};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use http_body_util::LengthLimitError;
use serde::Deserialize;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::Server;
use super::problem::Problem;

/// Maximum time until a body is complete.
const BODY_WITHIN: Duration = Duration::from_secs(10);
/// The first bytes of a body that do not count, so that small requests are read whatever others send. Connections are
/// limited in number.
const FREE_BYTES: usize = 16 << 10;

/// Bytes that the bodies of all requests may have together while they are read and used.
#[derive(Clone)]
pub struct Bodies(Arc<Semaphore>);

impl Default for Bodies {
    fn default() -> Self {
        Self(Arc::new(Semaphore::new(32 << 20)))
    }
}

impl Bodies {
    async fn read(&self, body: Body) -> Result<Bytes, Problem> {
        let mut counted: Option<OwnedSemaphorePermit> = None;
        // A growing vector would need up to three times the memory.
        let (mut pieces, mut length): (Vec<Vec<u8>>, usize) = (Vec::new(), 0);
        let mut parts = body.into_data_stream();
        while let Some(part) = parts.next().await {
            let part = part.map_err(|error| unread(&error))?;
            let more = (length + part.len()).saturating_sub(length.max(FREE_BYTES));
            let permit = u32::try_from(more).map(|more| self.0.clone().try_acquire_many_owned(more));
            let Ok(Ok(permit)) = permit else {
                let detail = "the bodies of other requests fill the memory for them; try again soon";
                return Err(Problem::new(StatusCode::SERVICE_UNAVAILABLE, "busy", detail).retry_after(1));
            };
            match &mut counted {
                Some(counted) => counted.merge(permit),
                none => *none = Some(permit),
            }
            length += part.len();
            let mut rest = &part[..];
            while !rest.is_empty() {
                if pieces.last().is_none_or(|piece| piece.len() == FREE_BYTES) {
                    pieces.push(Vec::with_capacity(FREE_BYTES));
                }
                let piece = pieces.last_mut().expect("there is one");
                let (now, later) = rest.split_at(rest.len().min(FREE_BYTES - piece.len()));
                piece.extend_from_slice(now);
                rest = later;
            }
        }
        Ok(Bytes::from_owner(Read { bytes: pieces.concat(), _counted: counted }))
    }
}

/// What of a body was read. Its bytes count until it is dropped.
struct Read {
    bytes: Vec<u8>,
    _counted: Option<OwnedSemaphorePermit>,
}

impl AsRef<[u8]> for Read {
    fn as_ref(&self) -> &[u8] {
        &self.bytes
    }
}

fn unread(error: &axum::Error) -> Problem {
    let is_long = std::iter::successors(Some(error as &dyn Error), |&error| error.source())
        .any(|one| one.is::<LengthLimitError>());
    let (status, code) = match is_long {
        true => (StatusCode::PAYLOAD_TOO_LARGE, "too_large"),
        false => (StatusCode::BAD_REQUEST, "malformed"),
    };
    Problem::new(status, code, format!("the body cannot be read: {error}"))
}

/// The whole body, within the route's limit.
pub struct WholeBody(pub Bytes);

impl FromRequest<Arc<Server>> for WholeBody {
    type Rejection = Problem;

    async fn from_request(request: Request, server: &Arc<Server>) -> Result<Self, Problem> {
        let reading = server.bodies.read(request.into_limited_body());
        tokio::time::timeout(BODY_WITHIN, reading).await.map_or_else(
            |_| {
                let detail = format!("the body did not arrive within {} s", BODY_WITHIN.as_secs());
                Err(Problem::new(StatusCode::REQUEST_TIMEOUT, "too_slow", detail))
            },
            |read| read.map(Self),
        )
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
