//! The paper's experiment: many random trials, counted honestly.

mod figure;

use std::sync::Arc;
use std::sync::Mutex;
use std::time::Instant;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::camera::{Camera, CameraError, Eye, Gpu, Subject};
use crate::image::CameraFrame;
use crate::policy::Policy;
use crate::scenario::{ControllerName, Parameters, Scenario};
use crate::trial::{Arena, Phase, Source, Tally, TickRecord, Trial, TrialError};

pub use figure::{FigureError, Trace};

/// What to evaluate.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// Name or path of the map.
    pub map: String,
    /// Sub-controller 2.
    pub controller: ControllerName,
    /// How many trials.
    pub episodes: u32,
    /// Scripted disturbances a trial.
    pub disturbances: u32,
    /// Seed of the trials: the same for every controller.
    pub seed: u64,
    /// Parameters of all trials.
    pub parameters: Parameters,
    /// A policy to use in place of the shipped ones.
    pub policy: Option<Policy>,
}

/// One trial's result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Episode {
    /// Which trial of the seed.
    pub index: u32,
    /// How it was set up.
    pub scenario: Scenario,
    /// Whether the tool came within 2 cm of the goal: the paper's success.
    pub reached: bool,
    /// Whether the bead did: ours.
    pub delivered: bool,
    /// How it ended.
    pub outcome: String,
    /// What kept sub-controller 2 from the goal in the end, if anything did.
    pub trouble: Option<String>,
    /// Why the arm held in the end, if it did.
    pub refusal: Option<String>,
    /// Mean distance of tool and bead during transport.
    pub tracking_error_mean_m: f64,
    /// Largest difference in x during transport.
    pub tracking_error_max_x_m: f64,
    /// Largest difference in y during transport.
    pub tracking_error_max_y_m: f64,
    /// Control steps.
    pub steps: u32,
    /// Switches of the active sub-controller.
    pub switches: u32,
    /// Disturbances that struck.
    pub disturbances: u32,
    /// Seconds a control step, camera and decision, on the wall clock.
    #[serde(skip)]
    pub decision_s: Vec<f64>,
}

/// One row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Sub-controller 2.
    pub controller: String,
    /// Map.
    pub map: String,
    /// Scripted disturbances a trial.
    pub disturbances: u32,
    /// Trials.
    pub episodes: u32,
    /// Trials whose tool reached the goal (paper's test).
    pub successes: u32,
    /// Wilson 95 % interval of `successes / episodes`.
    pub successes_wilson95: [f64; 2],
    /// Trials whose bead reached the goal.
    pub delivered: u32,
    /// Wilson 95 % interval of `delivered / episodes`.
    pub wilson95: [f64; 2],
    /// Mean over trials of the mean distance of tool and bead during transport.
    pub tracking_error_mean_m: f64,
    /// Mean over trials of the largest difference in x during transport.
    pub tracking_error_max_x_m: f64,
    /// The same in y.
    pub tracking_error_max_y_m: f64,
    /// Mean control steps.
    pub steps_mean: f64,
    /// Mean switches.
    pub switches_mean: f64,
    /// Disturbances that struck, all trials together.
    pub disturbances_struck: u32,
    /// Median milliseconds a control step, camera included.
    pub decision_ms_p50: f64,
    /// 99th percentile.
    pub decision_ms_p99: f64,
}

/// Why an experiment could not run.
#[derive(Debug, thiserror::Error)]
pub enum EvaluateError {
    /// `episodes` is zero or absurd.
    #[error("episodes is {0}, it must be 1 to 100000")]
    Episodes(u32),
    /// A trial could not be made or go on.
    #[error(transparent)]
    Trial(#[from] TrialError),
    /// No camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
}

impl From<crate::map::MapError> for EvaluateError {
    fn from(error: crate::map::MapError) -> Self {
        Self::Trial(error.into())
    }
}

/// An eye that notes how long each look took.
struct Timed<'a> {
    eye: &'a mut dyn Eye,
    looked: bool,
}

impl Eye for Timed<'_> {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        self.looked = true;
        self.eye.capture(subject)
    }
}

/// Runs one trial to its end; `watch` sees every tick.
pub fn episode(
    index: u32,
    scenario: Scenario,
    arena: &Arc<Arena>,
    eye: &mut dyn Eye,
    watch: &mut dyn FnMut(&TickRecord),
) -> Result<Episode, TrialError> {
    let mut trial = Trial::new(scenario.clone(), arena.clone())?;
    let mut tally = Tally::default();
    let mut decision_s = Vec::new();
    loop {
        let mut timed = Timed { eye, looked: false };
        let started = Instant::now();
        let record = trial.tick(Source::Eye(&mut timed))?;
        if timed.looked {
            decision_s.push(started.elapsed().as_secs_f64());
        }
        watch(&record);
        let moment = &record.moment;
        tally.add(moment);
        if !moment.phase.is_final() {
            continue;
        }
        let counters = moment.counters;
        let [max_x_m, max_y_m] = tally.max_m();
        return Ok(Episode {
            index,
            scenario,
            reached: trial.state().world.reached_tick.is_some(),
            delivered: moment.phase == Phase::Delivered,
            outcome: moment.phase.to_string(),
            trouble: trial.state().mind.carrier.trouble().map(|trouble| trouble.to_string()),
            refusal: moment.refusal.clone(),
            tracking_error_mean_m: tally.mean_m(),
            tracking_error_max_x_m: max_x_m,
            tracking_error_max_y_m: max_y_m,
            steps: counters.steps,
            switches: counters.switches,
            disturbances: counters.disturbances,
            decision_s,
        });
    }
}

