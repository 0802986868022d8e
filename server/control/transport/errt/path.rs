//! A way from start to goal, and how it is made shorter.

use rand::{Rng, RngExt};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::clearance::Clearance;
use super::obstacles::Obstacles;
use crate::geometry::Point2;

/// Straight lines from start to goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Corners, start and goal included. If the tool was over a wall, the first is where it gets off.
    #[serde(deserialize_with = "ends_and_corners")]
    pub points: Vec<Point2<f64>>,
    /// What all of it kept when it was found.
    pub clearance: Clearance,
}

/// A file may lie.
fn ends_and_corners<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Point2<f64>>, D::Error> {
    let points = Vec::deserialize(deserializer)?;
    if points.len() < 2 {
        return Err(D::Error::invalid_length(points.len(), &"a start and a goal"));
    }
    Ok(points)
}

impl Path {
    /// From start to goal.
    pub fn length_m(&self) -> f64 {
        self.points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()
    }

    /// Whether all of it from `from_m` on is clear of obstacles that may have become known since. Its clearance may
    /// have shrunk by `tolerance_m`: a cell more at the rim of a wall is no reason for another way.
    pub fn is_clear_from(&self, from_m: f64, obstacles: &Obstacles, tolerance_m: f64) -> bool {
        let clearance = self.clearance.less(tolerance_m);
        let (edge, place) = self.place(from_m);
        let mut from = place;
        self.points[edge + 1..].iter().all(|&to| {
            let is_clear = obstacles.is_clear(from, to, &clearance);
            from = to;
            is_clear
        })
    }

    /// Where it leads.
    pub fn goal(&self) -> Point2<f64> {
        self.clearance.ends[1].point
    }

    /// The place so far along the way; its end beyond that.
    pub fn at(&self, along_m: f64) -> Point2<f64> {
        self.place(along_m).1
    }

    /// How far along the way its place nearest to `point` is, not before `from_m`, and the distance from there.
    pub fn nearest(&self, point: Point2<f64>, from_m: f64) -> (f64, f64) {
        let mut start_m = 0.0;
        let mut best = (from_m, (self.at(from_m) - point).norm());
        for edge in self.points.windows(2) {
            let span = edge[1] - edge[0];
            let length_m = span.norm();
            if start_m + length_m > from_m && length_m > 0.0 {
                let share = (point - edge[0]).dot(&span) / (length_m * length_m);
                let along_m = (start_m + share.clamp(0.0, 1.0) * length_m).max(from_m);
                let off_m = (self.at(along_m) - point).norm();
                if off_m < best.1 {
                    best = (along_m, off_m);
                }
            }
            start_m += length_m;
        }
        best
    }

    /// From each corner on, goes straight to the farthest corner in sight.
    pub(super) fn skip_corners(&mut self, obstacles: &Obstacles) {
        let corners = std::mem::take(&mut self.points);
        let mut at = 0;
        self.points.push(corners[at]);
        while at + 1 < corners.len() {
            let is_in_sight = |&to: &usize| obstacles.is_clear(corners[at], corners[to], &self.clearance);
            at = (at + 2..corners.len()).rev().find(is_in_sight).unwrap_or(at + 1);
            self.points.push(corners[at]);
        }
    }

    /// Goes straight between two random places along it if that is clear.
    pub(super) fn cut_short(&mut self, obstacles: &Obstacles, rng: &mut impl Rng) {
        let length_m = self.length_m();
        let mut along_m = [length_m * rng.random::<f64>(), length_m * rng.random::<f64>()];
        along_m.sort_by(f64::total_cmp);
        let [(before, from), (last, to)] = along_m.map(|along_m| self.place(along_m));
        // What is left of an edge is looked at too: near an end, its pieces are others than those of the edge.
        let corners = [self.points[before], from, to, self.points[last + 1]];
        let is_clear = |edge: &[Point2<f64>]| obstacles.is_clear(edge[0], edge[1], &self.clearance);
        if before < last && corners.windows(2).all(is_clear) {
            self.points.splice(before + 1..=last, [from, to]);
        }
    }

    /// The place so far along the way, and the number of its edge.
    fn place(&self, mut along_m: f64) -> (usize, Point2<f64>) {
        let last = self.points.len() - 2;
        for (edge, ends) in self.points.windows(2).enumerate() {
            let span = ends[1] - ends[0];
            let length_m = span.norm();
            if along_m < length_m {
                return (edge, ends[0] + span * (along_m / length_m));
            }
            along_m -= length_m;
        }
        (last, self.points[last + 1])
    }
}
