//! Generated mazes: families to train on, and families that are kept for testing. The same family and seed always give the
//! same drawing.

mod channels;
mod ink;
mod rooms;
mod stones;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{FreeSpace, Map};
use ink::Ink;

/// Narrowest and widest passage.
const WIDTHS_MM: [f64; 2] = [35.0, 120.0];
/// Distance from walls that a trial's start and goal keep; all places that keep it must be connected.
const CLEARANCE_M: f64 = 0.012;
/// Drawings that are tried for a seed.
const ATTEMPTS: u64 = 100;

/// A kind of maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MazeFamily {
    /// One wandering channel with folds.
    Tubes,
    /// A channel that branches.
    Trees,
    /// Round and angular stones on an open floor.
    Stones,
    /// Rooms with doors.
    Rooms,
    /// A channel that winds to the middle.
    Spirals,
    /// A channel that goes to and fro.
    Serpentines,
}

impl MazeFamily {
    pub const ALL: [Self; 6] = [Self::Tubes, Self::Trees, Self::Stones, Self::Rooms, Self::Spirals, Self::Serpentines];

    pub fn as_str(self) -> &'static str {
        match self {
            Self::Tubes => "tubes",
            Self::Trees => "trees",
            Self::Stones => "stones",
            Self::Rooms => "rooms",
            Self::Spirals => "spirals",
            Self::Serpentines => "serpentines",
        }
    }

    fn draw(self, width_mm: f64, rng: &mut ChaCha8Rng) -> Ink {
        match self {
            Self::Tubes => channels::tube(width_mm, rng),
            Self::Trees => channels::tree(width_mm, rng),
            Self::Stones => stones::stones(width_mm, rng),
            Self::Rooms => rooms::rooms(width_mm, rng),
            Self::Spirals => channels::spiral(width_mm, rng),
            Self::Serpentines => rooms::serpentine(width_mm, rng),
        }
    }
}

/// A maze of a family.
#[derive(Debug)]
pub struct Maze {
    /// Width of its channels and doors, or of the gaps between its stones; folds are narrower.
    pub width_mm: f64,
    pub map: Map,
}

/// No drawing of a seed was usable.
#[derive(Debug, thiserror::Error)]
#[error("maze: none of {ATTEMPTS} drawings of {family} with seed {seed} is connected", family = family.as_str())]
pub struct MazeError {
    pub family: MazeFamily,
    pub seed: u64,
}

impl Maze {
    /// The maze of a seed. Consecutive seeds have widths from 35 to 120 mm, spread evenly.
    ///
    /// # Errors
    /// [`MazeError`].
    pub fn generate(family: MazeFamily, seed: u64) -> Result<Self, MazeError> {
        let [narrow, wide] = WIDTHS_MM;
        // Fractional parts of the multiples of the golden ratio are spread evenly, however many there are.
        let share = (seed as f64 * 0.618_033_988_749_895).fract();
        let width_mm = (narrow + share * (wide - narrow)).round();
        let name = format!("{}-{seed}", family.as_str());
        let drawn = (0..ATTEMPTS).find_map(|attempt| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            rng.set_stream((family as u64) << 32 | attempt);
            let svg = family.draw(width_mm, &mut rng).to_svg(&format!("{name}: {width_mm:.0} mm wide"));
            let map = Map::from_svg(&name, &svg).ok()?;
            (FreeSpace::new(&map, CLEARANCE_M).components() == 1).then_some(map)
        });
        drawn.map(|map| Self { width_mm, map }).ok_or(MazeError { family, seed })
    }
}

/// A number between two others.
fn between(low: f64, high: f64, rng: &mut ChaCha8Rng) -> f64 {
    low + rng.random::<f64>() * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_maze_is_a_map_and_the_same_again() {
        for family in MazeFamily::ALL {
            let mut widths = Vec::new();
            for seed in 1..=20 {
                let maze = Maze::generate(family, seed).unwrap();
                assert!(maze.map.repairs().is_empty(), "{}: {:?}", maze.map.name(), maze.map.repairs());
                assert_eq!(maze.map.name(), format!("{}-{seed}", family.as_str()));
                widths.push(maze.width_mm);
                if seed <= 2 {
                    assert_eq!(Maze::generate(family, seed).unwrap().map.svg(), maze.map.svg());
                }
            }
            widths.sort_by(f64::total_cmp);
            assert!(widths[0] < 42.0 && widths[19] > 113.0, "{widths:?}");
            let largest_gap = widths.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
            assert!(largest_gap < 9.0, "{widths:?}");
        }
    }

    #[test]
    fn passages_are_as_wide_as_stated() {
        for family in MazeFamily::ALL {
            for seed in [1, 2, 3] {
                let maze = Maze::generate(family, seed).unwrap();
                // A disc of nearly the width passes, except through the folds of a tube. Free space has cells of 5 mm.
                let disc_m = 0.5e-3 * (maze.width_mm - 15.0);
                assert!(FreeSpace::new(&maze.map, disc_m).area_m2() > 0.0, "{}", maze.map.name());
                if !matches!(family, MazeFamily::Tubes) {
                    assert_eq!(FreeSpace::new(&maze.map, disc_m).components(), 1, "{}", maze.map.name());
                }
            }
        }
    }
}
