//! The positioner moves the magnet over the table: the arm, or a planar stage.
//!
//! The paper's attractor examples are beyond the arm's reach; they run on the planar stage.

use std::f64::consts::{FRAC_PI_2, TAU};

use serde::{Deserialize, Serialize};

use super::TOOL_LENGTH_M;
use crate::geometry::{Isometry3, Point3, Rect, Translation3, UnitQuaternion, Vector3};
use crate::map::Map;
use crate::robot::inverse::{self, InverseError};
use crate::robot::workspace::{self, ManipulabilityMap, WorkspaceError};
use crate::robot::{self, Joints, forward, servo, ur5::SERVO_PERIOD_S};

/// Gain K2 of the integrators of joints and planar stage (paper, §IV-D).
const SERVO_GAIN_PER_S: f64 = 4.0;
/// Maximum speed of the planar stage: twice the maximum approach speed.
const STAGE_SPEED_LIMIT_M_S: f64 = 0.5;
/// The arm at rest over the table. Inverse kinematics always uses the branch nearest to it.
const HOME_RAD: Joints = [-FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2, 0.0];
/// The paper's rotation vector of the flange, 3.2° off the vertical.
const PAPER_ROTATION_RAD: [f64; 3] = [2.182, -2.182, 0.0];

/// A tool that is turned by less counts as not turned: joints that lag behind turn it a little.
const LEAST_TURN_RAD: f64 = 0.01;

/// The kind of positioner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum PositionerKind {
    /// The UR5.
    #[default]
    Arm,
    /// Three linear axes that reach everywhere and never tilt.
    PlanarStage,
}

impl PositionerKind {
    /// The positioner that a map is made for.
    pub fn of(map: &Map) -> Self {
        if map.is_for_stage() { Self::PlanarStage } else { Self::Arm }
    }
}

/// Orientation of the flange.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToolOrientation {
    /// Straight down.
    #[default]
    Vertical,
    /// The paper's rotation vector, exactly [2.182, −2.182, 0].
    Paper,
}

impl ToolOrientation {
    /// The rotation `base_from_flange`.
    pub fn base_from_flange(self) -> UnitQuaternion<f64> {
        match self {
            Self::Vertical => robot::tool_down(),
            Self::Paper => UnitQuaternion::from_scaled_axis(Vector3::from(PAPER_ROTATION_RAD)),
        }
    }
}

/// The arm's manipulability with its tool point over each cell of `area`, `tool_height_m` above the table
/// (see [`workspace::manipulability_map`]), on the branch that the arm uses.
///
/// # Errors
/// Those of [`workspace::manipulability_map`].
pub fn manipulability_map(
    area: &Rect,
    cell_m: f64,
    tool_height_m: f64,
    orientation: ToolOrientation,
) -> Result<ManipulabilityMap, WorkspaceError> {
    let rotation = orientation.base_from_flange();
    let shift = -(rotation * Vector3::new(0.0, 0.0, TOOL_LENGTH_M));
    let under_flange = Rect {
        x_min_m: area.x_min_m + shift.x,
        x_max_m: area.x_max_m + shift.x,
        y_min_m: area.y_min_m + shift.y,
        y_max_m: area.y_max_m + shift.y,
    };
    let map = workspace::manipulability_map(&under_flange, cell_m, tool_height_m + shift.z, &rotation, &HOME_RAD)?;
    Ok(ManipulabilityMap { origin_m: [area.x_min_m, area.y_min_m], ..map })
}

/// An actual position or a reference of the positioner.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Positioner {
    /// The arm, by its joint angles.
    Arm(Joints),
    /// The planar stage, by its tool point.
    PlanarStage(Point3<f64>),
}

impl Positioner {
    /// The rest position of a positioner of this kind, near `tool_m`: a seed for [`Self::at`].
    pub fn home(kind: PositionerKind, tool_m: Point3<f64>) -> Self {
        match kind {
            PositionerKind::Arm => Self::Arm(HOME_RAD),
            PositionerKind::PlanarStage => Self::PlanarStage(tool_m),
        }
    }

    /// The positioner of `seed`'s kind with its tool point at `tool_m`. The arm takes the branch nearest to
    /// the seed and the flange rotation of `orientation`; the planar stage ignores `orientation`.
    ///
    /// # Errors
    /// Those of [`inverse::nearest`].
    pub fn at(tool_m: Point3<f64>, orientation: ToolOrientation, seed: &Self) -> Result<Self, InverseError> {
        match seed {
            Self::Arm(joints) => {
                let rotation = orientation.base_from_flange();
                let flange_m = tool_m.coords - rotation * Vector3::new(0.0, 0.0, TOOL_LENGTH_M);
                inverse::nearest(&Isometry3::from_parts(flange_m.into(), rotation), joints).map(Self::Arm)
            }
            Self::PlanarStage(_) => Ok(Self::PlanarStage(tool_m)),
        }
    }

    pub fn kind(&self) -> PositionerKind {
        match self {
            Self::Arm(_) => PositionerKind::Arm,
            Self::PlanarStage(_) => PositionerKind::PlanarStage,
        }
    }

    /// The arm's joint angles; `None` for the planar stage.
    pub fn joints_rad(&self) -> Option<Joints> {
        match self {
            Self::Arm(joints) => Some(*joints),
            Self::PlanarStage(_) => None,
        }
    }

    /// The arm's link frames (see [`forward::link_frames`]); `None` for the planar stage.
    pub fn link_frames(&self) -> Option<[Isometry3<f64>; 6]> {
        self.joints_rad().map(|joints| forward::link_frames(&joints))
    }

