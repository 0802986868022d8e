//! The outline of walls that have closed in: it runs around the discs of all vertices.

use std::f64::consts::{PI, TAU};

use super::{SAME_PLACE_M, WallVertex};
use crate::geometry::{Band, Vector2};

/// Longest piece of an arc.
const ARC_RAD: f64 = 0.25;
/// Steepest change of a radius along a wall. Of discs that differ more, one lies inside the other.
const STEEPEST: f64 = 0.97;
/// A corner that one point represents as well as this has no more points.
const EXACT_M: f64 = 2e-5;

/// A straight piece of a ring.
struct Side {
    vertices: [usize; 2],
    /// Direction of the normal, to the left.
    normal_rad: f64,
    /// The common tangent of both discs is turned by this angle.
    tilt_rad: f64,
}

impl Side {
    fn tangent_rad(&self) -> f64 {
        self.normal_rad + self.tilt_rad
    }
}

/// What a ring covers if its vertices have closed in by `closings_m`.
pub(super) fn band(ring: &[WallVertex], mut closings_m: Vec<f64>) -> Band {
    smooth(ring, &mut closings_m);
    let sides: Vec<Side> = (0..ring.len()).filter_map(|from| side(ring, &closings_m, from)).collect();
    let mut band = Band::default();
    let mut add = |vertex: usize, normal_rad: f64| {
        let foot_m = ring[vertex].place_m;
        let (sin, cos) = normal_rad.sin_cos();
        band.foot_m.push(foot_m.into());
        band.edge_m.push((foot_m + Vector2::new(cos, sin) * closings_m[vertex]).into());
    };
    for (number, side) in sides.iter().enumerate() {
        let before = &sides[(number + sides.len() - 1) % sides.len()];
        let corner_rad = (side.normal_rad - before.normal_rad + PI).rem_euclid(TAU) - PI;
        let turn_rad = corner_rad + side.tilt_rad - before.tilt_rad;
        let from = side.vertices[0];
        if closings_m[from] * (1.0 - (0.5 * turn_rad).cos()) < EXACT_M {
            add(from, side.tangent_rad() - 0.5 * turn_rad);
            continue;
        }
        add(before.vertices[1], before.tangent_rad());
        // A corner that stands out into the free space is round.
        if turn_rad < -ARC_RAD {
            let steps = (-turn_rad / ARC_RAD).ceil();
            (1..steps as usize).for_each(|step| add(from, side.tangent_rad() - turn_rad * (1.0 - step as f64 / steps)));
        }
        add(from, side.tangent_rad());
    }
    band
}

fn side(ring: &[WallVertex], closings_m: &[f64], from: usize) -> Option<Side> {
    let to = (from + 1) % ring.len();
    let span = ring[to].place_m - ring[from].place_m;
    let length_m = span.norm();
    (length_m > SAME_PLACE_M).then(|| Side {
        vertices: [from, to],
        normal_rad: span.x.atan2(-span.y),
        tilt_rad: ((closings_m[to] - closings_m[from]) / length_m).clamp(-1.0, 1.0).asin(),
    })
}

/// Enlarges discs that lie inside others. The union of all discs stays the same, and its outline runs around each.
fn smooth(ring: &[WallVertex], closings_m: &mut [f64]) {
    let count = ring.len();
    let mut grow = |at: usize, from: usize| {
        let gap_m = (ring[at].place_m - ring[from].place_m).norm();
        closings_m[at] = closings_m[at].max(closings_m[from] - STEEPEST * gap_m);
    };
    // The second time, what was at the end arrives at the beginning.
    for _ in 0..2 {
        (0..count).for_each(|from| grow((from + 1) % count, from));
        (0..count).rev().for_each(|from| grow(from, (from + 1) % count));
    }
}
