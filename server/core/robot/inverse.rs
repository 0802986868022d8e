//! Inverse kinematics: a flange pose to joint angles, in closed form.
//!
//! The six equations and the order of solution (θ1, θ5, θ6, θ2+θ3+θ4, θ3, θ2, θ4) follow Hawkins,
//! "Analytic Inverse Kinematics for the Universal Robots UR-5/UR-10 Arms" (Georgia Tech, 2013). Three
//! things differ, each because the published form fails for some poses:
//! - all angles come from `atan2`; `acos` loses half the digits near its ends;
//! - θ2+θ3+θ4 is fitted to all three axes of the flange. The published form uses the x axis alone, which
//!   is undetermined if cos θ5 = sin θ6 = 0, for example with the tool straight down and θ1 = 0;
//! - an unreachable pose returns a typed error with the missing distance; no result is ever NaN.
//!
//! θ1 and the sign of s5 have two values each. The four combinations are computed together in the lanes
//! of a vector. Angles are kept as sine and cosine until the last step.

use super::{
    Joints,
    ur5::{A2_M, A3_M, D1_M, D4_M, D5_M, D6_M, JOINT_LIMIT_RAD},
};
use crate::geometry::Isometry3;
use std::f64::consts::{PI, TAU};
use wide::f64x4;

/// Tolerance for rounding: a pose computed by [`super::forward::flange`] at a singularity may miss it by
/// about 1e-16, while clamping 1e-13 moves the flange by less than 1e-12 m.
const ROUNDING: f64 = 1e-13;

/// The four lanes: the sign of the wrist's distance along the arm's plane, which distinguishes the two
/// values of θ1, and the sign of s5.
const SHOULDER: f64x4 = f64x4::new([1.0, 1.0, -1.0, -1.0]);
const WRIST: f64x4 = f64x4::new([1.0, -1.0, 1.0, -1.0]);

/// Weight of each joint in [`nearest`]: the first three joints move the whole arm and count twice as much
/// as those of the wrist.
const WEIGHTS: [f64; 6] = [1.0, 1.0, 1.0, 0.5, 0.5, 0.5];

#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InverseError {
    /// An input is NaN or infinite.
    #[error("{input} holds {value}, which is not a finite number")]
    NonFinite {
        /// `flange` or `seed`.
        input: &'static str,
        value: f64,
    },
    /// The wrist would lie inside the cylinder of radius `d4` about the base axis.
    #[error("the wrist is {missing_m} m too close to the base axis")]
    ShoulderCylinder {
        /// How much farther from the axis the wrist must be, m.
        missing_m: f64,
    },
    /// The wrist is beyond the straight arm, or inside the folded one.
    #[error("the pose is {missing_m} m out of reach")]
    OutOfReach {
        /// By how much the best branch misses, m.
        missing_m: f64,
    },
    /// No branch, and no copy of it turned by 360°, is inside the joint limits.
    #[error("joint {joint} would be at {angle_rad} rad, outside its limits")]
    JointLimit {
        /// The joint, 0 (base) to 5 (wrist 3), of the first branch refused.
        joint: usize,
        /// Its angle in (−π, π], rad.
        angle_rad: f64,
    },
}

/// Up to eight joint solutions, every angle in (−π, π], stored without an allocation.
///
/// The order is fixed: shoulder (θ1's sign +, −), then wrist (s5 +, −), then elbow (s3 +, −); branches
/// that do not exist are omitted, and branches that coincide exactly appear once.
#[derive(Clone, Copy, Debug)]
pub struct Solutions {
    joints: [Joints; 8],
    count: usize,
}

impl Solutions {
    fn push(&mut self, joints: Joints) {
        self.joints[self.count] = joints;
        self.count += 1;
    }
}

impl std::ops::Deref for Solutions {
    type Target = [Joints];

    fn deref(&self) -> &[Joints] {
        &self.joints[..self.count]
    }
}

