//! The camera's images as one long answer (motion JPEG), for programs that read a network camera.

use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use serde::Deserialize;
use tokio::sync::{OwnedSemaphorePermit, watch};
use utoipa::IntoParams;

use super::sessions::find;
use crate::http::live::{CameraWatch, Encoded};
use crate::http::path::{Path, Query, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, OutOfRange};
use crate::http::{CAMERA_STREAMS, Server};

/// While there is no newer image, the last one comes again at this interval: clients give up after a silence, and a client
/// that is gone is noticed.
const AGAIN_EVERY: Duration = Duration::from_secs(5);
/// Maximum number of images that can be asked for.
const FRAMES_MOST: u32 = 100_000;
const BOUNDARY: &str = "--ferry";

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct StreamQuery {
    /// The answer ends after this many images. Without it, it ends with the session.
    #[param(value_type = Option<u32>, minimum = 1, maximum = 100_000, example = 1)]
    frames: Option<String>,
}

impl StreamQuery {
    /// # Errors
    /// 422: not a whole number from 1 to [`FRAMES_MOST`].
    fn frames(&self) -> Result<Option<u32>, Problem> {
        let Some(text) = &self.frames else { return Ok(None) };
        let frames = text.parse().ok().filter(|frames| (1..=FRAMES_MOST).contains(frames));
        frames.map(Some).ok_or_else(|| {
            let detail = format!("frames is {text:?}, it must be a whole number from 1 to {FRAMES_MOST}");
            Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", detail).field("frames")
        })
    }
}

/// The camera's images as motion JPEG.
///
/// The newest image comes at once, then each newer one: one per control step, at most 30 per second. A slow client misses
/// images. Each part has the tick of its image in the header `X-Ferry-Tick`. While there is no newer image, the last one
/// comes again every 5 s.
#[utoipa::path(get, path = "/api/sessions/{id}/camera.mjpeg", tag = "sessions", params(SessionPath, StreamQuery),
    responses((status = 200, description = "JPEG files of 480 × 480 pixels.", content(("multipart/x-mixed-replace"))),
        NotFound, OutOfRange))]
pub async fn camera_stream(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
    Query(query): Query<StreamQuery>,
) -> Result<Response, Problem> {
    let left = query.frames()?;
    let hub = find(&server, &id)?;
    let Ok(place) = server.camera_streams.clone().try_acquire_owned() else {
        let detail = format!("{CAMERA_STREAMS} camera streams are open already; close one, or poll camera.png");
        return Err(Problem::new(StatusCode::TOO_MANY_REQUESTS, "too_many_streams", detail));
    };
    let images = Images {
        newest: hub.encoded(),
        closing: hub.closing(),
        stopping: server.stopping.clone(),
        left,
        sent: None,
        _watch: hub.watch_camera(),
        _place: place,
    };
    let parts = stream::unfold(Some(images), |images| async {
        let mut images = images?;
        Some(match images.next().await {
            Some(part) => (Ok::<_, Infallible>(part), Some(images)),
            None => (Ok(Bytes::from_static(b"--\r\n")), None),
        })
    });
    let head =
        [(header::CONTENT_TYPE, "multipart/x-mixed-replace; boundary=ferry"), (header::CACHE_CONTROL, "no-store")];
    Ok((head, Body::from_stream(parts)).into_response())
}

/// The images of one stream. It holds no session, which may end meanwhile.
struct Images {
    newest: watch::Receiver<Encoded>,
    /// Becomes true when the session is closed.
    closing: watch::Receiver<bool>,
    /// Becomes true when the server stops.
    stopping: watch::Receiver<bool>,
    /// Images until the end.
    left: Option<u32>,
    /// Version of the last image.
    sent: Option<u64>,
    _watch: CameraWatch,
    _place: OwnedSemaphorePermit,
}

impl Images {
    /// The next part, without the end of its last line; `None` at the end.
    async fn next(&mut self) -> Option<Bytes> {
        if self.left == Some(0) {
            return None;
        }
        let sent = self.sent;
        let newer = async { self.newest.wait_for(|newest| Some(newest.sight_version) != sent).await.is_ok() };
        let goes_on = tokio::select! {
            biased;
            () = async { drop(self.closing.wait_for(|&closed| closed).await) } => false,
            () = async { drop(self.stopping.wait_for(|&stop| stop).await) } => false,
            // An error means that the session has ended.
            has_newer = newer => has_newer,
            () = tokio::time::sleep(AGAIN_EVERY) => true,
        };
        if !goes_on {
            return None;
        }
        let (version, image) = {
            let newest = self.newest.borrow_and_update();
            (newest.sight_version, newest.camera_jpeg())
        };
        let (tick, jpeg) = image?;
        let is_first = self.sent.replace(version).is_none();
        self.left = self.left.map(|left| left - 1);
        Some(part(is_first, tick, &jpeg))
    }
}

/// The boundary follows each image at once, because some clients show an image only when they have read its end.
fn part(is_first: bool, tick: u64, jpeg: &[u8]) -> Bytes {
    let before = if is_first { BOUNDARY } else { "" };
    let length = jpeg.len();
    let head =
        format!("{before}\r\nContent-Type: image/jpeg\r\nContent-Length: {length}\r\nX-Ferry-Tick: {tick}\r\n\r\n");
    [head.as_bytes(), jpeg, b"\r\n", BOUNDARY.as_bytes()].concat().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(text: &str) -> Result<Option<u32>, Problem> {
        StreamQuery { frames: Some(text.to_owned()) }.frames()
    }

    #[test]
    fn frames_is_a_whole_number_within_its_limits() {
        assert_eq!(StreamQuery { frames: None }.frames().unwrap(), None);
        assert_eq!(frames("1").unwrap(), Some(1));
        assert_eq!(frames("100000").unwrap(), Some(100_000));
        for text in ["0", "100001", "-1", "1.5", "", "many"] {
            let refused = frames(text).unwrap_err();
            let detail = format!("frames is {text:?}, it must be a whole number from 1 to 100000");
            assert_eq!((refused.code(), refused.detail()), ("out_of_range", detail.as_str()));
        }
    }

    #[test]
    fn parts_make_a_multipart_body() {
        let body = [&part(true, 7, b"one")[..], &part(false, 38, b"two"), b"--\r\n"].concat();
        let expected = "--ferry\r\nContent-Type: image/jpeg\r\nContent-Length: 3\r\nX-Ferry-Tick: 7\r\n\r\none\r\n\
                        --ferry\r\nContent-Type: image/jpeg\r\nContent-Length: 3\r\nX-Ferry-Tick: 38\r\n\r\ntwo\r\n\
                        --ferry--\r\n";
        assert_eq!(String::from_utf8(body).unwrap(), expected);
    }
}
