//! The file of a policy: safetensors with the manifest in the metadata.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, OnceLock};

use candle_core::{Device, Tensor};
use rust_embed::RustEmbed;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::{Deserialize, Serialize};

use super::network::{Architecture, Fusion, Network, TensorSpec, builder};
use super::{OBSERVATION_SIZE_PX, Policy};

/// Key of the manifest in the metadata.
const KEY: &str = "ferry";
/// Size limit of a policy's file.
pub const MAX_BYTES: u64 = 16 << 20;
/// Largest weight; those of shipped policies are below 10.
const WEIGHT_MOST: f32 = 1e4;
/// Size limit of the header; shipped policies have 3 KiB.
const MAX_HEADER_BYTES: u64 = 64 << 10;

#[derive(RustEmbed)]
#[folder = "../../assets/policies"]
#[include = "*.safetensors"]
struct Assets;

/// Origin and requirements of a policy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Layout of this manifest, 1.
    pub version: u32,
    /// Maps used in training.
    pub maps: Vec<String>,
    pub step_m: f64,
    /// Shape of the observation: 2 × 84 × 84, or the planes of a survey, whose sides are those of the map.
    pub observation: [usize; 3],
    /// Parts of the network.
    pub architecture: Architecture,
    /// Distance from walls at which training ended an episode.
    pub clearance_m: f64,
    /// Seed of the training run.
    pub seed: u64,
    /// Git revision of the training program.
    pub revision: String,
    /// Number of updates of the weights.
    pub updates: u64,
}

impl Manifest {
    /// Version of the manifest's layout and of the outputs' meaning.
    pub const VERSION: u32 = 1;

    /// Shape of an architecture's observation; a side of 0 is that of the map.
    pub fn observation(architecture: &Architecture) -> [usize; 3] {
        match architecture.fusion {
            Fusion::Early | Fusion::Late => [2, OBSERVATION_SIZE_PX, OBSERVATION_SIZE_PX],
            Fusion::Survey => [architecture.channels(), 0, 0],
        }
    }
}

