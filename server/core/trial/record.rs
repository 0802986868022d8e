//! The record of a tick, for viewers, recordings and tests.

use std::sync::Arc;

use super::state::{Counters, TrialState, WorldHashes};
use super::{Decision, Event, Input, Motion, Phase, Trial};
use crate::control::switching::{self, Reason};
use crate::control::transport::rl::Rl;
use crate::control::transport::you::{Steering, You};
use crate::control::transport::{Carrier, Trouble};
use crate::control::{Refusal, step_is_due};
use crate::facts::Told;
use crate::geometry::{Point2, Point3, Vector2};
use crate::image::CameraFrame;
use crate::image::{CameraError, ImageSource};
use crate::perception::{Observation, ObstacleMap, Percept, Quadtree, QuadtreeParameters};
use crate::plant::{Hand, Load, Plant, Positioner, WallMotion};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::ControllerName;

/// What the controller observed and computed at a control step.
#[derive(Clone, Debug)]
pub struct Sight {
    pub frame: Arc<CameraFrame>,
    /// The perception's result for the frame.
    pub percept: Percept,
    /// Tool point when the frame was taken.
    pub tool_m: Point2<f64>,
    pub goal_m: Option<Point2<f64>>,
    /// The obstacle map accumulated so far.
    pub known: ObstacleMap,
    /// Parameters of the image's blocks.
    pub quadtree: QuadtreeParameters,
    /// Whether the network gets the image that the default camera would take.
    pub corrects_image: bool,
    /// Sub-controller 2 after its decision.
    pub carrier: Carrier,
}

impl Sight {
    /// The network's observation. If the policy has a memory, its survey is drawn in place of the image.
    pub fn observation(&self) -> Observation {
        if let Some(survey) = self.carrier.rl().and_then(Rl::survey) {
            return Observation::new(&survey.picture(), self.goal_m, self.tool_m, self.known.workspace());
        }
        let gray = self.percept.for_network(self.corrects_image, self.tool_m, &self.known);
        Observation::new(&gray, self.goal_m, self.tool_m, self.known.workspace())
    }

    /// The blocks of the image.
    pub fn blocks(&self) -> Quadtree {
        Quadtree::of(&self.percept.gray, &self.quadtree)
    }
}

#[derive(Clone, Debug)]
pub struct TickRecord {
    /// Ticks since the start, this one included.
    pub tick: u64,
    /// Inputs applied since the last tick.
    pub inputs: Vec<Input>,
    /// The control step's decision, if one was due.
    pub decision: Option<Decision>,
    /// The observation for it; `None` in a replay from logged decisions.
    pub sight: Option<Sight>,
    /// Events of this tick.
    pub events: Vec<Event>,
    /// The state after the tick.
    pub moment: Moment,
    /// See [`super::TrialState::world_hash`].
    pub world: WorldHashes,
    /// See [`super::TrialState::controller_hash`].
    pub controller_hash: u64,
}

/// A summary of a trial's state, for viewers.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Ticks since the start.
    pub tick: u64,
    /// Tool point.
    pub tool_m: Point3<f64>,
    /// True position of the bead.
    pub bead_m: Point3<f64>,
    /// Position of the bead from the tracker.
    pub tracked_m: Point2<f64>,
    pub goal_m: Option<Point2<f64>>,
    /// Target of the hand, while it holds the bead.
    pub hand: Option<Hand>,
    pub hand_force_n: f64,
    /// Where a person points the tool, if one does.
    pub steering: Option<Steering>,
    pub positioner: Positioner,
    /// Active sub-controller, and why.
    pub switching: switching::Decision,
    /// Sub-controller 2 in use.
    pub controller: ControllerName,
    /// What the tool's reference does.
    pub motion: Motion,
    /// Progress of the task.
    pub phase: Phase,
    /// Why the arm holds, if a step was refused.
    pub refusal: Option<Refusal>,
    /// Why the transport makes no progress, if it makes none.
    pub trouble: Option<Trouble>,
    /// Magnetic load on the bead.
    pub load: Load,
    /// Contractions of the walls; `None` at rest.
    pub walls: Option<WallMotion>,
    pub counters: Counters,
}

