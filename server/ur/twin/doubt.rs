//! Whether the arm that a robot reports is the one that Ferry computes with.

use std::fmt;

use crate::arm::{Spatial, pose, tool};
use crate::peer::Report;
use ferry_core::geometry::{Isometry3, UnitQuaternion, Vector3};
use ferry_core::robot::forward;

/// Flanges that are farther apart belong to different arms.
const OTHER_ARM_M: f64 = 0.02;
const OTHER_ARM_RAD: f64 = 4.0 * std::f64::consts::PI / 180.0;
/// What the calibration of an arm in its factory may account for is not doubted.
const DOUBTFUL_M: f64 = 0.003;

/// Two poses of one flange or one tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    pub reported: Spatial,
    pub computed: Spatial,
    pub distance_m: f64,
    pub angle_rad: f64,
}

impl Apart {
    fn of(reported: Spatial, computed: &Isometry3<f64>) -> Self {
        let [x, y, z, about_x, about_y, about_z] = reported;
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(about_x, about_y, about_z));
        Self {
            reported,
            computed: pose(computed),
            distance_m: (Vector3::new(x, y, z) - computed.translation.vector).norm(),
            angle_rad: turn.angle_to(&computed.rotation),
        }
    }

    /// The flange, as Ferry's program on the robot reports it.
    pub fn flange(report: &Report) -> Self {
        Self::of(report.flange, &forward::flange(&report.flange_joints_rad))
    }

    /// The tool, as the robot reports it. The robot may have another tool than Ferry.
    pub fn tool(report: &Report) -> Self {
        Self::of(report.tool, &tool(&report.joints_rad))
    }

    /// Also if a number is not finite.
    pub fn is_other_arm(&self) -> bool {
        let is_ours = self.distance_m <= OTHER_ARM_M && self.angle_rad <= OTHER_ARM_RAD;
        !is_ours
    }

    pub fn is_doubtful(&self) -> bool {
        let is_near = self.distance_m <= DOUBTFUL_M;
        !is_near
    }
}

/// Poses are written as in URScript.
impl fmt::Display for Apart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let written = |pose: &Spatial| pose.map(|value| format!("{value:.4}")).join(", ");
        let Self { reported, computed, distance_m, angle_rad } = self;
        write!(
            f,
            "p[{}] by the robot and p[{}] by Ferry, which are {:.1} mm and {:.1}° apart",
            written(reported),
            written(computed),
            1000.0 * distance_m,
            angle_rad.to_degrees(),
        )
    }
}

/// What may be wrong, though nothing is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    Tool(Apart),
    Flange(Apart),
}

impl Doubt {
    /// From the reported tool, before the program on the robot has told of the flange.
    pub fn of_tool(report: &Report) -> Option<Self> {
        let apart = Apart::tool(report);
        apart.is_doubtful().then_some(Self::Tool(apart))
    }

    pub fn of_flange(apart: Apart) -> Option<Self> {
        apart.is_doubtful().then_some(Self::Flange(apart))
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let length_m = ferry_core::plant::TOOL_LENGTH_M;
        match self {
            Self::Tool(apart) => write!(
                f,
                "either its TCP is not Ferry's, {length_m} m below the flange, or it is no UR5: its tool is at {apart}"
            ),
            Self::Flange(apart) => {
                write!(f, "its calibration differs, and places on the table do as well: its flange is at {apart}")
            }
        }
    }
}
