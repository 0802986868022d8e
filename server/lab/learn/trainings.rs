//! Trainings as jobs in the background. They are kept in a folder: after a restart of the server they go on.

mod folder;
mod frame;
mod query;
mod ranks;
mod stage;
#[cfg(test)]
mod tests;
mod training;

use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::library::Library;
use super::recipe::RecipeName;
use super::sweep::{STEP_M, cells};
use crate::changes::Changes;
use crate::jobs::{Lane, Queue, QueueError, Ticket};
use ferry_core::map::{self, Map, READER};
use ferry_core::policy::Policy;
use ferry_core::trial::Arena;
use folder::Record;

pub use frame::{Cells, Frame, Trail};
pub use query::{QueryError, TrainingQuery};
pub use stage::TrainingStage;
pub use training::{Origin, Status, Training};

/// Number of ended trainings that are kept; each has a few megabytes.
const KEPT: usize = 16;
/// Name of a training, before its number.
const NUMBERED: &str = "training-";

/// First guess of the time of an update, on two cores.
const GUESS_S: f64 = 0.04;

/// The kind of work of a recipe's updates, for their pace.
fn work_of(recipe: RecipeName) -> String {
    let name = serde_json::to_value(recipe).ok();
    format!("training_{}", name.as_ref().and_then(|name| name.as_str()).unwrap_or_default())
}

