//! Projections: from `base` to the device's clip space (x right, y up, depth 0 to 1).

use nalgebra::{Matrix4, Vector4};

use ferry_core::geometry::{Point3, Rect, Vector2, Vector3};
use ferry_core::image::Pinhole;

/// Near plane, as a share of the camera's height above the table.
const NEAR: f64 = 0.02;
/// Distance of the far plane behind the farthest table point in view of the controllers' camera.
const BEYOND_M: f64 = 0.05;

/// Iterations that centre the image; each shrinks the error several times.
const CENTERING_ROUNDS: usize = 8;

/// Projection of a camera that sees only the table, as checked by [`super::check_mount`].
pub(super) fn pinhole(camera: &Pinhole) -> Matrix4<f64> {
    let [right, up, forward] = camera.axes();
    let center = camera.center_m();
    let height_m = center.z;
    let corners = camera.table_corners_m().unwrap_or([center.xy(); 4]);
    let depths_m = corners.map(|corner| forward.dot(&(Point3::new(corner.x, corner.y, 0.0) - center)));
    let (near, far) = (NEAR * height_m, depths_m.into_iter().fold(height_m, f64::max) + BEYOND_M);
    let slope = far / (far - near);
    let zoom = 1.0 / camera.tangent();
    // Rows give clip x, y, z and w; w is the depth along the optical axis.
    let row = |axis: Vector3<f64>, scale: f64, offset: f64| {
        let scaled = axis * scale;
        [scaled.x, scaled.y, scaled.z, offset - scaled.dot(&center.coords)]
    };
    let rows = [row(right, zoom, 0.0), row(up, zoom, 0.0), row(forward, slope, -slope * near), row(forward, 1.0, 0.0)];
    Matrix4::from_fn(|row, column| rows[row][column])
}

/// Projection and position of a fixed scene camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    pub clip_from_base: Matrix4<f64>,
    /// Homogeneous: in a parallel view the fourth component is 0 and the rest is the direction to the camera.
    pub eye_m: Vector4<f64>,
}

/// Height above the table, and depth below it, that the parallel view covers.
const ABOVE_M: f64 = 1.0;

