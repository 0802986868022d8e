//! The one last gate: whatever asks for a tool position, controller or operator, passes here.

use super::{CONTROL_PERIOD_S, Refusal, TargetStep};
use crate::geometry::{Point2, Point3, Rect};
use crate::perception::Percept;
use crate::plant::{Plant, TOOL_LENGTH_M};
use crate::robot::{self, Joints, jacobian};

/// Poses with less manipulability are kept away from.
pub const LEAST_MANIPULABILITY_M3: f64 = 2e-3;

/// The limits of one trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// The tool stays in here.
    pub workspace: Rect,
    /// Fastest tool.
    pub speed_m_s: f64,
}

impl Limits {
    /// Checks a tool position: finite, in the workspace, in reach, not singular; returns the joints.
    pub fn position(&self, tool_m: Point3<f64>, seed: &Joints) -> Result<Joints, Refusal> {
        let (x_m, y_m) = (tool_m.x, tool_m.y);
        if !(x_m.is_finite() && y_m.is_finite()) {
            return Err(Refusal::NotFinite { x_m, y_m });
        }
        if !self.workspace.contains(tool_m.xy()) {
            return Err(Refusal::OutsideWorkspace { x_m, y_m });
        }
        let (min_m, max_m) = robot::reach(tool_m.z + TOOL_LENGTH_M).unwrap_or((f64::INFINITY, 0.0));
        let distance_m = tool_m.xy().coords.norm();
        if !(min_m..=max_m).contains(&distance_m) {
            return Err(Refusal::OutOfReach { distance_m, min_m, max_m });
        }
        let joints = Plant::joints_for(tool_m, seed).map_err(|error| Refusal::NoInverse(error.to_string()))?;
        let manipulability_m3 = jacobian::manipulability(&joints);
        if manipulability_m3 < LEAST_MANIPULABILITY_M3 {
            return Err(Refusal::Singular { manipulability_m3, least_m3: LEAST_MANIPULABILITY_M3 });
        }
        Ok(joints)
    }

    /// Checks a transport step: the position, the speed, and the camera's view of the whole step.
    pub fn step(
        &self,
        tool_m: Point3<f64>,
        step: &TargetStep,
        percept: &Percept,
        seed: &Joints,
    ) -> Result<(), Refusal> {
        let from = tool_m.xy();
        self.position(Point3::new(step.target_m.x, step.target_m.y, tool_m.z), seed)?;
        let speed_m_s = step.speed_m_s.max((step.target_m - from).norm() / CONTROL_PERIOD_S * 0.999);
        if speed_m_s > self.speed_m_s + 1e-9 {
            return Err(Refusal::TooFast { speed_m_s, limit_m_s: self.speed_m_s });
        }
        match percept.obstacle_on_step(from, step.target_m) {
            Some(place) => Err(Refusal::Obstacle { x_m: place.x, y_m: place.y }),
            None => Ok(()),
        }
    }

    /// The nearest point to `wanted` inside the workspace, for a flight that must not leave it.
    pub fn keep_in(&self, wanted: Point2<f64>) -> Point2<f64> {
        let w = &self.workspace;
        Point2::new(wanted.x.clamp(w.x_min_m, w.x_max_m), wanted.y.clamp(w.y_min_m, w.y_max_m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perception::Percept;

    const HOME: Joints = [-1.6, -1.6, -1.6, -1.6, 1.6, 0.0];

    fn limits() -> Limits {
        Limits { workspace: Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -1.2, y_max_m: -0.05 }, speed_m_s: 0.04 }
    }

    fn position(x_m: f64, y_m: f64) -> Result<Joints, Refusal> {
        limits().position(Point3::new(x_m, y_m, 0.1), &HOME)
    }

    #[test]
    fn a_position_is_refused_for_the_right_reason() {
        assert!(position(0.1, -0.4).is_ok());
        assert!(matches!(position(f64::NAN, -0.4), Err(Refusal::NotFinite { .. })));
        assert!(matches!(position(0.5, -0.4), Err(Refusal::OutsideWorkspace { .. })));
        assert!(matches!(position(0.0, -1.1), Err(Refusal::OutOfReach { .. })));
        assert!(matches!(position(0.0, -0.06), Err(Refusal::OutOfReach { .. })));
        let (_, most_m) = robot::reach(0.1 + TOOL_LENGTH_M).unwrap();
        assert!(matches!(position(0.0, 1e-6 - most_m), Err(Refusal::Singular { .. })));
    }

    #[test]
    fn a_step_is_refused_when_too_fast_or_into_a_wall() {
        let tool = Point3::new(0.0, -0.3, 0.1);
        let wall = crate::perception::test_frame(tool.xy(), |p| p.x > 0.015);
        let percept = Percept::of(&wall);
        let step = |x_m: f64, speed_m_s: f64| {
            let step = TargetStep { target_m: Point2::new(x_m, -0.3), speed_m_s };
            limits().step(tool, &step, &percept, &HOME)
        };
        assert_eq!(step(-0.01, 0.04), Ok(()));
        assert!(matches!(step(-0.01, 0.05), Err(Refusal::TooFast { .. })));
        assert!(matches!(step(-0.02, 0.04), Err(Refusal::TooFast { .. })), "too long for one control period");
        assert_eq!(step(0.004, 0.04), Ok(()));
        let wide = Limits { speed_m_s: 0.079, ..limits() };
        let into = TargetStep { target_m: Point2::new(0.0195, -0.3), speed_m_s: 0.079 };
        assert!(matches!(wide.step(tool, &into, &percept, &HOME), Err(Refusal::Obstacle { .. })));
    }
}
