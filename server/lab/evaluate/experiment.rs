//! Random trials in bulk: every controller gets the same starts, goals, seeds and disturbances.

use std::ops::{ControlFlow, RangeInclusive};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::course::Course;
use super::figure::Trace;
use super::manner::Manner;
use super::{Cell, DISTURBANCES, Setting, VariationError};
use crate::program::{self, Carrier, Program, ProgramError};
use ferry_camera::{Camera, Gpu};
use ferry_core::control::CONTROL_PERIOD_S;
use ferry_core::image::{CameraError, CameraFrame, ImageSource, Subject};
use ferry_core::map::{FreeSpace, MapError};
use ferry_core::plant::BEAD_RADIUS_M;
use ferry_core::scenario::{ControllerName, Parameters, Scenario};
use ferry_core::trial::{
    Arena, Beginning, GOAL_RADIUS_M, LEGS_PER_GOAL, Nowhere, Phase, Sink, Tally, TickRecord, TrialError,
};

/// Trials per row.
pub const EPISODES: RangeInclusive<u32> = 1..=100_000;

/// A map prepared for many trials.
pub struct Venue {
    pub arena: Arc<Arena>,
    /// Free space of the bead, for shortest paths.
    room: FreeSpace,
    /// One camera per worker, so that no worker waits for another.
    cameras: Mutex<Vec<Camera>>,
}

impl Venue {
    pub fn of(arena: Arc<Arena>) -> Arc<Self> {
        let room = FreeSpace::new(&arena.map, BEAD_RADIUS_M);
        Arc::new(Self { arena, room, cameras: Mutex::default() })
    }

    /// Area in which the bead has room.
    pub fn room_m2(&self) -> f64 {
        self.room.area_m2()
    }

    /// Takes a camera for this map; [`Self::keep`] returns it.
    pub(crate) fn camera(&self, gpu: &Arc<Gpu>) -> Result<Camera, CameraError> {
        let kept = self.cameras.lock().unwrap_or_else(PoisonError::into_inner).pop();
        kept.map_or_else(|| Camera::of(gpu, self.arena.static_scene()), Ok)
    }

    pub(crate) fn keep(&self, camera: Camera) {
        self.cameras.lock().unwrap_or_else(PoisonError::into_inner).push(camera);
    }
}

/// The trials of one row of the table.
#[derive(Clone)]
pub struct Experiment {
    pub cell: Cell,
    pub venue: Arc<Venue>,
    /// Name or path of the map, as in scenarios.
    pub map: String,
    pub episodes: u32,
    /// Seed of the trials: the same for every controller.
    pub seed: u64,
    /// Parameters of all trials.
    pub parameters: Parameters,
    pub manner: Manner,
    /// The program, with the controller `program`.
    pub program: Option<Arc<Program>>,
}

impl Experiment {
    /// A name for the trial of an index that no other has.
    pub fn trial_name(&self, index: u32) -> String {
        let Cell { map, disturbances, varied, .. } = &self.cell;
        let varied: String = varied.iter().map(|Setting { name, value }| format!("-{name}-{value}")).collect();
        format!("{map}-{}-{disturbances}{varied}-{index:04}", self.cell.controller())
    }

    /// The trial of an index. Start and goal do not depend on the controller.
    pub fn scenario(&self, index: u32) -> Result<Scenario, TrialError> {
        let arena = &self.venue.arena;
        let random =
            arena.random(&self.map, self.cell.controller, self.cell.disturbances, self.seed, u64::from(index))?;
        Ok(Scenario { parameters: self.parameters.clone(), ..random })
    }
}

/// One trial's result.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Episode {
    /// Index of the trial.
    pub index: u32,
    pub scenario: Scenario,
    pub manner: Manner,
    /// Whether the tool came within 2 cm of the goal: the paper's success.
    pub reached: bool,
    /// Whether the bead came within 2 cm of the goal.
    pub delivered: bool,
    pub outcome: String,
    /// What kept sub-controller 2 from the goal at the end, if anything.
    pub trouble: Option<String>,
    /// Why the arm held at the end, if it did.
    pub refusal: Option<String>,
    /// Tracking errors during transport.
    pub tally: Tally,
    /// Path of the tool divided by the shortest path, if the trial delivered.
    pub path_ratio: Option<f64>,
    /// Length of the shortest path of the bead from start to goal, if there is one.
    pub shortest_m: Option<f64>,
    /// Whether the policy was trained on this map; `None` for controllers without a policy.
    pub trained_on_map: Option<bool>,
    /// Control steps.
    pub steps: u32,
    /// Switches of the active sub-controller.
    pub switches: u32,
    /// Number of disturbances applied.
    pub disturbances: u32,
    /// Wall-clock seconds of each control step: camera and decision.
    pub decision_s: Vec<f64>,
    /// The trajectory for the figure; only for a row's first trial.
    pub trace: Option<Box<Trace>>,
}

