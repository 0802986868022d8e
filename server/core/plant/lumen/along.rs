//! The coordinate along the lumen: the length of the shortest path for a bead from one end of it. The ends of each
//! connected part are two places that are farthest from each other.

use super::WallVertex;
use crate::geometry::Point2;
use crate::map::{FreeSpace, Map};
use crate::plant::BEAD_RADIUS_M;

/// Cells around a vertex that are considered, in columns and rows.
const REACH: i64 = 3;
/// The coordinate is averaged over this distance along the outline, to both sides: the grid's steps must not become
/// ripples of the walls.
const SMOOTHED_M: f64 = 0.02;

/// The coordinate on a grid of cells.
#[derive(Debug)]
pub(super) struct Along {
    pub space: FreeSpace,
    /// For each cell; infinite where there is no room for the bead.
    pub at_m: Vec<f64>,
    /// Cells at the beginning and at the end of each connected part.
    pub ends: Vec<[usize; 2]>,
}

impl Along {
    pub fn of(map: &Map) -> Self {
        let space = FreeSpace::new(map, BEAD_RADIUS_M);
        let mut at_m = vec![f64::INFINITY; space.component_of_cells().len()];
        let mut ends = Vec::new();
        for component in 0..space.components() as u32 {
            let is_inside = |cell: &usize| space.component_of_cells()[*cell] == Some(component);
            let Some(any) = (0..at_m.len()).find(is_inside) else { continue };
            let farthest = |from: usize| {
                let lengths_m = space.lengths_m(from);
                let finite = (0..lengths_m.len()).filter(|&cell| lengths_m[cell].is_finite());
                finite.max_by(|&a, &b| lengths_m[a].total_cmp(&lengths_m[b])).unwrap_or(from)
            };
            let one = farthest(any);
            let other = farthest(one);
            let place = |cell: usize| space.center(cell);
            let begins_first = (place(one).x, place(one).y) < (place(other).x, place(other).y);
            let [begin, end] = if begins_first { [one, other] } else { [other, one] };
            for (cell, length_m) in space.lengths_m(begin).into_iter().enumerate() {
                at_m[cell] = at_m[cell].min(length_m);
            }
            ends.push([begin, end]);
        }
        Self { space, at_m, ends }
    }

    /// The coordinate at a place; infinite where there is no room for the bead.
    pub fn at_m(&self, place: Point2<f64>) -> f64 {
        self.space.cells_around(place, 1).map(|cell| self.at_m[cell]).fold(f64::INFINITY, f64::min)
    }

    /// Sets the coordinate of the vertices of an outline.
    pub fn label(&self, ring: &mut [WallVertex]) {
        let mut last_m = 0.0;
        let labels: Vec<f64> = ring
            .iter()
            .map(|vertex| {
                let found_m = self.beside(vertex);
                last_m = if found_m.is_finite() { found_m } else { last_m };
                last_m
            })
            .collect();
        let count = ring.len();
        let length_m = |at: usize| (ring[(at + 1) % count].place_m - ring[at].place_m).norm();
        let lengths_m: Vec<f64> = (0..count).map(length_m).collect();
        for (at, vertex) in ring.iter_mut().enumerate() {
            vertex.along_m = averaged(&labels, &lengths_m, at);
        }
    }

    /// The coordinate beside a wall: the shortest over the free cells in front of it.
    fn beside(&self, vertex: &WallVertex) -> f64 {
        let ahead: Point2<f64> = vertex.place_m + vertex.inward * BEAD_RADIUS_M;
        let lengths_m = self.space.cells_around(ahead, REACH).map(|cell| {
            let offset = self.space.center(cell) - vertex.place_m;
            let is_in_front = offset.dot(&vertex.inward) > 0.0;
            if is_in_front { self.at_m[cell] + offset.norm() } else { f64::INFINITY }
        });
        lengths_m.fold(f64::INFINITY, f64::min)
    }
}

/// The mean of the labels of a closed outline around a vertex, weighted by length and by nearness. `lengths_m` are the
/// distances from each vertex to the next.
fn averaged(labels: &[f64], lengths_m: &[f64], at: usize) -> f64 {
    let count = labels.len();
    // The vertex itself has a little weight, so that a ring of one place has a label.
    let (mut sum, mut weights) = (labels[at] * 1e-6, 1e-6);
    for is_forward in [true, false] {
        let (mut here, mut away_m) = (at, 0.0);
        for _ in 0..count {
            let next = if is_forward { (here + 1) % count } else { (here + count - 1) % count };
            let step_m = lengths_m[if is_forward { here } else { next }];
            if away_m + step_m > SMOOTHED_M {
                break;
            }
            away_m += step_m;
            let weight = step_m * (1.0 - away_m / SMOOTHED_M);
            sum += labels[next] * weight;
            weights += weight;
            here = next;
        }
    }
    sum / weights
}
