//! Conversion from pixels to the table.

use super::Calibration;
use super::dark::PixelRect;
use crate::geometry::Rect;

/// Ratio between the apparent distance of a wall's top from the camera's foot and the distance of the wall's foot, for
/// a pinhole `camera_height_m` above the table. Returns 1 if the wall is at least as high as the camera.
pub fn wall_spread(camera_height_m: f64, wall_height_m: f64) -> f64 {
    let spread = camera_height_m / (camera_height_m - wall_height_m);
    if spread.is_finite() { spread.max(1.0) } else { 1.0 }
}

impl PixelRect {
    /// The table area of these pixels, read at table height, in `base`.
    ///
    /// For dark pixels the result is conservative. A wall hides the place it covers, so the rectangle contains all of
    /// the wall's foot that is in view. It also contains the visible side or top beyond the foot, up to `wall_spread −
    /// 1` times the distance from the camera's foot: with the default camera 1.7 mm at the edge and 2.4 mm in the
    /// corners. Blocks of a quadtree add up to their smallest side. [`super::ObstacleMap`] removes the spread.
    pub fn on_table(&self, calibration: &Calibration) -> Rect {
        let (column, row) = (self.column_px as f64, self.row_px as f64);
        let upper_left = calibration.table_from_image(column, row);
        let lower_right = calibration.table_from_image(column + self.width_px as f64, row + self.height_px as f64);
        Rect { x_min_m: upper_left.x, x_max_m: lower_right.x, y_min_m: lower_right.y, y_max_m: upper_left.y }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point2, Vector2};
    use crate::perception::test_world::{seen_from, simple};
    use crate::perception::{Quadtree, QuadtreeParameters};
    use proptest::prelude::*;

    prop_compose! {
        fn calibrations()(
            x_m in -4.0..4.0, y_m in -4.0..4.0, span_m in 0.01..10.0, size_px in 1usize..4096,
        ) -> Calibration {
            let center_m = Point2::new(x_m, y_m);
            Calibration { center_m, m_per_px: span_m / size_px as f64, size_px, foot_m: center_m }
        }
    }

    proptest! {
        #[test]
        fn pixels_survive_conversion_to_metres_and_back(
            calibration in calibrations(), across in 0.0..1.0, down in 0.0..1.0,
        ) {
            let size_px = calibration.size_px as f64;
            let (column_px, row_px) = (across * size_px, down * size_px);
            let back = calibration.image_from_table(calibration.table_from_image(column_px, row_px));
            prop_assert!((back.0 - column_px).abs() < 1e-6 && (back.1 - row_px).abs() < 1e-6, "{back:?}");
        }

        #[test]
        fn places_survive_conversion_to_pixels_and_back(
            calibration in calibrations(), x_m in -4.0..4.0, y_m in -4.0..4.0,
        ) {
            let point = Point2::new(x_m, y_m);
            let (column_px, row_px) = calibration.image_from_table(point);
            prop_assert!((calibration.table_from_image(column_px, row_px) - point).norm() < 1e-12);
        }

        #[test]
        fn one_pixel_right_is_plus_x_and_one_down_is_minus_y(
            calibration in calibrations(), column_px in 0.0..4096.0, row_px in 0.0..4096.0,
        ) {
            let at = calibration.table_from_image(column_px, row_px);
            let step = calibration.table_from_image(column_px + 1.0, row_px + 1.0) - at;
            let expected = Vector2::new(calibration.m_per_px, -calibration.m_per_px);
            // Coordinates of coarse pixels can be kilometres.
            prop_assert!((step - expected).norm() < 1e-9);
            // The image centre is the centre of the table area in view.
            let half_px = calibration.size_px as f64 / 2.0;
            prop_assert_eq!(calibration.table_from_image(half_px, half_px), calibration.center_m);
        }

        #[test]
        fn a_rectangle_of_pixels_contains_exactly_the_centres_of_its_pixels(
            calibration in calibrations(),
            (column_px, row_px, width_px, height_px) in (0usize..99, 0usize..99, 1usize..99, 1usize..99),
            (across, down) in (0usize..200, 0usize..200),
        ) {
            let rect = PixelRect { column_px, row_px, width_px, height_px };
            let middle = calibration.table_from_image(across as f64 + 0.5, down as f64 + 0.5);
            let inside = (column_px..column_px + width_px).contains(&across)
                && (row_px..row_px + height_px).contains(&down);
            prop_assert_eq!(rect.on_table(&calibration).contains(middle), inside);
        }
    }

    #[test]
    fn rectangles_contain_every_wall_in_view_and_little_else() {
        for center in [Point2::new(-0.1, -0.4), Point2::new(0.103, -0.3)] {
            let percept = seen_from(center, simple);
            let tree = Quadtree::of(&percept.gray, &QuadtreeParameters::default());
            let rectangles: Vec<Rect> = tree
                .partition()
                .rectangles
                .iter()
                .map(|cells| tree.pixels(cells).on_table(&percept.calibration))
                .collect();
            // A block's diagonal, and the spread in a corner of the image.
            let excess_m = 6.0 * 2f64.sqrt() * percept.calibration.m_per_px + 0.0024;
            let around = |p: Point2<f64>| {
                (0..40).any(|i| {
                    let turn = Vector2::new((0.157 * f64::from(i)).cos(), (0.157 * f64::from(i)).sin());
                    (1..=8).any(|j| simple(p + turn * (excess_m * f64::from(j) / 8.0)))
                })
            };
            for i in 0..200 * 200 {
                let p =
                    center + Vector2::new(0.001 * f64::from(i % 200), 0.001 * f64::from(i / 200)).add_scalar(-0.0995);
                let held = rectangles.iter().any(|rect| rect.contains(p));
                // A wall that covers less than half of a pixel is not seen.
                let half_m = 0.5 * percept.calibration.m_per_px;
                let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
                let within = corners.into_iter().all(|(x, y)| simple(p + Vector2::new(x, y) * half_m));
                assert!(held || !within, "{p} is a wall");
                assert!(!held || simple(p) || around(p), "{p} is far from any wall");
            }
        }
    }

    #[test]
    fn wall_tops_spread_in_proportion_to_their_height() {
        assert!((wall_spread(0.3, 0.005) - 300.0 / 295.0).abs() < 1e-12);
        assert_eq!(wall_spread(0.3, 0.0), 1.0);
        assert_eq!([wall_spread(0.3, 0.3), wall_spread(0.3, 0.4), wall_spread(f64::NAN, 0.0)], [1.0; 3]);
    }
}