impl<'a> IntoIterator for &'a Solutions {
    type Item = &'a Joints;
    type IntoIter = std::slice::Iter<'a, Joints>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// All joint solutions of `base_from_flange` (m): at least one.
///
/// `seed` (rad) gives θ6 if the pose does not determine it, that is if s5 = 0 and wrist 3 turns about
/// the axis of wrist 1; otherwise it is not used.
///
/// # Errors
/// [`InverseError::NonFinite`], [`InverseError::ShoulderCylinder`], [`InverseError::OutOfReach`].
pub fn solutions(flange: &Isometry3<f64>, seed: &Joints) -> Result<Solutions, InverseError> {
    check_finite(flange, seed)?;
    let rotation = flange.rotation.to_rotation_matrix().into_inner();
    // Origin of frame 5: it does not move with wrist 3.
    let wrist = flange.translation.vector - rotation.column(2) * D6_M;
    let radius_m = wrist.x.hypot(wrist.y);
    if radius_m < D4_M - ROUNDING {
        return Err(InverseError::ShoulderCylinder { missing_m: D4_M - radius_m });
    }

    // θ1: the wrist is d4 off the arm's plane, s1·wx − c1·wy = d4, and √H along it. H is computed from its
    // factors: a difference of squares would lose digits near the cylinder.
    let root_h = (radius_m - D4_M).max(0.0).sqrt() * (radius_m + D4_M).sqrt();
    let off = D4_M / radius_m.max(D4_M);
    let on = SHOULDER * (root_h / radius_m.max(D4_M));
    let (x, y) = (wrist.x / radius_m, wrist.y / radius_m);
    let s1 = x * off - on * y;
    let c1 = -y * off - on * x;

    // The flange's axes in the arm's plane: `along` is horizontal, `across` is the plane's normal.
    let axes = [0, 1, 2].map(|k| rotation.column(k));
    let along = axes.map(|axis| c1 * axis.x + s1 * axis.y);
    let across = axes.map(|axis| s1 * axis.x - c1 * axis.y);
    let up = axes.map(|axis| axis.z);

    // How far wrist 3 is bent from wrist 1's axis: |s5|.
    let bend = (across[0] * across[0] + across[1] * across[1]).sqrt();
    let (s5, c5) = (WRIST * bend, across[2]);
    let (mut s6, mut c6) = (-across[1] / s5, across[0] / s5);
    let mut theta6 = s6.atan2(c6);
    let is_free = bend.simd_lt(f64x4::splat(ROUNDING));
    if is_free.any() {
        let seed6 = (seed[5] - TAU * (seed[5] / TAU).round()).clamp(-PI, PI);
        theta6 = is_free.select(f64x4::splat(seed6), theta6);
        s6 = is_free.select(f64x4::splat(seed6.sin()), s6);
        c6 = is_free.select(f64x4::splat(seed6.cos()), c6);
    }

    // (along_k, up_k) is `flat_k` rotated by θ234, for each axis k of the flange: fit the rotation. Half the
    // sum, because the squared projections of three orthonormal axes onto a plane add up to two.
    let flat = [[c5 * c6, s6], [-c5 * s6, c6], [-s5, f64x4::ZERO]];
    let (mut s234, mut c234) = (f64x4::ZERO, f64x4::ZERO);
    for (k, [a, b]) in flat.into_iter().enumerate() {
        s234 += 0.5 * (a * up[k] - b * along[k]);
        c234 += 0.5 * (a * along[k] + b * up[k]);
    }
    let theta234 = s234.atan2(c234);

    // Wrist 1 seen from the shoulder, in the arm's plane.
    let kc = c1 * wrist.x + s1 * wrist.y - s234 * D5_M;
    let ks = wrist.z - D1_M + c234 * D5_M;
    let c3 = (ks * ks + kc * kc - A2_M * A2_M - A3_M * A3_M) / (2.0 * A2_M * A3_M);
    let s3 = ((1.0 - c3) * (1.0 + c3)).max(f64x4::ZERO).sqrt();
    let theta3 = s3.atan2(c3);

    // θ2 = atan2(ks, kc) − atan2(a3·s3, a2 + a3·c3), for either elbow.
    let (x, y) = (A3_M * c3 + A2_M, A3_M * s3);
    let theta2 = [(ks * x - kc * y).atan2(kc * x + ks * y), (ks * x + kc * y).atan2(kc * x - ks * y)];
    let theta4 = [wrapped(theta234 - theta2[0]) - theta3, wrapped(theta234 - theta2[1]) + theta3];

    // Also false for NaN, which results if squares overflow.
    let is_reached = c3.abs().simd_le(f64x4::splat(1.0 + ROUNDING)).to_bitmask();
    let is_free = is_free.to_bitmask();
    let is_straight = s3.simd_eq(f64x4::ZERO).to_bitmask();
    let theta1 = wrapped(s1.atan2(c1)).to_array();
    let theta2 = theta2.map(|theta2| wrapped(theta2).to_array());
    let theta3 = theta3.to_array();
    let theta4 = theta4.map(|theta4| wrapped(theta4).to_array());
    let theta5 = s5.atan2(c5).to_array();
    let theta6 = wrapped(theta6).to_array();
    let mut found = Solutions { joints: [[0.0; 6]; 8], count: 0 };
    let mut least_missing_m = f64::INFINITY;
    for lane in 0..4 {
        let is_in = |mask: u32| mask >> lane & 1 != 0;
        // Both signs of a zero are one branch.
        if (lane >= 2 && root_h == 0.0) || (lane % 2 == 1 && is_in(is_free)) {
            continue;
        }
        if !is_in(is_reached) {
            least_missing_m = least_missing_m.min(missing_m(kc.to_array()[lane], ks.to_array()[lane]));
            continue;
        }
        found.push([theta1[lane], theta2[0][lane], theta3[lane], theta4[0][lane], theta5[lane], theta6[lane]]);
        if !is_in(is_straight) {
            found.push([theta1[lane], theta2[1][lane], -theta3[lane], theta4[1][lane], theta5[lane], theta6[lane]]);
        }
    }
    if found.is_empty() {
        return Err(InverseError::OutOfReach { missing_m: least_missing_m });
    }
    Ok(found)
}

/// The solution of `base_from_flange` nearest to `seed` (rad), inside ±[`JOINT_LIMIT_RAD`].
///
/// See [`nearest_within`]. The UR5's limits are a full turn in each direction, so every branch has an
/// equivalent inside them.
///
/// # Errors
/// Those of [`solutions`].
pub fn nearest(flange: &Isometry3<f64>, seed: &Joints) -> Result<Joints, InverseError> {
    nearest_within(flange, seed, &[[-JOINT_LIMIT_RAD, JOINT_LIMIT_RAD]; 6])
}

/// The solution of `base_from_flange` nearest to `seed` (rad) among all branches and their equivalents
/// (± 360° per joint), inside `limits_rad` (`[min, max]` per joint).
///
/// The distance is the sum of squared angles; the first three joints weigh twice as much as the wrist's.
/// Along a path, with the previous solution as the seed, it stays on the same branch.
///
/// # Errors
/// Those of [`solutions`], and [`InverseError::JointLimit`] if nothing is inside the limits.
pub fn nearest_within(
    flange: &Isometry3<f64>,
    seed: &Joints,
    limits_rad: &[[f64; 2]; 6],
) -> Result<Joints, InverseError> {
    let mut best: Option<(f64, Joints)> = None;
    let mut refusal = None;
    for branch in &solutions(flange, seed)? {
        match nearest_copy(branch, seed, limits_rad) {
            Ok(joints) => {
                let distance = distance2(&joints, seed);
                if best.is_none_or(|(least, _)| distance < least) {
                    best = Some((distance, joints));
                }
            }
            Err(error) => refusal = refusal.or(Some(error)),
        }
    }
    best.map(|(_, joints)| joints).ok_or_else(|| refusal.expect("one of the solutions is refused"))
}

/// Distance of wrist 1, at (`kc_m`, `ks_m`) from the shoulder, from the range that the two links reach, m.
fn missing_m(kc_m: f64, ks_m: f64) -> f64 {
    let distance_m = kc_m.hypot(ks_m);
    let nearest_m = distance_m.clamp((A2_M - A3_M).abs(), (A2_M + A3_M).abs());
    (distance_m - nearest_m).abs()
}

/// Maps `angle_rad` from [−2π, 2π] to (−π, π].
fn wrapped(angle_rad: f64x4) -> f64x4 {
    let is_above = angle_rad.simd_gt(f64x4::PI);
    let is_below = angle_rad.simd_le(-f64x4::PI);
    angle_rad - (is_above & f64x4::TAU) + (is_below & f64x4::TAU)
}

/// The equivalent of `branch` nearest to `seed` and inside the limits, chosen for each joint separately.
fn nearest_copy(branch: &Joints, seed: &Joints, limits_rad: &[[f64; 2]; 6]) -> Result<Joints, InverseError> {
    let mut copy = *branch;
    for joint in 0..6 {
        let [least_rad, most_rad] = limits_rad[joint];
        copy[joint] += TAU * whole((seed[joint] - branch[joint]) / TAU);
        if copy[joint] < least_rad || copy[joint] > most_rad {
            copy[joint] = copy_inside(joint, branch[joint], seed[joint], limits_rad[joint])?;
        }
    }
    Ok(copy)
}

/// The equivalent of `angle_rad` inside the limits that is nearest to a seed outside them.
#[cold]
fn copy_inside(joint: usize, angle_rad: f64, seed_rad: f64, limits_rad: [f64; 2]) -> Result<f64, InverseError> {
    let turns_to = |target_rad: f64| (target_rad - angle_rad) / TAU;
    let [fewest, most] = [turns_to(limits_rad[0]).ceil(), turns_to(limits_rad[1]).floor()];
    if fewest > most {
        return Err(InverseError::JointLimit { joint, angle_rad });
    }
    Ok(angle_rad + TAU * turns_to(seed_rad).round().max(fewest).min(most))
}

/// `number` rounded to an integer, inlined; `f64::round` is a function call.
fn whole(number: f64) -> f64 {
    // From here on, floating-point numbers are one apart.
    const SHIFT: f64 = 1.5 * (1_u64 << 52) as f64;
    (number + SHIFT) - SHIFT
}

fn distance2(joints: &Joints, seed: &Joints) -> f64 {
    (0..6).map(|i| WEIGHTS[i] * (joints[i] - seed[i]).powi(2)).sum()
}

fn check_finite(flange: &Isometry3<f64>, seed: &Joints) -> Result<(), InverseError> {
    let pose = flange.translation.vector.iter();
    let pose = pose.chain(flange.rotation.coords.iter());
    let inputs = pose.map(|value| ("flange", value));
    for (input, &value) in inputs.chain(seed.iter().map(|value| ("seed", value))) {
        if !value.is_finite() {
            return Err(InverseError::NonFinite { input, value });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::forward;

    #[test]
    fn wrapped_angles_stay_in_their_interval() {
        for (angle_rad, expected_rad) in [(-PI, PI), (PI, PI), (-TAU, 0.0), (TAU, 0.0), (4.0, 4.0 - TAU), (0.5, 0.5)] {
            assert_eq!(wrapped(f64x4::splat(angle_rad)), f64x4::splat(expected_rad));
        }
        assert!(wrapped(f64x4::splat(PI.next_up())).simd_gt(f64x4::splat(-PI)).all());
        assert!(wrapped(f64x4::splat((-PI).next_down())).simd_le(f64x4::PI).all());
    }

    #[test]
    fn a_distant_seed_still_gives_joints_within_limits() {
        let flange = forward::flange(&[0.4, -1.0, 1.2, 0.3, 0.0, 0.7]);
        for seed_rad in [1e15, -1e200, f64::MAX] {
            let found = nearest(&flange, &[seed_rad; 6]).unwrap();
            assert!(found.iter().all(|q| q.abs() <= JOINT_LIMIT_RAD), "{found:?}");
        }
    }
}
