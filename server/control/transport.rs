//! Sub-controller 2: carries the bead to the goal, seeing only the camera.

pub mod attractor;

use serde::{Deserialize, Serialize};

use super::{Refusal, TargetStep};
use crate::geometry::Point2;
use crate::perception::Percept;
use crate::scenario::{ControllerName, Parameters};

/// All that a transport may know at a control step.
#[derive(Clone, Copy, Debug)]
pub struct TransportInput<'a> {
    /// The frame just taken.
    pub percept: &'a Percept,
    /// Tool, in the plane.
    pub tool_m: Point2<f64>,
    /// Goal.
    pub goal_m: Point2<f64>,
    /// Parameters in force.
    pub parameters: &'a Parameters,
}

/// One way to carry the bead.
pub trait Transport {
    /// Forgets what belongs to the last leg: the goal moved or the bead was fetched anew.
    fn start_leg(&mut self);

    /// The next step, or why there is none.
    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal>;
}

/// A transport with its memory, so that a snapshot can hold it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Carrier {
    /// Attractor dynamics.
    Attractor(attractor::Attractor),
}

impl Carrier {
    /// A fresh transport of this name.
    pub fn new(name: ControllerName) -> Self {
        match name {
            ControllerName::Attractor => Self::Attractor(attractor::Attractor::default()),
        }
    }

    /// The transport inside.
    pub fn transport(&mut self) -> &mut dyn Transport {
        match self {
            Self::Attractor(attractor) => attractor,
        }
    }

    /// Obstacles that the last step was decided on, for the page.
    pub fn sensed(&self) -> &[attractor::Superellipse] {
        match self {
            Self::Attractor(attractor) => attractor.sensed(),
        }
    }
}
