//! A person as sub-controller 2: the tool goes where the hand at the page points.

use serde::{Deserialize, Serialize};

use super::{Transport, TransportInput, Trouble};
use crate::control::{Refusal, TargetStep};
use crate::geometry::Point2;

/// Shares of a full step, longest first: near a wall, the tool goes as far as the image shows a free way.
const SHARES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];

/// Where the hand points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Steering {
    pub target_m: Point2<f64>,
    /// Whether the hand also steers while sub-controller 1 is active.
    pub approach: bool,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct You {
    /// `None` until the hand points for the first time: the tool holds.
    steering: Option<Steering>,
}

impl You {
    pub fn steer(&mut self, steering: Steering) {
        self.steering = Some(steering);
    }

    pub fn steering(&self) -> Option<Steering> {
        self.steering
    }

    /// The step while sub-controller 1 is active; `None` if that flies to the bead by itself. Like that flight, it passes
    /// over walls.
    pub fn flight(&self, tool_m: Point2<f64>, speed_m_s: f64) -> Option<TargetStep> {
        let steering = self.steering.filter(|steering| steering.approach)?;
        Some(TargetStep::toward(tool_m, steering.target_m, speed_m_s))
    }
}

impl Transport for You {
    /// The hand still points where it did.
    fn start_leg(&mut self) {}

    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        let speed_m_s = input.parameters.transport_speed_m_s;
        let tool_m = input.tool_m;
        let pointed_m = self.steering.map_or(tool_m, |steering| steering.target_m);
        let target_m = TargetStep::toward(tool_m, pointed_m, speed_m_s).target_m;
        let part = |share: f64| tool_m + (target_m - tool_m) * share;
        let is_free = |end_m: &Point2<f64>| input.percept.obstacle_on_step(tool_m, *end_m).is_none();
        // Without a free part, the limits refuse the whole step and name the wall.
        let target_m = SHARES.map(part).into_iter().find(is_free).unwrap_or(target_m);
        Ok(TargetStep { target_m, speed_m_s })
    }

    fn trouble(&self) -> Option<Trouble> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::CONTROL_PERIOD_S;
    use crate::perception::{ObstacleMap, Percept, test_frame};
    use crate::scenario::Parameters;

    #[test]
    fn the_tool_goes_where_the_hand_points_and_stops_before_a_wall() {
        let tool_m = Point2::new(0.0, -0.3);
        let parameters = Parameters::default();
        let step_m = parameters.transport_speed_m_s * CONTROL_PERIOD_S;
        let next = |you: &mut You, percept: &Percept| {
            let known = ObstacleMap::new(*crate::map::Map::shipped("open").unwrap().workspace());
            let goal_m = Point2::new(0.2, -0.3);
            let input =
                TransportInput { percept, known: &known, tool_m, goal_m, parameters: &parameters, policy: None };
            you.next_step(&input).unwrap().target_m
        };
        let open = Percept::of(&test_frame(tool_m, |_| false), tool_m);
        let mut you = You::default();
        assert_eq!(next(&mut you, &open), tool_m, "no hand yet");
        let steering = Steering { target_m: Point2::new(0.1, -0.3), approach: false };
        you.steer(steering);
        assert!((next(&mut you, &open) - Point2::new(step_m, -0.3)).norm() < 1e-12);
        assert_eq!(you.flight(tool_m, 0.2), None);
        you.steer(Steering { approach: true, ..steering });
        assert!((you.flight(tool_m, 0.2).unwrap().target_m - Point2::new(0.05, -0.3)).norm() < 1e-12);
        let wall = Percept::of(&test_frame(tool_m, |place| place.x > 0.005), tool_m);
        let short = next(&mut you, &wall).x;
        assert!(short < step_m, "{short}");
    }
}
