//! One training as a job: its stage and progress, for all to read, and its work.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::folder::{self, Record};
use super::frame::{Cells, Frame};
use super::query::{QueryError, TrainingQuery};
use super::stage::TrainingStage;
use super::work_of;
use crate::changes::Changes;
use crate::jobs::{Job, Lane, Ticket, Workshop};
use crate::learn::curve::Curve;
use crate::learn::error::TrainingError;
use crate::learn::examine::{EXAMINATION_SEED, Marks};
use crate::learn::goals::GoalSet;
use crate::learn::library::{Library, LibraryError};
use crate::learn::point::Point;
use crate::learn::revision;
use crate::learn::run::{Run, Saving, drive};
use crate::learn::sweep::{STEP_M, Sweep, SweepError};
use crate::learn::terrain::Terrain;
use crate::learn::training::State;
use ferry_core::map::{Map, READER};
use ferry_core::policy::Policy;
use ferry_core::trial::Arena;

/// Interval at which a run is saved.
const SAVED_EVERY: Duration = Duration::from_secs(15);
/// Episodes of the last examination.
const EXAMINED_EPISODES: u32 = 1000;
/// Largest number of points of the curve that a policy keeps.
const ORIGIN_POINTS: usize = 50;

/// What a running training shall do after its next update. A later wish is stronger: a weaker one does not revoke it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Wish {
    GoOn,
    Pause,
    /// The server stops; the next one goes on.
    Suspend,
    Cancel,
}

/// How a policy was trained.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    pub query: TrainingQuery,
    /// The last examination.
    pub examined: Marks,
    pub elapsed_s: f64,
    /// A part of the curve.
    pub curve: Vec<Point>,
}

/// The progress of a training.
#[derive(Clone, Debug)]
pub struct Status {
    pub stage: TrainingStage,
    pub elapsed_s: f64,
    /// Estimated time until the end of learning.
    pub left_s: Option<f64>,
    pub points: Vec<Point>,
    pub cells: Option<Arc<Cells>>,
    pub frames: Vec<Arc<Frame>>,
    /// The last examination.
    pub examined: Option<Marks>,
    /// The policy, as `rl_policy`.
    pub policy: Option<String>,
    /// When it ended, since the server began.
    pub ended: Option<Instant>,
    wish: Wish,
}

/// A training. Its job updates it; all others only read.
#[derive(Debug)]
pub struct Training {
    pub id: String,
    pub query: TrainingQuery,
    /// Updates at its end.
    pub updates_total: u64,
    pub ticket: Ticket,
    map: Map,
    pub(super) folder: PathBuf,
    /// Folder of the maps' images.
    sweeps: PathBuf,
    policies: Arc<Library>,
    status: Mutex<Status>,
    /// Those of the list.
    changes: Changes,
}

impl Training {
    pub(super) fn new(
        id: String,
        (record, map): (Record, Map),
        ticket: Ticket,
        folders: [PathBuf; 2],
        policies: Arc<Library>,
        (cells, frames): (Option<Cells>, Vec<Frame>),
        changes: Changes,
    ) -> Arc<Self> {
        let Record { query, owner: _, updates_total, stage, elapsed_s, points, examined, policy, reader: _ } = record;
        let status = Status {
            stage,
            elapsed_s,
            left_s: None,
            points,
            cells: cells.map(Arc::new),
            frames: frames.into_iter().map(Arc::new).collect(),
            examined,
            policy,
            ended: None,
            wish: Wish::GoOn,
        };
        let [folder, sweeps] = folders;
        let status = Mutex::new(status);
        Arc::new(Self { id, query, updates_total, ticket, map, folder, sweeps, policies, status, changes })
    }

    pub fn status(&self) -> Status {
        self.lock().clone()
    }

    pub fn points(&self) -> Vec<Point> {
        self.lock().points.clone()
    }

    /// Whether it keeps its policy's name for itself.
    pub(super) fn holds(&self, name: &str) -> bool {
        self.query.name == name && !self.lock().stage.is_final()
    }

    /// Pauses it, after its next update if it is running. Returns false if it cannot.
    pub fn pause(&self) -> bool {
        let mut status = self.lock();
        match status.stage {
            TrainingStage::Waiting => {
                // With the lock held, so that it does not begin meanwhile.
                status.stage = TrainingStage::Paused;
                drop(status);
                self.enter(TrainingStage::Paused);
                true
            }
            TrainingStage::Images | TrainingStage::Learning => {
                status.wish = status.wish.max(Wish::Pause);
                status.wish != Wish::Cancel
            }
            _ => false,
        }
    }