/// Why a training is rejected.
#[derive(Debug, thiserror::Error)]
pub enum SubmitTrainingError {
    #[error(transparent)]
    Query(#[from] QueryError),
    #[error(transparent)]
    Queue(#[from] QueueError),
    /// It could not be stored; nothing has changed.
    #[error("the training could not be stored: {0}")]
    Io(#[from] std::io::Error),
}

/// The trainings of a server.
pub struct Trainings {
    folder: PathBuf,
    /// Folder of the maps' images.
    sweeps: PathBuf,
    queue: Arc<Queue>,
    maps: Arc<map::Library>,
    policies: Arc<Library>,
    kept: Mutex<Kept>,
    changes: Changes,
}

#[derive(Default)]
struct Kept {
    /// In the order of submission.
    trainings: Vec<Arc<Training>>,
    /// Largest number so far, for their names.
    last: u64,
}

impl Trainings {
    /// The trainings kept in a folder. Those that had not ended wait in the queue again.
    pub fn in_folder(
        folder: PathBuf,
        sweeps: PathBuf,
        queue: Arc<Queue>,
        maps: Arc<map::Library>,
        policies: Arc<Library>,
    ) -> Self {
        let mut numbers: Vec<u64> = std::fs::read_dir(&folder)
            .into_iter()
            .flatten()
            .filter_map(|entry| number(entry.ok()?.file_name().to_str()?))
            .collect();
        numbers.sort_unstable();
        let last = numbers.last().copied().unwrap_or(0);
        for (recipe, ..) in RecipeName::ALL {
            queue.paces.guess(&work_of(recipe), GUESS_S);
        }
        let changes = Changes::part_of(&queue.changes);
        let trainings = Self { folder, sweeps, queue, maps, policies, kept: Mutex::default(), changes };
        let restored: Vec<_> = numbers.into_iter().filter_map(|number| trainings.restore(number)).collect();
        for training in &restored {
            let stage = training.status().stage;
            if !stage.is_final() && stage != TrainingStage::Paused {
                training.enter(TrainingStage::Waiting);
                if trainings.queue.submit(training.clone()).is_err() {
                    training.enter(TrainingStage::Paused);
                }
            }
        }
        *trainings.lock() = Kept { trainings: restored, last };
        trainings
    }

    fn restore(&self, number: u64) -> Option<Arc<Training>> {
        let id = format!("{NUMBERED}{number}");
        let folder = self.folder.join(&id);
        let read = Record::read(&folder).map_err(|error| error.to_string()).and_then(|record| {
            let svg = folder::map(&folder).map_err(|error| error.to_string())?;
            let map = Map::from_svg(&record.query.map, &svg).and_then(|map| map.as_read_by(record.reader));
            let map = map.map_err(|error| error.to_string())?;
            Ok((record, map))
        });
        match read {
            Ok((record, map)) => Some(self.training(id, record, map, folder::read_history(&folder))),
            Err(error) => {
                tracing::warn!(error, folder = %folder.display(), "training left out");
                None
            }
        }
    }

    fn training(&self, id: String, record: Record, map: Map, history: (Option<Cells>, Vec<Frame>)) -> Arc<Training> {
        let folders = [self.folder.join(&id), self.sweeps.clone()];
        let estimate_s = record.updates_total as f64 * self.queue.paces.each_s(&work_of(record.query.recipe));
        let ticket = Ticket { owner: record.owner.clone(), lane: Lane::of(estimate_s), estimate_s };
        Training::new(id, (record, map), ticket, folders, self.policies.clone(), history, self.changes.clone())
    }

    /// Adds a training. `owner` is the session that starts it.
    ///
    /// # Errors
    /// [`SubmitTrainingError`]; then nothing has changed.
    pub fn submit(&self, owner: Option<String>, query: TrainingQuery) -> Result<Arc<Training>, SubmitTrainingError> {
        let map = self.maps.find(&query.map).map_err(QueryError::from)?;
        let (columns, rows) = cells(&Arena::of(map.clone()), STEP_M);
        query.check_map(&map, columns * rows)?;
        let start = query.start_from.as_ref().map(|name| self.start(name)).transpose()?;
        let manifest = start.as_deref().map(Policy::from_bytes).transpose().map_err(QueryError::from)?;
        let recipe = query.recipe(manifest.as_ref().map(Policy::manifest))?;
        self.policies.check(&query.name).map_err(QueryError::from)?;
        let mut kept = self.lock();
        if kept.trainings.iter().any(|training| training.holds(&query.name)) {
            return Err(QueryError::Taken { name: query.name }.into());
        }
        let record = Record {
            query,
            owner,
            updates_total: recipe.updates,
            stage: TrainingStage::Waiting,
            elapsed_s: 0.0,
            points: Vec::new(),
            examined: None,
            policy: None,
            reader: READER,
        };
        let number = kept.last + 1;
        let id = format!("{NUMBERED}{number}");
        let folder = self.folder.join(&id);
        folder::create(&folder, &record, map.svg(), start.as_deref())?;
        let training = self.training(id, record, map, (None, Vec::new()));
        if let Err(error) = self.queue.submit(training.clone()) {
            folder::remove(&folder);
            return Err(error.into());
        }
        kept.last = number;
        kept.trainings.push(training.clone());
        kept.prune();
        drop(kept);
        self.changes.note();
        Ok(training)
    }

    /// The file of the policy that a training starts from.
    fn start(&self, name: &str) -> Result<Vec<u8>, QueryError> {
        let unknown = || Policy::shipped(name).expect_err("a name that cannot be parsed is not that of a policy");
        let asked = name.parse().map_err(|_| unknown())?;
        Ok(self.policies.bytes(&asked)?)
    }

    pub fn find(&self, id: &str) -> Option<Arc<Training>> {
        self.lock().trainings.iter().find(|training| training.id == id).cloned()
    }

    /// All kept trainings, in the order of submission.
    pub fn all(&self) -> Vec<Arc<Training>> {
        self.lock().trainings.clone()
    }

    /// Lets a paused or failed training wait in the queue again. Returns false if it is neither.
    ///
    /// # Errors
    /// The queue is full; then it stays as it was.
    pub fn resume(&self, training: &Arc<Training>) -> Result<bool, QueueError> {
        let before = training.status().stage;
        if !training.resume() {
            return Ok(false);
        }
        if let Err(error) = self.queue.submit(training.clone()) {
            training.enter(before);
            return Err(error);
        }
        Ok(true)
    }

    /// Forgets a training that has ended; its policy stays.
    pub fn remove(&self, training: &Training) {
        folder::remove(&training.folder);
        self.lock().trainings.retain(|one| one.id != training.id);
        self.changes.note();
    }

    /// Those of the list.
    pub fn changes(&self) -> &Changes {
        &self.changes
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Kept {
    /// Removes the oldest ended trainings.
    fn prune(&mut self) {
        let ended = self.trainings.iter().filter(|training| training.status().stage.is_final()).count();
        for _ in KEPT..ended {
            if let Some(oldest) = self.trainings.iter().position(|training| training.status().stage.is_final()) {
                folder::remove(&self.trainings.remove(oldest).folder);
            }
        }
    }
}

fn number(id: &str) -> Option<u64> {
    // The next number must exist, too.
    id.strip_prefix(NUMBERED)?.parse::<u32>().ok().map(u64::from)
}
