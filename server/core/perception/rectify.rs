//! Rectifies a tilted or turned camera's image to a view of the table from straight above (inverse perspective mapping: Mallot et
//! al. 1991, Biological Cybernetics 64, 177–185).

use super::Calibration;
use crate::geometry::{Point3, Vector3};
use crate::image::{GrayImage, Pinhole};

/// The largest square of the table around the optical axis that is completely in view, with as many pixels as the
/// image. The image of a camera that looks straight down and is not turned is returned
/// unchanged.
///
/// Each pixel is a copy of the nearest image pixel, so dark stays dark and bright stays bright; an edge moves by at
/// most half a pixel. The camera must see only the table, which is checked when the image is drawn.
pub(super) fn from_above(gray: GrayImage, pinhole: &Pinhole) -> (GrayImage, Calibration) {
    let size_px = gray.width_px;
    let [_, _, height_m] = pinhole.position_m;
    let foot_m = pinhole.foot_m();
    if pinhole.tilt_rad == [0.0; 2] && pinhole.turn_rad == 0.0 {
        let m_per_px = 2.0 * height_m * pinhole.tangent() / size_px as f64;
        return (gray, Calibration { center_m: foot_m, m_per_px, size_px, foot_m });
    }
    let [right, up, forward] = pinhole.axes();
    let center_m = foot_m + pinhole.lean() * height_m;
    let half_side_m = half_side_m(pinhole);
    let calibration = Calibration { center_m, m_per_px: 2.0 * half_side_m / size_px as f64, size_px, foot_m };
    let half_px = 0.5 * size_px as f64;
    let scale_px = half_px / pinhole.tangent();
    let mut pixels = Vec::with_capacity(size_px * size_px);
    for row in 0..size_px {
        for column in 0..size_px {
            let point = calibration.table_from_image(column as f64 + 0.5, row as f64 + 0.5);
            let ray = Vector3::new(point.x - foot_m.x, point.y - foot_m.y, -height_m);
            let per_depth = scale_px / forward.dot(&ray);
            // In view by the choice of the square, except for rounding at its corners.
            let at = |offset_px: f64| ((half_px + offset_px).max(0.0) as usize).min(size_px - 1);
            let (from_column, from_row) = (at(right.dot(&ray) * per_depth), at(-up.dot(&ray) * per_depth));
            pixels.push(gray.pixels[from_row * size_px + from_column]);
        }
    }
    (GrayImage { pixels, ..gray }, calibration)
}

/// Half the side of the square: along each diagonal, from the optical axis on the table to the edge of the view.
fn half_side_m(pinhole: &Pinhole) -> f64 {
    let [right, up, forward] = pinhole.axes();
    let tangent = pinhole.tangent();
    let depth_m = (Point3::from(pinhole.position_m).z) / -forward.z;
    let diagonals = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| Vector3::new(x, y, 0.0));
    let along = |diagonal: &Vector3<f64>| {
        // A point t along it is seen at t·a/(depth + t·b) of the tangent, with a to the right or up and b forward.
        let leaves = |axis: &Vector3<f64>| {
            let rate = axis.dot(diagonal).abs() - tangent * forward.dot(diagonal);
            if rate > 0.0 { tangent * depth_m / rate } else { f64::INFINITY }
        };
        leaves(&right).min(leaves(&up))
    };
    diagonals.iter().map(along).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point2, Vector2};
    use crate::image::CameraMount;
    use proptest::prelude::*;

    /// The camera's image of a pattern painted on the table.
    fn image(pinhole: &Pinhole, size_px: usize, is_dark: impl Fn(Point2<f64>) -> bool) -> GrayImage {
        let half = 0.5 * size_px as f64;
        let pixels = (0..size_px * size_px).map(|at| {
            let (column, row) = ((at % size_px) as f64 + 0.5, (at / size_px) as f64 + 0.5);
            let place = Vector2::new(column / half - 1.0, 1.0 - row / half);
            if is_dark(pinhole.table_from_image(place).unwrap()) { 30 } else { 220 }
        });
        GrayImage { width_px: size_px, height_px: size_px, pixels: pixels.collect() }
    }

    #[test]
    fn leaves_an_image_from_above_unchanged() {
        let pinhole = CameraMount { offset_m: [0.03, 0.0], ..CameraMount::default() }.over(Point2::new(0.1, -0.3), 0.0);
        let seen = image(&pinhole, 48, |p| p.x > 0.13);
        let (gray, calibration) = from_above(seen.clone(), &pinhole);
        assert_eq!(gray, seen);
        assert!((calibration.m_per_px - 0.2 / 48.0).abs() < 1e-7 && calibration.center_m == pinhole.foot_m());
    }

    proptest! {
        #[test]
        fn a_rectified_view_shows_the_table_at_its_place(
            tilt_rad in prop::array::uniform2(-0.4..0.4), field_of_view_rad in 0.1..1.2,
            turn_rad in prop_oneof![Just(0.0), -3.0..3.0],
            (edge, turn) in (-0.5..0.5, 0.0..std::f64::consts::TAU),
        ) {
            let mount = CameraMount { tilt_rad, field_of_view_rad, ..CameraMount::default() };
            let pinhole = mount.over(Point2::new(0.1, -0.3), turn_rad);
            let size_px = 96;
            let (_, known) = from_above(image(&pinhole, size_px, |_| false), &pinhole);
            // Half of the table is dark, up to a line across the square.
            let normal = Vector2::new(turn.cos(), turn.sin());
            let side_m = known.m_per_px * size_px as f64;
            let beyond_m = |p: Point2<f64>| -> f64 { normal.dot(&(p - known.center_m)) - edge * 0.5 * side_m };
            let (gray, _) = from_above(image(&pinhole, size_px, |p| beyond_m(p) > 0.0), &pinhole);
            // The largest size of an image pixel on the table, in each direction.
            let corners = pinhole.table_corners_m().unwrap();
            let sides_m = (0..4).map(|i| (corners[i] - corners[(i + 1) % 4]).norm());
            let coarsest_m = 2.0 * sides_m.fold(0.0, f64::max) / size_px as f64;
            for (at, level) in gray.pixels.iter().enumerate() {
                let p = known.table_from_image((at % size_px) as f64 + 0.5, (at / size_px) as f64 + 0.5);
                if beyond_m(p).abs() > coarsest_m {
                    prop_assert_eq!(*level < 100, beyond_m(p) > 0.0, "{}", p);
                }
            }
        }

        #[test]
        fn the_square_is_the_largest_in_view(
            tilt_rad in prop::array::uniform2(-0.4..0.4), turn_rad in -3.0..3.0, field_of_view_rad in 0.1..1.2,
        ) {
            let mount = CameraMount { tilt_rad, field_of_view_rad, ..CameraMount::default() };
            let pinhole = mount.over(Point2::new(0.1, -0.3), turn_rad);
            let half_m = half_side_m(&pinhole);
            let middle = pinhole.table_from_image(Vector2::zeros()).unwrap();
            let farthest = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| {
                let corner = middle + Vector2::new(x, y) * half_m;
                let place = pinhole.image_from_point(Point3::new(corner.x, corner.y, 0.0)).unwrap();
                place.x.abs().max(place.y.abs())
            });
            let farthest = farthest.into_iter().fold(0.0, f64::max);
            prop_assert!((farthest - 1.0).abs() < 1e-9, "{}", farthest);
        }
    }
}
