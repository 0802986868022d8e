//! The robot, its gripper and the magnet as solids, for the scene.
//!
//! Joint frames come from the state. The housings between them follow the real arm, whose upper arm and forearm run
//! beside the joints' common plane.

use nalgebra::{Matrix4, Vector4};

use super::Subject;
use super::geometry_buffers::{Part, Solid};
use super::mesh::Color;
use crate::geometry::{Isometry3, Point3, Vector3};

const METAL: Color = [203, 208, 214, 255];
const LID: Color = [64, 140, 208, 255];
const SEAM: Color = [44, 47, 54, 255];
const FOOT: Color = [92, 97, 106, 255];
const GRIPPER: Color = [56, 60, 68, 255];
const FINGER: Color = [120, 126, 136, 255];
const PAD: Color = [34, 36, 42, 255];
const MAGNET: Color = [228, 225, 214, 255];

/// Along the shoulder's axis, from the plane of the joint frames to the middle of the upper arm.
const UPPER_ARM_ASIDE_M: f64 = 0.1358;
/// The same for the forearm.
const FOREARM_ASIDE_M: f64 = 0.0165;
/// Radii of the joint housings: the first two, the elbow, the wrists.
const SHOULDER_RADIUS_M: f64 = 0.060;
const ELBOW_RADIUS_M: f64 = 0.051;
const WRIST_RADIUS_M: f64 = 0.0405;
/// Width of the dark ring between two housings.
const SEAM_M: f64 = 0.006;
/// Upper limit of the drawn gripper, for a tool that is not on the arm.
const MAX_GRIPPER_M: f64 = 0.30;

/// Drawn length of the planar stage's column.
const COLUMN_M: f64 = 0.3;

/// Upper limit of the number of [`parts`].
pub(super) const MAX_PARTS: u64 = 96;

/// The solids of robot, gripper and block, in any order.
pub(super) fn parts(subject: &Subject) -> Vec<Part> {
    let mut parts = Vec::with_capacity(MAX_PARTS as usize);
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
    let joint = |link: usize| Line { origin: origin(link), along: axis(link) };

    let upright = Line { origin: Point3::origin(), along: Vector3::z() };
    let shoulder_m = origin(1).z;
    tube(parts, upright, [0.0, 0.010], 0.086, FOOT);
    tube(parts, upright, [0.010, 0.034], 0.072, METAL);
    tube(parts, upright, [0.034, 0.034 + SEAM_M], 0.069, SEAM);
    tube(parts, upright, [0.034 + SEAM_M, shoulder_m], 0.0625, METAL);
    housing(parts, joint(1), [-0.062, UPPER_ARM_ASIDE_M - 0.062], SHOULDER_RADIUS_M);

    // The upper arm on the far side of the shoulder, and the forearm back beside the joints.
    let aside = axis(1) * UPPER_ARM_ASIDE_M;
    housing(parts, joint(1), [UPPER_ARM_ASIDE_M + 0.052, UPPER_ARM_ASIDE_M - 0.058], SHOULDER_RADIUS_M);
    housing(parts, joint(2), [UPPER_ARM_ASIDE_M + 0.046, UPPER_ARM_ASIDE_M - 0.050], ELBOW_RADIUS_M);
    limb(parts, [origin(1) + aside, origin(2) + aside], [0.054, 0.047], [0.088, 0.076], 0.043);

    let aside = axis(2) * FOREARM_ASIDE_M;
    housing(parts, joint(2), [FOREARM_ASIDE_M - 0.044, UPPER_ARM_ASIDE_M - 0.056], ELBOW_RADIUS_M);
    limb(parts, [origin(2) + aside, origin(3) + aside], [0.046, 0.037], [0.076, 0.060], 0.036);

    // Three wrists; each ends in the side of the next.
    housing(parts, joint(3), [FOREARM_ASIDE_M - 0.034, 0.062], WRIST_RADIUS_M);
    for (link, next) in [(3, 4), (4, 5)] {
        let length_m = (origin(next) - origin(link)).norm();
        tube(parts, joint(link), [0.5 * length_m, length_m], 0.036, METAL);
    }
    for link in [4, 5] {
        housing(parts, joint(link), [-0.040, 0.047], WRIST_RADIUS_M);
    }
    let flange_m = (origin(6) - origin(5)).norm();
    tube(parts, joint(5), [0.047, flange_m], 0.0365, METAL);
}

pub(super) fn block(subject: &Subject) -> Part {
    let size = Vector3::from(subject.block_size_m);
    cuboid(Point3::from(subject.tool_m) + Vector3::z() * (0.5 * size.z), size, MAGNET)
}

/// The planar stage's column, which holds the block if there is no arm.
fn column(parts: &mut Vec<Part>, subject: &Subject) {
    let block_top_m = Point3::from(subject.tool_m) + Vector3::z() * subject.block_size_m[2];
    let upright = Line { origin: block_top_m, along: Vector3::z() };
    tube(parts, upright, [0.0, 0.02], 0.022, GRIPPER);
    lid(parts, upright, [0.02, 0.03], 0.022, GRIPPER);
    tube(parts, upright, [0.02, COLUMN_M], 0.014, METAL);
    lid(parts, upright, [COLUMN_M, COLUMN_M + 0.01], 0.014, LID);
}

