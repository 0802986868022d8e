//! Artificial worlds for tests, as the camera would see them.

use super::{Percept, test_frame, wall_spread};
use crate::geometry::{Point2, Rect};

pub(super) const WORKSPACE: Rect = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };

/// For the default camera and walls of 5 mm.
pub(super) fn spread() -> f64 {
    wall_spread(0.3, 0.005)
}

/// A slanted wall, a thin one and a post. All gaps are wider than the spread.
pub(super) fn simple(p: Point2<f64>) -> bool {
    !WORKSPACE.contains(p)
        || (p.y + 0.42 - 0.3 * p.x).abs() < 0.011 && p.x < 0.05
        || (p.x - 0.1003).abs() < 0.0011 && p.y > -0.33
        || (p - Point2::new(0.0, -0.28)).norm() < 0.0137
}

/// A wavy channel with slanted folds and a round post; everything else is wall.
pub(super) fn channel(p: Point2<f64>) -> bool {
    let from_middle_m = p.y + 0.38 + 0.03 * (18.0 * p.x).sin();
    let fold_m = (p.x + 0.4 * from_middle_m).rem_euclid(0.07) - 0.035;
    !WORKSPACE.contains(p)
        || from_middle_m.abs() > 0.035 + 0.004 * (70.0 * p.x).sin()
        || fold_m.abs() < 0.002 && from_middle_m.abs() > 0.015
        || (p - Point2::new(0.02, -0.38)).norm() < 0.006
}

/// Posts in rows, round and square.
pub(super) fn posts(p: Point2<f64>) -> bool {
    let (x, y) = (p.x.rem_euclid(0.045) - 0.0225, p.y.rem_euclid(0.037) - 0.0185);
    let is_round = (p.x / 0.045).floor() % 2.0 == 0.0;
    !WORKSPACE.contains(p) || if is_round { x.hypot(y) < 0.009 } else { x.abs().max(y.abs()) < 0.007 }
}

/// The image of the camera over `center`: a place is dark if anything up to 5 mm above it is on the ray.
pub(super) fn seen_from(center: Point2<f64>, is_wall: impl Fn(Point2<f64>) -> bool) -> Percept {
    let foot = |p: Point2<f64>, share: f64| center + (p - center) / (1.0 + (spread() - 1.0) * share);
    Percept::of(&test_frame(center, |p| (0..=8).any(|i| is_wall(foot(p, f64::from(i) / 8.0)))), center)
}