    /// Makes it wait again. Returns false if it was neither paused nor failed.
    pub(super) fn resume(&self) -> bool {
        let resumes = matches!(self.lock().stage, TrainingStage::Paused | TrainingStage::Failed(_));
        if resumes {
            self.enter(TrainingStage::Waiting);
        }
        resumes
    }

    /// Ends it, after its next update if it is running, and deletes what it has kept. Returns false if it had ended.
    pub fn cancel(&self) -> bool {
        let mut status = self.lock();
        if status.stage.is_final() {
            return false;
        }
        if status.stage.is_running() {
            status.wish = Wish::Cancel;
        } else {
            status.stage = TrainingStage::Cancelled;
            drop(status);
            self.end_cancelled();
        }
        true
    }

    fn end_cancelled(&self) {
        // Before others learn that it has ended: then nothing is left.
        folder::remove(&self.folder);
        self.change(|status| status.stage = TrainingStage::Cancelled);
    }

    /// Changes the status and saves it.
    pub(super) fn enter(&self, stage: TrainingStage) {
        tracing::info!(id = self.id, ?stage, "training");
        self.change(|status| status.stage = stage);
        if let Err(error) = self.record().write(&self.folder) {
            tracing::warn!(%error, id = self.id, "the training's stage could not be saved");
        }
    }

    fn record(&self) -> Record {
        let status = self.lock();
        Record {
            query: self.query.clone(),
            owner: self.ticket.owner.clone(),
            updates_total: self.updates_total,
            stage: status.stage.clone(),
            elapsed_s: status.elapsed_s,
            points: status.points.clone(),
            examined: status.examined,
            policy: status.policy.clone(),
            reader: READER,
        }
    }

    fn change(&self, change: impl FnOnce(&mut Status)) {
        let mut status = self.lock();
        change(&mut status);
        if !status.stage.is_final() {
            status.ended = None;
        } else if status.wish != Wish::Suspend {
            status.ended.get_or_insert_with(Instant::now);
        }
        drop(status);
        self.changes.note();
    }

    fn lock(&self) -> MutexGuard<'_, Status> {
        self.status.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Learns until it ends or is interrupted. The stage that follows.
    fn learn(&self, workshop: &Workshop) -> Result<TrainingStage, QueryError> {
        let start = folder::start_bytes(&self.folder)?;
        let manifest = start.as_deref().map(Policy::from_bytes).transpose()?;
        let recipe = self.query.recipe(manifest.as_ref().map(Policy::manifest))?;
        let arena = Arena::of(self.map.clone());
        let goes_on = || if self.goes_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
        let sweep = match Sweep::open(&arena, &workshop.gpu, &self.sweeps, STEP_M, &[], &goes_on) {
            Err(SweepError::Stopped) => return Ok(self.interrupted()),
            sweep => sweep.map_err(TrainingError::from)?,
        };
        let terrains = [Terrain::new(arena.map.name(), arena.map.workspace(), &sweep, recipe.clearance_m)?];
        let checkpoint = folder::checkpoint(&self.folder);
        let (mut state, spent_s) = match checkpoint.exists() {
            true => State::read(&checkpoint, &recipe, self.query.seed, &terrains)?,
            false => (State::begin(recipe, self.query.seed, &terrains, start.as_deref())?, 0.0),
        };
        let cells = Arc::new(Cells::of(&terrains[0], self.query.goal_m));
        self.change(|status| {
            status.points.clone_from(&state.curve);
            status.frames.retain(|frame| frame.update <= state.memory.updates);
            status.cells = Some(cells.clone());
        });
        folder::write_history(&self.folder, &cells, &self.lock().frames).map_err(TrainingError::from)?;
        self.enter(TrainingStage::Learning);
        let before = state.memory.updates;
        let mut curve = Curve::resumed(spent_s);
        let mut failure = None;
        let saving = Saving { checkpoint: &checkpoint, period: SAVED_EVERY };
        drive(&mut state, &terrains, saving, &mut curve, &|| self.goes_on(), &mut |state, curve| match self.note(
            state,
            &terrains,
            &cells,
            curve,
            (before, spent_s),
        ) {
            Ok(()) => self.goes_on(),
            Err(error) => {
                failure = Some(error);
                false
            }
        })?;
        if let Some(error) = failure {
            return Err(error.into());
        }
        let updates = state.memory.updates - before;
        workshop.paces.measure(&work_of(self.query.recipe), updates as f64, curve.spent_s() - spent_s);
        if !state.is_done() {
            return Ok(self.interrupted());
        }
        self.enter(TrainingStage::Examination);
        let marks = state.examine(&terrains, GoalSet::All, EXAMINED_EPISODES, EXAMINATION_SEED)?;
        if self.lock().wish == Wish::Cancel {
            return Ok(TrainingStage::Cancelled);
        }
        let policy = self.publish(&state, marks, curve.spent_s())?;
        self.change(|status| {
            status.examined = Some(marks);
            status.policy = Some(policy);
            status.left_s = None;
        });
        Ok(TrainingStage::Done)
    }

