//! What a policy with a memory sees: the lattice of the tool's places, with what the camera has observed so far, where
//! the tool has been on this leg, and the goal.
//!
//! Nothing in it is an absolute position.

mod route;
#[cfg(test)]
mod tests;
mod trunk;

use serde::{Deserialize, Serialize};

use super::Action;
use super::lattice::{Lattice, neighbours};
use crate::geometry::Point2;
use crate::image::GrayImage;
use crate::perception::{Area, OBSERVATION_SIZE_PX, ObstacleMap};

pub use trunk::{Plan, SurveyTrunk};

/// Largest number of visits that is counted.
const MAX_VISITS: u8 = 63;

/// The parts of a survey that a network sees; one of them missing is for ablations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurveyParts {
    /// Where the tool has been on this leg.
    pub visits: bool,
    /// The second scale, with cells four times as wide.
    pub coarse: bool,
}

impl SurveyParts {
    pub const ALL: Self = Self { visits: true, coarse: true };
}

impl Default for SurveyParts {
    fn default() -> Self {
        Self::ALL
    }
}

/// A lattice of cells, row by row from the smallest y.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Survey {
    columns: usize,
    /// Each cell's content in the two lowest bits, its visits in the others.
    cells: Vec<u8>,
    /// Cell of the tool.
    pub tool: usize,
    /// Cell of the goal.
    pub goal: usize,
}

impl Survey {
    /// A lattice of which nothing is known.
    pub fn unknown(columns: usize, rows: usize, tool: usize, goal: usize) -> Self {
        Self { columns, cells: vec![0; columns * rows], tool, goal }
    }

    /// What an obstacle map shows of the lattice: a cell is free if no obstacle is within `clearance_m` of its centre, and
    /// all of that was observed. Without visits. Tool and goal outside the workspace are at its border.
    pub fn over(map: &ObstacleMap, step_m: f64, clearance_m: f64, [tool_m, goal_m]: [Point2<f64>; 2]) -> Self {
        let lattice = Lattice { workspace: *map.workspace(), step_m };
        let (columns, rows) = lattice.shape();
        let cell_at = |place: Point2<f64>| {
            let [column, row] = lattice.cell_at(place).map(|index| index.max(0) as usize);
            row.min(rows - 1) * columns + column.min(columns - 1)
        };
        let mut survey = Self::unknown(columns, rows, cell_at(tool_m), cell_at(goal_m));
        for cell in 0..survey.count() {
            let center_m = lattice.center_m(survey.place(cell));
            survey.set_known(cell, map.disc(center_m, clearance_m));
        }
        survey
    }

    /// The cells around the tool's as an image, one pixel each: white where it is free, black where it is blocked or
    /// outside, gray where nothing was observed, and darker with each visit.
    pub fn picture(&self) -> GrayImage {
        const SIDE: i64 = OBSERVATION_SIZE_PX as i64;
        let [column, row] = self.place(self.tool);
        let level = |index: i64| {
            let at = [column + index % SIDE - SIDE / 2, row + SIDE / 2 - index / SIDE];
            let Some(cell) = self.cell_at(at) else { return 0 };
            match self.known(cell) {
                Area::Blocked => 0,
                Area::Unknown => 128,
                Area::Free => 255 - 20 * self.visits(cell).min(4),
            }
        };
        let pixels = (0..SIDE * SIDE).map(level).collect();
        GrayImage { width_px: OBSERVATION_SIZE_PX, height_px: OBSERVATION_SIZE_PX, pixels }
    }

    /// Columns and rows.
    pub fn shape(&self) -> (usize, usize) {
        (self.columns, self.cells.len() / self.columns)
    }

    /// Number of cells.
    pub fn count(&self) -> usize {
        self.cells.len()
    }

    /// Column and row of a cell.
    pub fn place(&self, cell: usize) -> [i64; 2] {
        [(cell % self.columns) as i64, (cell / self.columns) as i64]
    }

    /// The cell of a column and a row; `None` outside the lattice.
    pub fn cell_at(&self, [column, row]: [i64; 2]) -> Option<usize> {
        let (columns, rows) = self.shape();
        let inside = (0..columns as i64).contains(&column) && (0..rows as i64).contains(&row);
        inside.then(|| row as usize * columns + column as usize)
    }

    pub fn known(&self, cell: usize) -> Area {
        match self.cells[cell] & 3 {
            0 => Area::Unknown,
            1 => Area::Free,
            _ => Area::Blocked,
        }
    }

    pub fn set_known(&mut self, cell: usize, known: Area) {
        let bits = match known {
            Area::Unknown => 0,
            Area::Free => 1,
            Area::Blocked => 2,
        };
        self.cells[cell] = self.cells[cell] & !3 | bits;
    }

    /// How often the tool chose an action over a cell on this leg, at most 63.
    pub fn visits(&self, cell: usize) -> u8 {
        self.cells[cell] >> 2
    }

    pub fn set_visits(&mut self, cell: usize, visits: u32) {
        let visits = visits.min(u32::from(MAX_VISITS)) as u8;
        self.cells[cell] = self.cells[cell] & 3 | visits << 2;
    }

    /// The cell that an action leads to; `None` out of the lattice.
    pub fn beside(&self, cell: usize, action: Action) -> Option<usize> {
        let [column, row] = self.place(cell);
        let (dx, dy) = action.offset();
        self.cell_at([column + dx as i64, row + dy as i64])
    }

    /// Whether every route from the tool to the goal enters a cell that is known to be blocked.
    pub fn is_walled_off(&self) -> bool {
        let mut seen = vec![false; self.count()];
        let mut open = vec![self.tool];
        while let Some(cell) = open.pop() {
            if cell == self.goal {
                return false;
            }
            for next in neighbours(cell, self.columns, self.count()) {
                let is_open = next == self.goal || self.known(next) != Area::Blocked;
                if !std::mem::replace(&mut seen[next], true) && is_open {
                    open.push(next);
                }
            }
        }
        true
    }

    /// Forgets all visits: a new leg begins.
    pub fn clear_visits(&mut self) {
        self.cells.iter_mut().for_each(|cell| *cell &= 3);
    }
}
