//! One learner: the networks, their optimiser, and one update (paper, §III; Hessel et al. 2018, "Rainbow"; Dabney et
//! al. 2018, "Implicit Quantile Networks").

use candle_core::{D, Device, Result, Tensor};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::environment::{Ending, Goal};
use super::loss::{huber_mean, quantile_huber};
use super::networks::{Descent, Memory, Networks};
use super::recipe::{EPISODE_STEPS, Recipe};
use super::replay::{Replay, Transition};
use super::terrain::{Terrain, views};
use ferry_core::perception::OBSERVATION_SIZE_PX;
use ferry_core::policy::{Fusion, Network, acting_fractions, images};

/// Cells whose features are computed together, so that their columns stay in the CPU cache.
const CHUNK: usize = 32;

/// Measurements of one update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Mean loss of the images, before importance weights.
    pub loss: f64,
    /// Norm of the gradient before clipping.
    pub gradient: f64,
}

pub struct Learner<'a> {
    recipe: &'a Recipe,
    terrains: &'a [Terrain],
    memory: Memory,
    networks: Networks,
    /// Features of all cells by the target network, one tensor per terrain; empty with early fusion.
    cache: Vec<Tensor>,
}

/// Features of many views, each `[84 · 84]`: `[B, 128]`; late fusion only.
pub fn features_of_all(network: &Network, views: &[&[u8]]) -> Result<Tensor> {
    let chunks = views.chunks(CHUNK).map(|chunk| network.features(&images(chunk.iter().copied(), 1)?));
    Tensor::cat(&chunks.collect::<Result<Vec<_>>>()?, 0)
}

/// Features of views, each `[84 · 84]`: `[B, 128]`. With early fusion, `places` belong to the views.
pub fn features_of(network: &Network, views: &[&[u8]], places: &[[f32; 4]]) -> Result<Tensor> {
    match network.architecture().fusion {
        Fusion::Late => network.features(&images(views.iter().copied(), 1)?),
        Fusion::Early | Fusion::Survey => {
            let both: Vec<Vec<u8>> =
                views.iter().zip(places).map(|(view, &places)| observation(view, places)).collect();
            network.features(&images(both.iter().map(Vec::as_slice), 2)?)
        }
    }
}

/// Both channels of an observation.
fn observation(view: &[u8], places: [f32; 4]) -> Vec<u8> {
    const SIZE: usize = OBSERVATION_SIZE_PX;
    let levels = places.map(|place| (place * 255.0).round() as u8);
    let second = (0..SIZE * SIZE).map(|i| levels[2 * (i / SIZE / (SIZE / 2)) + i % SIZE / (SIZE / 2)]);
    view.iter().copied().chain(second).collect()
}

/// Selects one action for each of `[B · G]` from the `[B, G, N, 4]` values: `[B, G, N]`.
fn of_actions(values: &Tensor, actions: &[u32]) -> Result<Tensor> {
    let (batch, goals, _, _) = values.dims4()?;
    let chosen = actions.iter().flat_map(|&action| (0..4).map(move |index| f32::from(u8::from(index == action))));
    let chosen = Tensor::from_iter(chosen, &Device::Cpu)?.reshape((batch, goals, 1, 4))?;
    values.broadcast_mul(&chosen)?.sum(D::Minus1)
}

/// The best action of each of `[B · G]`, by the mean over the fractions.
pub fn best(quantiles: &Tensor) -> Result<Vec<u32>> {
    quantiles.mean(2)?.argmax(D::Minus1)?.flatten_all()?.to_vec1()
}

/// A sampled transition with the goals it is learned for.
struct Sample {
    cell: (u8, u16),
    action: u32,
    /// Terrain and cell from which the return is bootstrapped.
    beyond: (u8, u16),
    goals: Vec<Aim>,
}

/// One goal of a sample.
struct Aim {
    places: [f32; 4],
    places_beyond: [f32; 4],
    /// Discounted rewards up to the bootstrap cell.
    reward: f32,
    /// γⁿ, or 0 if the return ends there.
    discount: f32,
}

impl<'a> Learner<'a> {
    /// A learner that continues from its state.
    ///
    /// # Errors Those of candle, if the weights do not have the shapes of the recipe's network.
    pub fn new(recipe: &'a Recipe, terrains: &'a [Terrain], memory: Memory) -> Result<Self> {
        let networks = Networks::new(recipe.architecture, &memory)?;
        let mut learner = Self { recipe, terrains, memory, networks, cache: Vec::new() };
        learner.fill_cache()?;
        Ok(learner)
    }

    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    pub fn rng(&mut self) -> &mut ChaCha8Rng {
        &mut self.memory.rng
    }