impl Moment {
    /// Simulated time.
    pub fn sim_time_s(&self) -> f64 {
        self.tick as f64 * SERVO_PERIOD_S
    }

    /// Why the active sub-controller is active.
    pub fn reason(&self) -> Told<Reason> {
        match self.phase {
            Phase::LiftedOff => Reason::LiftedOff.told(),
            _ => self.switching.reason(),
        }
    }

    /// Tracking error: tool minus bead in the plane.
    pub fn tracking_error_m(&self) -> Vector2<f64> {
        self.tool_m.xy() - self.bead_m.xy()
    }
}

/// The camera frame of a control step, and the tool point when it was taken.
#[derive(Clone, Debug)]
pub struct Seen {
    pub frame: CameraFrame,
    pub percept: Percept,
    pub tool_m: Point2<f64>,
}

impl Trial {
    /// Whether the next tick is a control step.
    pub fn step_is_due(&self) -> bool {
        step_is_due(self.state.world.tick)
    }

    /// What the controllers see now. The trial does not change.
    ///
    /// # Errors
    /// The camera delivered no image.
    pub fn see(&self, camera: &mut dyn ImageSource) -> Result<Seen, CameraError> {
        let tool_m = self.tool_m().xy();
        let frame = self.capture(camera)?;
        let percept = Percept::of(&frame, tool_m);
        Ok(Seen { frame, percept, tool_m })
    }

    pub fn moment(&self) -> Moment {
        let world = &self.state.world;
        let tool_m = self.tool_m();
        let bead = world.plant.bead;
        Moment {
            tick: world.tick,
            tool_m,
            bead_m: Point3::new(bead.position_m.x, bead.position_m.y, bead.height_m(tool_m)),
            tracked_m: world.tracker.estimate().position_m,
            goal_m: world.goal_m,
            hand: world.plant.hand,
            hand_force_n: Plant::hand_force_n(&world.plant),
            steering: self.state.controller_state.carrier.you().and_then(You::steering),
            positioner: world.plant.positioner,
            switching: world.switching,
            controller: self.state.controller,
            motion: world.motion,
            phase: world.phase,
            refusal: world.refusal.clone(),
            trouble: match world.refusal {
                Some(Refusal::Closed) => Some(Trouble::Closed),
                _ => self.state.controller_state.carrier.trouble(),
            },
            load: self.load(),
            walls: world.plant.walls,
            counters: world.counters,
        }
    }

    /// Removes and returns the events since the last record, for inputs while paused.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// The current observation, outside of control steps. The trial does not change.
    pub fn observe(&self, camera: &mut dyn ImageSource) -> Result<Sight, CameraError> {
        Ok(self.sight(self.see(camera)?))
    }

    fn sight(&self, Seen { frame, percept, tool_m }: Seen) -> Sight {
        let TrialState { world, controller_state, .. } = &self.state;
        Sight {
            frame: Arc::new(frame),
            percept,
            tool_m,
            goal_m: world.goal_m,
            known: controller_state.known.clone(),
            quadtree: QuadtreeParameters {
                threshold: world.parameters.obstacle_level,
                smallest_px: world.parameters.smallest_block_px as usize,
            },
            corrects_image: world.parameters.rl_corrects_image,
            carrier: controller_state.carrier.clone(),
        }
    }

    pub(super) fn record(&mut self, decision: Option<Decision>, seen: Option<Seen>) -> TickRecord {
        let sight = seen.map(|seen| self.sight(seen));
        let moment = self.moment();
        TickRecord {
            tick: moment.tick,
            inputs: std::mem::take(&mut self.inputs),
            decision,
            sight,
            events: self.take_events(),
            world: self.state.world.hashes(),
            controller_hash: self.state.controller_hash(),
            moment,
        }
    }
}
