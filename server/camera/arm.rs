//! The robot, its gripper and the magnet as solids. Only the scene shows them.
//!
//! Joint frames come from the state; the housings between them are drawn after the real arm, whose
//! upper arm and forearm run beside the joints' common plane.

use nalgebra::{Matrix4, Vector4};

use super::Subject;
use super::geometry_buffers::{Part, Solid};
use super::mesh::Color;
use crate::geometry::{Isometry3, Point3, Vector3};

const TUBE: Color = [206, 212, 220, 255];
const CAP: Color = [96, 158, 214, 255];
const DARK: Color = [58, 62, 70, 255];
const GRIPPER: Color = [120, 126, 136, 255];
const FINGER: Color = [88, 94, 104, 255];
const MAGNET: Color = [38, 40, 48, 255];

/// Along the shoulder's axis, from the joint frames' plane to the middle of the upper arm.
const UPPER_ARM_ASIDE_M: f64 = 0.1358;
/// The same for the forearm.
const FOREARM_ASIDE_M: f64 = 0.0165;
/// Longest gripper that is drawn, for a stage whose tool is not on the arm.
const MOST_GRIPPER_M: f64 = 0.30;

/// Length of the planar stage's column that is drawn.
const COLUMN_M: f64 = 0.3;

/// Parts that [`parts`] can return at most.
pub(super) const MOST_PARTS: u64 = 48;

/// The solids of robot, gripper and block, in any order.
pub(super) fn parts(subject: &Subject) -> Vec<Part> {
    let mut parts = Vec::with_capacity(MOST_PARTS as usize);
    match &subject.link_frames {
        Some(frames) => {
            robot(&mut parts, frames);
            gripper(&mut parts, subject, &frames[5]);
        }
        None => column(&mut parts, subject),
    }
    parts.push(block(subject));
    parts
}

fn robot(parts: &mut Vec<Part>, base_from_link: &[Isometry3<f64>; 6]) {
    let origin = |link: usize| Point3::from(base_from_link[link - 1].translation.vector);
    let axis = |link: usize| base_from_link[link - 1].rotation * Vector3::z();
    let (up, foot) = (Vector3::z(), Point3::origin());

    // Base and shoulder: an upright column, and the housing of joint 2 across it.
    tube(parts, foot, foot + up * 0.022, 0.088, DARK);
    tube(parts, foot + up * 0.022, origin(1) - up * 0.02, 0.068, TUBE);
    let shoulder = (origin(1), axis(1));
    housing(parts, shoulder, -0.058, UPPER_ARM_ASIDE_M - 0.058, 0.060);

    // Upper arm, on the far side of the shoulder, with a joint housing at either end.
    let aside = axis(1) * UPPER_ARM_ASIDE_M;
    let elbow = (origin(2), axis(2));
    housing(parts, shoulder, UPPER_ARM_ASIDE_M - 0.058, UPPER_ARM_ASIDE_M + 0.062, 0.060);
    tube(parts, origin(1) + aside, origin(2) + aside, 0.048, TUBE);
    housing(parts, elbow, UPPER_ARM_ASIDE_M - 0.052, UPPER_ARM_ASIDE_M + 0.055, 0.052);

    // Forearm, back beside the joints.
    let aside = axis(2) * FOREARM_ASIDE_M;
    housing(parts, elbow, FOREARM_ASIDE_M - 0.050, UPPER_ARM_ASIDE_M - 0.052, 0.050);
    tube(parts, origin(2) + aside, origin(3) + aside, 0.040, TUBE);

    // Three wrists, each across the one before.
    housing(parts, (origin(3), axis(3)), FOREARM_ASIDE_M - 0.044, FOREARM_ASIDE_M + 0.040, 0.042);
    tube(parts, origin(3) + aside, origin(4), 0.038, TUBE);
    housing(parts, (origin(4), axis(4)), -0.050, 0.042, 0.041);
    tube(parts, origin(4), origin(5), 0.038, TUBE);
    housing(parts, (origin(5), axis(5)), -0.050, 0.042, 0.041);
    tube(parts, origin(5), origin(6), 0.036, TUBE);
}

