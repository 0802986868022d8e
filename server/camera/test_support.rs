//! Fixtures: a post, a row of posts, and the arm above them.

use std::sync::Arc;

use super::{AdapterChoice, Gpu, StaticScene, Subject};
use ferry_core::geometry::{Isometry3, Polygon, Rect, Vector3};
use ferry_core::image::CameraMount;
use nalgebra::{Translation3, UnitQuaternion};

pub const WORKSPACE: Rect = Rect { x_min_m: -0.30, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
pub const WALL_HEIGHT_M: f64 = 0.005;

/// Any device; the tests fail without one.
pub fn gpu() -> Arc<Gpu> {
    Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter")
}

pub fn static_scene(walls: &[Polygon]) -> StaticScene<'_> {
    StaticScene { workspace: &WORKSPACE, walls, wall_height_m: WALL_HEIGHT_M }
}

/// A wall on the rectangle from (x0, y0) to (x1, y1).
pub fn block(x0: f64, y0: f64, x1: f64, y1: f64) -> Polygon {
    Polygon { exterior: vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]], holes: vec![] }
}

/// Round posts on a staggered lattice, a long wall, and a square ring with a hole.
pub fn posts() -> Vec<Polygon> {
    let circle = |x: f64, y: f64, radius: f64| -> Vec<[f64; 2]> {
        (0..32)
            .map(|step| std::f64::consts::TAU * f64::from(step) / 32.0)
            .map(|angle| [x + radius * angle.cos(), y + radius * angle.sin()])
            .collect()
    };
    let mut walls = Vec::new();
    for row in 0..3 {
        for column in 0..5 {
            let shift = if row % 2 == 0 { 0.0 } else { 0.05 };
            let (x, y) = (-0.24 + 0.1 * f64::from(column) + shift, -0.28 - 0.09 * f64::from(row));
            walls.push(Polygon { exterior: circle(x, y, 0.016), holes: vec![] });
        }
    }
    walls.push(block(-0.10, -0.515, 0.08, -0.507));
    let mut ring = block(0.19, -0.53, 0.26, -0.48);
    let mut hole = block(0.20, -0.52, 0.25, -0.49).exterior;
    hole.reverse();
    ring.holes.push(hole);
    walls.push(ring);
    walls
}

/// The arm with its tool pointing straight down at `tool_m`, about 10 cm above the table.
pub fn subject(tool_m: [f64; 3], bead_m: [f64; 3]) -> Subject {
    let flange_m = Vector3::from(tool_m) + Vector3::z() * 0.18;
    Subject {
        tick: 7,
        tool_m,
        turn_rad: 0.0,
        bead_m,
        goal_m: Some([0.19, -0.28]),
        link_frames: Some(forward(tool_down(flange_m))),
        block_size_m: [0.05, 0.025, 0.010],
        mount: CameraMount::default(),
        moved_walls: None,
    }
}

const D: [f64; 6] = [0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823];
const A: [f64; 6] = [0.0, -0.425, -0.39225, 0.0, 0.0, 0.0];
const QUARTER: f64 = std::f64::consts::FRAC_PI_2;
const ALPHA: [f64; 6] = [QUARTER, 0.0, 0.0, QUARTER, -QUARTER, 0.0];

/// Denavit–Hartenberg frames of the UR5.
fn forward(joints_rad: [f64; 6]) -> [Isometry3<f64>; 6] {
    let mut base_from_link = Isometry3::identity();
    std::array::from_fn(|i| {
        let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
        base_from_link *=
            Isometry3::from_parts(Translation3::new(0.0, 0.0, D[i]), about(Vector3::z_axis(), joints_rad[i]))
                * Isometry3::from_parts(Translation3::new(A[i], 0.0, 0.0), about(Vector3::x_axis(), ALPHA[i]));
        base_from_link
    })
}

/// Joint angles with the flange at `p` facing down and the elbow up: the closed form for rotation rows
/// (0, −1, 0), (−1, 0, 0), (0, 0, −1).
fn tool_down(p: Vector3<f64>) -> [f64; 6] {
    let [d1, _, _, d4, d5, d6] = D;
    let (a2, a3) = (A[1], A[2]);
    let square = p.x * p.x + p.y * p.y - d4 * d4;
    let theta1 = p.x.atan2(-p.y) - square.sqrt().atan2(d4);
    let branches = [theta1, p.x.atan2(-p.y) + square.sqrt().atan2(d4)];
    let mut best: Option<([f64; 6], f64)> = None;
    for theta1 in branches {
        let (s1, c1) = theta1.sin_cos();
        for sigma in [-1.0_f64, 1.0] {
            let theta6 = (sigma * s1).atan2(sigma * c1);
            let theta5 = sigma * QUARTER;
            let theta234 = (theta6.sin() * s1).atan2(-theta6.cos() * 0.0 + 0.0);
            let (s234, c234) = theta234.sin_cos();
            let kc = c1 * p.x + s1 * p.y - s234 * d5 + c234 * sigma * d6;
            let ks = p.z - d1 + c234 * d5 + s234 * sigma * d6;
            let c3 = (ks * ks + kc * kc - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
            if c3.abs() > 1.0 {
                continue;
            }
            for s3 in [-(1.0 - c3 * c3).sqrt(), (1.0 - c3 * c3).sqrt()] {
                let theta3 = s3.atan2(c3);
                let theta2 = ks.atan2(kc) - (a3 * s3).atan2(a3 * c3 + a2);
                let joints = [theta1, theta2, theta3, theta234 - theta2 - theta3, theta5, theta6];
                let frames = forward(joints);
                let miss = (frames[5].translation.vector - p).norm()
                    + (frames[5].rotation * Vector3::z() + Vector3::z()).norm();
                // Prefer the solution with the elbow up.
                let height = frames[1].translation.z - 100.0 * miss;
                if best.is_none_or(|(_, max)| height > max) {
                    best = Some((joints, height));
                }
            }
        }
    }
    best.expect("the pose is within reach").0
}
