//! The obstacle map: which parts of the workspace the camera has observed so far as free or as obstacle, in `base`.
//!
//! **Grid.** Cells have 2 mm, or more if needed to limit their number to about 2¹⁸ (7.8 mm in 4 m × 4 m). They are
//! narrowed so that whole cells fill the workspace. Two bits per cell give 13 KB for the usual 580 mm × 330 mm, and at
//! most 64 KB. Snapshots share the cells until one changes. Cells serialise as two byte arrays, so that hashing a map
//! takes little longer than copying it, and the map can be part of the hash of every tick.
//!
//! **Walls have a height.** A pinhole camera sees their tops farther from its axis than they are. A wall darkens
//! everything from its foot to [`super::wall_spread`] times its distance from the camera's foot: 1.7 mm more at the
//! edge of the default image and 2.4 mm in its corners. So a wall at a place darkens both the place and its spread
//! image; if either is bright, there is no wall. A cell is an obstacle if any pixel in it is dark together with its
//! spread image. This misses no wall of the given height or higher. It can add up to a cell and a pixel, and gaps
//! narrower than the spread. Lower walls lose the difference on their far side.
//!
//! **Walls that move** leave the map with obstacles where there are none any more. What is in view is corrected with
//! each image; what came to a free place and is out of view for a while is forgotten ([`ObstacleMap::forget`]).
//!
//! **No flicker.** Cells that are not completely in view, including their spread, stay unchanged. An obstacle cell
//! becomes free only if no such pixel is within two pixels of it: a wall edge that extends into a cell by less than a
//! pixel is visible from some places only, and must not appear and disappear.

mod bits;
mod memory;
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
use memory::Memory;
use view::View;

pub use queries::{Area, CellState, Unknown};

/// Side of a cell, if the workspace is not too large.
const CELL_M: f64 = 0.002;
/// Largest number of cells of a map, before rounding up.
const MAX_CELLS: f64 = (1 << 18) as f64;
/// Largest number of cells along one side, for long and narrow workspaces.
const MAX_ALONG: usize = 4096;

/// The observed part of a workspace; empty at first. Everything outside the workspace is wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct ObstacleMap {
    workspace: Rect,
    version: u64,
    #[serde(serialize_with = "serialize_shared")]
    cells: Arc<Cells>,
    /// While walls move.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_memory")]
    memory: Option<Arc<Memory>>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Cells {
    /// Row by row from the smallest y; an obstacle was observed.
    obstacle: BitGrid,
    seen: BitGrid,
}

/// A deserialised map before validation.
#[derive(Deserialize)]
struct Stored {
    workspace: Rect,
    version: u64,
    cells: Cells,
    #[serde(default)]
    memory: Option<Memory>,
}

impl TryFrom<Stored> for ObstacleMap {
    type Error = &'static str;

    fn try_from(stored: Stored) -> Result<Self, Self::Error> {
        let Stored { workspace, version, cells, memory } = stored;
        let cell_count = shape(&workspace);
        let shape = Some(cell_count);
        let is_whole = |grid: &BitGrid| Some((grid.columns, grid.rows)) == shape && grid.is_whole();
        let remembers = memory.as_ref().is_none_or(|memory| memory.is_whole(cell_count));
        if !is_whole(&cells.obstacle) || !is_whole(&cells.seen) || !remembers {
            return Err("the cells of the obstacle map do not fit its workspace");
        }
        Ok(Self { workspace, version, cells: Arc::new(cells), memory: memory.map(Arc::new) })
    }
}

fn serialize_shared<S: Serializer>(cells: &Arc<Cells>, serializer: S) -> Result<S::Ok, S::Error> {
    cells.as_ref().serialize(serializer)
}

fn serialize_memory<S: Serializer>(memory: &Option<Arc<Memory>>, serializer: S) -> Result<S::Ok, S::Error> {
    memory.as_deref().serialize(serializer)
}

/// Result of an update, in `base`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// Cells that became obstacles, as disjoint rectangles.
    pub appeared: Vec<Rect>,
    /// Cells that were obstacles and became free, as disjoint rectangles.
    pub cleared: Vec<Rect>,
    /// Whether any cell was observed for the first time.
    pub seen_more: bool,
}

