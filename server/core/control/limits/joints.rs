//! Limits of joint angles that a program for a UR5 commands.

use super::{LIFT_SPEED_M_S, Limits, MIN_MANIPULABILITY_M3};
use crate::geometry::{Point3, Vector3};
use crate::plant::Positioner;
use crate::robot::ur5::{JOINT_LIMIT_RAD, JOINT_SPEED_LIMIT_RAD_S, SERVO_PERIOD_S};
use crate::robot::{Joints, forward, jacobian};

/// The tool point's height above the table. Below, the block would touch the walls.
pub const TOOL_HEIGHT_M: [f64; 2] = [0.09, 0.5];
/// Largest angle between the flange and straight down. It may turn about the vertical, with block and camera.
pub const TILT_MOST_RAD: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// For rounding.
const SPARE: f64 = 1.0 + 1e-6;

/// Why joint angles were refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum JointRefusal {
    #[error("the planar stage has no joints")]
    NoJoints,
    #[error("joint {joint} is {angle_rad}, it must be finite")]
    NotFinite { joint: usize, angle_rad: f64 },
    #[error("joint {joint} would be at {angle_rad:.3} rad, its limits are ±{JOINT_LIMIT_RAD:.3} rad")]
    JointLimit { joint: usize, angle_rad: f64 },
    #[error("joint {joint} would turn at {speed_rad_s:.2} rad/s, its limit is {JOINT_SPEED_LIMIT_RAD_S:.2} rad/s")]
    JointSpeed { joint: usize, speed_rad_s: f64 },
    #[error("the tool ({x_m:.3}, {y_m:.3}) m would be outside the workspace")]
    OutsideWorkspace { x_m: f64, y_m: f64 },
    #[error("the tool would be {height_m:.4} m above the table, it must be {least_m} to {most_m} m", least_m = TOOL_HEIGHT_M[0], most_m = TOOL_HEIGHT_M[1])]
    Height { height_m: f64 },
    #[error("the tool would be tilted {tilt_rad:.4} rad from straight down, the limit is {TILT_MOST_RAD:.4} rad")]
    Tilted { tilt_rad: f64 },
    #[error("the tool would move at {speed_m_s:.3} m/s, the limit is {limit_m_s:.3} m/s")]
    ToolSpeed { speed_m_s: f64, limit_m_s: f64 },
    #[error("the manipulability would be {manipulability_m3:.2e} m³, less than {MIN_MANIPULABILITY_M3:.0e}")]
    Singular { manipulability_m3: f64 },
}

impl Limits {
    /// Largest horizontal speed of the tool, from any source.
    pub fn tool_speed_m_s(&self) -> f64 {
        self.speed_m_s.max(self.flight_speed_m_s)
    }

    /// Checks joint angles for the end of a servo period (8 ms) that begins at `from_rad`.
    ///
    /// # Errors
    /// [`JointRefusal`]; joints count from 0, the base.
    pub fn joints(&self, from_rad: &Joints, to_rad: &Joints) -> Result<(), JointRefusal> {
        for (joint, (&from, &angle_rad)) in from_rad.iter().zip(to_rad).enumerate() {
            if !angle_rad.is_finite() {
                return Err(JointRefusal::NotFinite { joint, angle_rad });
            }
            if angle_rad.abs() > JOINT_LIMIT_RAD {
                return Err(JointRefusal::JointLimit { joint, angle_rad });
            }
            let speed_rad_s = (angle_rad - from).abs() / SERVO_PERIOD_S;
            if speed_rad_s > JOINT_SPEED_LIMIT_RAD_S * SPARE {
                return Err(JointRefusal::JointSpeed { joint, speed_rad_s });
            }
        }
        let tool_m = tool(to_rad);
        let (x_m, y_m, height_m) = (tool_m.x, tool_m.y, tool_m.z);
        if !self.workspace.contains(tool_m.xy()) {
            return Err(JointRefusal::OutsideWorkspace { x_m, y_m });
        }
        if !(TOOL_HEIGHT_M[0]..=TOOL_HEIGHT_M[1]).contains(&height_m) {
            return Err(JointRefusal::Height { height_m });
        }
        let tilt_rad = (forward::flange(to_rad).rotation * Vector3::z()).angle(&-Vector3::z());
        if tilt_rad > TILT_MOST_RAD {
            return Err(JointRefusal::Tilted { tilt_rad });
        }
        let speed_m_s = (tool_m - tool(from_rad)).norm() / SERVO_PERIOD_S;
        // A controller may lift the tool during a flight.
        let limit_m_s = self.tool_speed_m_s().hypot(LIFT_SPEED_M_S);
        if speed_m_s > limit_m_s * SPARE {
            return Err(JointRefusal::ToolSpeed { speed_m_s, limit_m_s });
        }
        let manipulability_m3 = jacobian::manipulability(to_rad);
        if manipulability_m3 < MIN_MANIPULABILITY_M3 {
            return Err(JointRefusal::Singular { manipulability_m3 });
        }
        Ok(())
    }
}

