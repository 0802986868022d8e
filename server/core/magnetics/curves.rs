//! The pull on the bead as curves that a page can plot: over the offset from the block, and over its height.
//!
//! The block hangs in one of its three orientations above a bead on the table. Pulls are in units of the bead's
//! weight W.

use super::{
    cuboid::Cuboid,
    dipole::{self, BLOCK_REMANENCE_T, SPHERE_DIAMETER_M},
    force::{self, FARTHEST_M, Orientation},
};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

#[cfg(feature = "schema")]
use crate::schema::Numbers2;

/// Maximum number of points of a curve.
pub const POINTS_LIMIT: u32 = 2000;

/// Allowed friction coefficients.
const FRICTION: (f64, f64) = (0.0, 1e3);
/// Allowed viscous drag, N·s/m.
const DRAG_N_S_M: (f64, f64) = (1e-6, 1e3);
/// Step of the search for the largest value over the offset, m: a small part of the block.
const SCAN_STEP_M: f64 = 2e-3;

/// Why a query was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// A number is NaN or outside its range.
    #[error("{field} must be from {least} to {most}, not {value}")]
    Range {
        /// Name of the query's field.
        field: &'static str,
        /// The offending value, in the unit of its name.
        value: f64,
        /// Smallest allowed value.
        least: f64,
        /// Largest allowed value.
        most: f64,
    },
    /// The number of points is outside its range.
    #[error("count must be from 2 to {most}, not {value}")]
    Count {
        value: u32,
        /// Largest allowed value.
        most: u32,
    },
}

/// The derive does not accept constants as limits.
#[cfg(feature = "schema")]
fn direction() -> utoipa::openapi::schema::Object {
    use utoipa::openapi::schema::{ObjectBuilder, Type};
    let about = "Where the bead lies, from below the block's middle: along the block's x, turned toward its y.";
    let number = ObjectBuilder::new().schema_type(Type::Number).description(Some(about));
    number.minimum(Some(-TAU)).maximum(Some(TAU)).build()
}

/// Query of `pull`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct PullQuery {
    /// Orientation of the block.
    pub orientation: Orientation,
    /// Its lower face above the table, m: at least the bead's diameter.
    #[cfg_attr(feature = "schema", schema(minimum = 0.005, maximum = 0.5))]
    pub lower_face_height_m: f64,
    /// Direction of the bead from below the block's middle: from the block's x toward its y.
    #[cfg_attr(feature = "schema", schema(schema_with = direction))]
    pub direction_rad: f64,
    /// Coulomb's coefficient.
    #[cfg_attr(feature = "schema", schema(minimum = 0, maximum = 1000))]
    pub friction: f64,
    /// Maximum offset, m.
    #[cfg_attr(feature = "schema", schema(minimum = 0, maximum = 0.5))]
    pub farthest_m: f64,
    /// Number of evenly spaced offsets, starting at zero.
    #[cfg_attr(feature = "schema", schema(minimum = 2, maximum = 2000))]
    pub count: u32,
}

/// The pull on a bead over its horizontal offset; every array has one entry per offset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
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
    #[cfg_attr(feature = "schema", schema(value_type = Option<Numbers2>))]
    pub capture_m: Option<(f64, f64)>,
}

