//! All that the camera has seen of the workspace so far: unknown, free and obstacle, in `base`.
//!
//! **Grid.** Cells of 2 mm, or as coarse as it takes to have about 2¹⁸ at most (7.8 mm in 4 m × 4 m), narrowed so
//! that whole cells fill the workspace. Two bits a cell: 13 KB for the usual 580 mm × 330 mm, 64 KB at most.
//! Snapshots share the cells until one changes, and cells serialise as two pieces of bytes, so that hashing a map
//! takes little longer than copying it: there is no need to keep it out of the hash of every tick.
//!
//! **Walls have a height**, and the pinhole sees their tops farther from its axis than they stand: a wall darkens
//! everything from its foot to [`super::wall_spread`] times as far from the camera's foot, 1.7 mm more at the rim of the
//! default image and 2.4 mm in its corners. Whatever stands on a place therefore darkens both the place and the
//! place spread; where either is bright, nothing stands. A cell is an obstacle when any pixel in it is dark and so is
//! its place spread. That misses no wall of the height that was said or higher; it adds up to a cell and a pixel,
//! and what lies in gaps narrower than the spread. Lower walls lose the difference from their far side.
//!
//! **No flicker.** Cells that are not wholly in view, spread included, stay as they are. A cell that was an obstacle
//! becomes free only when no such pixel is within two pixels of it: an edge that sticks out into a cell by less than
//! a pixel is seen from one place and not from the next, and must not come and go.

mod bits;
mod queries;
#[cfg(test)]
mod tests;
mod view;

use std::sync::Arc;

use serde::{Deserialize, Serialize, Serializer};

use super::Calibration;
use super::dark::DarkPixels;
use super::rectangles::{CellMask, CellRect, Partition};
use crate::geometry::{Rect, Vector2};
use bits::BitGrid;
use view::View;

pub use queries::{Area, CellState, Unknown};

/// Side of a cell, where the workspace is not too large for it.
const CELL_M: f64 = 0.002;
/// Most cells of a map, but for those that rounding up adds.
const MAX_CELLS: f64 = (1 << 18) as f64;
/// Most cells along one side of a workspace that is long and narrow.
const MOST_ALONG: usize = 4096;

/// What has been seen of a workspace; at first nothing. Everything outside the workspace is wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct ObstacleMap {
    workspace: Rect,
    version: u64,
    #[serde(serialize_with = "serialize_shared")]
    cells: Arc<Cells>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Cells {
    /// Row by row from the least y; an obstacle has been seen.
    obstacle: BitGrid,
    seen: BitGrid,
}

/// A map as it was serialised, not yet checked.
#[derive(Deserialize)]
struct Stored {
    workspace: Rect,
    version: u64,
    cells: Cells,
}

impl TryFrom<Stored> for ObstacleMap {
    type Error = &'static str;

    fn try_from(stored: Stored) -> Result<Self, Self::Error> {
        let Stored { workspace, version, cells } = stored;
        let shape = Some(shape(&workspace));
        let is_whole = |grid: &BitGrid| Some((grid.columns, grid.rows)) == shape && grid.is_whole();
        if !is_whole(&cells.obstacle) || !is_whole(&cells.seen) {
            return Err("an obstacle map's cells do not fit its workspace");
        }
        Ok(Self { workspace, version, cells: Arc::new(cells) })
    }
}

fn serialize_shared<S: Serializer>(cells: &Arc<Cells>, serializer: S) -> Result<S::Ok, S::Error> {
    cells.as_ref().serialize(serializer)
}

/// What an update changed, in `base`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// The cells that became obstacles, as few disjoint rectangles.
    pub appeared: Vec<Rect>,
    /// The cells that were obstacles and are free, likewise.
    pub cleared: Vec<Rect>,
    /// Whether anything was seen for the first time.
    pub seen_more: bool,
}

/// Columns and rows of the grid.
fn shape(workspace: &Rect) -> (usize, usize) {
    let size = workspace.size_m();
    let cell_m = CELL_M.max((size.x * size.y / MAX_CELLS).sqrt());
    // A size that is a multiple of the cell but for rounding gets no cell more.
    let count = |side_m: f64| ((side_m / cell_m - 1e-6).ceil() as usize).clamp(1, MOST_ALONG);
    (count(size.x), count(size.y))
}

impl ObstacleMap {
    /// A map of which nothing is known.
    pub fn new(workspace: Rect) -> Self {
        let (columns, rows) = shape(&workspace);
        let grid = BitGrid::zero(columns, rows);
        Self { workspace, version: 0, cells: Arc::new(Cells { obstacle: grid.clone(), seen: grid }) }
    }

    /// The workspace.
    pub fn workspace(&self) -> &Rect {
        &self.workspace
    }

