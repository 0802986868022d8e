//! Replay of an input log: runs the trial again from the same inputs and compares the hashes at every tick.

use std::sync::Arc;

use super::entry::{Entry, LoggedBeginning, LoggedTick};
use super::log::InputLog;
use super::{Arena, InputError, Source, TickRecord, Trial, TrialError, TrialState, World};
use crate::image::{CameraError, ImageSource};
use crate::map::MapError;
use crate::policy::{Policies, Shipped};

/// Result of a replay without differences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Replayed {
    pub trials: u32,
    /// How often a trial continued from another state: after a rewind, or at the start of a file.
    pub resumed: u32,
    /// Number of ticks, all equal.
    pub ticks: u64,
}

/// Why a replay ended early.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    /// The map in the log cannot be read.
    #[error("trial {trial}: {error}")]
    Map {
        /// Number of the trial in the log, from 1.
        trial: u32,
        error: MapError,
    },
    /// A trial could not be created or continued.
    #[error("trial {trial}, tick {tick}: {error}")]
    Trial {
        /// Number of the trial in the log, from 1.
        trial: u32,
        tick: u64,
        error: TrialError,
    },
    /// The decisions cannot be repeated because the policy is missing.
    #[error(
        "trial {trial}: its policy (hash {policy_hash:016x}) is not shipped with Ferry, so its decisions cannot be made \
         again; without a camera the logged decisions are carried out"
    )]
    Policy {
        /// Number of the trial in the log, from 1.
        trial: u32,
        /// Hash of the policy file.
        policy_hash: u64,
    },
    /// An input of the log is rejected now.
    #[error("trial {trial}, tick {tick}: an input of the log is refused: {error}")]
    Refused {
        /// Number of the trial in the log, from 1.
        trial: u32,
        tick: u64,
        error: InputError,
    },
    /// The first tick that differs.
    #[error("trial {trial}: the first difference is at tick {tick}, in {}", fields.join(", "))]
    Differs {
        /// Number of the trial in the log, from 1.
        trial: u32,
        tick: u64,
        /// Names of the parts that differ.
        fields: Vec<&'static str>,
    },
}

/// Creates cameras for the arenas of a log.
pub type MakeCamera<'a> = &'a mut dyn FnMut(&Arena) -> Result<Box<dyn ImageSource>, CameraError>;

/// What is needed to decide again.
pub struct Deciding<'a> {
    pub make_camera: MakeCamera<'a>,
    /// Policies that the trials may have selected.
    pub policies: Arc<dyn Policies>,
}

/// Runs a log again from its decisions. With `deciding`, every decision is made again from the camera images, and
/// the controller's state is compared too. `watch` is called after each tick.
///
/// # Errors
/// [`ReplayError`].
pub fn replay(
    log: &InputLog,
    mut deciding: Option<Deciding<'_>>,
    watch: &mut dyn FnMut(&TickRecord),
) -> Result<Replayed, ReplayError> {
    let mut replayed = Replayed::default();
    let mut arena: Option<Arc<Arena>> = None;
    let mut running: Option<(Trial, Option<Box<dyn ImageSource>>)> = None;
    for entry in &log.entries {
        match entry {
            Entry::Begin(beginning) => {
                match beginning.state {
                    Some(_) => replayed.resumed += 1,
                    None => replayed.trials += 1,
                }
                let number = replayed.trials.max(1);
                if let (Some(policy_hash), Some(_)) = (beginning.policy_hash, &deciding) {
                    return Err(ReplayError::Policy { trial: number, policy_hash });
                }
                if let Some(map) = &beginning.map {
                    let map = map.map().map_err(|error| ReplayError::Map { trial: number, error })?;
                    let policies = deciding.as_ref().map(|deciding| deciding.policies.clone());
                    arena = Some(Arena::with_policies(map, policies.unwrap_or_else(|| Arc::new(Shipped))));
                }
                // The first entry of a log always contains a map.
                let Some(arena) = &arena else { continue };
                running = Some(begin(beginning, arena, &mut deciding).map_err(|error| {
                    let tick = beginning.state.as_ref().map_or(0, |state| state.world.tick);
                    ReplayError::Trial { trial: number, tick, error }
                })?);
            }
            Entry::Tick(logged) => {
                let Some((trial, camera)) = &mut running else { continue };
                let record = repeat(trial, camera.as_deref_mut(), logged, replayed.trials.max(1))?;
                replayed.ticks += 1;
                watch(&record);
            }
        }
    }
    Ok(replayed)
}

fn begin(
    beginning: &LoggedBeginning,
    arena: &Arc<Arena>,
    deciding: &mut Option<Deciding<'_>>,
) -> Result<(Trial, Option<Box<dyn ImageSource>>), TrialError> {
    let mut trial = Trial::new(beginning.scenario.clone(), arena.clone())?;
    trial.take_events();
    if let Some(state) = &beginning.state {
        trial.resume(TrialState::clone(state))?;
    }
    let camera = deciding.as_mut().map(|deciding| (deciding.make_camera)(arena)).transpose()?;
    Ok((trial, camera))
}

fn repeat(
    trial: &mut Trial,
    camera: Option<&mut (dyn ImageSource + 'static)>,
    logged: &LoggedTick,
    number: u32,
) -> Result<TickRecord, ReplayError> {
    let tick = trial.state().world.tick + 1;
    for input in &logged.inputs {
        trial.apply(input.clone()).map_err(|error| ReplayError::Refused { trial: number, tick, error })?;
    }
    let sees = camera.is_some();
    let source = match camera {
        Some(camera) => Source::Camera(camera),
        None => Source::Logged(logged.decision.clone()),
    };
    let record = trial.tick(source).map_err(|error| ReplayError::Trial { trial: number, tick, error })?;
    let found = LoggedTick::from(&record);
    let same = found.tick == logged.tick
        && found.inputs == logged.inputs
        && found.decision == logged.decision
        && found.world_hash == logged.world_hash
        && (!sees || found.controller_hash == logged.controller_hash);
    if same {
        return Ok(record);
    }
    Err(ReplayError::Differs { trial: number, tick, fields: differences(&found, logged, sees) })
}

fn differences(found: &LoggedTick, logged: &LoggedTick, sees: bool) -> Vec<&'static str> {
    let mut fields = Vec::new();
    let mut note = |differs: bool, name| {
        if differs {
            fields.push(name);
        }
    };
    note(found.decision != logged.decision, "decision");
    let hashes = found.fields.chunks(2).zip(logged.fields.chunks(2));
    for (name, (found, logged)) in World::FIELDS.iter().zip(hashes) {
        note(found != logged, name);
    }
    note(sees && found.controller_hash != logged.controller_hash, "mind");
    if fields.is_empty() {
        // By chance, one pair of hashes in 65,536 has equal lowest 16 bits.
        fields.push("world");
    }
    fields
}
