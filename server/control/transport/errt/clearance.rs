//! Known obstacles as rectangles, and the clearance that a path keeps from them.
//!
//! The bead trails the tool and cuts corners. Therefore an edge must stay `asked_m` away from every rectangle and from
//! the workspace's border. Start and goal may be closer to a wall: after a fetch the tool is where the bead was,
//! possibly over a wall, and the map's cells make walls thicker. Near such an end the required clearance starts at the
//! end's own distance and grows, beyond 6 mm, by a quarter of the distance from the end. So a path moves away from a
//! wall and does not follow it. If the tool is over a wall, its path begins at the nearest point with the minimum
//! clearance. None of this is from the publication, which plans for a point.

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};
use serde::{Deserialize, Serialize};

use super::reach::Grid;
use crate::geometry::{Point2, Rect, Vector2};
use crate::perception::ObstacleMap;

/// The clearance does not grow within this distance of an end: walls of cells have steps, so the distance to them does
/// not grow evenly.
const GRACE_M: f64 = 0.006;
/// Growth of the required clearance per distance from an end that has less.
pub(super) const GROWTH: f64 = 0.25;
/// Near such an end, edges are checked in pieces of this length; each must keep what its nearer end requires.
pub(super) const PIECE_M: f64 = 0.0005;
/// Upper bound of rounding errors in distances and positions.
const ROUNDING_M: f64 = 1e-9;

/// All known obstacles, indexed for fast queries with straight lines. Unobserved places are free.
#[derive(Clone, Debug)]
pub struct Obstacles {
    version: u64,
    most_clearance_m: f64,
    workspace: Rect,
    rectangles: Vec<Rect>,
    /// The leaves are the rectangles.
    index: Bvh,
    grid: Grid,
}

impl Obstacles {
    /// The obstacles of a map, for queries with clearances up to `most_clearance_m`.
    pub fn of(map: &ObstacleMap, most_clearance_m: f64) -> Self {
        let cells = map.partition().rectangles;
        let rectangles: Vec<Rect> = cells.iter().map(|cells| map.rect(cells)).collect();
        let leaves: Vec<Aabb> = rectangles.iter().map(|rect| Aabb::new(mins(rect), maxs(rect))).collect();
        Self {
            version: map.version(),
            most_clearance_m,
            workspace: *map.workspace(),
            index: Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves),
            rectangles,
            grid: Grid::new(*map.workspace(), map.shape(), &cells, most_clearance_m),
        }
    }

    /// Version of the map that they were made from.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Largest clearance that a query may use.
    pub fn most_clearance_m(&self) -> f64 {
        self.most_clearance_m
    }

    /// The workspace. Its border counts as a wall.
    pub fn workspace(&self) -> &Rect {
        &self.workspace
    }

    /// Disjoint rectangles, as few as possible.
    pub fn rectangles(&self) -> &[Rect] {
        &self.rectangles
    }

    pub(super) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Whether the straight line between two points keeps `clearance`.
    pub fn is_clear(&self, from: Point2<f64>, to: Point2<f64>, clearance: &Clearance) -> bool {
        let [least_m, most_m] = clearance.required_along_m(from, to);
        if self.keeps(from, to, most_m) {
            return true;
        }
        if least_m == most_m || !self.keeps(from, to, least_m) {
            return false;
        }
        if (to - from).norm() <= PIECE_M {
            return true;
        }
        let middle = nalgebra::center(&from, &to);
        self.is_clear(from, middle, clearance) && self.is_clear(middle, to, clearance)
    }

    /// Whether a straight line stays `distance_m` away from every rectangle and from the border.
    fn keeps(&self, from: Point2<f64>, to: Point2<f64>, distance_m: f64) -> bool {
        let segment = Segment::new(from, to);
        let is_near = |node: &BvhNode| segment.is_nearer(node, distance_m);
        self.border_m(from).min(self.border_m(to)) >= distance_m && self.index.leaves(is_near).next().is_none()
    }

    /// Distance to the nearest rectangle or to the border; 0 over a wall and outside the workspace.
    pub fn distance_m(&self, point: Point2<f64>) -> f64 {
        let to_rectangle_m = |rect| rect_distance_m(point, mins(rect), maxs(rect));
        self.rectangles.iter().map(to_rectangle_m).fold(self.border_m(point).max(0.0), f64::min)
    }

    /// Distance to the border; negative outside.
    fn border_m(&self, point: Point2<f64>) -> f64 {
        let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = self.workspace;
        (point.x - x_min_m).min(x_max_m - point.x).min(point.y - y_min_m).min(y_max_m - point.y)
    }
}

/// The distance that a path keeps from walls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// Required distance away from the ends; everywhere if both ends are far enough from walls.
    pub asked_m: f64,
    /// Start and goal.
    pub ends: [End; 2],
}

/// Start or goal of a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// In `base`.
    pub point: Point2<f64>,
    /// [`Obstacles::distance_m`] at the point; more than 0.
    pub distance_m: f64,
}

