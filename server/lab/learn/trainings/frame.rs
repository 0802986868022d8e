//! What a network thinks of a map: its values, best actions and quantiles above every cell, and episodes that follow
//! them. A training keeps one such frame for each point of its curve.

use candle_core::{Device, Result, Tensor};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::ranks::rank_correlation;
use crate::learn::environment::{Ending, Episode, Goal};
use crate::learn::learner::{best, features_of, features_of_all};
use crate::learn::networks::network;
use crate::learn::recipe::EPISODE_STEPS;
use crate::learn::terrain::{Terrain, UNREACHABLE, views};
use crate::learn::training::State;
use ferry_core::geometry::Point2;
use ferry_core::policy::{ACTING_FRACTIONS, BATCH, Fusion, Network, acting_fractions};

/// Fractions of the shown quantiles.
const SHOWN_FRACTIONS: [f32; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];
/// Random stream of the shown episodes; training uses other streams of its seed.
const STREAM: u64 = 1 << 41;
/// Starts of the shown episodes, as shares of all cells in the order of their distance to the goal.
const STARTS: [f64; 6] = [1.0, 0.85, 0.7, 0.55, 0.4, 0.25];

/// A map's cells and the goal that all frames of a training share.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cells {
    pub centers_m: Vec<Point2<f64>>,
    goal: Goal,
    pub goal_m: Point2<f64>,
    /// Steps of the shortest path to the goal; `None` without a path.
    pub steps: Vec<Option<u16>>,
    /// Starts of the shown episodes.
    starts: Vec<u16>,
}

/// An episode as the cells that the tool visits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[schema(as = TrainingEpisode)]
#[ts(rename = "TrainingEpisode")]
pub struct Trail {
    /// Indices of cells.
    pub cells: Vec<u16>,
    pub ending: Ending,
}

/// One entry of each list per cell, in the order of [`Cells`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    pub update: u64,
    /// Value of the best action.
    pub values: Vec<f32>,
    /// Index of the best action.
    pub actions: Vec<u8>,
    /// Quantiles .05, .25, .5, .75 and .95 of the return of the best action.
    pub quantiles: Vec<[f32; 5]>,
    /// How an episode without exploration ends that begins at the cell.
    pub endings: Vec<Ending>,
    /// Rank correlation of the values with the distances outside the goal; `None` if all values are equal.
    pub rank_correlation: Option<f64>,
    /// Episodes to the goal without exploration.
    pub greedy: Vec<Trail>,
    /// Episodes to the goal with exploration, from the same starts.
    pub exploring: Vec<Trail>,
}

impl Cells {
    /// The cells of a terrain. The goal is in the cell nearest to the wish, or else at the cell that is farthest from
    /// others and can be reached from most.
    pub fn of(terrain: &Terrain, wish_m: Option<Point2<f64>>) -> Self {
        let cells = 0..terrain.cells() as u16;
        let distances = |to: u16| cells.clone().map(move |from| terrain.distance(from, to));
        let reached = |to: u16| distances(to).filter(|&steps| steps != UNREACHABLE);
        let farthest = || cells.clone().max_by_key(|&to| (reached(to).count(), reached(to).max()));
        let cell = match wish_m {
            Some(wish_m) => {
                let off_m = |cell: &u16| (terrain.center_m(*cell) - wish_m).norm();
                cells.clone().min_by(|a, b| off_m(a).total_cmp(&off_m(b)))
            }
            None => farthest(),
        };
        let cell = cell.expect("a terrain has cells");
        let steps: Vec<_> = distances(cell).map(|steps| Some(steps).filter(|&steps| steps != UNREACHABLE)).collect();
        let mut by_distance: Vec<u16> = cells.filter(|&from| steps[usize::from(from)].is_some()).collect();
        by_distance.sort_by_key(|&from| steps[usize::from(from)]);
        let last = by_distance.len() - 1;
        let starts = STARTS.map(|share| by_distance[(share * last as f64) as usize]).to_vec();
        let goal = Goal { cell, offset: [0, 0] };
        let centers_m = (0..terrain.cells() as u16).map(|cell| terrain.center_m(cell)).collect();
        Self { centers_m, goal, goal_m: terrain.center_m(cell), steps, starts }
    }
}