/// Columns and rows of the grid.
fn shape(workspace: &Rect) -> (usize, usize) {
    let size = workspace.size_m();
    let cell_m = CELL_M.max((size.x * size.y / MAX_CELLS).sqrt());
    // A size that is a multiple of the cell except for rounding gets no additional cell.
    let count = |side_m: f64| ((side_m / cell_m - 1e-6).ceil() as usize).clamp(1, MAX_ALONG);
    (count(size.x), count(size.y))
}

impl ObstacleMap {
    /// A map without observations.
    pub fn new(workspace: Rect) -> Self {
        let (columns, rows) = shape(&workspace);
        let grid = BitGrid::zero(columns, rows);
        Self { workspace, version: 0, cells: Arc::new(Cells { obstacle: grid.clone(), seen: grid }), memory: None }
    }

    pub fn workspace(&self) -> &Rect {
        &self.workspace
    }

    /// Increases by one with every update that changes an obstacle.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Whether both share their cells in memory. Clones do until one of them changes.
    pub fn shares_cells(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.cells, &other.cells)
    }

    /// Columns and rows.
    pub fn shape(&self) -> (usize, usize) {
        (self.cells.seen.columns, self.cells.seen.rows)
    }

    /// Width and height of a cell.
    pub fn cell_m(&self) -> Vector2<f64> {
        let (columns, rows) = self.shape();
        self.workspace.size_m().component_div(&Vector2::new(columns as f64, rows as f64))
    }

    /// Adds the content of an image: its dark pixels, their positions, and the spread of wall tops
    /// ([`super::wall_spread`]; with 1, every dark pixel counts as the place that it covers).
    ///
    /// The pixels may be those of the image, or blocks of a quadtree ([`super::Quadtree::dark_pixels`]). Blocks move
    /// with the camera, so the additional area that they darken varies.
    pub fn update(&mut self, dark: &DarkPixels, calibration: &Calibration, spread: f64) -> Change {
        self.update_around(dark, None, calibration, spread)
    }

    /// The same for an image in which something hides the table. A cell of which more than a quarter is hidden stays
    /// unchanged.
    pub fn update_around(
        &mut self,
        dark: &DarkPixels,
        hidden: Option<&DarkPixels>,
        calibration: &Calibration,
        spread: f64,
    ) -> Change {
        let view = View::of(self, dark, hidden, calibration, spread);
        let (mut appeared, mut cleared, mut first_seen) = (Vec::new(), Vec::new(), Vec::new());
        for (column, row) in view.cells() {
            if hidden.is_some_and(|hidden| view.is_hidden(column, row, hidden)) {
                continue;
            }
            let was_obstacle = self.cells.obstacle.get(column, row);
            let is_dark = view.is_dark(column, row);
            if let Some(memory) = &mut self.memory {
                Arc::make_mut(memory).note(column, row, !is_dark);
            }
            match (was_obstacle, is_dark) {
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

    /// All observed obstacles, as the minimum number of disjoint rectangles.
    pub fn rectangles(&self) -> Vec<Rect> {
        let partition = self.partition();
        partition.rectangles.iter().map(|cells| self.rect(cells)).collect()
    }

    /// The same in cells, row 0 at the smallest y, with the terms of the formula for their number.
    pub fn partition(&self) -> Partition {
        let (columns, rows) = self.shape();
        let obstacle = |row| (0..columns).map(move |column| self.cells.obstacle.get(column, row));
        Partition::of(&CellMask { columns, rows, dark: (0..rows).flat_map(obstacle).collect() })
    }

    /// The table area of a rectangle of cells.
    pub fn rect(&self, cells: &CellRect) -> Rect {
        Rect {
            x_min_m: self.column_edge_m(cells.column),
            x_max_m: self.column_edge_m(cells.column + cells.columns),
            y_min_m: self.row_edge_m(cells.row),
            y_max_m: self.row_edge_m(cells.row + cells.rows),
        }
    }

    /// Lower edge of a column of cells. The last edge equals that of the workspace exactly.
    fn column_edge_m(&self, column: usize) -> f64 {
        edge_m(self.workspace.x_min_m, self.workspace.x_max_m, column, self.cells.seen.columns)
    }

    fn row_edge_m(&self, row: usize) -> f64 {
        edge_m(self.workspace.y_min_m, self.workspace.y_max_m, row, self.cells.seen.rows)
    }

    /// The minimum number of rectangles for a list of cells.
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
