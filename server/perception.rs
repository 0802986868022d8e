//! Evaluation of camera frames: gray image, obstacle test, observation, obstacles near the tool.

mod dark;
mod observation;
mod obstacle_map;
mod obstacles;
mod quadtree;
mod rectangles;
mod rectify;
mod table;
#[cfg(test)]
mod test_world;

use crate::geometry::{Point2, Rect, Vector2};
use crate::image::{CameraFrame, GrayImage};

pub use dark::{DarkPixels, OBSTACLE_LEVEL, PixelRect};
pub use observation::{OBSERVATION_SIZE_PX, Observation};
pub use obstacle_map::{Area, CellState, Change, ObstacleMap, Unknown};
pub use obstacles::{ObstacleMask, Patch};
pub use quadtree::{Quadtree, QuadtreeParameters};
pub use rectangles::{CellMask, CellRect, Partition};
pub use table::wall_spread;

/// Side of the square of pixels whose mean decides the obstacle test (paper, §IV-A).
pub const TEST_PATCH_PX: i64 = 15;
/// A mean below this is an obstacle (paper, §IV-A).
pub const OBSTACLE_MEAN: f64 = 150.0;

/// Conversion between pixels and table points, for an image taken from straight above, +y up.
///
/// Wall tops are 5 mm closer to the camera and therefore appear up to 1.7 % farther from the camera's foot than they
/// are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// Table point at the image centre.
    pub center_m: Point2<f64>,
    /// Metres on the table per pixel.
    pub m_per_px: f64,
    /// Columns and rows.
    pub size_px: usize,
    /// Table point below the camera.
    pub foot_m: Point2<f64>,
}

impl Calibration {
    /// Table point of a place in the image; pixel centres are at half-integers.
    pub fn table_from_image(&self, column_px: f64, row_px: f64) -> Point2<f64> {
        let half = self.size_px as f64 / 2.0;
        self.center_m + Vector2::new(column_px - half, half - row_px) * self.m_per_px
    }

    /// Column and row of a table point.
    pub fn image_from_table(&self, point: Point2<f64>) -> (f64, f64) {
        let half = self.size_px as f64 / 2.0;
        let offset = (point - self.center_m) / self.m_per_px;
        (half + offset.x, half - offset.y)
    }

    /// Whether a table point is in the image.
    pub fn sees(&self, point: Point2<f64>) -> bool {
        let half_m = 0.5 * self.size_px as f64 * self.m_per_px;
        let offset = point - self.center_m;
        offset.x.abs() < half_m && offset.y.abs() < half_m
    }
}

/// One evaluated frame.
#[derive(Clone, Debug)]
pub struct Percept {
    /// Gray by Rec. 601, seen from straight above: the frame's own image for a camera that looks straight down,
    /// rectified for a tilted camera.
    pub gray: GrayImage,
    /// Positions of the pixels on the table.
    pub calibration: Calibration,
    /// Mean of the 15×15 pixels around the tool, which is at the image centre of the default camera.
    pub center_mean: f64,
}

impl Percept {
    /// Evaluates a frame that was taken with the tool at `tool_m`.
    pub fn of(frame: &CameraFrame, tool_m: Point2<f64>) -> Self {
        let (gray, calibration) = rectify::from_above(frame.picture.to_gray(), &frame.pinhole);
        let mut percept = Self { gray, calibration, center_mean: 0.0 };
        percept.center_mean = percept.patch_mean(tool_m);
        percept
    }

    /// The table area that [`Self::patch_mean`] covers around a point.
    pub fn patch(&self, point: Point2<f64>) -> Rect {
        let (column, row) = self.calibration.image_from_table(point);
        let corner_px = |at: f64| at.floor() - (TEST_PATCH_PX / 2) as f64;
        let side_px = TEST_PATCH_PX as f64;
        let upper_left = self.calibration.table_from_image(corner_px(column), corner_px(row));
        let size_m = side_px * self.calibration.m_per_px;
        Rect {
            x_min_m: upper_left.x,
            x_max_m: upper_left.x + size_m,
            y_min_m: upper_left.y - size_m,
            y_max_m: upper_left.y,
        }
    }

