//! Evaluation of camera frames: gray image, obstacle test, observation, obstacles near the tool.

mod bead;
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

use std::borrow::Cow;
use std::ops::RangeInclusive;

use crate::geometry::{Point2, Rect, Vector2};
use crate::image::{CameraFrame, CameraMount, GrayImage};

pub use bead::BeadView;
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

/// Gray levels of what hides the table: the magnet and the gripper (165). Floor and bead are 200 or lighter, walls 50 or
/// darker. What is hidden is neither.
pub const HIDING: RangeInclusive<u8> = 126..=189;

/// Columns and rows of [`Percept::from_default_camera`], if it is not the image itself: whole multiples of the
/// observation's.
const WINDOW_PX: usize = 3 * OBSERVATION_SIZE_PX;
/// Gray of a wall's top and of the floor in the controllers' view.
const WALL_LEVEL: u8 = 43;
const FLOOR_LEVEL: u8 = 240;

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
    /// Whether the magnet hides any pixel.
    is_partly_hidden: bool,
}

impl Percept {
    /// Evaluates a frame that was taken with the tool at `tool_m`.
    pub fn of(frame: &CameraFrame, tool_m: Point2<f64>) -> Self {
        let (gray, calibration) = rectify::from_above(frame.picture.to_gray(), &frame.pinhole);
        // Counting is faster than searching, because most images have no such pixel.
        let is_partly_hidden = gray.pixels.iter().filter(|&level| HIDING.contains(level)).count() > 0;
        let mut percept = Self { gray, calibration, center_mean: 0.0, is_partly_hidden };
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

    /// The pixels at or below a gray level that are not hidden by the magnet.
    pub fn dark(&self, level: u8) -> DarkPixels {
        DarkPixels::where_(&self.gray, |pixel| pixel <= level && !HIDING.contains(&pixel))
    }

    /// The pixels that the magnet hides; `None` if there are none.
    pub fn hidden(&self) -> Option<DarkPixels> {
        self.is_partly_hidden.then(|| DarkPixels::where_(&self.gray, |pixel| HIDING.contains(&pixel)))
    }

    /// Of the 15×15 pixels around a table point: the sum of those that the magnet does not hide, and the number of those
    /// that it hides. Pixels out of view are black.
    fn patch_sum(&self, point: Point2<f64>) -> (u64, i64) {
        let (column, row) = self.calibration.image_from_table(point);
        let half = TEST_PATCH_PX / 2;
        let (column, row) = (column.floor() as i64, row.floor() as i64);
        let size = self.gray.width_px as i64;
        let (mut sum, mut hidden) = (0, 0);
        for r in (row - half).max(0)..=(row + half).min(size - 1) {
            for c in (column - half).max(0)..=(column + half).min(size - 1) {
                let level = self.gray.pixels[(r * size + c) as usize];
                let is_hidden = HIDING.contains(&level);
                sum += if is_hidden { 0 } else { u64::from(level) };
                hidden += i64::from(is_hidden);
            }
        }
        (sum, hidden)
    }

    /// Mean of the 15×15 pixels around a table point. Pixels out of view count as wall. Those that the magnet hides do
    /// not count; where it hides all of them, no wall is seen.
    pub fn patch_mean(&self, point: Point2<f64>) -> f64 {
        let (sum, hidden) = self.patch_sum(point);
        let visible = TEST_PATCH_PX * TEST_PATCH_PX - hidden;
        if visible > 0 { sum as f64 / visible as f64 } else { OBSTACLE_MEAN }
    }

    /// Whether the magnet hides more than half of the 15×15 pixels around a table point.
    pub fn is_hidden(&self, point: Point2<f64>) -> bool {
        self.is_partly_hidden && 2 * self.patch_sum(point).1 > TEST_PATCH_PX * TEST_PATCH_PX
    }

    /// The network's image: the camera's own, or the one that the default camera would take.
    pub fn for_network(&self, is_corrected: bool, tool_m: Point2<f64>, known: &ObstacleMap) -> Cow<'_, GrayImage> {
        if is_corrected { self.from_default_camera(tool_m, known) } else { Cow::Borrowed(&self.gray) }
    }

