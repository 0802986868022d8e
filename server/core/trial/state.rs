//! The complete state of a trial, in two parts. The *world* is reproduced by a replay from logged decisions. The
//! *controller state* ([`ControllerState`]) is reproduced only if the decisions are made again from camera frames.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use super::phase::Phase;
use super::script::Script;
use crate::control::search::Search;
use crate::control::switching::{self, Mode};
use crate::control::transport::Carrier;
use crate::control::{Refusal, TargetStep};
use crate::geometry::Rect;
use crate::geometry::{Point2, Point3};
use crate::perception::ObstacleMap;
use crate::plant::{Bead, PlantState, Positioner, WallMotion};
use crate::robot::Joints;
use crate::scenario::{ControllerName, Hashed, Parameters, Scenario, Stream};
use crate::tracking::Tracker;

/// What the tool's reference does until the next control step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Motion {
    Hold,
    /// Follows a straight segment (sub-controller 2).
    Segment(TargetStep),
    /// Follows the tracked bead, tick by tick (sub-controller 1).
    Track,
    /// Joint angles in rad, at the next tick, and then rest (a program for a UR5, or a robot that is mirrored).
    Joints(Joints),
}

/// Result of a control step; part of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// The active sub-controller, and why.
    pub switching: switching::Decision,
    /// What the arm does.
    pub motion: Motion,
    /// Why the arm holds, if a step was refused.
    pub refusal: Option<Refusal>,
}

/// Counters since the reset.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counters {
    /// Control steps.
    pub steps: u32,
    /// Control steps since the goal was placed.
    pub goal_steps: u32,
    /// Control steps of sub-controller 2 since the last fetch or goal.
    pub leg_steps: u32,
    /// Control steps since the goal was placed during which the tracker was lost. The other counters leave them out.
    pub held_steps: u32,
    /// Switches of the active sub-controller.
    pub switches: u32,
    /// Goals delivered.
    pub deliveries: u32,
    /// Disturbances by hand or script.
    pub disturbances: u32,
}

/// Robot, bead, tracker and task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct World {
    /// Ticks of 8 ms since the start.
    pub tick: u64,
    pub parameters: Parameters,
    /// Goal, if any.
    pub goal_m: Option<Point2<f64>>,
    /// Positioner, bead, hand.
    pub plant: PlantState,
    /// Optical tracker.
    pub tracker: Tracker,
    /// The latest states of the plant, newest last, for a camera with latency.
    pub past: VecDeque<Past>,
    /// Target of the tool point.
    pub reference_m: Point3<f64>,
    /// The positioner at that point.
    pub reference: Positioner,
    /// What the reference does.
    pub motion: Motion,
    /// The last switching decision.
    pub switching: switching::Decision,
    /// Why the arm holds, if a step was refused at the last control step.
    pub refusal: Option<Refusal>,
    /// Progress of the task.
    pub phase: Phase,
    /// Tick at which the tool first came within 2 cm of this goal.
    pub reached_tick: Option<u64>,
    pub counters: Counters,
    /// Pending and active disturbances.
    pub script: Script,
}

/// The controller state: memory and last observation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ControllerState {
    /// Sub-controller 2 with its memory.
    pub carrier: Carrier,
    /// Hash of the last gray image.
    pub seen: u64,
    /// The obstacle map accumulated so far.
    pub known: ObstacleMap,
    /// The search for the bead while the tracker is lost.
    pub search: Search,
    /// Control steps during which moving walls have closed all paths.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub closed_steps: u32,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(steps: &u32) -> bool {
    *steps == 0
}

/// What a camera with latency shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Past {
    pub positioner: Positioner,
    pub bead: Bead,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub walls: Option<WallMotion>,
}

/// A whole trial at one tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialState {
    pub world: World,
    /// Sub-controller 2 in use.
    pub controller: ControllerName,
    #[serde(rename = "mind")]
    pub controller_state: ControllerState,
}

