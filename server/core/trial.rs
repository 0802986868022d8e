//! The trial: one episode as a pure loop. Live sessions, evaluation, replay and tests all run this loop.
//!
//! It is deterministic: scenario, seed and inputs determine the state at every tick. It reads no clock and
//! draws random numbers only from the generator in its state. The camera is passed in through [`ImageSource`], so
//! recorded frames or recorded decisions can replace it.

mod arena;
mod case;
mod catalog;
mod control_query;
mod decide;
mod disturb;
mod entry;
mod event;
mod facts;
mod input;
mod input_error;
mod log;
mod origin;
mod outcome;
mod phase;
mod record;
mod replay;
mod resume;
mod script;
mod sink;
mod state;
mod tally;

use std::sync::Arc;

use rand::Rng;

use crate::control::{approach, step_is_due};
use crate::geometry::{Point2, Point3, Vector2};
use crate::image::CameraFrame;
use crate::image::{CameraError, ImageSource, Subject};
use crate::map::MapError;
use crate::plant::{Plant, PlantState, Positioner, PositionerKind, Surroundings, Walls};
use crate::policy::PolicyError;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{ParameterError, RandomTrialError, Scenario, Stream, start_point};
use crate::tracking::{self, TrackerParameters};

pub use arena::Arena;
pub use case::{Case, CaseError, CaseOutcome, Expectation, Timed};
pub use catalog::Catalog;
pub use control_query::{ControlQuery, Leg};
pub use decide::Question;
pub use disturb::far_point;
pub use entry::{Entry, LoggedBeginning, LoggedMap, LoggedTick};
pub use event::{Event, EventKind, Happening, Resumption};
pub use facts::{PhaseFact, RecordingFact, StopCode};
pub use input::Input;
pub use input_error::{InputError, REASON_BYTES_MOST};
pub use log::{InputLog, LogError, LogWriter};
pub use origin::Origin;
pub use outcome::GOAL_RADIUS_M;
pub use phase::{LEGS_PER_GOAL, Phase, SETTLE_S, StopReason};
pub use record::{Moment, Seen, Sight, TickRecord};
pub use replay::{Deciding, MakeCamera, ReplayError, Replayed, replay};
pub use resume::StateError;
pub use script::Script;
pub use sink::{Beginning, Nowhere, Sink};
pub use state::{ControllerState, Counters, Decision, Motion, Past, TrialState, World, WorldHashes};
pub use tally::Tally;

