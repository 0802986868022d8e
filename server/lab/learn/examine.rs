//! Examination: the success of a network that acts greedily on random starts and goals.

use candle_core::{Device, Result, Tensor};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::environment::{Ending, Episode};
use super::goals::GoalSet;
use super::learner::{best, features_of, features_of_all};
use super::recipe::Recipe;
use super::terrain::{Terrain, views};
use ferry_core::policy::{ACTING_FRACTIONS, Fusion, Network, acting_fractions};

/// Episodes that are stepped together.
const TOGETHER: usize = 250;
/// Seed of the last examination; no run trains with it.
pub const EXAMINATION_SEED: u64 = 0x00FE_77E5;
/// Random stream of examinations; training uses other streams of its seed.
const STREAM: u64 = 1 << 40;

/// Counts of episode endings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Marks {
    pub episodes: u32,
    /// Within 2 cm of the goal.
    pub reached: u32,
    /// Into a wall.
    pub collided: u32,
    /// Out of steps.
    pub timed_out: u32,
    /// Steps of the episodes that reached their goal.
    pub steps: u32,
    /// Length of the shortest paths of these episodes to the goal's cell. Episodes end within 2 cm, so `steps` can be
    /// smaller.
    pub least_steps: u32,
}

impl Marks {
    /// Share of episodes that reached the goal.
    pub fn success(&self) -> f64 {
        f64::from(self.reached) / f64::from(self.episodes.max(1))
    }
}

impl std::iter::Sum for Marks {
    fn sum<I: Iterator<Item = Self>>(marks: I) -> Self {
        marks.fold(Self::default(), |a, b| Self {
            episodes: a.episodes + b.episodes,
            reached: a.reached + b.reached,
            collided: a.collided + b.collided,
            timed_out: a.timed_out + b.timed_out,
            steps: a.steps + b.steps,
            least_steps: a.least_steps + b.least_steps,
        })
    }
}

/// Maps cells and places to actions.
pub type Act<'a> = dyn FnMut(&[(u8, u16)], &[[f32; 4]]) -> Result<Vec<u32>> + 'a;

/// Examines a function that chooses actions. Steps follow the terrains' tables.
pub fn examine_by(
    recipe: &Recipe,
    terrains: &[Terrain],
    goals: GoalSet,
    episodes: u32,
    seed: u64,
    act: &mut Act<'_>,
) -> Result<Marks> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(STREAM);
    let mut marks = Marks { episodes, ..Marks::default() };
    let mut left: Vec<Episode> = (0..episodes).map(|_| Episode::start(terrains, goals, &mut rng)).collect();
    while !left.is_empty() {
        let together = left.len().min(TOGETHER);
        let mut running: Vec<(Episode, Episode)> = left.drain(..together).map(|episode| (episode, episode)).collect();
        while !running.is_empty() {
            let cells: Vec<(u8, u16)> = running.iter().map(|(_, now)| (now.terrain, now.cell)).collect();
            let places: Vec<[f32; 4]> = running.iter().map(|(_, now)| now.places(terrains)).collect();
            let actions = act(&cells, &places)?;
            let mut still = Vec::with_capacity(running.len());
            for ((first, mut now), action) in running.into_iter().zip(actions) {
                match now.step(terrains, action as usize, recipe).1 {
                    None => still.push((first, now)),
                    Some(Ending::Collided) => marks.collided += 1,
                    Some(Ending::TimedOut) => marks.timed_out += 1,
                    Some(Ending::Reached) => {
                        let terrain = &terrains[usize::from(first.terrain)];
                        marks.reached += 1;
                        marks.steps += now.steps;
                        marks.least_steps += u32::from(terrain.distance(first.cell, first.goal.cell));
                    }
                }
            }
            running = still;
        }
    }
    Ok(marks)
}

/// Examines a network, greedy and without noise.
pub fn examine(
    network: &Network,
    recipe: &Recipe,
    terrains: &[Terrain],
    goals: GoalSet,
    episodes: u32,
    seed: u64,
) -> Result<Marks> {
    let cache: Vec<Tensor> = match network.architecture().fusion {
        Fusion::Late => {
            terrains.iter().map(|terrain| features_of_all(network, &terrain.images())).collect::<Result<_>>()?
        }
        Fusion::Early | Fusion::Survey => Vec::new(),
    };
    examine_by(recipe, terrains, goals, episodes, seed, &mut |cells, places| {
        let batch = cells.len();
        let features = match network.architecture().fusion {
            Fusion::Early | Fusion::Survey => features_of(network, &views(terrains, cells), places)?,
            Fusion::Late => {
                let rows = cells.iter().map(|&(terrain, cell)| cache[usize::from(terrain)].get(usize::from(cell)));
                Tensor::stack(&rows.collect::<Result<Vec<_>>>()?, 0)?
            }
        };
        let places = Tensor::from_iter(places.iter().flatten().copied(), &Device::Cpu)?.reshape((batch, 1, 4))?;
        best(&network.quantiles(&features, &places, &acting_fractions(batch, ACTING_FRACTIONS)?, None)?)
    })
}