/// The pull over the offset.
///
/// # Errors
/// [`CurveError`], naming the field and its value.
pub fn pull(query: &PullQuery) -> Result<PullCurve, CurveError> {
    let PullQuery { orientation, lower_face_height_m, direction_rad, friction, farthest_m, count } = *query;
    in_range("lower_face_height_m", lower_face_height_m, (SPHERE_DIAMETER_M, FARTHEST_M))?;
    in_range("direction_rad", direction_rad, (-TAU, TAU))?;
    in_range("friction", friction, FRICTION)?;
    in_range("farthest_m", farthest_m, (0.0, FARTHEST_M))?;
    let offset_m = evenly(0.0, farthest_m, count)?;
    let view = View::new(orientation, lower_face_height_m, direction_rad);
    let pulls: Vec<Pull> = offset_m.iter().map(|&offset_m| view.pull(offset_m)).collect();
    Ok(PullCurve {
        lift_ratio: pulls.iter().map(|pull| pull.lift_ratio).collect(),
        lateral_ratio: pulls.iter().map(|pull| pull.lateral_ratio).collect(),
        weight_ratio: pulls.iter().map(|pull| 1.0 - pull.lift_ratio).collect(),
        is_lifted: pulls.iter().map(Pull::is_lifted).collect(),
        drag_ratio: pulls.iter().map(|pull| pull.drag_ratio(friction)).collect(),
        capture_m: force::capture_interval_m(orientation, lower_face_height_m, friction, direction_rad),
        offset_m,
    })
}

/// Query of `reach`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct ReachQuery {
    /// Orientation of the block.
    pub orientation: Orientation,
    /// Minimum height of its lower face above the table, m: at least the bead's diameter.
    #[cfg_attr(feature = "schema", schema(minimum = 0.005, maximum = 0.5))]
    pub lowest_m: f64,
    /// Maximum height, m.
    #[cfg_attr(feature = "schema", schema(minimum = 0.005, maximum = 0.5))]
    pub highest_m: f64,
    /// Direction of the bead from below the block's middle: from the block's x toward its y.
    #[cfg_attr(feature = "schema", schema(schema_with = direction))]
    pub direction_rad: f64,
    /// Coulomb's coefficient.
    #[cfg_attr(feature = "schema", schema(minimum = 0, maximum = 1000))]
    pub friction: f64,
    /// Viscous drag on the bead, N·s/m; not zero, since without drag the speed is unlimited.
    #[cfg_attr(feature = "schema", schema(minimum = 0.000001, maximum = 1000))]
    pub drag_n_s_m: f64,
    /// Number of heights, evenly spaced.
    #[cfg_attr(feature = "schema", schema(minimum = 2, maximum = 2000))]
    pub count: u32,
}

/// Reach and speed of the drag over the block's height; every array has one entry per height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
pub struct ReachCurve {
    /// Lower face above the table, m.
    pub lower_face_height_m: Vec<f64>,
    /// Offsets `(inner_m, outer_m)` between which a bead is dragged, of `force::capture_interval_m`.
    #[cfg_attr(feature = "schema", schema(value_type = Vec<Option<Numbers2>>))]
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

/// Reach, speed and lift over the height.
///
/// # Errors
/// [`CurveError`], naming the field and its value.
pub fn reach(query: &ReachQuery) -> Result<ReachCurve, CurveError> {
    let ReachQuery { orientation, lowest_m, highest_m, direction_rad, friction, drag_n_s_m, count } = *query;
    in_range("lowest_m", lowest_m, (SPHERE_DIAMETER_M, FARTHEST_M))?;
    in_range("highest_m", highest_m, (lowest_m, FARTHEST_M))?;
    in_range("direction_rad", direction_rad, (-TAU, TAU))?;
    in_range("friction", friction, FRICTION)?;
    in_range("drag_n_s_m", drag_n_s_m, DRAG_N_S_M)?;
    let lower_face_height_m = evenly(lowest_m, highest_m, count)?;
    let views = || lower_face_height_m.iter().map(|&height_m| View::new(orientation, height_m, direction_rad));
    Ok(ReachCurve {
        capture_m: lower_face_height_m
            .iter()
            .map(|&height_m| force::capture_interval_m(orientation, height_m, friction, direction_rad))
            .collect(),
        lift_ratio: views().map(|view| view.pull(0.0).lift_ratio).collect(),
        greatest_lift_ratio: views().map(|view| view.greatest(|pull| pull.lift_ratio)).collect(),
        largest_speed_m_s: views().map(|view| view.largest_speed_m_s(friction, drag_n_s_m)).collect(),
        lift_off_m: force::lift_off_height_m(orientation) - force::half_height_m(orientation),
        lower_face_height_m,
    })
}

/// The pull on the bead in units of its weight.
struct Pull {
    lift_ratio: f64,
    lateral_ratio: f64,
}

impl Pull {
    fn is_lifted(&self) -> bool {
        self.lift_ratio >= 1.0
    }

