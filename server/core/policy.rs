//! The Rainbow-IQN policy: network, weights and manifest (paper, §III and §IV-A; specification §7).

mod convolution;
mod file;
mod lattice;
mod linear;
mod modulation;
mod network;
mod policies;
mod survey;

use std::sync::Arc;

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};

use crate::geometry::Vector2;
use crate::perception::{OBSERVATION_SIZE_PX, Observation};

pub use file::{MAX_BYTES, Manifest, PolicyError, weights};
pub use lattice::{Cell, Lattice, neighbours};
pub use network::{Architecture, Fusion, HIDDEN, Initial, Network, TensorSpec, builder};
pub use policies::{Policies, Shipped};
use survey::Plan;
pub use survey::{Survey, SurveyParts};

/// Number of quantile fractions for acting (Dabney et al. 2018, K = 32).
pub const ACTING_FRACTIONS: usize = 32;

/// Places per call of the network: each has 32 fractions of 128 features.
pub const BATCH: usize = 256;

/// One step of the tool along an axis of the table (paper, §IV-A).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Action {
    /// +x.
    PlusX,
    /// −x.
    MinusX,
    /// +y.
    PlusY,
    /// −y.
    MinusY,
}

impl Action {
    /// All actions, in the order of the network's outputs.
    pub const ALL: [Self; 4] = [Self::PlusX, Self::MinusX, Self::PlusY, Self::MinusY];

    /// Index in [`Self::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    /// Columns and rows that the tool moves on the lattice.
    pub fn offset(self) -> (isize, isize) {
        match self {
            Self::PlusX => (1, 0),
            Self::MinusX => (-1, 0),
            Self::PlusY => (0, 1),
            Self::MinusY => (0, -1),
        }
    }

    /// Unit vector on the table.
    pub fn direction(self) -> Vector2<f64> {
        let (x, y) = self.offset();
        Vector2::new(x as f64, y as f64)
    }
}

/// The network's result for an observation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// `[4][K]`: quantiles of each action's return, at the fractions (k + ½) / K.
    pub quantiles: [Vec<f32>; 4],
}

impl Judgement {
    /// Mean of each action's quantiles: the action's value.
    pub fn values(&self) -> [f32; 4] {
        self.quantiles.each_ref().map(|row| row.iter().sum::<f32>() / row.len() as f32)
    }

    /// Actions, best first. Equal values keep the order of [`Action::ALL`].
    pub fn ranking(&self) -> [Action; 4] {
        self.ranking_with([0.0; 4])
    }

    /// Actions, best first, by value minus a penalty for each.
    pub fn ranking_with(&self, penalties: [f32; 4]) -> [Action; 4] {
        let values = self.values();
        let values: [f32; 4] = std::array::from_fn(|action| values[action] - penalties[action]);
        let mut order = [0, 1, 2, 3];
        order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
        order.map(|index| Action::ALL[index])
    }
}

/// A trained network with its manifest; immutable and shared.
#[derive(Clone, Debug)]
pub struct Policy {
    manifest: Manifest,
    network: Arc<Network>,
    /// Hash of the file's bytes.
    hash: u64,
}

impl PartialEq for Policy {
    fn eq(&self, other: &Self) -> bool {
        self.hash == other.hash
    }
}

