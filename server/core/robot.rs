//! The arm: a Universal Robots UR5 (CB3), as pure functions of joint angles.
//!
//! - [`ur5`]: lengths and limits from the manufacturer's tables.
//! - [`forward`]: joints → flange pose, and every link frame for drawing.
//! - [`inverse`]: flange pose → all closed-form joint solutions, or a typed refusal.
//! - [`jacobian`]: joint speeds → flange twist; distance from a singularity.
//! - [`servo`]: the joints as speed-limited integrators at 125 Hz, the controller's rate.
//! - [`workspace`]: the manipulability over a horizontal plane, as a map.
//!
//! Poses are `base_from_flange`: metres, in the UR5's `base` frame (z up, origin on the table under
//! joint 1). Angles are radians. This module has no magnets, tools or maps, and no state.

pub mod forward;
pub mod inverse;
pub mod jacobian;
pub mod servo;
pub mod ur5;
pub mod workspace;

use nalgebra::{Quaternion, UnitQuaternion};
use std::f64::consts::FRAC_1_SQRT_2;

/// Joint angles in rad: base, shoulder, elbow, wrist 1, wrist 2, wrist 3.
pub type Joints = [f64; 6];

/// The rotation `base_from_flange` of a flange that points straight down.
///
/// The rotation vector is (π/√2)(1, −1, 0): half a turn, so that the flange's x is base −y, its y is
/// base −x and its z is base −z.
pub fn tool_down() -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(0.0, FRAC_1_SQRT_2, -FRAC_1_SQRT_2, 0.0))
}

