//! Inverse kinematics: a flange pose to joint angles, in closed form.
//!
//! The six equations and the order of solution (θ1, θ5, θ6, θ2+θ3+θ4, θ3, θ2, θ4) follow Hawkins,
//! "Analytic Inverse Kinematics for the Universal Robots UR-5/UR-10 Arms" (Georgia Tech, 2013). Three
//! things differ, each because the published form fails somewhere:
//! - angles come from `atan2` alone; `acos` keeps only half the digits near its ends;
//! - θ2+θ3+θ4 is fitted to all three axes of the flange instead of its x axis alone, which says nothing
//!   when cos θ5 = sin θ6 = 0: the tool straight down and θ1 = 0 is such a pose;
//! - where there is no answer a typed error says by how much, and no value is ever NaN.

use super::{
    Joints,
    ur5::{A2_M, A3_M, D1_M, D4_M, D5_M, D6_M, JOINT_LIMIT_RAD},
};
use crate::geometry::{Isometry3, Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Excess that rounding explains: a pose computed by [`super::forward::flange`] at a singularity may
/// miss it by some 1e-16, while clamping 1e-13 moves the flange by less than 1e-12 m.
const ROUNDING: f64 = 1e-13;

/// What a radian of each joint counts in [`nearest`]: the three joints that carry the whole arm count
/// twice as much as those of the wrist.
const WEIGHTS: [f64; 6] = [1.0, 1.0, 1.0, 0.5, 0.5, 0.5];

/// Why a pose has no joint solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InverseError {
    /// An input is NaN or infinite.
    #[error("{input} holds {value}, which is not a finite number")]
    NonFinite {
        /// `flange` or `seed`.
        input: &'static str,
        /// The offending value.
        value: f64,
    },
    /// The wrist would lie inside the cylinder of radius `d4` about the base axis.
    #[error("the wrist is {missing_m} m too near to the base axis")]
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
    #[error("joint {joint} would stand at {angle_rad} rad, outside its limits")]
    JointLimit {
        /// The joint, 0 (base) to 5 (wrist 3), of the first branch refused.
        joint: usize,
        /// Its angle in (−π, π], rad.
        angle_rad: f64,
    },
}

/// Up to eight joint solutions, every angle in (−π, π], without an allocation.
///
/// The order is fixed: shoulder (θ1's sign +, −), then wrist (s5 +, −), then elbow (s3 +, −); branches
/// that do not exist are left out, and branches that coincide exactly appear once.
#[derive(Clone, Copy, Debug)]
pub struct Solutions {
    joints: [Joints; 8],
    count: usize,
}

