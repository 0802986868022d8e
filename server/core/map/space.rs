//! Free space on a grid: connected components, path lengths and uniform sampling.

use pathfinding::prelude::{astar, dijkstra_all};
use rand::{Rng, RngExt};

use super::Map;
use crate::geometry::Point2;

const CELL_M: f64 = 0.005;

/// Upper bound of rounding errors in positions and distances.
const ROUNDING_M: f64 = 1e-9;

/// The points of a map that keep `clearance_m` from every wall, on a 5 mm grid.
#[derive(Clone, Debug)]
pub struct FreeSpace {
    columns: usize,
    origin_m: [f64; 2],
    clearance_m: f64,
    /// Component of each cell, row-major from the lower left; `None` if a wall is too close.
    component: Vec<Option<u32>>,
}

impl FreeSpace {
    /// Rasterises `map`. A cell is free if its centre keeps `clearance_m`.
    pub fn new(map: &Map, clearance_m: f64) -> Self {
        let w = map.workspace();
        let columns = ((w.x_max_m - w.x_min_m) / CELL_M).round().max(1.0) as usize;
        let rows = ((w.y_max_m - w.y_min_m) / CELL_M).round().max(1.0) as usize;
        let mut space =
            Self { columns, origin_m: [w.x_min_m, w.y_min_m], clearance_m, component: vec![None; columns * rows] };
        let free = space.rasterise(map);
        let mut next = 0;
        for seed in 0..free.len() {
            if !free[seed] || space.component[seed].is_some() {
                continue;
            }
            let mut stack = vec![seed];
            space.component[seed] = Some(next);
            while let Some(cell) = stack.pop() {
                for (neighbour, _) in space.neighbours(cell) {
                    if free[neighbour] && space.component[neighbour].is_none() {
                        space.component[neighbour] = Some(next);
                        stack.push(neighbour);
                    }
                }
            }
            next += 1;
        }
        space
    }

    /// Which cells are free. Between two points the clearance changes by at most their distance, so a cell far from
    /// walls, or deep inside one, decides the next cells in its row too.
    fn rasterise(&self, map: &Map) -> Vec<bool> {
        let mut free = vec![false; self.component.len()];
        for (row, cells) in free.chunks_mut(self.columns).enumerate() {
            let mut column = 0;
            while column < self.columns {
                let center = self.center(row * self.columns + column);
                let distance_m = (map.nearest_wall_point(center) - center).norm();
                // If the distance is too small, the side of the wall does not matter.
                let inside = distance_m < self.clearance_m || map.is_free(center);
                let spare_m = if inside { distance_m } else { -distance_m } - self.clearance_m;
                let equal = 1 + ((spare_m.abs() - ROUNDING_M) / CELL_M).max(0.0) as usize;
                let end = (column + equal).min(self.columns);
                cells[column..end].fill(spare_m >= 0.0);
                column = end;
            }
        }
        free
    }

