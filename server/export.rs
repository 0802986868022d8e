//! The arm with gripper and magnet for other programs: a URDF, or a model for MuJoCo.
//!
//! Links and joints have the names of Universal Robots' ROS packages. The root is the frame `base` of the robot's
//! controller, which is Ferry's. `tool0` is the flange. The origin of `magnet` is Ferry's tool point, in the middle of
//! the block's lower face; its axes are those of `base` while the flange points straight down.

mod mjcf;
mod urdf;
mod xml;

pub use mjcf::mjcf;
pub use urdf::urdf;

use nalgebra::{Rotation3, Translation3, UnitQuaternion};

use ferry_camera::robot::{BLOCK_COLOR, Material, RobotSolid, solids};
use ferry_core::geometry::{Isometry3, Vector3};
use ferry_core::plant::{Plant, Positioner, TOOL_LENGTH_M};
use ferry_core::robot::{forward, ur5};
use ferry_core::scenario::Parameters;

/// Typical of sintered NdFeB.
const BLOCK_DENSITY_KG_M3: f64 = 7500.0;
const GRIPPER_RADIUS_M: f64 = 0.034;

/// A link of the UR5, and the joint that carries it.
///
/// Masses and their centres: Universal Robots, "DH parameters for calculations of kinematics and dynamics". Torques:
/// the UR5's technical specification. Moments of inertia are not published; those of a solid cylinder take their place.
struct Datum {
    link: &'static str,
    joint: &'static str,
    torque_n_m: f64,
    mass_kg: f64,
    /// In the link's Denavit-Hartenberg frame.
    center_m: [f64; 3],
    /// Axis of the cylinder in that frame: 0 is x.
    along: usize,
    radius_m: f64,
    length_m: f64,
}

#[rustfmt::skip]
const DATA: [Datum; 6] = [
    Datum { link: "shoulder_link", joint: "shoulder_pan_joint", torque_n_m: 150.0, mass_kg: 3.7, center_m: [0.0, -0.02561, 0.00193], along: 2, radius_m: 0.06, length_m: 0.15 },
    Datum { link: "upper_arm_link", joint: "shoulder_lift_joint", torque_n_m: 150.0, mass_kg: 8.393, center_m: [0.2125, 0.0, 0.11336], along: 0, radius_m: 0.06, length_m: 0.545 },
    Datum { link: "forearm_link", joint: "elbow_joint", torque_n_m: 150.0, mass_kg: 2.33, center_m: [0.15, 0.0, 0.0265], along: 0, radius_m: 0.045, length_m: 0.48 },
    Datum { link: "wrist_1_link", joint: "wrist_1_joint", torque_n_m: 28.0, mass_kg: 1.219, center_m: [0.0, -0.0018, 0.01634], along: 2, radius_m: 0.0405, length_m: 0.1 },
    Datum { link: "wrist_2_link", joint: "wrist_2_joint", torque_n_m: 28.0, mass_kg: 1.219, center_m: [0.0, 0.0018, 0.01634], along: 2, radius_m: 0.0405, length_m: 0.1 },
    Datum { link: "wrist_3_link", joint: "wrist_3_joint", torque_n_m: 28.0, mass_kg: 0.1879, center_m: [0.0, 0.0, -0.001159], along: 2, radius_m: 0.0365, length_m: 0.035 },
];

/// A rigid body.
struct Link {
    name: &'static str,
    /// Where it is in its parent, at the joint's angle 0.
    parent_from_link: Isometry3<f64>,
    /// It turns about its own z; `None` if it is fixed.
    joint: Option<Joint>,
    inertia: Option<Inertia>,
    shapes: Vec<Shape>,
}

struct Joint {
    name: &'static str,
    torque_n_m: f64,
}

#[derive(Default)]
struct Inertia {
    mass_kg: f64,
    center_m: Vector3<f64>,
    /// About axes parallel to the link's.
    moments_kg_m2: Vector3<f64>,
}

enum Form {
    /// Along z.
    Cylinder {
        radius_m: f64,
        length_m: f64,
    },
    Cuboid {
        size_m: Vector3<f64>,
    },
}

struct Shape {
    form: Form,
    link_from_shape: Isometry3<f64>,
    color: [u8; 3],
    /// Otherwise it is only seen.
    collides: bool,
}