    fn goes_on(&self) -> bool {
        self.lock().wish == Wish::GoOn
    }

    /// The stage after an interruption.
    fn interrupted(&self) -> TrainingStage {
        match self.lock().wish {
            Wish::Cancel => TrainingStage::Cancelled,
            Wish::Suspend => TrainingStage::Waiting,
            Wish::Pause | Wish::GoOn => TrainingStage::Paused,
        }
    }

    /// Adds a point with its frame. `begun` has the updates and seconds at which this part of the run began.
    fn note(
        &self,
        state: &State,
        terrains: &[Terrain],
        cells: &Cells,
        curve: &Curve,
        begun: (u64, f64),
    ) -> Result<(), TrainingError> {
        let frame = Arc::new(Frame::of(state, terrains, cells)?);
        let done = state.memory.updates - begun.0;
        let pace_s = (curve.spent_s() - begun.1) / done.max(1) as f64;
        self.change(|status| {
            status.points.clone_from(&state.curve);
            status.frames.push(frame.clone());
            status.elapsed_s = curve.spent_s();
            status.left_s = Some(pace_s * (self.updates_total - state.memory.updates) as f64);
        });
        Ok(folder::append_frame(&self.folder, &frame)?)
    }

    /// Adds the policy under its name, or under one with a number if that was taken meanwhile.
    fn publish(&self, state: &State, examined: Marks, elapsed_s: f64) -> Result<String, QueryError> {
        let bytes = state.policy(&revision())?;
        let every = state.curve.len().div_ceil(ORIGIN_POINTS).max(1);
        let curve = state.curve.iter().rev().step_by(every).rev().copied().collect();
        let origin = Origin { query: self.query.clone(), examined, elapsed_s, curve };
        let origin = serde_json::to_string(&origin).map_err(std::io::Error::other).map_err(LibraryError::from)?;
        let name = &self.query.name;
        let numbered = (2..).map(|number| format!("{}-{number}", &name[..name.len().min(36)]));
        for name in std::iter::once(name.clone()).chain(numbered) {
            match self.policies.add(&name, &bytes, Some(origin.clone())) {
                Err(LibraryError::Taken { .. }) => {}
                added => return Ok(added?.reference().to_string()),
            }
        }
        unreachable!("there are more names than policies")
    }
}

impl Job for Training {
    fn id(&self) -> &str {
        &self.id
    }

    fn lane(&self) -> Lane {
        self.ticket.lane
    }

    fn is_waiting(&self) -> bool {
        self.lock().stage == TrainingStage::Waiting
    }

    fn begin(&self) -> bool {
        let mut status = self.lock();
        if status.stage != TrainingStage::Waiting {
            return false;
        }
        (status.stage, status.wish) = (TrainingStage::Images, Wish::GoOn);
        drop(status);
        self.enter(TrainingStage::Images);
        true
    }

    fn run(&self, workshop: &Workshop) {
        match workshop.pool.install(|| self.learn(workshop)) {
            Ok(TrainingStage::Cancelled) => self.end_cancelled(),
            Ok(stage) => {
                if stage == TrainingStage::Done {
                    folder::forget_checkpoint(&self.folder);
                }
                self.enter(stage);
            }
            Err(error) => self.fail(error.to_string()),
        }
    }

    fn fail(&self, reason: String) {
        self.enter(TrainingStage::Failed(reason));
    }

    fn interrupt(&self) {
        let mut status = self.lock();
        status.wish = status.wish.max(Wish::Suspend);
    }
}
