//! Straight lines between boxes.

use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::BvhNode;

use crate::geometry::{Point2, Rect, Vector2};

/// A straight line, prepared for comparisons with many boxes.
pub(super) struct Segment {
    from: Point2<f64>,
    along: Vector2<f64>,
    /// Unit vector perpendicular to the line; zero if the line is a point.
    normal: Option<Vector2<f64>>,
}

impl Segment {
    pub(super) fn new(from: Point2<f64>, to: Point2<f64>) -> Self {
        let along = to - from;
        Self { from, along, normal: Vector2::new(-along.y, along.x).try_normalize(0.0) }
    }

    pub(super) fn distance_m(&self, point: Point2<f64>) -> f64 {
        let length_2 = self.along.norm_squared();
        let share = if length_2 > 0.0 { (point - self.from).dot(&self.along) / length_2 } else { 0.0 };
        (point - self.from - self.along * share.clamp(0.0, 1.0)).norm()
    }

    /// Whether a rectangle meets the line or is nearer than `distance_m`. For a box around several rectangles: whether
    /// one of them may be.
    pub(super) fn is_nearer(&self, node: &BvhNode, distance_m: f64) -> bool {
        let (from, to) = (self.from, self.from + self.along);
        let (mins, maxs) = (node.mins(), node.maxs());
        // The gap between the two along an axis is never more than their distance.
        let gap_m = |a: f64, b: f64, min: f64, max: f64| (min - a.max(b)).max(a.min(b) - max);
        let apart_m = gap_m(from.x, to.x, mins.x, maxs.x).max(gap_m(from.y, to.y, mins.y, maxs.y));
        if apart_m >= distance_m {
            return false;
        }
        let across_m = self.normal.map_or(0.0, |normal| {
            let center = Point2::new(0.5 * (mins.x + maxs.x), 0.5 * (mins.y + maxs.y));
            let half_m = 0.5 * ((maxs.x - mins.x) * normal.x.abs() + (maxs.y - mins.y) * normal.y.abs());
            (center - from).dot(&normal).abs() - half_m
        });
        if across_m >= distance_m {
            return false;
        }
        // No axis separates them, so they meet. A box around several rectangles is not examined further.
        if !node.is_leaf() || apart_m.max(across_m) <= 0.0 {
            return true;
        }
        // Two separate convex shapes are nearest at a corner of one of them.
        let corners = [(mins.x, mins.y), (maxs.x, mins.y), (mins.x, maxs.y), (maxs.x, maxs.y)];
        rect_distance_m(from, mins, maxs) < distance_m
            || rect_distance_m(to, mins, maxs) < distance_m
            || corners.into_iter().any(|(x, y)| self.distance_m(Point2::new(x, y)) < distance_m)
    }
}

pub(super) fn mins(rect: &Rect) -> Vector {
    Vector::new(rect.x_min_m, rect.y_min_m)
}

pub(super) fn maxs(rect: &Rect) -> Vector {
    Vector::new(rect.x_max_m, rect.y_max_m)
}

pub(super) fn rect_distance_m(point: Point2<f64>, mins: Vector, maxs: Vector) -> f64 {
    let dx_m = (mins.x - point.x).max(point.x - maxs.x).max(0.0);
    let dy_m = (mins.y - point.y).max(point.y - maxs.y).max(0.0);
    (dx_m * dx_m + dy_m * dy_m).sqrt()
}
