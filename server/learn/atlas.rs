//! What a policy thinks of every place of a map: its value map and its greedy action there.

use std::path::Path;
use std::sync::Arc;

use candle_core::Tensor;

use super::learner::{features_of, features_of_all};
use super::sweep::{STEP_M, Sweep, SweepError, cells};
use super::terrain::{Terrain, TerrainError};
use crate::camera::Gpu;
use crate::geometry::Point2;
use crate::policy::{Fusion, Judgement, Policy, PolicyError};
use crate::trial::Arena;

/// Most cells of a map, free or not: twice the paper's table. Distances grow with their square, and a picture of
/// each takes milliseconds.
pub const CELLS_MOST: usize = 4000;
/// Cells judged at once: each has 32 fractions of 128 features.
const BATCH: usize = 256;

/// A map seen from everywhere, once and for all goals.
pub struct Atlas {
    terrain: Terrain,
    policy: Arc<Policy>,
    /// `[cells, 128]`; `None` with early fusion, whose features depend on the goal.
    features: Option<Tensor>,
}

/// Why there is no atlas.
#[derive(Debug, thiserror::Error)]
pub enum AtlasError {
    /// Too large a map.
    #[error("the map has {cells} places a centimetre apart, and {CELLS_MOST} at most can be judged")]
    TooLarge {
        /// How many it has.
        cells: usize,
    },
    /// No images.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// Nowhere to be.
    #[error(transparent)]
    Terrain(#[from] TerrainError),
    /// No answer.
    #[error(transparent)]
    Policy(#[from] PolicyError),
}

impl Atlas {
    /// Looks at a map from every free centimetre, with the default camera; the images are kept in `folder`. Takes
    /// seconds the first time.
    ///
    /// # Errors
    /// [`AtlasError`].
    pub fn of(arena: &Arena, policy: Arc<Policy>, gpu: &Arc<Gpu>, folder: &Path) -> Result<Self, AtlasError> {
        let (columns, rows) = cells(arena);
        if columns * rows > CELLS_MOST {
            return Err(AtlasError::TooLarge { cells: columns * rows });
        }
        let sweep = Sweep::open(arena, gpu, folder, &|| ())?;
        let terrain = Terrain::new(arena.map.name(), arena.map.workspace(), &sweep, policy.manifest().clearance_m)?;
        let features = match policy.manifest().architecture.fusion {
            Fusion::Late => Some(features_of_all(policy.network(), &terrain).map_err(PolicyError::from)?),
            Fusion::Early => None,
        };
        Ok(Self { terrain, policy, features })
    }

    /// The policy that it is of.
    pub fn policy(&self) -> &Arc<Policy> {
        &self.policy
    }

    /// Distance between two cells.
    pub fn spacing_m(&self) -> f64 {
        STEP_M
    }

    /// Middle of each cell that keeps the policy's distance from the walls, and what the policy makes of standing there
    /// on the way to a goal.
    ///
    /// # Errors
    /// [`AtlasError::Policy`].
    pub fn judge(&self, goal_m: Point2<f64>) -> Result<Vec<(Point2<f64>, Judgement)>, AtlasError> {
        let cells: Vec<u16> = (0..self.terrain.cells() as u16).collect();
        let mut judged = Vec::with_capacity(cells.len());
        for (batch, cells) in cells.chunks(BATCH).enumerate() {
            let places: Vec<[f32; 4]> = cells.iter().map(|&cell| self.terrain.places(goal_m, cell)).collect();
            let features = match &self.features {
                Some(features) => features.narrow(0, batch * BATCH, cells.len()),
                None => {
                    let terrains = std::slice::from_ref(&self.terrain);
                    let cells: Vec<(u8, u16)> = cells.iter().map(|&cell| (0, cell)).collect();
                    features_of(self.policy.network(), terrains, &cells, &places)
                }
            };
            let judgements = self.policy.judge_from(&features.map_err(PolicyError::from)?, &places)?;
            judged.extend(cells.iter().map(|&cell| self.terrain.center_m(cell)).zip(judgements));
        }
        Ok(judged)
    }
}
