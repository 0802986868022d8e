//! A training run: lanes act, the replay fills, the learner updates. It can be saved at any step and resumed with
//! bit-identical results.

use std::path::Path;

use rand::RngExt;
use serde::{Deserialize, Serialize};

use super::checkpoint::{self, CheckpointError};
use super::environment::{Ending, Episode};
use super::error::TrainingError;
use super::examine::{Marks, examine};
use super::goals::GoalSet;
use super::learner::Learner;
use super::networks::{Memory, Weights, network};
use super::point::{Point, WINDOW};
use super::recipe::Recipe;
use super::replay::{Replay, Transition};
use super::run::Run;
use super::sweep::STEP_M;
use super::terrain::Terrain;
use ferry_core::policy::{Manifest, Policy};

/// Updates between two small examinations.
const EXAMINED_EVERY: u64 = 1000;
/// Episodes of a small examination.
const EXAMINED_EPISODES: u32 = 200;
/// Version of the checkpoint's layout.
const VERSION: u32 = 5;

/// The complete state of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    pub recipe: Recipe,
    pub seed: u64,
    /// Names of the maps and their numbers of cells; with walls that move, one for each moment.
    pub maps: Vec<(String, u32)>,
    pub memory: Memory,
    pub replay: Replay,
    /// The episodes in parallel.
    pub lanes: Vec<Episode>,
    /// Steps of the environment.
    pub steps: u64,
    /// Finished episodes.
    pub episodes: u64,
    /// The curve so far.
    pub curve: Vec<Point>,
    pub point: Point,
}

impl State {
    /// A run before its first step.
    ///
    /// # Errors
    /// [`TrainingError::Recipe`].
    pub fn new(recipe: Recipe, seed: u64, terrains: &[Terrain]) -> Result<Self, TrainingError> {
        recipe.check()?;
        let goals = recipe.trained_goals();
        let held_out = recipe.held_out_goals;
        for terrain in terrains {
            let lacks = |goals: GoalSet| !goals.has_episode(terrain);
            if lacks(goals) || (held_out > 0.0 && lacks(GoalSet::HeldOut { held_out })) {
                return Err(TrainingError::NoGoals { map: terrain.name().to_owned(), held_out });
            }
        }
        let mut memory = Memory::new(&recipe.architecture, seed);
        let lanes = (0..recipe.lanes).map(|_| Episode::start(terrains, goals, &mut memory.rng)).collect();
        Ok(Self {
            seed,
            maps: maps(terrains),
            memory,
            replay: Replay::new(recipe.capacity, recipe.lanes, recipe.priority_exponent),
            lanes,
            steps: 0,
            episodes: 0,
            curve: Vec::new(),
            point: Point::default(),
            recipe,
        })
    }

    /// A run before its first step, with the weights in a policy's file or with random ones.
    ///
    /// # Errors
    /// [`TrainingError::Recipe`], [`TrainingError::Policy`].
    pub fn begin(
        recipe: Recipe,
        seed: u64,
        terrains: &[Terrain],
        policy: Option<&[u8]>,
    ) -> Result<Self, TrainingError> {
        let mut state = Self::new(recipe, seed, terrains)?;
        if let Some(bytes) = policy {
            state.memory.start_from(&state.recipe.architecture, bytes)?;
        }
        Ok(state)
    }

    /// The weights that are shipped.
    pub fn weights(&self) -> &Weights {
        if self.recipe.averaging > 0.0 { &self.memory.average } else { &self.memory.online }
    }

    /// One step of all lanes.
    fn act(&mut self, terrains: &[Terrain], learner: &mut Learner<'_>) -> Result<(), TrainingError> {
        let cells: Vec<(u8, u16)> = self.lanes.iter().map(|lane| (lane.terrain, lane.cell)).collect();
        let places: Vec<[f32; 4]> = self.lanes.iter().map(|lane| lane.places(terrains)).collect();
        let actions = learner.act(&cells, &places)?;
        for (lane, action) in self.lanes.iter_mut().zip(actions) {
            let rng = learner.rng();
            let explores = rng.random::<f64>() < self.recipe.exploration;
            let action = if explores { rng.random_range(0..4) } else { action as usize };
            let before = *lane;
            let (next, ending) = lane.step(terrains, action, &self.recipe);
            let Episode { terrain, cell, goal, .. } = before;
            self.replay.push(Transition { terrain, cell, action: action as u8, next, goal, ending });
            if let Some(ending) = ending {
                let failed = ending == Ending::TimedOut && self.recipe.timeout_fails;
                self.point.reward.add(f64::from(lane.total) - f64::from(u8::from(failed)));
                self.point.reached += u32::from(ending == Ending::Reached);
                self.point.collided += u32::from(ending == Ending::Collided);
                self.episodes += 1;
                *lane = Episode::start(terrains, self.recipe.trained_goals(), rng);
            }
        }
        self.steps += self.lanes.len() as u64;
        Ok(())
    }

