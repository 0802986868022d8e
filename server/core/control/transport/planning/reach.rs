//! Decides by flood fill on the map's cells whether a path exists and which clearance it can keep.
//!
//! A random search cannot distinguish a missing path from an unlucky sample, so this test comes first. It is not from
//! the publication. Levels of clearance are tried from the largest to the smallest, each on cells that have a third
//! more, so that the random search has room. If all fail, the fill uses every cell that a path with the smallest
//! clearance could touch. If those do not lead to the goal either, no path exists.

use crate::geometry::{Point2, Rect, Vector2};
use crate::perception::CellRect;

use super::clearance::{Clearance, End, GROWTH, PIECE_M, ROUNDING_M, levels_m};

/// Extra clearance, as a share of the required one, that leaves room for a random search.
const ROOM: f64 = 1.0 / 3.0;
/// Steps along a line shorter than this take longer than to look at the obstacles themselves.
const LEAST_ROOM_M: f64 = 0.0005;
/// Where on a line a wall is looked for first, as shares of its length.
const FIRST_LOOKS: [f64; 3] = [0.5, 0.25, 0.75];

/// The distance of each cell's centre from walls.
#[derive(Clone, Debug)]
pub(in crate::control::transport) struct Grid {
    workspace: Rect,
    columns: usize,
    cell_m: Vector2<f64>,
    /// Cells per metre: lines are followed cell by cell, and a division takes longer than all else in a step.
    cells_per_m: Vector2<f64>,
    /// Row by row, from the smallest y: distance from the centre to the nearest obstacle edge or to the border; 0 in an
    /// obstacle. Exact up to `most_m`; larger distances are only known to be larger.
    distance_m: Vec<f64>,
    most_m: f64,
}

impl Grid {
    /// Distances for clearances up to `most_clearance_m`.
    pub fn new(
        workspace: Rect,
        (columns, rows): (usize, usize),
        obstacles: &[CellRect],
        most_clearance_m: f64,
    ) -> Self {
        let count = Vector2::new(columns as f64, rows as f64);
        let cell_m = workspace.size_m().component_div(&count);
        let cells_per_m = count.component_div(&workspace.size_m());
        let most_m = most_clearance_m * (1.0 + ROOM);
        let distance_m = truncated_distances_m(columns, rows, cell_m, obstacles, most_m);
        Self { workspace, columns, cell_m, cells_per_m, distance_m, most_m }
    }

    /// The clearance for a path between two ends, between the two limits; `None` if no path has the smallest.
    pub fn clearance(&self, ends: [End; 2], [most_m, least_m]: [f64; 2]) -> Option<Clearance> {
        let near_ends = Clearance { asked_m: f64::INFINITY, ends };
        let leads = |is_free: &dyn Fn(usize) -> bool| {
            self.connects(self.cell(ends[0].point), self.cell(ends[1].point), is_free)
        };
        // From the end itself to the centre of a cell next to the end's cell.
        let beside_m = self.cell_m.norm();
        let beside: Vec<usize> = ends
            .iter()
            .flat_map(|end| {
                let around = self.neighbours(self.cell(end.point));
                around.filter(move |&cell| (end.point - self.center(cell)).norm() <= beside_m)
            })
            .collect();
        let least_near_ends_m = ends[0].distance_m.min(ends[1].distance_m);
        let is_roomy = |cell: usize, asked_m: f64| {
            let distance_m = self.distance_m[cell];
            // For most cells the first two comparisons decide.
            distance_m >= asked_m * (1.0 + ROOM)
                || distance_m >= least_near_ends_m && distance_m >= near_ends.required_m(self.center(cell))
                || beside.contains(&cell)
        };
        let roomy = levels_m([most_m, least_m]).find(|&asked_m| leads(&|cell| is_roomy(cell, asked_m)));
        // A point of a path is at most half a diagonal from the centre of its cell. There the distance may be half a
        // diagonal less, and the requirement GROWTH times half a diagonal more.
        let half_m = 0.5 * self.cell_m.norm();
        let is_possible = |cell: usize| {
            let (distance_m, required_m) = (self.distance_m[cell], near_ends.required_m(self.center(cell)));
            let more_m = GROWTH * (half_m + PIECE_M);
            distance_m > 0.0 && distance_m >= least_m.min(required_m - more_m) - half_m
        };
        let asked_m = roomy.or_else(|| leads(&is_possible).then_some(least_m))?;
        Some(Clearance { asked_m, ends })
    }

