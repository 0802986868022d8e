//! Why a robot is not connected, does not follow, or may be another, in the form of the wire (see [`ferry_core::facts`]).

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::DriveError;
use super::doubt::{Apart, Doubt};
use crate::arm::Spatial;
use ferry_core::schema::Numbers6;

/// Why a robot is not connected. `detail` is what the system says, in English.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema, thiserror::Error)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum TwinTrouble {
    #[error("not connected yet")]
    NotYet,
    #[error("{detail}")]
    Failed { detail: String },
}

/// Where the robot and Ferry say that one part of the arm is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct ApartFact {
    /// Position in metres and rotation vector in radians, as URScript writes a pose.
    #[schema(value_type = Numbers6)]
    pub reported: Spatial,
    #[schema(value_type = Numbers6)]
    pub computed: Spatial,
    pub distance_m: f64,
    pub angle_rad: f64,
}

impl From<&Apart> for ApartFact {
    fn from(&Apart { reported, computed, distance_m, angle_rad }: &Apart) -> Self {
        Self { reported, computed, distance_m, angle_rad }
    }
}

/// Why places on the table may be others than Ferry's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum DoubtFact {
    /// The reported tool is elsewhere: it has another TCP, or it is no UR5.
    Tool(ApartFact),
    /// The reported flange is elsewhere: its calibration differs.
    Flange(ApartFact),
}

impl From<&Doubt> for DoubtFact {
    fn from(doubt: &Doubt) -> Self {
        match doubt {
            Doubt::Tool(apart) => Self::Tool(apart.into()),
            Doubt::Flange(apart) => Self::Flange(apart.into()),
        }
    }
}

/// Why a robot does not follow. `detail` is an English sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum DriveFact {
    NotEnabled,
    NotConnected,
    Mode {
        robot_mode: i32,
    },
    Safety {
        safety_mode: i32,
    },
    /// Another program runs on the robot.
    Busy,
    /// The arm is where Ferry may not move it.
    Place {
        detail: String,
    },
    OtherArm(ApartFact),
    NoArm,
    /// The robot has not begun Ferry's program in time.
    NotBegun,
    NotSent {
        detail: String,
    },
    /// Nothing was heard from the robot.
    Silent,
    /// The robot has ended Ferry's program.
    Over,
    /// A joint is not where it should be.
    Behind {
        joint: usize,
        behind_rad: f64,
    },
    Limit {
        detail: String,
    },
    /// The session refuses what the robot reports.
    Refused {
        detail: String,
    },
    /// The session was paused, set back or changed.
    Changed,
    Released,
}

impl From<&DriveError> for DriveFact {
    fn from(error: &DriveError) -> Self {
        let detail = String::clone;
        match error {
            DriveError::NotEnabled => Self::NotEnabled,
            DriveError::NotConnected => Self::NotConnected,
            &DriveError::Mode(robot_mode) => Self::Mode { robot_mode },
            &DriveError::Safety(safety_mode) => Self::Safety { safety_mode },
            DriveError::Busy => Self::Busy,
            DriveError::Place(why) => Self::Place { detail: detail(why) },
            DriveError::OtherArm(apart) => Self::OtherArm((&**apart).into()),
            DriveError::NoArm => Self::NoArm,
            DriveError::NotBegun => Self::NotBegun,
            DriveError::NotSent(why) => Self::NotSent { detail: detail(why) },
            DriveError::Silent => Self::Silent,
            DriveError::Over => Self::Over,
            &DriveError::Behind { joint, behind_rad } => Self::Behind { joint, behind_rad },
            DriveError::Limit(why) => Self::Limit { detail: detail(why) },
            DriveError::Refused(why) => Self::Refused { detail: detail(why) },
            DriveError::Changed => Self::Changed,
            DriveError::Released => Self::Released,
        }
    }
}
