//! What the tracker reports to the controllers, as a small answer that a program can poll.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use super::sessions::find;
use crate::http::Server;
use crate::http::path::{Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, Unavailable};
use crate::protocol::TrackerEstimate;
use crate::session::CommandError;
use ferry_core::session::{self, Recalled};

/// The tracker's estimate of the bead, and the goal.
///
/// While the session runs, it is the estimate that the controllers had at the last control step, at most about 0.25 s of
/// simulated time ago. While it is paused, it is the present one. `tick` is its time.
#[utoipa::path(get, path = "/api/sessions/{id}/tracker", tag = "sessions", params(SessionPath),
    responses((status = 200, body = TrackerEstimate), NotFound, Unavailable))]
pub async fn tracker(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Json<TrackerEstimate>, Problem> {
    let hub = find(&server, &id)?;
    let (tick, running) = {
        let views = hub.session.watch();
        let view = views.borrow();
        (view.moment.tick, view.running)
    };
    let moment = if running { Recalled::Step } else { Recalled::Present };
    let point = hub.session.recall(tick, moment).await.map_err(|error| match error {
        CommandError::Session(session::CommandError::Range { .. }) => {
            let detail = format!("the session went back before tick {tick} meanwhile; try again");
            Problem::new(StatusCode::SERVICE_UNAVAILABLE, "trial_changed", detail)
        }
        error => Problem::from(&error),
    })?;
    Ok(Json(TrackerEstimate::from(&point.point.origin.state.world)))
}
