//! `POST /api/kinematics/…` and `POST /api/magnetics/…`: calculations for arm and magnet.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use nalgebra::{Rotation3, UnitQuaternion};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::problem::Problem;
use crate::http::refusals::{OutOfRange, Unavailable};
use crate::protocol::{Numbers3, Numbers6, Rows3, WorkspaceMap, WorkspaceQuery};
use ferry_core::control::limits::MIN_MANIPULABILITY_M3;
use ferry_core::geometry::{Isometry3, Matrix3, Vector3};
use ferry_core::magnetics::curves::{self, CurveError, PullCurve, PullQuery, ReachCurve, ReachQuery};
use ferry_core::magnetics::plane::{self, Plane, PlaneQuery};
use ferry_core::magnetics::{cuboid::Cuboid, force};
use ferry_core::plant::manipulability_map;
use ferry_core::robot::workspace::WorkspaceError;
use ferry_core::robot::{Joints, forward, inverse};

/// Maximum number of items per request.
const BATCH_LIMIT: usize = 10_000;
/// Tolerance for the orthonormality of a rotation's rows: single precision.
const ORTHONORMAL_SLACK: f64 = 1e-6;

/// Body of `POST /api/kinematics/forward`.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct ForwardRequest {
    #[schema(value_type = Vec<Numbers6>, max_items = 10_000)]
    joints_rad: Vec<Joints>,
}

/// A flange pose; the rotation is given by rows.
#[derive(Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct Pose {
    #[schema(value_type = Numbers3)]
    position_m: [f64; 3],
    #[schema(value_type = Rows3)]
    rotation: [[f64; 3]; 3],
}

/// Answer of `POST /api/kinematics/forward`.
#[derive(Serialize, ToSchema)]
pub struct ForwardAnswer {
    flange: Vec<Pose>,
}

/// Flange poses of joint angles.
#[utoipa::path(post, path = "/api/kinematics/forward", tag = "calculator", request_body = ForwardRequest,
    responses((status = 200, body = ForwardAnswer), Unavailable))]
pub async fn forward(
    State(server): State<Arc<Server>>,
    WholeBody(body): WholeBody,
) -> Result<Json<ForwardAnswer>, Problem> {
    server.work(move |_| poses(&body)).await?.map(Json)
}

fn poses(body: &[u8]) -> Result<ForwardAnswer, Problem> {
    let request: ForwardRequest = parse(body)?;
    limit("joints_rad", request.joints_rad.len())?;
    let poses = request.joints_rad.iter().map(|joints| {
        let flange = forward::flange(joints);
        let rotation = flange.rotation.to_rotation_matrix();
        let row = |i: usize| [rotation[(i, 0)], rotation[(i, 1)], rotation[(i, 2)]];
        Pose { position_m: flange.translation.vector.into(), rotation: [row(0), row(1), row(2)] }
    });
    Ok(ForwardAnswer { flange: poses.collect() })
}

/// Body of `POST /api/kinematics/inverse`.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({
    "poses": [{"position_m": [0.1, -0.4, 0.3], "rotation": [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]}],
}))]
struct InverseRequest {
    #[schema(max_items = 10_000)]
    poses: Vec<Pose>,
}

/// Answer of `POST /api/kinematics/inverse`: up to eight solutions per pose; an empty list if the pose is unreachable.
#[derive(Serialize, ToSchema)]
pub struct InverseAnswer {
    #[schema(value_type = Vec<Vec<Numbers6>>)]
    solutions: Vec<Vec<Joints>>,
}

/// Joint angles of flange poses.
#[utoipa::path(post, path = "/api/kinematics/inverse", tag = "calculator", request_body = InverseRequest,
    responses((status = 200, body = InverseAnswer), OutOfRange, Unavailable))]
pub async fn inverse(
    State(server): State<Arc<Server>>,
    WholeBody(body): WholeBody,
) -> Result<Json<InverseAnswer>, Problem> {
    server.work(move |_| solutions(&body)).await?.map(Json)
}

