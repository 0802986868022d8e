//! The lumen of a map: the room between its walls, seen as a tube with a coordinate along it.
//!
//! Walls that move stay above their drawn place and close in on the free side: around every point of a wall lies a disc
//! whose radius is how far the wall has closed in there. The discs' radii change linearly between two vertices, so a
//! piece of wall is a round cone, and its distance from a point has a closed form. A closing is limited so that walls of
//! opposite sides do not cross ([`spine`]), and it stops at the bead: the tissue yields to a bead that it has closed on.

mod along;
mod flow;
mod index;
mod outline;
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
/// Vertices that are nearer than this are one.
const SAME_PLACE_M: f64 = 1e-9;
/// Walls farther along the lumen than this cannot reach the bead: the most that one closes in, the bead's size, the
/// grid's steps, and what the fastest bead travels in a tick.
const BESIDE_M: f64 = 0.12;
/// Spacing of the samples of a wave along the lumen, and their largest number.
const KNOT_M: f64 = 0.005;
const MOST_KNOTS: f64 = 256.0;

/// A vertex of the walls' outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallVertex {
    /// Where it is while the wall is at rest.
    pub place_m: Point2<f64>,
    /// Toward the free side; in a corner, halfway between the normals of both sides.
    inward: Vector2<f64>,
    /// Coordinate along the lumen.
    pub along_m: f64,
    /// The most that it closes in.
    pub limit_m: f64,
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
        Self { vertices, rings, pieces, index, along, knot_m, knots, flow: OnceLock::new() }
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
        let closings_m = |ring: &[WallVertex]| ring.iter().map(|vertex| self.shown_m(vertex, wave_m, bead_m)).collect();
        self.rings().map(|ring| outline::band(ring, closings_m(ring))).collect()
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

/// The vertices of a ring with free space on its left. Long edges are divided.
fn ring_vertices(ring: &[[f64; 2]]) -> Vec<WallVertex> {
    let mut corners: Vec<Point2<f64>> = ring.iter().map(|&[x, y]| Point2::new(x, y)).collect();
    corners.dedup_by(|a, b| (*a - *b).norm() < SAME_PLACE_M);
    let count = corners.len();
    let edge = |corner: usize| corners[(corner + 1) % count] - corners[corner];
    let left = |span: Vector2<f64>| Vector2::new(-span.y, span.x).normalize();
    let mut vertices = Vec::new();
    for (corner, &here) in corners.iter().enumerate() {
        let (before, after) = (left(edge((corner + count - 1) % count)), left(edge(corner)));
        let middle = (before + after).try_normalize(1e-9).unwrap_or(after);
        let parts = (edge(corner).norm() / PIECE_M).ceil() as usize;
        vertices.extend((0..parts).map(|part| WallVertex {
            place_m: here + edge(corner) * (part as f64 / parts as f64),
            inward: if part == 0 { middle } else { after },
            along_m: 0.0,
            limit_m: 0.0,
        }));
    }
    vertices
}

fn ring_pieces<'a>(vertices: &'a [WallVertex], ring: &'a Range<usize>) -> impl Iterator<Item = Piece> + 'a {
    ring.clone().filter_map(move |first| {
        let next = if first + 1 == ring.end { ring.start } else { first + 1 };
        let span = vertices[next].place_m - vertices[first].place_m;
        let length_m = span.norm();
        (length_m > SAME_PLACE_M).then(|| Piece {
            vertices: [first as u32, next as u32],
            along: span / length_m,
            length_m,
        })
    })
}

/// Farthest that a piece of wall reaches into the free side, with a bead beside it.
fn reach_m(vertices: &[WallVertex], piece: &Piece) -> f64 {
    let limit_m = |vertex: u32| vertices[vertex as usize].limit_m;
    limit_m(piece.vertices[0]).max(limit_m(piece.vertices[1])) + 1.01 * BEAD_RADIUS_M
}
