//! Lengths and limits of the UR5 (CB3).
//!
//! Source: Universal Robots, "DH parameters for calculations of kinematics and dynamics", and the
//! UR5 technical specification. The link twists α are (π/2, 0, 0, π/2, −π/2, 0).

use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Height of the shoulder axis above the base, m.
pub const D1_M: f64 = 0.089159;
/// Shoulder to elbow, m; negative in the manufacturer's convention.
pub const A2_M: f64 = -0.425;
/// Elbow to wrist 1, m; negative in the manufacturer's convention.
pub const A3_M: f64 = -0.39225;
/// Sideways offset of the wrist from the arm's plane through the base axis, m.
pub const D4_M: f64 = 0.10915;
/// Wrist 1 to wrist 2, m.
pub const D5_M: f64 = 0.09465;
/// Wrist 3 to the flange, m.
pub const D6_M: f64 = 0.0823;
/// Offset of the upper arm's centre line from the plane of the joint frames, along the shoulder's axis.
pub const UPPER_ARM_ASIDE_M: f64 = 0.1358;
/// The same offset for the forearm.
pub const FOREARM_ASIDE_M: f64 = 0.0165;

/// One row of the Denavit-Hartenberg table, in the classic (distal) convention: the next frame is
/// reached by Rz(θ)·Tz(d)·Tx(a)·Rx(α).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DhRow {
    /// Offset along the joint's axis, m.
    pub d_m: f64,
    /// Length of the link, m.
    pub a_m: f64,
    /// Sine and cosine of half the link's twist α.
    pub half_twist: (f64, f64),
}

/// The Denavit-Hartenberg table, from the base to the flange.
pub const DH: [DhRow; 6] =
    [row(D1_M, 0.0, 1), row(0.0, A2_M, 0), row(0.0, A3_M, 0), row(D4_M, 0.0, 1), row(D5_M, 0.0, -1), row(D6_M, 0.0, 0)];

/// Joint limit, ± rad, the same for all joints.
pub const JOINT_LIMIT_RAD: f64 = 2.0 * PI;
/// Maximum speed of each joint, rad/s (180°/s).
pub const JOINT_SPEED_LIMIT_RAD_S: f64 = PI;
/// Period of the CB3 controller, s (125 Hz).
pub const SERVO_PERIOD_S: f64 = 0.008;

/// A row whose twist is `quarter_turns`·π/2: −1, 0 or 1.
const fn row(d_m: f64, a_m: f64, quarter_turns: i32) -> DhRow {
    let half_twist =
        if quarter_turns == 0 { (0.0, 1.0) } else { (quarter_turns as f64 * FRAC_1_SQRT_2, FRAC_1_SQRT_2) };
    DhRow { d_m, a_m, half_twist }
}
