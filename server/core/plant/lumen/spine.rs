//! The spine: the middle of every passage through which the bead fits, as places at the same distance from walls on
//! opposite sides. Moving walls do not reach it, so walls of opposite sides never cross.

use std::collections::HashMap;

use super::{BEAD_RADIUS_M, MOST_CLOSING_M, WallVertex};
use crate::geometry::{Point2, Vector2};
use crate::map::Map;

/// Half the width of a closed passage. The bead does not fit through it.
const KEPT_M: f64 = 0.001;
/// Spacing of the samples.
const SAMPLE_M: f64 = 0.0015;
/// A place is on the spine if it touches walls in directions that differ by at least this much. In a corner they differ
/// less, and a bead is pushed out of it.
const LEAST_ANGLE_RAD: f64 = 1.75;
/// Iterations of the shrinking ball; it converges in about five.
const SHRINKINGS: usize = 30;

/// Sets the limits of all vertices.
pub(super) fn limit(map: &Map, vertices: &mut [WallVertex]) {
    let spine = of(map);
    let reach_m = MOST_CLOSING_M + KEPT_M;
    let cell = |point: &Point2<f64>| ((point.x / reach_m).floor() as i64, (point.y / reach_m).floor() as i64);
    let mut buckets: HashMap<(i64, i64), Vec<Point2<f64>>> = HashMap::new();
    for point in spine {
        buckets.entry(cell(&point)).or_default().push(point);
    }
    for vertex in vertices {
        let (column, row) = cell(&vertex.place_m);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
        let near = around.filter_map(|key| buckets.get(&key)).flatten();
        let nearest_m = near.map(|point| (point - vertex.place_m).norm()).fold(f64::INFINITY, f64::min);
        vertex.limit_m = (nearest_m - KEPT_M).clamp(0.0, MOST_CLOSING_M);
    }
}

/// Places in the middle of passages.
fn of(map: &Map) -> Vec<Point2<f64>> {
    let mut spine = Vec::new();
    for ring in map.free().iter().flat_map(|free| free.rings()) {
        for (at, &[x, y]) in ring.iter().enumerate() {
            let [to_x, to_y] = ring[(at + 1) % ring.len()];
            let (from, to) = (Point2::new(x, y), Point2::new(to_x, to_y));
            let span = to - from;
            let Some(along) = span.try_normalize(1e-9) else { continue };
            let inward = Vector2::new(-along.y, along.x);
            let count = (span.norm() / SAMPLE_M).ceil() as usize;
            let samples = (0..count).map(|sample| from + span * ((sample as f64 + 0.5) / count as f64));
            spine.extend(samples.filter_map(|wall| middle(map, wall, inward)));
        }
    }
    spine
}

/// The centre of the largest ball that touches the wall here, if it is in the middle of a passage that the bead fits
/// through: Ma, Bae & Choi 2012, "3D medial axis point approximation using nearest neighbors and the normal field".
fn middle(map: &Map, wall: Point2<f64>, inward: Vector2<f64>) -> Option<Point2<f64>> {
    let mut radius_m = 2.0 * (MOST_CLOSING_M + KEPT_M);
    let mut opposite: Option<Point2<f64>> = None;
    for _ in 0..SHRINKINGS {
        let center = wall + inward * radius_m;
        let nearest = map.nearest_wall_point(center);
        let depth_m = (nearest - wall).dot(&inward);
        if (nearest - center).norm() >= radius_m - 1e-6 || depth_m <= 1e-9 {
            let angle_rad = (wall - center).angle(&(opposite? - center));
            return (radius_m >= BEAD_RADIUS_M && angle_rad >= LEAST_ANGLE_RAD).then_some(center);
        }
        radius_m = (nearest - wall).norm_squared() / (2.0 * depth_m);
        opposite = Some(nearest);
    }
    None
}