fn solutions(body: &[u8]) -> Result<InverseAnswer, Problem> {
    let request: InverseRequest = parse(body)?;
    limit("poses", request.poses.len())?;
    let mut solutions = Vec::with_capacity(request.poses.len());
    for (index, pose) in request.poses.iter().enumerate() {
        let flange = flange_of(pose).map_err(|detail| {
            Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "not_a_rotation", detail)
                .field(&format!("poses[{index}].rotation"))
        })?;
        // If θ6 is free, it is zero.
        let found = inverse::solutions(&flange, &[0.0; 6]);
        solutions.push(found.map_or_else(|_| Vec::new(), |found| found.to_vec()));
    }
    Ok(InverseAnswer { solutions })
}

fn flange_of(pose: &Pose) -> Result<Isometry3<f64>, String> {
    let rows = Matrix3::from_fn(|i, j| pose.rotation[i][j]);
    let off = (rows * rows.transpose() - Matrix3::identity()).amax();
    let handed = rows.determinant();
    if off > ORTHONORMAL_SLACK || handed < 0.0 {
        return Err(format!(
            "the rotation {:?} is not orthonormal and right-handed: its rows deviate by {off:.1e}, its determinant is {handed:.3}",
            pose.rotation
        ));
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rows));
    Ok(Isometry3::from_parts(Vector3::from(pose.position_m).into(), rotation))
}

/// The arm's manipulability over the table; the singularity-free workspace is where it is not small.
#[utoipa::path(post, path = "/api/kinematics/workspace", tag = "calculator", request_body = WorkspaceQuery,
    responses((status = 200, body = WorkspaceMap), OutOfRange, Unavailable))]
pub async fn workspace(
    State(server): State<Arc<Server>>,
    WholeBody(body): WholeBody,
) -> Result<Json<WorkspaceMap>, Problem> {
    let WorkspaceQuery { area, cell_m, tool_height_m, tool_orientation } = parse(&body)?;
    // Up to a tenth of a second.
    let making = move || manipulability_map(&area, cell_m, tool_height_m, tool_orientation);
    let made = server.work(move |_| making()).await?;
    let map = made.map_err(|error| {
        let field = match error {
            WorkspaceError::NonFinite { input: "height", .. } => "tool_height_m",
            WorkspaceError::NonFinite { .. } | WorkspaceError::EmptyArea { .. } => "area",
            WorkspaceError::EmptyCell { .. } | WorkspaceError::TooManyCells { .. } => "cell_m",
        };
        Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "no_workspace", error.to_string()).field(field)
    })?;
    Ok(Json(WorkspaceMap { map, least_m3: MIN_MANIPULABILITY_M3 }))
}

/// The pull on the bead over its offset from the block.
#[utoipa::path(post, path = "/api/magnetics/pull", tag = "calculator", request_body = PullQuery,
    responses((status = 200, body = PullCurve), OutOfRange, Unavailable))]
pub async fn pull(State(server): State<Arc<Server>>, WholeBody(body): WholeBody) -> Result<Json<PullCurve>, Problem> {
    let query: PullQuery = parse(&body)?;
    let curve = server.work(move |_| curves::pull(&query)).await?;
    curve.map(Json).map_err(|error| no_curve(&error))
}

/// The field and the pull on the bead over the table around the block.
#[utoipa::path(post, path = "/api/magnetics/plane", tag = "calculator", request_body = PlaneQuery,
    responses((status = 200, body = Plane), OutOfRange, Unavailable))]
pub async fn plane(State(server): State<Arc<Server>>, WholeBody(body): WholeBody) -> Result<Json<Plane>, Problem> {
    let query: PlaneQuery = parse(&body)?;
    let plane = server.work(move |_| plane::plane(&query)).await?;
    plane.map(Json).map_err(|error| no_curve(&error))
}

/// Reach and maximum speed of the drag over the block's height.
#[utoipa::path(post, path = "/api/magnetics/reach", tag = "calculator", request_body = ReachQuery,
    responses((status = 200, body = ReachCurve), OutOfRange, Unavailable))]
pub async fn reach(State(server): State<Arc<Server>>, WholeBody(body): WholeBody) -> Result<Json<ReachCurve>, Problem> {
    let query: ReachQuery = parse(&body)?;
    // Some tenths of a millisecond per height.
    let curve = server.work(move |_| curves::reach(&query)).await?;
    curve.map(Json).map_err(|error| no_curve(&error))
}

fn no_curve(error: &CurveError) -> Problem {
    let field = match error {
        CurveError::Range { field, .. } => field,
        CurveError::Count { .. } => "count",
    };
    Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", error.to_string()).field(field)
}