    fn fill_cache(&mut self) -> Result<()> {
        if self.recipe.architecture.fusion == Fusion::Late {
            let features =
                self.terrains.iter().map(|terrain| features_of_all(&self.networks.target, &terrain.images()));
            self.cache = features.collect::<Result<_>>()?;
        }
        Ok(())
    }

    /// The noisy network's actions `[B]` for cells and places.
    ///
    /// # Errors Those of candle.
    pub fn act(&mut self, cells: &[(u8, u16)], places: &[[f32; 4]]) -> Result<Vec<u32>> {
        let batch = cells.len();
        let features = features_of(&self.networks.frozen, &views(self.terrains, cells), places)?;
        let noise = self.recipe.architecture.draw_noise(&mut self.memory.rng)?;
        let fractions = acting_fractions(batch, self.recipe.choosing_fractions)?;
        let places = tensor(places, (batch, 1, 4))?;
        best(&self.networks.frozen.quantiles(&features, &places, &fractions, noise.as_ref())?)
    }

    /// Learns from one draw of the replay and updates the draw's losses.
    ///
    /// # Errors Those of candle.
    pub fn update(&mut self, replay: &mut Replay) -> Result<Report> {
        let recipe = self.recipe;
        let progress = self.memory.updates as f64 / recipe.updates as f64;
        let importance = recipe.importance_start + (1.0 - recipe.importance_start) * progress.min(1.0);
        let draw = replay.draw(recipe.images, importance, &mut self.memory.rng);
        let samples: Vec<Sample> = draw.indices.iter().map(|&index| self.sample(replay, index)).collect();

        let (batch, goals) = (samples.len(), samples[0].goals.len());
        let aims = || samples.iter().flat_map(|sample| &sample.goals);
        let places: Vec<[f32; 4]> = aims().map(|aim| aim.places).collect();
        let actions: Vec<u32> = samples.iter().flat_map(|sample| vec![sample.action; goals]).collect();
        let targets = self.targets(&samples)?;

        let cells: Vec<(u8, u16)> = samples.iter().map(|sample| sample.cell).collect();
        let features = features_of(&self.networks.online, &views(self.terrains, &cells), &places)?;
        let noise = recipe.architecture.draw_noise(&mut self.memory.rng)?;
        let fractions = self.memory.draw_fractions(batch, recipe.fractions)?;
        let places = tensor(&places, (batch, goals, 4))?;
        let quantiles = self.networks.online.quantiles(&features, &places, &fractions, noise.as_ref())?;
        let count = quantiles.dim(2)?;
        let chosen = of_actions(&quantiles, &actions)?.reshape((batch * goals, count))?;
        let each = if recipe.architecture.quantiles {
            let fractions = fractions.unsqueeze(1)?.repeat((1, goals, 1))?.reshape((batch * goals, count))?;
            quantile_huber(&chosen, &fractions, &targets)?
        } else {
            huber_mean(&chosen, &targets)?
        };
        let each = each.reshape((batch, goals))?.mean(1)?;
        let losses: Vec<f32> = each.to_vec1()?;
        let weights = Tensor::from_vec(draw.weights, batch, &Device::Cpu)?;
        let descent = Descent {
            rates: [recipe.learning_rate, recipe.learning_rate_end],
            gradient_most: recipe.gradient_most,
            averaging: recipe.averaging,
            target_period: recipe.target_period,
            updates: recipe.updates,
        };
        let loss = (each * weights)?.mean_all()?;
        let (gradient, is_target_new) = self.networks.descend(&loss, &mut self.memory, &descent)?;
        if is_target_new {
            self.fill_cache()?;
        }
        for (&index, &loss) in draw.indices.iter().zip(&losses) {
            replay.set_loss(index, f64::from(loss));
        }
        let loss = losses.iter().map(|&loss| f64::from(loss)).sum::<f64>() / batch as f64;
        Ok(Report { loss, gradient })
    }

