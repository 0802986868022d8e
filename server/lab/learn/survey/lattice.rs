//! A maze on the lattice: how far the centre of each cell is from the walls.

use rayon::prelude::*;

use crate::learn::sweep::STEP_M;
use ferry_core::geometry::Point2;
use ferry_core::map::{Map, Maze, MazeError, MazeFamily};
use ferry_core::policy::{Lattice, neighbours};

/// Distance without a path.
pub const UNREACHABLE: u16 = u16::MAX;

#[derive(Clone, Debug)]
pub struct MazeLattice {
    name: String,
    lattice: Lattice,
    /// Row by row from the smallest y; negative inside walls.
    clearance_m: Vec<f32>,
}

impl MazeLattice {
    pub fn of(map: &Map) -> Self {
        let lattice = Lattice { workspace: *map.workspace(), step_m: STEP_M };
        let (columns, rows) = lattice.shape();
        let maze = Self { name: map.name().to_owned(), lattice, clearance_m: Vec::new() };
        let clearance_m = (0..columns * rows).map(|cell| map.clearance_m(maze.center_m(cell)) as f32).collect();
        Self { clearance_m, ..maze }
    }

    /// Mazes of families, each with seeds from `first_seed` on, in turn.
    ///
    /// # Errors
    /// [`MazeError`].
    pub fn generated(families: &[MazeFamily], first_seed: u64, count: usize) -> Result<Vec<Self>, MazeError> {
        let draw = |index: usize| {
            let seed = first_seed + (index / families.len()) as u64;
            Maze::generate(families[index % families.len()], seed).map(|maze| Self::of(&maze.map))
        };
        (0..count).into_par_iter().map(draw).collect()
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// Columns and rows.
    pub fn shape(&self) -> (usize, usize) {
        self.lattice.shape()
    }

    pub fn count(&self) -> usize {
        self.clearance_m.len()
    }

    pub fn clearance_m(&self, cell: usize) -> f64 {
        f64::from(self.clearance_m[cell])
    }

    pub fn center_m(&self, cell: usize) -> Point2<f64> {
        let (columns, _) = self.shape();
        self.lattice.center_m([cell % columns, cell / columns].map(|index| index as i64))
    }

    /// Steps to a cell from every other, over the cells that `is_free`, and from the cells beside those.
    pub fn steps_to(&self, goal: usize, is_free: impl Fn(usize) -> bool) -> Vec<u16> {
        steps_to(self.shape().0, self.count(), goal, is_free)
    }
}

/// Steps to a cell from every other, over cells that are free. The goal itself counts as free.
pub fn steps_to(columns: usize, count: usize, goal: usize, is_free: impl Fn(usize) -> bool) -> Vec<u16> {
    let mut steps = vec![UNREACHABLE; count];
    steps[goal] = 0;
    let mut open = std::collections::VecDeque::from([goal]);
    while let Some(cell) = open.pop_front() {
        for next in neighbours(cell, columns, count) {
            if steps[next] == UNREACHABLE && is_free(next) {
                steps[next] = steps[cell] + 1;
                open.push_back(next);
            }
        }
    }
    steps
}