impl Solutions {
    fn push(&mut self, joints: Joints) {
        self.joints[self.count] = joints.map(wrapped);
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

/// All joint solutions of `base_from_flange` (m); at least one.
///
/// `seed` (rad) gives θ6 where the pose leaves it free, that is where s5 = 0 and wrist 3 turns about
/// the axis of wrist 1; elsewhere it is not used.
///
/// # Errors
/// [`InverseError::NonFinite`], [`InverseError::ShoulderCylinder`], [`InverseError::OutOfReach`].
pub fn solutions(flange: &Isometry3<f64>, seed: &Joints) -> Result<Solutions, InverseError> {
    check_finite(flange, seed)?;
    let rotation = flange.rotation.to_rotation_matrix().into_inner();
    // Origin of frame 5: it does not move with wrist 3.
    let wrist = flange.translation.vector - rotation.column(2) * D6_M;

    // In frame 1 the wrist lies d4 off the arm's plane: s1·wx − c1·wy = d4.
    let radius_m = wrist.x.hypot(wrist.y);
    if radius_m < D4_M - ROUNDING {
        let missing_m = D4_M - radius_m;
        return Err(InverseError::ShoulderCylinder { missing_m });
    }
    // H as a product: a difference of squares would lose the digits that matter at the cylinder.
    let root_h = ((radius_m - D4_M).max(0.0) * (radius_m + D4_M)).sqrt();
    let toward = wrist.x.atan2(-wrist.y);
    let swing = root_h.atan2(D4_M);

    let mut found = Solutions { joints: [[0.0; 6]; 8], count: 0 };
    let mut least_missing_m = f64::INFINITY;
    for shoulder in signs(root_h) {
        let theta1 = toward + shoulder * swing;
        let missing_m = branches_of_shoulder(theta1, &rotation, &wrist, seed[5], &mut found);
        least_missing_m = least_missing_m.min(missing_m);
    }
    if found.is_empty() {
        return Err(InverseError::OutOfReach { missing_m: least_missing_m });
    }
    Ok(found)
}

/// The solution of `base_from_flange` nearest to `seed` (rad), inside ±[`JOINT_LIMIT_RAD`].
///
/// See [`nearest_within`]. The UR5's limits are a full turn each way, so that every branch has a copy
/// inside them.
///
/// # Errors
/// Those of [`solutions`].
pub fn nearest(flange: &Isometry3<f64>, seed: &Joints) -> Result<Joints, InverseError> {
    nearest_within(flange, seed, &[[-JOINT_LIMIT_RAD, JOINT_LIMIT_RAD]; 6])
}

/// The solution of `base_from_flange` nearest to `seed` (rad) among all branches and their copies
/// turned by 360°, inside `limits_rad` (`[least, greatest]` a joint).
///
/// Distance is the sum of squared angles, the arm's three joints weighing twice the wrist's. Called
/// along a path with the last answer as the seed, it keeps the branch.
///
/// # Errors
/// Those of [`solutions`], and [`InverseError::JointLimit`] if nothing is inside the limits.
pub fn nearest_within(
    flange: &Isometry3<f64>,
    seed: &Joints,
    limits_rad: &[[f64; 2]; 6],
) -> Result<Joints, InverseError> {
    let mut best = (f64::INFINITY, *seed);
    let mut refusal = None;
    for branch in &solutions(flange, seed)? {
        match nearest_copy(branch, seed, limits_rad) {
            Ok(joints) => {
                let distance = distance2(&joints, seed);
                if distance < best.0 {
                    best = (distance, joints);
                }
            }
            Err(error) => refusal = refusal.or(Some(error)),
        }
    }
    match refusal {
        Some(error) if best.0 == f64::INFINITY => Err(error),
        _ => Ok(best.1),
    }
}

/// Adds the branches of one θ1 to `found`; returns by how much, m, its nearest branch misses.
fn branches_of_shoulder(
    theta1: f64,
    rotation: &Matrix3<f64>,
    wrist: &Vector3<f64>,
    seed6: f64,
    found: &mut Solutions,
) -> f64 {
    let (s1, c1) = theta1.sin_cos();
    // The flange's axes in the arm's plane: `along` is horizontal, `across` is the plane's normal.
    let along = rotation.row(0) * c1 + rotation.row(1) * s1;
    let across = rotation.row(0) * s1 - rotation.row(1) * c1;
    let up = rotation.row(2);

    let mut least_missing_m = f64::INFINITY;
    let wrist_bend = across[0].hypot(across[1]);
    let wrist_is_singular = wrist_bend < ROUNDING;
    for sigma in signs(if wrist_is_singular { 0.0 } else { wrist_bend }) {
        let theta5 = (sigma * wrist_bend).atan2(across[2]);
        let theta6 = if wrist_is_singular { seed6 } else { (-sigma * across[1]).atan2(sigma * across[0]) };
        let (s5, c5) = theta5.sin_cos();
        let (s6, c6) = theta6.sin_cos();
        // (along_k, up_k) is `flat_k` turned by θ234, for each axis k of the flange; fit the turn.
        let flat = [[c5 * c6, s6], [-c5 * s6, c6], [-s5, 0.0]];
        let (mut sin, mut cos) = (0.0, 0.0);
        for (k, [a, b]) in flat.into_iter().enumerate() {
            sin += a * up[k] - b * along[k];
            cos += a * along[k] + b * up[k];
        }
        let theta234 = sin.atan2(cos);

        // Wrist 1 seen from the shoulder, in the arm's plane.
        let (s234, c234) = theta234.sin_cos();
        let kc = c1 * wrist.x + s1 * wrist.y - s234 * D5_M;
        let ks = wrist.z - D1_M + c234 * D5_M;
        let c3 = (ks * ks + kc * kc - A2_M * A2_M - A3_M * A3_M) / (2.0 * A2_M * A3_M);
        if c3.abs() > 1.0 + ROUNDING {
            let distance_m = kc.hypot(ks);
            let nearest_m = distance_m.clamp((A2_M - A3_M).abs(), (A2_M + A3_M).abs());
            least_missing_m = least_missing_m.min((distance_m - nearest_m).abs());
            continue;
        }
        let root_s3 = ((1.0 - c3) * (1.0 + c3)).max(0.0).sqrt();
        for elbow in signs(root_s3) {
            let s3 = elbow * root_s3;
            let theta3 = s3.atan2(c3);
            let theta2 = ks.atan2(kc) - (A3_M * s3).atan2(A3_M * c3 + A2_M);
            let theta4 = theta234 - theta2 - theta3;
            found.push([theta1, theta2, theta3, theta4, theta5, theta6]);
        }
    }
    least_missing_m
}

/// The signs of a square root, one of them if the root is zero.
fn signs(root: f64) -> impl Iterator<Item = f64> {
    [1.0, -1.0].into_iter().take(if root == 0.0 { 1 } else { 2 })
}

/// `angle_rad` turned into (−π, π].
fn wrapped(angle_rad: f64) -> f64 {
    let angle_rad = angle_rad - TAU * (angle_rad / TAU).round();
    if angle_rad <= -PI { PI } else { angle_rad.min(PI) }
}

/// The copy of `branch` nearest to `seed` and inside the limits, each joint by itself.
fn nearest_copy(branch: &Joints, seed: &Joints, limits_rad: &[[f64; 2]; 6]) -> Result<Joints, InverseError> {
    let mut copy = *branch;
    for joint in 0..6 {
        let angle_rad = branch[joint];
        let turns_to = |target_rad: f64| (target_rad - angle_rad) / TAU;
        let fewest = turns_to(limits_rad[joint][0]).ceil();
        let most = turns_to(limits_rad[joint][1]).floor();
        if fewest > most {
            return Err(InverseError::JointLimit { joint, angle_rad });
        }
        copy[joint] += TAU * turns_to(seed[joint]).round().max(fewest).min(most);
    }
    Ok(copy)
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