impl World {
    /// Names of the entries of [`WorldHashes`], in the same order.
    pub const FIELDS: [&'static str; 18] = [
        "tick",
        "parameters",
        "goal",
        "positioner",
        "bead",
        "hand",
        "drift and walls",
        "tracker",
        "past",
        "reference place",
        "reference",
        "motion",
        "switching",
        "refusal",
        "phase",
        "reached tick",
        "counters",
        "script",
    ];

    /// One hash per field.
    pub fn hashes(&self) -> WorldHashes {
        let Self {
            tick,
            parameters,
            goal_m,
            plant: PlantState { positioner, bead, hand, drift_n, walls, mirror },
            tracker,
            past,
            reference_m,
            reference,
            motion,
            switching,
            refusal,
            phase,
            reached_tick,
            counters,
            script,
        } = self;
        let fields = [
            hash(tick),
            hash(&Hashed(parameters)),
            hash(goal_m),
            // Mirrors and walls came later; without them, the hash is as before.
            mirror.map_or_else(|| hash(positioner), |mirror| hash(&(positioner, mirror))),
            hash(bead),
            hash(hand),
            walls.map_or_else(|| hash(drift_n), |walls| hash(&(drift_n, walls))),
            hash(tracker),
            hash(past),
            hash(reference_m),
            hash(reference),
            hash(motion),
            hash(switching),
            hash(refusal),
            hash(phase),
            hash(reached_tick),
            hash(counters),
            hash(script),
        ];
        WorldHashes { fields }
    }
}

/// One hash for each of [`World::FIELDS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorldHashes {
    /// In the order of [`World::FIELDS`].
    pub fields: [u64; World::FIELDS.len()],
}

impl WorldHashes {
    /// A single hash of all entries.
    pub fn total(&self) -> u64 {
        hash(&self.fields)
    }
}

impl TrialState {
    pub(super) fn at_start(scenario: &Scenario, workspace: &Rect, tool_m: Point3<f64>, positioner: Positioner) -> Self {
        let start = tool_m.xy();
        let threshold_m = scenario.parameters.threshold_m;
        Self {
            world: World {
                tick: 0,
                parameters: scenario.parameters.clone(),
                goal_m: None,
                plant: PlantState::at_rest(positioner, start),
                tracker: Tracker::at(start, Stream::Tracker.rng(scenario.seed)),
                past: VecDeque::new(),
                reference_m: tool_m,
                reference: positioner,
                motion: Motion::Hold,
                switching: switching::Decision { mode: Mode::Transport, switched: false, error_m: 0.0, threshold_m },
                refusal: None,
                phase: Phase::Holding,
                reached_tick: None,
                counters: Counters::default(),
                script: Script {
                    remaining: scenario.disturbances,
                    pending: scenario.script.clone(),
                    ..Script::default()
                },
            },
            controller: scenario.controller,
            controller_state: ControllerState {
                carrier: Carrier::new(scenario.controller, scenario.seed),
                seen: 0,
                known: ObstacleMap::new(*workspace),
                search: Search::default(),
                closed_steps: 0,
            },
        }
    }

    /// Whether something outside of Ferry moves the arm: a program for a UR5, or whatever moves the robot that is
    /// mirrored. Then there are no control steps to count.
    pub(super) fn is_led_from_outside(&self) -> bool {
        self.controller == ControllerName::Robot || self.world.plant.mirror.is_some_and(|mirror| !mirror.is_driven)
    }

    /// Hash of the world: equal in a replay from logged decisions.
    pub fn world_hash(&self) -> u64 {
        self.world.hashes().total()
    }

    /// Both hashes.
    pub fn hashes(&self) -> (u64, u64) {
        (self.world_hash(), self.controller_hash())
    }

    /// Hash of the controller state: equal if the decisions are made again from frames.
    pub fn controller_hash(&self) -> u64 {
        hash(&(&self.controller_state, self.controller))
    }
}

fn hash(value: &impl Serialize) -> u64 {
    // Serialising these types to a `Vec` cannot fail.
    xxh3_64(&postcard::to_stdvec(value).expect("plain data serialises"))
}
