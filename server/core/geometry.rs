//! Frames, poses and plane shapes, shared by all other modules.
//!
//! Everything is in the UR5's `base` frame unless a name says otherwise: x right, +y away from the user,
//! z up, origin on the table under joint 1. Metres and radians.

mod band;

#[cfg(feature = "schema")]
use crate::schema::Numbers2;
pub use band::Band;
pub use nalgebra::{
    Isometry3, Matrix3, Matrix6, Point2, Point3, Translation3, UnitQuaternion, Vector2, Vector3, Vector6,
};
use serde::{Deserialize, Serialize};

/// A filled polygon with holes, in metres.
///
/// `exterior` runs counter-clockwise and each hole clockwise; no ring repeats its first point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
pub struct Polygon {
    /// Outer ring, `[x_m, y_m]` for each vertex.
    #[cfg_attr(feature = "schema", schema(value_type = Vec<Numbers2>))]
    pub exterior: Vec<[f64; 2]>,
    /// Inner rings.
    #[cfg_attr(feature = "schema", schema(value_type = Vec<Vec<Numbers2>>))]
    pub holes: Vec<Vec<[f64; 2]>>,
}

impl Polygon {
    /// All rings, the exterior first.
    pub fn rings(&self) -> impl Iterator<Item = &[[f64; 2]]> {
        std::iter::once(self.exterior.as_slice()).chain(self.holes.iter().map(Vec::as_slice))
    }
}

/// An axis-aligned rectangle, in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
pub struct Rect {
    /// Smallest x.
    pub x_min_m: f64,
    /// Largest x.
    pub x_max_m: f64,
    /// Smallest y.
    pub y_min_m: f64,
    /// Largest y.
    pub y_max_m: f64,
}

impl Rect {
    /// Whether `point` is inside or on the border.
    pub fn contains(&self, point: Point2<f64>) -> bool {
        (self.x_min_m..=self.x_max_m).contains(&point.x) && (self.y_min_m..=self.y_max_m).contains(&point.y)
    }

    /// The point inside that is nearest to `point`.
    pub fn nearest(&self, point: Point2<f64>) -> Point2<f64> {
        Point2::new(point.x.clamp(self.x_min_m, self.x_max_m), point.y.clamp(self.y_min_m, self.y_max_m))
    }

    /// Width and height.
    pub fn size_m(&self) -> Vector2<f64> {
        Vector2::new(self.x_max_m - self.x_min_m, self.y_max_m - self.y_min_m)
    }

    pub fn center_m(&self) -> Point2<f64> {
        Point2::new(0.5 * (self.x_min_m + self.x_max_m), 0.5 * (self.y_min_m + self.y_max_m))
    }
}