    /// Whether the image is that of the default camera over a tool, with nothing hidden.
    pub fn is_from_default_camera(&self, tool_m: Point2<f64>) -> bool {
        let Calibration { center_m, m_per_px, size_px, .. } = self.calibration;
        let side_m = default_side_m(tool_m);
        let is_default = (center_m - tool_m).norm() < 1e-9 && (m_per_px * size_px as f64 - side_m).abs() < 1e-6;
        is_default && !self.is_partly_hidden
    }

    /// The image that the default camera would take over a tool: [`CameraMount::default`]'s square of table, with the
    /// tool in the middle. Policies are trained with that camera. What this camera does not see, or what the magnet
    /// hides, comes from the obstacle map; a place that was never seen is shown as floor.
    pub fn from_default_camera(&self, tool_m: Point2<f64>, known: &ObstacleMap) -> Cow<'_, GrayImage> {
        if self.is_from_default_camera(tool_m) {
            return Cow::Borrowed(&self.gray);
        }
        let side_m = default_side_m(tool_m);
        let m_per_px = side_m / WINDOW_PX as f64;
        let window = Calibration { center_m: tool_m, m_per_px, size_px: WINDOW_PX, foot_m: tool_m };
        let pixels = (0..WINDOW_PX * WINDOW_PX).map(|at| {
            let (column_px, row_px) = ((at % WINDOW_PX) as f64 + 0.5, (at / WINDOW_PX) as f64 + 0.5);
            let place = window.table_from_image(column_px, row_px);
            self.level(place).filter(|level| !HIDING.contains(level)).unwrap_or_else(|| match known.state(place) {
                CellState::Obstacle => WALL_LEVEL,
                CellState::Free | CellState::Unknown => FLOOR_LEVEL,
            })
        });
        Cow::Owned(GrayImage { width_px: WINDOW_PX, height_px: WINDOW_PX, pixels: pixels.collect() })
    }

    /// Gray level of a table point, if it is in view.
    fn level(&self, place: Point2<f64>) -> Option<u8> {
        let (column, row) = self.calibration.image_from_table(place);
        let at = || self.gray.pixels[row as usize * self.gray.width_px + column as usize];
        self.calibration.sees(place).then(at)
    }

    /// Whether a dark pixel is on the straight line between two places. Pixels out of view are ignored.
    pub fn wall_between(&self, from: Point2<f64>, to: Point2<f64>) -> bool {
        let count = ((to - from).norm() / (0.5 * self.calibration.m_per_px)).ceil().max(1.0) as usize;
        (0..=count).any(|i| {
            let place = from + (to - from) * (i as f64 / count as f64);
            self.level(place).is_some_and(|level| level <= OBSTACLE_LEVEL)
        })
    }

    /// Distance from a table point to the nearest wall in view; `None` if it is more than `max_m`. Pixels out of view
    /// count as wall, and those that the magnet hides do not.
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
                if seen && !is_wall(self.gray.pixels[(r * size + c) as usize]) {
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

/// Whether a pixel is dark, and not the magnet.
fn is_wall(level: u8) -> bool {
    f64::from(level) < OBSTACLE_MEAN && !HIDING.contains(&level)
}

#[cfg(test)]
pub(crate) use tests::frame as test_frame;

/// Side of the square of table that the default camera sees over a tool.
fn default_side_m(tool_m: Point2<f64>) -> f64 {
    let pinhole = CameraMount::default().over(tool_m, 0.0);
    let [_, _, height_m] = pinhole.position_m;
    2.0 * height_m * pinhole.tangent()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{CameraMount, Picture};

    /// A frame whose pixels are given by a rule on table coordinates.
    pub(crate) fn frame(center: Point2<f64>, wall: impl Fn(Point2<f64>) -> bool) -> CameraFrame {
        let pinhole = CameraMount::default().over(center, 0.0);
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
