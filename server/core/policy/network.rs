//! The network: a ResNet trunk (He et al. 2016), implicit quantiles (Dabney et al. 2018, "Implicit Quantile Networks"),
//! and a dueling head (Wang et al. 2016) of factorised noisy layers (Fortunato et al. 2018).

use std::collections::HashMap;
use std::f32::consts::PI;

use candle_core::{D, DType, Device, Result, Tensor};
use candle_nn::VarBuilder;
use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

use super::convolution::Convolution;
use super::linear::{Input, Linear, Noise};
use super::modulation::modulate;
use super::survey::{Plan, Survey, SurveyParts, SurveyTrunk};

/// Width of every fully connected layer.
pub const HIDDEN: usize = 128;
/// Channels of the trunk.
const CHANNELS: usize = 32;
/// Side of the trunk's last images, 84 px / 7 / 2.
const LAST_SIDE: usize = 6;
/// Cosines in the embedding of a quantile fraction (Dabney et al. 2018, §4).
const COSINES: usize = 64;
/// Octaves in the embedding of a place.
const OCTAVES: usize = 4;
/// Size of the embedding of the places: the four numbers, and their sines and cosines.
const PLACE: usize = 4 * (1 + 2 * OCTAVES);
/// σ0 of the noisy layers (Fortunato et al. 2018, §3.2).
const SIGMA: f32 = 0.5;

/// Where goal and tool (the observation's second channel) enter the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fusion {
    /// The trunk processes both channels, as in the paper.
    Early,
    /// The trunk processes only the image; the four numbers of channel 1 are joined to its features.
    Late,
    /// The trunk plans on a [`Survey`] instead of processing an image. Goal and tool are on the survey.
    Survey,
}

/// The parts of the network. The shipped policies use late fusion and all parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Architecture {
    pub fusion: Fusion,
    /// Implicit quantiles; otherwise one value per action.
    pub quantiles: bool,
    /// Separate value and advantage.
    pub dueling: bool,
    /// Noisy layers as the last two; otherwise plain ones.
    pub noisy: bool,
    /// Skip connections in the trunk; without a survey.
    pub residual: bool,
    /// The parts of a survey that the network sees.
    #[serde(default)]
    pub survey: SurveyParts,
}

impl Default for Architecture {
    fn default() -> Self {
        Self {
            fusion: Fusion::Late,
            quantiles: true,
            dueling: true,
            noisy: true,
            residual: true,
            survey: SurveyParts::ALL,
        }
    }
}

/// Initial distribution of a weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Initial {
    /// Uniform in ±1/√(inputs of the layer).
    Uniform {
        /// Number of inputs of the layer.
        inputs: usize,
    },
    /// The same value everywhere.
    Constant(f32),
}

/// Tensors by their names, for [`Network::new`].
pub fn builder(tensors: HashMap<String, Tensor>) -> VarBuilder<'static> {
    VarBuilder::from_tensors(tensors, DType::F32, &Device::Cpu)
}

/// Name, shape and initial distribution of a weight.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorSpec {
    /// Name in the file.
    pub name: String,
    pub shape: Vec<usize>,
    pub initial: Initial,
}

