//! Queries and answers for the magnet's curves and fields.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;
use utoipa::openapi::schema::{Object, ObjectBuilder, Type};

use ferry_core::magnetics::force::Orientation;
use ferry_core::magnetics::{curves, plane};
use ferry_core::schema::Numbers2;

/// The derive does not accept constants as limits.
fn direction() -> Object {
    let about = "Where the bead lies, from below the block's middle: along the block's x, turned toward its y.";
    let number = ObjectBuilder::new().schema_type(Type::Number).description(Some(about));
    number.minimum(Some(-TAU)).maximum(Some(TAU)).build()
}

/// Query of `pull`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PullQuery {
    /// Orientation of the block.
    pub orientation: Orientation,
    /// Its lower face above the table, m: at least the bead's diameter.
    #[schema(minimum = 0.005, maximum = 0.5)]
    pub lower_face_height_m: f64,
    /// Direction of the bead from below the block's middle: from the block's x toward its y.
    #[schema(schema_with = direction)]
    pub direction_rad: f64,
    /// Coulomb's coefficient.
    #[schema(minimum = 0, maximum = 1000)]
    pub friction: f64,
    /// Maximum offset, m.
    #[schema(minimum = 0, maximum = 0.5)]
    pub farthest_m: f64,
    /// Number of evenly spaced offsets, starting at zero.
    #[schema(minimum = 2, maximum = 2000)]
    pub count: u32,
}

impl From<PullQuery> for curves::PullQuery {
    fn from(value: PullQuery) -> Self {
        let PullQuery { orientation, lower_face_height_m, direction_rad, friction, farthest_m, count } = value;
        Self { orientation, lower_face_height_m, direction_rad, friction, farthest_m, count }
    }
}

/// The pull on a bead over its horizontal offset; every array has one entry per offset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct PullCurve {
    /// Offset from below the block's middle, m.
    pub offset_m: Vec<f64>,
    /// Fz/W: 1 lifts the bead.
    pub lift_ratio: Vec<f64>,
    /// Pull in the table's plane over W.
    pub lateral_ratio: Vec<f64>,
    /// (W − Fz)/W: the remaining weight.
    pub weight_ratio: Vec<f64>,
    /// Whether the bead lifts off because no weight remains.
    pub is_lifted: Vec<bool>,
    /// Pull in the table's plane divided by the maximum friction, friction·(W − Fz): from 1 on the bead
    /// follows. `None` if there is no friction, because the coefficient is zero or the bead lifts off.
    pub drag_ratio: Vec<Option<f64>>,
    /// Offsets `(inner_m, outer_m)` between which the bead is dragged, of `force::capture_interval_m`.
    #[schema(value_type = Option<Numbers2>)]
    pub capture_m: Option<(f64, f64)>,
}

impl From<curves::PullCurve> for PullCurve {
    fn from(value: curves::PullCurve) -> Self {
        let curves::PullCurve { offset_m, lift_ratio, lateral_ratio, weight_ratio, is_lifted, drag_ratio, capture_m } =
            value;
        Self { offset_m, lift_ratio, lateral_ratio, weight_ratio, is_lifted, drag_ratio, capture_m }
    }
}

/// Query of `reach`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ReachQuery {
    /// Orientation of the block.
    pub orientation: Orientation,
    /// Minimum height of its lower face above the table, m: at least the bead's diameter.
    #[schema(minimum = 0.005, maximum = 0.5)]
    pub lowest_m: f64,
    /// Maximum height, m.
    #[schema(minimum = 0.005, maximum = 0.5)]
    pub highest_m: f64,
    /// Direction of the bead from below the block's middle: from the block's x toward its y.
    #[schema(schema_with = direction)]
    pub direction_rad: f64,
    /// Coulomb's coefficient.
    #[schema(minimum = 0, maximum = 1000)]
    pub friction: f64,
    /// Viscous drag on the bead, N·s/m; not zero, since without drag the speed is unlimited.
    #[schema(minimum = 0.000001, maximum = 1000)]
    pub drag_n_s_m: f64,
    /// Number of heights, evenly spaced.
    #[schema(minimum = 2, maximum = 2000)]
    pub count: u32,
}

impl From<ReachQuery> for curves::ReachQuery {
    fn from(value: ReachQuery) -> Self {
        let ReachQuery { orientation, lowest_m, highest_m, direction_rad, friction, drag_n_s_m, count } = value;
        Self { orientation, lowest_m, highest_m, direction_rad, friction, drag_n_s_m, count }
    }
}

/// Reach and speed of the drag over the block's height; every array has one entry per height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct ReachCurve {
    /// Lower face above the table, m.
    pub lower_face_height_m: Vec<f64>,
    /// Offsets `(inner_m, outer_m)` between which a bead is dragged, of `force::capture_interval_m`.
    #[schema(value_type = Vec<Option<Numbers2>>)]
    pub capture_m: Vec<Option<(f64, f64)>>,
    /// Fz/W right below the block's middle.
    pub lift_ratio: Vec<f64>,
    /// Maximum Fz/W over the offsets in the direction; 1 lifts the bead.
    pub greatest_lift_ratio: Vec<f64>,
    /// Maximum speed, m/s, at which a sliding bead can follow at a fixed offset in the direction: there
    /// the pull minus friction equals the drag. `None` if the pull never exceeds friction.
    pub largest_speed_m_s: Vec<Option<f64>>,
    /// Height of the lower face, m, below which a bead right below the block's middle lifts off. In C the
    /// lift is greatest beside the middle, where a bead lifts off a few tenths of a millimetre higher.
    pub lift_off_m: f64,
}

impl From<curves::ReachCurve> for ReachCurve {
    fn from(value: curves::ReachCurve) -> Self {
        let curves::ReachCurve {
            lower_face_height_m,
            capture_m,
            lift_ratio,
            greatest_lift_ratio,
            largest_speed_m_s,
            lift_off_m,
        } = value;
        Self { lower_face_height_m, capture_m, lift_ratio, greatest_lift_ratio, largest_speed_m_s, lift_off_m }
    }
}

/// Query of `plane`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneQuery {
    /// Orientation of the block.
    pub orientation: Orientation,
    /// Its lower face above the table, m: at least the bead's diameter.
    #[schema(minimum = 0.005, maximum = 0.5)]
    pub lower_face_height_m: f64,
    /// Half side of the square around the point below the block's middle, m, along the block's x and y.
    #[schema(minimum = 0.001, maximum = 0.5)]
    pub reach_m: f64,
    /// Number of points per row and column, evenly spaced, the first and last ones at the edges.
    #[schema(minimum = 2, maximum = 101)]
    pub count: u32,
}

impl From<PlaneQuery> for plane::PlaneQuery {
    fn from(value: PlaneQuery) -> Self {
        let PlaneQuery { orientation, lower_face_height_m, reach_m, count } = value;
        Self { orientation, lower_face_height_m, reach_m, count }
    }
}

/// The field in a square around the block: one entry per point, row by row from the minimum x and y.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Plane {
    /// |B|, T.
    pub field_t: Vec<f64>,
    /// Pull on the bead in the table's plane, N.
    #[schema(value_type = Vec<Numbers2>)]
    pub pull_n: Vec<[f64; 2]>,
}

impl From<plane::Plane> for Plane {
    fn from(value: plane::Plane) -> Self {
        let plane::Plane { field_t, pull_n } = value;
        Self { field_t, pull_n }
    }
}
