//! Sub-controller 2: carries the bead to the goal, seeing only the camera.

pub mod attractor;
pub mod errt;
mod progress;
pub mod rl;

use serde::{Deserialize, Serialize};

use super::{Refusal, TargetStep};
use crate::geometry::Point2;
use crate::perception::{ObstacleMap, Percept};
use crate::policy::Policy;
use crate::scenario::{ControllerName, Parameters};

/// All that a transport may know at a control step.
#[derive(Clone, Copy, Debug)]
pub struct TransportInput<'a> {
    /// The frame just taken.
    pub percept: &'a Percept,
    /// All that the camera has shown up to now.
    pub known: &'a ObstacleMap,
    /// Tool, in the plane.
    pub tool_m: Point2<f64>,
    /// Goal.
    pub goal_m: Point2<f64>,
    /// Parameters in force.
    pub parameters: &'a Parameters,
    /// The policy in use; only [`rl::Rl`] asks for one.
    pub policy: Option<&'a Policy>,
}

/// What keeps a transport from its goal, for the page and for the table of failures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Trouble {
    /// The flow stands still where it should not: a saddle, or a sink that is not the goal.
    Saddle,
    /// The tool moves, but gets nowhere.
    Circling,
    /// The tool is inside of what it takes for an obstacle.
    InsideObstacle,
    /// The step that is wanted is refused, again and again.
    Refused,
    /// No way was found yet.
    Searching,
    /// No way leads to the goal.
    WalledOff,
}

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Saddle => "trapped where the flow stands still",
            Self::Circling => "moving without getting nearer",
            Self::InsideObstacle => "inside an obstacle",
            Self::Refused => "standing before a step that is refused",
            Self::Searching => "no way found yet",
            Self::WalledOff => "walled off",
        })
    }
}

/// One way to carry the bead.
pub trait Transport {
    /// Forgets what belongs to the last leg: the goal moved or the bead was fetched anew.
    fn start_leg(&mut self);

    /// The next step, or why there is none.
    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal>;

    /// What kept it from its goal at the last step, if anything did.
    fn trouble(&self) -> Option<Trouble>;
}

/// A transport with its memory, so that a snapshot can hold it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Carrier {
    /// Rainbow-IQN.
    Rl(Box<rl::Rl>),
    /// ERRT.
    Errt(Box<errt::Errt>),
    /// Attractor dynamics.
    Attractor(attractor::Attractor),
}

impl Carrier {
    /// A fresh transport of this name; what it draws at random comes from the seed.
    pub fn new(name: ControllerName, seed: u64) -> Self {
        match name {
            ControllerName::Rl => Self::Rl(Box::default()),
            ControllerName::Errt => Self::Errt(Box::new(errt::Errt::new(seed))),
            ControllerName::Attractor => Self::Attractor(attractor::Attractor::default()),
        }
    }

    /// See [`Transport::trouble`].
    pub fn trouble(&self) -> Option<Trouble> {
        match self {
            Self::Rl(rl) => rl.trouble(),
            Self::Errt(errt) => errt.trouble(),
            Self::Attractor(attractor) => attractor.trouble(),
        }
    }

    /// The transport inside.
    pub fn transport(&mut self) -> &mut dyn Transport {
        match self {
            Self::Rl(rl) => rl.as_mut(),
            Self::Errt(errt) => errt.as_mut(),
            Self::Attractor(attractor) => attractor,
        }
    }
}
