//! A training run: lanes act, the replay fills, the learner updates. It can be saved at each point of the curve and
//! resumed with bit-identical results.

use std::path::Path;

use candle_core::Result as NetworkResult;
use rand::RngExt;
use serde::{Deserialize, Serialize};

use super::episode::Episode;
use super::examination::{examine, examined_mazes};
use super::lattice::MazeLattice;
use super::learner::{SurveyLearner, taught};
use super::recipe::SurveyRecipe;
use super::replay::{Entry, Step, SurveyReplay};
use crate::learn::checkpoint::{self, CheckpointError};
use crate::learn::environment::Ending;
use crate::learn::error::TrainingError;
use crate::learn::networks::{Memory, Weights, network};
use crate::learn::point::{Point, WINDOW};
use crate::learn::run::Run;
use crate::learn::sweep::STEP_M;
use ferry_core::policy::{Action, Manifest, Network, Policy};

/// Updates between two small examinations, on mazes of the trained families.
const EXAMINED_EVERY: u64 = 1000;
/// Version of the checkpoint's layout.
const VERSION: u32 = 101;

/// The complete state of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurveyRun {
    pub recipe: SurveyRecipe,
    pub seed: u64,
    pub memory: Memory,
    replay: SurveyReplay,
    lanes: Vec<Episode>,
    /// Total rewards of the lanes' episodes so far.
    totals: Vec<f32>,
    /// Steps of the environment.
    pub steps: u64,
    /// Finished episodes.
    pub episodes: u64,
    /// The curve so far.
    pub curve: Vec<Point>,
    point: Point,
}

impl SurveyRun {
    /// A run before its first step.
    ///
    /// # Errors
    /// [`TrainingError::Recipe`].
    pub fn new(recipe: SurveyRecipe, seed: u64, mazes: &[MazeLattice]) -> Result<Self, TrainingError> {
        recipe.check()?;
        let mut memory = Memory::new(&recipe.architecture, seed);
        let lanes = (0..recipe.lanes).map(|_| Episode::start(mazes, None, &recipe, &mut memory.rng)).collect();
        Ok(Self {
            seed,
            memory,
            replay: SurveyReplay::new(recipe.lanes, recipe.capacity),
            lanes,
            totals: vec![0.0; recipe.lanes],
            steps: 0,
            episodes: 0,
            curve: Vec::new(),
            point: Point::default(),
            recipe,
        })
    }

    /// One step of all lanes.
    fn act(&mut self, mazes: &[MazeLattice], learner: &mut SurveyLearner<'_>) -> NetworkResult<()> {
        let surveys: Vec<_> = self.lanes.iter().map(|lane| &lane.survey).collect();
        let actions = learner.act(&surveys)?;
        let recipe = &self.recipe;
        for (index, (lane, action)) in self.lanes.iter_mut().zip(actions).enumerate() {
            let rng = &mut learner.memory.rng;
            let explores = rng.random::<f64>() < recipe.exploration;
            let action = if explores { Action::ALL[rng.random_range(0..4)] } else { action };
            let maze = &mazes[lane.maze];
            let taught = taught(lane, |action| lane.reaches(maze, action), recipe);
            let survey = lane.survey.clone();
            let outcome = lane.step(maze, action, recipe);
            self.totals[index] += outcome.reward;
            let terminal = matches!(outcome.ending, Some(Ending::Reached | Ending::Collided));
            let step = Step { action: action as u8, reward: outcome.reward, terminal, taught };
            self.replay.push(index, Entry { survey, step: Some(step) });
            let Some(ending) = outcome.ending else { continue };
            if ending == Ending::TimedOut {
                self.replay.push(index, Entry { survey: lane.survey.clone(), step: None });
            }
            self.point.reward.add(f64::from(std::mem::take(&mut self.totals[index])));
            self.point.reached += u32::from(ending == Ending::Reached);
            self.point.collided += u32::from(ending == Ending::Collided);
            self.episodes += 1;
            *lane = Episode::start(mazes, Some(lane), recipe, rng);
        }
        self.steps += self.lanes.len() as u64;
        Ok(())
    }

