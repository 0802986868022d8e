//! The final check of every requested tool position, from controllers and from the operator.

mod joints;

pub use joints::{JointRefusal, TILT_MOST_RAD, TOOL_HEIGHT_M};

use super::{CONTROL_PERIOD_S, Refusal, TargetStep};
use crate::geometry::{Isometry3, Point2, Point3, Rect, Vector3};
use crate::perception::Percept;
use crate::plant::{Positioner, TOOL_LENGTH_M, ToolOrientation};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::robot::{self, Joints, forward, inverse, jacobian};

/// Poses with less manipulability are refused.
pub const MIN_MANIPULABILITY_M3: f64 = 2e-3;

/// Largest vertical speed of the tool.
pub const LIFT_SPEED_M_S: f64 = 0.05;

/// Largest speed at which the tool turns back after a program for a UR5 has tilted it.
const TURN_SPEED_RAD_S: f64 = 0.2;
/// A tool that is tilted by less is not tilted.
const LEAST_TILT_RAD: f64 = 1e-6;

/// The limits of one trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// The tool must stay inside.
    pub workspace: Rect,
    /// Largest tool speed of a transport step.
    pub speed_m_s: f64,
    /// Largest tool speed of a flight to the bead.
    pub flight_speed_m_s: f64,
    pub tool_orientation: ToolOrientation,
}

impl Limits {
    /// Checks that a tool position is finite, inside the workspace and, with an arm, reachable and not singular.
    /// Returns the positioner's state there: the same kind as `seed`, on the solution branch nearest to it.
    pub fn position(&self, tool_m: Point3<f64>, seed: &Positioner) -> Result<Positioner, Refusal> {
        let (x_m, y_m) = (tool_m.x, tool_m.y);
        if !(x_m.is_finite() && y_m.is_finite()) {
            return Err(Refusal::NotFinite { x_m, y_m });
        }
        if !self.workspace.contains(tool_m.xy()) {
            return Err(Refusal::OutsideWorkspace { x_m, y_m });
        }
        let found = Positioner::at(tool_m, self.tool_orientation, seed).map_err(|error| {
            let reach = robot::reach(tool_m.z + TOOL_LENGTH_M);
            let distance_m = tool_m.xy().coords.norm();
            match reach {
                // The reach with a tilted tool differs by a few millimetres.
                Some((min_m, max_m)) if !(min_m..=max_m).contains(&distance_m) => {
                    Refusal::OutOfReach { distance_m, min_m, max_m }
                }
                _ => Refusal::NoInverse(error.to_string()),
            }
        })?;
        let manipulability_m3 = found.joints_rad().map_or(f64::INFINITY, |joints| jacobian::manipulability(&joints));
        if manipulability_m3 < MIN_MANIPULABILITY_M3 {
            return Err(Refusal::Singular { manipulability_m3, least_m3: MIN_MANIPULABILITY_M3 });
        }
        Ok(found)
    }

