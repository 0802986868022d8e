//! The lumen of a map: the room between its walls, seen as a tube with a coordinate along it.
//!
//! Walls that move stay above their drawn place and close in on the free side: around every point of a wall lies a disc
//! whose radius is how far the wall has closed in there. The discs' radii change linearly between two vertices, so a
//! piece of wall is a round cone, and its distance from a point has a closed form. A closing is limited so that walls of
//! opposite sides do not cross ([`spine`]), and it stops at the bead: the tissue yields to a bead that it has closed on.

mod along;
mod flow;
mod index;
mod spine;

use std::ops::{Range, RangeInclusive};
use std::sync::OnceLock;

use super::BEAD_RADIUS_M;
use crate::geometry::{Band, Point2, Vector2};
use crate::map::Map;
use along::Along;
use flow::Flow;
use index::Index;

/// The most that a wall may close in.
pub const MOST_CLOSING_M: f64 = 0.04;
/// Longest piece of wall.
const PIECE_M: f64 = 0.004;
/// Turn of an outward corner at which the wall gets one more vertex, so that it stays round when it closes in.
const FAN_RAD: f64 = 0.35;
/// A vertex of an inward corner moves farther than its walls, but not more than this many times.
const MOST_MITRE: f64 = 3.0;
/// Closings at which walls are tried for being covered, the depth from which they count as covered, and how often a
/// covered place is moved.
const COVERED_AT_M: [f64; 3] = [0.004, 0.01, 0.02];
const COVERED_M: f64 = 1e-4;
const UNCOVERINGS: usize = 4;
/// Walls farther along the lumen than this cannot reach the bead: the most that one closes in, the bead's size, the
/// grid's steps, and what the fastest bead travels in a tick.
const BESIDE_M: f64 = 0.12;
/// A vertex that moves this many times as far as its walls is in a corner.
const MITRED: f64 = 1.02;
/// Vertices that are looked at for the direction of a wall.
const MOST_BESIDE: usize = 12;
/// Spacing of the samples of a wave along the lumen, and their largest number.
const KNOT_M: f64 = 0.005;
const MOST_KNOTS: f64 = 256.0;

/// A vertex of the walls' outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallVertex {
    /// Where it is while the wall is at rest.
    pub place_m: Point2<f64>,
    /// Where it moves: toward the free side. Longer than 1 in inward corners.
    pub inward: Vector2<f64>,
    /// Coordinate along the lumen.
    pub along_m: f64,
    /// The most that it closes in.
    pub limit_m: f64,
    /// Whether it is in or near an inward corner, where other walls may cover it when it closes in.
    pub is_in_corner: bool,
}

/// A piece of wall between two vertices, free on its left.
#[derive(Clone, Copy, Debug)]
struct Piece {
    vertices: [u32; 2],
    along: Vector2<f64>,
    length_m: f64,
}

/// Where a moved wall is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nearest {
    /// Distance from the moved surface; negative inside.
    pub distance_m: f64,
    /// From the wall toward the point.
    pub normal: Vector2<f64>,
    /// The piece, and the share of its length.
    at: (u32, f64),
}

/// A map's walls with the coordinate along the lumen.
#[derive(Debug)]
pub struct Lumen {
    vertices: Vec<WallVertex>,
    /// Vertices of each closed outline.
    rings: Vec<Range<usize>>,
    pieces: Vec<Piece>,
    index: Index,
    along: Along,
    knot_m: f64,
    knots: usize,
    flow: OnceLock<Flow>,
}

impl Lumen {
    pub fn of(map: &Map) -> Self {
        let along = Along::of(map);
        let (mut vertices, mut rings) = (Vec::new(), Vec::new());
        for ring in map.free().iter().flat_map(|free| free.rings()) {
            let first = vertices.len();
            vertices.extend(ring_vertices(ring));
            along.label(&mut vertices[first..]);
            rings.push(first..vertices.len());
        }
        spine::limit(map, &mut vertices);
        let pieces: Vec<Piece> = rings.iter().flat_map(|ring| ring_pieces(&vertices, ring)).collect();
        let index = Index::of(map.workspace(), &vertices, &pieces);
        let length_m = vertices.iter().map(|vertex| vertex.along_m).fold(0.0, f64::max);
        let knot_m = KNOT_M.max(length_m / (MOST_KNOTS - 2.0));
        let knots = (length_m / knot_m) as usize + 2;
        let mut lumen = Self { vertices, rings, pieces, index, along, knot_m, knots, flow: OnceLock::new() };
        lumen.find_covered();
        lumen
    }

    /// Finds the vertices that others cover when all walls close in alike.
    fn find_covered(&mut self) {
        let waves_m = COVERED_AT_M.map(|closing_m| vec![closing_m; self.knots]);
        let is_covered = |vertex: &WallVertex| {
            waves_m.iter().any(|wave_m| {
                let place = moved(vertex, self.closing_m(vertex, wave_m));
                self.nearest_within(place, -COVERED_M, wave_m).is_some()
            })
        };
        let covered: Vec<bool> = self.vertices.iter().map(is_covered).collect();
        for (vertex, is_covered) in self.vertices.iter_mut().zip(covered) {
            vertex.is_in_corner = is_covered || vertex.inward.norm() > MITRED;
        }
    }

