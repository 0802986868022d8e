//! The geometric Jacobian of the flange, and the distance from a singularity.

use super::{
    Joints, forward,
    ur5::{A2_M, A3_M, D5_M},
};
use crate::geometry::{Matrix6, Vector3};

/// The Jacobian J of the flange in `base`: (linear velocity m/s, angular velocity rad/s) = J·q̇.
///
/// Rows 0 to 2 are linear (m), rows 3 to 5 angular (unitless); column i belongs to joint i. Column i is
/// (z × (p − o), z) with z the joint's axis, o a point of it and p the flange (Siciliano et al.,
/// *Robotics: Modelling, Planning and Control*, 2009, §3.1.3).
pub fn geometric(joints: &Joints) -> Matrix6<f64> {
    let frames = forward::link_frames(joints);
    let flange = frames[5].translation.vector;
    let mut jacobian = Matrix6::zeros();
    let (mut axis, mut origin) = (Vector3::z(), Vector3::zeros());
    for (joint, frame) in frames.iter().enumerate() {
        let linear = axis.cross(&(flange - origin));
        jacobian.fixed_view_mut::<3, 1>(0, joint).copy_from(&linear);
        jacobian.fixed_view_mut::<3, 1>(3, joint).copy_from(&axis);
        axis = frame.rotation * Vector3::z();
        origin = frame.translation.vector;
    }
    jacobian
}

/// The factors of det J that change sign: the shoulder's a2·c2 + a3·c23 + d5·s234 (m), the wrist's s5 and
/// the elbow's s3.
///
/// Each is zero at one kind of singularity: wrist on the shoulder's cylinder around the base axis; wrist 3
/// parallel to wrist 1; elbow straight.
pub fn factors(joints: &Joints) -> [f64; 3] {
    let [_, theta2, theta3, theta4, theta5, _] = *joints;
    let shoulder_m = A2_M * theta2.cos() + A3_M * (theta2 + theta3).cos() + D5_M * (theta2 + theta3 + theta4).sin();
    [shoulder_m, theta5.sin(), theta3.sin()]
}

/// |det J| in m³: |a2·a3| times its [`factors`].
///
/// It is Yoshikawa's measure of manipulability for an arm of six joints (1985).
pub fn manipulability(joints: &Joints) -> f64 {
    (A2_M * A3_M * factors(joints).iter().product::<f64>()).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn manipulability_is_the_determinant(
            joints in prop::array::uniform6(-2.0 * PI..2.0 * PI),
        ) {
            let determinant = geometric(&joints).determinant().abs();
            prop_assert!((determinant - manipulability(&joints)).abs() < 1e-15);
        }

        #[test]
        fn columns_match_numerical_derivatives(joints in prop::array::uniform6(-PI..PI)) {
            let step_rad = 1e-5;
            let jacobian = geometric(&joints);
            for joint in 0..6 {
                let [mut before, mut after] = [joints; 2];
                before[joint] -= 0.5 * step_rad;
                after[joint] += 0.5 * step_rad;
                let (before, after) = (forward::flange(&before), forward::flange(&after));
                let moved = (after.translation.vector - before.translation.vector) / step_rad;
                let turned = (after.rotation * before.rotation.inverse()).scaled_axis() / step_rad;
                let column = jacobian.column(joint);
                prop_assert!((moved - column.fixed_rows::<3>(0)).norm() < 1e-9);
                prop_assert!((turned - column.fixed_rows::<3>(3)).norm() < 1e-9);
            }
        }
    }

    #[test]
    fn manipulability_is_zero_at_singularities() {
        assert_eq!(manipulability(&[0.3, -1.0, 0.0, 0.2, 1.0, 0.4]), 0.0);
        assert_eq!(manipulability(&[0.3, -1.0, 1.0, 0.2, 0.0, 0.4]), 0.0);
    }
}
