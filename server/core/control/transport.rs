//! Sub-controller 2: carries the bead to the goal, using only the camera.

pub mod attractor;
pub mod errt;
pub mod planning;
pub mod program;
mod progress;
pub mod replanner;
pub mod rl;
pub mod robot;
pub mod you;

use serde::{Deserialize, Serialize};

use super::{Refusal, TargetStep};
use crate::geometry::Point2;
use crate::perception::{ObstacleMap, Percept};
use crate::policy::Policy;
use crate::scenario::{ControllerName, Parameters};

/// Everything that a transport may use at a control step.
#[derive(Clone, Copy, Debug)]
pub struct TransportInput<'a> {
    /// The current frame.
    pub percept: &'a Percept,
    /// The obstacle map of all frames so far.
    pub known: &'a ObstacleMap,
    /// Tool position in the plane.
    pub tool_m: Point2<f64>,
    pub goal_m: Point2<f64>,
    pub parameters: &'a Parameters,
    /// The loaded policy; only [`rl::Rl`] needs one.
    pub policy: Option<&'a Policy>,
}

/// Why a transport makes no progress, for the page and for the table of failures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Trouble {
    /// The flow vanishes at a place that is not the goal: a saddle or another sink.
    Saddle,
    /// The tool moves, but makes no progress.
    Circling,
    /// The tool is inside a sensed obstacle.
    InsideObstacle,
    /// The same step is refused repeatedly.
    Refused,
    /// No path was found yet.
    Searching,
    /// No path to the goal exists.
    WalledOff,
    /// Moving walls have closed all paths.
    Closed,
}

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Saddle => "stuck where the flow ends before the goal",
            Self::Circling => "going to and fro without getting nearer",
            Self::InsideObstacle => "too near a wall to go on",
            Self::Refused => "blocked: each step is refused",
            Self::Searching => "no path found yet",
            Self::WalledOff => "walled off",
            Self::Closed => "waiting for a closed segment to open",
        })
    }
}

/// A method that carries the bead.
pub trait Transport {
    /// Forgets the state of the last leg: the goal was moved, or the bead was fetched again.
    fn start_leg(&mut self);

    /// The next step, or why no step is taken.
    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal>;

    /// Why the last step made no progress; `None` if it did.
    fn trouble(&self) -> Option<Trouble>;
}

/// A transport with its memory, so that a snapshot can contain it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Carrier {
    Rl(Box<rl::Rl>),
    Errt(Box<errt::Errt>),
    Attractor(attractor::Attractor),
    Replanner(replanner::Replanner),
    You(you::You),
    Program(program::Program),
    Robot(robot::Robot),
}

impl Carrier {
    /// A new transport of this kind. All its randomness comes from `seed`.
    pub fn new(name: ControllerName, seed: u64) -> Self {
        match name {
            ControllerName::Rl => Self::Rl(Box::default()),
            ControllerName::Errt => Self::Errt(Box::new(errt::Errt::new(seed))),
            ControllerName::Attractor => Self::Attractor(attractor::Attractor::default()),
            ControllerName::Replanner => Self::Replanner(replanner::Replanner::default()),
            ControllerName::You => Self::You(you::You::default()),
            ControllerName::Program => Self::Program(program::Program::default()),
            ControllerName::Robot => Self::Robot(robot::Robot),
        }
    }

    /// All further random numbers come from `seed`; the memory stays.
    pub fn reseed(&mut self, seed: u64) {
        if let Self::Errt(errt) = self {
            errt.reseed(seed);
        }
    }

    pub fn rl(&self) -> Option<&rl::Rl> {
        if let Self::Rl(rl) = self { Some(rl) } else { None }
    }

    pub fn errt(&self) -> Option<&errt::Errt> {
        if let Self::Errt(errt) = self { Some(errt) } else { None }
    }

    pub fn attractor(&self) -> Option<&attractor::Attractor> {
        if let Self::Attractor(attractor) = self { Some(attractor) } else { None }
    }

    pub fn you(&self) -> Option<&you::You> {
        if let Self::You(you) = self { Some(you) } else { None }
    }

    /// See [`Transport::trouble`].
    pub fn trouble(&self) -> Option<Trouble> {
        match self {
            Self::Rl(rl) => rl.trouble(),
            Self::Errt(errt) => errt.trouble(),
            Self::Attractor(attractor) => attractor.trouble(),
            Self::Replanner(replanner) => replanner.trouble(),
            Self::You(you) => you.trouble(),
            Self::Program(program) => program.trouble(),
            Self::Robot(robot) => robot.trouble(),
        }
    }

    pub fn transport(&mut self) -> &mut dyn Transport {
        match self {
            Self::Rl(rl) => rl.as_mut(),
            Self::Errt(errt) => errt.as_mut(),
            Self::Attractor(attractor) => attractor,
            Self::Replanner(replanner) => replanner,
            Self::You(you) => you,
            Self::Program(program) => program,
            Self::Robot(robot) => robot,
        }
    }
}
