//! The joint servo: single integrators that follow a reference within the joints' speed limits.

use super::{
    Joints,
    ur5::{JOINT_SPEED_LIMIT_RAD_S, SERVO_PERIOD_S},
};

/// The joints (rad) one servo period of 8 ms after `joints`.
///
/// `reference` is the reference now, `next_reference` the one at the end of the period (both in rad).
/// `gain_per_s` is the gain K2 of the paper's joint loop, 1/s. The speed is
/// q̇ = (next_reference − reference)/dt + K2·(reference − q): the speed of the reference plus a term that
/// makes the error decay as exp(−K2·t). The loop is stable for 0 < K2 < 2/dt = 250 /s.
///
/// If any joint would exceed [`JOINT_SPEED_LIMIT_RAD_S`], all joints slow down by the same factor, so the
/// direction of motion stays the same. NaN inputs give NaN joints.
pub fn step(joints: &Joints, reference: &Joints, next_reference: &Joints, gain_per_s: f64) -> Joints {
    let speed_rad_s: Joints = std::array::from_fn(|i| {
        (next_reference[i] - reference[i]) / SERVO_PERIOD_S + gain_per_s * (reference[i] - joints[i])
    });
    let fastest_rad_s = speed_rad_s.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let factor = if fastest_rad_s > JOINT_SPEED_LIMIT_RAD_S { JOINT_SPEED_LIMIT_RAD_S / fastest_rad_s } else { 1.0 };
    std::array::from_fn(|i| joints[i] + factor * speed_rad_s[i] * SERVO_PERIOD_S)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const GAIN_PER_S: f64 = 4.0;

    #[test]
    fn a_moving_reference_is_followed_without_lag() {
        let reference = |k: f64| -> Joints { std::array::from_fn(|i| 0.01 * k * (i as f64 - 2.5)) };
        let mut joints = reference(0.0);
        for k in 0..200 {
            joints = step(&joints, &reference(k.into()), &reference(f64::from(k) + 1.0), GAIN_PER_S);
        }
        for (joint, target) in joints.iter().zip(reference(200.0)) {
            assert!((joint - target).abs() < 1e-12);
        }
    }

    #[test]
    fn an_error_decays_with_the_gain() {
        let mut joints = [0.1; 6];
        for _ in 0..125 {
            joints = step(&joints, &[0.0; 6], &[0.0; 6], GAIN_PER_S);
        }
        let expected = 0.1 * (1.0 - GAIN_PER_S * SERVO_PERIOD_S).powi(125);
        assert!(joints.iter().all(|q| (q - expected).abs() < 1e-12));
    }

    proptest! {
        #[test]
        fn no_joint_exceeds_its_speed_and_direction_is_kept(
            joints in prop::array::uniform6(-6.0..6.0),
            reference in prop::array::uniform6(-6.0..6.0),
            next in prop::array::uniform6(-6.0..6.0),
        ) {
            let after = step(&joints, &reference, &next, GAIN_PER_S);
            let wanted: Joints = std::array::from_fn(|i| {
                (next[i] - reference[i]) / SERVO_PERIOD_S + GAIN_PER_S * (reference[i] - joints[i])
            });
            let made: Joints = std::array::from_fn(|i| (after[i] - joints[i]) / SERVO_PERIOD_S);
            for i in 0..6 {
                prop_assert!(made[i].abs() <= JOINT_SPEED_LIMIT_RAD_S * (1.0 + 1e-9));
                for j in 0..6 {
                    let turn = made[i] * wanted[j] - made[j] * wanted[i];
                    prop_assert!(turn.abs() < 1e-7);
                }
            }
        }
    }
}
