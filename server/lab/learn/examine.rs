//! Examination: the success of a network that acts greedily, on random starts and goals, or on a tiny map on all pairs of
//! cells.

use std::collections::HashMap;

use candle_core::{Device, Result, Tensor};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::environment::{Ending, Episode, Goal};
use super::goals::GoalSet;
use super::learner::{best, features_of, features_of_all};
use super::recipe::Recipe;
use super::terrain::{Terrain, UNREACHABLE, views};
use ferry_core::policy::{ACTING_FRACTIONS, Fusion, Network, acting_fractions};

/// Episodes that are stepped together.
const TOGETHER: usize = 250;
/// Most pairs of a start and a goal of which an examination takes all: those of 63 cells.
const MOST_PAIRS: usize = 4000;
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
    /// Whether the episodes are all pairs of a start and a goal, each once.
    #[serde(default)]
    pub all_pairs: bool,
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
            all_pairs: false,
        })
    }
}

/// Maps cells and places to actions.
pub type Act<'a> = dyn FnMut(&[(u8, u16)], &[[f32; 4]]) -> Result<Vec<u32>> + 'a;

/// The episodes of an examination: all pairs of a start and a goal in the middle of its cell, if there are few enough;
/// otherwise random ones. Whether they are all pairs.
fn drawn(terrains: &[Terrain], goals: GoalSet, episodes: u32, seed: u64) -> (Vec<Episode>, bool) {
    if terrains.iter().map(|terrain| terrain.cells() * (terrain.cells() - 1)).sum::<usize>() <= MOST_PAIRS {
        return (pairs(terrains, goals), true);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(STREAM);
    ((0..episodes).map(|_| Episode::start(terrains, goals, &mut rng)).collect(), false)
}

/// One episode for each start and each goal that it does not reach already and to which a path leads.
fn pairs(terrains: &[Terrain], goals: GoalSet) -> Vec<Episode> {
    let mut pairs = Vec::new();
    for (index, terrain) in (0..).zip(terrains) {
        let cells = 0..terrain.cells() as u16;
        for to in cells.clone().filter(|&to| goals.has(terrain, to)) {
            let goal = Goal { cell: to, offset: [0, 0] };
            let starts = cells.clone().filter(|&cell| terrain.distance(cell, to) != UNREACHABLE);
            let starts = starts.filter(|&cell| !goal.is_reached_from(terrain, cell));
            pairs.extend(starts.map(|cell| Episode { terrain: index, cell, goal, steps: 0, total: 0.0 }));
        }
    }
    pairs
}

/// Examines a function that chooses actions; for the same cell and places always the same one. Steps follow the terrains'
/// tables.
pub fn examine_by(
    recipe: &Recipe,
    terrains: &[Terrain],
    goals: GoalSet,
    episodes: u32,
    seed: u64,
    act: &mut Act<'_>,
) -> Result<Marks> {
    let (mut left, all_pairs) = drawn(terrains, goals, episodes, seed);
    let mut marks = Marks { episodes: left.len() as u32, all_pairs, ..Marks::default() };
    while !left.is_empty() {
        let together = left.len().min(TOGETHER);
        let mut running: Vec<(Episode, Episode)> = left.drain(..together).map(|episode| (episode, episode)).collect();
        // Where episodes meet or go in circles, the action is known.
        let mut known = HashMap::new();
        while !running.is_empty() {
            let at = |now: &Episode| (now.terrain, now.cell, now.goal.cell, now.goal.offset);
            let new: Vec<&Episode> =
                running.iter().map(|(_, now)| now).filter(|now| !known.contains_key(&at(now))).collect();
            if !new.is_empty() {
                let cells: Vec<(u8, u16)> = new.iter().map(|now| (now.terrain, now.cell)).collect();
                let places: Vec<[f32; 4]> = new.iter().map(|now| now.places(terrains)).collect();
                let actions = act(&cells, &places)?;
                known.extend(new.into_iter().map(at).zip(actions));
            }
            let mut still = Vec::with_capacity(running.len());
            for (first, mut now) in running {
                let action = known[&at(&now)] as usize;
                match now.step(terrains, action, recipe).1 {
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::learn::terrain::tests::{corridor, two_rooms};

    #[test]
    fn a_tiny_map_is_examined_over_all_its_pairs_each_once() {
        let terrains = [two_rooms()];
        let terrain = &terrains[0];
        let all = pairs(&terrains, GoalSet::All);
        let ends: BTreeSet<(u16, u16)> = all.iter().map(|pair| (pair.cell, pair.goal.cell)).collect();
        assert_eq!(ends.len(), all.len(), "each once");
        // Just 2 cm apart, rounding decides.
        for (from, to) in (0..26).flat_map(|from| (0..26).map(move |to| (from, to))) {
            let off_m = (terrain.center_m(from) - terrain.center_m(to)).norm();
            let is_pair = ends.contains(&(from, to));
            assert!((off_m - 0.02).abs() < 1e-9 || is_pair == (off_m > 0.02), "{from} to {to}: {off_m}");
        }
        // From the fourth cell no step leads back.
        let one_way = [corridor(&[1, 3, 3, 1, 3, 2]).unwrap()];
        let has = |from, to| pairs(&one_way, GoalSet::All).iter().any(|pair| (pair.cell, pair.goal.cell) == (from, to));
        assert!(has(0, 3) && !has(3, 0) && has(0, 5) && !has(5, 0));
    }

    #[test]
    fn marks_count_every_pair_and_repeat_no_question() {
        let terrains = [two_rooms()];
        let mut asked = BTreeSet::new();
        // A step to the right: only goals within 2 cm of that path are reached, and all others end at a wall.
        let mut act = |cells: &[(u8, u16)], places: &[[f32; 4]]| {
            for (cell, place) in cells.iter().zip(places) {
                asked.insert((*cell, place.map(f32::to_bits)));
            }
            Ok(vec![0; cells.len()])
        };
        let marks = examine_by(&Recipe::default(), &terrains, GoalSet::All, 10, 1, &mut act).unwrap();
        assert!(marks.all_pairs && marks.reached > 0 && marks.collided > 0 && marks.timed_out == 0, "{marks:?}");
        assert_eq!(marks.episodes as usize, pairs(&terrains, GoalSet::All).len());
        assert_eq!(marks.episodes, marks.reached + marks.collided);
        assert!(asked.len() <= 26 * 26, "{}", asked.len());
        // More cells than that are examined by random episodes.
        let long = [corridor(&[3; 70]).unwrap()];
        let marks =
            examine_by(&Recipe::default(), &long, GoalSet::All, 10, 1, &mut |cells, _| Ok(vec![0; cells.len()]));
        let marks = marks.unwrap();
        assert!(!marks.all_pairs && marks.episodes == 10, "{marks:?}");
    }
}