/// A block magnet; its axes are those of `base`.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct Magnet {
    #[schema(value_type = Numbers3)]
    size_m: [f64; 3],
    #[schema(value_type = Numbers3)]
    polarization_t: [f64; 3],
    #[schema(value_type = Numbers3)]
    position_m: [f64; 3],
}

/// Body of `POST /api/magnetics/field`.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({
    "magnet": {"size_m": [0.05, 0.025, 0.01], "polarization_t": [0.0, 0.0, 1.2], "position_m": [0.0, 0.0, 0.1]},
    "points_m": [[0.0, 0.0, 0.0]],
    "moment_a_m2": 0.01,
}))]
struct FieldRequest {
    magnet: Magnet,
    #[schema(value_type = Vec<Numbers3>, max_items = 10_000)]
    points_m: Vec<[f64; 3]>,
    #[schema(minimum = 0)]
    moment_a_m2: f64,
}

/// Definition of B inside the magnet.
const CONVENTION: &str = "b_t is the flux density B; inside the magnet B = mu0*H + J with the polarization J, a face counts \
                          as outside; force_n is m*grad|B| and no sphere fits where is_inside is true";

/// Answer of `POST /api/magnetics/field`: flux density, inside the magnet too, and the force on a
/// sphere of that moment, aligned with the field.
#[derive(Serialize, ToSchema)]
pub struct FieldAnswer {
    #[schema(value_type = Vec<Numbers3>)]
    b_t: Vec<[f64; 3]>,
    #[schema(value_type = Vec<Numbers3>)]
    force_n: Vec<[f64; 3]>,
    is_inside: Vec<bool>,
    convention: &'static str,
}

/// Flux density of a block magnet, and the force on a sphere.
#[utoipa::path(post, path = "/api/magnetics/field", tag = "calculator", request_body = FieldRequest,
    responses((status = 200, body = FieldAnswer), OutOfRange, Unavailable))]
pub async fn field(
    State(server): State<Arc<Server>>,
    WholeBody(body): WholeBody,
) -> Result<Json<FieldAnswer>, Problem> {
    server.work(move |_| fluxes(&body)).await?.map(Json)
}

fn fluxes(body: &[u8]) -> Result<FieldAnswer, Problem> {
    let request: FieldRequest = parse(body)?;
    limit("points_m", request.points_m.len())?;
    let magnet = &request.magnet;
    let block =
        Cuboid::new(Vector3::from(magnet.size_m) / 2.0, Vector3::from(magnet.polarization_t)).map_err(|error| {
            Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "bad_magnet", error.to_string()).field("magnet")
        })?;
    if request.moment_a_m2 < 0.0 {
        let detail = format!("moment_a_m2 is {}, it must not be negative", request.moment_a_m2);
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", detail).field("moment_a_m2"));
    }
    let relative = |point: &[f64; 3]| Vector3::from(*point) - Vector3::from(magnet.position_m);
    let points_m: Vec<_> = request.points_m.iter().map(relative).collect();
    let b_t: Vec<[f64; 3]> = block.fields_t(&points_m).into_iter().map(Into::into).collect();
    let force_n: Vec<[f64; 3]> =
        points_m.iter().map(|point| force::force_n(&block, point, request.moment_a_m2).into()).collect();
    let beyond = |i: &usize| b_t[*i].iter().chain(&force_n[*i]).any(|value| !value.is_finite());
    if let Some(index) = (0..points_m.len()).find(beyond) {
        let detail =
            format!("the numbers are too large or too small to compute with, at {:?}", request.points_m[index]);
        return Err(
            Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "not_finite", detail).field(&format!("points_m[{index}]"))
        );
    }
    let is_inside = points_m.iter().map(|point| block.contains(point)).collect();
    Ok(FieldAnswer { b_t, force_n, is_inside, convention: CONVENTION })
}

fn limit(field: &str, count: usize) -> Result<(), Problem> {
    if count <= BATCH_LIMIT {
        return Ok(());
    }
    let detail = format!("{field} has {count} items, the limit is {BATCH_LIMIT}");
    Err(Problem::new(StatusCode::PAYLOAD_TOO_LARGE, "too_many", detail).field(field))
}
