//! Known obstacles as rectangles, and the clearance that a way keeps from them.
//!
//! The bead trails the tool and cuts corners, so an edge must stay `asked_m` away from every rectangle and from the
//! workspace's border. Ends may lie nearer to a wall: after a fetch the tool stands wherever the bead was, even over a
//! wall, and cells of the map make walls thicker. Around such an end the clearance asked for begins with the end's own
//! and, from 6 mm on, grows by a quarter of the distance from the end, so that a way leaves a wall and does not follow
//! it. A tool over a wall first gets off it: its way begins at the nearest place with the least clearance. All that, like
//! the clearance itself, is ours and not the publication's, which plans for a point.

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};
use serde::{Deserialize, Serialize};

use super::reach::Grid;
use crate::geometry::{Point2, Rect, Vector2};
use crate::perception::ObstacleMap;

/// Around an end it does not grow yet: walls of cells have steps, and beside one the distance does not grow evenly.
const GRACE_M: f64 = 0.006;
/// How fast the clearance asked for grows farther from an end that has less.
pub(super) const GROWTH: f64 = 0.25;
/// Around such an end, edges are judged in pieces of this length; each keeps what its nearer end asks for.
pub(super) const PIECE_M: f64 = 0.0005;
/// More than distances and positions can be off by.
const ROUNDING_M: f64 = 1e-9;

/// All obstacles that are known, arranged for fast questions about straight lines. What was never seen is free.
#[derive(Clone, Debug)]
pub struct Obstacles {
    version: u64,
    most_clearance_m: f64,
    workspace: Rect,
    rectangles: Vec<Rect>,
    /// Its leaves are the rectangles.
    index: Bvh,
    grid: Grid,
}

impl Obstacles {
    /// The obstacles of a map, to be asked for clearances up to `most_clearance_m`.
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

    /// Version of the map they were taken from.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Most clearance that may be asked for.
    pub fn most_clearance_m(&self) -> f64 {
        self.most_clearance_m
    }

    /// The workspace; its border is a wall.
    pub fn workspace(&self) -> &Rect {
        &self.workspace
    }

    /// Disjoint, and as few as possible.
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

    /// Whether a straight line stays `distance_m` from every rectangle and from the border.
    fn keeps(&self, from: Point2<f64>, to: Point2<f64>, distance_m: f64) -> bool {
        let segment = Segment::new(from, to);
        let is_near = |node: &BvhNode| segment.is_nearer(node, distance_m);
        self.border_m(from).min(self.border_m(to)) >= distance_m && self.index.leaves(is_near).next().is_none()
    }

    /// Distance to the nearest rectangle or to the border; 0 over a wall and outside of the workspace.
    pub fn distance_m(&self, point: Point2<f64>) -> f64 {
        let to_rectangle_m = |rect| rect_distance_m(point, mins(rect), maxs(rect));
        self.rectangles.iter().map(to_rectangle_m).fold(self.border_m(point).max(0.0), f64::min)
    }

    /// Distance to the border, negative outside.
    fn border_m(&self, point: Point2<f64>) -> f64 {
        let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = self.workspace;
        (point.x - x_min_m).min(x_max_m - point.x).min(point.y - y_min_m).min(y_max_m - point.y)
    }
}

/// How far a way stays from walls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// Away from its ends, or everywhere if they lie far enough from walls.
    pub asked_m: f64,
    /// Start and goal.
    pub ends: [End; 2],
}

/// Where a way begins or ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// In `base`.
    pub point: Point2<f64>,
    /// [`Obstacles::distance_m`] there; more than 0.
    pub distance_m: f64,
}

impl End {
    /// The place itself; `None` if it is in a wall, or nowhere.
    pub(super) fn at(point: Point2<f64>, obstacles: &Obstacles) -> Option<Self> {
        let distance_m = obstacles.distance_m(point) - ROUNDING_M;
        (distance_m > 0.0).then_some(Self { point, distance_m })
    }

    /// What is asked for so far away from it, on its account.
    fn required_m(&self, away_m: f64) -> f64 {
        self.distance_m + GROWTH * (away_m - GRACE_M).max(0.0)
    }

    /// Where a way from a place begins: there, or where a tool over a wall gets off it.
    pub(super) fn near(point: Point2<f64>, obstacles: &Obstacles, least_clearance_m: f64) -> Option<Self> {
        let is_place = point.coords.iter().all(|m| m.is_finite());
        let way_out = || obstacles.grid.nearest(point, least_clearance_m).filter(|_| is_place);
        Self::at(point, obstacles).or_else(|| Self::at(way_out()?, obstacles))
    }
}

impl Clearance {
    /// What is asked for at a point. Edges near an end are judged in pieces of half a millimetre, so that up to an
    /// eighth of a millimetre less may be kept there.
    pub fn required_m(&self, point: Point2<f64>) -> f64 {
        let [start_m, goal_m] = self.ends.map(|end| end.required_m((point - end.point).norm()));
        self.asked_m.min(start_m).min(goal_m)
    }

    /// The same, all of it less by so much, but nowhere less than to touch no wall.
    pub(super) fn less(&self, by_m: f64) -> Self {
        let less_m = |m: f64| (m - by_m).max(ROUNDING_M);
        let ends = self.ends.map(|end| End { distance_m: less_m(end.distance_m), ..end });
        Self { asked_m: less_m(self.asked_m), ends }
    }

    /// Bounds for what is asked for anywhere on a straight line; equal when all of it asks for the same.
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

/// A straight line, ready to be compared with many boxes.
struct Segment {
    from: Point2<f64>,
    along: Vector2<f64>,
    /// Unit vector across it; none for a point.
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

    /// Whether a rectangle meets the line or is nearer than `distance_m`; of several rectangles, whether one may be.
    fn is_nearer(&self, node: &BvhNode, distance_m: f64) -> bool {
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
        // No axis parts them: they meet. A node of the index that holds several rectangles is looked at no closer.
        if !node.is_leaf() || apart_m.max(across_m) <= 0.0 {
            return true;
        }
        // Two convex shapes apart are nearest at a corner of one of them.
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
