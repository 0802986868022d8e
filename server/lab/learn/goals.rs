//! Goals that are trained, and goals that are held out for the examination.

use super::terrain::Terrain;

/// Side of the squares that are held out.
const SQUARE_M: f64 = 0.04;

/// Cells that may be goals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GoalSet {
    All,
    /// All but the held-out squares, given by their share.
    Trained {
        held_out: f64,
    },
    /// Only the held-out squares.
    HeldOut {
        held_out: f64,
    },
}

impl GoalSet {
    /// Whether a cell belongs to the set. The hash of its place decides whether a square is held out, whatever the seed.
    pub fn has(self, terrain: &Terrain, cell: u16) -> bool {
        let is_held_out = |share: f64| {
            let square = (terrain.center_m(cell) / SQUARE_M).coords.map(f64::floor);
            let bytes = [square.x.to_le_bytes(), square.y.to_le_bytes()].concat();
            (xxhash_rust::xxh3::xxh3_64(&bytes) as f64 / u64::MAX as f64) < share
        };
        match self {
            Self::All => true,
            Self::Trained { held_out } => !is_held_out(held_out),
            Self::HeldOut { held_out } => is_held_out(held_out),
        }
    }

    /// Whether an episode can start on a terrain.
    pub fn has_episode(self, terrain: &Terrain) -> bool {
        terrain.has_path(|cell| self.has(terrain, cell))
    }
}