/// The magnet.
pub(super) fn block(subject: &Subject) -> Part {
    let size = Vector3::from(subject.block_size_m);
    cuboid(Point3::from(subject.tool_m) + Vector3::z() * (0.5 * size.z), size, MAGNET)
}

/// What holds the block where there is no arm: a column of the planar stage.
fn column(parts: &mut Vec<Part>, subject: &Subject) {
    let top = Point3::from(subject.tool_m) + Vector3::z() * subject.block_size_m[2];
    tube(parts, top, top + Vector3::z() * 0.02, 0.022, GRIPPER);
    tube(parts, top + Vector3::z() * 0.02, top + Vector3::z() * COLUMN_M, 0.014, TUBE);
}

/// From the flange to the block, whose edges are along `base`, so that the fingers
/// are too: they hold it across its narrower side.
fn gripper(parts: &mut Vec<Part>, subject: &Subject, base_from_flange: &Isometry3<f64>) {
    let tool = Point3::from(subject.tool_m);
    let size = Vector3::from(subject.block_size_m);
    let block_top = tool + Vector3::z() * size.z;
    let flange = Point3::from(base_from_flange.translation.vector);
    let along = base_from_flange.rotation * Vector3::z();
    let length = along.dot(&(block_top - flange)).clamp(0.0, MOST_GRIPPER_M);
    let at = |share: f64| flange + along * (share * length);
    tube(parts, flange, at(0.22), 0.036, DARK);
    tube(parts, at(0.22), at(0.30), 0.028, GRIPPER);

    let (across, wide) = if size.x < size.y { (0, 1) } else { (1, 0) };
    let solid = |along_across: f64, along_wide: f64, height: f64| {
        let mut edges = Vector3::zeros();
        (edges[across], edges[wide], edges.z) = (along_across, along_wide, height);
        edges
    };
    let palm = solid(size[across] + 0.036, 0.040, 0.45 * length);
    parts.push(cuboid(at(0.52), palm, GRIPPER));
    // Fingers reach from the palm half-way down the block.
    let finger = solid(0.010, 0.022, 0.27 * length + 0.5 * size.z);
    for side in [-0.5, 0.5] {
        let mut offset = Vector3::z() * (-0.25 * size.z);
        offset[across] = side * (size[across] + finger[across]);
        parts.push(cuboid(at(0.865) + offset, finger, FINGER));
    }
}

/// A cylinder between two points.
fn tube(parts: &mut Vec<Part>, from: Point3<f64>, to: Point3<f64>, radius_m: f64, color: Color) {
    let along = to - from;
    if along.norm() < 1e-9 {
        return;
    }
    let slanted = if along.x.abs() < 0.7 * along.norm() { Vector3::x() } else { Vector3::y() };
    let u = along.cross(&slanted).normalize();
    let v = along.cross(&u).normalize();
    parts.push(Part {
        solid: Solid::Cylinder,
        base_from_solid: Matrix4::from_columns(&[
            (u * radius_m).push(0.0),
            (v * radius_m).push(0.0),
            along.push(0.0),
            from.to_homogeneous(),
        ]),
        color,
    });
}

/// The housing of a joint: a thick cylinder along the joint's axis, between two places on it, with
/// the blue lid of this make on its outer end.
fn housing(parts: &mut Vec<Part>, (origin, axis): (Point3<f64>, Vector3<f64>), from_m: f64, to_m: f64, radius_m: f64) {
    let lid_m = 0.012;
    let at = |along_m: f64| origin + axis * along_m;
    // The outer end is the one farther from the joint frame.
    let (inner_m, outer_m) = if from_m.abs() > to_m.abs() { (to_m, from_m) } else { (from_m, to_m) };
    let outward = (outer_m - inner_m).signum();
    tube(parts, at(inner_m), at(outer_m), radius_m, TUBE);
    let lid = (at(outer_m), at(outer_m + outward * lid_m));
    tube(parts, lid.0, lid.1, 0.93 * radius_m, CAP);
}

/// An upright box around `center`.
fn cuboid(center: Point3<f64>, size: Vector3<f64>, color: Color) -> Part {
    let mut base_from_solid = Matrix4::new_nonuniform_scaling(&size);
    base_from_solid.set_column(3, &Vector4::new(center.x, center.y, center.z, 1.0));
    Part { solid: Solid::Cube, base_from_solid, color }
}