/// Looks straight down at `area` with `margin_m` around it, +y up, in parallel projection. If the image's `aspect`
/// (width over height) differs from the area's, the longer side shows more.
pub(super) fn parallel_down(area: &Rect, margin_m: f64, aspect: f64) -> Projection {
    let size_m = area.size_m() + Vector2::repeat(2.0 * margin_m);
    let half_y_m = 0.5 * size_m.y.max(size_m.x / aspect);
    let (half_x_m, middle) = (half_y_m * aspect, area.center_m());
    let rows = [
        [1.0 / half_x_m, 0.0, 0.0, -middle.x / half_x_m],
        [0.0, 1.0 / half_y_m, 0.0, -middle.y / half_y_m],
        [0.0, 0.0, -0.5 / ABOVE_M, 0.5],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let clip_from_base = Matrix4::from_fn(|row, column| rows[row][column]);
    Projection { clip_from_base, eye_m: Vector4::z() }
}

/// Looks from direction `toward_eye` at the middle of `bounds`, from the smallest distance at which all of them are
/// inside an image of `aspect` (width over height). `field_of_view_rad` spans the image's shorter side; the share
/// `margin` stays free on every side.
pub(super) fn perspective_around(
    bounds: &[Point3<f64>],
    toward_eye: Vector3<f64>,
    field_of_view_rad: f64,
    margin: f64,
    aspect: f64,
) -> Projection {
    let (mut middle, radius) = ball_around(bounds);
    let [right, up, back] = axes(toward_eye);
    let tangent = (0.5 * field_of_view_rad).tan();
    let (tangent_x, tangent_y) = (tangent * aspect.max(1.0), tangent / aspect.min(1.0));
    let filled = [tangent_x, tangent_y].map(|tangent| (1.0 - 2.0 * margin) * tangent);
    let mut distance = distance_to_hold(bounds, middle, [right, up, back], filled);
    for _ in 0..CENTERING_ROUNDS {
        // Near points appear larger, so the middle of the image is not the middle of the bounds.
        for axis in [right, up] {
            let seen = bounds.iter().map(|point| {
                let p = point - middle;
                axis.dot(&p) / (distance - back.dot(&p))
            });
            let (min, max) = seen.fold((f64::MAX, f64::MIN), |(min, max), at| (min.min(at), max.max(at)));
            middle += axis * (0.5 * (min + max) * distance);
        }
        distance = distance_to_hold(bounds, middle, [right, up, back], filled);
    }
    let eye_m = middle + back * distance;
    let (near, far) = (0.1 * distance, 4.0 * (distance + radius));
    let slope = far / (far - near);
    let row = |axis: Vector3<f64>, scale: f64, offset: f64| {
        let scaled = axis * scale;
        [scaled.x, scaled.y, scaled.z, offset - scaled.dot(&eye_m.coords)]
    };
    let rows = [
        row(right, 1.0 / tangent_x, 0.0),
        row(up, 1.0 / tangent_y, 0.0),
        row(back, -slope, -slope * near),
        row(back, -1.0, 0.0),
    ];
    Projection { clip_from_base: Matrix4::from_fn(|row, column| rows[row][column]), eye_m: eye_m.to_homogeneous() }
}

/// Distance of the camera from `middle` at which all `bounds` are within the tangents to the right and up.
fn distance_to_hold(
    bounds: &[Point3<f64>],
    middle: Point3<f64>,
    [right, up, back]: [Vector3<f64>; 3],
    [tangent_x, tangent_y]: [f64; 2],
) -> f64 {
    let needed = bounds.iter().map(|point| {
        let p = point - middle;
        let aside = (right.dot(&p).abs() / tangent_x).max(up.dot(&p).abs() / tangent_y);
        back.dot(&p) + aside
    });
    needed.fold(f64::MIN, f64::max)
}

/// A parallel projection along the light that contains all `bounds`, for the shadow map.
pub(super) fn parallel_around(bounds: &[Point3<f64>], toward_light: Vector3<f64>) -> Matrix4<f64> {
    let (middle, radius) = ball_around(bounds);
    let [right, up, back] = axes(toward_light);
    let row = |axis: Vector3<f64>, scale: f64, offset: f64| {
        let at_middle = axis.dot(&middle.coords);
        [axis.x * scale, axis.y * scale, axis.z * scale, offset - at_middle * scale]
    };
    let rows = [
        row(right, 1.0 / radius, 0.0),
        row(up, 1.0 / radius, 0.0),
        row(back, -0.5 / radius, 0.5),
        [0.0, 0.0, 0.0, 1.0],
    ];
    Matrix4::from_fn(|row, column| rows[row][column])
}

/// Right, up and back vectors of a camera that looks against `toward_eye`, which must not be vertical.
fn axes(toward_eye: Vector3<f64>) -> [Vector3<f64>; 3] {
    let back = toward_eye.normalize();
    let right = Vector3::z().cross(&back).normalize();
    [right, back.cross(&right), back]
}

/// A ball that contains all points: the middle of their bounding box and the largest distance from it.
fn ball_around(points: &[Point3<f64>]) -> (Point3<f64>, f64) {
    let mut low = points[0];
    let mut high = points[0];
    for point in points {
        low = low.inf(point);
        high = high.sup(point);
    }
    let middle = nalgebra::center(&low, &high);
    let radius = points.iter().map(|point| (point - middle).norm()).fold(0.0, f64::max);
    (middle, radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ferry_core::geometry::Point2;
    use ferry_core::image::CameraMount;

    #[test]
    fn the_pinhole_puts_table_metres_on_pixels() {
        let clip_from_base = pinhole(&CameraMount::default().over(Point2::new(0.1, -0.3), 0.0));
        let ndc = |x, y, z| clip_from_base.transform_point(&Point3::new(x, y, z));
        assert!((ndc(0.2, -0.3, 0.0).xy() - nalgebra::point![1.0, 0.0]).norm() < 1e-5);
        assert!((ndc(0.1, -0.2, 0.0).xy() - nalgebra::point![0.0, 1.0]).norm() < 1e-5);
        // Half-way up to the camera everything appears twice as large.
        assert!((ndc(0.15, -0.3, 0.15).xy() - nalgebra::point![1.0, 0.0]).norm() < 1e-5);
        assert!(ndc(0.1, -0.3, 0.01).z < ndc(0.1, -0.3, 0.0).z);
        assert!((ndc(0.1, -0.3, 0.3 - 0.006).z).abs() < 1e-12);
    }

    #[test]
    fn a_tilted_pinhole_projects_like_image_from_point() {
        let mount = CameraMount { tilt_rad: [0.2, -0.3], offset_m: [0.05, 0.1], ..CameraMount::default() };
        let camera = mount.over(Point2::new(0.1, -0.3), 0.0);
        let clip_from_base = pinhole(&camera);
        for (x, y, z) in [(0.2, -0.3, 0.0), (0.1, -0.25, 0.05), (0.3, -0.4, 0.005)] {
            let point = Point3::new(x, y, z);
            let ndc = clip_from_base.transform_point(&point);
            assert!((ndc.xy().coords - camera.image_from_point(point).unwrap()).norm() < 1e-12);
        }
        for corner in camera.table_corners_m().unwrap() {
            let ndc = clip_from_base.transform_point(&Point3::new(corner.x, corner.y, 0.0));
            assert!((ndc.x.abs() - 1.0).abs() < 1e-12 && (ndc.y.abs() - 1.0).abs() < 1e-12);
            assert!((0.0..1.0).contains(&ndc.z), "{ndc}");
        }
    }

    #[test]
    fn all_bounds_are_in_the_picture_at_any_aspect() {
        let bounds = [Point3::new(-0.3, -0.54, 0.0), Point3::new(0.28, -0.21, 0.0), Point3::new(0.0, 0.0, 0.6)];
        for aspect in [0.4, 1.0, 16.0 / 9.0] {
            let toward_eye = Vector3::new(0.4, -1.0, 0.8);
            let view = perspective_around(&bounds, toward_eye, 0.6, 0.05, aspect);
            let mut touches = false;
            for point in &bounds {
                let ndc = view.clip_from_base.transform_point(point);
                let max = ndc.x.abs().max(ndc.y.abs());
                assert!(max <= 0.9 + 1e-9, "{aspect}: {ndc}");
                assert!((0.0..1.0).contains(&ndc.z));
                touches |= max > 0.9 - 1e-9;
            }
            assert!(touches, "the picture is larger than needed at {aspect}");
        }
    }

    #[test]
    fn the_plan_contains_its_area_at_one_scale() {
        let area = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
        for aspect in [0.4, 1.0, 16.0 / 9.0] {
            let plan = parallel_down(&area, 0.01, aspect);
            let ndc = |x, y, z| plan.clip_from_base.transform_point(&Point3::new(x, y, z));
            let corner = ndc(0.29, -0.2, 0.0);
            assert!(corner.x.max(corner.y) <= 1.0 + 1e-12 && corner.x.max(corner.y) > 1.0 - 1e-12);
            let (right, up) =
                (ndc(0.1, -0.3, 0.0).x - ndc(0.0, -0.3, 0.0).x, ndc(0.0, -0.3, 0.0).y - ndc(0.0, -0.4, 0.0).y);
            assert!((right * aspect - up).abs() < 1e-12);
            assert!(ndc(0.0, -0.3, 0.1).z < ndc(0.0, -0.3, 0.0).z);
        }
    }

    #[test]
    fn the_shadow_map_contains_its_bounds() {
        let bounds = [Point3::new(-0.3, -0.5, 0.0), Point3::new(0.3, 0.1, 0.6)];
        let clip_from_base = parallel_around(&bounds, Vector3::new(-0.4, -0.3, 1.0));
        for point in &bounds {
            let ndc = clip_from_base.transform_point(point);
            assert!(ndc.x.abs() <= 1.0 && ndc.y.abs() <= 1.0 && (0.0..=1.0).contains(&ndc.z));
        }
    }
}
