//! Fully connected layers, plain and noisy (Fortunato et al. 2018, "Noisy Networks for Exploration").

use candle_core::{Device, Error, Result, Tensor};
use candle_nn::VarBuilder;
use rand::{Rng, RngExt};
use rand_distr::StandardNormal;

use super::convolution::Convolution;

/// Number of parts into which the rows of a large product are divided.
const ROW_PARTS: usize = 16;

/// y = x·W + b, with W + σ_W∘ε if noisy.
#[derive(Clone, Debug)]
pub(super) struct Linear {
    pub weight: Tensor,
    pub bias: Tensor,
    pub sigma: Option<(Tensor, Tensor)>,
}

/// Whether a layer rectifies its input, so that the preceding ReLU needs no separate pass.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Input {
    AsItIs,
    Rectified,
}

impl Linear {
    /// # Errors Those of candle, for a missing weight.
    pub fn new(weights: &VarBuilder<'_>, noisy: bool) -> Result<Self> {
        let get = |name| weights.get_unchecked(name);
        let sigma = noisy.then(|| Ok::<_, Error>((get("weight_sigma")?, get("bias_sigma")?))).transpose()?;
        Ok(Self { weight: get("weight")?, bias: get("bias")?, sigma })
    }

    /// `[M, inputs]` → `[M, outputs]`.
    pub fn forward(&self, x: &Tensor, input: Input, noise: Option<&LayerNoise>) -> Result<Tensor> {
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

/// A linear layer as a convolution over single pixels, which includes bias, ReLU and their gradients at no cost. With
/// candle, the sum over the rows takes longer than the product.
fn pointwise(x: &Tensor, weight: &Tensor, bias: &Tensor, input: Input) -> Result<Tensor> {
    let (rows, inputs) = x.dims2()?;
    // Rows are divided into parts for the thread pool.
    let parts = if rows.is_multiple_of(ROW_PARTS) { ROW_PARTS } else { 1 };
    let layer = Convolution { kernel: 1, stride: 1, padding: 0, rectify_input: input == Input::Rectified };
    let y = layer.forward(&x.reshape((parts, rows / parts, 1, inputs))?, weight, bias)?;
    y.reshape((rows, bias.elem_count()))
}

/// ε of one noisy layer.
#[derive(Clone, Debug)]
pub(super) struct LayerNoise {
    pub weight: Tensor,
    pub bias: Tensor,
}

/// One draw of the noise of all noisy layers (Fortunato et al. 2018, equations 10 and 11): ε_ij = f(ε_i)·f(ε_j) with
/// f(x) = sgn x·√|x|.
#[derive(Clone, Debug)]
pub struct Noise(pub(super) Vec<LayerNoise>);

impl Noise {
    /// Draws noise for layers, given by inputs and outputs.
    ///
    /// # Errors Those of candle, which cannot occur with these shapes.
    pub(super) fn of_layers(layers: &[(&str, usize, usize)], rng: &mut impl Rng) -> Result<Self> {
        let mut vector = |count: usize| {
            let scaled = (0..count).map(|_| {
                let x: f32 = rng.sample(StandardNormal);
                x.signum() * x.abs().sqrt()
            });
            Tensor::from_iter(scaled, &Device::Cpu)
        };
        let layers = layers.iter().map(|&(_, inputs, outputs)| {
            let (from, to) = (vector(inputs)?, vector(outputs)?);
            let weight = from.unsqueeze(1)?.matmul(&to.unsqueeze(0)?)?;
            Ok(LayerNoise { weight, bias: to })
        });
        layers.collect::<Result<Vec<_>>>().map(Self)
    }
}