    /// Target values of the samples' returns, `[B · G, N']`.
    fn targets(&mut self, samples: &[Sample]) -> Result<Tensor> {
        let recipe = self.recipe;
        let (batch, goals) = (samples.len(), samples[0].goals.len());
        let aims = || samples.iter().flat_map(|sample| &sample.goals);
        let places: Vec<[f32; 4]> = aims().map(|aim| aim.places_beyond).collect();
        let beyond: Vec<(u8, u16)> = samples.iter().map(|sample| sample.beyond).collect();
        let judged = match recipe.architecture.fusion {
            Fusion::Early | Fusion::Survey => {
                features_of(&self.networks.target, &views(self.terrains, &beyond), &places)?
            }
            Fusion::Late => {
                let rows =
                    beyond.iter().map(|&(terrain, cell)| self.cache[usize::from(terrain)].get(usize::from(cell)));
                Tensor::stack(&rows.collect::<Result<Vec<_>>>()?, 0)?
            }
        };
        let place_tensor = tensor(&places, (batch, goals, 4))?;
        let noise = recipe.architecture.draw_noise(&mut self.memory.rng)?;
        let fractions = self.memory.draw_fractions(batch, recipe.fractions)?;
        let quantiles = self.networks.target.quantiles(&judged, &place_tensor, &fractions, noise.as_ref())?;

        let noise = recipe.architecture.draw_noise(&mut self.memory.rng)?;
        let fractions = self.memory.draw_fractions(batch, recipe.choosing_fractions)?;
        let chosen = if recipe.double {
            let features = features_of(&self.networks.frozen, &views(self.terrains, &beyond), &places)?;
            best(&self.networks.frozen.quantiles(&features, &place_tensor, &fractions, noise.as_ref())?)?
        } else {
            best(&self.networks.target.quantiles(&judged, &place_tensor, &fractions, noise.as_ref())?)?
        };
        let values = of_actions(&quantiles, &chosen)?;
        let count = values.dim(2)?;
        let numbers =
            |get: fn(&Aim) -> f32| Tensor::from_iter(aims().map(get), &Device::Cpu)?.reshape((batch * goals, 1));
        let discounted = values.reshape((batch * goals, count))?.broadcast_mul(&numbers(|aim| aim.discount)?)?;
        Ok(discounted.broadcast_add(&numbers(|aim| aim.reward)?)?.detach())
    }

    /// A transition with its goals and returns.
    fn sample(&mut self, replay: &Replay, index: usize) -> Sample {
        let recipe = self.recipe;
        let first = *replay.get(index);
        let terrain = &self.terrains[usize::from(first.terrain)];
        let path: Vec<Transition> = replay.following(index, recipe.n_step).copied().collect();
        let last = path.last().expect("a path has at least its first step");
        let beyond = last.next.unwrap_or(last.cell);
        let goals = (0..recipe.goals).map(|_| {
            let (goal, is_own) = self.choose_goal(replay, index, terrain);
            let (reward, discount) = self.step_return(terrain, &path, goal, is_own);
            let places = terrain.places(goal.place_m(terrain), first.cell);
            Aim { places, places_beyond: terrain.places(goal.place_m(terrain), beyond), reward, discount }
        });
        let goals = goals.collect();
        Sample {
            cell: (first.terrain, first.cell),
            action: u32::from(first.action),
            beyond: (first.terrain, beyond),
            goals,
        }
    }

    /// Discounted rewards along a path for a goal, and the discount of the value after it.
    fn step_return(&self, terrain: &Terrain, path: &[Transition], goal: Goal, is_own: bool) -> (f32, f32) {
        let (mut reward, mut discount) = (0.0, 1.0f32);
        for step in path {
            let outcome = self.recipe.outcome(terrain, step.cell, step.next, goal);
            let ran_out = step.ending == Some(Ending::TimedOut) && is_own && self.recipe.timeout_fails;
            reward += discount * (outcome.reward - f32::from(u8::from(ran_out)));
            if outcome.terminal || ran_out {
                return (reward, 0.0);
            }
            discount *= self.recipe.discount as f32;
        }
        (reward, discount)
    }

    /// A goal for learning a transition, and whether it is the episode's own goal.
    fn choose_goal(&mut self, replay: &Replay, index: usize, terrain: &Terrain) -> (Goal, bool) {
        let recipe = self.recipe;
        let first = replay.get(index);
        let rng = &mut self.memory.rng;
        let kind: f64 = rng.random();
        let goals = recipe.trained_goals();
        if kind < recipe.uniform_goals
            && let Some(goal) = Goal::anywhere(terrain, goals, first.cell, rng)
        {
            return (goal, false);
        }
        if kind < recipe.uniform_goals + recipe.future_goals {
            let later = replay.following(index, EPISODE_STEPS as usize).filter_map(|transition| transition.next);
            let later: Vec<u16> = later.filter(|&cell| goals.has(terrain, cell)).collect();
            if !later.is_empty() {
                let cell = later[rng.random_range(0..later.len())];
                return (Goal::in_cell(cell, rng), false);
            }
        }
        (first.goal, true)
    }
}

fn tensor(places: &[[f32; 4]], shape: (usize, usize, usize)) -> Result<Tensor> {
    Tensor::from_iter(places.iter().flatten().copied(), &Device::Cpu)?.reshape(shape)
}

#[cfg(test)]
mod tests;
