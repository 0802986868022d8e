//! `/api/policies`: the policies that a session can select.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::http::Server;
use crate::http::body::{WholeBody, attachment, parse};
use crate::http::path::{Path, PolicyPath};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use crate::protocol::{Policies, PolicyName, PolicySummary};
use ferry_core::policy::PolicyError;
use ferry_core::scenario::RlPolicy;
use ferry_lab::learn::LibraryError;

/// The shipped policies, then the added ones.
#[utoipa::path(get, path = "/api/policies", tag = "policies", operation_id = "policies",
    responses((status = 200, body = Policies), Unavailable))]
pub async fn list(State(server): State<Arc<Server>>) -> Result<Json<Policies>, Problem> {
    Ok(Json(server.work(|server| Policies::of(&server.policies)).await?))
}

/// A policy as a safetensors file, with its manifest in the metadata.
#[utoipa::path(get, path = "/api/policies/{file}", tag = "policies", params(PolicyPath), operation_id = "policy_file",
    responses((status = 200, description = "The file.", content(("application/octet-stream"))), NotFound, Unavailable))]
pub async fn file(
    State(server): State<Arc<Server>>,
    Path(PolicyPath { file }): Path<PolicyPath>,
) -> Result<Response, Problem> {
    let unknown = || Problem::not_found("policy", &file);
    let name = file.strip_suffix(".safetensors").ok_or_else(unknown)?;
    let asked: RlPolicy = name.parse().map_err(|_| unknown())?;
    let read = server.work(move |server| server.policies.bytes(&asked)).await?;
    Ok(attachment("application/octet-stream", &file, read?))
}

/// Adds the policy in the body, a safetensors file.
#[utoipa::path(post, path = "/api/policies/{file}", tag = "policies", params(PolicyPath), operation_id = "add_policy",
    request_body(content_type = "application/octet-stream", content = String, description = "The policy's file."),
    responses((status = 201, body = PolicySummary, headers(("Location" = String, description = "Its file's path."))),
        Conflict, OutOfRange, TooMany, Unavailable))]
pub async fn add(
    State(server): State<Arc<Server>>,
    Path(PolicyPath { file: name }): Path<PolicyPath>,
    WholeBody(body): WholeBody,
) -> Result<Response, Problem> {
    let added = server.work(move |server| server.policies.add(&name, &body, None)).await??;
    let location = format!("/api/policies/{}.safetensors", added.name);
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], Json(PolicySummary::from(&added))).into_response())
}

/// Gives an added policy another name. Links to it still work.
#[utoipa::path(patch, path = "/api/policies/{file}", tag = "policies", params(PolicyPath),
    operation_id = "rename_policy", request_body = PolicyName,
    responses((status = 200, body = PolicySummary), NotFound, Conflict, OutOfRange, Unavailable))]
pub async fn rename(
    State(server): State<Arc<Server>>,
    Path(PolicyPath { file: name }): Path<PolicyPath>,
    WholeBody(body): WholeBody,
) -> Result<Json<PolicySummary>, Problem> {
    let PolicyName { name: new } = parse(&body)?;
    let renamed = server.work(move |server| server.policies.rename(&name, &new)).await??;
    Ok(Json(PolicySummary::from(&renamed)))
}

/// Deletes an added policy. A session that uses it holds the arm from its next decision on.
#[utoipa::path(delete, path = "/api/policies/{file}", tag = "policies", params(PolicyPath),
    operation_id = "delete_policy",
    responses((status = 204, description = "The policy is deleted."), NotFound, Unavailable))]
pub async fn delete(
    State(server): State<Arc<Server>>,
    Path(PolicyPath { file: name }): Path<PolicyPath>,
) -> Result<StatusCode, Problem> {
    server.work(move |server| server.policies.remove(&name)).await??;
    Ok(StatusCode::NO_CONTENT)
}

impl From<LibraryError> for Problem {
    fn from(error: LibraryError) -> Self {
        let detail = error.to_string();
        let (status, code, field) = match error {
            LibraryError::Policy(_) => (StatusCode::UNPROCESSABLE_ENTITY, "policy_refused", "policy"),
            LibraryError::Name { .. } => (StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", "name"),
            LibraryError::Taken { .. } => (StatusCode::CONFLICT, "taken", "name"),
            LibraryError::TooMany => (StatusCode::TOO_MANY_REQUESTS, "too_many_policies", "policy"),
            LibraryError::Unknown { .. } => (StatusCode::NOT_FOUND, "not_found", "name"),
            LibraryError::Io(_) => (StatusCode::INSUFFICIENT_STORAGE, "not_kept", "policy"),
        };
        Self::new(status, code, detail).field(field)
    }
}

impl From<PolicyError> for Problem {
    fn from(error: PolicyError) -> Self {
        match error {
            PolicyError::Unknown { .. } => Self::new(StatusCode::NOT_FOUND, "not_found", error.to_string()),
            error => Self::internal(error),
        }
    }
}