    /// Whether a straight line stays `distance_m` from walls, where the cells decide it; `None` where the line is too
    /// near to that distance.
    pub fn keeps(&self, from: Point2<f64>, to: Point2<f64>, distance_m: f64) -> Option<bool> {
        let length_m = (to - from).norm();
        let along = (to - from) / length_m.max(ROUNDING_M);
        // A place has at most half a diagonal more or less than the centre of its cell.
        let half_m = 0.5 * self.cell_m.norm() + ROUNDING_M;
        let is_too_near = |here_m: f64| here_m + half_m < distance_m;
        // A long line through a wall is often in it here.
        if FIRST_LOOKS.iter().any(|share| is_too_near(self.distance_m(from + (to - from) * *share))) {
            return Some(false);
        }
        let (mut along_m, mut is_decided) = (0.0, true);
        while along_m <= length_m {
            let here_m = self.distance_m(from + along * along_m);
            if is_too_near(here_m) {
                return Some(false);
            }
            // So far around, no place is nearer to a wall than asked.
            let room_m = here_m.min(self.most_m) - half_m - distance_m;
            is_decided &= room_m >= LEAST_ROOM_M;
            // Where the cells cannot tell, only a place too near to a wall is looked for.
            along_m += if is_decided { room_m } else { room_m.max(half_m) };
        }
        is_decided.then_some(true)
    }

    /// Distance from walls at the centre of the cell that contains a point.
    pub fn distance_m(&self, point: Point2<f64>) -> f64 {
        self.distance_m[self.cell(point)]
    }

    /// The nearest centre of a cell with at least `clearance_m`.
    pub fn nearest(&self, point: Point2<f64>, clearance_m: f64) -> Option<Point2<f64>> {
        let clear = (0..self.distance_m.len()).filter(|&cell| self.distance_m[cell] >= clearance_m);
        let away_2 = |center: &Point2<f64>| (center - point).norm_squared();
        clear.map(|cell| self.center(cell)).min_by(|a, b| away_2(a).total_cmp(&away_2(b)))
    }

    /// Whether a chain of free cells, connected by sides or corners, leads from one cell to another. The first need not
    /// be free. Filled row by row, a run of free cells at a time.
    fn connects(&self, from: usize, to: usize, is_free: impl Fn(usize) -> bool) -> bool {
        let (columns, count) = (self.columns, self.distance_m.len());
        let mut seen = vec![false; count];
        let mut open = vec![from];
        while let Some(cell) = open.pop() {
            if seen[cell] {
                continue;
            }
            let row = cell - cell % columns;
            let is_new = |&cell: &usize| !seen[cell] && is_free(cell);
            let first = (row..cell).rev().take_while(is_new).last().unwrap_or(cell);
            let last = (cell + 1..row + columns).take_while(is_new).last().unwrap_or(cell);
            if (first..=last).contains(&to) {
                return true;
            }
            seen[first..=last].fill(true);
            // With the cells beside the run's ends, which share a corner with it.
            let around = first.max(row + 1) - 1..(last + 2).min(row + columns);
            let below = (row > 0).then(|| around.start.wrapping_sub(columns)..around.end.wrapping_sub(columns));
            let above = (row + columns < count).then(|| around.start + columns..around.end + columns);
            for beside in [below, above].into_iter().flatten() {
                let mut was_open = false;
                for cell in beside {
                    let is_open = !seen[cell] && is_free(cell);
                    if is_open && !was_open {
                        open.push(cell);
                    }
                    was_open = is_open;
                }
            }
        }
        false
    }