/// Why a policy was refused, or why its network failed.
#[derive(Debug, thiserror::Error)]
pub enum PolicyError {
    /// No policy has this name.
    #[error("policy: there is no policy named {name:?}; there are {}", known.join(", "))]
    Unknown {
        name: String,
        /// Existing names.
        known: Vec<String>,
    },
    /// The file could not be read.
    #[error("policy: {path}: {error}")]
    Io { path: String, error: std::io::Error },
    /// The file is larger than a policy can be.
    #[error("policy: the file has {bytes} bytes, the limit is {MAX_BYTES}")]
    TooLarge { bytes: u64 },
    /// The header is longer than that of a policy can be.
    #[error(
        "policy: not a safetensors file of Ferry: its header would have {bytes} bytes, the limit is {MAX_HEADER_BYTES}"
    )]
    Header {
        /// The value of the file's first eight bytes.
        bytes: u64,
    },
    /// A file of another format.
    #[error(
        "policy: this is {0}, which Ferry does not read; it reads the safetensors files that it writes, such as those of `ferry \
         train`; other networks carry the bead as a program (docs/python.md)"
    )]
    Foreign(&'static str),
    /// Not a safetensors file.
    #[error("policy: not a safetensors file: {0}")]
    Format(#[from] safetensors::SafeTensorError),
    /// The manifest is missing or wrong.
    #[error("policy: manifest: {0}")]
    Manifest(String),
    /// A tensor is missing.
    #[error("policy: tensor {name:?} is missing")]
    Missing { name: String },
    /// A tensor does not fit the observation or the network.
    #[error("policy: tensor {name:?} is {found}, the observation and the network need {needed:?} of f32")]
    Shape {
        name: String,
        /// Shape and type found.
        found: String,
        /// Required shape.
        needed: Vec<usize>,
    },
    /// A tensor that the network does not have.
    #[error("policy: tensor {name:?} is not part of the network")]
    Stray { name: String },
    /// A number in a tensor is not finite, or so large that sums of it would not be.
    #[error("policy: tensor {name:?} contains {value}, it must be -{WEIGHT_MOST} to {WEIGHT_MOST}")]
    Weight { name: String, value: f32 },
    /// The header names a tensor more than once.
    #[error("policy: tensor {name:?} is in the file twice")]
    Twice { name: String },
    /// The network returned an error.
    #[error("policy: {0}")]
    Network(#[from] candle_core::Error),
}

impl Policy {
    pub fn shipped_names() -> Vec<String> {
        let names = Assets::iter().filter_map(|file| file.strip_suffix(".safetensors").map(str::to_owned));
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    /// A shipped policy; each is read only once.
    ///
    /// # Errors
    /// [`PolicyError::Unknown`].
    pub fn shipped(name: &str) -> Result<Arc<Self>, PolicyError> {
        static READ: OnceLock<HashMap<String, Arc<Policy>>> = OnceLock::new();
        let read = READ.get_or_init(|| {
            let read = |name: String| {
                let file = Assets::get(&format!("{name}.safetensors")).expect("a listed asset exists");
                let policy = Self::from_bytes(&file.data).expect("shipped policies are valid: a test reads them");
                (name, Arc::new(policy))
            };
            Self::shipped_names().into_iter().map(read).collect()
        });
        let found = read.get(name).cloned();
        found.ok_or_else(|| PolicyError::Unknown { name: name.to_owned(), known: Self::shipped_names() })
    }

    /// The file of a shipped policy.
    ///
    /// # Errors
    /// [`PolicyError::Unknown`].
    pub fn shipped_bytes(name: &str) -> Result<Vec<u8>, PolicyError> {
        let file = Assets::get(&format!("{name}.safetensors"));
        let unknown = || PolicyError::Unknown { name: name.to_owned(), known: Self::shipped_names() };
        Ok(file.ok_or_else(unknown)?.data.into_owned())
    }

    /// Reads a policy. Errors name the tensor that does not fit.
    ///
    /// # Errors
    /// [`PolicyError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PolicyError> {
        // Checked before parsing, so that the file cannot determine how much is read.
        let header = bytes.first_chunk().map_or(0, |length| u64::from_le_bytes(*length));
        if header > MAX_HEADER_BYTES {
            return Err(foreign(bytes).map_or(PolicyError::Header { bytes: header }, PolicyError::Foreign));
        }
        if let Some(name) = twice(bytes, header as usize) {
            return Err(PolicyError::Twice { name });
        }
        let file = SafeTensors::deserialize(bytes)?;
        let (_, metadata) = SafeTensors::read_metadata(bytes)?;
        let text = metadata.metadata().as_ref().and_then(|entries| entries.get(KEY));
        let text = text.ok_or_else(|| {
            PolicyError::Manifest(format!("the metadata has no {KEY:?}: another program has written it"))
        })?;
        let mut json = serde_json::Deserializer::from_str(text);
        let manifest: Manifest =
            serde_path_to_error::deserialize(&mut json).map_err(|error| PolicyError::Manifest(error.to_string()))?;
        json.end().map_err(|error| PolicyError::Manifest(error.to_string()))?;
        if manifest.version != Manifest::VERSION {
            let (found, expected) = (manifest.version, Manifest::VERSION);
            return Err(PolicyError::Manifest(format!("version is {found}, expected {expected}")));
        }
        let observation = Manifest::observation(&manifest.architecture);
        if manifest.observation != observation {
            let found = manifest.observation;
            return Err(PolicyError::Manifest(format!("observation is {found:?}, expected {observation:?}")));
        }
        for (name, value_m, [least_m, most_m]) in
            [("step_m", manifest.step_m, [0.001, 0.1]), ("clearance_m", manifest.clearance_m, [0.0, 0.1])]
        {
            if !(least_m..=most_m).contains(&value_m) {
                let reason = format!("{name} is {value_m}, it must be {least_m} to {most_m}");
                return Err(PolicyError::Manifest(reason));
            }
        }
        let specs = manifest.architecture.tensors();
        if let Some(name) = file.names().into_iter().find(|name| specs.iter().all(|spec| spec.name != **name)) {
            return Err(PolicyError::Stray { name: name.to_owned() });
        }
        let weights = specs.iter().map(|spec| Ok((spec.name.clone(), read(&file, spec)?)));
        let weights = weights.collect::<Result<HashMap<_, _>, PolicyError>>()?;
        let network = Network::new(manifest.architecture, &builder(weights))?;
        Ok(Self { manifest, network: Arc::new(network), hash: xxhash_rust::xxh3::xxh3_64(bytes) })
    }

    /// The bytes of a policy's file. Only the means of noisy layers are written, which is sufficient for acting.
    ///
    /// # Errors
    /// [`PolicyError::Format`].
    pub fn to_bytes(manifest: &Manifest, weights: &[(TensorSpec, Vec<f32>)]) -> Result<Vec<u8>, PolicyError> {
        let architecture = Architecture { noisy: false, ..manifest.architecture };
        let kept: Vec<TensorSpec> = architecture.tensors();
        let manifest = Manifest { architecture, ..manifest.clone() };
        let text = serde_json::to_string(&manifest).map_err(|error| PolicyError::Manifest(error.to_string()))?;
        let bytes_of = |values: &Vec<f32>| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        let wanted = weights.iter().filter(|(spec, _)| kept.iter().any(|known| known.name == spec.name));
        let data: Vec<(&TensorSpec, Vec<u8>)> = wanted.map(|(spec, values)| (spec, bytes_of(values))).collect();
        let views = data
            .iter()
            .map(|(spec, bytes)| Ok((&spec.name, TensorView::new(Dtype::F32, spec.shape.clone(), bytes)?)))
            .collect::<Result<Vec<_>, safetensors::SafeTensorError>>()?;
        Ok(safetensors::serialize(views, Some(HashMap::from([(KEY.to_owned(), text)])))?)
    }
}

/// What a file of another format is, by its first bytes.
fn foreign(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        // `ModelProto`: the version, then one of its other fields.
        [0x08, _, 0x12 | 0x1a | 0x22 | 0x28 | 0x32 | 0x3a | 0x42, ..] => Some("an ONNX model"),
        [b'P', b'K', 3, 4, ..] => Some("a zip archive, as PyTorch and NumPy write them"),
        [0x80, 2..=5, ..] => Some("a Python pickle, as PyTorch and scikit-learn write them"),
        [0x89, b'H', b'D', b'F', ..] => Some("an HDF5 file, as Keras writes them"),
        _ => None,
    }
}

/// A name that is in the header twice: the library would take the last one. Other faults of the header are its.
fn twice(bytes: &[u8], header: usize) -> Option<String> {
    struct Names;
    impl<'de> serde::de::Visitor<'de> for Names {
        type Value = Option<String>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str("a header")
        }

        fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let (mut known, mut twice) = (HashSet::new(), None);
            while let Some((name, _)) = map.next_entry::<String, serde::de::IgnoredAny>()? {
                if !known.insert(name.clone()) {
                    twice = Some(name);
                }
            }
            Ok(twice)
        }
    }
    let text = bytes.get(8..header.checked_add(8)?)?;
    serde::Deserializer::deserialize_map(&mut serde_json::Deserializer::from_slice(text), Names).ok().flatten()
}