    /// Changes how far vertices close in at most.
    #[cfg(test)]
    pub(super) fn limit(&mut self, limit_m: impl Fn(&WallVertex) -> f64) {
        self.vertices.iter_mut().for_each(|vertex| vertex.limit_m = limit_m(vertex));
    }

    /// The vertices of each closed outline.
    pub fn rings(&self) -> impl Iterator<Item = &[WallVertex]> {
        self.rings.iter().map(|ring| &self.vertices[ring.clone()])
    }

    /// Spacing of the samples of a wave along the lumen.
    pub fn knot_m(&self) -> f64 {
        self.knot_m
    }

    /// Coordinates along the lumen at which a wave is sampled.
    pub fn knots_m(&self) -> impl Iterator<Item = f64> + Clone + use<> {
        let knot_m = self.knot_m;
        (0..self.knots).map(move |knot| knot as f64 * knot_m)
    }

    /// The coordinates of the walls that a bead at a place may touch within a few milliseconds.
    pub(super) fn beside_m(&self, place: Point2<f64>) -> RangeInclusive<f64> {
        let here_m = self.along.at_m(place);
        if here_m.is_finite() { here_m - BESIDE_M..=here_m + BESIDE_M } else { 0.0..=f64::INFINITY }
    }

    /// How far a vertex has closed in, given the wave at the knots.
    fn closing_m(&self, vertex: &WallVertex, wave_m: &[f64]) -> f64 {
        let at = vertex.along_m / self.knot_m;
        let knot = (at as usize).min(wave_m.len() - 2);
        let part = at - knot as f64;
        (wave_m[knot] * (1.0 - part) + wave_m[knot + 1] * part).min(vertex.limit_m)
    }

    /// The area that the walls cover beyond their drawn place, one closed band for each outline.
    pub fn bands(&self, wave_m: &[f64], bead_m: Point2<f64>) -> Vec<Band> {
        let band = |ring: &[WallVertex]| {
            let closings_m: Vec<f64> = ring.iter().map(|vertex| self.shown_m(vertex, wave_m, bead_m)).collect();
            let edge = |at: usize| {
                let [before, after] = beside(ring, at);
                let span = ring[after].place_m - ring[before].place_m;
                let Some(along) = span.try_normalize(1e-6) else { return moved(&ring[at], closings_m[at]) };
                // The common tangent of discs whose radius changes.
                let slope = ((closings_m[after] - closings_m[before]) / span.norm()).clamp(-0.9, 0.9);
                let place = moved(&ring[at], closings_m[at] * (1.0 - slope * slope).sqrt());
                let place = place - along * (closings_m[at] * slope);
                if ring[at].is_in_corner { self.on_outline(place, wave_m) } else { place }
            };
            Band {
                foot_m: ring.iter().map(|vertex| vertex.place_m.into()).collect(),
                edge_m: (0..ring.len()).map(|at| edge(at).into()).collect(),
            }
        };
        self.rings().map(band).collect()
    }

    /// A place near the moved walls' outline, moved onto it.
    fn on_outline(&self, mut place: Point2<f64>, wave_m: &[f64]) -> Point2<f64> {
        for _ in 0..UNCOVERINGS {
            match self.nearest_within(place, BEAD_RADIUS_M, wave_m) {
                Some(nearest) if nearest.distance_m.abs() > COVERED_M => place -= nearest.normal * nearest.distance_m,
                _ => break,
            }
        }
        place
    }

    /// How far a vertex has closed in, with a bead that it may have closed on.
    fn shown_m(&self, vertex: &WallVertex, wave_m: &[f64], bead_m: Point2<f64>) -> f64 {
        let room_m = (bead_m - vertex.place_m).norm() - BEAD_RADIUS_M;
        self.closing_m(vertex, wave_m).min(room_m.max(0.0))
    }

