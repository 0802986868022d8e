//! Queries for points, discs and corridors.

use super::ObstacleMap;
use crate::geometry::{Point2, Rect, Vector2};

/// Content of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellState {
    /// Not observed.
    Unknown,
    /// Observed, without an obstacle.
    Free,
    /// Observed as an obstacle.
    Obstacle,
}

/// Content of an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Area {
    /// Completely observed and free.
    Free,
    /// Without a known obstacle, but not completely observed.
    Unknown,
    /// It touches an obstacle, or leaves the workspace.
    Blocked,
}

/// How unknown cells are treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// As free.
    Free,
    /// As obstacles.
    Blocked,
}

impl ObstacleMap {
    /// Content of the cell under a point. Outside the workspace everything is an obstacle.
    pub fn state(&self, point: Point2<f64>) -> CellState {
        if !self.workspace.contains(point) {
            return CellState::Obstacle;
        }
        let (columns, rows) = self.shape();
        let at = self.in_cells(point);
        self.cell_state((at.x as usize).min(columns - 1), (at.y as usize).min(rows - 1))
    }

    /// Content of a disc.
    pub fn disc(&self, center: Point2<f64>, radius_m: f64) -> Area {
        if !self.keeps_in(center, center, radius_m) {
            return Area::Blocked;
        }
        // Most discs are in a square of one kind, which takes a tenth of the time to look at.
        let (columns, rows) = self.shape();
        let reach = Vector2::new(radius_m, radius_m);
        let [low, high] = [center - reach, center + reach].map(|corner| self.in_cells(corner));
        // Also the cells that the disc only touches. Casting a negative number gives 0.
        let [first, end] = [low.map(|at| (at.ceil() - 1.0) as usize), high.map(|at| at as usize + 1)];
        let across = [first.x.min(columns), end.x.min(columns)];
        let mut up = first.y..end.y.min(rows);
        if !up.clone().any(|row| self.cells.obstacle.any(row, across[0], across[1])) {
            if up.clone().all(|row| self.cells.seen.all(row, across[0], across[1])) {
                return Area::Free;
            }
            if !up.any(|row| self.cells.seen.any(row, across[0], across[1])) {
                return Area::Unknown;
            }
        }
        self.corridor(center, center, radius_m)
    }

    /// Content of the corridor of all points within `clearance_m` of a straight line. A corridor with a number that is
    /// NaN is blocked.
    pub fn corridor(&self, from: Point2<f64>, to: Point2<f64>, clearance_m: f64) -> Area {
        if !self.keeps_in(from, to, clearance_m) {
            return Area::Blocked;
        }
        let mut spans = self.spans(from, to, clearance_m);
        if spans.clone().any(|(row, [first, end])| self.cells.obstacle.any(row, first, end)) {
            return Area::Blocked;
        }
        let all_seen = spans.all(|(row, [first, end])| self.cells.seen.all(row, first, end));
        if all_seen { Area::Free } else { Area::Unknown }
    }

    /// Whether a corridor is free.
    pub fn is_corridor_free(&self, from: Point2<f64>, to: Point2<f64>, clearance_m: f64, unknown: Unknown) -> bool {
        match unknown {
            Unknown::Blocked => self.corridor(from, to, clearance_m) == Area::Free,
            Unknown::Free => {
                self.keeps_in(from, to, clearance_m)
                    && !self
                        .spans(from, to, clearance_m)
                        .any(|(row, [first, end])| self.cells.obstacle.any(row, first, end))
            }
        }
    }

    /// Distance to the nearest known obstacle or to the workspace's border; 0 inside an obstacle or outside.
    pub fn nearest_obstacle_m(&self, point: Point2<f64>) -> f64 {
        let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = self.workspace;
        if !self.workspace.contains(point) {
            return 0.0;
        }
        let border = [point.x - x_min_m, x_max_m - point.x, point.y - y_min_m, y_max_m - point.y];
        let mut nearest_m = border.into_iter().fold(f64::INFINITY, f64::min);
        let (columns, rows) = self.shape();
        let at = self.in_cells(point);
        let (column, row) = ((at.x as usize).min(columns - 1), (at.y as usize).min(rows - 1));
        let mut look = |row: usize| {
            let dy_m = (self.row_edge_m(row) - point.y).max(point.y - self.row_edge_m(row + 1)).max(0.0);
            if dy_m >= nearest_m {
                return false;
            }
            let obstacle = &self.cells.obstacle;
            for found in [obstacle.previous(row, column), obstacle.next(row, column)].into_iter().flatten() {
                let dx_m = (self.column_edge_m(found) - point.x).max(point.x - self.column_edge_m(found + 1));
                nearest_m = nearest_m.min(dy_m.hypot(dx_m.max(0.0)));
            }
            true
        };
        let _ = (row..rows).all(&mut look);
        let _ = (0..row).rev().all(&mut look);
        nearest_m
    }