fn tool(joints_rad: &Joints) -> Point3<f64> {
    Positioner::Arm(*joints_rad).tool_m()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Rect;
    use crate::plant::ToolOrientation;
    use proptest::prelude::*;

    const HOME: Positioner = Positioner::Arm([-1.6, -1.6, -1.6, -1.6, 1.6, 0.0]);

    fn limits() -> Limits {
        let workspace = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.7, y_max_m: -0.05 };
        Limits { workspace, speed_m_s: 0.04, flight_speed_m_s: 0.25, tool_orientation: ToolOrientation::Vertical }
    }

    fn at(x_m: f64, y_m: f64, height_m: f64, orientation: ToolOrientation) -> Joints {
        Positioner::at(Point3::new(x_m, y_m, height_m), orientation, &HOME).unwrap().joints_rad().unwrap()
    }

    #[test]
    fn what_is_refused_is_named() {
        let limits = limits();
        let here = at(0.0, -0.4, 0.1, ToolOrientation::Vertical);
        assert_eq!(limits.joints(&here, &here), Ok(()));
        assert_eq!(limits.joints(&here, &at(0.0019, -0.4, 0.1, ToolOrientation::Vertical)), Ok(()));
        let with = |joint: usize, angle_rad: f64| {
            let mut joints = here;
            joints[joint] = angle_rad;
            limits.joints(&here, &joints)
        };
        assert!(matches!(with(2, f64::NAN), Err(JointRefusal::NotFinite { joint: 2, .. })));
        assert_eq!(with(5, 7.0), Err(JointRefusal::JointLimit { joint: 5, angle_rad: 7.0 }));
        assert!(matches!(with(0, here[0] + 0.03), Err(JointRefusal::JointSpeed { joint: 0, .. })));
        assert!(matches!(with(0, here[0] + 0.01), Err(JointRefusal::ToolSpeed { .. })));
        let stays = |joints: Joints| limits.joints(&joints, &joints);
        assert_eq!(stays(at(0.0, -0.4, 0.1, ToolOrientation::Paper)), Ok(()));
        assert!(matches!(
            stays(at(0.285, -0.4, 0.1, ToolOrientation::Vertical)),
            Err(JointRefusal::OutsideWorkspace { .. })
        ));
        assert!(matches!(stays(at(0.0, -0.4, 0.08, ToolOrientation::Vertical)), Err(JointRefusal::Height { .. })));
        let mut turned = here;
        turned[5] += 3.0;
        assert_eq!(stays(turned), Ok(()), "about the vertical");
        turned[4] += 0.1;
        assert!(matches!(stays(turned), Err(JointRefusal::Tilted { tilt_rad }) if (tilt_rad - 0.1).abs() < 1e-9));
        let far = Limits { workspace: Rect { y_min_m: -1.2, ..limits.workspace }, ..limits };
        let (_, max_m) = crate::robot::reach(0.1 + crate::plant::TOOL_LENGTH_M).unwrap();
        let stretched = at(0.0, 1e-6 - max_m, 0.1, ToolOrientation::Vertical);
        assert!(matches!(far.joints(&stretched, &stretched), Err(JointRefusal::Singular { .. })));
    }

    proptest! {
        /// Whatever is allowed keeps the tool over the table, above the walls, and slow.
        #[test]
        fn what_is_allowed_is_within_all_limits(
            place in (-0.4..0.4, -0.8..0.0, 0.05..0.6),
            change in prop::array::uniform6(-0.01..0.01),
        ) {
            let limits = limits();
            let wanted = Point3::new(place.0, place.1, place.2);
            if let Ok(Positioner::Arm(from)) = Positioner::at(wanted, ToolOrientation::Vertical, &HOME) {
                let to = std::array::from_fn(|i| from[i] + change[i]);
                if limits.joints(&from, &to).is_ok() {
                    prop_assert!(limits.workspace.contains(tool(&to).xy()) && tool(&to).z >= 0.09);
                    prop_assert!((tool(&to) - tool(&from)).norm() <= 0.255 * SERVO_PERIOD_S * SPARE);
                    prop_assert!((forward::flange(&to).rotation * crate::geometry::Vector3::z()).z < -0.99);
                }
            }
        }
    }
}