impl Frame {
    /// The frame of a run's present weights on its only terrain.
    ///
    /// # Errors
    /// Those of candle.
    pub fn of(state: &State, terrains: &[Terrain], cells: &Cells) -> Result<Self> {
        let architecture = state.recipe.architecture;
        let judged = judge(&network(architecture, state.weights())?, &terrains[0], cells)?;
        let Judged { values, actions, quantiles } = judged;
        let trail = |start: u16| follow(&terrains[0], cells.goal, &actions, start);
        // An episode that begins within the goal ends at once, so nothing is learned there.
        let outside = |cell: u16| !cells.goal.is_reached_from(&terrains[0], cell);
        let ranked =
            || (0..).zip(&cells.steps).filter_map(|(cell, &steps)| Some((cell, steps.filter(|_| outside(cell))?)));
        let distances: Vec<f64> = ranked().map(|(_, steps)| -f64::from(steps)).collect();
        let expected: Vec<f64> = ranked().map(|(cell, _)| f64::from(values[usize::from(cell)])).collect();
        Ok(Self {
            update: state.memory.updates,
            endings: (0..actions.len() as u16).map(|start| trail(start).ending).collect(),
            greedy: cells.starts.iter().map(|&start| trail(start)).collect(),
            exploring: explore(state, terrains, cells)?,
            rank_correlation: rank_correlation(&expected, &distances),
            values,
            actions,
            quantiles,
        })
    }
}

struct Judged {
    values: Vec<f32>,
    actions: Vec<u8>,
    quantiles: Vec<[f32; 5]>,
}

/// A network's values of the goal above every cell, without noise.
fn judge(network: &Network, terrain: &Terrain, cells: &Cells) -> Result<Judged> {
    let mut judged = Judged { values: Vec::new(), actions: Vec::new(), quantiles: Vec::new() };
    let all: Vec<u16> = (0..terrain.cells() as u16).collect();
    for chunk in all.chunks(BATCH) {
        let images: Vec<&[u8]> = chunk.iter().map(|&cell| terrain.image(cell)).collect();
        let places: Vec<[f32; 4]> = chunk.iter().map(|&cell| terrain.places(cells.goal_m, cell)).collect();
        let features = match network.architecture().fusion {
            Fusion::Late => features_of_all(network, &images)?,
            Fusion::Early | Fusion::Survey => features_of(network, &images, &places)?,
        };
        let fractions = acting_fractions(chunk.len(), ACTING_FRACTIONS)?;
        let places = Tensor::from_iter(places.into_iter().flatten(), &Device::Cpu)?.reshape((chunk.len(), 1, 4))?;
        let quantiles = network.quantiles(&features, &places, &fractions, None)?;
        let count = quantiles.dim(2)?;
        let actions = best(&quantiles)?;
        let flat: Vec<f32> = quantiles.flatten_all()?.to_vec1()?;
        for (row, &action) in flat.chunks_exact(4 * count).zip(&actions) {
            let mut returns: Vec<f32> = row.iter().skip(action as usize).step_by(4).copied().collect();
            judged.values.push(returns.iter().sum::<f32>() / count as f32);
            returns.sort_by(f32::total_cmp);
            judged.quantiles.push(SHOWN_FRACTIONS.map(|fraction| at(&returns, fraction)));
        }
        judged.actions.extend(actions.into_iter().map(|action| action as u8));
    }
    Ok(judged)
}

/// The value at a fraction, between sorted values at the fractions (k + ½) / K.
fn at(sorted: &[f32], fraction: f32) -> f32 {
    let last = sorted.len() - 1;
    let place = (fraction * sorted.len() as f32 - 0.5).clamp(0.0, last as f32);
    let (low, share) = (place as usize, place.fract());
    sorted[low] + share * (sorted[(low + 1).min(last)] - sorted[low])
}

/// The episode that begins at a cell and takes the best action above each.
fn follow(terrain: &Terrain, goal: Goal, actions: &[u8], start: u16) -> Trail {
    let mut cells = vec![start];
    let mut cell = start;
    for _ in 0..EPISODE_STEPS {
        if goal.is_reached_from(terrain, cell) {
            return Trail { cells, ending: Ending::Reached };
        }
        match terrain.step(cell, actions[usize::from(cell)].into()) {
            Some(next) => cell = next,
            None => return Trail { cells, ending: Ending::Collided },
        }
        cells.push(cell);
    }
    let ending = if goal.is_reached_from(terrain, cell) { Ending::Reached } else { Ending::TimedOut };
    Trail { cells, ending }
}

