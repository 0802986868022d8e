//! Known obstacles as rectangles, and whether straight lines keep their clearance from them.

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use super::clearance::{Clearance, End, PIECE_M, ROUNDING_M};
use super::reach::Grid;
use super::segment::{Segment, maxs, mins, rect_distance_m};
use crate::geometry::{Point2, Rect};
use crate::perception::ObstacleMap;

/// All known obstacles, indexed for fast queries about straight lines. Unobserved places are free.
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
    /// The obstacles of a map, for clearances up to `most_clearance_m`.
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

    /// Version of the map that they come from.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Largest clearance that a query may have.
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

    pub(in crate::control::transport) fn grid(&self) -> &Grid {
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
        if self.border_m(from).min(self.border_m(to)) < distance_m {
            return false;
        }
        self.grid.keeps(from, to, distance_m).unwrap_or_else(|| {
            let segment = Segment::new(from, to);
            let is_near = |node: &BvhNode| segment.is_nearer(node, distance_m);
            self.index.leaves(is_near).next().is_none()
        })
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

    /// An end at the point itself; `None` if the point is in a wall or outside the workspace.
    pub(in crate::control::transport) fn end_at(&self, point: Point2<f64>) -> Option<End> {
        let distance_m = self.distance_m(point) - ROUNDING_M;
        (distance_m > 0.0).then_some(End { point, distance_m })
    }

    /// The end from which a path begins: the point itself, or the place where a tool over a wall leaves the wall.
    pub(in crate::control::transport) fn end_near(&self, point: Point2<f64>, least_clearance_m: f64) -> Option<End> {
        let is_place = point.coords.iter().all(|m| m.is_finite());
        let way_out = || self.grid.nearest(point, least_clearance_m).filter(|_| is_place);
        self.end_at(point).or_else(|| self.end_at(way_out()?))
    }
}