    fn end_point(&mut self, terrains: &[Terrain]) -> Result<(), TrainingError> {
        let update = self.memory.updates;
        let examined = match update.is_multiple_of(EXAMINED_EVERY) {
            true => Some(self.examine(terrains, GoalSet::All, EXAMINED_EPISODES, self.seed)?),
            false => None,
        };
        let (steps, episodes) = (self.steps, self.episodes);
        self.curve.push(Point { update, steps, episodes, examined, ..std::mem::take(&mut self.point) });
        Ok(())
    }

    /// Examines the shipped weights on terrains.
    ///
    /// # Errors
    /// [`TrainingError::Network`].
    pub fn examine(
        &self,
        terrains: &[Terrain],
        goals: GoalSet,
        episodes: u32,
        seed: u64,
    ) -> Result<Marks, TrainingError> {
        let network = network(self.recipe.architecture, self.weights())?;
        Ok(examine(&network, &self.recipe, terrains, goals, episodes, seed)?)
    }

    /// The bytes of the current policy. `revision` is the git revision of the training program.
    ///
    /// # Errors
    /// [`TrainingError::Policy`].
    pub fn policy(&self, revision: &str) -> Result<Vec<u8>, TrainingError> {
        let mut maps: Vec<String> = self.maps.iter().map(|(name, _)| name.clone()).collect();
        maps.dedup();
        let manifest = Manifest {
            version: Manifest::VERSION,
            maps,
            step_m: STEP_M,
            observation: Manifest::observation(&self.recipe.architecture),
            architecture: self.recipe.architecture,
            clearance_m: self.recipe.clearance_m,
            seed: self.seed,
            revision: revision.to_owned(),
            updates: self.memory.updates,
        };
        let weights = self.recipe.architecture.tensors().into_iter().zip(self.weights().iter().cloned());
        Ok(Policy::to_bytes(&manifest, &weights.collect::<Vec<_>>())?)
    }

    /// Reads a run of the same recipe, seed and maps, and the seconds that it took.
    ///
    /// # Errors
    /// [`TrainingError::Checkpoint`].
    pub fn read(path: &Path, recipe: &Recipe, seed: u64, terrains: &[Terrain]) -> Result<(Self, f64), TrainingError> {
        let (state, spent_s): (Self, f64) = checkpoint::read(path, VERSION)?;
        let refuse = |reason: &str| Err(CheckpointError::refused(path, reason).into());
        match checkpoint::differences(&state.recipe, recipe) {
            Some(differences) => refuse(&differences),
            None if state.seed != seed => refuse(&format!("its seed is {}, not {seed}", state.seed)),
            None if state.maps != maps(terrains) => refuse(&format!("its maps are {:?}", state.maps)),
            None => Ok((state, spent_s)),
        }
    }
}

impl Run for State {
    type World = Terrain;

    fn advance(
        &mut self,
        terrains: &[Terrain],
        goes_on: &dyn Fn() -> bool,
        watch: &mut dyn FnMut(&Self) -> bool,
    ) -> Result<(), TrainingError> {
        let recipe = self.recipe.clone();
        let mut learner = Learner::new(&recipe, terrains, self.memory.clone())?;
        while learner.memory().updates < recipe.updates {
            if !goes_on() {
                self.memory = learner.memory().clone();
                return Ok(());
            }
            self.act(terrains, &mut learner)?;
            if self.replay.len() < recipe.warm_up {
                continue;
            }
            let mut ended = false;
            for _ in 0..recipe.updates_per_step {
                let report = learner.update(&mut self.replay)?;
                let update = learner.memory().updates;
                if !(report.loss.is_finite() && report.gradient.is_finite()) {
                    let (loss, gradient) = (report.loss, report.gradient);
                    return Err(TrainingError::Diverged { update, loss, gradient });
                }
                self.point.loss.add(report.loss);
                self.point.gradient.add(report.gradient);
                ended |= update.is_multiple_of(WINDOW) || update == recipe.updates;
            }
            if ended {
                self.memory = learner.memory().clone();
                self.end_point(terrains)?;
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

fn maps(terrains: &[Terrain]) -> Vec<(String, u32)> {
    terrains.iter().map(|terrain| (terrain.name().to_owned(), terrain.cells() as u32)).collect()
}

#[cfg(test)]
mod tests;
