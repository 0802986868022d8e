//! A laboratory session as a state machine: commands and times in, messages out. It has no thread, clock or channel. Its
//! caller passes the time, as the duration since any fixed moment.
//!
//! [`Session::apply`] carries out a command. [`Session::advance`] makes the next tick if it is due. Both leave messages,
//! which [`Session::take_messages`] returns. [`Session::view`] is what viewers see.

mod advance;
mod apply;
mod asking;
mod branch_point;
#[cfg(test)]
mod command_tests;
mod contest;
mod course;
mod error;
mod facts;
mod history;
mod inputs;
mod kept_runs;
mod opened_case;
mod pacing;
mod playing;
mod recall;
mod saved;
mod timeline;
mod trials;
#[cfg(test)]
mod whole_tests;

use std::sync::Arc;
use std::time::Duration;

use crate::challenge::{Challenge, ChallengeName};
use crate::image::{CameraError, ImageSource};
use crate::plant::PositionerKind;
use crate::scenario::{Parameters, Scenario};
use crate::trial::{
    Arena, Case, Catalog, ControlQuery, Event, Input, LogError, Moment, Origin, RecordingFact, Sight, Sink, Timed,
    Trial, TrialError,
};

pub use asking::PROGRAM_ANSWER_WITHIN;
use asking::ProgramQueries;
pub use branch_point::{BranchPoint, Progress};
pub use course::{Course, CoursePoint};
pub use error::CommandError;
pub use facts::VoidFact;
use history::History;
pub use kept_runs::KeptRunSummary;
pub use opened_case::OpenedCase;
use pacing::Pace;
pub use pacing::{SPEED_MAX, SPEED_MIN};
use playing::Playing;
pub use playing::{Ended, Played, Standing, Void};
pub use saved::Saved;

/// Number of past events that a new viewer receives.
pub const JOURNAL: usize = 500;
/// Maximum ticks of one `Step`.
const STEP_MAX: u32 = 12_500;

/// A command to a session.
#[derive(Clone, Debug)]
pub enum Command {
    /// An input of the trial.
    Input(Input),
    Run,
    Pause,
    /// Advances this many ticks, then pauses.
    Step(u32),
    /// Selects the program of this name as sub-controller 2.
    Attach(String),
    /// Sets the speed, in simulated seconds per second.
    SetSpeed(f64),
    /// Back to the start, with a new seed or the same one.
    Reset(Option<u64>),
    /// A new trial of this scenario, except for the kept parts.
    Load {
        scenario: Box<Scenario>,
        kept: Kept,
    },
    /// A new trial of this challenge, paused, at real speed; a reset without a seed begins it again.
    Play(ChallengeName),
    /// A new trial of this case; its inputs are applied at their ticks.
    Open(Box<Case>),
    /// Back to the last control step at or before this tick; pauses. What lies after it is kept as a run when the trial
    /// goes on.
    Rewind(u64),
    /// Back to the end of the kept run of this number; pauses. The present is kept.
    Return(u32),
    /// The trial goes on from another moment, with inputs that are applied at their ticks; pauses. The present is kept.
    TakeUp {
        moment: Box<Origin>,
        about: String,
        inputs: Vec<Timed>,
    },
}

/// What a session keeps when another scenario is loaded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    pub controller: bool,
    pub seed: bool,
    pub parameters: bool,
}

/// What a session says to its caller.
#[derive(Clone, Debug)]
pub enum Message {
    /// Something has happened.
    Event(Event),
    /// The program is asked; [`Session::answer`] takes the answer.
    Ask {
        /// Counts questions, from 1.
        number: u64,
        query: Box<ControlQuery>,
    },
    /// No answer to this question has come in time: the arm holds for this control step.
    Unanswered { number: u64 },
}

/// The static part of a view, constant between two loads.
#[derive(Clone, Debug)]
pub struct Scenery {
    /// Incremented at each change.
    pub version: u64,
    /// Incremented for each new trial.
    pub trial: u64,
    /// Incremented when the session returns to a kept run, whose events are then sent again.
    pub past_version: u64,
    /// Kept runs, oldest first.
    pub kept_runs: Vec<KeptRunSummary>,
    /// The test case that was opened for this trial.
    pub case: Option<Arc<OpenedCase>>,
    /// The challenge that is being played.
    pub challenge: Option<Arc<Challenge>>,
    /// Maps and policies that can be chosen.
    pub catalog: Catalog,
    /// Map and free space.
    pub arena: Arc<Arena>,
    /// The trial's scenario.
    pub scenario: Scenario,
    pub positioner: PositionerKind,
    pub parameters: Parameters,
}

impl Scenery {
    fn of(trial: &Trial, catalog: Catalog, version: u64, number: u64) -> Self {
        Self {
            version,
            trial: number,
            past_version: 0,
            kept_runs: Vec::new(),
            case: None,
            challenge: None,
            catalog,
            arena: trial.arena().clone(),
            scenario: trial.scenario().clone(),
            positioner: trial.state().world.plant.positioner.kind(),
            parameters: trial.state().world.parameters.clone(),
        }
    }
}

