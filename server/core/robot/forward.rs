//! Forward kinematics: joint angles to poses.

use super::{
    Joints,
    ur5::{DH, DhRow},
};
use crate::geometry::Isometry3;
use nalgebra::{Quaternion, Translation3, UnitQuaternion};

/// The pose `base_from_flange` at `joints` (rad), metres.
///
/// NaN joints give a NaN pose; no value panics.
pub fn flange(joints: &Joints) -> Isometry3<f64> {
    link_frames(joints)[5]
}

/// The poses `base_from_frame` of the Denavit-Hartenberg frames 1 to 6, metres.
///
/// Frame i is fixed to link i and lies at its far end; frame 6 is the flange. Frame 1 lies in the
/// shoulder, frame 2 in the elbow, frame 3 in wrist 1.
pub fn link_frames(joints: &Joints) -> [Isometry3<f64>; 6] {
    let mut base_from_frame = Isometry3::identity();
    std::array::from_fn(|i| {
        base_from_frame *= link(&DH[i], joints[i]);
        base_from_frame
    })
}

/// Rz(θ)·Tz(d)·Tx(a)·Rx(α): the next frame relative to this one.
pub fn link(row: &DhRow, theta_rad: f64) -> Isometry3<f64> {
    let (sin, cos) = theta_rad.sin_cos();
    let (half_sin, half_cos) = (0.5 * theta_rad).sin_cos();
    let (twist_sin, twist_cos) = row.half_twist;
    let shift = Translation3::new(row.a_m * cos, row.a_m * sin, row.d_m);
    // The product of the quaternions of Rz(θ) and Rx(α).
    let turn = Quaternion::new(half_cos * twist_cos, half_cos * twist_sin, half_sin * twist_sin, half_sin * twist_cos);
    Isometry3::from_parts(shift, UnitQuaternion::new_unchecked(turn))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector3;
    use crate::robot::ur5;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn stretched_arm_matches_the_reference_table() {
        let pose = flange(&[0.0; 6]);
        let expected = Vector3::new(-0.81725, -0.19145, -0.00549);
        // The reference is printed to five decimals: its z is 0.089159 − 0.09465 = −0.005491.
        assert!((pose.translation.vector - expected).amax() < 5e-6);
        // The flange points along base −y.
        assert!((pose.rotation * Vector3::z() + Vector3::y()).norm() < 1e-15);
    }

    #[test]
    fn upright_arm_is_above_the_base() {
        let pose = flange(&[0.0, -FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0]);
        let top_m = ur5::D1_M - ur5::A2_M - ur5::A3_M + ur5::D5_M;
        let expected = Vector3::new(0.0, -ur5::D4_M - ur5::D6_M, top_m);
        assert!((pose.translation.vector - expected).amax() < 1e-15);
    }

    proptest! {
        #[test]
        fn links_keep_their_lengths(joints in prop::array::uniform6(-2.0 * PI..2.0 * PI)) {
            let frames = link_frames(&joints);
            let mut previous = Isometry3::identity();
            for (frame, row) in frames.iter().zip(DH) {
                let length_m = (frame.translation.vector - previous.translation.vector).norm();
                prop_assert!((length_m - row.a_m.hypot(row.d_m)).abs() < 1e-14);
                prop_assert!((frame.rotation.norm() - 1.0).abs() < 1e-14);
                previous = *frame;
            }
            prop_assert_eq!(frames[5], flange(&joints));
        }

        #[test]
        fn first_joint_rotates_all_frames(
            joints in prop::array::uniform6(-PI..PI),
            turn_rad in -PI..PI,
        ) {
            let mut turned = joints;
            turned[0] += turn_rad;
            let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn_rad);
            let expected = rotation * flange(&joints);
            let found = flange(&turned);
            prop_assert!((found.translation.vector - expected.translation.vector).norm() < 1e-14);
            prop_assert!(found.rotation.angle_to(&expected.rotation) < 1e-7);
        }
    }
}