impl Episode {
    /// Length of a control step at full speed.
    fn step_m(&self) -> f64 {
        self.scenario.parameters.transport_speed_m_s * CONTROL_PERIOD_S
    }

    /// Control steps that its transports may take: one after the start, and one after each disturbance.
    fn limit(&self) -> u32 {
        self.scenario.parameters.step_limit * self.scenario.disturbances.saturating_add(1).min(LEGS_PER_GOAL)
    }

    /// Whether no transport of `step_limit` steps can reach the goal from the start, even on the shortest path.
    pub(super) fn is_beyond_steps(&self) -> bool {
        let most_m = f64::from(self.scenario.parameters.step_limit) * self.step_m() + GOAL_RADIUS_M;
        self.shortest_m.is_some_and(|shortest_m| shortest_m > most_m)
    }

    /// Control steps; without a delivery, all that its transports may take.
    pub(super) fn steps_or_limit(&self) -> u32 {
        if self.delivered { self.steps } else { self.steps.max(self.limit()) }
    }

    /// Path ÷ shortest path; without a delivery, the path of all steps that its transports may take.
    pub(super) fn path_ratio_or_limit(&self) -> Option<f64> {
        if self.delivered {
            return self.path_ratio;
        }
        let shortest_m = self.shortest_m.filter(|&shortest_m| shortest_m > 0.0)?;
        Some(f64::from(self.limit()) * self.step_m() / shortest_m)
    }
}

/// Why an experiment could not run.
#[derive(Debug, thiserror::Error)]
pub enum EvaluateError {
    /// `episodes` is out of range.
    #[error("episodes is {0}, it must be {first} to {last}", first = EPISODES.start(), last = EPISODES.end())]
    Episodes(u32),
    /// `disturbances` is out of range.
    #[error("disturbances is {0}, it must be {first} to {last}", first = DISTURBANCES.start(), last = DISTURBANCES.end())]
    Disturbances(u32),
    /// The trial index is out of range.
    #[error("episode is {index}, it must be 0 to {}", episodes - 1)]
    Episode { index: u32, episodes: u32 },
    /// A recording is incomplete.
    #[error("recording: {0}")]
    NotRecorded(String),
    /// A trial could not be created or continued.
    #[error(transparent)]
    Trial(#[from] TrialError),
    /// The camera could not be created.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// A recording could not start.
    #[error("{0}")]
    Recording(String),
    /// A program did not decide.
    #[error(transparent)]
    Program(#[from] ProgramError),
    /// A parameter cannot have a value.
    #[error("vary: {0}")]
    Vary(#[from] VariationError),
    /// The experiment was cancelled.
    #[error("stopped before its end")]
    Stopped,
}

impl From<MapError> for EvaluateError {
    fn from(error: MapError) -> Self {
        Self::Trial(error.into())
    }
}

/// Creates the sink that records an episode.
pub type Recorders<'a> = &'a (dyn Fn(&Experiment, u32) -> Result<Box<dyn Sink>, EvaluateError> + Sync);

/// Records nothing.
pub fn unrecorded(_: &Experiment, _: u32) -> Result<Box<dyn Sink>, EvaluateError> {
    Ok(Box::new(Nowhere::default()))
}

/// Observers of a running experiment.
pub struct Watch<'a> {
    /// Set to true to cancel: the experiment ends with [`EvaluateError::Stopped`].
    pub stop: &'a AtomicBool,
    /// Called after each trial, with the index of its experiment.
    pub progress: &'a (dyn Fn(usize, &Episode) + Sync),
    /// Creates the sink of each trial.
    pub recorders: Recorders<'a>,
}

/// A camera wrapper that notes whether it was used.
struct Noting<'a> {
    camera: &'a mut dyn ImageSource,
    was_used: bool,
}

impl ImageSource for Noting<'_> {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        self.was_used = true;
        self.camera.capture(subject)
    }
}

/// Runs a trial to its end. `watch` is called after every tick and may cancel it: [`EvaluateError::Stopped`].
pub fn episode(
    scenario: Scenario,
    venue: &Venue,
    camera: &mut dyn ImageSource,
    sink: &mut dyn Sink,
    watch: &mut dyn FnMut(&TickRecord) -> ControlFlow<()>,
) -> Result<Episode, EvaluateError> {
    episode_in(Manner::default(), None, scenario, venue, camera, sink, watch)
}