    /// The whole grid in run-length encoding, row by row from the smallest y, each row from the smallest x. Runs may
    /// continue in the next row.
    pub fn runs(&self) -> Vec<(CellState, u32)> {
        let (columns, rows) = self.shape();
        let mut runs: Vec<(CellState, u32)> = Vec::new();
        for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
            let state = self.cell_state(column, row);
            match runs.last_mut() {
                Some((last, count)) if *last == state => *count += 1,
                _ => runs.push((state, 1)),
            }
        }
        runs
    }

    pub(super) fn cell_state(&self, column: usize, row: usize) -> CellState {
        match (self.cells.seen.get(column, row), self.cells.obstacle.get(column, row)) {
            (_, true) => CellState::Obstacle,
            (true, false) => CellState::Free,
            (false, false) => CellState::Unknown,
        }
    }

    /// A point in units of cells, from the corner of smallest x and y.
    fn in_cells(&self, point: Point2<f64>) -> Vector2<f64> {
        let corner = Point2::new(self.workspace.x_min_m, self.workspace.y_min_m);
        (point - corner).component_div(&self.cell_m())
    }

    /// Whether a capsule is inside the workspace, that is, both of its end discs are.
    fn keeps_in(&self, from: Point2<f64>, to: Point2<f64>, radius_m: f64) -> bool {
        let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = self.workspace;
        let inner = Rect {
            x_min_m: x_min_m + radius_m,
            x_max_m: x_max_m - radius_m,
            y_min_m: y_min_m + radius_m,
            y_max_m: y_max_m - radius_m,
        };
        inner.contains(from) && inner.contains(to)
    }

    /// The half-open column range, for each row, that a capsule inside the workspace touches.
    fn spans(
        &self,
        from: Point2<f64>,
        to: Point2<f64>,
        radius_m: f64,
    ) -> impl Iterator<Item = (usize, [usize; 2])> + Clone {
        let (columns, rows) = self.shape();
        let cell_m = self.cell_m();
        let corner = Point2::new(self.workspace.x_min_m, self.workspace.y_min_m);
        let touched = move |low_m: f64, high_m: f64, cell_m: f64, count: usize| {
            let first = ((low_m / cell_m).ceil() - 1.0).max(0.0) as usize;
            // Casting a negative number gives 0.
            let end = ((high_m / cell_m).floor() + 1.0) as usize;
            [first.min(count), end.min(count)]
        };
        // Relative to the corner.
        let capsule = Capsule::new(from - corner, to - corner, radius_m.max(0.0));
        let [low_m, high_m] = capsule.extent_y();
        let [first, end] = touched(low_m, high_m, cell_m.y, rows);
        (first..end).filter_map(move |row| {
            let strip = [row as f64 * cell_m.y, (row + 1) as f64 * cell_m.y];
            let [low_m, high_m] = capsule.extent_x(strip);
            let span = touched(low_m, high_m, cell_m.x, columns);
            (span[0] < span[1]).then_some((row, span))
        })
    }
}

/// All points within `radius_m` of a straight line.
#[derive(Clone, Copy)]
struct Capsule {
    from: Vector2<f64>,
    to: Vector2<f64>,
    radius_m: f64,
    /// Vector from the line to its side of larger x; `None` for a point.
    flank: Option<Vector2<f64>>,
}

impl Capsule {
    fn new(from: Vector2<f64>, to: Vector2<f64>, radius_m: f64) -> Self {
        let along = to - from;
        let flank = Vector2::new(along.y, -along.x).try_normalize(0.0);
        let flank = flank.map(|normal| normal * if normal.x < 0.0 { -radius_m } else { radius_m });
        Self { from, to, radius_m, flank }
    }

    fn extent_y(&self) -> [f64; 2] {
        [self.from.y.min(self.to.y) - self.radius_m, self.from.y.max(self.to.y) + self.radius_m]
    }

    /// Smallest and largest x between two values of y; an empty range without points.
    fn extent_x(&self, strip: [f64; 2]) -> [f64; 2] {
        let mirrored = |v: Vector2<f64>| Vector2::new(-v.x, v.y);
        // The side of smaller x, mirrored, is the side of larger x of the mirrored capsule.
        let other = Self {
            from: mirrored(self.from),
            to: mirrored(self.to),
            radius_m: self.radius_m,
            flank: self.flank.map(|flank| mirrored(-flank)),
        };
        [-other.greatest_x(strip), self.greatest_x(strip)]
    }

    fn greatest_x(&self, [low, high]: [f64; 2]) -> f64 {
        // The outline is concave as a function of y: the maximum is as close to its top as the strip allows.
        let top = if self.from.x >= self.to.x { self.from } else { self.to };
        let y = top.y.clamp(low, high);
        let on_disc = |center: Vector2<f64>| {
            let rest = self.radius_m * self.radius_m - (y - center.y) * (y - center.y);
            (rest >= 0.0).then(|| center.x + rest.sqrt())
        };
        let on_flank = || {
            let [from, to] = [self.from + self.flank?, self.to + self.flank?];
            let share = (y - from.y) / (to.y - from.y);
            (0.0..=1.0).contains(&share).then(|| from.x + share * (to.x - from.x))
        };
        let found = [on_disc(self.from), on_disc(self.to), on_flank()];
        found.into_iter().flatten().fold(f64::NEG_INFINITY, f64::max)
    }
}