/// Episodes as the training has them, with noise and random actions, but not part of it: the draws are others.
fn explore(state: &State, terrains: &[Terrain], cells: &Cells) -> Result<Vec<Trail>> {
    let online = network(state.recipe.architecture, &state.memory.online)?;
    let mut rng = ChaCha8Rng::seed_from_u64(state.seed ^ state.memory.updates);
    rng.set_stream(STREAM);
    let start = |&cell: &u16| Episode { terrain: 0, cell, goal: cells.goal, steps: 0, total: 0.0 };
    let mut running: Vec<(Episode, Trail)> = (cells.starts.iter())
        .map(|cell| (start(cell), Trail { cells: vec![*cell], ending: Ending::TimedOut }))
        .collect();
    let mut trails = vec![None; running.len()];
    let mut left: Vec<usize> = (0..running.len()).collect();
    while !left.is_empty() {
        let at: Vec<(u8, u16)> = left.iter().map(|&index| (0, running[index].0.cell)).collect();
        let places: Vec<[f32; 4]> = left.iter().map(|&index| running[index].0.places(terrains)).collect();
        let features = features_of(&online, &views(terrains, &at), &places)?;
        let noise = state.recipe.architecture.draw_noise(&mut rng)?;
        let fractions = acting_fractions(left.len(), state.recipe.choosing_fractions)?;
        let places = Tensor::from_iter(places.into_iter().flatten(), &Device::Cpu)?.reshape((left.len(), 1, 4))?;
        let actions = best(&online.quantiles(&features, &places, &fractions, noise.as_ref())?)?;
        let mut still = Vec::new();
        for (&index, action) in left.iter().zip(actions) {
            let explores = rng.random::<f64>() < state.recipe.exploration;
            let action = if explores { rng.random_range(0..4) } else { action as usize };
            let (episode, trail) = &mut running[index];
            let (next, ending) = episode.step(terrains, action, &state.recipe);
            trail.cells.extend(next);
            match ending {
                Some(ending) => trails[index] = Some(Trail { cells: std::mem::take(&mut trail.cells), ending }),
                None => still.push(index),
            }
        }
        left = still;
    }
    Ok(trails.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::recipe::Recipe;
    use crate::learn::terrain::tests::two_rooms;

    #[test]
    fn episodes_follow_the_actions_to_goal_wall_or_loop() {
        let terrain = two_rooms();
        let cells = Cells::of(&terrain, Some(Point2::new(0.005, 0.005)));
        assert_eq!((cells.goal.cell, cells.steps[0], cells.centers_m.len()), (0, Some(0), 26));
        let toward_minus_x = vec![1; 26];
        let begun_at = |x_m: f64, y_m: f64| {
            let near = |cell: &u16| (terrain.center_m(*cell) - Point2::new(x_m, y_m)).norm() < 1e-9;
            follow(&terrain, cells.goal, &toward_minus_x, (0..26).find(near).unwrap())
        };
        assert_eq!(begun_at(0.015, 0.005).ending, Ending::Reached, "within 2 cm from the start");
        assert_eq!(begun_at(0.025, 0.005).ending, Ending::Reached);
        assert_eq!(begun_at(0.055, 0.005).ending, Ending::Collided, "the wall is between");
        let mut back_and_forth = toward_minus_x.clone();
        let right = (0..26).find(|&cell| terrain.step(cell, 1).is_none() && terrain.center_m(cell).x > 0.04).unwrap();
        back_and_forth[usize::from(right)] = 0;
        let trail = follow(&terrain, cells.goal, &back_and_forth, right);
        assert_eq!((trail.ending, trail.cells.len()), (Ending::TimedOut, 151));
    }

    #[test]
    fn a_frame_has_an_entry_for_each_cell_and_is_the_same_each_time() {
        let terrains = [two_rooms()];
        let recipe = Recipe { lanes: 2, images: 2, warm_up: 2, capacity: 10, ..Recipe::quick() };
        let state = State::new(recipe, 3, &terrains).unwrap();
        let before = state.clone();
        let cells = Cells::of(&terrains[0], None);
        let frame = Frame::of(&state, &terrains, &cells).unwrap();
        assert_eq!([frame.values.len(), frame.actions.len(), frame.quantiles.len(), frame.endings.len()], [26; 4]);
        assert!(frame.quantiles.iter().all(|row| row.is_sorted()));
        assert_eq!((frame.greedy.len(), frame.exploring.len()), (STARTS.len(), STARTS.len()));
        assert_eq!(frame, Frame::of(&state, &terrains, &cells).unwrap());
        assert_eq!(state, before, "a frame is no part of the training");
    }
}
