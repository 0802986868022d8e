//! The network: a ResNet trunk (He et al. 2016), implicit quantiles (Dabney et al. 2018, "Implicit Quantile
//! Networks"), a dueling head (Wang et al. 2016) of factorised noisy layers (Fortunato et al. 2018).

use std::f32::consts::PI;

use candle_core::{D, Device, Result, Tensor};
use rand::{Rng, RngExt};
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

use super::convolution::Convolution;
use super::modulation::modulate;

/// Width of every fully connected layer.
pub const HIDDEN: usize = 128;
/// Channels of the trunk.
const CHANNELS: usize = 32;
/// Side of the trunk's last images, 84 px / 7 / 2.
const LAST_SIDE: usize = 6;
/// Cosines that a quantile fraction is embedded by (Dabney et al. 2018, §4).
const COSINES: usize = 64;
/// Octaves that a place is embedded by.
const OCTAVES: usize = 4;
/// Parts that the rows of a large product are cut into.
const ROW_PARTS: usize = 16;
/// A place's embedding: the four numbers, and their sines and cosines.
const PLACE: usize = 4 * (1 + 2 * OCTAVES);
/// σ0 of the noisy layers (Fortunato et al. 2018, §3.2).
const SIGMA: f32 = 0.5;

/// Where goal and tool, the observation's second channel, meet the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fusion {
    /// The trunk looks at both channels (the paper).
    Early,
    /// The trunk looks at the image alone; the four numbers that channel 1 repeats join its features.
    Late,
}

/// What parts the network has; all on but for early fusion is what Ferry trains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Architecture {
    /// Where the second channel comes in.
    pub fusion: Fusion,
    /// Implicit quantiles; without, one value an action.
    pub quantiles: bool,
    /// Value and advantage apart.
    pub dueling: bool,
    /// Noisy layers for the last two; without, plain ones.
    pub noisy: bool,
    /// Skip connections in the trunk.
    pub residual: bool,
}

impl Default for Architecture {
    fn default() -> Self {
        Self { fusion: Fusion::Late, quantiles: true, dueling: true, noisy: true, residual: true }
    }
}

/// How a weight begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Initial {
    /// Uniform in ±1/√(inputs of the layer).
    Uniform {
        /// Inputs of the layer.
        inputs: usize,
    },
    /// The same number everywhere.
    Constant(f32),
}

/// A weight's name, shape and beginning.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorSpec {
    /// Name in the file.
    pub name: String,
    /// Shape.
    pub shape: Vec<usize>,
    /// How it begins.
    pub initial: Initial,
}

impl Architecture {
    /// Channels that the trunk looks at.
    pub fn channels(&self) -> usize {
        match self.fusion {
            Fusion::Early => 2,
            Fusion::Late => 1,
        }
    }

    /// All weights, in a fixed order.
    pub fn tensors(&self) -> Vec<TensorSpec> {
        let mut specs = Vec::new();
        let mut add = |name: &str, shape: &[usize], initial| {
            specs.push(TensorSpec { name: name.to_owned(), shape: shape.to_vec(), initial });
        };
        let mut layer = |name: &str, inputs: usize, outputs: usize, noisy: bool| {
            let uniform = Initial::Uniform { inputs };
            add(&format!("{name}.weight"), &[inputs, outputs], uniform);
            add(&format!("{name}.bias"), &[outputs], uniform);
            if noisy {
                let sigma = Initial::Constant(SIGMA / (inputs as f32).sqrt());
                add(&format!("{name}.weight_sigma"), &[inputs, outputs], sigma);
                add(&format!("{name}.bias_sigma"), &[outputs], sigma);
            }
        };
        layer("trunk.patches", 7 * 7 * self.channels(), CHANNELS, false);
        for name in
            ["trunk.block1.conv1", "trunk.block1.conv2", "trunk.reduce", "trunk.block2.conv1", "trunk.block2.conv2"]
        {
            layer(name, 3 * 3 * CHANNELS, CHANNELS, false);
        }
        layer("trunk.features", LAST_SIDE * LAST_SIDE * CHANNELS, HIDDEN, false);
        layer("join.features", HIDDEN, HIDDEN, false);
        if self.fusion == Fusion::Late {
            layer("place", PLACE, HIDDEN, false);
            layer("join.place", HIDDEN, HIDDEN, false);
        }
        if self.quantiles {
            layer("fraction", COSINES, HIDDEN, false);
        }
        for (name, inputs, outputs) in self.head() {
            layer(name, inputs, outputs, self.noisy);
        }
        specs
    }

    /// The last two layers: name, inputs, outputs.
    fn head(&self) -> Vec<(&'static str, usize, usize)> {
        let mut layers = vec![("advantage.hidden", HIDDEN, HIDDEN), ("advantage.out", HIDDEN, 4)];
        if self.dueling {
            layers.extend([("value.hidden", HIDDEN, HIDDEN), ("value.out", HIDDEN, 1)]);
        }
        layers
    }
}