    /// The paper's obstacle test.
    pub fn obstacle(&self) -> bool {
        self.center_mean < OBSTACLE_MEAN
    }

    /// Mean of the 15×15 pixels around a table point. Pixels out of view count as wall.
    pub fn patch_mean(&self, point: Point2<f64>) -> f64 {
        let (column, row) = self.calibration.image_from_table(point);
        let half = TEST_PATCH_PX / 2;
        let (column, row) = (column.floor() as i64, row.floor() as i64);
        let size = self.gray.width_px as i64;
        let mut sum = 0u64;
        for r in (row - half).max(0)..=(row + half).min(size - 1) {
            for c in (column - half).max(0)..=(column + half).min(size - 1) {
                sum += u64::from(self.gray.pixels[(r * size + c) as usize]);
            }
        }
        sum as f64 / (TEST_PATCH_PX * TEST_PATCH_PX) as f64
    }

    /// Whether a dark pixel is on the straight line between two places. Pixels out of view are ignored.
    pub fn wall_between(&self, from: Point2<f64>, to: Point2<f64>) -> bool {
        let count = ((to - from).norm() / (0.5 * self.calibration.m_per_px)).ceil().max(1.0) as usize;
        (0..=count).any(|i| {
            let place = from + (to - from) * (i as f64 / count as f64);
            let (column, row) = self.calibration.image_from_table(place);
            let at = row as usize * self.gray.width_px + column as usize;
            self.calibration.sees(place) && self.gray.pixels[at] <= OBSTACLE_LEVEL
        })
    }

    /// Distance from a table point to the nearest wall in view; `None` if it is more than `max_m`. Pixels out of view
    /// count as wall.
    pub fn wall_distance_m(&self, point: Point2<f64>, max_m: f64) -> Option<f64> {
        let (column, row) = self.calibration.image_from_table(point);
        let (m_per_px, size) = (self.calibration.m_per_px, self.gray.width_px as i64);
        let reach = (max_m / m_per_px).ceil() as i64;
        let (middle_column, middle_row) = (column.floor() as i64, row.floor() as i64);
        let mut nearest_m = max_m;
        let mut found = false;
        for r in middle_row - reach..=middle_row + reach {
            for c in middle_column - reach..=middle_column + reach {
                let seen = (0..size).contains(&r) && (0..size).contains(&c);
                if seen && f64::from(self.gray.pixels[(r * size + c) as usize]) >= OBSTACLE_MEAN {
                    continue;
                }
                let offset_m = Vector2::new(c as f64 + 0.5 - column, r as f64 + 0.5 - row).norm() * m_per_px;
                if offset_m <= nearest_m {
                    (nearest_m, found) = (offset_m, true);
                }
            }
        }
        found.then_some(nearest_m)
    }

    /// The obstacle test along a whole step, so that walls thinner than the step are detected (specification §3).
    /// Returns the first place that fails; `None` if the step is free.
    ///
    /// A tool that is already over a wall, as after a fetch, may leave it: while the patch is dark from the start on,
    /// it must not get darker.
    pub fn obstacle_on_step(&self, from: Point2<f64>, to: Point2<f64>) -> Option<Point2<f64>> {
        let span = to - from;
        let spacing_m = TEST_PATCH_PX as f64 / 2.0 * self.calibration.m_per_px;
        let count = (span.norm() / spacing_m).ceil().max(1.0) as usize;
        let mut lightest = self.patch_mean(from);
        for i in 1..=count {
            let point = from + span * (i as f64 / count as f64);
            let mean = self.patch_mean(point);
            let leaving = lightest < OBSTACLE_MEAN && mean >= lightest - 1.0;
            if mean < OBSTACLE_MEAN && !leaving {
                return Some(point);
            }
            lightest = lightest.max(mean);
        }
        None
    }
}

