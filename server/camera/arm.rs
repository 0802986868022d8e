//! The robot, its gripper and the magnet as solids, for the scene.
//!
//! Joint frames come from the state. The housings between them follow the real arm, whose upper arm and forearm run
//! beside the joints' common plane.

use nalgebra::{Matrix4, Vector4};

use super::Subject;
use super::geometry_buffers::{Part, Solid};
use super::mesh::Color;
use super::robot::{BLOCK_COLOR, Material, solids};
use ferry_core::geometry::{Isometry3, Point3, Vector3};

const METAL: Color = opaque(Material::Metal.color());
const LID: Color = opaque(Material::Lid.color());
const SEAM: Color = opaque(Material::Seam.color());
const GRIPPER: Color = [56, 60, 68, 255];
const FINGER: Color = [120, 126, 136, 255];
const PAD: Color = [34, 36, 42, 255];
const MAGNET: Color = opaque(BLOCK_COLOR);

/// Longest gripper that is drawn, for a stage whose tool is not on the arm.
const MAX_GRIPPER_M: f64 = 0.30;

/// Drawn length of the planar stage's column.
const COLUMN_M: f64 = 0.3;

/// Upper limit of the number of [`parts`].
pub(super) const MAX_PARTS: u64 = 96;

const fn opaque([red, green, blue]: [u8; 3]) -> Color {
    [red, green, blue, 255]
}

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

/// The robot's own solids, wherever their frames are.
fn robot(parts: &mut Vec<Part>, base_from_link: &[Isometry3<f64>; 6]) {
    for solid in solids() {
        let frame = if solid.frame == 0 { Isometry3::identity() } else { base_from_link[solid.frame - 1] };
        let line =
            Line { origin: frame * Point3::from(solid.origin_m), along: frame.rotation * Vector3::from(solid.along) };
        let color = opaque(solid.material.color());
        let place = if solid.is_lid { lid } else { tube };
        place(parts, line, solid.places_m, solid.radius_m, color);
    }
}

/// What is below the flange, without the flange: the gripper or the stage's column, and the block.
pub(super) fn tool_parts(subject: &Subject) -> Vec<Part> {
    let mut parts = Vec::new();
    match &subject.link_frames {
        Some(frames) => gripper(&mut parts, subject, &frames[5]),
        None => column(&mut parts, subject),
    }
    parts.push(block(subject));
    // Equal solids that follow each other are drawn together.
    parts.sort_by_key(|part| part.solid);
    parts
}

pub(super) fn block(subject: &Subject) -> Part {
    let size = Vector3::from(subject.block_size_m);
    turned(subject, cuboid(Point3::from(subject.tool_m) + Vector3::z() * (0.5 * size.z), size, MAGNET))
}

/// A part of the tool, turned with it about the vertical.
fn turned(subject: &Subject, part: Part) -> Part {
    let tool_m = Vector3::from(subject.tool_m);
    let turn = Matrix4::new_translation(&tool_m)
        * Matrix4::from_axis_angle(&Vector3::z_axis(), subject.turn_rad)
        * Matrix4::new_translation(&-tool_m);
    match subject.turn_rad {
        0.0 => part,
        _ => Part { base_from_solid: turn * part.base_from_solid, ..part },
    }
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

/// From the flange to the block. The edges of block and fingers are along `base` if the tool is not turned; the fingers
/// hold the block across its narrower side.
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
    parts.push(turned(subject, cuboid(line.at(0.57), knuckles, FINGER)));
    // Fingers reach from the knuckles down to the block's lower edge, with a pad on the inside.
    let finger = solid(finger_m, 0.018, 0.38 * length_m + 0.8 * size.z);
    let pad = solid(pad_m, 0.021, size.z + 0.012);
    for side in [-0.5, 0.5] {
        let mut offset = Vector3::z() * (-0.4 * size.z);
        offset[across] = side * (size[across] + 2.0 * pad_m + finger_m);
        parts.push(turned(subject, cuboid(line.at(0.81) + offset, finger, FINGER)));
        let mut offset = Vector3::z() * (-0.4 * size.z + 0.006);
        offset[across] = side * (size[across] + pad_m);
        parts.push(turned(subject, cuboid(line.at(1.0) + offset, pad, PAD)));
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

/// A cylinder between two places on a line.
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
