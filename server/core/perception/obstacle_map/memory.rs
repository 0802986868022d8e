//! What the map forgets where walls move: obstacles at places that were free before and that have been out of view for a
//! while. Places where there has always been a wall are kept.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::ObstacleMap;
use super::bits::BitGrid;

/// Since when cells have been out of view, in two half periods.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Memory {
    /// Observed as free at any time.
    pub was_free: BitGrid,
    /// In view since `since_tick`, and in the half period before it.
    pub recent: [BitGrid; 2],
    pub since_tick: u64,
}

impl Memory {
    pub fn is_whole(&self, shape: (usize, usize)) -> bool {
        let is_whole = |grid: &BitGrid| (grid.columns, grid.rows) == shape && grid.is_whole();
        is_whole(&self.was_free) && self.recent.iter().all(is_whole)
    }

    /// Notes a cell that is in view.
    pub fn note(&mut self, column: usize, row: usize, is_free: bool) {
        let set = |grid: &mut BitGrid| {
            if !grid.get(column, row) {
                grid.flip(column, row);
            }
        };
        set(&mut self.recent[0]);
        if is_free {
            set(&mut self.was_free);
        }
    }
}

impl ObstacleMap {
    /// Forgets obstacles that came to free places and have been out of view for `memory_ticks`, and up to half as long
    /// again. Called at each control step, before the image is added. They become unknown.
    pub fn forget(&mut self, tick: u64, memory_ticks: u64) {
        let (columns, rows) = self.shape();
        let memory = self.memory.get_or_insert_with(|| {
            let zero = BitGrid::zero(columns, rows);
            // What was free when the walls began to move.
            let mut was_free = zero.clone();
            for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
                if self.cells.seen.get(column, row) && !self.cells.obstacle.get(column, row) {
                    was_free.flip(column, row);
                }
            }
            Arc::new(Memory { was_free, recent: [zero.clone(), zero], since_tick: tick })
        });
        if tick.saturating_sub(memory.since_tick) < memory_ticks / 2 {
            return;
        }
        let memory = Arc::make_mut(memory);
        memory.since_tick = tick;
        let is_stale = |&(column, row): &(usize, usize)| {
            self.cells.obstacle.get(column, row)
                && memory.was_free.get(column, row)
                && !memory.recent.iter().any(|grid| grid.get(column, row))
        };
        let all = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let stale: Vec<(usize, usize)> = all.filter(is_stale).collect();
        let newest = std::mem::replace(&mut memory.recent[0], BitGrid::zero(columns, rows));
        memory.recent[1] = newest;
        if stale.is_empty() {
            return;
        }
        let cells = Arc::make_mut(&mut self.cells);
        for &(column, row) in &stale {
            cells.obstacle.flip(column, row);
            cells.seen.flip(column, row);
        }
        self.version += 1;
    }

    /// Whether walls have moved since the map is being made: then what it shows may change.
    pub fn forgets(&self) -> bool {
        self.memory.is_some()
    }
}