/// Runs an experiment on all cores; `progress` is called after each trial.
pub fn run(
    experiment: &Experiment,
    gpu: &Arc<Gpu>,
    progress: &(dyn Fn(&Episode) + Sync),
) -> Result<Vec<Episode>, EvaluateError> {
    if !(1..=100_000).contains(&experiment.episodes) {
        return Err(EvaluateError::Episodes(experiment.episodes));
    }
    let mut arena = Arena::open(&experiment.map)?;
    if let Some(policy) = &experiment.policy {
        arena = arena.with_policy(policy.clone());
    }
    // A camera a worker: they are cheap beside the trials, and none waits for another.
    let cameras: Mutex<Vec<Camera>> = Mutex::new(Vec::new());
    (0..experiment.episodes)
        .into_par_iter()
        .map(|index| {
            let kept = cameras.lock().expect("no holder panics").pop();
            let mut camera = match kept {
                Some(camera) => camera,
                None => arena.camera(gpu)?,
            };
            let mut scenario = Scenario::random(
                &arena.map,
                &experiment.map,
                &arena.space,
                experiment.controller,
                experiment.disturbances,
                experiment.seed,
                u64::from(index),
            )
            .map_err(TrialError::from)?;
            scenario.parameters = experiment.parameters.clone();
            let episode = episode(index, scenario, &arena, &mut camera, &mut |_| ())?;
            cameras.lock().expect("no holder panics").push(camera);
            progress(&episode);
            Ok(episode)
        })
        .collect()
}

/// Adds episodes up.
pub fn summarize(experiment: &Experiment, map: &str, episodes: &[Episode]) -> Row {
    let count = episodes.len() as f64;
    let mean = |value: &dyn Fn(&Episode) -> f64| episodes.iter().map(value).sum::<f64>() / count;
    let total = |flag: &dyn Fn(&Episode) -> bool| episodes.iter().filter(|e| flag(e)).count() as u32;
    let mut decisions: Vec<f64> = episodes.iter().flat_map(|e| e.decision_s.iter().copied()).collect();
    decisions.sort_by(f64::total_cmp);
    let quantile_ms =
        |q: f64| decisions.get(((decisions.len() - 1) as f64 * q).round() as usize).map_or(0.0, |s| s * 1e3);
    let (reached, delivered) = (total(&|e| e.reached), total(&|e| e.delivered));
    Row {
        controller: experiment.controller.as_str().to_owned(),
        map: map.to_owned(),
        disturbances: experiment.disturbances,
        episodes: episodes.len() as u32,
        successes: reached,
        successes_wilson95: wilson95(reached, episodes.len() as u32),
        delivered,
        wilson95: wilson95(delivered, episodes.len() as u32),
        tracking_error_mean_m: mean(&|e| e.tracking_error_mean_m),
        tracking_error_max_x_m: mean(&|e| e.tracking_error_max_x_m),
        tracking_error_max_y_m: mean(&|e| e.tracking_error_max_y_m),
        steps_mean: mean(&|e| f64::from(e.steps)),
        switches_mean: mean(&|e| f64::from(e.switches)),
        disturbances_struck: episodes.iter().map(|e| e.disturbances).sum(),
        decision_ms_p50: quantile_ms(0.5),
        decision_ms_p99: quantile_ms(0.99),
    }
}

/// Wilson's score interval at 95 % for `k` of `n` (Wilson 1927).
pub fn wilson95(k: u32, n: u32) -> [f64; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    let (k, n) = (f64::from(k), f64::from(n));
    let (p, z2) = (k / n, Z * Z);
    let center = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = Z / (1.0 + z2 / n) * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    [(center - half).max(0.0), (center + half).min(1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_agrees_with_published_values() {
        // statsmodels proportion_confint(29, 30, method="wilson"); Brown, Cai & DasGupta (2001).
        let [low, high] = wilson95(29, 30);
        assert!((low - 0.83329).abs() < 1e-4 && (high - 0.99409).abs() < 1e-4, "{low} {high}");
        let [low, high] = wilson95(30, 30);
        assert!((low - 0.88649).abs() < 1e-4 && (high - 1.0).abs() < 1e-12, "{low} {high}");
    }
}
