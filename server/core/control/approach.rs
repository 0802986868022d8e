//! Sub-controller 1: flies to the tracked bead (paper, equation for ė1 = −K1·e1), also over walls.

use crate::geometry::{Point2, Vector2};
use crate::tracking::Estimate;

/// Gain K1 (specification §1).
pub const GAIN_PER_S: f64 = 4.0;
/// Slower tracked motion is treated as noise and not fed forward.
const FEED_FORWARD_FLOOR_M_S: f64 = 0.02;

/// Tool velocity: the bead's velocity plus K1 times the error, capped at `speed_limit_m_s`.
pub fn velocity(tool_m: Point2<f64>, bead: &Estimate, speed_limit_m_s: f64) -> Vector2<f64> {
    let moving = bead.velocity_m_s.norm() > FEED_FORWARD_FLOOR_M_S;
    let feed_forward = if moving { bead.velocity_m_s } else { Vector2::zeros() };
    (feed_forward + (bead.position_m - tool_m) * GAIN_PER_S).cap_magnitude(speed_limit_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::ur5::SERVO_PERIOD_S;

    #[test]
    fn the_error_decays_at_the_gain_even_with_a_moving_bead() {
        let mut tool = Point2::origin();
        let velocity_m_s = Vector2::new(0.05, 0.0);
        let mut bead = Estimate { position_m: Point2::new(0.02, 0.01), velocity_m_s, age_ticks: 0 };
        for _ in 0..125 {
            tool += velocity(tool, &bead, 0.25) * SERVO_PERIOD_S;
            bead.position_m += velocity_m_s * SERVO_PERIOD_S;
        }
        let error = (bead.position_m - tool).norm();
        assert!((error / (0.02f64.hypot(0.01) * (-4.0f64).exp()) - 1.0).abs() < 0.1, "{error}");
    }

    #[test]
    fn speed_is_capped_at_the_limit() {
        let bead = Estimate { position_m: Point2::new(1.0, 1.0), velocity_m_s: Vector2::new(1.0, 0.0), age_ticks: 0 };
        assert!(velocity(Point2::origin(), &bead, 0.25).norm() <= 0.25 + 1e-12);
    }
}
