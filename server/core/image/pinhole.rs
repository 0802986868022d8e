//! A camera above the table: its pose, and the conversion between image and table.

use nalgebra::{Point2, Point3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// Pose of a camera relative to the tool: it turns with the tool about the vertical, and does not tilt with it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraMount {
    /// Optical centre above the table.
    pub height_m: f64,
    /// From the tool's axis to the optical centre, along x and y of a tool that is not turned, which are those of `base`.
    pub offset_m: [f64; 2],
    /// Tilt of the optical axis from straight down toward +x and +y. Its direction is
    /// (tan `tilt_rad[0]`, tan `tilt_rad[1]`, −1).
    pub tilt_rad: [f64; 2],
    /// Angle across the square image.
    pub field_of_view_rad: f64,
    /// Whether the magnet is visible in the image, as in front of a real camera.
    pub sees_magnet: bool,
}

impl Default for CameraMount {
    /// Specification §3: .30 m above the table, over the tool, straight down, .20 m of table across.
    fn default() -> Self {
        // 36.87°, a round number that gives .20 m to a micrometre.
        let field_of_view_rad = 0.643_502_895_21;
        Self { height_m: 0.30, offset_m: [0.0; 2], tilt_rad: [0.0; 2], field_of_view_rad, sees_magnet: false }
    }
}

impl CameraMount {
    /// The camera of a tool at this point that is turned about the vertical.
    pub fn over(&self, tool_m: Point2<f64>, turn_rad: f64) -> Pinhole {
        let [x_m, y_m] = self.offset_m;
        let (sin, cos) = turn_rad.sin_cos();
        let position_m = [tool_m.x + (x_m * cos - y_m * sin), tool_m.y + (x_m * sin + y_m * cos), self.height_m];
        Pinhole { position_m, tilt_rad: self.tilt_rad, turn_rad, field_of_view_rad: self.field_of_view_rad }
    }
}

/// A pinhole camera with a square image, +y up. Positions in the image are relative to its centre, right and up, with 1
/// at the edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pinhole {
    /// Optical centre in `base`.
    pub position_m: [f64; 3],
    /// See [`CameraMount::tilt_rad`], before it is turned.
    pub tilt_rad: [f64; 2],
    /// Turn about the vertical.
    #[serde(default)]
    pub turn_rad: f64,
    /// Angle across the image.
    pub field_of_view_rad: f64,
}

impl Pinhole {
    /// Unit vectors of `base` to the right and up in the image, and along the optical axis.
    pub fn axes(&self) -> [Vector3<f64>; 3] {
        let [x, y] = self.tilt_rad.map(f64::tan);
        let forward = Vector3::new(x, y, -1.0).normalize();
        let right = forward.cross(&Vector3::y()).normalize();
        [right, right.cross(&forward), forward].map(|axis| turned(axis, self.turn_rad))
    }

    /// From the foot to where the optical axis meets the table, for a camera at height 1.
    pub fn lean(&self) -> Vector2<f64> {
        let [x, y] = self.tilt_rad.map(f64::tan);
        turned(Vector3::new(x, y, 0.0), self.turn_rad).xy()
    }

    /// Tangent of half the field of view.
    pub fn tangent(&self) -> f64 {
        (0.5 * self.field_of_view_rad).tan()
    }

    /// Optical centre.
    pub fn center_m(&self) -> Point3<f64> {
        Point3::from(self.position_m)
    }

    /// The table point below the optical centre; wall tops appear displaced away from it.
    pub fn foot_m(&self) -> Point2<f64> {
        self.center_m().xy()
    }

    /// Position of a point in the image; `None` behind the camera.
    pub fn image_from_point(&self, point_m: Point3<f64>) -> Option<Vector2<f64>> {
        let [right, up, forward] = self.axes();
        let ray = point_m - self.center_m();
        let depth_m = forward.dot(&ray);
        (depth_m > 0.0).then(|| Vector2::new(right.dot(&ray), up.dot(&ray)) / (depth_m * self.tangent()))
    }