impl Architecture {
    /// Number of channels that the trunk processes.
    pub fn channels(&self) -> usize {
        match self.fusion {
            Fusion::Early => 2,
            Fusion::Late => 1,
            Fusion::Survey => SurveyTrunk::PLANES,
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
        if self.fusion == Fusion::Survey {
            for (name, inputs, outputs) in SurveyTrunk::layers(self.survey, HIDDEN) {
                layer(&format!("survey.{name}"), inputs, outputs, false);
            }
        } else {
            self.add_image_layers(&mut layer);
        }
        if self.quantiles {
            layer("fraction", COSINES, HIDDEN, false);
        }
        for (name, inputs, outputs) in self.head() {
            layer(name, inputs, outputs, self.noisy);
        }
        specs
    }

    fn add_image_layers(&self, layer: &mut impl FnMut(&str, usize, usize, bool)) {
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
    }

    /// One draw of the noise of all noisy layers; `None` without noisy layers.
    ///
    /// # Errors Those of candle, which cannot occur with these shapes.
    pub fn draw_noise(&self, rng: &mut impl Rng) -> Result<Option<Noise>> {
        self.noisy.then(|| Noise::of_layers(&self.head(), rng)).transpose()
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
    /// Draws the initial values, row-major.
    pub fn draw(&self, rng: &mut impl Rng) -> Vec<f32> {
        let count = self.shape.iter().product();
        match self.initial {
            Initial::Constant(value) => vec![value; count],
            Initial::Uniform { inputs } => {
                let max = 1.0 / (inputs as f32).sqrt();
                (0..count).map(|_| rng.random_range(-max..max)).collect()
            }
        }
    }
}

/// The network with its weights.
#[derive(Clone, Debug)]
pub struct Network {
    architecture: Architecture,
    trunk: Trunk,
    /// Embedding of the places, and its join with the features; late fusion only.
    place: Option<[Linear; 2]>,
    fraction: Option<Linear>,
    advantage: [Linear; 2],
    value: Option<[Linear; 2]>,
}

#[derive(Clone, Debug)]
enum Trunk {
    Image(ImageTrunk),
    Survey(SurveyTrunk),
}

#[derive(Clone, Debug)]
struct ImageTrunk {
    patches: Linear,
    block1: [Linear; 2],
    reduce: Linear,
    block2: [Linear; 2],
    features: Linear,
    join_features: Linear,
}

impl Network {
    /// A network with the weights of a builder, which have the names and shapes of [`Architecture::tensors`].
    ///
    /// # Errors Those of candle, for a missing weight.
    pub fn new(architecture: Architecture, weights: &VarBuilder<'_>) -> Result<Self> {
        let layer = |name: &str, noisy: bool| Linear::new(&weights.pp(name), noisy);
        let noisy = architecture.noisy;
        let trunk = match architecture.fusion {
            Fusion::Survey => Trunk::Survey(SurveyTrunk::new(architecture.survey, &weights.pp("survey"))?),
            Fusion::Early | Fusion::Late => Trunk::Image(ImageTrunk {
                patches: layer("trunk.patches", false)?,
                block1: [layer("trunk.block1.conv1", false)?, layer("trunk.block1.conv2", false)?],
                reduce: layer("trunk.reduce", false)?,
                block2: [layer("trunk.block2.conv1", false)?, layer("trunk.block2.conv2", false)?],
                features: layer("trunk.features", false)?,
                join_features: layer("join.features", false)?,
            }),
        };
        Ok(Self {
            architecture,
            trunk,
            place: match architecture.fusion {
                Fusion::Late => Some([layer("place", false)?, layer("join.place", false)?]),
                Fusion::Early | Fusion::Survey => None,
            },
            fraction: if architecture.quantiles { Some(layer("fraction", false)?) } else { None },
            advantage: [layer("advantage.hidden", noisy)?, layer("advantage.out", noisy)?],
            value: match architecture.dueling {
                true => Some([layer("value.hidden", noisy)?, layer("value.out", noisy)?]),
                false => None,
            },
        })
    }

    pub fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    /// The trunk and the first layer after it: images `[B, 84, 84, channels]` → features `[B, 128]`.
    ///
    /// # Errors Those of candle, for another shape, or for a network that has no image.
    pub fn features(&self, images: &Tensor) -> Result<Tensor> {
        match &self.trunk {
            Trunk::Image(trunk) => trunk.features(images, self.architecture.residual),
            Trunk::Survey(_) => candle_core::bail!("the network sees a survey, not an image"),
        }
    }

    /// The same from surveys of one shape: `[B]` → features `[B, 128]`.
    ///
    /// # Errors Those of candle, for surveys of several shapes, or for a network that has no survey.
    pub fn features_of_surveys(&self, surveys: &[&Survey]) -> Result<Tensor> {
        match &self.trunk {
            Trunk::Survey(trunk) => trunk.features(surveys),
            Trunk::Image(_) => candle_core::bail!("the network sees an image, not a survey"),
        }
    }

    /// The plan over one survey.
    ///
    /// # Errors Those of candle, for a network that has no survey.
    pub(super) fn plan<'a>(&self, survey: &'a Survey) -> Result<Plan<'a>> {
        match &self.trunk {
            Trunk::Survey(trunk) => trunk.plan(survey),
            Trunk::Image(_) => candle_core::bail!("the network sees an image, not a survey"),
        }
    }

    /// Features with the tool above each of many cells of a plan's survey: `[cells, 128]`.
    ///
    /// # Errors Those of candle, for a network that has no survey.
    pub(super) fn features_at(&self, plan: &Plan<'_>, cells: &[usize]) -> Result<Tensor> {
        match &self.trunk {
            Trunk::Survey(trunk) => trunk.features_at(plan, cells),
            Trunk::Image(_) => candle_core::bail!("the network sees an image, not a survey"),
        }
    }

    /// Quantiles of the return: features `[B, 128]`, places `[B, G, 4]` from 0 to 1 of `G` goals (and tools) per image,
    /// fractions `[B, N]` → `[B, G, N, 4]`. Without late fusion the features include the places, and `G` is 1. Without
    /// quantiles `N` is 1 for any fractions.
    ///
    /// # Errors Those of candle, for other shapes.
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

impl ImageTrunk {
    fn features(&self, images: &Tensor, residual: bool) -> Result<Tensor> {
        let conv = |layer: &Linear, x: &Tensor, kernel, stride, rectify_input| {
            let padding = usize::from(kernel == 3);
            Convolution { kernel, stride, padding, rectify_input }.forward(x, &layer.weight, &layer.bias)
        };
        let block = |layers: &[Linear; 2], x: &Tensor| {
            let y = conv(&layers[1], &conv(&layers[0], x, 3, 1, true)?, 3, 1, true)?;
            if residual { x + y } else { Ok(y) }
        };
        let x = conv(&self.patches, images, 7, 7, false)?;
        let x = block(&self.block1, &x)?;
        let x = conv(&self.reduce, &x, 3, 2, true)?;
        let x = block(&self.block2, &x)?;
        let x = self.features.forward(&x.flatten_from(1)?, Input::Rectified, None)?;
        self.join_features.forward(&x, Input::Rectified, None)
    }
}

/// cos(π·j·τ) for j < 64: `[M]` → `[M, 64]` (Dabney et al. 2018, equation 4).
fn cosines(fractions: &Tensor) -> Result<Tensor> {
    let orders = Tensor::from_iter((0..COSINES).map(|j| PI * j as f32), &Device::Cpu)?;
    // Not `matmul`: candle's reads /proc/cpuinfo each time.
    fractions.unsqueeze(1)?.broadcast_mul(&orders.unsqueeze(0)?)?.cos()
}

/// The numbers themselves, and the sine and cosine of π·2^k times them: `[M, 4]` → `[M, 36]`.
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