    /// Grows by one with every update that changes an obstacle.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Whether the two share their cells, as a copy does until either is updated with something new.
    pub fn shares_cells(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.cells, &other.cells)
    }

    /// Cells across and away from the user.
    pub fn shape(&self) -> (usize, usize) {
        (self.cells.seen.columns, self.cells.seen.rows)
    }

    /// Width and height of a cell.
    pub fn cell_m(&self) -> Vector2<f64> {
        let (columns, rows) = self.shape();
        self.workspace.size_m().component_div(&Vector2::new(columns as f64, rows as f64))
    }

    /// Takes in what an image shows: its dark pixels, where they lie, and how far wall tops seem to spread
    /// ([`super::wall_spread`]; 1 takes every dark pixel for what it covers).
    ///
    /// The pixels may be those of the image, or as coarse as the blocks of a quadtree
    /// ([`super::Quadtree::dark_pixels`]); blocks move with the camera, so what they darken besides comes and goes.
    pub fn update(&mut self, dark: &DarkPixels, calibration: &Calibration, spread: f64) -> Change {
        let view = View::of(self, dark, calibration, spread);
        let (mut appeared, mut cleared, mut first_seen) = (Vec::new(), Vec::new(), Vec::new());
        for (column, row) in view.cells() {
            let was_obstacle = self.cells.obstacle.get(column, row);
            match (was_obstacle, view.is_dark(column, row)) {
                (false, true) => appeared.push((column, row)),
                (true, false) if !view.is_near_dark(column, row) => cleared.push((column, row)),
                _ => (),
            }
            if !self.cells.seen.get(column, row) {
                first_seen.push((column, row));
            }
        }
        let change = Change {
            appeared: self.rectangles_around(&appeared),
            cleared: self.rectangles_around(&cleared),
            seen_more: !first_seen.is_empty(),
        };
        if change != Change::default() {
            let cells = Arc::make_mut(&mut self.cells);
            appeared.iter().chain(&cleared).for_each(|&(column, row)| cells.obstacle.flip(column, row));
            first_seen.iter().for_each(|&(column, row)| cells.seen.flip(column, row));
            self.version += u64::from(!appeared.is_empty() || !cleared.is_empty());
        }
        change
    }

    /// All obstacles seen so far, as few disjoint rectangles as possible.
    pub fn rectangles(&self) -> Vec<Rect> {
        let partition = self.partition();
        partition.rectangles.iter().map(|cells| self.rect(cells)).collect()
    }

    /// The same in cells, row 0 at the least y, with the terms of the formula for their number.
    pub fn partition(&self) -> Partition {
        let (columns, rows) = self.shape();
        let obstacle = |row| (0..columns).map(move |column| self.cells.obstacle.get(column, row));
        Partition::of(&CellMask { columns, rows, dark: (0..rows).flat_map(obstacle).collect() })
    }

    /// The part of the table that a rectangle of cells covers.
    pub fn rect(&self, cells: &CellRect) -> Rect {
        Rect {
            x_min_m: self.column_edge_m(cells.column),
            x_max_m: self.column_edge_m(cells.column + cells.columns),
            y_min_m: self.row_edge_m(cells.row),
            y_max_m: self.row_edge_m(cells.row + cells.rows),
        }
    }

    /// Where a column of cells begins; the last edge is the workspace's to the bit.
    fn column_edge_m(&self, column: usize) -> f64 {
        edge_m(self.workspace.x_min_m, self.workspace.x_max_m, column, self.cells.seen.columns)
    }

    fn row_edge_m(&self, row: usize) -> f64 {
        edge_m(self.workspace.y_min_m, self.workspace.y_max_m, row, self.cells.seen.rows)
    }

    /// The fewest rectangles that make up a list of cells.
    fn rectangles_around(&self, cells: &[(usize, usize)]) -> Vec<Rect> {
        let Some(&first) = cells.first() else { return Vec::new() };
        let bounds = |(low, high): ((usize, usize), (usize, usize)), &(column, row): &(usize, usize)| {
            ((column.min(low.0), row.min(low.1)), (column.max(high.0), row.max(high.1)))
        };
        let (low, high) = cells.iter().fold((first, first), bounds);
        let mut mask = CellMask::free(high.0 - low.0 + 1, high.1 - low.1 + 1);
        for (column, row) in cells {
            mask.dark[(row - low.1) * mask.columns + column - low.0] = true;
        }
        let moved = |cells: CellRect| CellRect { column: cells.column + low.0, row: cells.row + low.1, ..cells };
        Partition::of(&mask).rectangles.into_iter().map(|cells| self.rect(&moved(cells))).collect()
    }
}

fn edge_m(min_m: f64, max_m: f64, index: usize, count: usize) -> f64 {
    let share = index as f64 / count as f64;
    min_m * (1.0 - share) + max_m * share
}
