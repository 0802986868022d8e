//! Writes a data set as Minari (<https://minari.farama.org>) does in its Arrow format: for each episode, a folder with an
//! Arrow IPC file and its metadata. `minari/dataset/_storages/arrow_storage.py` of Minari 0.5.4 is the reference.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::{
    ArrayRef, BooleanArray, FixedSizeListArray, Float32Array, Float64Array, Int64Array, RecordBatch, StructArray,
    UInt8Array,
};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, Field};
use serde_json::{Value, json};

use super::episode::{Episode, View};
use ferry_core::control::CONTROL_PERIOD_S;
use ferry_core::perception::OBSERVATION_SIZE_PX;
use ferry_core::scenario::Scenario;

/// Name of the data set: namespace, name and version.
pub const DATA_SET: &str = "ferry/attempts-v0";
/// The Minari whose format this is.
const MINARI_VERSION: &str = "0.5.4";
/// Largest absolute coordinate and distance. The workspaces of challenges are smaller.
const MOST_M: f64 = 1.0;
/// Shape of an observation. With the channels first, Minari does not take it for a picture, which it would store as JPEG.
const SHAPE: [usize; 3] = [2, OBSERVATION_SIZE_PX, OBSERVATION_SIZE_PX];

/// Why a data set could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    #[error(transparent)]
    Io(#[from] std::io::Error),
    #[error(transparent)]
    Arrow(#[from] ArrowError),
}

/// A data set that is being written.
pub struct DataSet {
    folder: PathBuf,
    episodes: u64,
    steps: u64,
    bytes: u64,
}

impl DataSet {
    /// Begins a data set in a new folder of data sets.
    ///
    /// # Errors
    /// [`WriteError`]: the folder exists, for example.
    pub fn create(root: &Path) -> Result<Self, WriteError> {
        if let Some(parent) = root.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::create_dir(root)?;
        let folder = root.join(DATA_SET).join("data");
        std::fs::create_dir_all(&folder)?;
        // Minari lists only namespaces with this file.
        std::fs::write(root.join("ferry/namespace_metadata.json"), "{}")?;
        Ok(Self { folder, episodes: 0, steps: 0, bytes: 0 })
    }

    pub fn episodes(&self) -> u64 {
        self.episodes
    }

    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Adds an episode.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn add(&mut self, episode: &Episode) -> Result<(), WriteError> {
        let folder = self.folder.join(self.episodes.to_string());
        std::fs::create_dir(&folder)?;
        let rows = rows(episode)?;
        let file = folder.join("part-0.arrow");
        let mut writer = FileWriter::try_new(BufWriter::new(File::create(&file)?), &rows.schema())?;
        writer.write(&rows)?;
        writer.finish()?;
        drop(writer);
        self.bytes += file.metadata()?.len();
        self.write(&folder, &about(episode, self.episodes))?;
        self.episodes += 1;
        self.steps += episode.steps.len() as u64;
        Ok(())
    }

    /// Writes what Minari reads first; until then it does not find a data set.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn finish(&mut self) -> Result<(), WriteError> {
        let megabytes = (self.bytes as f64 / 1e5).round() / 10.0;
        let about = json!({
            "dataset_id": DATA_SET,
            "minari_version": MINARI_VERSION,
            "data_format": "arrow",
            "jpeg_encoding": false,
            "total_episodes": self.episodes,
            "total_steps": self.steps,
            "dataset_size": megabytes,
            // Minari keeps the spaces as text.
            "observation_space": observation_space().to_string(),
            "action_space": place_space().to_string(),
            "algorithm_name": "human",
            "author": ["Ferry"],
            "author_email": [],
            "description": "People steer a magnet that carries a bead to a goal: attempts at Ferry's challenges.",
            "control_period_s": CONTROL_PERIOD_S,
            "ferry_version": env!("CARGO_PKG_VERSION"),
        });
        self.write(&self.folder.clone(), &about)
    }

    fn write(&mut self, folder: &Path, about: &Value) -> Result<(), WriteError> {
        let text = about.to_string();
        std::fs::write(folder.join("metadata.json"), &text)?;
        self.bytes += text.len() as u64;
        Ok(())
    }
}

/// What an episode is about.
fn about(episode: &Episode, index: u64) -> Value {
    let Episode { challenge, kept, steps, .. } = episode;
    let Scenario { seed, map, .. } = &challenge.scenario;
    let (score, signature) = (kept.attempt.score, &kept.signature);
    json!({
        "id": index,
        "total_steps": steps.len(),
        "seed": seed,
        "challenge": challenge.name.to_string(),
        "difficulty": challenge.name.difficulty.as_str(),
        "map": map,
        "path_m": challenge.path_m,
        "player": signature.player,
        "class": signature.class,
        "at": signature.at,
        "score_s": score.total_s(),
        "delivery_tick": score.tick,
        "walls": score.walls,
        "lost_beads": score.lost_beads,
        "world_hash": kept.attempt.world_hash,
    })
}