/// The links from the base to the magnet; each is the parent of the next.
fn links(parameters: &Parameters) -> Vec<Link> {
    let mut links = vec![Link {
        name: "base",
        parent_from_link: Isometry3::identity(),
        joint: None,
        inertia: None,
        shapes: Vec::new(),
    }];
    // A Denavit-Hartenberg frame lies at its link's far end, that of a URDF's link in the joint that carries it.
    let mut link_from_frame = Isometry3::identity();
    let mut frames = vec![link_from_frame];
    for (datum, row) in DATA.iter().zip(&ur5::DH) {
        let parent_from_link = link_from_frame;
        link_from_frame = forward::link(row, 0.0);
        frames.push(link_from_frame);
        links.push(Link {
            name: datum.link,
            parent_from_link,
            joint: Some(Joint { name: datum.joint, torque_n_m: datum.torque_n_m }),
            inertia: Some(datum.inertia(&link_from_frame)),
            shapes: Vec::new(),
        });
    }
    for solid in solids() {
        links[solid.frame].shapes.push(shape_of(&solid, &frames[solid.frame]));
    }
    let size_m = Vector3::from(Plant::new(parameters.plant()).block_size_m());
    links.push(gripper(link_from_frame, TOOL_LENGTH_M - size_m.z));
    links.push(magnet(size_m));
    links
}

impl Datum {
    fn inertia(&self, link_from_frame: &Isometry3<f64>) -> Inertia {
        let radius_2 = self.radius_m.powi(2);
        let mut moments = Vector3::repeat(self.mass_kg * (3.0 * radius_2 + self.length_m.powi(2)) / 12.0);
        moments[self.along] = 0.5 * self.mass_kg * radius_2;
        // The frames are quarter turns apart, so axes stay axes.
        let moments_kg_m2 = (link_from_frame.rotation * moments).abs();
        let center_m = (link_from_frame * nalgebra::Point3::from(self.center_m)).coords;
        Inertia { mass_kg: self.mass_kg, center_m, moments_kg_m2 }
    }
}

fn shape_of(solid: &RobotSolid, link_from_frame: &Isometry3<f64>) -> Shape {
    let along = Vector3::from(solid.along);
    let [from_m, to_m] = solid.places_m;
    let middle_m = Vector3::from(solid.origin_m) + along * (0.5 * (from_m + to_m));
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &along)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
    Shape {
        form: Form::Cylinder { radius_m: solid.radius_m, length_m: (to_m - from_m).abs() },
        link_from_shape: link_from_frame * Isometry3::from_parts(middle_m.into(), turn),
        color: solid.material.color(),
        collides: matches!(solid.material, Material::Metal | Material::Foot),
    }
}

fn gripper(parent_from_link: Isometry3<f64>, length_m: f64) -> Link {
    let shape = Shape {
        form: Form::Cylinder { radius_m: GRIPPER_RADIUS_M, length_m },
        link_from_shape: Isometry3::translation(0.0, 0.0, 0.5 * length_m),
        color: Material::Seam.color(),
        collides: true,
    };
    Link { name: "tool0", parent_from_link, joint: None, inertia: None, shapes: vec![shape] }
}

fn magnet(size_m: Vector3<f64>) -> Link {
    let mass_kg = BLOCK_DENSITY_KG_M3 * size_m.product();
    let squares = size_m.component_mul(&size_m);
    let center_m = Vector3::z() * (0.5 * size_m.z);
    Link {
        name: "magnet",
        parent_from_link: Positioner::flange_from_tool(),
        joint: None,
        inertia: Some(Inertia {
            mass_kg,
            center_m,
            moments_kg_m2: (Vector3::repeat(squares.sum()) - squares) * (mass_kg / 12.0),
        }),
        shapes: vec![Shape {
            form: Form::Cuboid { size_m },
            link_from_shape: Translation3::from(center_m).into(),
            color: BLOCK_COLOR,
            collides: true,
        }],
    }
}

/// Roll, pitch and yaw of a pose, as in a URDF: about the fixed axes x, y and z, in this order.
fn roll_pitch_yaw(pose: &Isometry3<f64>) -> [f64; 3] {
    let (roll, pitch, yaw) = Rotation3::from(pose.rotation).euler_angles();
    [roll, pitch, yaw]
}