/// Why a trial could not be created or continued.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
    #[error(transparent)]
    Map(#[from] MapError),
    /// No valid start was found.
    #[error(transparent)]
    Random(#[from] RandomTrialError),
    /// A parameter is out of range.
    #[error("parameters: {0}")]
    Parameter(#[from] ParameterError),
    /// There is no such policy.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// Start or goal is impossible.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A scripted disturbance is impossible.
    #[error("script[{index}]: {error}")]
    Script {
        /// Index in the script, from 0.
        index: usize,
        error: InputError,
    },
    /// The script has more entries than allowed.
    #[error("script has {entries} disturbances, the limit is {}", crate::scenario::SCRIPT_LIMIT)]
    LongScript { entries: usize },
    /// The state in a file is not a valid state.
    #[error(transparent)]
    State(#[from] StateError),
    /// The camera delivered no image.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The operating system could not start a thread.
    #[error("the session's thread could not start: {0}")]
    Thread(String),
    /// A simulated value became NaN or infinite; the state is unusable.
    #[error("tick {tick}: {what} is no longer a finite number")]
    NotFinite { tick: u64, what: &'static str },
    /// A replay needs a decision at this tick, but the log does not contain it.
    #[error("log: no decision at tick {tick}")]
    MissingDecision { tick: u64 },
}

/// Source of a control step's decision.
pub enum Source<'a> {
    /// The camera: the controllers decide from its image.
    Camera(&'a mut dyn ImageSource),
    /// What [`Trial::see`] has returned since the last tick: the controllers decide from it.
    Seen(Box<Seen>),
    /// A log: the logged decision is carried out.
    Logged(Option<Decision>),
}

/// One episode.
#[derive(Clone, Debug)]
pub struct Trial {
    scenario: Scenario,
    arena: Arc<Arena>,
    plant: Plant,
    /// Of the walls' contractions.
    wall_seed: u64,
    state: TrialState,
    /// Control steps before this count toward no limit; see [`Self::renew_steps`].
    free_steps: u32,
    /// Inputs since the last tick, for the log.
    inputs: Vec<Input>,
    events: Vec<Event>,
}

impl Trial {
    /// Creates the trial of a scenario. `arena` must be made from the scenario's map.
    pub fn new(scenario: Scenario, arena: Arc<Arena>) -> Result<Self, TrialError> {
        scenario.parameters.check()?;
        let kind = scenario.positioner.unwrap_or_else(|| PositionerKind::of(&arena.map));
        let above = |start| arena.above(start, kind, &scenario.parameters);
        let start = match scenario.start_m {
            Some(start) => start,
            None => start_point(&arena.map, &arena.space, scenario.seed, &|start| above(start).is_ok())?,
        };
        input::check_place("start_m", start, &arena.map)?;
        Self::check_script(&scenario.script, &arena.map)?;
        let (tool_m, positioner) = above(start).map_err(|refusal| InputError::Reach { field: "start_m", refusal })?;
        let plant = Plant::new(scenario.parameters.plant());
        let state = TrialState::at_start(&scenario, arena.map.workspace(), tool_m, positioner);
        let wall_seed = Stream::Walls.rng(scenario.seed).next_u64();
        let (inputs, events, free_steps) = (Vec::new(), Vec::new(), 0);
        let mut trial = Self { arena, plant, wall_seed, state, free_steps, inputs, events, scenario };
        if let Some(goal) = trial.scenario.goal_m {
            trial.apply(Input::SetGoal { x_m: goal.x, y_m: goal.y })?;
            // Part of the scenario, not of the log.
            trial.inputs.clear();
        }
        Ok(trial)
    }

    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    pub fn arena(&self) -> &Arc<Arena> {
        &self.arena
    }

    /// Inputs that wait for the next tick.
    pub fn waiting_inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// A copy of the complete state; see [`Self::restore`].
    pub fn snapshot(&self) -> TrialState {
        self.state.clone()
    }

    pub fn state(&self) -> &TrialState {
        &self.state
    }

    /// Returns to a snapshot of the same scenario.
    pub fn restore(&mut self, state: TrialState) {
        self.plant = Plant::new(state.world.parameters.plant());
        self.state = state;
        self.free_steps = 0;
        self.inputs.clear();
        self.events.clear();
    }

    /// The tool point.
    pub fn tool_m(&self) -> Point3<f64> {
        self.state.world.plant.positioner.tool_m()
    }

    /// The scene that a camera without latency would render now.
    pub fn subject(&self) -> Subject {
        let PlantState { positioner, bead, walls, .. } = self.state.world.plant;
        self.subject_at(Past { positioner, bead, walls }, 0)
    }

    /// The walls now.
    fn walls(&self) -> Walls<'_> {
        let world = &self.state.world;
        self.surroundings().walls(world.plant.walls.as_ref(), world.tick)
    }

    fn surroundings(&self) -> Surroundings<'_> {
        self.arena.surroundings(self.wall_seed)
    }

    fn subject_at(&self, Past { positioner, bead, walls }: Past, age_ticks: u64) -> Subject {
        let world = &self.state.world;
        let tool = positioner.tool_m();
        Subject {
            tick: world.tick - age_ticks,
            tool_m: tool.coords.into(),
            turn_rad: positioner.turn_rad(),
            bead_m: [bead.position_m.x, bead.position_m.y, bead.height_m(tool)],
            goal_m: world.goal_m.map(|goal| [goal.x, goal.y]),
            link_frames: positioner.link_frames(),
            block_size_m: self.plant.block_size_m(),
            mount: world.parameters.camera_mount(),
            moved_walls: self
                .surroundings()
                .bands(walls.as_ref(), world.tick - age_ticks, bead.position_m)
                .map(Arc::from),
        }
    }

    /// The image that the controllers get now, with the camera's latency and noise.
    pub fn capture(&self, camera: &mut dyn ImageSource) -> Result<CameraFrame, CameraError> {
        let world = &self.state.world;
        let subject = match world.past.front() {
            Some(&past) => self.subject_at(past, world.past.len() as u64),
            None => self.subject(),
        };
        let mut frame = camera.capture(&subject)?;
        let noise_levels = world.parameters.camera_noise_levels;
        if noise_levels > 0.0 {
            let seed = world.script.seed(self.scenario.seed);
            frame.picture.add_noise(noise_levels, &mut Stream::Camera(world.tick as u32).rng(seed));
        }
        Ok(frame)
    }

    /// Magnet's pull on the bead now.
    pub fn load(&self) -> crate::plant::Load {
        let plant = &self.state.world.plant;
        self.plant.load(&plant.positioner.base_from_tool(), plant.bead.position_m)
    }

    /// Advances one servo period of 8 ms. If the camera fails, the state is unchanged.
    pub fn tick(&mut self, source: Source<'_>) -> Result<TickRecord, TrialError> {
        let tick = self.state.world.tick;
        if !self.inputs.iter().any(|input| matches!(input, Input::Mirror { .. })) {
            self.state.world.plant.mirror = None;
        }
        let mut decision = None;
        let mut seen = None;
        if step_is_due(tick) {
            let sees = match source {
                Source::Camera(camera) => Ok(self.see(camera)?),
                Source::Seen(sees) => Ok(*sees),
                Source::Logged(logged) => Err(logged.ok_or(TrialError::MissingDecision { tick })?),
            };
            let decided = match sees {
                Ok(sees) => {
                    let decided = self.decide(&sees.frame, &sees.percept);
                    seen = Some(sees);
                    decided
                }
                Err(logged) => logged,
            };
            self.carry_out(&decided);
            decision = Some(decided);
        }
        self.apply_scripted(None);
        let PlantState { positioner, bead, walls, .. } = self.state.world.plant;
        let before = Past { positioner, bead, walls };
        self.advance_reference();
        self.check_finite(tick)?;
        self.remember(before);
        self.sense();
        self.state.world.tick += 1;
        self.judge();
        Ok(self.record(decision, seen))
    }

    /// Moves the tool's reference along the motion; arm and bead follow.
    fn advance_reference(&mut self) {
        let is_led = self.state.is_led_from_outside();
        let world = &mut self.state.world;
        let limits = self.arena.limits(&world.parameters);
        let here = world.reference_m.xy();
        let reference = world.reference;
        let wanted: Point2<f64> = match world.motion {
            Motion::Joints(joints_rad) => {
                world.reference = Positioner::Arm(joints_rad);
                world.reference_m = world.reference.tool_m();
                return self.follow(&reference);
            }
            // Also at another height than the parameters'.
            Motion::Hold if is_led => return self.follow(&reference),
            Motion::Hold => here,
            Motion::Segment(step) => {
                let way: Vector2<f64> = step.target_m - here;
                here + way.cap_magnitude(step.speed_m_s * SERVO_PERIOD_S)
            }
            Motion::Track if world.tracker.is_lost(world.parameters.tracker_timeout_s) => here,
            Motion::Track => {
                let speed = world.parameters.approach_speed_m_s;
                let velocity = approach::velocity(here, &world.tracker.estimate(), speed);
                limits.keep_in(here + velocity * SERVO_PERIOD_S)
            }
        };
        let wanted_m = Point3::new(wanted.x, wanted.y, world.parameters.tool_height_m);
        // A motion beyond the reach stops at its edge.
        if let Ok((next_m, next)) = limits.advance(world.reference_m, wanted_m, &reference) {
            world.reference_m = next_m;
            world.reference = next;
        }
        self.follow(&reference);
    }

    /// Arm and bead follow the reference, which was at `before`.
    fn follow(&mut self, before: &Positioner) {
        let around = self.arena.surroundings(self.wall_seed);
        let world = &mut self.state.world;
        self.plant.step(&mut world.plant, &around, world.tick, before, &world.reference);
    }

    fn check_finite(&self, tick: u64) -> Result<(), TrialError> {
        let world = &self.state.world;
        let is_finite = |coordinates: &[f64]| coordinates.iter().all(|value| value.is_finite());
        let what = if !is_finite(world.plant.bead.position_m.coords.as_slice()) {
            "the bead's position"
        } else if !is_finite(self.tool_m().coords.as_slice()) {
            "the tool's position"
        } else {
            return Ok(());
        };
        Err(TrialError::NotFinite { tick, what })
    }

    /// Keeps the states that a camera with latency will show.
    fn remember(&mut self, before: Past) {
        let world = &mut self.state.world;
        world.past.push_back(before);
        while world.past.len() > world.parameters.camera_latency_ticks as usize {
            world.past.pop_front();
        }
    }

    fn sense(&mut self) {
        let tool_m = self.tool_m();
        let World { plant, parameters, script, tracker, tick, .. } = &mut self.state.world;
        let bead_m = plant.bead.position_m;
        let bead_top_m = Point3::new(bead_m.x, bead_m.y, plant.bead.height_m(tool_m));
        let is_hidden = *tick < script.dropout_until
            || parameters.tracker_is_hidden_by_arm
                && tracking::is_hidden(bead_top_m, tool_m, plant.positioner.link_frames().as_ref());
        let quality = TrackerParameters {
            noise_m: parameters.tracker_noise_m,
            bias_m: Vector2::new(parameters.tracker_bias_x_m, parameters.tracker_bias_y_m),
            drift_m: parameters.tracker_drift_m,
            latency_ticks: parameters.tracker_latency_ticks,
            dropout: parameters.tracker_dropout,
        };
        tracker.sample((!is_hidden).then_some(bead_m), &quality);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::EmptyFloor;

    #[test]
    fn a_position_that_is_not_a_number_ends_the_trial() {
        let arena = Arena::shipped("posts").unwrap();
        let mut trial = Trial::new(Scenario::idle("posts", 1), arena).unwrap();
        let mut camera = EmptyFloor::default();
        trial.tick(Source::Camera(&mut camera)).unwrap();
        trial.state.world.plant.bead.position_m.x = f64::NAN;
        let refused = trial.tick(Source::Camera(&mut camera)).unwrap_err();
        assert_eq!(refused.to_string(), "tick 1: the bead's position is no longer a finite number");
    }
}
