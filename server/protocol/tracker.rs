//! The tracker's estimate, for programs.

use serde::Serialize;
use utoipa::ToSchema;

use ferry_core::geometry::Point2;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::trial::World;

/// The bead as the tracker reports it to the controllers, not its true place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, ToSchema)]
pub struct TrackerEstimate {
    /// Ticks since the start of the trial.
    pub tick: u64,
    /// `tick` in seconds.
    pub sim_time_s: f64,
    pub x_m: f64,
    pub y_m: f64,
    /// Velocity along x, low-pass filtered.
    pub x_m_s: f64,
    /// Velocity along y, low-pass filtered.
    pub y_m_s: f64,
    /// Simulated time since the position was measured.
    pub age_s: f64,
    /// Whether no sample has arrived for longer than the parameter `tracker_timeout_s`.
    pub is_lost: bool,
    /// Goal, if one is set.
    pub goal: Option<GoalPlace>,
}

/// A goal on the table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, ToSchema)]
pub struct GoalPlace {
    pub x_m: f64,
    pub y_m: f64,
}

impl From<Point2<f64>> for GoalPlace {
    fn from(goal_m: Point2<f64>) -> Self {
        Self { x_m: goal_m.x, y_m: goal_m.y }
    }
}

impl From<&World> for TrackerEstimate {
    fn from(world: &World) -> Self {
        let estimate = world.tracker.estimate();
        Self {
            tick: world.tick,
            sim_time_s: world.tick as f64 * SERVO_PERIOD_S,
            x_m: estimate.position_m.x,
            y_m: estimate.position_m.y,
            x_m_s: estimate.velocity_m_s.x,
            y_m_s: estimate.velocity_m_s.y,
            age_s: f64::from(estimate.age_ticks) * SERVO_PERIOD_S,
            is_lost: world.tracker.is_lost(world.parameters.tracker_timeout_s),
            goal: world.goal_m.map(GoalPlace::from),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ferry_core::geometry::Vector2;
    use ferry_core::scenario::Scenario;
    use ferry_core::tracking::TrackerParameters;
    use ferry_core::trial::{Arena, Trial};

    #[test]
    fn it_is_what_the_tracker_reports_and_ages_while_no_sample_arrives() {
        let scenario = Scenario { goal_m: Some(Point2::new(0.12, -0.33)), ..Scenario::idle("posts", 1) };
        let mut world = Trial::new(scenario, Arena::shipped("posts").unwrap()).unwrap().snapshot().world;
        let truth_m = world.plant.bead.position_m;
        let perfect =
            TrackerParameters { noise_m: 0.0, bias_m: Vector2::zeros(), drift_m: 0.0, latency_ticks: 0, dropout: 0.0 };
        let shifted_m = truth_m + Vector2::new(0.003, 0.0);
        world.tracker.sample(Some(shifted_m), &perfect);
        let told = TrackerEstimate::from(&world);
        assert_eq!((told.x_m, told.y_m, told.age_s, told.is_lost), (shifted_m.x, truth_m.y, 0.0, false));
        assert!(told.x_m_s > 0.0 && told.y_m_s == 0.0, "{told:?}");
        assert_eq!(told.goal, Some(GoalPlace { x_m: 0.12, y_m: -0.33 }));
        for tick in 1..=26 {
            world.tracker.sample(None, &perfect);
            // The timeout is 0.2 s, 25 ticks.
            assert_eq!(TrackerEstimate::from(&world).is_lost, tick > 25, "{tick}");
        }
        let silent = TrackerEstimate::from(&world);
        assert_eq!((silent.x_m, silent.x_m_s), (told.x_m, told.x_m_s));
        assert!((silent.age_s - 26.0 * SERVO_PERIOD_S).abs() < 1e-12, "{silent:?}");
    }
}
