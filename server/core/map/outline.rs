//! The outline of free space, indexed for fast point queries.

use parry2d_f64::{
    math::Vector,
    shape::{CompositeShapeRef, Polyline},
};

use crate::geometry::{Point2, Polygon};

/// Rows are halved until they hold at most this many copies of each edge, so that thousands of long edges cost time but
/// not memory.
const COPIES_PER_EDGE: usize = 8;

/// Closed rings around free space.
#[derive(Clone)]
pub(super) struct Outline {
    edges: Polyline,
    rows: Rows,
}

impl Outline {
    pub fn of(free: &[Polygon]) -> Self {
        let mut vertices = Vec::new();
        let mut indices = Vec::new();
        for ring in free.iter().flat_map(Polygon::rings) {
            let first = vertices.len() as u32;
            let count = ring.len() as u32;
            vertices.extend(ring.iter().map(|&[x, y]| Vector::new(x, y)));
            indices.extend((0..count).map(|i| [first + i, first + (i + 1) % count]));
        }
        let edges = Polyline::new(vertices, Some(indices));
        let rows = Rows::of(edges.segments().map(|s| [s.a.x, s.a.y, s.b.x, s.b.y]).collect());
        Self { edges, rows }
    }

    /// The nearest point of any ring; `point` itself if it is not finite.
    pub fn nearest(&self, point: Point2<f64>) -> Point2<f64> {
        self.project(point, f64::MAX).unwrap_or(point)
    }

    /// The nearest point of any ring, if it is within `radius_m`.
    pub fn nearest_within(&self, point: Point2<f64>, radius_m: f64) -> Option<Point2<f64>> {
        // The search finds only points strictly within its limit and rounds boxes, so the limit is slightly larger.
        let found = self.project(point, radius_m + 1e-9)?;
        ((found - point).norm() <= radius_m).then_some(found)
    }

    fn project(&self, point: Point2<f64>, limit_m: f64) -> Option<Point2<f64>> {
        let point = Vector::new(point.x, point.y);
        let (_, found) = CompositeShapeRef(&self.edges).project_local_point(point, limit_m, false)?;
        Some(Point2::new(found.point.x, found.point.y))
    }

    /// Whether a point is inside, by the even–odd rule.
    pub fn contains(&self, point: Point2<f64>) -> bool {
        let mut inside = false;
        for &[ax, ay, bx, by] in self.rows.at(point.y) {
            if (ay > point.y) != (by > point.y) && point.x < (bx - ax) * (point.y - ay) / (by - ay) + ax {
                inside = !inside;
            }
        }
        inside
    }
}

/// Edges `[ax, ay, bx, by]`, grouped by the horizontal rows that they cross.
#[derive(Clone)]
struct Rows {
    y_min_m: f64,
    rows_per_m: f64,
    /// Start of each row in `edges`, and the end of the last row.
    starts: Vec<usize>,
    edges: Vec<[f64; 4]>,
}

impl Rows {
    fn of(edges: Vec<[f64; 4]>) -> Self {
        let heights = || edges.iter().flat_map(|e| [e[1], e[3]]);
        let y_min_m = heights().fold(f64::INFINITY, f64::min);
        let height_m = heights().fold(f64::NEG_INFINITY, f64::max) - y_min_m;
        let mut count = edges.len().next_power_of_two();
        loop {
            let mut rows =
                Self { y_min_m, rows_per_m: count as f64 / height_m, starts: vec![0; count + 1], edges: vec![] };
            let spans: Vec<_> = edges.iter().map(|e| rows.row(e[1].min(e[3]))..rows.row(e[1].max(e[3])) + 1).collect();
            let copies: usize = spans.iter().map(ExactSizeIterator::len).sum();
            if copies > COPIES_PER_EDGE * edges.len() && count > 1 {
                count /= 2;
                continue;
            }
            for row in spans.iter().cloned().flatten() {
                rows.starts[row + 1] += 1;
            }
            for row in 0..count {
                rows.starts[row + 1] += rows.starts[row];
            }
            let mut next = rows.starts.clone();
            rows.edges.resize(copies, [0.0; 4]);
            for (edge, span) in edges.iter().zip(spans) {
                for row in span {
                    rows.edges[next[row]] = *edge;
                    next[row] += 1;
                }
            }
            return rows;
        }
    }

    /// Rounding is monotonic, so the row of a point contains all edges at its height.
    fn row(&self, y_m: f64) -> usize {
        (((y_m - self.y_min_m) * self.rows_per_m) as usize).min(self.starts.len() - 2)
    }

    fn at(&self, y_m: f64) -> &[[f64; 4]] {
        let row = self.row(y_m);
        &self.edges[self.starts[row]..self.starts[row + 1]]
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::super::Map;
    use super::*;

    /// Random points: anywhere, at the height of a vertex, on a vertex, and on an edge.
    fn points(map: &Map, count: usize) -> Vec<Point2<f64>> {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let w = *map.workspace();
        let vertices: Vec<[f64; 2]> = map.free().iter().flat_map(Polygon::rings).flatten().copied().collect();
        (0..count)
            .map(|k| {
                let [x, y] = vertices[rng.random_range(0..vertices.len())];
                let anywhere_m = rng.random_range(w.x_min_m - 0.1..w.x_max_m + 0.1);
                match k % 4 {
                    0 => Point2::new(anywhere_m, rng.random_range(w.y_min_m - 0.1..w.y_max_m + 0.1)),
                    1 => Point2::new(anywhere_m, y),
                    2 => Point2::new(x, y),
                    _ => map.nearest_wall_point(Point2::new(anywhere_m, y)),
                }
            })
            .collect()
    }

    #[test]
    fn rows_agree_with_a_loop_over_every_edge() {
        for name in Map::shipped_names() {
            let map = Map::shipped(&name).unwrap();
            let outline = Outline::of(map.free());
            for p in points(&map, 4000) {
                let crossings = outline.edges.segments().filter(|s| {
                    let (a, b) = (s.a, s.b);
                    (a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x
                });
                assert_eq!(map.is_free(p), crossings.count() % 2 == 1, "{name} {p}");
            }
        }
    }

    #[test]
    fn searches_with_and_without_a_radius_agree() {
        for name in Map::shipped_names() {
            let map = Map::shipped(&name).unwrap();
            for p in points(&map, 4000) {
                let nearest = map.nearest_wall_point(p);
                let distance_m = (nearest - p).norm();
                for radius_m in [0.0, 0.0026, 0.01, distance_m] {
                    let expected = (distance_m <= radius_m).then_some(nearest);
                    assert_eq!(map.nearest_wall_point_within(p, radius_m), expected, "{name} {p} {radius_m}");
                }
            }
        }
    }

    #[test]
    fn edges_that_span_the_map_do_not_use_much_memory() {
        let comb = (0..1000).map(|i| [f64::from(i), 0.0, f64::from(i) + 0.5, 1.0]).collect();
        assert!(Rows::of(comb).edges.len() <= COPIES_PER_EDGE * 1000);
    }
}
