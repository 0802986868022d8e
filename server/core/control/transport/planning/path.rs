//! A path from start to goal, and how it is shortened.

use rand::{Rng, RngExt};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::clearance::Clearance;
use super::obstacles::Obstacles;
use crate::geometry::Point2;

/// After this many shortcuts in a row that are not possible, a path is hardly shortened by more of them.
pub(super) const MOST_MISSES: usize = 40;

/// Straight lines from start to goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Corners, including start and goal. If the tool was over a wall, the first is where it leaves the wall.
    #[serde(deserialize_with = "ends_and_corners")]
    pub points: Vec<Point2<f64>>,
    /// The clearance that the whole path kept when it was found.
    pub clearance: Clearance,
}

/// Rejects a path with fewer than two points from a file.
fn ends_and_corners<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Point2<f64>>, D::Error> {
    let points = Vec::deserialize(deserializer)?;
    if points.len() < 2 {
        return Err(D::Error::invalid_length(points.len(), &"a start and a goal"));
    }
    Ok(points)
}

impl Path {
    pub fn length_m(&self) -> f64 {
        self.points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()
    }

    /// Whether the path from `from_m` on is clear of the currently known obstacles. The clearance may have shrunk by
    /// `tolerance_m`: one more cell at the edge of a wall is no reason for a new path.
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

    pub fn goal(&self) -> Point2<f64> {
        self.clearance.ends[1].point
    }

    /// The point at `along_m` from the start; the end if the path is shorter.
    pub fn at(&self, along_m: f64) -> Point2<f64> {
        self.place(along_m).1
    }

    /// The path's point nearest to `point`, not before `from_m`: its distance along the path, and its distance to
    /// `point`.
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

    /// Replaces corners by straight lines: from each corner on to the farthest corner with a clear line.
    pub(in crate::control::transport) fn skip_corners(&mut self, obstacles: &Obstacles) {
        let corners = std::mem::take(&mut self.points);
        let mut at = 0;
        self.points.push(corners[at]);
        while at + 1 < corners.len() {
            let is_in_sight = |&to: &usize| obstacles.is_clear(corners[at], corners[to], &self.clearance);
            at = (at + 2..corners.len()).rev().find(is_in_sight).unwrap_or(at + 1);
            self.points.push(corners[at]);
        }
    }

    /// Tries `count` random shortcuts, or fewer if [`MOST_MISSES`] in a row are not possible.
    pub(in crate::control::transport) fn cut_short(&mut self, count: usize, obstacles: &Obstacles, rng: &mut impl Rng) {
        let mut misses = 0;
        for _ in 0..count {
            misses = if self.try_shortcut(obstacles, rng) { 0 } else { misses + 1 };
            if misses == MOST_MISSES {
                break;
            }
        }
    }

    /// Replaces the part between two random points by a straight line if that is clear. Returns whether it was.
    fn try_shortcut(&mut self, obstacles: &Obstacles, rng: &mut impl Rng) -> bool {
        let length_m = self.length_m();
        let mut along_m = [length_m * rng.random::<f64>(), length_m * rng.random::<f64>()];
        along_m.sort_by(f64::total_cmp);
        let [(before, from), (last, to)] = along_m.map(|along_m| self.place(along_m));
        let is_clear = |from, to| obstacles.is_clear(from, to, &self.clearance);
        // The remaining parts of edges are checked again: near an end, they are divided into other pieces than before.
        let rest_is_clear = || is_clear(self.points[before], from) && is_clear(to, self.points[last + 1]);
        let is_shortcut = before < last && is_clear(from, to) && rest_is_clear();
        if is_shortcut {
            self.points.splice(before + 1..=last, [from, to]);
        }
        is_shortcut
    }

    /// The point at `along_m` from the start, and the index of its edge.
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
