//! The networks of a training run: the one that is trained, its older copy for the targets, and the average that is
//! shipped. Every kind of training updates them in the same way.

use candle_core::{Device, Tensor, Var};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::adam::Adam;
use ferry_core::policy::{Architecture, Network, PolicyError, TensorSpec, builder, weights};

type NetworkResult<T> = candle_core::Result<T>;

/// All weights, in the order of [`Architecture::tensors`].
pub type Weights = Vec<Vec<f32>>;

/// The learner's state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// The network that is trained.
    pub online: Weights,
    /// Its older copy, which gives the targets.
    pub target: Weights,
    /// The averaged weights, which are evaluated and shipped.
    pub average: Weights,
    /// Moments of the optimiser.
    pub adam: Adam,
    /// Number of updates so far.
    pub updates: u64,
    /// Source of all random draws.
    pub rng: ChaCha8Rng,
}

impl Memory {
    /// Initial weights and optimiser state.
    pub fn new(architecture: &Architecture, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let online: Weights = architecture.tensors().iter().map(|spec| spec.draw(&mut rng)).collect();
        let adam = Adam::new(online.iter().map(Vec::len));
        Self { target: online.clone(), average: online.clone(), online, adam, updates: 0, rng }
    }

    /// Takes the weights in a policy's file. A policy has no scales of noise: those stay as they are.
    ///
    /// # Errors
    /// [`PolicyError`], also if the file is that of another network.
    pub fn start_from(&mut self, architecture: &Architecture, bytes: &[u8]) -> Result<(), PolicyError> {
        let mut known = weights(bytes)?;
        for (spec, values) in architecture.tensors().into_iter().zip(&mut self.online) {
            match known.remove(&spec.name) {
                Some(found) if found.len() == values.len() => *values = found,
                Some(found) => {
                    let found = format!("{} numbers", found.len());
                    return Err(PolicyError::Shape { name: spec.name, found, needed: spec.shape });
                }
                None => {}
            }
        }
        self.target.clone_from(&self.online);
        self.average.clone_from(&self.online);
        known.into_keys().next().map_or(Ok(()), |name| Err(PolicyError::Stray { name }))
    }

    /// Random quantile fractions, `[batch, count]`.
    pub fn draw_fractions(&mut self, batch: usize, count: usize) -> NetworkResult<Tensor> {
        let draws = (0..batch * count).map(|_| self.rng.random::<f32>());
        Tensor::from_iter(draws, &Device::Cpu)?.reshape((batch, count))
    }
}

/// How the weights follow their gradients.
#[derive(Clone, Copy, Debug)]
pub struct Descent {
    /// Learning rate of Adam in the first half of `updates`, and at their end; it falls in the second half.
    pub rates: [f64; 2],
    /// Largest norm of a gradient.
    pub gradient_most: f64,
    /// Decay of the averaged weights.
    pub averaging: f64,
    /// Updates between copies to the target network.
    pub target_period: u64,
    /// Total number of updates.
    pub updates: u64,
}

pub struct Networks {
    variables: Vec<Var>,
    /// Uses the variables.
    pub online: Network,
    /// Uses the same numbers without recording gradients.
    pub frozen: Network,
    pub target: Network,
}

/// A network with the given weights.
pub fn network(architecture: Architecture, weights: &Weights) -> NetworkResult<Network> {
    let tensors = architecture.tensors().into_iter().zip(weights);
    let tensors = tensors.map(|(spec, values)| Ok((spec.name, Tensor::from_slice(values, spec.shape, &Device::Cpu)?)));
    Network::new(architecture, &builder(tensors.collect::<NetworkResult<_>>()?))
}

impl Networks {
    /// # Errors Those of candle, if the weights do not have the shapes of the network.
    pub fn new(architecture: Architecture, memory: &Memory) -> NetworkResult<Self> {
        let specs = architecture.tensors();
        let variable =
            |(spec, values): (&TensorSpec, &Vec<f32>)| Var::from_slice(values, spec.shape.clone(), &Device::Cpu);
        let variables = specs.iter().zip(&memory.online).map(variable).collect::<NetworkResult<Vec<_>>>()?;
        let names = || specs.iter().map(|spec| spec.name.clone());
        let taped = names().zip(variables.iter().map(|variable| variable.as_tensor().clone()));
        let online = Network::new(architecture, &builder(taped.collect()))?;
        let detached = names().zip(variables.iter().map(Var::as_detached_tensor));
        let frozen = Network::new(architecture, &builder(detached.collect()))?;
        let target = network(architecture, &memory.target)?;
        Ok(Self { variables, online, frozen, target })
    }

    /// One step down the gradient of a loss: of the weights, of their average and, if it is due, of the target network.
    /// Returns the norm of the gradient before clipping, and whether the target network changed.
    ///
    /// # Errors Those of candle.
    pub fn descend(&mut self, loss: &Tensor, memory: &mut Memory, descent: &Descent) -> NetworkResult<(f64, bool)> {
        let gradients = loss.backward()?;
        let gradients = self.variables.iter().map(|variable| match gradients.get(variable) {
            Some(gradient) => gradient.flatten_all()?.to_vec1(),
            None => Ok(vec![0.0; variable.elem_count()]),
        });
        let gradients = gradients.collect::<NetworkResult<Weights>>()?;
        let progress = memory.updates as f64 / descent.updates as f64;
        let fallen = (2.0 * progress - 1.0).clamp(0.0, 1.0);
        let rate = descent.rates[0] + (descent.rates[1] - descent.rates[0]) * fallen;
        let length = memory.adam.step(&mut memory.online, &gradients, rate, descent.gradient_most);
        for (variable, values) in self.variables.iter().zip(&memory.online) {
            variable.set(&Tensor::from_slice(values, variable.shape(), &Device::Cpu)?)?;
        }
        let kept = descent.averaging as f32;
        for (average, online) in memory.average.iter_mut().zip(&memory.online) {
            for (average, &online) in average.iter_mut().zip(online) {
                *average = kept * *average + (1.0 - kept) * online;
            }
        }
        memory.updates += 1;
        let is_due = memory.updates.is_multiple_of(descent.target_period);
        if is_due {
            memory.target.clone_from(&memory.online);
            self.target = network(*self.online.architecture(), &memory.target)?;
        }
        Ok((length, is_due))
    }
}
