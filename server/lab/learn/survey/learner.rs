//! One update: imitation of the teacher's values of all actions (DAgger, Ross et al. 2011, with the costs of all actions
//! as in AggreVaTe, Ross & Bagnell 2014), or a step of Rainbow-IQN on the task.

use candle_core::{D, DType, Device, Result, Tensor};
use rand_chacha::ChaCha8Rng;

use super::episode::Episode;
use super::recipe::SurveyRecipe;
use super::replay::{Step, SurveyReplay};
use super::teacher::Advice;
use crate::learn::loss::quantile_huber;
use crate::learn::networks::{Descent, Memory, Networks};
use ferry_core::policy::{Action, Network, Survey, acting_fractions};

/// Farthest that the teacher's reward for an action goes below the reward of a step that gains nothing, in steps.
const LOST_MOST: f32 = 5.0;

pub struct SurveyLearner<'a> {
    recipe: &'a SurveyRecipe,
    pub memory: Memory,
    networks: Networks,
}

/// The values of the actions that the teacher expects: those of the shaped return on its own path.
pub fn taught(episode: &Episode, reaches: impl Fn(Action) -> bool, recipe: &SurveyRecipe) -> [f32; 4] {
    let advice = Advice::on(&episode.survey);
    let gamma = recipe.discount as f32;
    let progress = recipe.progress_reward as f32;
    Action::ALL.map(|action| {
        let Some((here, after)) = advice.here.zip(advice.after[action.index()]) else { return -1.0 };
        let gained = (f32::from(here) - f32::from(after)).clamp(-LOST_MOST, 1.0);
        // The episode ends when the tool is near the goal's cell, about one step before it.
        let left = i32::from(after.max(2)) - 1;
        let value = 1.0 + progress * gamma.powi(left - 1);
        progress * gained + if reaches(action) { 1.0 } else { gamma * value }
    })
}

/// Values of the actions by the mean over the fractions, for many surveys.
pub fn values(
    network: &Network,
    surveys: &[&Survey],
    count: usize,
    noise_rng: Option<&mut ChaCha8Rng>,
) -> Result<Vec<[f32; 4]>> {
    let batch = surveys.len();
    let noise = match noise_rng {
        Some(rng) => network.architecture().draw_noise(rng)?,
        None => None,
    };
    let features = network.features_of_surveys(surveys)?;
    let places = Tensor::zeros((batch, 1, 4), DType::F32, &Device::Cpu)?;
    let quantiles = network.quantiles(&features, &places, &acting_fractions(batch, count)?, noise.as_ref())?;
    let flat: Vec<f32> = quantiles.mean(2)?.flatten_all()?.to_vec1()?;
    Ok(flat.as_chunks::<4>().0.to_vec())
}

impl<'a> SurveyLearner<'a> {
    /// # Errors
    /// Those of candle, if the weights do not have the shapes of the recipe's network.
    pub fn new(recipe: &'a SurveyRecipe, memory: Memory) -> Result<Self> {
        let networks = Networks::new(recipe.architecture, &memory)?;
        Ok(Self { recipe, memory, networks })
    }

    /// The noisy network's actions.
    ///
    /// # Errors
    /// Those of candle.
    pub fn act(&mut self, surveys: &[&Survey]) -> Result<Vec<Action>> {
        let values = values(&self.networks.frozen, surveys, self.recipe.fractions, Some(&mut self.memory.rng))?;
        Ok(surveys.iter().zip(values).map(|(survey, values)| Episode::best(survey, values, self.recipe)).collect())
    }

    /// One update; its loss and the norm of its gradient.
    ///
    /// # Errors
    /// Those of candle.
    pub fn update(&mut self, replay: &SurveyReplay) -> Result<(f64, f64)> {
        let recipe = self.recipe;
        let (batch, count) = (recipe.batch, recipe.fractions);
        let drawn: Vec<_> = (0..batch).map(|_| replay.draw(&mut self.memory.rng)).collect();
        let surveys: Vec<&Survey> = drawn.iter().map(|(survey, _, _)| *survey).collect();
        let is_task = self.memory.updates >= recipe.imitation_updates;
        let targets = if is_task { Some(self.targets(&drawn)?) } else { None };

        let noise = recipe.architecture.draw_noise(&mut self.memory.rng)?;
        let fractions = self.memory.draw_fractions(batch, count)?;
        let places = Tensor::zeros((batch, 1, 4), DType::F32, &Device::Cpu)?;
        let features = self.networks.online.features_of_surveys(&surveys)?;
        let quantiles = self.networks.online.quantiles(&features, &places, &fractions, noise.as_ref())?;
        let quantiles = quantiles.reshape((batch, count, 4))?;

        let of_actions = quantiles.transpose(1, 2)?.reshape((batch * 4, count))?;
        let all_fractions = fractions.unsqueeze(1)?.repeat((1, 4, 1))?.reshape((batch * 4, count))?;
        let taught = drawn.iter().flat_map(|(_, step, _)| step.taught);
        let taught = Tensor::from_iter(taught, &Device::Cpu)?.reshape((batch * 4, 1))?;
        let imitation = quantile_huber(&of_actions, &all_fractions, &taught)?.mean_all()?;
        let loss = match targets {
            None => imitation,
            Some(targets) => {
                let chosen = drawn
                    .iter()
                    .flat_map(|(_, step, _)| (0..4).map(|action| f32::from(u8::from(action == step.action))));
                let chosen = Tensor::from_iter(chosen, &Device::Cpu)?.reshape((batch, 1, 4))?;
                let chosen = quantiles.broadcast_mul(&chosen)?.sum(D::Minus1)?;
                let task = quantile_huber(&chosen, &fractions, &targets)?.mean_all()?;
                (task + (imitation * recipe.imitation_weight)?)?
            }
        };
        let descent = Descent {
            rates: [recipe.learning_rate, recipe.learning_rate_end],
            gradient_most: recipe.gradient_most,
            averaging: recipe.averaging,
            target_period: recipe.target_period,
            updates: recipe.updates,
        };
        let (gradient, _) = self.networks.descend(&loss, &mut self.memory, &descent)?;
        Ok((f64::from(loss.to_scalar::<f32>()?), gradient))
    }

    /// Returns of the steps, `[B, N']`.
    fn targets(&mut self, drawn: &[(&Survey, Step, &Survey)]) -> Result<Tensor> {
        let recipe = self.recipe;
        let (batch, count) = (drawn.len(), recipe.fractions);
        let beyond: Vec<&Survey> = drawn.iter().map(|(_, _, beyond)| *beyond).collect();
        let best = self.act(&beyond)?;
        let noise = recipe.architecture.draw_noise(&mut self.memory.rng)?;
        let fractions = self.memory.draw_fractions(batch, count)?;
        let places = Tensor::zeros((batch, 1, 4), DType::F32, &Device::Cpu)?;
        let features = self.networks.target.features_of_surveys(&beyond)?;
        let quantiles = self.networks.target.quantiles(&features, &places, &fractions, noise.as_ref())?;
        let flat: Vec<f32> = quantiles.flatten_all()?.to_vec1()?;
        let targets =
            drawn.iter().zip(best).zip(flat.chunks_exact(4 * count)).flat_map(|(((_, step, _), best), row)| {
                let discount = if step.terminal { 0.0 } else { recipe.discount as f32 };
                let beyond = row.iter().skip(best.index()).step_by(4);
                beyond.map(move |value| step.reward + discount * value)
            });
        Tensor::from_iter(targets, &Device::Cpu)?.reshape((batch, count))
    }
}
