//! Flow of a fluid along the lumen: the potential flow from one end to the other, with walls that let nothing through.
//! The speed is the same in all channels, whatever their width; where the fluid stands, as in a blind branch, it is 0.

use super::along::Along;
use crate::geometry::{Point2, Vector2};

/// Cells within this distance of an end have its potential.
const END_M: f64 = 0.015;
/// Over-relaxation, and the most sweeps of the solver.
const RELAXATION: f64 = 1.9;
const MOST_SWEEPS: usize = 4000;
/// The solver ends when no cell changes by more than this share of the whole potential.
const CONVERGED: f64 = 1e-6;
/// Where the gradient is below this share of the usual one, the fluid nearly stands.
const STANDING_SHARE: f64 = 0.1;

/// The direction of the flow in each cell.
#[derive(Debug)]
pub(super) struct Flow {
    origin_m: Point2<f64>,
    cell_m: f64,
    columns: usize,
    at: Vec<Vector2<f64>>,
}

impl Flow {
    pub fn of(along: &Along) -> Self {
        let (columns, rows) = along.space.shape();
        let first = along.space.center(0);
        let cell_m =
            if columns > 1 { along.space.center(1).x - first.x } else { along.space.center(columns).y - first.y };
        let components = along.space.component_of_cells();
        let mut potential = vec![0.0; components.len()];
        let mut is_fixed = vec![false; components.len()];
        for [begin, end] in &along.ends {
            for cell in (0..components.len()).filter(|&cell| components[cell] == components[*begin]) {
                let length_m = along.at_m[*end];
                let from_begin_m = along.at_m[cell];
                let from_end_m = (along.space.center(cell) - along.space.center(*end)).norm();
                is_fixed[cell] = from_begin_m < END_M || from_end_m < END_M;
                potential[cell] = if from_end_m < END_M { length_m } else { from_begin_m.min(length_m) };
                if from_begin_m < END_M {
                    potential[cell] = 0.0;
                }
            }
        }
        let neighbours = |cell: usize| {
            let (column, row) = (cell % columns, cell / columns);
            let free = |inside: bool, other: usize| (inside && components[other].is_some()).then_some(other);
            [
                free(column > 0, cell.wrapping_sub(1)),
                free(column + 1 < columns, cell + 1),
                free(row > 0, cell.wrapping_sub(columns)),
                free(row + 1 < rows, cell + columns),
            ]
        };
        let moving: Vec<usize> =
            (0..components.len()).filter(|&cell| components[cell].is_some() && !is_fixed[cell]).collect();
        let scale_m = along.ends.iter().map(|[_, end]| along.at_m[*end]).fold(1e-9, f64::max);
        for _ in 0..MOST_SWEEPS {
            let mut most: f64 = 0.0;
            for &cell in &moving {
                let (mut sum, mut count) = (0.0, 0.0);
                for other in neighbours(cell).into_iter().flatten() {
                    sum += potential[other];
                    count += 1.0;
                }
                if count > 0.0 {
                    let change = RELAXATION * (sum / count - potential[cell]);
                    potential[cell] += change;
                    most = most.max(change.abs());
                }
            }
            if most < CONVERGED * scale_m {
                break;
            }
        }
        let slope = |cell: usize| {
            let [left, right, below, above] = neighbours(cell);
            let along = |low: Option<usize>, high: Option<usize>| {
                let (low, high) = (low.unwrap_or(cell), high.unwrap_or(cell));
                (potential[high] - potential[low]) / (2.0 * cell_m)
            };
            Vector2::new(along(left, right), along(below, above))
        };
        let slopes: Vec<Option<Vector2<f64>>> =
            (0..components.len()).map(|cell| components[cell].map(|_| slope(cell))).collect();
        let mut steepness: Vec<f64> = slopes.iter().flatten().map(|slope| slope.norm()).collect();
        steepness.sort_by(f64::total_cmp);
        let usual = steepness.get(steepness.len() / 2).copied().unwrap_or(0.0);
        let direction = |slope: &Option<Vector2<f64>>| {
            slope.map_or(Vector2::zeros(), |slope| slope / (slope.norm() + STANDING_SHARE * usual + 1e-12))
        };
        Self { origin_m: first, cell_m, columns, at: slopes.iter().map(direction).collect() }
    }

    /// Interpolated between the centres of the cells.
    pub fn at(&self, point: Point2<f64>) -> Vector2<f64> {
        let rows = self.at.len() / self.columns;
        let offset = (point - self.origin_m) / self.cell_m;
        let cell = |at: f64, count: usize| at.floor().clamp(0.0, (count.max(2) - 2) as f64);
        let (column, row) = (cell(offset.x, self.columns), cell(offset.y, rows));
        let (x, y) = ((offset.x - column).clamp(0.0, 1.0), (offset.y - row).clamp(0.0, 1.0));
        let at = |right: usize, up: usize| {
            let column = (column as usize + right).min(self.columns - 1);
            self.at[(row as usize + up).min(rows - 1) * self.columns + column]
        };
        (at(0, 0) * (1.0 - x) + at(1, 0) * x) * (1.0 - y) + (at(0, 1) * (1.0 - x) + at(1, 1) * x) * y
    }
}