    /// Takes (x, y, 1) on the table, in metres, to (column, row, 1) times a factor in a square picture: the homography
    /// that [`Self::image_from_point`] is for points of the table.
    pub fn picture_from_table(&self, width_px: u32) -> [[f64; 3]; 3] {
        let [right, up, forward] = self.axes();
        let half_px = 0.5 * f64::from(width_px);
        let scale_px = half_px / self.tangent();
        let center = self.center_m().coords;
        let rows = [forward * half_px + right * scale_px, forward * half_px - up * scale_px, forward];
        rows.map(|axis| [axis.x, axis.y, -axis.dot(&center)])
    }

    /// The point of the table (z = 0) at a place of the image; `None` at or above the horizon.
    pub fn table_from_image(&self, place: Vector2<f64>) -> Option<Point2<f64>> {
        let [right, up, forward] = self.axes();
        let ray = forward + (right * place.x + up * place.y) * self.tangent();
        let per_metre = self.position_m[2] / -ray.z;
        (ray.z < 0.0).then(|| self.foot_m() + ray.xy() * per_metre)
    }

    /// Corners of the table area in view, counter-clockwise from the lower left of the image; `None` if the horizon is
    /// in view.
    pub fn table_corners_m(&self) -> Option<[Point2<f64>; 4]> {
        let corner = |x, y| self.table_from_image(Vector2::new(x, y));
        Some([corner(-1.0, -1.0)?, corner(1.0, -1.0)?, corner(1.0, 1.0)?, corner(-1.0, 1.0)?])
    }
}

/// A direction turned about the vertical.
fn turned(axis: Vector3<f64>, turn_rad: f64) -> Vector3<f64> {
    let (sin, cos) = turn_rad.sin_cos();
    Vector3::new(axis.x * cos - axis.y * sin, axis.x * sin + axis.y * cos, axis.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_default_camera_sees_20_cm_of_table_below_the_tool() {
        let mount = CameraMount::default();
        let corners = mount.over(Point2::new(0.05, -0.3), 0.0).table_corners_m().unwrap();
        let expected = [(-0.05, -0.4), (0.15, -0.4), (0.15, -0.2), (-0.05, -0.2)];
        for (corner, (x, y)) in corners.iter().zip(expected) {
            assert!((corner - Point2::new(x, y)).norm() < 1e-6, "{corner}");
        }
    }

    #[test]
    fn a_tilted_camera_points_along_its_tilt() {
        let mount = CameraMount { offset_m: [0.08, -0.02], tilt_rad: [-0.2, 0.1], ..CameraMount::default() };
        let camera = mount.over(Point2::new(0.1, -0.3), 0.0);
        let middle = camera.table_from_image(Vector2::zeros()).unwrap();
        let expected = Point2::new(0.18 - 0.3 * 0.2_f64.tan(), -0.32 + 0.3 * 0.1_f64.tan());
        assert!((middle - expected).norm() < 1e-15);
        // Up in the image is +y and right is +x, without rotation.
        let above = camera.table_from_image(Vector2::new(0.0, 0.5)).unwrap() - middle;
        let beside = camera.table_from_image(Vector2::new(0.5, 0.0)).unwrap() - middle;
        assert!(above.y > 0.0 && beside.x > 0.0 && camera.axes()[0].y == 0.0);
        let level = Pinhole { tilt_rad: [1.4, 0.0], ..camera };
        assert_eq!(level.table_from_image(Vector2::new(1.0, 0.0)), None);
        assert_eq!(level.table_corners_m(), None);
        assert_eq!(camera.image_from_point(Point3::new(0.18, -0.32, 0.4)), None);
    }

    proptest! {
        #[test]
        fn image_and_table_conversions_are_inverse(
            tilt_rad in prop::array::uniform2(-0.4..0.4), turn_rad in -3.0..3.0, field_of_view_rad in 0.05..1.2,
            (x, y) in (-1.0..1.0, -1.0..1.0), height_m in 0.1..1.0,
        ) {
            let camera = Pinhole { position_m: [0.2, -0.4, height_m], tilt_rad, turn_rad, field_of_view_rad };
            let place = Vector2::new(x, y);
            let point = camera.table_from_image(place).unwrap();
            let back = camera.image_from_point(Point3::new(point.x, point.y, 0.0)).unwrap();
            prop_assert!((back - place).norm() < 1e-9);
            let [right, up, forward] = camera.axes();
            prop_assert!((right.cross(&up) + forward).norm() < 1e-12);
        }
    }
}