    /// What friction can hold, in weights; not above zero where the bead lifts off.
    fn held_ratio(&self, friction: f64) -> f64 {
        friction * (1.0 - self.lift_ratio)
    }

    fn drag_ratio(&self, friction: f64) -> Option<f64> {
        let held_ratio = self.held_ratio(friction);
        (held_ratio > 0.0).then(|| self.lateral_ratio / held_ratio)
    }
}

/// A block at a height, and beads in one direction from it.
struct View {
    block: Cuboid,
    center_height_m: f64,
    direction: [f64; 2],
}

impl View {
    fn new(orientation: Orientation, lower_face_height_m: f64, direction_rad: f64) -> Self {
        let block = force::block(orientation, BLOCK_REMANENCE_T);
        let (sin, cos) = direction_rad.sin_cos();
        Self { block, center_height_m: lower_face_height_m + block.half_size_m.z, direction: [cos, sin] }
    }

    fn pull(&self, offset_m: f64) -> Pull {
        let offset_m = self.direction.map(|part| part * offset_m);
        let (lateral_n, up_n) = force::pull_n(&self.block, offset_m, self.center_height_m);
        Pull { lift_ratio: up_n / dipole::weight_n(), lateral_ratio: lateral_n / dipole::weight_n() }
    }

    /// The largest `value` over the offset.
    fn greatest(&self, value: impl Fn(&Pull) -> f64) -> f64 {
        let value = |offset_m: f64| value(&self.pull(offset_m));
        let steps = (FARTHEST_M / SCAN_STEP_M).round() as u32;
        let scanned = (0..=steps).map(|k| SCAN_STEP_M * f64::from(k)).map(|offset_m| (value(offset_m), offset_m));
        let (found, at_m) =
            scanned.fold((f64::NEG_INFINITY, 0.0), |best, next| if next.0 > best.0 { next } else { best });
        // Between its neighbours there is one maximum. Each step removes the third that cannot contain it.
        let (mut low_m, mut high_m) = ((at_m - SCAN_STEP_M).max(0.0), at_m + SCAN_STEP_M);
        for _ in 0..40 {
            let third_m = (high_m - low_m) / 3.0;
            if value(low_m + third_m) < value(high_m - third_m) {
                low_m += third_m;
            } else {
                high_m -= third_m;
            }
        }
        found.max(value(0.5 * (low_m + high_m)))
    }

    fn largest_speed_m_s(&self, friction: f64, drag_n_s_m: f64) -> Option<f64> {
        let spare = |pull: &Pull| {
            if pull.is_lifted() { f64::NEG_INFINITY } else { pull.lateral_ratio - pull.held_ratio(friction) }
        };
        let spare_n = self.greatest(spare) * dipole::weight_n();
        (spare_n > 0.0).then_some(spare_n / drag_n_s_m)
    }
}

/// NaN is in no range.
pub(super) fn in_range(field: &'static str, value: f64, (least, most): (f64, f64)) -> Result<(), CurveError> {
    if (least..=most).contains(&value) { Ok(()) } else { Err(CurveError::Range { field, value, least, most }) }
}

/// `count` numbers from `first` to `last`.
fn evenly(first: f64, last: f64, count: u32) -> Result<Vec<f64>, CurveError> {
    if !(2..=POINTS_LIMIT).contains(&count) {
        return Err(CurveError::Count { value: count, most: POINTS_LIMIT });
    }
    let step = (last - first) / f64::from(count - 1);
    Ok((0..count).map(|k| first + step * f64::from(k)).collect())
}

#[cfg(test)]
mod tests;
