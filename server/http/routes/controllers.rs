//! `/api/controllers`: programs outside of Ferry that decide control steps.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::http::Server;
use crate::http::lists;
use crate::http::path::{Path, ProgramPath, Query};
use crate::http::problem::Problem;
use crate::http::programs::{LIMITS, serve};
use crate::http::refusals::{Conflict, Malformed, NotUpgraded, OutOfRange, TooMany};
use crate::http::socket::Upgrade;
use crate::protocol::{PROGRAM_PROTOCOL_VERSION, Programs};

/// The programs that are or were connected.
#[utoipa::path(get, path = "/api/controllers", tag = "controllers", operation_id = "controllers",
    responses((status = 200, body = Programs)))]
pub async fn list(State(server): State<Arc<Server>>) -> Json<Programs> {
    Json(Programs { programs: lists::programs(&server) })
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ProgramQuery {
    /// Version of the messages that the program understands.
    #[param(example = 1)]
    protocol: u32,
}

/// Connects a program by WebSocket. The server sends `ProgramMessage`, the program `ProgramAnswer`, JSON both.
#[utoipa::path(get, path = "/api/controllers/{name}", tag = "controllers", params(ProgramPath, ProgramQuery),
    operation_id = "connect_controller",
    responses((status = 101, description = "The connection is a WebSocket from here on."),
        Malformed, Conflict, OutOfRange, NotUpgraded, TooMany))]
pub async fn connect(
    State(server): State<Arc<Server>>,
    Path(ProgramPath { name }): Path<ProgramPath>,
    Query(ProgramQuery { protocol }): Query<ProgramQuery>,
    upgrade: Result<Upgrade, Problem>,
) -> Result<Response, Problem> {
    if protocol != PROGRAM_PROTOCOL_VERSION {
        let detail = format!("protocol is {protocol}, this server has {PROGRAM_PROTOCOL_VERSION}");
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "other_protocol", detail).field("protocol"));
    }
    let upgrade = upgrade?;
    let link = server.programs.connect(&name)?;
    Ok(upgrade.serve(&server, LIMITS, |socket| serve(link, socket)))
}