    /// The cells that share a side or a corner with a cell, and the cell itself.
    pub fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        let (columns, rows) = (self.columns, self.distance_m.len() / self.columns);
        let (column, row) = (cell % columns, cell / columns);
        let around = |middle: usize, count: usize| middle.saturating_sub(1)..(middle + 2).min(count);
        around(row, rows).flat_map(move |row| around(column, columns).map(move |column| row * columns + column))
    }

    /// Distance from walls at a cell's centre.
    pub fn cell_distance_m(&self, cell: usize) -> f64 {
        self.distance_m[cell]
    }

    /// The cell that contains a point, or the nearest one.
    pub fn cell(&self, point: Point2<f64>) -> usize {
        let corner = Point2::new(self.workspace.x_min_m, self.workspace.y_min_m);
        let at = (point - corner).component_mul(&self.cells_per_m);
        // Casting a negative number gives 0.
        let rows = self.distance_m.len() / self.columns;
        (at.y as usize).min(rows - 1) * self.columns + (at.x as usize).min(self.columns - 1)
    }

    pub fn center(&self, cell: usize) -> Point2<f64> {
        let (column, row) = (cell % self.columns, cell / self.columns);
        Point2::new(
            self.workspace.x_min_m + (column as f64 + 0.5) * self.cell_m.x,
            self.workspace.y_min_m + (row as f64 + 0.5) * self.cell_m.y,
        )
    }
}

/// Distance from each cell's centre to the nearest obstacle edge or to the border; any number above `most_m` where the
/// distance is larger. Computed first along each column, then across the columns that are near enough.
fn truncated_distances_m(
    columns: usize,
    rows: usize,
    cell_m: Vector2<f64>,
    obstacles: &[CellRect],
    most_m: f64,
) -> Vec<f64> {
    let mut along_y_m = vec![f64::INFINITY; columns * rows];
    for rect in obstacles {
        for row in rect.row..rect.row + rect.rows {
            along_y_m[row * columns + rect.column..][..rect.columns].fill(0.0);
        }
    }
    // From a centre to the edge of the next cell is half a cell; then one cell more each.
    let next_m = |from_m: f64| if from_m > 0.0 { from_m + cell_m.y } else { 0.5 * cell_m.y };
    for cell in columns..along_y_m.len() {
        along_y_m[cell] = along_y_m[cell].min(next_m(along_y_m[cell - columns]));
    }
    for cell in (0..along_y_m.len() - columns).rev() {
        along_y_m[cell] = along_y_m[cell].min(next_m(along_y_m[cell + columns]));
    }
    let border_m = |index: usize, count: usize, side_m: f64| (index.min(count - 1 - index) as f64 + 0.5) * side_m;
    let max_columns = (most_m / cell_m.x + 0.5).ceil() as usize;
    let mut distance_m = vec![0.0; columns * rows];
    for (row, (found, along_y_m)) in
        distance_m.chunks_exact_mut(columns).zip(along_y_m.chunks_exact(columns)).enumerate()
    {
        let squared: Vec<f64> = along_y_m.iter().map(|along_m| along_m * along_m).collect();
        found.copy_from_slice(&squared);
        for offset in 1..=max_columns.min(columns - 1) {
            let across_m = (offset as f64 - 0.5) * cell_m.x;
            let across_2 = across_m * across_m;
            let nearer = |(found, beside): (&mut f64, &f64)| *found = found.min(beside + across_2);
            found[..columns - offset].iter_mut().zip(&squared[offset..]).for_each(nearer);
            found[offset..].iter_mut().zip(&squared[..columns - offset]).for_each(nearer);
        }
        let border_y_m = border_m(row, rows, cell_m.y);
        for (column, found) in found.iter_mut().enumerate() {
            *found = found.sqrt().min(border_y_m).min(border_m(column, columns, cell_m.x));
        }
    }
    distance_m
}
