//! A policy's value map and greedy action at every place of a map.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use candle_core::Tensor;

use super::learner::{features_of, features_of_all};
use super::sweep::{STEP_M, Sweep, SweepError, cells, center};
use super::terrain::places;
use ferry_camera::Gpu;
use ferry_core::geometry::{Point2, Rect};
use ferry_core::policy::{BATCH, Fusion, Judgement, Policy, PolicyError};
use ferry_core::trial::Arena;

/// Largest number of places, twice that of the paper's table: an image of each takes milliseconds.
const MAX_PLACES: usize = 4000;

/// The images of one map, for all goals.
pub struct Atlas {
    workspace: Rect,
    spacing_m: f64,
    centers_m: Vec<Point2<f64>>,
    seen: Stored,
    policy: Arc<Policy>,
}

/// The stored data of each place.
enum Stored {
    /// `[places, 128]`, independent of the goal.
    Features(Tensor),
    /// `[84 · 84]` each: with early fusion, features depend on the goal.
    Images(Vec<Vec<u8>>),
}

#[derive(Debug, thiserror::Error)]
pub enum AtlasError {
    /// The images could not be taken.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// No place keeps the policy's distance from walls.
    #[error("map: {map:?} has no place that keeps {clearance_m} m from the walls, as the policy requires")]
    NoRoom {
        map: String,
        /// Distance that the policy keeps.
        clearance_m: f64,
    },
    /// The policy's network failed.
    #[error(transparent)]
    Policy(#[from] PolicyError),
}

impl Atlas {
    /// Takes the images of a map with the default camera, every centimetre or, if that gives too many, at the smallest
    /// sufficient multiple of half a centimetre. The images are kept in `folder`. The first call takes seconds, on a
    /// large map a minute.
    ///
    /// # Errors
    /// [`AtlasError`].
    pub fn of(arena: &Arena, policy: Arc<Policy>, gpu: &Arc<Gpu>, folder: &Path) -> Result<Self, AtlasError> {
        let spacing_m = spacing_m(arena);
        let sweep = Sweep::open(arena, gpu, folder, spacing_m, &[], &|| ControlFlow::Continue(()))?;
        let workspace = *arena.map.workspace();
        let clearance_m = policy.manifest().clearance_m;
        let free = sweep.free(clearance_m);
        if free.is_empty() {
            return Err(AtlasError::NoRoom { map: arena.map.name().to_owned(), clearance_m });
        }
        let images = || free.iter().map(|&cell| sweep.image(cell));
        let seen = match policy.manifest().architecture.fusion {
            Fusion::Late => {
                let views: Vec<&[u8]> = images().collect();
                Stored::Features(features_of_all(policy.network(), &views).map_err(PolicyError::from)?)
            }
            Fusion::Early | Fusion::Survey => Stored::Images(images().map(<[u8]>::to_vec).collect()),
        };
        let at = |&cell: &usize| center(&workspace, spacing_m, cell % sweep.columns, cell / sweep.columns);
        Ok(Self { workspace, spacing_m, centers_m: free.iter().map(at).collect(), seen, policy })
    }

    pub fn policy(&self) -> &Arc<Policy> {
        &self.policy
    }

    /// Distance between two places.
    pub fn spacing_m(&self) -> f64 {
        self.spacing_m
    }

    /// The policy's values for one goal, at all places that keep the policy's distance from walls.
    ///
    /// # Errors
    /// [`AtlasError::Policy`].
    pub fn judge(&self, goal_m: Point2<f64>) -> Result<Vec<(Point2<f64>, Judgement)>, AtlasError> {
        let mut judged = Vec::with_capacity(self.centers_m.len());
        for (batch, centers_m) in self.centers_m.chunks(BATCH).enumerate() {
            let begin = batch * BATCH;
            let places: Vec<[f32; 4]> =
                centers_m.iter().map(|&center_m| places(&self.workspace, goal_m, center_m)).collect();
            let features = match &self.seen {
                Stored::Features(features) => features.narrow(0, begin, places.len()),
                Stored::Images(images) => {
                    let views: Vec<&[u8]> = images[begin..][..places.len()].iter().map(Vec::as_slice).collect();
                    features_of(self.policy.network(), &views, &places)
                }
            };
            let judgements = self.policy.judge_from(&features.map_err(PolicyError::from)?, &places)?;
            judged.extend(centers_m.iter().copied().zip(judgements));
        }
        Ok(judged)
    }
}

fn spacing_m(arena: &Arena) -> f64 {
    let fits = |&spacing_m: &f64| {
        let (columns, rows) = cells(arena, spacing_m);
        columns * rows <= MAX_PLACES
    };
    (2..).map(|halves| 0.5 * STEP_M * f64::from(halves)).find(fits).expect("a map has bounds")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_map_has_coarser_places() {
        let spacing_of = |map: &str| spacing_m(&Arena::shipped(map).unwrap());
        assert_eq!(spacing_of("colon"), STEP_M);
        assert_eq!(spacing_of("attractor-example"), 0.025);
    }
}