    fn end_point(&mut self, mazes: &[MazeLattice]) -> NetworkResult<()> {
        let update = self.memory.updates;
        let examined = match update.is_multiple_of(EXAMINED_EVERY) {
            true => {
                Some(examine(&self.network()?, &self.recipe, examined_mazes(mazes), 2, self.seed)?.into_iter().sum())
            }
            false => None,
        };
        let (steps, episodes) = (self.steps, self.episodes);
        self.curve.push(Point { update, steps, episodes, examined, ..std::mem::take(&mut self.point) });
        Ok(())
    }

    /// The weights that are shipped.
    fn weights(&self) -> &Weights {
        if self.recipe.averaging > 0.0 { &self.memory.average } else { &self.memory.online }
    }

    /// The network that is shipped.
    ///
    /// # Errors
    /// Those of candle, which cannot occur with these weights.
    pub fn network(&self) -> NetworkResult<Network> {
        network(self.recipe.architecture, self.weights())
    }

    /// The bytes of the current policy. `maps` says what it was trained on, `revision` is the git revision of the
    /// training program.
    ///
    /// # Errors
    /// [`TrainingError::Policy`].
    pub fn policy(&self, maps: Vec<String>, revision: &str) -> Result<Vec<u8>, TrainingError> {
        let architecture = self.recipe.architecture;
        let manifest = Manifest {
            version: Manifest::VERSION,
            maps,
            step_m: STEP_M,
            observation: Manifest::observation(&architecture),
            architecture,
            clearance_m: self.recipe.clearance_m,
            seed: self.seed,
            revision: revision.to_owned(),
            updates: self.memory.updates,
        };
        let weights = architecture.tensors().into_iter().zip(self.weights().iter().cloned());
        Ok(Policy::to_bytes(&manifest, &weights.collect::<Vec<_>>())?)
    }

    /// Reads a run of the same recipe and seed, and the seconds that it took.
    ///
    /// # Errors
    /// [`TrainingError::Checkpoint`].
    pub fn read(path: &Path, recipe: &SurveyRecipe, seed: u64) -> Result<(Self, f64), TrainingError> {
        let (run, spent_s): (Self, f64) = checkpoint::read(path, VERSION)?;
        let refuse = |reason: &str| Err(CheckpointError::refused(path, reason).into());
        match checkpoint::differences(&run.recipe, recipe) {
            Some(differences) => refuse(&differences),
            None if run.seed != seed => refuse(&format!("its seed is {}, not {seed}", run.seed)),
            None => Ok((run, spent_s)),
        }
    }
}

impl Run for SurveyRun {
    type World = MazeLattice;

    fn advance(
        &mut self,
        mazes: &[MazeLattice],
        goes_on: &dyn Fn() -> bool,
        watch: &mut dyn FnMut(&Self) -> bool,
    ) -> Result<(), TrainingError> {
        let recipe = self.recipe.clone();
        let mut learner = SurveyLearner::new(&recipe, self.memory.clone())?;
        while learner.memory.updates < recipe.updates {
            if !goes_on() {
                self.memory = learner.memory.clone();
                return Ok(());
            }
            self.act(mazes, &mut learner)?;
            if self.replay.len() < recipe.warm_up {
                continue;
            }
            let (loss, gradient) = learner.update(&self.replay)?;
            let update = learner.memory.updates;
            if !(loss.is_finite() && gradient.is_finite()) {
                return Err(TrainingError::Diverged { update, loss, gradient });
            }
            self.point.loss.add(loss);
            self.point.gradient.add(gradient);
            if update.is_multiple_of(WINDOW) || update == recipe.updates {
                self.memory = learner.memory.clone();
                self.end_point(mazes)?;
                if !watch(self) {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.memory.updates >= self.recipe.updates
    }

    fn points(&self) -> &[Point] {
        &self.curve
    }

    fn write(&self, path: &Path, spent_s: f64) -> Result<(), TrainingError> {
        Ok(checkpoint::write(path, VERSION, spent_s, self)?)
    }
}