    /// The tool's frame in the flange frame; see [`Self::base_from_tool`].
    pub fn flange_from_tool() -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::new(0.0, 0.0, TOOL_LENGTH_M), robot::tool_down().inverse())
    }

    /// The pose of the tool's frame: its origin is the tool point, its axes are those of `base` while the
    /// flange points straight down.
    pub fn base_from_tool(&self) -> Isometry3<f64> {
        match self {
            Self::Arm(joints) => forward::flange(joints) * Self::flange_from_tool(),
            Self::PlanarStage(tool_m) => Isometry3::from_parts((*tool_m).into(), UnitQuaternion::identity()),
        }
    }

    /// How far the tool is turned about the vertical, which is the twist of its rotation; 0 if it is less than
    /// `LEAST_TURN_RAD`.
    pub fn turn_rad(&self) -> f64 {
        let [_, _, z, w]: [f64; 4] = self.base_from_tool().rotation.coords.into();
        let turn_rad = 2.0 * z.atan2(w);
        // The same rotation, less than half a turn away.
        let turn_rad = turn_rad - TAU * (turn_rad / TAU).round();
        if turn_rad.abs() < LEAST_TURN_RAD { 0.0 } else { turn_rad }
    }

    /// The tool point: the middle of the block's lower face.
    pub fn tool_m(&self) -> Point3<f64> {
        self.base_from_tool().translation.vector.into()
    }

    /// The positioner one servo period later. It follows `reference` → `next_reference` as a single integrator
    /// with gain K2 = 4 /s, within its speed limits. It does not move if the three are of different kinds.
    #[must_use]
    pub fn step(&self, reference: &Self, next_reference: &Self) -> Self {
        match (self, reference, next_reference) {
            (Self::Arm(joints), Self::Arm(reference), Self::Arm(next)) => {
                Self::Arm(servo::step(joints, reference, next, SERVO_GAIN_PER_S))
            }
            (Self::PlanarStage(tool_m), Self::PlanarStage(reference), Self::PlanarStage(next)) => {
                let velocity = (next - reference) / SERVO_PERIOD_S + (reference - tool_m) * SERVO_GAIN_PER_S;
                Self::PlanarStage(tool_m + velocity.cap_magnitude(STAGE_SPEED_LIMIT_M_S) * SERVO_PERIOD_S)
            }
            _ => *self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::jacobian;

    const SEED: Positioner = Positioner::Arm(HOME_RAD);

    #[test]
    fn the_tool_point_is_at_its_target_in_both_orientations() {
        let wanted = Point3::new(0.1, -0.4, 0.1);
        for orientation in [ToolOrientation::Vertical, ToolOrientation::Paper] {
            let arm = Positioner::at(wanted, orientation, &SEED).unwrap();
            assert!((arm.tool_m() - wanted).norm() < 1e-12);
        }
        let tilt = |orientation| {
            let arm = Positioner::at(wanted, orientation, &SEED).unwrap();
            (arm.base_from_tool().rotation * Vector3::z()).angle(&Vector3::z()).to_degrees()
        };
        assert!(tilt(ToolOrientation::Vertical) < 1e-6);
        assert!((tilt(ToolOrientation::Paper) - 3.2).abs() < 0.05, "{}", tilt(ToolOrientation::Paper));
    }

    #[test]
    fn the_manipulability_map_refers_to_the_tool_point_in_both_orientations() {
        let area = Rect { x_min_m: -0.30, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
        for orientation in [ToolOrientation::Vertical, ToolOrientation::Paper] {
            let map = manipulability_map(&area, 0.01, 0.1, orientation).unwrap();
            assert_eq!((map.columns, map.rows, map.origin_m), (58, 33, [-0.30, -0.54]));
            for cell in [0, 57, 900, 58 * 33 - 1] {
                let center = map.center_m(cell);
                let arm = Positioner::at(Point3::new(center.x, center.y, 0.1), orientation, &SEED).unwrap();
                let expected = jacobian::manipulability(&arm.joints_rad().unwrap());
                assert!((map.manipulability_m3[cell].unwrap() - expected).abs() < 1e-12);
            }
            // As in the paper: no singularity within the working environment.
            assert_eq!(map.share_at_least(0.018), 1.0);
        }
    }

    #[test]
    fn the_planar_stage_reaches_positions_beyond_the_arm() {
        let far = Point3::new(-0.78, 0.73, 0.1);
        assert!(Positioner::at(far, ToolOrientation::Vertical, &SEED).is_err());
        let stage = Positioner::PlanarStage(Point3::origin());
        assert_eq!(Positioner::at(far, ToolOrientation::Vertical, &stage).unwrap().tool_m(), far);
    }

    #[test]
    fn the_planar_stage_follows_without_lag_within_its_speed_limit() {
        let reference = |k: f64| Positioner::PlanarStage(Point3::new(0.002 * k, -0.001 * k, 0.1));
        let mut stage = reference(0.0);
        for k in 0..100 {
            stage = stage.step(&reference(f64::from(k)), &reference(f64::from(k) + 1.0));
        }
        assert!((stage.tool_m() - reference(100.0).tool_m()).norm() < 1e-12);
        let after = stage.step(&reference(100.0), &reference(1e6));
        let speed_m_s = (after.tool_m() - stage.tool_m()).norm() / SERVO_PERIOD_S;
        assert!((speed_m_s - STAGE_SPEED_LIMIT_M_S).abs() < 1e-9);
    }
}