    /// Moves the tool's reference for one servo period from `from_m` toward `wanted_m`. The horizontal speed is at most
    /// the larger of the two limits and the vertical speed at most [`LIFT_SPEED_M_S`]. [`Self::position`] checks the
    /// result.
    pub fn advance(
        &self,
        from_m: Point3<f64>,
        wanted_m: Point3<f64>,
        seed: &Positioner,
    ) -> Result<(Point3<f64>, Positioner), Refusal> {
        let offset = wanted_m.xy() - from_m.xy();
        let max_m = self.speed_m_s.max(self.flight_speed_m_s) * SERVO_PERIOD_S;
        // A target within the limit is kept exactly, without rounding.
        let place_m = if offset.norm() > max_m * (1.0 + 1e-9) {
            from_m.xy() + offset.cap_magnitude(max_m)
        } else {
            wanted_m.xy()
        };
        let max_rise_m = LIFT_SPEED_M_S * SERVO_PERIOD_S;
        let rise_m = (wanted_m.z - from_m.z).clamp(-max_rise_m, max_rise_m);
        let next_m = Point3::new(place_m.x, place_m.y, from_m.z + rise_m);
        let next = self.position(next_m, seed)?;
        let (Some(from_rad), Some(to_rad)) = (seed.joints_rad(), next.joints_rad()) else { return Ok((next_m, next)) };
        let upright = self.tool_orientation.base_from_flange();
        let tilt_rad = forward::flange(&from_rad).rotation.angle_to(&upright);
        if tilt_rad < LEAST_TILT_RAD {
            return Ok((next_m, next));
        }
        let share = (TURN_SPEED_RAD_S * SERVO_PERIOD_S / tilt_rad).min(1.0);
        if tilt_rad > TILT_MOST_RAD {
            // Turned about the vertical: it turns back on its way.
            let rotation = upright.rotation_to(&forward::flange(&from_rad).rotation).powf(1.0 - share) * upright;
            let flange_m = next_m.coords - rotation * Vector3::new(0.0, 0.0, TOOL_LENGTH_M);
            let joints_rad = inverse::nearest(&Isometry3::from_parts(flange_m.into(), rotation), &from_rad)
                .map_err(|error| Refusal::NoInverse(error.to_string()))?;
            return Ok((next_m, Positioner::Arm(joints_rad)));
        }
        self.keep_joints_in(std::array::from_fn(|i| from_rad[i] + share * (to_rad[i] - from_rad[i])))
    }

    /// The tool point of an arm and the arm. Between two poses inside the workspace the tool point makes a bow, which may
    /// lead out: the arm then keeps its tilt at the nearest place inside.
    fn keep_joints_in(&self, joints_rad: Joints) -> Result<(Point3<f64>, Positioner), Refusal> {
        let arm = Positioner::Arm(joints_rad);
        let tool_m = arm.tool_m();
        let inside = self.keep_in(tool_m.xy());
        if inside == tool_m.xy() {
            return Ok((tool_m, arm));
        }
        let inside_m = Point3::new(inside.x, inside.y, tool_m.z);
        let mut flange = forward::flange(&joints_rad);
        flange.translation.vector += inside_m - tool_m;
        let joints_rad =
            inverse::nearest(&flange, &joints_rad).map_err(|error| Refusal::NoInverse(error.to_string()))?;
        Ok((inside_m, Positioner::Arm(joints_rad)))
    }

    /// Checks a transport step: the position, the speed, and the camera's view of the whole step.
    pub fn step(
        &self,
        tool_m: Point3<f64>,
        step: &TargetStep,
        percept: &Percept,
        seed: &Positioner,
    ) -> Result<(), Refusal> {
        let from = tool_m.xy();
        self.position(Point3::new(step.target_m.x, step.target_m.y, tool_m.z), seed)?;
        let speed_m_s = step.speed_m_s.max((step.target_m - from).norm() / CONTROL_PERIOD_S * 0.999);
        if speed_m_s > self.speed_m_s + 1e-9 {
            return Err(Refusal::TooFast { speed_m_s, limit_m_s: self.speed_m_s });
        }
        if !(percept.calibration.sees(from) && percept.calibration.sees(step.target_m)) {
            return Err(Refusal::OutOfView { x_m: step.target_m.x, y_m: step.target_m.y });
        }
        if percept.is_hidden(from) || percept.is_hidden(step.target_m) {
            return Err(Refusal::Hidden { x_m: step.target_m.x, y_m: step.target_m.y });
        }
        match percept.obstacle_on_step(from, step.target_m) {
            Some(place) => Err(Refusal::Obstacle { x_m: place.x, y_m: place.y }),
            None => Ok(()),
        }
    }