/// One weight of the file, checked.
fn read(file: &SafeTensors<'_>, spec: &TensorSpec) -> Result<Tensor, PolicyError> {
    let name = spec.name.clone();
    let Ok(view) = file.tensor(&name) else { return Err(PolicyError::Missing { name }) };
    if view.shape() != spec.shape || view.dtype() != Dtype::F32 {
        let found = format!("{:?} of {:?}", view.shape(), view.dtype());
        return Err(PolicyError::Shape { name, found, needed: spec.shape.clone() });
    }
    let values: Vec<f32> = view.data().chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    if let Some(&value) = values.iter().find(|value| value.is_nan() || value.abs() > WEIGHT_MOST) {
        return Err(PolicyError::Weight { name, value });
    }
    Ok(Tensor::from_vec(values, spec.shape.clone(), &Device::Cpu)?)
}

/// The weights in a policy's file, by the names of its tensors.
///
/// # Errors
/// [`PolicyError`], as [`Policy::from_bytes`].
pub fn weights(bytes: &[u8]) -> Result<HashMap<String, Vec<f32>>, PolicyError> {
    Policy::from_bytes(bytes)?;
    let file = safetensors::SafeTensors::deserialize(bytes)?;
    let floats = |bytes: &[u8]| bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    Ok(file.tensors().into_iter().map(|(name, view)| (name, floats(view.data()))).collect())
}

#[cfg(test)]
mod tests;
