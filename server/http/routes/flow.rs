//! Flow fields of the attractor dynamics.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use super::sessions::view;
use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::path::{Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, OutOfRange};
use crate::protocol::{FLOW_SPACING_M, FlowField, FlowQuery};
use ferry_core::control::transport::attractor::Flow;

/// The flow field of the attractor dynamics.
#[utoipa::path(post, path = "/api/sessions/{id}/flow", tag = "sessions", params(SessionPath), request_body = FlowQuery,
    responses((status = 200, body = FlowField), NotFound, OutOfRange))]
pub async fn flow(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
    WholeBody(body): WholeBody,
) -> Result<Json<FlowField>, Problem> {
    let FlowQuery { spacing_m, .. } = parse(&body)?;
    if !FLOW_SPACING_M.contains(&spacing_m) {
        let (least, most) = (FLOW_SPACING_M.start(), FLOW_SPACING_M.end());
        let message = format!("spacing_m is {spacing_m}, it must be {least} to {most}");
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", message).field("spacing_m"));
    }
    let view = view(&server, &id)?;
    let flow = server.work(move |_| {
        let known = &view.sight.1.known;
        Flow::of(known, view.moment.goal_m, &view.scenery.parameters, spacing_m)
    });
    Ok(Json(flow.await?.into()))
}