/// Minimum and maximum horizontal distance `(r_min_m, r_max_m)` from the base axis that the flange
/// reaches while it points straight down at height `flange_z_m` above the table.
///
/// `None` if the height is too large, too small, or NaN.
///
/// With the tool down, wrist 1 and wrist 2 lie in one horizontal plane, `d5` apart, and the upper arm
/// and the forearm must bridge the rest in the vertical plane that `d4` offsets from the base axis:
/// r_max = √((√((a2+a3)² − (z+d6−d1)²) + d5)² + d4²). The minimum distance is `d4`, except near the
/// extreme heights, where the nearly straight arm spans less than `d5`.
pub fn reach(flange_z_m: f64) -> Option<(f64, f64)> {
    let rise_m = flange_z_m + ur5::D6_M - ur5::D1_M;
    // NaN if the straight arm is too short, or if the height is NaN.
    let span_m = ((ur5::A2_M + ur5::A3_M).powi(2) - rise_m * rise_m).sqrt();
    if span_m.is_nan() {
        return None;
    }
    let least_m = (ur5::D5_M - span_m).max(0.0);
    Some((least_m.hypot(ur5::D4_M), (span_m + ur5::D5_M).hypot(ur5::D4_M)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Isometry3, Vector3};
    use inverse::InverseError;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    const SEED: Joints = [0.1, -1.2, 1.5, -1.8, -1.4, 0.6];

    /// The flange pointing straight down over (x, y) at height z, m.
    fn down_over(x_m: f64, y_m: f64, z_m: f64) -> Isometry3<f64> {
        Isometry3::from_parts(Vector3::new(x_m, y_m, z_m).into(), tool_down())
    }

    /// Distance between the pose of `joints` and `flange`: the larger of metres and entries of the rotation matrix.
    fn miss(joints: &Joints, flange: &Isometry3<f64>) -> f64 {
        let found = forward::flange(joints);
        let shift = found.translation.vector - flange.translation.vector;
        let turn = found.rotation.to_rotation_matrix().into_inner() - flange.rotation.to_rotation_matrix().into_inner();
        shift.amax().max(turn.amax())
    }

    fn apart(a: &Joints, b: &Joints) -> f64 {
        (0..6).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
    }

    fn solvable(r_m: f64, z_m: f64) -> bool {
        inverse::solutions(&down_over(0.0, -r_m, z_m), &SEED).is_ok()
    }

    #[test]
    fn tool_down_is_half_a_turn_about_the_diagonal() {
        let vector = Vector3::new(1.0, -1.0, 0.0) * (PI / 2.0_f64.sqrt());
        assert!((tool_down().scaled_axis() - vector).norm() < 1e-15);
        assert!((tool_down() * Vector3::z() + Vector3::z()).norm() < 1e-15);
        assert!((tool_down() * Vector3::x() + Vector3::y()).norm() < 1e-15);
    }

    #[test]
    fn reach_limits_match_inverse_kinematics() {
        for z_m in [-0.5, 0.0, 0.1, 0.28, 0.5, 0.7, 0.8235] {
            let (r_min_m, r_max_m) = reach(z_m).unwrap();
            assert!(solvable(r_min_m + 1e-9, z_m), "{z_m}");
            assert!(!solvable(r_min_m - 1e-9, z_m), "{z_m}");
            assert!(solvable(r_max_m - 1e-9, z_m), "{z_m}");
            assert!(!solvable(r_max_m + 1e-9, z_m), "{z_m}");
        }
        assert_eq!(reach(0.28).unwrap().0, ur5::D4_M);
    }

    #[test]
    fn reaches_nothing_beyond_the_straight_arm() {
        assert_eq!(reach(0.9), None);
        assert_eq!(reach(-0.9), None);
        assert_eq!(reach(f64::NAN), None);
        assert_eq!(reach(f64::INFINITY), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn every_branch_leads_back_to_the_pose(
            joints in prop::array::uniform6(-2.0 * PI..2.0 * PI),
        ) {
            let flange = forward::flange(&joints);
            let branches = inverse::solutions(&flange, &SEED).unwrap();
            for branch in &branches {
                prop_assert!(miss(branch, &flange) <= 1e-12, "{branch:?}");
                prop_assert!(branch.iter().all(|q| -PI < *q && *q <= PI));
            }
            // Near a singularity the pose hardly determines the joints; the joints always determine the pose.
            if jacobian::manipulability(&joints) > 1e-4 {
                let found = inverse::nearest(&flange, &joints).unwrap();
                prop_assert!(apart(&found, &joints) < 1e-8, "{found:?}");
            }
        }
    }

    #[test]
    fn singular_poses_have_solutions_without_nan() {
        // All joints at multiples of a quarter turn: straight elbows, aligned wrists, and both.
        for index in 0..4_usize.pow(6) {
            let quarters: [usize; 6] = std::array::from_fn(|i| index / 4_usize.pow(i as u32) % 4);
            let joints = quarters.map(|n| n as f64 * FRAC_PI_2 - FRAC_PI_2);
            let flange = forward::flange(&joints);
            let branches = inverse::solutions(&flange, &joints).unwrap();
            for branch in &branches {
                assert!(miss(branch, &flange) <= 1e-12, "{joints:?} {branch:?}");
            }
        }
    }

    #[test]
    fn wrist_on_the_shoulder_cylinder_is_reached() {
        // Turn wrist 1 until the wrist is above the base axis: a2·c2 + a3·c23 + d5·s234 = 0.
        for k in 0..100 {
            let theta2 = -FRAC_PI_2 + 0.0005 * f64::from(k);
            let theta23 = -FRAC_PI_2 - 0.0002 * f64::from(k);
            let rest_m = ur5::A2_M * theta2.cos() + ur5::A3_M * theta23.cos();
            let theta234 = (-rest_m / ur5::D5_M).asin();
            let joints = [1.0, theta2, theta23 - theta2, theta234 - theta23, 1.1, 0.4];
            assert!(jacobian::manipulability(&joints) < 1e-15);
            let flange = forward::flange(&joints);
            for branch in &inverse::solutions(&flange, &SEED).unwrap() {
                assert!(miss(branch, &flange) <= 1e-12, "{joints:?} {branch:?}");
            }
        }
    }

    #[test]
    fn undetermined_wrist_angle_is_taken_from_the_seed() {
        let flange = forward::flange(&[0.4, -1.0, 1.2, 0.3, 0.0, 0.7]);
        for branch in &inverse::solutions(&flange, &SEED).unwrap() {
            if branch[4].abs() < 1e-12 {
                assert_eq!(branch[5], SEED[5]);
            }
        }
        let seed = [0.4, -1.0, 1.2, 0.3, 0.0, 0.6];
        let found = inverse::nearest(&flange, &seed).unwrap();
        assert!(found[5] == 0.6 && apart(&found, &seed) < 0.2, "{found:?}");
        assert!(miss(&found, &flange) <= 1e-12);
    }

    #[test]
    fn rejects_unreachable_poses_with_the_missing_distance() {
        let refusal = |flange: &Isometry3<f64>| inverse::solutions(flange, &SEED).unwrap_err();
        for (x_m, missing) in [(0.0, ur5::D4_M), (0.05, ur5::D4_M - 0.05)] {
            match refusal(&down_over(x_m, 0.0, 0.3)) {
                InverseError::ShoulderCylinder { missing_m } => {
                    assert!((missing_m - missing).abs() < 1e-15);
                }
                other => panic!("{other}"),
            }
        }
        let far = Isometry3::translation(0.0, -ur5::D4_M, 3.0);
        match refusal(&far) {
            InverseError::OutOfReach { missing_m } => assert!((1.5..2.5).contains(&missing_m)),
            other => panic!("{other}"),
        }
        let mut flange = down_over(0.3, 0.3, 0.3);
        flange.translation.vector.y = f64::NAN;
        assert!(matches!(
            refusal(&flange),
            InverseError::NonFinite { input: "flange", value } if value.is_nan()
        ));
        let seed = [0.0, 0.0, f64::INFINITY, 0.0, 0.0, 0.0];
        let error = inverse::nearest(&down_over(0.3, 0.3, 0.3), &seed).unwrap_err();
        assert_eq!(error, InverseError::NonFinite { input: "seed", value: f64::INFINITY });
    }

    #[test]
    fn joint_limits_select_the_equivalent_angle_or_reject_the_pose() {
        let joints = [3.0, -1.2, 1.5, -1.8, -1.4, -3.0];
        let flange = forward::flange(&joints);
        let turned = joints.map(|q| q + if q < 0.0 { 2.0 * PI } else { -2.0 * PI });
        assert!(apart(&inverse::nearest(&flange, &turned).unwrap(), &turned) < 1e-9);
        let far = inverse::nearest(&flange, &[1e3; 6]).unwrap();
        assert!(far.iter().all(|q| q.abs() <= ur5::JOINT_LIMIT_RAD));
        let mut limits_rad = [[-PI, PI]; 6];
        let found = inverse::nearest_within(&flange, &turned, &limits_rad).unwrap();
        assert!(found.iter().all(|q| q.abs() <= PI));
        limits_rad[1] = [2.5, 2.6];
        let error = inverse::nearest_within(&flange, &joints, &limits_rad).unwrap_err();
        assert!(matches!(error, InverseError::JointLimit { joint: 1, .. }), "{error}");
    }

    #[test]
    fn each_position_of_the_paper_has_eight_solutions() {
        // x and y in m; also x = ±d4, where θ1 = 0 or π and the published θ234 is undetermined.
        let places = [
            (-0.24, -0.27),
            (0.19, -0.28),
            (0.21, -0.34),
            (0.20, -0.47),
            (-0.19, -0.48),
            (-0.24, -0.28),
            (0.21, -0.40),
            (-0.4, -ur5::D4_M),
            (0.4, ur5::D4_M),
        ];
        for (x_m, y_m) in places {
            let flange = down_over(x_m, y_m, 0.28);
            let branches = inverse::solutions(&flange, &SEED).unwrap();
            assert_eq!(branches.len(), 8, "({x_m}, {y_m})");
            for branch in &branches {
                assert!(miss(branch, &flange) <= 1e-12, "{branch:?}");
            }
        }
    }

    #[test]
    fn a_straight_path_keeps_its_branch() {
        let mut joints = inverse::nearest(&down_over(-0.24, -0.27, 0.28), &SEED).unwrap();
        for k in 1..=1000 {
            let part = f64::from(k) / 1000.0;
            let flange = down_over(-0.24 + 0.45 * part, -0.27 - 0.13 * part, 0.28);
            let next = inverse::nearest(&flange, &joints).unwrap();
            assert!(apart(&next, &joints) < 0.01, "step {k}: {joints:?} to {next:?}");
            joints = next;
        }
    }
}