/// The newest state of a session, for viewers.
#[derive(Clone, Debug)]
pub struct View {
    /// The trial.
    pub moment: Moment,
    pub world_hash: u64,
    /// Whether the session is running.
    pub running: bool,
    /// Requested speed, simulated seconds per second.
    pub speed_target: f64,
    /// Achieved speed over the last half second; 0 while paused.
    pub speed_achieved: f64,
    /// Delay of the latest tick of the last half second; zero while paused.
    pub lateness: Duration,
    /// How often the session fell behind so far that it skipped the lost time.
    pub missed_deadlines: u64,
    /// First and last tick that a rewind reaches.
    pub rewind_ticks: (u64, u64),
    /// Where tool and bead were; after a rewind up to its last tick, too.
    pub course: Course,
    /// The static part.
    pub scenery: Arc<Scenery>,
    /// The last observation with its tick.
    pub sight: Arc<(u64, Sight)>,
    /// Events of the trial, oldest first, at most [`JOURNAL`]; without those that a rewind undid.
    pub journal: Arc<Vec<Event>>,
    /// The attempt at the challenge that is being played.
    pub attempt: Option<Standing>,
    /// `recording`, or why nothing is recorded.
    pub recording: RecordingFact,
}

/// How a tick selects a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recalled {
    /// The start of the last control step at or before it.
    Step,
    /// The same, or the present state if it belongs to that tick.
    Present,
}

/// What a session begins with, besides its scenario.
#[derive(Debug)]
pub enum Opening {
    Fresh,
    /// It goes on from here, paused.
    Saved(Saved),
    /// It begins with its scenario; what was saved is kept as runs.
    Beside(Saved),
    /// It starts over and says why.
    Unreadable(LogError),
}

/// What became of a saved session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Resumed {
    /// Tick from which the session went on.
    pub tick: Option<u64>,
    /// Whether something that was saved could not be restored.
    pub has_left_out: bool,
}

/// Creates a camera for an arena.
pub type MakeCamera<E> = Box<dyn Fn(&Arena) -> Result<E, CameraError> + Send>;

/// What a session needs from outside.
pub struct Surroundings<E> {
    /// The maps and policies that it may use.
    pub catalog: Catalog,
    /// Creates its camera.
    pub make_camera: MakeCamera<E>,
    /// Receives its ticks.
    pub sink: Box<dyn Sink>,
}

/// A trial with its past, its pace and everything else that an operator can act on.
pub struct Session<E> {
    trial: Trial,
    make_camera: MakeCamera<E>,
    camera: E,
    sink: Box<dyn Sink>,
    history: History,
    pace: Pace,
    running: bool,
    /// Ticks that are left of a `Step`.
    stepping: u32,
    /// Whether the trial's hand comes from a rewind and no longer belongs to a pointer.
    hand_is_stale: bool,
    playing: Option<Playing>,
    program: ProgramQueries,
    scenery: Arc<Scenery>,
    sight: Arc<(u64, Sight)>,
    messages: Vec<Message>,
    /// The session ends: the camera failed while a command was carried out.
    fault: Option<TrialError>,
}

impl<E: ImageSource> Session<E> {
    /// A session, paused.
    ///
    /// # Errors
    /// [`TrialError`]; the scenario or the camera is refused. What cannot be restored is an event instead.
    pub fn start(
        mut scenario: Scenario,
        opening: Opening,
        surroundings: Surroundings<E>,
        now: Duration,
    ) -> Result<(Self, Resumed), TrialError> {
        let Surroundings { catalog, make_camera, sink } = surroundings;
        catalog.resolve(&mut scenario.parameters)?;
        let arena = catalog.arena(&scenario.map)?;
        let mut camera = make_camera(&arena)?;
        let trial = Trial::new(scenario, arena)?;
        let mut session = Self {
            sight: Arc::new((0, trial.observe(&mut camera)?)),
            scenery: Arc::new(Scenery::of(&trial, catalog, 0, 0)),
            history: History::from_state(trial.snapshot()),
            trial,
            make_camera,
            camera,
            sink,
            pace: Pace::new(1.0, now),
            running: false,
            stepping: 0,
            hand_is_stale: false,
            playing: None,
            program: ProgramQueries::default(),
            messages: Vec::new(),
            fault: None,
        };
        let resumed = session.begin(opening);
        Ok((session, resumed))
    }

    pub fn view(&self) -> View {
        View {
            moment: self.trial.moment(),
            world_hash: self.trial.state().world_hash(),
            running: self.running,
            speed_target: self.pace.factor(),
            speed_achieved: if self.running { self.pace.achieved() } else { 0.0 },
            lateness: if self.running { self.pace.lateness() } else { Duration::ZERO },
            missed_deadlines: self.pace.missed(),
            rewind_ticks: self.history.range(),
            course: self.history.timeline().course().clone(),
            scenery: self.scenery.clone(),
            sight: self.sight.clone(),
            journal: self.history.journal().clone(),
            attempt: self.playing.as_ref().map(|playing| playing.standing(self.trial.state().world.tick)),
            recording: self.sink.status(),
        }
    }

    pub fn trial(&self) -> &Trial {
        &self.trial
    }

    pub fn is_running(&self) -> bool {
        self.running
    }

    /// Whether a `Step` is being carried out.
    pub fn is_stepping(&self) -> bool {
        self.stepping > 0
    }

    /// Requested speed, simulated seconds per second.
    pub fn speed_target(&self) -> f64 {
        self.pace.factor()
    }

    /// Whether everything is recorded, or why not.
    pub fn recording(&self) -> RecordingFact {
        self.sink.status()
    }

    /// What it says since the last call, oldest first.
    pub fn take_messages(&mut self) -> Vec<Message> {
        std::mem::take(&mut self.messages)
    }

    /// Why the session must end: its camera failed while a command was carried out.
    pub fn take_fault(&mut self) -> Option<TrialError> {
        self.fault.take()
    }

    /// Sends an event and stores it in the journal.
    pub fn report(&mut self, event: Event) {
        self.history.report(&event);
        self.messages.push(Message::Event(event));
    }

    /// The same, for an event that no tick carries to the sink.
    fn note(&mut self, event: Event) {
        self.sink.note(&event);
        self.report(event);
    }
}
