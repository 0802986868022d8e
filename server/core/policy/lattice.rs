//! The places above which policies are trained: the centres of square cells over the workspace.

use crate::geometry::{Point2, Rect, Vector2};

/// A side that is a multiple of a step, except for rounding, has all its cells.
const ROUNDING: f64 = 1e-6;

/// Column and row of a cell, from the smallest x and y.
pub type Cell = [i64; 2];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    pub workspace: Rect,
    pub step_m: f64,
}

impl Lattice {
    /// Columns and rows, at least one of each.
    pub fn shape(&self) -> (usize, usize) {
        let count = |side_m: f64| ((side_m / self.step_m + ROUNDING) as usize).max(1);
        let size_m = self.workspace.size_m();
        (count(size_m.x), count(size_m.y))
    }

    pub fn center_m(&self, cell: Cell) -> Point2<f64> {
        let [x_m, y_m] = cell.map(|index| (index as f64 + 0.5) * self.step_m);
        self.corner_m() + Vector2::new(x_m, y_m)
    }

    /// The cell under a place, which may be outside the workspace.
    pub fn cell_at(&self, place: Point2<f64>) -> Cell {
        let along_m = place - self.corner_m();
        [along_m.x, along_m.y].map(|along_m| (along_m / self.step_m).floor() as i64)
    }

    fn corner_m(&self) -> Point2<f64> {
        Point2::new(self.workspace.x_min_m, self.workspace.y_min_m)
    }
}

/// The cells beside a cell, of `count` cells that lie row by row.
pub fn neighbours(cell: usize, columns: usize, count: usize) -> impl Iterator<Item = usize> {
    let column = cell % columns;
    let beside = [
        (column + 1 < columns).then_some(cell + 1),
        (column > 0).then(|| cell.wrapping_sub(1)),
        (cell + columns < count).then_some(cell + columns),
        cell.checked_sub(columns),
    ];
    beside.into_iter().flatten()
}