impl Policy {
    /// Origin and requirements of the policy.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    pub fn network(&self) -> &Network {
        &self.network
    }

    /// Hash of the policy's file.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    /// Quantiles of the return for all four actions, without exploration.
    ///
    /// # Errors
    /// [`PolicyError::Network`], only if [`Policy`] has accepted an invalid network.
    pub fn judge(&self, observation: &Observation) -> Result<Judgement, PolicyError> {
        let features = self.features(&[&observation.bytes])?;
        Ok(self.judge_from(&features, &[observation.places()])?.remove(0))
    }

    /// Whether the policy sees a survey instead of an image.
    pub fn has_memory(&self) -> bool {
        self.manifest.architecture.fusion == Fusion::Survey
    }

    /// Quantiles of the return for all four actions, from a survey.
    ///
    /// # Errors
    /// [`PolicyError::Network`], for a policy that sees an image.
    pub fn judge_survey(&self, survey: &Survey) -> Result<Judgement, PolicyError> {
        Ok(self.plan(survey)?.judge(&[survey.tool])?.remove(0))
    }

    /// Plans over a survey, to judge it with the tool above other cells too.
    ///
    /// # Errors
    /// [`PolicyError::Network`], for a policy that sees an image.
    pub fn plan<'a>(&'a self, survey: &'a Survey) -> Result<Planned<'a>, PolicyError> {
        Ok(Planned { policy: self, plan: self.network.plan(survey)? })
    }

    /// Output of the trunk: `[B]` observations of 2×84×84 bytes → `[B, 128]`. With late fusion the places on channel 1
    /// are not used.
    ///
    /// # Errors
    /// [`PolicyError::Network`].
    pub fn features(&self, observations: &[&[u8]]) -> Result<Tensor, PolicyError> {
        if self.has_memory() {
            return Err(candle_core::Error::msg("the network sees a survey, not an image").into());
        }
        let channels = self.network.architecture().channels();
        Ok(self.network.features(&images(observations.iter().copied(), channels)?)?)
    }

    /// Quantiles from features `[B, 128]` and the `[B]` places of goal and tool.
    ///
    /// # Errors
    /// [`PolicyError::Network`].
    pub fn judge_from(&self, features: &Tensor, places: &[[f32; 4]]) -> Result<Vec<Judgement>, PolicyError> {
        let batch = places.len();
        let places = Tensor::from_iter(places.iter().flatten().copied(), &Device::Cpu)?.reshape((batch, 1, 4))?;
        let fractions = acting_fractions(batch, ACTING_FRACTIONS)?;
        let quantiles = self.network.quantiles(features, &places, &fractions, None)?;
        let count = quantiles.dim(2)?;
        let flat: Vec<f32> = quantiles.flatten_all()?.to_vec1()?;
        let judgement = |row: &[f32]| Judgement {
            quantiles: std::array::from_fn(|action| row.iter().skip(action).step_by(4).copied().collect()),
        };
        Ok(flat.chunks_exact(4 * count).map(judgement).collect())
    }
}

/// A policy's plan over a survey.
#[derive(Clone, Debug)]
pub struct Planned<'a> {
    policy: &'a Policy,
    plan: Plan<'a>,
}

impl Planned<'_> {
    /// Quantiles of the return for all four actions, with the tool above each of many cells.
    ///
    /// # Errors
    /// [`PolicyError::Network`], only if [`Policy`] has accepted an invalid network.
    pub fn judge(&self, cells: &[usize]) -> Result<Vec<Judgement>, PolicyError> {
        let mut judged = Vec::with_capacity(cells.len());
        for cells in cells.chunks(BATCH) {
            let features = self.policy.network.features_at(&self.plan, cells)?;
            judged.extend(self.policy.judge_from(&features, &vec![[0.0; 4]; cells.len()])?);
        }
        Ok(judged)
    }
}

/// The centres of `count` equal parts of [0, 1], for each entry of a batch: `[B, K]`.
pub fn acting_fractions(batch: usize, count: usize) -> candle_core::Result<Tensor> {
    let one = (0..count).map(|k| (k as f32 + 0.5) / count as f32);
    Tensor::from_iter(one, &Device::Cpu)?.unsqueeze(0)?.repeat((batch, 1))
}

/// Images for a trunk with `channels` channels, `[B, 84, 84, channels]` from 0 to 1, from the bytes `[2][84][84]` of
/// observations. With one channel, the second channel of the bytes may be missing.
pub fn images<'a>(observations: impl Iterator<Item = &'a [u8]>, channels: usize) -> candle_core::Result<Tensor> {
    const AREA: usize = OBSERVATION_SIZE_PX * OBSERVATION_SIZE_PX;
    let mut values = Vec::new();
    for bytes in observations {
        match channels {
            1 => values.extend(bytes[..AREA].iter().map(|&byte| f32::from(byte) / 255.0)),
            _ => values.extend((0..AREA).flat_map(|i| [bytes[i], bytes[AREA + i]]).map(|byte| f32::from(byte) / 255.0)),
        }
    }
    let batch = values.len() / (AREA * channels);
    Tensor::from_vec(values, (batch, OBSERVATION_SIZE_PX, OBSERVATION_SIZE_PX, channels), &Device::Cpu)
}