    /// The nearest place of the moved walls within `within_m` of a point on the free side; `within_m` is at most a
    /// bead's radius, and a little. `wave_m` gives the wave at the knots.
    pub(super) fn nearest_within(&self, point: Point2<f64>, within_m: f64, wave_m: &[f64]) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let mut limit_m = within_m;
        for &number in self.index.at(point) {
            let piece = &self.pieces[number as usize];
            let [a, b] = piece.vertices.map(|vertex| &self.vertices[vertex as usize]);
            let offset = point - a.place_m;
            let left = Vector2::new(-piece.along.y, piece.along.x).dot(&offset);
            // Behind it, this wall does not close in.
            if left < -1e-9 {
                continue;
            }
            let closings_m = [self.closing_m(a, wave_m), self.closing_m(b, wave_m)];
            let most_m = closings_m[0].max(closings_m[1]);
            if left > limit_m + most_m {
                continue;
            }
            // The nearest disc: the radius changes by `slope` per length, which moves it along by this much.
            let slope = ((closings_m[1] - closings_m[0]) / piece.length_m).clamp(-0.99, 0.99);
            let ahead_m = piece.along.dot(&offset) + left.max(0.0) * slope / (1.0 - slope * slope).sqrt();
            let share = (ahead_m / piece.length_m).clamp(0.0, 1.0);
            let from = offset - piece.along * (share * piece.length_m);
            let away_m = from.norm();
            let distance_m = away_m - (closings_m[0] * (1.0 - share) + closings_m[1] * share);
            if distance_m <= limit_m && away_m > 1e-12 {
                limit_m = distance_m;
                best = Some(Nearest { distance_m, normal: from / away_m, at: (number, share) });
            }
        }
        best
    }

    /// How far the wall has closed in at a place of [`Self::nearest_within`].
    pub(super) fn closing_at_m(&self, nearest: &Nearest, wave_m: &[f64]) -> f64 {
        let (number, share) = nearest.at;
        let [a, b] = self.pieces[number as usize].vertices.map(|vertex| {
            let vertex = &self.vertices[vertex as usize];
            self.closing_m(vertex, wave_m)
        });
        a * (1.0 - share) + b * share
    }

    /// Direction of the flow along the lumen: 1 in a channel, less in a bay, 0 in a wall.
    pub fn flow(&self, point: Point2<f64>) -> Vector2<f64> {
        self.flow.get_or_init(|| Flow::of(&self.along)).at(point)
    }
}

/// The vertices before and after one, far enough apart for a direction.
fn beside(ring: &[WallVertex], at: usize) -> [usize; 2] {
    let count = ring.len();
    let is_far = |other: usize| (ring[other].place_m - ring[at].place_m).norm() >= 0.5 * PIECE_M;
    let find = |step: usize| {
        let others = (1..count).map(|number| (at + number * step) % count);
        others.take(MOST_BESIDE).find(|&other| is_far(other)).unwrap_or((at + step) % count)
    };
    [find(count - 1), find(1)]
}

fn moved(vertex: &WallVertex, closing_m: f64) -> Point2<f64> {
    vertex.place_m + vertex.inward * closing_m
}

/// The vertices of a ring with free space on its left. Long edges are divided; outward corners get several vertices.
fn ring_vertices(ring: &[[f64; 2]]) -> Vec<WallVertex> {
    let mut corners: Vec<Point2<f64>> = ring.iter().map(|&[x, y]| Point2::new(x, y)).collect();
    corners.dedup_by(|a, b| (*a - *b).norm() < 1e-9);
    let count = corners.len();
    let edge = |corner: usize| corners[(corner + 1) % count] - corners[corner];
    let left = |span: Vector2<f64>| Vector2::new(-span.y, span.x).normalize();
    let mut vertices = Vec::new();
    let mut add = |place_m, inward| {
        vertices.push(WallVertex { place_m, inward, along_m: 0.0, limit_m: 0.0, is_in_corner: false })
    };
    for (corner, &here) in corners.iter().enumerate() {
        let (before, after) = (left(edge((corner + count - 1) % count)), left(edge(corner)));
        let turn_rad = before.perp(&after).atan2(before.dot(&after));
        if turn_rad < -FAN_RAD {
            let steps = (-turn_rad / FAN_RAD).ceil() as usize;
            for step in 0..=steps {
                let (sin, cos) = (turn_rad * step as f64 / steps as f64).sin_cos();
                add(here, Vector2::new(before.x * cos - before.y * sin, before.x * sin + before.y * cos));
            }
        } else {
            let middle = (before + after).try_normalize(1e-9).unwrap_or(after);
            add(here, middle * (1.0 / middle.dot(&after).max(1.0 / MOST_MITRE)).max(1.0));
        }
        let span = edge(corner);
        let parts = (span.norm() / PIECE_M).ceil() as usize;
        for part in 1..parts {
            add(here + span * (part as f64 / parts as f64), after);
        }
    }
    vertices
}

fn ring_pieces<'a>(vertices: &'a [WallVertex], ring: &'a Range<usize>) -> impl Iterator<Item = Piece> + 'a {
    ring.clone().filter_map(move |first| {
        let next = if first + 1 == ring.end { ring.start } else { first + 1 };
        let span = vertices[next].place_m - vertices[first].place_m;
        let length_m = span.norm();
        // The vertices of an outward corner share their place.
        (length_m > 1e-9).then(|| Piece { vertices: [first as u32, next as u32], along: span / length_m, length_m })
    })
}

/// Farthest that a piece of wall reaches into the free side, with a bead beside it.
fn reach_m(vertices: &[WallVertex], piece: &Piece) -> f64 {
    let limit_m = |vertex: u32| vertices[vertex as usize].limit_m;
    limit_m(piece.vertices[0]).max(limit_m(piece.vertices[1])) + 1.01 * BEAD_RADIUS_M
}