    /// The centre of each cell; `None` where it is not free.
    pub fn cells(&self) -> impl Iterator<Item = Option<Point2<f64>>> + '_ {
        (0..self.component.len()).map(|cell| self.component[cell].map(|_| self.center(cell)))
    }

    /// The centre of a cell, free or not.
    pub fn center(&self, cell: usize) -> Point2<f64> {
        let (column, row) = (cell % self.columns, cell / self.columns);
        Point2::new(self.origin_m[0] + (column as f64 + 0.5) * CELL_M, self.origin_m[1] + (row as f64 + 0.5) * CELL_M)
    }

    fn cell(&self, point: Point2<f64>) -> Option<usize> {
        let column = ((point.x - self.origin_m[0]) / CELL_M).floor();
        let row = ((point.y - self.origin_m[1]) / CELL_M).floor();
        let rows = self.component.len() / self.columns;
        let inside = column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < rows as f64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// The eight neighbours inside the grid, with their distances in micrometres.
    pub(super) fn neighbours(&self, cell: usize) -> impl Iterator<Item = (usize, u32)> + use<> {
        let (columns, rows) = (self.columns as isize, (self.component.len() / self.columns) as isize);
        let (column, row) = ((cell % self.columns) as isize, (cell / self.columns) as isize);
        let steps = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)];
        steps.into_iter().filter_map(move |(dx, dy)| {
            let (c, r) = (column + dx, row + dy);
            let inside = c >= 0 && r >= 0 && c < columns && r < rows;
            let length_um = if dx != 0 && dy != 0 { 7071 } else { 5000 };
            inside.then_some(((r * columns + c) as usize, length_um))
        })
    }

    /// Length of the shortest path on the grid from a free cell to each cell; infinite where no path leads.
    pub fn lengths_m(&self, from: usize) -> Vec<f64> {
        let mut lengths_m = vec![f64::INFINITY; self.component.len()];
        let next =
            |&cell: &usize| self.neighbours(cell).filter(|&(n, _)| self.component[n].is_some()).collect::<Vec<_>>();
        for (cell, (_, length_um)) in dijkstra_all(&from, next) {
            lengths_m[cell] = f64::from(length_um) * 1e-6;
        }
        lengths_m[from] = 0.0;
        lengths_m
    }

    /// Columns and rows.
    pub fn shape(&self) -> (usize, usize) {
        (self.columns, self.component.len() / self.columns)
    }

    /// The component of each cell, row by row from the smallest y; `None` where it is not free.
    pub fn component_of_cells(&self) -> &[Option<u32>] {
        &self.component
    }

    /// The cells within `reach` columns and rows of a point's cell.
    pub fn cells_around(&self, point: Point2<f64>, reach: i64) -> impl Iterator<Item = usize> + use<> {
        let (columns, rows) = (self.columns as i64, (self.component.len() / self.columns) as i64);
        let at = |along_m: f64, least_m: f64| ((along_m - least_m) / CELL_M).floor() as i64;
        let (column, row) = (at(point.x, self.origin_m[0]), at(point.y, self.origin_m[1]));
        let inside = |from: i64, count: i64| (from - reach).max(0)..(from + reach + 1).min(count);
        let across = inside(column, columns);
        inside(row, rows).flat_map(move |r| across.clone().map(move |c| (r * columns + c) as usize))
    }

    /// Number of connected components.
    pub fn components(&self) -> usize {
        self.component.iter().flatten().max().map_or(0, |&last| last as usize + 1)
    }

    /// Centres of the free cells.
    pub fn points(&self) -> impl Iterator<Item = Point2<f64>> + '_ {
        (0..self.component.len()).filter(|&cell| self.component[cell].is_some()).map(|cell| self.center(cell))
    }

    /// Area of the free cells.
    pub fn area_m2(&self) -> f64 {
        self.points().count() as f64 * CELL_M * CELL_M
    }

    /// Component of the cell that contains `point`, or of the nearest free cell.
    pub fn component_at(&self, point: Point2<f64>) -> Option<u32> {
        self.nearest_free(point).and_then(|cell| self.component[cell])
    }

    /// A uniformly distributed point of the free space, or of one component. It keeps the map's exact clearance.
    /// `None` if 10,000 draws find no point.
    pub fn sample(&self, map: &Map, component: Option<u32>, rng: &mut impl Rng) -> Option<Point2<f64>> {
        let w = map.workspace();
        (0..10_000).find_map(|_| {
            let point = Point2::new(rng.random_range(w.x_min_m..w.x_max_m), rng.random_range(w.y_min_m..w.y_max_m));
            let found = self.cell(point).and_then(|cell| self.component[cell]);
            let wanted = found.is_some() && (component.is_none() || found == component);
            (wanted && map.clearance_m(point) >= self.clearance_m).then_some(point)
        })
    }

    /// Length of the shortest path from `from` to `to` on the grid; `None` without a path. The grid is 8-connected, so
    /// the length is up to 8 % too large.
    pub fn geodesic_m(&self, from: Point2<f64>, to: Point2<f64>) -> Option<f64> {
        let (start, end) = (self.cell(from)?, self.cell(to)?);
        if start == end {
            return Some((to - from).norm());
        }
        let (_, length_um) = self.grid_path(start, end)?;
        Some(f64::from(length_um) * 1e-6)
    }

    /// Length of the shortest path, if there is one.
    pub fn shortest_m(&self, from: Point2<f64>, to: Point2<f64>) -> Option<f64> {
        let path = self.taut_path(from, to)?;
        Some(path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum())
    }

    /// The shortest path on the grid, pulled taut: from each point straight to the farthest visible one. If `from` or
    /// `to` is not free, the nearest free point is used. `None` without a path.
    pub fn taut_path(&self, from: Point2<f64>, to: Point2<f64>) -> Option<Vec<Point2<f64>>> {
        let (start, end) = (self.nearest_free(from)?, self.nearest_free(to)?);
        let (cells, _) = self.grid_path(start, end)?;
        let mut points: Vec<Point2<f64>> = cells.into_iter().map(|cell| self.center(cell)).collect();
        let last = points.len() - 1;
        points[0] = from;
        points[last] = to;
        if last == 0 {
            points = vec![from, to];
        }
        // Forward and backward, because each direction can shorten different parts.
        for _ in 0..2 {
            points = self.shortened(&points);
            points.reverse();
        }
        Some(points)
    }

    fn shortened(&self, points: &[Point2<f64>]) -> Vec<Point2<f64>> {
        let (mut kept, mut at) = (vec![points[0]], 0);
        while at + 1 < points.len() {
            let seen = (at + 2..points.len()).rev().find(|&next| self.sees(points[at], points[next]));
            at = seen.unwrap_or(at + 1);
            kept.push(points[at]);
        }
        kept
    }

    /// Whether all cells on the straight line are free.
    fn sees(&self, from: Point2<f64>, to: Point2<f64>) -> bool {
        let offset = to - from;
        let steps = (offset.norm() / (0.25 * CELL_M)).ceil().max(1.0) as usize;
        (0..=steps).all(|step| {
            let place = from + offset * (step as f64 / steps as f64);
            self.cell(place).is_some_and(|cell| self.component[cell].is_some())
        })
    }

    fn nearest_free(&self, point: Point2<f64>) -> Option<usize> {
        if let Some(cell) = self.cell(point).filter(|&cell| self.component[cell].is_some()) {
            return Some(cell);
        }
        let distance_m = |&cell: &usize| (self.center(cell) - point).norm();
        let free = (0..self.component.len()).filter(|&cell| self.component[cell].is_some());
        free.min_by(|a, b| distance_m(a).total_cmp(&distance_m(b)))
    }

    /// The shortest path over free cells including both ends, and its length in micrometres.
    fn grid_path(&self, start: usize, end: usize) -> Option<(Vec<usize>, u32)> {
        if self.component[start].is_none() || self.component[start] != self.component[end] {
            return None;
        }
        let free = |&cell: &usize| self.neighbours(cell).filter(|&(n, _)| self.component[n].is_some());
        let goal = self.center(end);
        // Slightly less than the straight line, because diagonal steps are rounded down.
        let left_um = |&cell: &usize| ((goal - self.center(cell)).norm() * 0.999e6) as u32;
        astar(&start, |cell| free(cell).collect::<Vec<_>>(), left_um, |&cell| cell == end)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;

    fn two_rooms() -> Map {
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 200 200 200">
            <rect x="-5" y="200" width="10" height="200"/></svg>"#;
        Map::from_svg("rooms", svg).unwrap()
    }

    #[test]
    fn rooms_are_components_without_a_path_between_them() {
        let map = two_rooms();
        let space = FreeSpace::new(&map, 0.012);
        let (left, right) = (Point2::new(-0.05, -0.3), Point2::new(0.05, -0.3));
        assert_ne!(space.component_at(left), space.component_at(right));
        assert_eq!(space.geodesic_m(left, right), None);
        let there = space.geodesic_m(Point2::new(-0.05, -0.35), Point2::new(-0.05, -0.25)).unwrap();
        assert!((there - 0.1).abs() < 0.01, "{there}");
    }

    fn length_m(points: &[Point2<f64>]) -> f64 {
        points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }

    #[test]
    fn a_taut_path_has_the_length_from_geometry() {
        // A wall from below up to y = -0.25. The shortest path passes over its tip, 5 mm wide, with 10 mm clearance.
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-200 200 400 200">
            <rect x="-5" y="250" width="10" height="150"/></svg>"#;
        let space = FreeSpace::new(&Map::from_svg("wall", svg).unwrap(), 0.01);
        let (from, to) = (Point2::new(-0.15, -0.35), Point2::new(0.15, -0.35));
        // Around two corners at 10 mm: two tangents and two arcs of that radius.
        let (dx, dy, radius_m) = (0.145, 0.1, 0.01_f64);
        let distance_m = f64::hypot(dx, dy);
        let tangent_m = (distance_m * distance_m - radius_m * radius_m).sqrt();
        let arc_rad = std::f64::consts::FRAC_PI_2 + (dx / distance_m).acos() - (radius_m / distance_m).acos();
        let expected_m = 2.0 * (tangent_m + arc_rad * radius_m) + 0.01;
        let found_m = length_m(&space.taut_path(from, to).unwrap());
        assert!((found_m / expected_m - 1.0).abs() < 0.02, "{found_m} {expected_m}");
        assert!(found_m < space.geodesic_m(from, to).unwrap());

        let near = Point2::new(-0.149, -0.35);
        assert!((length_m(&space.taut_path(from, near).unwrap()) - 0.001).abs() < 1e-12);
        let straight = space.taut_path(Point2::new(-0.15, -0.22), Point2::new(0.15, -0.23)).unwrap();
        assert_eq!(straight.len(), 2);
        // Inside a wall, it starts at the nearest free place.
        assert!(space.taut_path(Point2::new(0.0, -0.3), to).is_some());
        assert!(
            FreeSpace::new(&two_rooms(), 0.012).taut_path(Point2::new(-0.05, -0.3), Point2::new(0.05, -0.3)).is_none()
        );
    }

    #[test]
    fn a_cell_is_free_exactly_if_its_centre_is() {
        for map in Map::shipped_names().iter().map(|name| Map::shipped(name).unwrap()).chain([two_rooms()]) {
            for clearance_m in [0.0, 0.0025, 0.012] {
                let space = FreeSpace::new(&map, clearance_m);
                for cell in 0..space.component.len() {
                    let free = map.clearance_m(space.center(cell)) >= clearance_m;
                    assert_eq!(space.component[cell].is_some(), free, "{} {}", map.name(), space.center(cell));
                }
            }
        }
    }

    #[test]
    fn samples_keep_the_clearance_and_the_component() {
        let map = two_rooms();
        let space = FreeSpace::new(&map, 0.012);
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let left = space.component_at(Point2::new(-0.05, -0.3));
        for _ in 0..200 {
            let point = space.sample(&map, left, &mut rng).unwrap();
            assert!(point.x < 0.0 && map.clearance_m(point) >= 0.012);
        }
    }
}
