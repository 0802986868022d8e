//! The physics: arm, bead, contact, disturbance. One [`Plant::step`] is a servo period of 8 ms.
//!
//! `step` takes all state as an argument and owns none.

mod bead;
pub(crate) mod contact;

use serde::{Deserialize, Serialize};

use crate::geometry::{Isometry3, Point2, Point3, UnitQuaternion, Vector2, Vector3};
use crate::magnetics::cuboid::Cuboid;
use crate::magnetics::{dipole, force};
use crate::map::Map;
use crate::robot::inverse::{self, InverseError};
use crate::robot::{Joints, forward, servo, ur5};

pub use bead::Bead;
pub use force::Orientation as BlockOrientation;

/// Length of gripper and block, flange to tool point (specification §1).
pub const TOOL_LENGTH_M: f64 = 0.180;
/// Radius of the bead.
pub const BEAD_RADIUS_M: f64 = dipole::SPHERE_DIAMETER_M / 2.0;
/// Plant steps a servo period: 1 kHz.
pub const SUBSTEPS: usize = 8;
/// Gain K2 of the joints' integrators (paper, §IV-D).
pub const SERVO_GAIN_PER_S: f64 = 4.0;

/// What the physics can be told.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantParameters {
    /// How the block is turned.
    pub block_orientation: BlockOrientation,
    /// Coulomb friction of the bead on the table.
    pub friction: f64,
    /// Viscous drag on the bead.
    pub drag_n_s_m: f64,
}

/// The hand that disturbs: a critically damped spring from the bead to the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hand {
    /// Where the pointer is.
    pub target_m: Point2<f64>,
    /// Whether it carries the bead over walls.
    pub lift: bool,
}

/// All that the physics remember.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlantState {
    /// Joint angles.
    pub joints_rad: Joints,
    /// The bead.
    pub bead: Bead,
    /// The hand, while it holds the bead.
    pub hand: Option<Hand>,
}

/// Forces on the bead at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Pull of the magnet in the table's plane.
    pub lateral_n: Vector2<f64>,
    /// Pull upward.
    pub vertical_n: f64,
}

impl Load {
    /// Upward pull in units of the bead's weight; 1 is lift-off.
    pub fn lift_ratio(&self) -> f64 {
        self.vertical_n / dipole::weight_n()
    }
}

/// The fixed part of the physics.
#[derive(Clone, Debug)]
pub struct Plant {
    parameters: PlantParameters,
    block: Cuboid,
    block_half_height_m: f64,
}

impl Plant {
    /// A plant with these parameters.
    pub fn new(parameters: PlantParameters) -> Self {
        let block = force::block(parameters.block_orientation, dipole::BLOCK_REMANENCE_T);
        Self { block_half_height_m: block.half_size_m.z, parameters, block }
    }

    /// Sides of the block in `base`.
    pub fn block_size_m(&self) -> [f64; 3] {
        (self.block.half_size_m * 2.0).into()
    }

    /// The tool point: the middle of the block's lower face.
    pub fn tool_m(joints_rad: &Joints) -> Point3<f64> {
        forward::flange(joints_rad) * Point3::new(0.0, 0.0, TOOL_LENGTH_M)
    }

    /// Joints that put the tool point at `tool_m`, straight down, on the branch nearest to `seed`.
    pub fn joints_for(tool_m: Point3<f64>, seed: &Joints) -> Result<Joints, InverseError> {
        let flange_m = tool_m.coords + Vector3::new(0.0, 0.0, TOOL_LENGTH_M);
        let rotation: UnitQuaternion<f64> = crate::robot::tool_down();
        inverse::nearest(&Isometry3::from_parts(flange_m.into(), rotation), seed)
    }

    /// Magnetic load on a bead at `bead_m` on the table.
    pub fn load(&self, tool_m: Point3<f64>, bead_m: Point2<f64>) -> Load {
        let block_center_z_m = tool_m.z + self.block_half_height_m;
        let bead_from_block = Vector3::new(bead_m.x - tool_m.x, bead_m.y - tool_m.y, BEAD_RADIUS_M - block_center_z_m);
        let force_n = force::force_n(&self.block, &bead_from_block, dipole::moment_a_m2());
        Load { lateral_n: force_n.xy(), vertical_n: force_n.z }
    }

    /// Advances one servo period: joints follow `reference` → `next_reference`, the bead follows the
    /// magnet, the hand and the walls.
    pub fn step(&self, state: &mut PlantState, map: &Map, reference: &Joints, next_reference: &Joints) {
        let tool_before = Self::tool_m(&state.joints_rad);
        state.joints_rad = servo::step(&state.joints_rad, reference, next_reference, SERVO_GAIN_PER_S);
        let tool_after = Self::tool_m(&state.joints_rad);
        let dt_s = ur5::SERVO_PERIOD_S / SUBSTEPS as f64;
        for substep in 1..=SUBSTEPS {
            let fraction = substep as f64 / SUBSTEPS as f64;
            let tool_m = tool_before + (tool_after - tool_before) * fraction;
            self.step_bead(state, map, tool_m, dt_s);
        }
    }
}

#[cfg(test)]
mod tests;