    /// The point of the workspace nearest to `wanted`. A flight stays inside the workspace.
    pub fn keep_in(&self, wanted: Point2<f64>) -> Point2<f64> {
        self.workspace.nearest(wanted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perception::Percept;

    const HOME: Positioner = Positioner::Arm([-1.6, -1.6, -1.6, -1.6, 1.6, 0.0]);

    fn limits() -> Limits {
        let workspace = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -1.2, y_max_m: -0.05 };
        Limits { workspace, speed_m_s: 0.04, flight_speed_m_s: 0.25, tool_orientation: ToolOrientation::Vertical }
    }

    fn position(x_m: f64, y_m: f64) -> Result<Positioner, Refusal> {
        limits().position(Point3::new(x_m, y_m, 0.1), &HOME)
    }

    #[test]
    fn refused_positions_name_the_right_reason() {
        assert!(position(0.1, -0.4).is_ok());
        assert!(matches!(position(f64::NAN, -0.4), Err(Refusal::NotFinite { .. })));
        assert!(matches!(position(0.5, -0.4), Err(Refusal::OutsideWorkspace { .. })));
        assert!(matches!(position(0.0, -1.1), Err(Refusal::OutOfReach { .. })));
        assert!(matches!(position(0.0, -0.06), Err(Refusal::OutOfReach { .. })));
        let (_, max_m) = robot::reach(0.1 + TOOL_LENGTH_M).unwrap();
        assert!(matches!(position(0.0, 1e-6 - max_m), Err(Refusal::Singular { .. })));
    }

    #[test]
    fn the_planar_stage_reaches_positions_that_the_arm_does_not() {
        let stage = Positioner::PlanarStage(Point3::new(0.0, -0.3, 0.1));
        let at = |y_m: f64| limits().position(Point3::new(0.0, y_m, 0.1), &stage);
        assert!(at(-1.1).is_ok() && at(-0.06).is_ok());
        assert!(matches!(at(-1.3), Err(Refusal::OutsideWorkspace { .. })));
    }

    #[test]
    fn the_reference_keeps_its_speed_limit_and_stays_inside() {
        let seed = limits().position(Point3::new(0.0, -0.3, 0.1), &HOME).unwrap();
        let from = Point3::new(0.0, -0.3, 0.1);
        let near = Point3::new(0.001, -0.3, 0.1);
        assert_eq!(limits().advance(from, near, &seed).unwrap().0, near);
        let (next, _) = limits().advance(from, Point3::new(0.2, -0.5, 0.3), &seed).unwrap();
        assert!(((next - from).xy().norm() - 0.25 * SERVO_PERIOD_S).abs() < 1e-12, "{next}");
        assert!((next.z - from.z - LIFT_SPEED_M_S * SERVO_PERIOD_S).abs() < 1e-12, "{next}");
        let edge = Point3::new(0.2799, -0.3, 0.1);
        let out = limits().advance(edge, Point3::new(1.0, -0.3, 0.1), &seed);
        assert!(matches!(out, Err(Refusal::OutsideWorkspace { .. })));
        assert!(limits().advance(from, Point3::new(f64::NAN, -0.3, 0.1), &seed).is_err());
    }

    #[test]
    fn a_tilted_tool_turns_back_slowly() {
        let mut from_m = Point3::new(0.0, -0.3, 0.1);
        let paper = Limits { tool_orientation: ToolOrientation::Paper, ..limits() };
        let mut reference = paper.position(from_m, &HOME).unwrap();
        let goal_m = Point3::new(0.05, -0.3, 0.1);
        let mut ticks = 0;
        while reference != limits().position(goal_m, &reference).unwrap() {
            let before = reference.joints_rad().unwrap();
            (from_m, reference) = limits().advance(from_m, goal_m, &reference).unwrap();
            let turned =
                before.iter().zip(reference.joints_rad().unwrap()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(turned / SERVO_PERIOD_S < 1.5, "{turned}");
            assert!((reference.tool_m() - from_m).norm() < 1e-9);
            ticks += 1;
            assert!(ticks < 200, "{from_m}");
        }
        assert!(ticks > 30, "3.2 degrees in .28 s");
    }

    #[test]
    fn a_turned_tool_turns_back_on_its_way() {
        for turn_rad in [-3.0, 0.1, 1.5] {
            let (mut from_m, goal_m) = (Point3::new(0.0, -0.4, 0.1), Point3::new(0.1, -0.35, 0.1));
            let mut joints = limits().position(from_m, &HOME).unwrap().joints_rad().unwrap();
            joints[5] -= turn_rad;
            let mut reference = Positioner::Arm(joints);
            assert!((reference.turn_rad() - turn_rad).abs() < 1e-9, "{}", reference.turn_rad());
            let mut ticks = 0;
            while reference.turn_rad() != 0.0 || (from_m - goal_m).norm() > 1e-9 {
                let before = (reference.turn_rad(), from_m);
                (from_m, reference) = limits().advance(from_m, goal_m, &reference).unwrap();
                assert!((reference.tool_m() - from_m).norm() < 1e-9);
                assert!(
                    reference.turn_rad().abs() <= before.0.abs() && (before.0 - reference.turn_rad()).abs() < 0.012
                );
                let is_on_its_way = ticks > 100 || (from_m - before.1).norm() > 1.9e-3 || from_m == goal_m;
                assert!(is_on_its_way || reference.turn_rad().abs() < TILT_MOST_RAD, "{from_m}");
                ticks += 1;
                assert!(ticks < 2000, "{from_m} {}", reference.turn_rad());
            }
        }
    }

    #[test]
    fn a_tilted_tool_turns_back_inside_the_workspace() {
        let paper = Limits { tool_orientation: ToolOrientation::Paper, ..limits() };
        let (mut bows, workspace) = (0, limits().workspace);
        for y_m in (-60..-25).map(|cm| f64::from(cm) / 100.0) {
            for x_m in [workspace.x_min_m, workspace.x_max_m] {
                let mut from_m = Point3::new(x_m, y_m, 0.1);
                let Ok(mut reference) = paper.position(from_m, &HOME) else { continue };
                let along_m = Point3::new(x_m, y_m - 0.05, 0.1);
                for _ in 0..20 {
                    let before = reference;
                    let Ok(next) = limits().advance(from_m, along_m, &reference) else { break };
                    (from_m, reference) = next;
                    assert!(workspace.contains(from_m.xy()), "{from_m}");
                    assert!((reference.tool_m() - from_m).norm() < 1e-9);
                    let turned = std::iter::zip(before.joints_rad().unwrap(), reference.joints_rad().unwrap());
                    let turned_rad = turned.map(|(a, b)| f64::abs(a - b)).fold(0.0, f64::max);
                    assert!(turned_rad / SERVO_PERIOD_S < 3.0, "{turned_rad} at {from_m}");
                    let flange = forward::flange(&reference.joints_rad().unwrap());
                    let is_tilted = flange.rotation.angle_to(&ToolOrientation::Vertical.base_from_flange()) > 1e-4;
                    bows += usize::from(is_tilted && from_m.x == x_m);
                }
            }
        }
        assert!(bows > 100, "{bows}");
    }

    #[test]
    fn refuses_steps_that_are_too_fast_or_into_a_wall() {
        let tool = Point3::new(0.0, -0.3, 0.1);
        let wall = crate::perception::test_frame(tool.xy(), |p| p.x > 0.015);
        let percept = Percept::of(&wall, tool.xy());
        let step = |x_m: f64, speed_m_s: f64| {
            let step = TargetStep { target_m: Point2::new(x_m, -0.3), speed_m_s };
            limits().step(tool, &step, &percept, &HOME)
        };
        assert_eq!(step(-0.01, 0.04), Ok(()));
        assert!(matches!(step(-0.01, 0.05), Err(Refusal::TooFast { .. })));
        assert!(matches!(step(-0.02, 0.04), Err(Refusal::TooFast { .. })), "too long for one control period");
        assert_eq!(step(0.004, 0.04), Ok(()));
        let aside = Percept::of(&crate::perception::test_frame(Point2::new(0.102, -0.3), |_| false), tool.xy());
        let unseen = TargetStep { target_m: Point2::new(0.005, -0.3), speed_m_s: 0.04 };
        assert!(matches!(limits().step(tool, &unseen, &aside, &HOME), Err(Refusal::OutOfView { .. })));
        let wide = Limits { speed_m_s: 0.079, ..limits() };
        let into = TargetStep { target_m: Point2::new(0.0195, -0.3), speed_m_s: 0.079 };
        assert!(matches!(wide.step(tool, &into, &percept, &HOME), Err(Refusal::Obstacle { .. })));
    }
}