/// [`episode`], run in a manner.
pub fn episode_in(
    manner: Manner,
    carrier: Option<Carrier<'_>>,
    scenario: Scenario,
    venue: &Venue,
    camera: &mut dyn ImageSource,
    sink: &mut dyn Sink,
    watch: &mut dyn FnMut(&TickRecord) -> ControlFlow<()>,
) -> Result<Episode, EvaluateError> {
    let (mut trial, mut person) = manner.begin(&scenario, &venue.arena)?;
    sink.begin(&trial, Beginning::SetUp);
    let (mut tally, mut course, mut decision_s) = (Tally::default(), Course::default(), Vec::new());
    loop {
        let mut noting = Noting { camera, was_used: false };
        person.act(&mut trial)?;
        let started = Instant::now();
        let record = program::tick(&mut trial, carrier, &mut noting)?;
        if noting.was_used {
            decision_s.push(started.elapsed().as_secs_f64());
        }
        if watch(&record).is_break() {
            return Err(EvaluateError::Stopped);
        }
        sink.record(&record);
        let moment = &record.moment;
        tally.add(moment);
        course.add(moment);
        if !moment.phase.is_final() {
            continue;
        }
        let (counters, delivered) = (moment.counters, moment.phase == Phase::Delivered);
        return Ok(Episode {
            index: 0,
            reached: trial.state().world.reached_tick.is_some(),
            delivered,
            outcome: moment.phase.to_string(),
            trouble: trial.state().controller_state.carrier.trouble().map(|trouble| trouble.to_string()),
            refusal: moment.refusal.as_ref().map(ToString::to_string),
            tally,
            shortest_m: scenario
                .start_m
                .zip(scenario.goal_m)
                .and_then(|(start, goal)| venue.room.shortest_m(start, goal)),
            trained_on_map: (scenario.controller == ControllerName::Rl)
                .then(|| venue.arena.is_trained_on(&scenario.parameters.rl_policy)),
            path_ratio: scenario.goal_m.filter(|_| delivered).and_then(|goal| course.ratio(&venue.room, goal)),
            steps: counters.steps,
            switches: counters.switches,
            // Putting the bead down apart from the tool was counted as one.
            disturbances: counters.disturbances - u32::from(manner.tool_apart),
            decision_s,
            trace: None,
            manner,
            scenario,
        });
    }
}

/// Runs experiments on all threads of the current pool and returns the episodes of each.
pub fn run(experiments: &[Experiment], gpu: &Arc<Gpu>, watch: &Watch<'_>) -> Result<Vec<Vec<Episode>>, EvaluateError> {
    let every =
        experiments.iter().enumerate().flat_map(|(number, one)| (0..one.episodes).map(move |index| (number, index)));
    let mut of_each: Vec<Vec<Episode>> = experiments.iter().map(|_| Vec::new()).collect();
    for (number, episode) in run_trials(experiments, every.collect(), gpu, watch)? {
        of_each[number].push(episode);
    }
    Ok(of_each)
}

/// Runs some trials, each given by the number of its experiment and its index, and returns them in this order.
pub fn run_trials(
    experiments: &[Experiment],
    trials: Vec<(usize, u32)>,
    gpu: &Arc<Gpu>,
    watch: &Watch<'_>,
) -> Result<Vec<(usize, Episode)>, EvaluateError> {
    experiments.iter().try_for_each(check_counts)?;
    let done = trials.into_par_iter().map(|(number, index)| {
        let episode = run_one(&experiments[number], index, gpu, watch)?;
        (watch.progress)(number, &episode);
        Ok((number, episode))
    });
    done.collect()
}

fn check_counts(experiment: &Experiment) -> Result<(), EvaluateError> {
    let Experiment { episodes, cell: Cell { disturbances, .. }, .. } = experiment;
    match () {
        () if !EPISODES.contains(episodes) => Err(EvaluateError::Episodes(*episodes)),
        () if !DISTURBANCES.contains(disturbances) => Err(EvaluateError::Disturbances(*disturbances)),
        () => Ok(()),
    }
}

/// Runs one trial of an experiment with a camera of its venue.
pub fn run_one(
    experiment: &Experiment,
    index: u32,
    gpu: &Arc<Gpu>,
    watch: &Watch<'_>,
) -> Result<Episode, EvaluateError> {
    check_counts(experiment)?;
    if index >= experiment.episodes {
        return Err(EvaluateError::Episode { index, episodes: experiment.episodes });
    }
    let stopped = || watch.stop.load(Ordering::Relaxed);
    if stopped() {
        return Err(EvaluateError::Stopped);
    }
    let venue = &experiment.venue;
    let scenario = experiment.scenario(index)?;
    let mut trace = (index == 0).then(|| Box::new(Trace::of(&venue.arena.map, &scenario)));
    let mut camera = venue.camera(gpu)?;
    let mut sink = (watch.recorders)(experiment, index)?;
    let name = experiment.trial_name(index);
    let carrier = experiment.program.as_deref().map(|program| Carrier { program, trial: &name });
    let ran = episode_in(experiment.manner, carrier, scenario, venue, &mut camera, &mut *sink, &mut |record| {
        if let Some(trace) = &mut trace {
            trace.add(record);
        }
        if stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    if let Some(carrier) = carrier {
        carrier.end();
    }
    let ran = ran?;
    venue.keep(camera);
    sink.finish().map_err(EvaluateError::NotRecorded)?;
    Ok(Episode { index, trace, ..ran })
}