impl End {
    /// An end exactly at `point`; `None` if it is in a wall or not finite.
    pub(super) fn at(point: Point2<f64>, obstacles: &Obstacles) -> Option<Self> {
        let distance_m = obstacles.distance_m(point) - ROUNDING_M;
        (distance_m > 0.0).then_some(Self { point, distance_m })
    }

    /// The clearance that this end allows at the distance `away_m` from it.
    fn required_m(&self, away_m: f64) -> f64 {
        self.distance_m + GROWTH * (away_m - GRACE_M).max(0.0)
    }

    /// The start of a path from `point`: there or, for a tool over a wall, at the nearest point with
    /// `least_clearance_m`.
    pub(super) fn near(point: Point2<f64>, obstacles: &Obstacles, least_clearance_m: f64) -> Option<Self> {
        let is_place = point.coords.iter().all(|m| m.is_finite());
        let way_out = || obstacles.grid.nearest(point, least_clearance_m).filter(|_| is_place);
        Self::at(point, obstacles).or_else(|| Self::at(way_out()?, obstacles))
    }
}

impl Clearance {
    /// Required distance at a point. Near an end, edges are checked in pieces of .5 mm, so up to .125 mm less may be
    /// kept there.
    pub fn required_m(&self, point: Point2<f64>) -> f64 {
        let [start_m, goal_m] = self.ends.map(|end| end.required_m((point - end.point).norm()));
        self.asked_m.min(start_m).min(goal_m)
    }

    /// The same clearance reduced by `by_m`, but still without touching walls.
    pub(super) fn less(&self, by_m: f64) -> Self {
        let less_m = |m: f64| (m - by_m).max(ROUNDING_M);
        let ends = self.ends.map(|end| End { distance_m: less_m(end.distance_m), ..end });
        Self { asked_m: less_m(self.asked_m), ends }
    }

    /// Lower and upper bound of the requirement on a straight line; equal if it is the same everywhere on the line.
    fn required_along_m(&self, from: Point2<f64>, to: Point2<f64>) -> [f64; 2] {
        if self.ends.iter().all(|end| end.distance_m >= self.asked_m) {
            return [self.asked_m; 2];
        }
        let along = Segment::new(from, to);
        let near = self.ends.map(|end| end.required_m(along.distance_m(end.point)));
        let far = self.ends.map(|end| end.required_m((from - end.point).norm().max((to - end.point).norm())));
        [near, far].map(|[start_m, goal_m]| self.asked_m.min(start_m).min(goal_m))
    }
}

/// A straight line, prepared for comparison with many boxes.
struct Segment {
    from: Point2<f64>,
    along: Vector2<f64>,
    /// Unit vector across the line; `None` if it is a point.
    normal: Option<Vector2<f64>>,
}

impl Segment {
    fn new(from: Point2<f64>, to: Point2<f64>) -> Self {
        let along = to - from;
        Self { from, along, normal: Vector2::new(-along.y, along.x).try_normalize(0.0) }
    }

    fn distance_m(&self, point: Point2<f64>) -> f64 {
        let length_2 = self.along.norm_squared();
        let share = if length_2 > 0.0 { (point - self.from).dot(&self.along) / length_2 } else { 0.0 };
        (point - self.from - self.along * share.clamp(0.0, 1.0)).norm()
    }

    /// Whether a rectangle meets the line or is nearer than `distance_m`. For an inner node of the index: whether one
    /// of its rectangles may be.
    fn is_nearer(&self, node: &BvhNode, distance_m: f64) -> bool {
        let (from, to) = (self.from, self.from + self.along);
        let (mins, maxs) = (node.mins(), node.maxs());
        // The gap between the two along an axis is at most their distance.
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
        // No axis separates them: they meet. Inner nodes of the index are not examined more closely.
        if !node.is_leaf() || apart_m.max(across_m) <= 0.0 {
            return true;
        }
        // Two disjoint convex shapes are nearest at a corner of one of them.
        let corners = [(mins.x, mins.y), (maxs.x, mins.y), (mins.x, maxs.y), (maxs.x, maxs.y)];
        rect_distance_m(from, mins, maxs) < distance_m
            || rect_distance_m(to, mins, maxs) < distance_m
            || corners.into_iter().any(|(x, y)| self.distance_m(Point2::new(x, y)) < distance_m)
    }
}

fn mins(rect: &Rect) -> Vector {
    Vector::new(rect.x_min_m, rect.y_min_m)
}

fn maxs(rect: &Rect) -> Vector {
    Vector::new(rect.x_max_m, rect.y_max_m)
}

fn rect_distance_m(point: Point2<f64>, mins: Vector, maxs: Vector) -> f64 {
    let dx_m = (mins.x - point.x).max(point.x - maxs.x).max(0.0);
    let dy_m = (mins.y - point.y).max(point.y - maxs.y).max(0.0);
    (dx_m * dx_m + dy_m * dy_m).sqrt()
}