/// A row per step, and one for the delivery. It has an observation only; its other columns are padding.
fn rows(episode: &Episode) -> Result<RecordBatch, ArrowError> {
    let Episode { steps, last, .. } = episode;
    let views: Vec<&View> = steps.iter().map(|step| &step.view).chain([last]).collect();
    let (count, delivery) = (views.len(), steps.len().wrapping_sub(1));
    let places = |place: &dyn Fn(&View) -> [f64; 2]| pairs(views.iter().flat_map(|view| place(view)).collect());
    let observations: Vec<u8> = views.iter().flat_map(|view| &view.observation).copied().collect();
    let beads = views.iter().flat_map(|view| [view.bead_m.x, view.bead_m.y]);
    let steered = steps.iter().map(|step| Some(step.steers)).chain([Some(false)]);
    let sub_controllers = steps.iter().map(|step| i64::from(step.sub_controller));
    // The same sub-controller is active at the end of the last step.
    let at_the_end = steps.last().map(|step| i64::from(step.sub_controller));
    let hands = steps.iter().flat_map(|step| [step.hand_m.x, step.hand_m.y]).chain([0.0; 2]);
    // Minari keeps the shape of an array in `infos` so.
    let two = [("shape".to_owned(), "2".to_owned())].into();
    RecordBatch::try_from_iter_with_nullable([
        (
            "observations",
            columns([
                field("goal_m", places(&|view| view.goal_m.into())?),
                field("observation", list(SHAPE.iter().product(), Arc::new(UInt8Array::from(observations)))?),
                field("tool_m", places(&|view| view.tool_m.into())?),
            ]),
            true,
        ),
        ("actions", pairs(hands.collect())?, true),
        (
            "rewards",
            Arc::new(Float64Array::from_iter_values((0..count).map(|row| f64::from(u8::from(row == delivery))))),
            true,
        ),
        ("terminations", Arc::new(BooleanArray::from_iter((0..count).map(|row| Some(row == delivery)))), true),
        ("truncations", Arc::new(BooleanArray::from(vec![false; count])), true),
        (
            "infos",
            columns([
                field("tick", Arc::new(Int64Array::from_iter_values(views.iter().map(|view| view.tick as i64)))),
                field("sub_controller", Arc::new(Int64Array::from_iter_values(sub_controllers.chain(at_the_end)))),
                field("steers", Arc::new(BooleanArray::from_iter(steered))),
                with_metadata(field("bead_m", list(2, Arc::new(Float64Array::from_iter_values(beads)))?), two),
            ]),
            true,
        ),
    ])
}

type Column = (Arc<Field>, ArrayRef);

fn field(name: &str, column: ArrayRef) -> Column {
    (Arc::new(Field::new(name, column.data_type().clone(), true)), column)
}

fn with_metadata((field, column): Column, metadata: std::collections::HashMap<String, String>) -> Column {
    (Arc::new(Arc::unwrap_or_clone(field).with_metadata(metadata)), column)
}

fn columns<const N: usize>(columns: [Column; N]) -> ArrayRef {
    Arc::new(StructArray::from(columns.to_vec()))
}

/// Pairs of x and y, single precision.
fn pairs(values_m: Vec<f64>) -> Result<ArrayRef, ArrowError> {
    list(2, Arc::new(Float32Array::from_iter_values(values_m.into_iter().map(|value_m| value_m as f32))))
}

/// Rows of `size` values each.
fn list(size: usize, values: ArrayRef) -> Result<ArrayRef, ArrowError> {
    let item = Arc::new(Field::new("item", values.data_type().clone(), true));
    Ok(Arc::new(FixedSizeListArray::try_new(item, size as i32, values, None)?))
}

/// As `minari/serialization.py` describes spaces.
fn observation_space() -> Value {
    let [channels, height, width] = SHAPE;
    let filled = |level: u8| vec![vec![vec![level; width]; height]; channels];
    json!({"type": "Dict", "subspaces": {
        "goal_m": place_space(),
        "observation": {"type": "Box", "dtype": "uint8", "shape": SHAPE, "low": filled(0), "high": filled(255)},
        "tool_m": place_space(),
    }})
}

/// Of a place, and of a distance in x and y.
fn place_space() -> Value {
    let (low, high) = ([-MOST_M; 2], [MOST_M; 2]);
    json!({"type": "Box", "dtype": "float32", "shape": [2], "low": low, "high": high})
}

#[cfg(test)]
mod tests;
