//! The physics of arm, bead, contacts and disturbances. One [`Plant::step`] is a servo period of 8 ms.
//!
//! `step` receives all state as an argument; [`Plant`] itself has no changing state.

mod bead;
mod contact;
mod fit;
mod lumen;
mod motion;
mod peristalsis;
mod positioner;
mod walls;

use serde::{Deserialize, Serialize};

use crate::geometry::{Isometry3, Point2, Point3, Translation3, Vector2};
use crate::magnetics::cuboid::Cuboid;
use crate::magnetics::posed::PosedBlock;
use crate::magnetics::{dipole, force};
use crate::robot::{Joints, ur5};

pub use bead::{Bead, BeadMotion};
pub use force::Orientation as BlockOrientation;
pub use lumen::{Lumen, MOST_CLOSING_M, WallVertex};
pub use peristalsis::{Contraction, LEAST_PERIOD_S, LEAST_WAVELENGTH_M, Peristalsis, WallMotion};
pub use positioner::{Positioner, PositionerKind, ToolOrientation, manipulability_map};
pub use walls::{LazyLumen, Surroundings, Walls};

/// Length of gripper and block, from the flange to the tool point.
pub const TOOL_LENGTH_M: f64 = 0.180;
pub const BEAD_RADIUS_M: f64 = dipole::SPHERE_DIAMETER_M / 2.0;
/// Plant steps per servo period: 1 kHz.
pub const SUBSTEPS: usize = 8;

#[derive(Clone, Debug, PartialEq)]
pub struct PlantParameters {
    /// How the block is turned.
    pub block_orientation: BlockOrientation,
    /// How the bead moves over the table.
    pub bead_motion: BeadMotion,
    /// Coulomb friction of the bead on the table.
    pub friction: f64,
    /// Resistance to rolling, in units of the normal load; used by [`BeadMotion::Rolling`] alone.
    pub rolling_resistance: f64,
    /// Viscous drag on the bead, relative to the fluid.
    pub drag_n_s_m: f64,
    /// Speed of the fluid along the lumen.
    pub flow_m_s: f64,
    /// Contractions of the walls.
    pub peristalsis: Peristalsis,
}

impl PlantParameters {
    /// The pull, in units of the normal load, above which a resting bead begins to move.
    pub fn breakaway(&self) -> f64 {
        match self.bead_motion {
            BeadMotion::Sliding => self.friction,
            BeadMotion::Rolling => self.friction.min(self.rolling_resistance),
        }
    }

    /// Smallest and largest distance from the tool at which the magnet's pull moves a resting bead, in `directions`
    /// directions from +x counter-clockwise. `None` if it never does; no largest distance if it always does.
    pub fn capture_m(&self, tool_height_m: f64, directions: u32) -> Vec<Option<(f64, Option<f64>)>> {
        let breakaway = self.breakaway();
        let capture_m = |k: u32| {
            let direction_rad = f64::from(k) * std::f64::consts::TAU / f64::from(directions);
            force::capture_interval_m(self.block_orientation, tool_height_m, breakaway, direction_rad)
        };
        let end_m = |far_m: f64| (far_m < force::FARTHEST_M).then_some(far_m);
        (0..directions).map(|k| capture_m(k).map(|(near_m, far_m)| (near_m, end_m(far_m)))).collect()
    }
}

/// The hand: a critically damped spring from the bead to the operator's pointer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hand {
    /// Position of the pointer.
    pub target_m: Point2<f64>,
    /// Whether the bead is lifted over walls.
    pub lift: bool,
}

/// The arm of a robot outside of Ferry: the simulated arm is where it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mirror {
    /// Measured by the robot.
    pub joints_rad: Joints,
    /// Whether the robot follows Ferry's reference. If not, something else moves it.
    pub is_driven: bool,
}

/// The complete state of the physics.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlantState {
    /// What carries the magnet.
    pub positioner: Positioner,
    pub bead: Bead,
    /// The hand, while it holds the bead.
    pub hand: Option<Hand>,
    /// A disturbance that pushes the bead with a force for some time.
    pub drift_n: Vector2<f64>,
    /// Contractions of the walls; `None` at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub walls: Option<WallMotion>,
    /// The robot that the arm mirrors in this tick, if it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mirror: Option<Mirror>,
}

impl PlantState {
    /// A bead at rest at `bead_m`, without disturbances.
    pub fn at_rest(positioner: Positioner, bead_m: Point2<f64>) -> Self {
        Self { positioner, bead: Bead::at(bead_m), hand: None, drift_n: Vector2::zeros(), walls: None, mirror: None }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Pull of the magnet in the table's plane.
    pub lateral_n: Vector2<f64>,
    /// Pull upward.
    pub vertical_n: f64,
}

impl Load {
    /// Upward pull in units of the bead's weight; the bead lifts off at 1.
    pub fn lift_ratio(&self) -> f64 {
        self.vertical_n / dipole::weight_n()
    }
}

/// The physics, with everything that stays constant during a trial.
#[derive(Clone, Debug)]
pub struct Plant {
    parameters: PlantParameters,
    block: Cuboid,
    block_half_height_m: f64,
}

impl Plant {
    pub fn new(parameters: PlantParameters) -> Self {
        let block = force::block(parameters.block_orientation, dipole::BLOCK_REMANENCE_T);
        Self { block_half_height_m: block.half_size_m.z, parameters, block }
    }

    /// Sides of the block in `base`.
    pub fn block_size_m(&self) -> [f64; 3] {
        (self.block.half_size_m * 2.0).into()
    }

    /// Magnetic load on a bead at `bead_m` on the table; see [`Positioner::base_from_tool`] for the pose.
    pub fn load(&self, base_from_tool: &Isometry3<f64>, bead_m: Point2<f64>) -> Load {
        let bead_m = Point3::new(bead_m.x, bead_m.y, BEAD_RADIUS_M);
        let tool_from_block = Translation3::new(0.0, 0.0, self.block_half_height_m);
        let posed = PosedBlock { block: self.block, base_from_block: base_from_tool * tool_from_block };
        let force_n = posed.force_n(&bead_m, dipole::moment_a_m2());
        Load { lateral_n: force_n.xy(), vertical_n: force_n.z }
    }

    /// Advances one servo period from `tick`: the positioner follows `reference` → `next_reference` or the robot that it
    /// mirrors, the walls contract, and the bead follows the magnet, the hand and the walls.
    pub fn step(
        &self,
        state: &mut PlantState,
        around: &Surroundings<'_>,
        tick: u64,
        reference: &Positioner,
        next_reference: &Positioner,
    ) {
        let before = state.positioner.base_from_tool();
        state.positioner = match state.mirror {
            Some(mirror) => Positioner::Arm(mirror.joints_rad),
            None => state.positioner.step(reference, next_reference),
        };
        let mut base_from_tool = state.positioner.base_from_tool();
        let travel_m = base_from_tool.translation.vector - before.translation.vector;
        let rested = state.walls;
        state.walls = WallMotion::next(rested, &self.parameters.peristalsis, around.seed);
        let mut walls = around.walls_between(rested.as_ref(), state.walls.as_ref(), tick, state.bead.position_m);
        let dt_s = ur5::SERVO_PERIOD_S / SUBSTEPS as f64;
        for substep in 1..=SUBSTEPS {
            // The tool moves at constant speed; its tilt hardly changes in a servo period.
            let part = substep as f64 / SUBSTEPS as f64;
            base_from_tool.translation.vector = before.translation.vector + travel_m * part;
            walls.advance_to(part);
            self.step_bead(state, &walls, &base_from_tool, dt_s);
        }
    }
}

#[cfg(test)]
mod tests;
