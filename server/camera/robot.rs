//! The robot's solids, each fixed to a link: the scene draws them, and the page draws the same ones.
//!
//! The housings between the joint frames follow the real arm, whose upper arm and forearm run beside the joints'
//! common plane.

use ferry_core::robot::ur5::{A2_M, A3_M, D1_M, D4_M, D5_M, D6_M, FOREARM_ASIDE_M, UPPER_ARM_ASIDE_M};

/// Radii of the housings around the joints. The shoulder's value holds for the first two joints.
const SHOULDER_RADIUS_M: f64 = 0.060;
const ELBOW_RADIUS_M: f64 = 0.051;
const WRIST_RADIUS_M: f64 = 0.0405;
/// Width of the dark ring between two housings.
const SEAM_M: f64 = 0.006;

/// Red, green and blue of the magnet.
pub const BLOCK_COLOR: [u8; 3] = [228, 225, 214];

/// What a solid looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Material {
    Metal,
    Lid,
    Seam,
    Foot,
}

impl Material {
    /// Red, green and blue.
    pub const fn color(self) -> [u8; 3] {
        match self {
            Self::Metal => [203, 208, 214],
            Self::Lid => [64, 140, 208],
            Self::Seam => [44, 47, 54],
            Self::Foot => [92, 97, 106],
        }
    }
}

/// A round solid between two places on a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotSolid {
    /// The Denavit-Hartenberg frame to which it is fixed: 0 is the base, 6 the flange.
    pub frame: usize,
    /// A lid has its rim at the first place and its domed top at the second; otherwise a cylinder.
    pub is_lid: bool,
    /// What it looks like.
    pub material: Material,
    /// Where the line begins, in the frame.
    pub origin_m: [f64; 3],
    /// The line's direction, of length 1.
    pub along: [f64; 3],
    /// The two places, from the origin.
    pub places_m: [f64; 2],
    pub radius_m: f64,
}

/// All solids from the foot to the last wrist.
pub fn solids() -> Vec<RobotSolid> {
    let mut all = Vec::with_capacity(64);
    let solids = &mut all;
    let foot = Line::axis(0);
    foot.tube(solids, [0.0, 0.010], 0.086, Material::Foot);
    foot.tube(solids, [0.010, 0.034], 0.072, Material::Metal);
    foot.tube(solids, [0.034, 0.034 + SEAM_M], 0.069, Material::Seam);
    foot.tube(solids, [0.034 + SEAM_M, D1_M], 0.0625, Material::Metal);
    housing(solids, 1, [-0.062, UPPER_ARM_ASIDE_M - 0.062], SHOULDER_RADIUS_M);

    // The upper arm, on the far side of the shoulder, and the forearm, back beside the joints.
    housing(solids, 1, [UPPER_ARM_ASIDE_M + 0.052, UPPER_ARM_ASIDE_M - 0.058], SHOULDER_RADIUS_M);
    housing(solids, 2, [UPPER_ARM_ASIDE_M + 0.046, UPPER_ARM_ASIDE_M - 0.050], ELBOW_RADIUS_M);
    limb(solids, 2, [-A2_M, UPPER_ARM_ASIDE_M], [0.054, 0.047], [0.088, 0.076], 0.043);

    housing(solids, 2, [FOREARM_ASIDE_M - 0.044, UPPER_ARM_ASIDE_M - 0.056], ELBOW_RADIUS_M);
    limb(solids, 3, [-A3_M, FOREARM_ASIDE_M], [0.046, 0.037], [0.076, 0.060], 0.036);

    // Three wrists; each ends in the side of the next.
    housing(solids, 3, [FOREARM_ASIDE_M - 0.034, 0.062], WRIST_RADIUS_M);
    for (frame, length_m) in [(3, D4_M), (4, D5_M)] {
        Line::axis(frame).tube(solids, [0.5 * length_m, length_m], 0.036, Material::Metal);
    }
    for frame in [4, 5] {
        housing(solids, frame, [-0.040, 0.047], WRIST_RADIUS_M);
    }
    Line::axis(5).tube(solids, [0.047, D6_M], 0.0365, Material::Metal);
    all
}

/// The line on which round solids are placed, in a frame.
#[derive(Clone, Copy)]
struct Line {
    frame: usize,
    origin_m: [f64; 3],
    along: [f64; 3],
}

impl Line {
    /// The frame's z, which is the next joint's axis.
    fn axis(frame: usize) -> Self {
        Self { frame, origin_m: [0.0; 3], along: [0.0, 0.0, 1.0] }
    }

    fn tube(self, solids: &mut Vec<RobotSolid>, places_m: [f64; 2], radius_m: f64, material: Material) {
        let Self { frame, origin_m, along } = self;
        solids.push(RobotSolid { frame, is_lid: false, material, origin_m, along, places_m, radius_m });
    }

    fn lid(self, solids: &mut Vec<RobotSolid>, places_m: [f64; 2], radius_m: f64, material: Material) {
        let Self { frame, origin_m, along } = self;
        solids.push(RobotSolid { frame, is_lid: true, material, origin_m, along, places_m, radius_m });
    }
}

/// The housing of a joint, between two places on its axis: the first carries a lid, the second meets the next
/// housing at a seam.
fn housing(solids: &mut Vec<RobotSolid>, frame: usize, [closed, open]: [f64; 2], radius_m: f64) {
    let out = (closed - open).signum();
    let axis = Line::axis(frame);
    axis.tube(solids, [open, closed], radius_m, Material::Metal);
    axis.tube(solids, [open - out * SEAM_M, open], 0.95 * radius_m, Material::Seam);
    axis.tube(solids, [closed, closed + out * 0.003], 0.94 * radius_m, Material::Seam);
    axis.tube(solids, [closed + out * 0.003, closed + out * 0.007], 0.97 * radius_m, Material::Lid);
    axis.lid(solids, [closed + out * 0.007, closed + out * 0.018], 0.97 * radius_m, Material::Lid);
}

/// A tube along the frame's x to its origin, beside the joints' plane, between two housings; it ends in rounded stubs.
fn limb(
    solids: &mut Vec<RobotSolid>,
    frame: usize,
    [length_m, aside_m]: [f64; 2],
    stub_radius_m: [f64; 2],
    stub_m: [f64; 2],
    radius_m: f64,
) {
    let far = Line { frame, origin_m: [length_m, 0.0, aside_m], along: [-1.0, 0.0, 0.0] };
    let near = Line { frame, origin_m: [0.0, 0.0, aside_m], along: [1.0, 0.0, 0.0] };
    far.tube(solids, [0.0, length_m], radius_m, Material::Metal);
    for (end, (stub_radius_m, stub_m)) in [far, near].into_iter().zip(stub_radius_m.into_iter().zip(stub_m)) {
        end.tube(solids, [0.0, stub_m], stub_radius_m, Material::Metal);
        end.lid(solids, [stub_m, stub_m + 0.016], stub_radius_m, Material::Metal);
        end.tube(solids, [stub_m + 0.012, stub_m + 0.020], radius_m + 0.0012, Material::Seam);
    }
}