impl TensorSpec {
    /// Draws the first values, row-major.
    pub fn draw(&self, rng: &mut impl Rng) -> Vec<f32> {
        let count = self.shape.iter().product();
        match self.initial {
            Initial::Constant(value) => vec![value; count],
            Initial::Uniform { inputs } => {
                let most = 1.0 / (inputs as f32).sqrt();
                (0..count).map(|_| rng.random_range(-most..most)).collect()
            }
        }
    }
}

/// y = x·W + b, with W + σ_W∘ε when noisy.
#[derive(Clone, Debug)]
struct Linear {
    weight: Tensor,
    bias: Tensor,
    sigma: Option<(Tensor, Tensor)>,
}

/// Whether a layer takes negative inputs as zero: the ReLU before it costs no pass of its own.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Input {
    AsItIs,
    Rectified,
}

impl Linear {
    /// `[M, inputs]` → `[M, outputs]`.
    fn forward(&self, x: &Tensor, input: Input, noise: Option<&LayerNoise>) -> Result<Tensor> {
        match (&self.sigma, noise) {
            (Some((weight_sigma, bias_sigma)), Some(noise)) => {
                let weight = (&self.weight + (weight_sigma * &noise.weight)?)?;
                let bias = (&self.bias + (bias_sigma * &noise.bias)?)?;
                pointwise(x, &weight, &bias, input)
            }
            _ => pointwise(x, &self.weight, &self.bias, input),
        }
    }
}

/// A linear layer as a convolution over single pixels, whose bias and ReLU and their gradients cost nothing: candle's
/// own sum over the rows takes longer than the product.
fn pointwise(x: &Tensor, weight: &Tensor, bias: &Tensor, input: Input) -> Result<Tensor> {
    let (rows, inputs) = x.dims2()?;
    // Rows in parts, which the thread pool shares.
    let parts = if rows.is_multiple_of(ROW_PARTS) { ROW_PARTS } else { 1 };
    let layer = Convolution { kernel: 1, stride: 1, padding: 0, rectify_input: input == Input::Rectified };
    let y = layer.forward(&x.reshape((parts, rows / parts, 1, inputs))?, weight, bias)?;
    y.reshape((rows, bias.elem_count()))
}

/// ε of one noisy layer.
#[derive(Clone, Debug)]
struct LayerNoise {
    weight: Tensor,
    bias: Tensor,
}

/// One draw of the noise of all noisy layers (Fortunato et al. 2018, equations 10 and 11): ε_ij = f(ε_i)·f(ε_j) with
/// f(x) = sgn x·√|x|.
#[derive(Clone, Debug)]
pub struct Noise(Vec<LayerNoise>);

impl Noise {
    /// Draws noise for an architecture; `None` where it has no noisy layers.
    ///
    /// # Errors
    /// Of candle, which no shape here gives.
    pub fn draw(architecture: &Architecture, rng: &mut impl Rng) -> Result<Option<Self>> {
        if !architecture.noisy {
            return Ok(None);
        }
        let mut vector = |count: usize| {
            let scaled = (0..count).map(|_| {
                let x: f32 = rng.sample(StandardNormal);
                x.signum() * x.abs().sqrt()
            });
            Tensor::from_iter(scaled, &Device::Cpu)
        };
        let layers = architecture.head().into_iter().map(|(_, inputs, outputs)| {
            let (from, to) = (vector(inputs)?, vector(outputs)?);
            let weight = from.unsqueeze(1)?.matmul(&to.unsqueeze(0)?)?;
            Ok(LayerNoise { weight, bias: to })
        });
        layers.collect::<Result<Vec<_>>>().map(|layers| Some(Self(layers)))
    }
}

/// The network over given weights.
#[derive(Clone, Debug)]
pub struct Network {
    architecture: Architecture,
    patches: Linear,
    block1: [Linear; 2],
    reduce: Linear,
    block2: [Linear; 2],
    features: Linear,
    join_features: Linear,
    /// Embedding of the places and what joins them, with late fusion.
    place: Option<[Linear; 2]>,
    fraction: Option<Linear>,
    advantage: [Linear; 2],
    value: Option<[Linear; 2]>,
}

impl Network {
    /// A network over the weights that `get` finds by name, of the shapes of [`Architecture::tensors`].
    ///
    /// # Errors
    /// What `get` gives.
    pub fn new<E>(
        architecture: Architecture,
        mut get: impl FnMut(&str) -> std::result::Result<Tensor, E>,
    ) -> std::result::Result<Self, E> {
        let mut layer = |name: &str, noisy: bool| {
            let sigma = match noisy {
                true => Some((get(&format!("{name}.weight_sigma"))?, get(&format!("{name}.bias_sigma"))?)),
                false => None,
            };
            Ok(Linear { weight: get(&format!("{name}.weight"))?, bias: get(&format!("{name}.bias"))?, sigma })
        };
        let noisy = architecture.noisy;
        Ok(Self {
            architecture,
            patches: layer("trunk.patches", false)?,
            block1: [layer("trunk.block1.conv1", false)?, layer("trunk.block1.conv2", false)?],
            reduce: layer("trunk.reduce", false)?,
            block2: [layer("trunk.block2.conv1", false)?, layer("trunk.block2.conv2", false)?],
            features: layer("trunk.features", false)?,
            join_features: layer("join.features", false)?,
            place: match architecture.fusion {
                Fusion::Late => Some([layer("place", false)?, layer("join.place", false)?]),
                Fusion::Early => None,
            },
            fraction: if architecture.quantiles { Some(layer("fraction", false)?) } else { None },
            advantage: [layer("advantage.hidden", noisy)?, layer("advantage.out", noisy)?],
            value: match architecture.dueling {
                true => Some([layer("value.hidden", noisy)?, layer("value.out", noisy)?]),
                false => None,
            },
        })
    }