#[cfg(test)]
pub(crate) use tests::frame as test_frame;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{CameraMount, Picture};

    /// A frame whose pixels are given by a rule on table coordinates.
    pub(crate) fn frame(center: Point2<f64>, wall: impl Fn(Point2<f64>) -> bool) -> CameraFrame {
        let pinhole = CameraMount::default().over(center);
        let m_per_px = 2.0 * 0.3 * pinhole.tangent() / 480.0;
        let calibration = Calibration { center_m: center, m_per_px, size_px: 480, foot_m: center };
        let rgba = (0..480 * 480)
            .flat_map(|i| {
                let point = calibration.table_from_image((i % 480) as f64 + 0.5, (i / 480) as f64 + 0.5);
                let level = if wall(point) { 20 } else { 230 };
                [level, level, level, 255]
            })
            .collect();
        CameraFrame { picture: Picture { width_px: 480, height_px: 480, rgba }, tick: 0, pinhole }
    }

    #[test]
    fn calibration_is_invertible() {
        let center_m = Point2::new(0.1, -0.3);
        let calibration = Calibration { center_m, m_per_px: 0.2 / 480.0, size_px: 480, foot_m: center_m };
        let upper_left = calibration.table_from_image(0.0, 0.0);
        assert!((upper_left - Point2::new(0.0, -0.2)).norm() < 1e-12);
        let (column, row) = calibration.image_from_table(upper_left);
        assert!(column.abs() < 1e-9 && row.abs() < 1e-9);
    }

    #[test]
    fn the_obstacle_test_uses_the_mean_of_the_centre() {
        let center = Point2::new(0.0, -0.3);
        assert!(!Percept::of(&frame(center, |_| false), center).obstacle());
        assert!(Percept::of(&frame(center, |p| (p - center).norm() < 0.004), center).obstacle());
        assert!(!Percept::of(&frame(center, |p| (p - center).norm() > 0.006), center).obstacle());
    }

    #[test]
    fn the_distance_to_the_nearest_wall_is_exact() {
        let center = Point2::new(0.0, -0.3);
        let percept = Percept::of(&frame(center, |p| p.x > 0.013), center);
        let distance_m = |x_m: f64| percept.wall_distance_m(center + Vector2::new(x_m, 0.0), 0.02);
        assert!((distance_m(0.0).unwrap() - 0.013).abs() < 0.0005);
        assert!((distance_m(-0.005).unwrap() - 0.018).abs() < 0.0005);
        assert_eq!(distance_m(-0.01), None);
        assert!((distance_m(-0.085).unwrap() - 0.015).abs() < 0.0005, "the edge of the image");
    }

    #[test]
    fn a_thin_wall_between_two_places_is_detected() {
        let center = Point2::new(0.0, -0.3);
        let thin = Percept::of(&frame(center, |p| (p.x - 0.01).abs() < 0.0005), center);
        assert!(thin.wall_between(center, center + Vector2::new(0.02, 0.003)));
        assert!(!thin.wall_between(center, center + Vector2::new(0.009, 0.05)));
        assert!(!thin.wall_between(center, center) && !thin.wall_between(center, center - Vector2::new(3.0, 0.0)));
    }

    #[test]
    fn detects_a_thin_wall_across_a_step_and_allows_leaving_a_wall() {
        let center = Point2::new(0.0, -0.3);
        let to = center + Vector2::new(0.02, 0.0);
        let thin = Percept::of(&frame(center, |p| (p.x - 0.01).abs() < 0.002), center);
        assert!(thin.obstacle_on_step(center, to).is_some());
        let behind = Percept::of(&frame(center, |p| p.x < 0.001), center);
        assert!(behind.obstacle_on_step(center, to).is_none());
        assert!(behind.obstacle_on_step(center, center - Vector2::new(0.02, 0.0)).is_some());
    }
}
