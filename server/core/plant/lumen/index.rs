//! Which pieces of wall can reach a place.

use super::{Piece, WallVertex, reach_m};
use crate::geometry::{Point2, Rect};

/// Side of a cell, unless the workspace is large.
const CELL_M: f64 = 0.008;
/// Largest number of cells along a side.
const MOST_CELLS: f64 = 512.0;

/// For each cell of a grid, the pieces of wall that a bead in it may touch.
#[derive(Debug)]
pub(super) struct Index {
    origin_m: Point2<f64>,
    cell_m: f64,
    columns: usize,
    /// Start of each cell in `pieces`, and the end of the last one.
    starts: Vec<u32>,
    pieces: Vec<u32>,
}

impl Index {
    pub fn of(workspace: &Rect, vertices: &[WallVertex], pieces: &[Piece]) -> Self {
        let size = workspace.size_m();
        let cell_m = CELL_M.max(size.max() / MOST_CELLS);
        let [columns, rows] = [size.x, size.y].map(|side_m| (side_m / cell_m).ceil().max(1.0) as usize);
        let origin_m = Point2::new(workspace.x_min_m, workspace.y_min_m);
        let mut cells: Vec<Vec<u32>> = vec![Vec::new(); columns * rows];
        for (number, piece) in pieces.iter().enumerate() {
            let [a, b] = piece.vertices.map(|vertex| vertices[vertex as usize].place_m);
            // To a cell's centre, so half a cell's diagonal more.
            let reach_m = reach_m(vertices, piece) + 0.5 * cell_m * std::f64::consts::SQRT_2;
            let range = |low_m: f64, high_m: f64, count: usize| {
                let cell = |at_m: f64| (at_m / cell_m).floor().clamp(0.0, count as f64 - 1.0) as usize;
                cell(low_m - reach_m)..=cell(high_m + reach_m)
            };
            let low = a.coords.inf(&b.coords) - origin_m.coords;
            let high = a.coords.sup(&b.coords) - origin_m.coords;
            for row in range(low.y, high.y, rows) {
                for column in range(low.x, high.x, columns) {
                    let center =
                        Point2::new((column as f64 + 0.5) * cell_m, (row as f64 + 0.5) * cell_m) + origin_m.coords;
                    let ahead_m = (center - a).dot(&piece.along).clamp(0.0, piece.length_m);
                    if (center - (a + piece.along * ahead_m)).norm() <= reach_m {
                        cells[row * columns + column].push(number as u32);
                    }
                }
            }
        }
        let mut starts = vec![0];
        let mut all = Vec::new();
        for cell in &cells {
            all.extend_from_slice(cell);
            starts.push(all.len() as u32);
        }
        Self { origin_m, cell_m, columns, starts, pieces: all }
    }

    /// The pieces that a bead at a place may touch.
    pub fn at(&self, point: Point2<f64>) -> &[u32] {
        let rows = (self.starts.len() - 1) / self.columns;
        let cell = |at_m: f64, count: usize| (at_m / self.cell_m).floor().clamp(0.0, count as f64 - 1.0) as usize;
        let offset = point - self.origin_m;
        let at = cell(offset.y, rows) * self.columns + cell(offset.x, self.columns);
        &self.pieces[self.starts[at] as usize..self.starts[at + 1] as usize]
    }
}