    /// What parts it has.
    pub fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    /// The trunk and the first layer after it: images `[B, 84, 84, channels]` → features `[B, 128]`.
    ///
    /// # Errors
    /// Of candle, for another shape.
    pub fn features(&self, images: &Tensor) -> Result<Tensor> {
        let conv = |layer: &Linear, x: &Tensor, kernel, stride, rectify_input| {
            let padding = usize::from(kernel == 3);
            Convolution { kernel, stride, padding, rectify_input }.forward(x, &layer.weight, &layer.bias)
        };
        let block = |layers: &[Linear; 2], x: &Tensor| {
            let y = conv(&layers[1], &conv(&layers[0], x, 3, 1, true)?, 3, 1, true)?;
            if self.architecture.residual { x + y } else { Ok(y) }
        };
        let x = conv(&self.patches, images, 7, 7, false)?;
        let x = block(&self.block1, &x)?;
        let x = conv(&self.reduce, &x, 3, 2, true)?;
        let x = block(&self.block2, &x)?;
        let x = self.features.forward(&x.flatten_from(1)?, Input::Rectified, None)?;
        self.join_features.forward(&x, Input::Rectified, None)
    }

    /// Quantiles of the return: features `[B, 128]`, places `[B, G, 4]` of `G` goals (and tools) for each image, from 0
    /// to 1, fractions `[B, N]` → `[B, G, N, 4]`. With early fusion the features know the places, and `G` is 1; without
    /// quantiles `N` is 1, whatever the fractions.
    ///
    /// # Errors
    /// Of candle, for other shapes.
    pub fn quantiles(
        &self,
        features: &Tensor,
        places: &Tensor,
        fractions: &Tensor,
        noise: Option<&Noise>,
    ) -> Result<Tensor> {
        let (batch, goals, _) = places.dims3()?;
        let mut state = features.unsqueeze(1)?;
        if let Some([embed, join]) = &self.place {
            let octaves = octaves(&places.reshape((batch * goals, 4))?)?;
            let embedded = embed.forward(&octaves, Input::AsItIs, None)?;
            let joined = join.forward(&embedded, Input::Rectified, None)?.reshape((batch, goals, HIDDEN))?;
            state = joined.broadcast_add(&state)?;
        }
        let (state, count) = match &self.fraction {
            Some(layer) => {
                let count = fractions.dim(1)?;
                let embedded = layer.forward(&cosines(&fractions.flatten_all()?)?, Input::AsItIs, None)?;
                (modulate(&state, &embedded.reshape((batch, count, HIDDEN))?)?, count)
            }
            None => (state.relu()?, 1),
        };
        let flat = state.reshape((batch * goals * count, HIDDEN))?;
        let noise = |index: usize| noise.map(|Noise(layers)| &layers[index]);
        let stream = |layers: &[Linear; 2], first: usize| {
            let hidden = layers[0].forward(&flat, Input::AsItIs, noise(first))?;
            layers[1].forward(&hidden, Input::Rectified, noise(first + 1))
        };
        let advantage = stream(&self.advantage, 0)?;
        let out = match &self.value {
            Some(layers) => {
                let centered = advantage.broadcast_sub(&advantage.mean_keepdim(D::Minus1)?)?;
                centered.broadcast_add(&stream(layers, 2)?)?
            }
            None => advantage,
        };
        out.reshape((batch, goals, count, 4))
    }
}

/// cos(π·j·τ) for j < 64: `[M]` → `[M, 64]` (Dabney et al. 2018, equation 4).
fn cosines(fractions: &Tensor) -> Result<Tensor> {
    let orders = Tensor::from_iter((0..COSINES).map(|j| PI * j as f32), &Device::Cpu)?;
    fractions.unsqueeze(1)?.matmul(&orders.unsqueeze(0)?)?.cos()
}

/// The numbers themselves, and sine and cosine of π·2^k times them: `[M, 4]` → `[M, 36]`.
fn octaves(places: &Tensor) -> Result<Tensor> {
    let mut parts = vec![places.clone()];
    for octave in 0..OCTAVES {
        let angle = (places * (std::f64::consts::PI * f64::from(1 << octave)))?;
        parts.extend([angle.sin()?, angle.cos()?]);
    }
    Tensor::cat(&parts, 1)
}

#[cfg(test)]
mod tests;