/// From the flange to the block. The edges of block and fingers are along `base`; the fingers hold the block across
/// its narrower side.
fn gripper(parts: &mut Vec<Part>, subject: &Subject, base_from_flange: &Isometry3<f64>) {
    let tool = Point3::from(subject.tool_m);
    let size = Vector3::from(subject.block_size_m);
    let block_top = tool + Vector3::z() * size.z;
    let flange = Point3::from(base_from_flange.translation.vector);
    let along = base_from_flange.rotation * Vector3::z();
    let length_m = along.dot(&(block_top - flange)).clamp(0.0, MAX_GRIPPER_M);
    // Places are shares of the length.
    let line = Line { origin: flange, along: along * length_m };
    tube(parts, line, [0.0, 0.08], 0.0375, SEAM);
    tube(parts, line, [0.08, 0.12], 0.035, FINGER);
    tube(parts, line, [0.12, 0.46], 0.034, GRIPPER);
    lid(parts, line, [0.46, 0.50], 0.034, GRIPPER);

    let (across, wide) = if size.x < size.y { (0, 1) } else { (1, 0) };
    let solid = |along_across: f64, along_wide: f64, height: f64| {
        let mut edges = Vector3::zeros();
        (edges[across], edges[wide], edges.z) = (along_across, along_wide, height);
        edges
    };
    let (finger_m, pad_m) = (0.011, 0.004);
    let knuckles = solid(size[across] + 2.0 * (finger_m + pad_m) + 0.010, 0.032, 0.15 * length_m);
    parts.push(cuboid(line.at(0.57), knuckles, FINGER));
    // Fingers reach from the knuckles down to the block's lower edge, with a pad on the inside.
    let finger = solid(finger_m, 0.018, 0.38 * length_m + 0.8 * size.z);
    let pad = solid(pad_m, 0.021, size.z + 0.012);
    for side in [-0.5, 0.5] {
        let mut offset = Vector3::z() * (-0.4 * size.z);
        offset[across] = side * (size[across] + 2.0 * pad_m + finger_m);
        parts.push(cuboid(line.at(0.81) + offset, finger, FINGER));
        let mut offset = Vector3::z() * (-0.4 * size.z + 0.006);
        offset[across] = side * (size[across] + pad_m);
        parts.push(cuboid(line.at(1.0) + offset, pad, PAD));
    }
}

/// The axis of round solids; places on it are multiples of `along`.
#[derive(Clone, Copy)]
struct Line {
    origin: Point3<f64>,
    along: Vector3<f64>,
}

impl Line {
    fn at(&self, place: f64) -> Point3<f64> {
        self.origin + self.along * place
    }
}

/// The housing of a joint between two places on its axis: a lid closes the first, and a seam at the second joins it
/// to the next housing.
fn housing(parts: &mut Vec<Part>, joint: Line, [closed, open]: [f64; 2], radius_m: f64) {
    let out = (closed - open).signum();
    tube(parts, joint, [open, closed], radius_m, METAL);
    tube(parts, joint, [open - out * SEAM_M, open], 0.95 * radius_m, SEAM);
    tube(parts, joint, [closed, closed + out * 0.003], 0.94 * radius_m, SEAM);
    tube(parts, joint, [closed + out * 0.003, closed + out * 0.007], 0.97 * radius_m, LID);
    lid(parts, joint, [closed + out * 0.007, closed + out * 0.018], 0.97 * radius_m, LID);
}

/// A tube between two housings; rounded stubs cover its ends.
fn limb(parts: &mut Vec<Part>, [from, to]: [Point3<f64>; 2], stub_radius_m: [f64; 2], stub_m: [f64; 2], radius_m: f64) {
    let along = (to - from).normalize();
    let whole = Line { origin: from, along };
    tube(parts, whole, [0.0, (to - from).norm()], radius_m, METAL);
    let ends = [whole, Line { origin: to, along: -along }];
    for (end, (stub_radius_m, stub_m)) in ends.into_iter().zip(stub_radius_m.into_iter().zip(stub_m)) {
        tube(parts, end, [0.0, stub_m], stub_radius_m, METAL);
        lid(parts, end, [stub_m, stub_m + 0.016], stub_radius_m, METAL);
        tube(parts, end, [stub_m + 0.012, stub_m + 0.020], radius_m + 0.0012, SEAM);
    }
}

fn tube(parts: &mut Vec<Part>, line: Line, places: [f64; 2], radius_m: f64, color: Color) {
    parts.extend(round(Solid::Cylinder, line, places, radius_m, color));
}

/// A lid with its rim at the first place and its top at the second.
fn lid(parts: &mut Vec<Part>, line: Line, places: [f64; 2], radius_m: f64, color: Color) {
    parts.extend(round(Solid::Disc, line, places, radius_m, color));
}

/// `None` if the places coincide.
fn round(solid: Solid, line: Line, [from, to]: [f64; 2], radius_m: f64, color: Color) -> Option<Part> {
    let along = line.along * (to - from);
    if along.norm() < 1e-9 {
        return None;
    }
    let slanted = if along.x.abs() < 0.7 * along.norm() { Vector3::x() } else { Vector3::y() };
    let u = along.cross(&slanted).normalize();
    let v = along.cross(&u).normalize();
    let base_from_solid = Matrix4::from_columns(&[
        (u * radius_m).push(0.0),
        (v * radius_m).push(0.0),
        along.push(0.0),
        line.at(from).to_homogeneous(),
    ]);
    Some(Part { solid, base_from_solid, color })
}

/// An axis-aligned box around `center`.
fn cuboid(center: Point3<f64>, size: Vector3<f64>, color: Color) -> Part {
    let mut base_from_solid = Matrix4::new_nonuniform_scaling(&size);
    base_from_solid.set_column(3, &Vector4::new(center.x, center.y, center.z, 1.0));
    Part { solid: Solid::Cube, base_from_solid, color }
}
